// SPDX-License-Identifier: GPL-2.0-or-later
/// Impulses as functions of the velocities after the step, and Newton's method for the impulses of an island.
#include "heap.hpp"
#include <gtest/gtest.h>
#include <kernel/contact_step.hpp>
#include <kernel/point_law.hpp>

using namespace timber;
using namespace timber::shapes;

namespace {

/// A point between two bodies of 0.1 kg to 1 t: loaded or new, hardening or linear, with an account or none.
PointStep randomPoint(Random& random)
{
	const double h = 5e-4, mass = logUniform(random, 0.1, 1000), n = logUniform(random, 1e-7, 1e-3),
	             K = logUniform(random, 1e-2, 1e4) * mass / (h * h), F = K * n / 1.5;
	const SolverBody a = body(mass, randomVector(random, 1)), b = body(logUniform(random, 0.1, 1000), Vec3::Zero());
	HeapPoint p = central(uniform(random, 0, 2) * std::sqrt(mass * K), F);
	p.armA = randomVector(random, 0.3);
	p.armB = randomVector(random, 0.3);
	p.normal = randomDirection(random);
	p.elasticShear = p.normal.cross(randomVector(random, 0.3 * F));
	p.normalStiffness = p.shearStiffness = K;
	p.energy = oneOf(random, 3) ? 0 : F * n * logUniform(random, 0.01, 100);
	p.shearEnergy = oneOf(random, 3) ? 0 : 0.1 * F * n * logUniform(random, 0.01, 100);
	p.hardening = oneOf(random, 2) ? F : 0;
	p.exponent = 1.5;
	p.overlap = n;
	p.overlapLeft = logUniform(random, 1e-7, 1e-1);
	const InverseRootMass rootA(a), rootB(b);
	PointStep step {};
	prepareSteps<double>(p, SolverBodies { a, b, rootA, rootB }, h, 1, [&](size_t) -> PointStep& { return step; });
	if (oneOf(random, 3)) step.rebound = 0.1 * std::abs(step.before[0]);
	return step;
}

Vec3 firstThree(const PointStep::Quad& q) { return { q[0], q[1], q[2] }; }

/// Impulse after a visit at the velocity u', in which the impulse p acts.
Vec3 visited(PointStep c, const Vec3& after, const Vec3& p)
{
	c.velocity = PointStep::Quad { after[0], after[1], after[2], 0 };
	c.impulse = PointStep::Quad { p[0], p[1], p[2], 0 };
	PairVector none {};
	visitPoint(c, none);
	return firstThree(c.impulse);
}

} // namespace

/// A visit leaves the impulse of its velocity as it is. Where (5) limits the tangential one, it is shorter than that of
/// visits, and returns no more than the account.
TEST(PointLaw, IsTheFixedPointOfVisits)
{
	constexpr double softness = 1e-8;
	Random random(5);
	int loaded = 0, limited = 0;
	for (int trial = 0; trial < 20000; ++trial) {
		PointStep c = randomPoint(random);
		// visited() replaces the velocity u_n0, on which the bound of an impact depends
		if (c.rebound < noRebound) continue;
		const Vec3 after = logUniform(random, 1e-4, 3) * randomDirection(random),
		           p = impulseAt(c, after, softness), next = visited(c, after, p), v = firstThree(c.before);
		const Vec2 shear = p.tail<2>();
		const double limit = c.friction * p[0], work = shear.dot((v + after).tail<2>());
		loaded += p[0] > 0;
		// The root of the hardening in a visit: hardeningTolerance
		ASSERT_NEAR(next[0], p[0], 1e-5 * (p[0] + after.norm() / c.response())) << trial;
		ASSERT_LE(shear.norm(), limit * (1 + 1e-12)) << trial;
		ASSERT_LE(work, 2 * c.shearEnergy + 1e-12 * shear.norm()) << trial;
		ASSERT_LE(p[0] * (v[0] + after[0]), 2 * c.energy + 1e-12 * p[0]) << trial;
		const bool isLimited = work > 1.99 * c.shearEnergy - 1e-6 * shear.norm() || shear.isZero(0);
		limited += isLimited;
		if (!isLimited) {
			ASSERT_LE((next - p).tail<2>().norm(), 1e-5 * (limit + after.norm() / c.response())) << trial;
		}
	}
	EXPECT_GT(loaded, 5000);
	EXPECT_LT(limited, 15000);
}

/// The normal impulse does not increase with the velocity, and does not jump: by at most 1 / (softness a) times its
/// change.
TEST(PointLaw, FallsContinuously)
{
	constexpr double softness = 1e-3;
	Random random(6);
	for (int trial = 0; trial < 5000; ++trial) {
		PointStep c = randomPoint(random);
		const double speed = std::abs(c.before[0]) + 1e-3;
		double v = -3 * speed, p = normalImpulseAt(c, v, softness);
		for (int k = 0; k < 60; ++k) {
			const double next = v + speed * logUniform(random, 1e-6, 0.3),
			             now = normalImpulseAt(c, next, softness);
			ASSERT_LE(now, p * (1 + 1e-12)) << trial;
			const double steepest
			        = std::max({ 1 / softness, 1 / reboundSoftness, c.factor[0] / (1 - c.factor[0]) })
			        / c.response();
			// Hardening adds to the linear slope while the point closes
			if (v > 0) {
				ASSERT_GE(now, p - 1.01 * steepest * (next - v) - 1e-12 * p) << trial;
			}
			v = next;
			p = now;
		}
	}
}

namespace {

/// Boards of 0.1 kg and 50 mm, one upon the other between the ground and a body of 2 t, pressed together and shaken; no
/// point has more than a part of the energy of its spring.
Heap pressedBoards(unsigned seed, int boards)
{
	constexpr double mass = 0.1, side = 0.05, force = 1e4, stiffness = 1e8;
	Random random(seed);
	Heap heap(seed, 1, 0, 0, 0);
	for (int k = 0; k < boards; ++k) {
		heap.bodies.push_back(body(mass, randomVector(random, 0.3)));
		heap.bodies.back().inverseInertia = Mat3::Identity() * 6 / (mass * side * side);
		heap.bodies.back().spin = heap.bodies.back().newSpin = randomVector(random, 3);
	}
	heap.bodies.push_back(body(2000, { 0, 0, -0.1 }));
	for (int lower = 0; lower <= boards; ++lower)
		for (int k = 0; k < 4; ++k) {
			HeapPoint p = central(2 * std::sqrt(mass * stiffness), force * uniform(random, 0.1, 1));
			p.bodyA = lower;
			p.bodyB = lower + 1;
			const Vec3 x(k % 2 ? side : -side, k / 2 ? side : -side, 0);
			p.armA = x / 2 + Vec3(0, 0, side / 4);
			p.armB = x / 2 - Vec3(0, 0, side / 4);
			p.normal = Vec3(uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1), 1).normalized();
			p.impulse = 5e-4 * p.elasticNormal * p.normal;
			p.normalStiffness = p.shearStiffness = stiffness;
			p.energy = oneOf(random, 2) ? 0 : uniform(random, 0, 1) * force * force / stiffness;
			p.shearEnergy = oneOf(random, 2) ? 0 : 0.1 * p.energy;
			heap.points.push_back(p);
		}
	return heap;
}

} // namespace

/// The impulses that Newton's method finds are those of the velocities: a visit of any point leaves its normal impulse
/// as it is to leastSoftness, friction is at most mu times it, no point returns more than it has, and momenta are kept.
TEST(Newton, SolvesLightMembersBetweenHeavyOnes)
{
	int solved = 0;
	for (unsigned seed = 0; seed < 60; ++seed) {
		Heap heap = pressedBoards(seed, 1 + int(seed % 5));
		ContactSolver solver;
		Islands islands;
		const int sweeps = solveContacts(solver, islands, heap.bodies, heap.points, 5e-4, 10000, 1e-3);
		if (sweeps != plainSweeps + newtonInterval) continue;
		++solved;
		double largest = 0;
		std::vector<Vec3> momenta; // missing ones
		for (const HeapPoint& p : heap.points)
			largest = std::max(largest, p.impulse.norm());
		for (const SolverBody& b : heap.bodies)
			momenta.push_back(
			        b.inverseMass > 0 ? Vec3((b.newVelocity - b.velocity) / b.inverseMass) : Vec3(0, 0, 0));
		for (size_t k = 0; k < heap.points.size(); ++k) {
			const HeapPoint& p = heap.points[k];
			momenta[size_t(p.bodyA)] += p.impulse;
			momenta[size_t(p.bodyB)] -= p.impulse;
			const PointStep& c = solver.stepsOf(solver.pair(k / 4))[k % 4];
			const SolverBody &a = heap.bodies[size_t(p.bodyA)], &b = heap.bodies[size_t(p.bodyB)];
			const Vec3 u = relativeVelocity<double>(
			                   p.armA, p.armB, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin),
			           after(u.dot(c.axes[0]), u.dot(c.axes[1]), u.dot(c.axes[2])),
			           now = firstThree(c.impulse);
			EXPECT_NEAR(visited(c, after, now)[0], now[0], 1e-4 * largest) << seed << " " << k;
			EXPECT_LE(now.tail<2>().norm(), c.friction * now[0] + 1e-9 * largest) << seed << " " << k;
			EXPECT_LE(now[0] * (after[0] + c.before[0]) / 2, p.energy + 1e-9 * largest) << seed << " " << k;
			EXPECT_LE(now.tail<2>().dot((after + firstThree(c.before)).tail<2>()) / 2,
			        p.shearEnergy + 1e-9 * largest)
			        << seed << " " << k;
		}
		for (size_t k = 1; k < heap.bodies.size(); ++k)
			EXPECT_LE(momenta[k].norm(), 1e-9 * largest) << seed << " body " << k;
	}
	EXPECT_GT(solved, 2);
}

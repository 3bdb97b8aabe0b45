// SPDX-License-Identifier: GPL-2.0-or-later
/// Stiff dashpots and light members between heavy ones: convergence of the sweeps, energy.
#include "heap.hpp"
#include <gtest/gtest.h>

using namespace timber;
using namespace timber::shapes;

/// h C / m = 1e4 at every point, hundreds of steps, without and with warm start.
TEST(Stiff, HeapComesToRest)
{
	for (const bool warm : { false, true })
		for (unsigned seed = 0; seed < 5; ++seed) {
			Heap heap(seed, 5, 12, 1e8, 0.5);
			double before = kineticEnergy(heap.bodies);
			const double start = before;
			for (int step = 0; step < 300; ++step) {
				for (auto& p : heap.points)
					if (!warm) p.impulse.setZero();
				heap.solve(1e-4, 4);
				for (auto& b : heap.bodies) {
					b.velocity = b.newVelocity;
					b.spin = b.newSpin;
				}
				const double now = kineticEnergy(heap.bodies);
				ASSERT_TRUE(std::isfinite(now));
				EXPECT_LE(now, (warm ? start : before) * (1 + rounding)) << seed;
				before = now;
			}
			EXPECT_LT(before, 0.9 * start) << seed;
		}
}

/// A tower of light bodies on a heavy one with the large impulses: the remaining error is small for the light ones,
/// too.
TEST(Stiff, ConvergenceIsJudgedByLightMembers)
{
	constexpr double h = 1e-4, heavy = 1e5, light = 1, gravity = 10;
	constexpr int tower = 8;
	const auto solved = [&](int sweeps, double tolerance) {
		std::vector<SolverBody> bodies { body(0, Vec3::Zero()), body(heavy, Vec3::Zero()) };
		std::vector<HeapPoint> points { central(1e7, heavy * gravity) };
		for (int k = 0; k < tower; ++k) {
			bodies.push_back(body(light, { 0, 0, k == tower - 1 ? -1. : 0. }));
			points.push_back(central(1e5));
			points.back().bodyA = k + 1;
			points.back().bodyB = k + 2;
		}
		solveContacts(bodies, points, h, sweeps, tolerance);
		return bodies;
	};
	const std::vector<SolverBody> converged = solved(10000, 0), accelerated = solved(10000, 1e-3);
	for (int k = 2; k < tower + 2; ++k)
		EXPECT_NEAR(accelerated[k].newVelocity.z(), converged[k].newVelocity.z(), 1e-3) << k; // of 1 m/s
}

/// Normal impulse of one point of a hardening contact between these bodies. [N s]
namespace {
double hardenedPoint(std::vector<SolverBody> bodies, double overlapLeft, double hardening)
{
	HeapPoint p = central(1e3, 2e4);
	p.normalStiffness = 3e7;
	p.overlap = 1e-3;
	p.exponent = 1.5;
	p.overlapLeft = overlapLeft;
	p.hardening = hardening;
	ContactSolver solver;
	solver.begin(bodies, 1e-3, 100);
	solver.prepare<double>(solver.addPair(0, 1, 1), 0, p);
	solver.solve();
	return solver.stepsOf(solver.pair(0))->impulse[0];
}
} // namespace

/// Beyond the overlap limit the force is constant, and no impulse moves two fixed bodies: the linear rule (2) is left.
TEST(Stiff, HardensOnlyWithRoomAndResponse)
{
	const SolverBody ground = body(0, Vec3::Zero()), falling = body(20, { 0, 0, -8 }),
	                 lowered = body(0, { 0, 0, -8 });
	EXPECT_GT(hardenedPoint({ ground, falling }, 0.02, 2e4), 1.01 * hardenedPoint({ ground, falling }, 0.02, 0));
	EXPECT_EQ(hardenedPoint({ ground, falling }, 0, 2e4), hardenedPoint({ ground, falling }, 0, 0));
	EXPECT_EQ(hardenedPoint({ ground, lowered }, 0.02, 2e4), hardenedPoint({ ground, lowered }, 0.02, 0));
	EXPECT_GT(hardenedPoint({ ground, lowered }, 0.02, 2e4), 0);
}

TEST(Stiff, MassRatioOfAMillion)
{
	for (const double light : { 1e-3, 1. }) {
		const double heavy = 1e6 * light, v = after(heavy, light, 1, 1e4 * light / 1e-4, 1e-4, 4);
		EXPECT_NEAR(v, 0, 1e-3); // 2 / x of the speed remains, x = 1e4
	}
	std::vector<SolverBody> bodies { body(0, Vec3::Zero()), body(1e-3, { 0, 0, -1 }), body(1e3, { 0, 0, -1 }) };
	// The heavy one falls on the light one on the ground
	std::vector<HeapPoint> points { central(1e7), central(1e7) };
	points[1].bodyA = 1;
	points[1].bodyB = 2;
	const double before = kineticEnergy(bodies);
	solveContacts(bodies, points, 1e-4, 8);
	EXPECT_LE(kineticEnergy(bodies), before * (1 + rounding));
	for (const auto& b : bodies)
		EXPECT_LE(std::abs(b.newVelocity.z()), 1.5);
}

namespace {

/// A cube of 0.1 kg and 66 mm between the ground and a body of 3.5 t that falls on it; its points press with some 1e6 N,
/// which nearly cancel.
Heap pressedCube(unsigned seed)
{
	constexpr double mass = 0.1, side = 0.066, force = 1e6, stiffness = 1.5e8;
	Random random(seed);
	Heap heap(seed, 1, 0, 0, 0);
	heap.bodies.push_back(body(mass, randomVector(random, 5)));
	heap.bodies.back().inverseInertia = Mat3::Identity() * 6 / (mass * side * side);
	heap.bodies.push_back(body(3500, { 0, 0, -4 }));
	for (const int upper : { 0, 1 })
		for (int k = 0; k < 4; ++k) {
			HeapPoint p = central(2 * std::sqrt(mass * stiffness), force * uniform(random, 0.1, 1));
			p.bodyA = upper;
			p.bodyB = upper + 1;
			const Vec3 x = side / 2 * Vec3(uniform(random, -1, 1), uniform(random, -1, 1), upper ? 1 : -1);
			p.armA = upper ? x : Vec3(x + Vec3(1, 0, 0));
			p.armB = upper ? Vec3(x - Vec3(0, 0, 1)) : x;
			p.normal = Vec3(uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3), 1).normalized();
			p.impulse = 5e-4 * p.elasticNormal * p.normal;
			p.normalStiffness = p.shearStiffness = stiffness;
			p.energy = 300;
			p.shearEnergy = 0.1 * p.energy;
			heap.points.push_back(p);
		}
	return heap;
}

/// Energy that the points of a solved heap have returned in the normal direction beyond their accounts. [J]
double excessOf(const Heap& heap)
{
	double excess = 0;
	for (const HeapPoint& p : heap.points) {
		const SolverBody &a = heap.bodies[size_t(p.bodyA)], &b = heap.bodies[size_t(p.bodyB)];
		const Vec3 before = relativeVelocity<double>(p.armA, p.armB, a.velocity, a.spin, b.velocity, b.spin),
		           after
		        = relativeVelocity<double>(p.armA, p.armB, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin);
		excess += std::max(0., p.impulse.dot(p.normal) * (before + after).dot(p.normal) / 2 - p.energy);
	}
	return excess;
}

} // namespace

/// Accelerated sweeps converge where 500 plain ones do not, and no energy is returned twice.
TEST(Accelerated, LightMembersBetweenHeavyOnes)
{
	constexpr int slowSweeps = 20;
	int slow = 0, late = 0;
	double plainExcess = 0, excess = 0, energy = 0;
	for (unsigned seed = 0; seed < 40; ++seed) {
		Heap plain = pressedCube(seed), heap = plain;
		const int sweeps = solveContacts(plain.bodies, plain.points, 5e-4, plainSweeps, 1e-3);
		if (sweeps < slowSweeps) continue;
		++slow;
		late += solveContacts(heap.bodies, heap.points, 5e-4, 5 * plainSweeps, 1e-3) >= 5 * plainSweeps;
		energy += kineticEnergy(heap.bodies);
		plainExcess += excessOf(plain);
		excess += excessOf(heap);
	}
	EXPECT_GT(slow, 20);
	EXPECT_EQ(late, 0);
	EXPECT_GT(plainExcess, 1e-4 * energy);
	EXPECT_LT(excess, returnTolerance * energy);
}

// SPDX-License-Identifier: GPL-2.0-or-later
/// Contact impulses with dashpots: closed forms of single pairs, and the limits of Coulomb and of no tension.
#include "heap.hpp"
#include <gtest/gtest.h>
#include <kernel/contact_law.hpp>

using namespace timber;
using namespace timber::shapes;

/// One step of a single dashpot multiplies the relative velocity by the (1, 2) Pade approximant of exp(-x),
/// (1 - x/3) / (1 + 2x/3 + x^2/6), x = h C / m.
TEST(SinglePair, DecaysByThePadeApproximant)
{
	for (const double x : { 1e-3, 0.1, 1., 3., 10., 100., 1e4 })
		for (const double otherMass : { 2., 1e6, 0. }) {
			const double m = otherMass > 0 ? 1 / (1 / 3. + 1 / otherMass) : 3, h = 1e-4;
			const double expected = -2 * (1 - x / 3) / (1 + 2 * x / 3 + x * x / 6);
			// X amplifies rounding once
			EXPECT_NEAR(after(otherMass, 3, 2, x * m / h, h, 1), expected, 2 * rounding * std::max(1., x))
			        << x;
			// More sweeps, same result
			EXPECT_NEAR(after(otherMass, 3, 2, x * m / h, h, 5), expected, 2 * rounding * std::max(1., x))
			        << x;
		}
}

TEST(SinglePair, SecondOrderInTheStep)
{
	const double damping = 50, time = 0.02;
	double before = 1;
	for (const int steps : { 4, 8, 16 }) {
		double v = 2;
		for (int k = 0; k < steps; ++k)
			v = -after(0, 1, v, damping, time / steps, 2);
		const double error = std::abs(v / (2 * std::exp(-damping * time)) - 1);
		EXPECT_LT(error, before / 4);
		before = error;
	}
	EXPECT_LT(before, 1e-5);
}

TEST(SinglePair, ElasticAndOtherForcesWork)
{
	const double h = 1e-3, c = 800, e = 3000, m = 1.2; // masses 2 and 3 kg
	std::vector<SolverBody> bodies { body(2, { 0, 0, 0.5 }), body(3, { 0, 0, -1 }) };
	bodies[0].newVelocity.z() = 0.4;
	bodies[1].newVelocity.z() = -1.3;
	std::vector<HeapPoint> points { central(c, e) };
	solveContacts(bodies, points, h, 1);
	const double x = h * c / m, theta = 0.5 + x / (12 + 2 * x);
	const double impulse = (h * e - h * c * ((1 - theta) * -1.5 + theta * -1.7)) / (1 + theta * x);
	EXPECT_NEAR(points[0].impulse.z(), impulse, 10 * rounding); // impulses of some N s
	EXPECT_NEAR(bodies[0].newVelocity.z(), 0.4 - impulse / 2, 10 * rounding);
	EXPECT_NEAR(bodies[1].newVelocity.z(), -1.3 + impulse / 3, 10 * rounding);
}

/// Eqs. 17, 18, 23, 24 with the velocity before the step.
TEST(SinglePair, NoSweepsIsTheExplicitDashpot)
{
	const double h = 1e-5, cn = 700, cs = 300;
	std::vector<SolverBody> bodies { body(2, { 0.1, 0, 0.5 }), body(3, { 0, 0.2, -1 }) };
	HeapPoint p = central(cn, 900);
	p.shearDamping = cs;
	p.elasticShear = { 40, -10, 0 };
	p.friction = 0.9;
	p.impulse = { 1, 2, 3 }; // the warm start is ignored
	std::vector<HeapPoint> points { p };
	solveContacts(bodies, points, h, 0);
	const Vec3 force(40 - cs * -0.1, -10 - cs * 0.2, 900 + cn * 1.5);
	EXPECT_LT((points[0].impulse - h * force).norm(), rounding * h * force.norm());
	EXPECT_LT((bodies[0].newVelocity - Vec3(0.1, 0, 0.5) + h * force / 2).norm(), rounding);
	EXPECT_LT((bodies[1].newVelocity - Vec3(0, 0.2, -1) - h * force / 3).norm(), rounding);
}

namespace {

/// A mass loaded against the ground on `points` equal springs: its velocity, and its displacement from equilibrium.
struct LoadedMass {
	double mass = 4, load, friction, stiffness, damping, h;
	size_t points = 1;
	Vec3 velocity = Vec3::Zero(), displacement = Vec3::Zero(), shear = Vec3::Zero();

	/// One step: elastic forces, load, contact.
	void step(int sweeps)
	{
		std::vector<SolverBody> bodies { body(0, Vec3::Zero()), body(mass, velocity) };
		bodies[1].inverseInertia.setZero();
		bodies[1].newVelocity.z() -= h * load / mass;
		HeapPoint p = central(damping, std::max(0., load / double(points) - stiffness * displacement.z()));
		p.elasticShear = shear;
		p.friction = friction;
		p.normalStiffness = p.shearStiffness = stiffness;
		std::vector<HeapPoint> heap(points, p);
		solveContacts(bodies, heap, h, sweeps);
		velocity = bodies[1].newVelocity;
		displacement += h * velocity;
		shear = clipped(shear, friction * (heap[0].impulse.z() / h));
		shear -= h * stiffness * Vec3(velocity.x(), velocity.y(), 0);
	}
};

} // namespace

/// Newmark's method preserves the amplitude of an oscillation and advances its phase in a step by acos(1 - y / (2 + 2
/// beta y)), however stiff the spring;
/// explicit springs are unstable beyond omega h = 2.
TEST(SinglePair, SpringsSetNoLimitToTheStep)
{
	for (const double turn : { 0.1, 1., 2., 10., 300. }) {
		LoadedMass m { 4, 1e5, 0, 4e6, 0, turn / 1e3 }; // omega = 1000 /s
		const double y = turn * turn, phase = std::acos(1 - y / (2 + 2 * y * y / (4 * y + 2))), start = 1e-3;
		m.displacement.z() = start;
		// Half a step earlier, on the orbit of start cos(phase k)
		m.velocity.z() = start * (1 - std::cos(phase)) / m.h;
		for (int k = 1; k <= 200; ++k) {
			m.step(1);
			EXPECT_NEAR(m.displacement.z(), start * std::cos(phase * k), 1e-7 * start * std::max(1., turn))
			        << turn << " " << k; // rounding of the load adds up
		}
	}
}

/// beta of a point follows from its own stiffness only. Eight points on one member preserve the amplitude at any step,
/// sixteen do not: n are stable while n y / (8 y + 4) <= 1, y that of one.
TEST(SinglePair, EightSpringsOnAMemberSetNoLimitEither)
{
	const double start = 1e-3;
	for (const double turn : { 0.3, 1., 3. }) // at 10 the phase of eight is within 0.01 of pi, and rounding shows
		for (const size_t points : { 8, 16 }) {
			LoadedMass m { 4, 2e5, 0, 4e6, 0, turn / 1e3 };
			m.points = points;
			m.displacement.z() = start;
			const double y = turn * turn, rate = double(points) * y;
			// On the orbit of start cos(phase k), as above
			m.velocity.z() = start * rate / (2 + 2 * rate * y / (4 * y + 2)) / m.h;
			double largest = 0;
			for (int k = 0; k < 200 && largest < 0.1; ++k) {
				m.step(2000); // coupled points: linear convergence of the sweeps
				largest = std::max(largest, std::abs(m.displacement.z()));
			}
			if (rate <= 8 * y + 4) EXPECT_LT(largest, 1.001 * start) << turn << " " << points;
			else EXPECT_GT(largest, 10 * start) << turn << " " << points;
		}
}

/// A light member under a heavy load begins to slip, on springs too stiff for the step: omega h is 1 and 4.5. With the
/// explicit rule of sliding it would chatter between the limits with h mu N / m: 5 m/s at 4e-4 s.
TEST(Limits, FrictionOfALoadedLightMemberDissipates)
{
	const double stiffness = 5e8, limit = 5e4;
	for (const double h : { 1e-4, 4e-4 }) {
		LoadedMass m { 4, 2 * limit, 0.5, stiffness, 2 * std::sqrt(4 * stiffness), h };
		m.velocity.x() = 0.1;
		m.shear.x() = -limit;
		double largest = 0;
		for (int k = 0; k < 200; ++k) {
			m.step(5);
			largest = std::max(largest, std::abs(m.velocity.x()));
		}
		// The spring accelerates it to 1.1 m/s when it slips
		EXPECT_LE(largest, 0.1 + limit / std::sqrt(4 * stiffness)) << h;
		EXPECT_LT(m.velocity.norm(), 1e-6) << h;
	}
}

TEST(SinglePair, LeverArms)
{
	std::vector<SolverBody> bodies { body(0, Vec3::Zero()), body(3, { 0, 0, -2 }) };
	HeapPoint p = central(500);
	p.armB = { 0.4, 0, 0 };
	p.friction = 0;
	std::vector<HeapPoint> points { p };
	const double h = 1e-3, m = 1 / (1 / 3. + 0.16 / 0.3), x = h * 500 / m; // effective mass of the point
	solveContacts(bodies, points, h, 1);
	const double speed = bodies[1].newVelocity.z() - 0.4 * bodies[1].newSpin.y();
	EXPECT_NEAR(speed, -2 * (1 - x / 3) / (1 + 2 * x / 3 + x * x / 6), 10 * rounding);
	EXPECT_NEAR(bodies[1].newSpin.y(), -0.4 * points[0].impulse.z() / 0.3, 10 * rounding);
}

TEST(Limits, NoTension)
{
	for (const int sweeps : { 0, 1, 4 }) {
		std::vector<SolverBody> bodies { body(1, Vec3::Zero()), body(1, { 0, 0, 5 }) };
		std::vector<HeapPoint> points { central(1e4, 10) };
		solveContacts(bodies, points, 1e-4, sweeps);
		EXPECT_EQ(points[0].impulse, Vec3::Zero());
		EXPECT_EQ(bodies[1].newVelocity, Vec3(0, 0, 5));
	}
}

/// A point that continues to slide has mu times the normal force against the slip, whatever its dashpot; with explicit
/// dashpots whatever its velocity.
TEST(Limits, SlidingHasTheForceOfFriction)
{
	for (const int sweeps : { 0, 1, 4 }) {
		std::vector<SolverBody> bodies { body(1, Vec3::Zero()), body(1, { -0.3, sweeps == 0 ? 0.4 : 0, 0 }) };
		HeapPoint p = central(20, 100);
		p.elasticShear = { 80, 0, 0 };
		std::vector<HeapPoint> points { p };
		solveContacts(bodies, points, 1e-4, sweeps);
		const double normal = points[0].impulse.z();
		EXPECT_NEAR(normal, 1e-2, 1e-4); // the normal dashpot reacts to the spring force: x / 2 = 0.2 %
		EXPECT_LT((points[0].impulse - normal * Vec3(0.5, 0, 1)).norm(), rounding);
	}
}

TEST(Limits, SpringAndDashpotTogetherRespectCoulomb)
{
	for (const int sweeps : { 0, 1, 4 }) {
		std::vector<SolverBody> bodies { body(1, Vec3::Zero()), body(1, { -3, 4, 0 }) };
		HeapPoint p = central(200, 100);
		p.elasticShear = { 10, 0, 0 };
		std::vector<HeapPoint> points { p };
		solveContacts(bodies, points, 1e-4, sweeps);
		EXPECT_NEAR(points[0].impulse.head<2>().norm(), 0.5 * points[0].impulse.z(), rounding);
		EXPECT_GT(points[0].impulse.x(), 0); // against the slide
		EXPECT_LT(points[0].impulse.y(), 0);
	}
	EXPECT_EQ(clipped(Vec3 { 3, 4, 0 }, 0.5 * 20), Vec3(3, 4, 0));
	EXPECT_LT((clipped(Vec3 { 3, 4, 0 }, 0.5 * 5) - Vec3(1.5, 2, 0)).norm(), rounding);
	EXPECT_EQ(clipped(Vec3 { 3, 4, 0 }, 0.5 * 0), Vec3::Zero());
}

TEST(Limits, AreRespectedInHeaps)
{
	for (unsigned seed = 0; seed < 50; ++seed)
		for (const int sweeps : { 0, 1, 2, 5 }) {
			Heap heap(seed, 6, 15, 1e3, 0.4, 2000);
			heap.solve(1e-4, sweeps);
			for (const auto& p : heap.points) {
				const double normal = p.impulse.dot(p.normal),
				             shear = (p.impulse - normal * p.normal).norm();
				EXPECT_GE(normal, -rounding); // rounding of the projection
				EXPECT_LE(shear, 0.4 * normal + rounding);
			}
		}
}

TEST(ZeroDamping, GivesTheElasticImpulses)
{
	for (const int sweeps : { 0, 1, 3 }) {
		Heap heap(1, 5, 12, 0, 1, 1000);
		for (auto& p : heap.points)
			if (sweeps > 0) p.impulse = Vec3(1, 2, 3) * 1e-2; // any warm start
		const Heap start = heap;
		heap.solve(1e-4, sweeps);
		for (size_t k = 0; k < heap.points.size(); ++k) {
			const HeapPoint& p = start.points[k];
			const Vec3 elastic = 1e-4 * (p.elasticNormal * p.normal + p.elasticShear);
			EXPECT_LT((heap.points[k].impulse - elastic).norm(), rounding); // impulses of 0.1 N s
		}
	}
}

// SPDX-License-Identifier: GPL-2.0-or-later
/// The rule of one visit: its monotony, on which the convergence of the sweeps rests (contact_solver.hpp), and its
/// limits.
#include "shapes.hpp"
#include <gtest/gtest.h>
#include <kernel/contact_step.hpp>
#include <kernel/contact_visit.hpp>

using namespace timber;
using namespace timber::shapes;

namespace {

/// A point of any law, light and heavy, loaded and loose, hardening, in an impact or not. The response is that of a
/// point alone.
PointStep randomPoint(Random& random)
{
	PointStep c {};
	const double a = 1 / logUniform(random, 1e-3, 1e4), h = logUniform(random, 1e-6, 1e-3),
	             n = logUniform(random, 1e-9, 1e-2);
	c.exponent = oneOf(random, 3) ? 1 : oneOf(random, 2) ? 1.5 : 2;
	const double K = logUniform(random, 1e-4, 1e6) / (a * h * h), F = K * n / c.exponent,
	             C = uniform(random, 0, 2) * std::sqrt(K / a);
	const double x = a * h * C, theta = 0.5 + x / (12 + 2 * x), y = a * h * h * K, beta = y / (4 * y + 2);
	const double D = theta * h * C + beta * h * h * K, Q = beta * h * h * K - (1 - theta) * h * C,
	             speed = logUniform(random, 1e-6, 30);
	c.column = PointStep::Quad { a, 0, 0, 0 };
	c.before[0] = uniform(random, -1, 1) * speed;
	c.velocity[0] = c.before[0] + uniform(random, -1, 1) * speed;
	c.mass[0] = D / (1 + a * D);
	c.factor[0] = a * c.mass[0];
	c.bias[0] = (h * F + Q * c.before[0]) / (1 + a * D);
	c.friction = uniform(random, 0, 1);
	c.energy = oneOf(random, 3) ? 0
	        : oneOf(random, 3)  ? std::numeric_limits<double>::infinity()
	                            : logUniform(random, 1e-6, 10) * F * n;
	c.rebound = oneOf(random, 2) ? noRebound : uniform(random, 0, 1) * std::abs(c.before[0]);
	c.hardening = c.exponent > 1 ? F : 0;
	c.overlap = n;
	c.overlapLeft = logUniform(random, 1e-9, 1e-1);
	c.damping = C;
	c.step = h;
	return c;
}

/// Normal impulse for the velocity b without the point's impulse, after a visit from the impulse p0.
double impulseAt(PointStep c, double base, double p0)
{
	c.impulse = PointStep::Quad { p0, 0, 0, 0 };
	const double un = base + c.response() * p0;
	return normalImpulse(c, un, c.factor[0] * p0 + c.bias[0] - c.mass[0] * un);
}

} // namespace

/// Never rises with b, and falls by at most the change of b over a: without jumps. Newton's method of the hardening
/// ends within hardeningTolerance of its root.
TEST(Visit, ImpulseFallsContinuouslyWithTheVelocity)
{
	Random random(3);
	for (int trial = 0; trial < 20000; ++trial) {
		const PointStep c = randomPoint(random);
		const double a = c.response(), scale = std::abs(c.before[0]) + std::abs(c.velocity[0]) + a * c.bias[0];
		double base = -3 * scale, p = impulseAt(c, base, 0);
		for (int k = 0; k < 40; ++k) {
			const double next = base
			        + scale * (oneOf(random, 2) ? uniform(random, 0, 0.3) : logUniform(random, 1e-9, 1e-2));
			const double now = impulseAt(c, next, 0), error = 1e-5 * (p + std::abs(base) / a);
			ASSERT_LE(now, p + error) << trial << " power " << c.exponent;
			ASSERT_GE(now, p - (next - base) / a - error) << trial << " power " << c.exponent;
			base = next;
			p = now;
		}
	}
}

/// The force of the law at the end of the step minus its linear extrapolation, for a law that is no power: F = k n (1 +
/// n/d).
TEST(Visit, HardensAsTheLaw)
{
	const double k = 1e6, depth = 0.01;
	const auto force = [&](double n) { return k * n * (1 + n / depth); };
	for (const double n : { 1e-5, 1e-3, 0.02 })
		for (const double d : { 1e-6, 1e-3, 0.1 }) {
			PointStep c {};
			const double stiffness = k * (1 + 2 * n / depth);
			c.exponent = 2;
			c.overlap = n;
			// As contact_pair.cpp takes it from force and stiffness
			c.hardening = (stiffness * n - force(n)) / (c.exponent - 1);
			const Hardening spring(c, d, 0);
			EXPECT_NEAR(spring.force, force(n + d) - force(n) - stiffness * d, 1e-9 * force(n + d));
			EXPECT_NEAR(spring.slope, k * (1 + 2 * (n + d) / depth) - stiffness,
			        1e-9 * stiffness * (1 + d / n));
		}
}

/// What a visit gives depends on the velocity without the impulse, not on the impulse before: a second visit changes
/// nothing.
TEST(Visit, IsExactInOneCoordinate)
{
	Random random(4);
	for (int trial = 0; trial < 20000; ++trial) {
		const PointStep c = randomPoint(random);
		const double a = c.response(), base = uniform(random, -2, 2) * std::abs(c.before[0]),
		             p = impulseAt(c, base, 0);
		EXPECT_NEAR(impulseAt(c, base, p), p, 1e-5 * (p + std::abs(base) / a)) << trial;
	}
}

TEST(Visit, RespectsItsLimits)
{
	Random random(5);
	for (int trial = 0; trial < 20000; ++trial) {
		const PointStep c = randomPoint(random);
		const double a = c.response(), base = uniform(random, -2, 2) * std::abs(c.before[0]),
		             p = impulseAt(c, base, 0), after = base + a * p;
		EXPECT_GE(p, 0);
		if (c.energy < 1e300) { // (5)
			EXPECT_LE(p * (c.before[0] + after) / 2, c.energy * (1 + 1e-9) + 1e-9 * p * std::abs(base))
			        << trial;
		}
		const double bound = c.rebound + reboundSoftness * std::max(0., c.rebound - c.velocity[0] - a * p);
		if (p > 0 && c.rebound < noRebound) { // (6)
			EXPECT_LE(after, bound + 1e-9 * (std::abs(base) + bound)) << trial;
			PointStep unbounded = c;
			unbounded.rebound = noRebound;
			if (p < impulseAt(unbounded, base, 0)) { // it bounds the separation only
				EXPECT_GE(after, -1e-12 * std::abs(base)) << trial;
			}
		}
	}
}

/// (5) and the cone of friction for tangential impulses of points whose directions are coupled.
TEST(Visit, TangentialImpulseReturnsAtMostItsAccount)
{
	Random random(6);
	for (int trial = 0; trial < 20000; ++trial) {
		PointStep c = randomPoint(random);
		const double a = logUniform(random, 1e-3, 1e3), b = logUniform(random, 1e-3, 1e3),
		             coupling = uniform(random, -0.99, 0.99) * std::sqrt(a * b);
		c.shearResponse = PointStep::Quad { a, coupling, b, 0 };
		c.before = PointStep::Quad { 0, uniform(random, -1, 1), uniform(random, -1, 1), 0 };
		c.shearEnergy = oneOf(random, 3) ? 0 : logUniform(random, 1e-6, 1);
		const PointStep::Quad old { 1, uniform(random, -1, 1), uniform(random, -1, 1), 0 },
		        u { 0, uniform(random, -1, 1), uniform(random, -1, 1), 0 };
		PointStep::Quad p { uniform(random, 0, 1), uniform(random, -1, 1), uniform(random, -1, 1), 0 };
		const double normal = p[0];
		p = limitedShear(c, p, normal, old, u);
		const double x = p[1] - old[1], y = p[2] - old[2], after1 = u[1] + a * x + coupling * y,
		             after2 = u[2] + coupling * x + b * y;
		const double size = std::hypot(p[1], p[2]);
		EXPECT_LE(size, c.friction * normal * (1 + 1e-12)) << trial;
		EXPECT_LE((p[1] * (c.before[1] + after1) + p[2] * (c.before[2] + after2)) / 2,
		        c.shearEnergy + 1e-9 * size * (1 + a + b))
		        << trial;
	}
}

/// Of the tangential impulses that return at most the account, the result is the closest: no point of a fine grid on
/// the boundary of the admissible set is closer.
TEST(Visit, TangentialImpulseIsTheClosestAdmissibleOne)
{
	Random random(8);
	for (int trial = 0; trial < 300; ++trial) {
		const double att = logUniform(random, 0.1, 10), auu = logUniform(random, 0.1, 10),
		             atu = uniform(random, -0.9, 0.9) * std::sqrt(att * auu);
		ShearAccount limits { Vec2(uniform(random, -1, 1), uniform(random, -1, 1)), Mat2(),
			oneOf(random, 2) ? 0 : logUniform(random, 1e-4, 0.1) };
		limits.response << att, atu, atu, auu;
		const Vec2 wanted(uniform(random, -2, 2), uniform(random, -2, 2));
		if (limits.excess(wanted) <= 0) continue;
		const Vec2 p = limits.closestTo(wanted);
		EXPECT_LE(limits.excess(p), 1e-12) << trial; // rounding of products of order 10
		for (int k = 0; k < 3600; ++k) {
			const double angle = 2 * M_PI * k / 3600;
			const Vec2 onBoundary = limits.shortened(100 * Vec2(std::cos(angle), std::sin(angle)));
			// The excess that Newton's method leaves: projectionTolerance, ten times for the slope
			EXPECT_GE((onBoundary - wanted).norm(), (p - wanted).norm() * (1 - 1e-5)) << trial;
		}
	}
}

/// No impulse moves two fixed bodies: (5) does not limit it.
TEST(Visit, TangentialImpulseOfFixedBodies)
{
	PointStep c {};
	c.friction = 0.5;
	c.before = PointStep::Quad { 0, 1, 0, 0 };
	const PointStep::Quad p = limitedShear(c, PointStep::Quad { 10, 2, 1, 0 }, 10, PointStep::Quad {}, c.before);
	EXPECT_EQ(p[1], 2);
	EXPECT_EQ(p[2], 1);
}

/// Visits of one point end at an impulse, also where the tangents have different responses and the account is empty.
/// With the impulse shortened in its own direction some alternate between two values.
TEST(Visit, RepeatedVisitsEnd)
{
	Random random(7);
	for (int trial = 0; trial < 2000; ++trial) {
		PointStep c {};
		const double hC = logUniform(random, 1e-2, 1e2), mass = hC / (1 + hC), angle = uniform(random, 0, M_PI),
		             least = logUniform(random, 0.03, 1), co = std::cos(angle), si = std::sin(angle);
		c.rows[0].part[0] = PointStep::Quad { 1, 0, 0, 0 };
		c.rows[1].part[0] = PointStep::Quad { 0, co, -least * si, 0 };
		c.rows[2].part[0] = PointStep::Quad { 0, si, least * co, 0 };
		c.column = PointStep::Quad { 1, 0, 0, 0 };
		c.shearResponse = PointStep::Quad { co * co + least * least * si * si, co * si * (1 - least * least),
			si * si + least * least * co * co, 0 }; // the largest response is 1
		c.before = PointStep::Quad { 0, uniform(random, -1, 1), uniform(random, -1, 1), 0 };
		c.velocity = PointStep::Quad { -1, uniform(random, -1, 1), uniform(random, -1, 1), 0 };
		c.mass = c.factor = PointStep::Quad { 0.5, mass, mass, 0 };
		c.bias = PointStep::Quad { 1, 0, 0, 0 };
		c.rebound = noRebound;
		c.energy = StepInput<double>::unlimitedEnergy;
		c.friction = 0.5;
		PairVector velocity {};
		int visits = 0;
		while (visits < 20000 && visitPoint(c, velocity) > 1e-18) // of impulses of order 1
			++visits;
		EXPECT_LT(visits, 20000) << trial;
	}
}

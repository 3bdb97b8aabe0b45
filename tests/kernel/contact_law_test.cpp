// SPDX-License-Identifier: GPL-2.0-or-later
/// Elastic contact laws against numbers worked out by hand, finite differences and the balance of energy.
#include "shapes.hpp"
#include <gtest/gtest.h>
#include <kernel/contact_law.hpp>

using namespace timber;
using namespace timber::shapes;

namespace {

constexpr double rounding = 1e-14; ///< a few products and a root, relative
const HertzLaw timberLaw { 5.25e9, 0.05 };
const double dt = 1e-5;

/// One contact point with prescribed motion.
template <class Law> struct Spring {
	Law law;
	PairProperties pair;
	NormalForm form = NormalForm::Closed;
	PointRecord state {};

	/// overlap at the end of the step [m], tangential displacement of B against A in it [m]; the normal is z.
	void step(double overlap, double approach, const Vec3& slide, const Vec3& spin = Vec3::Zero(),
	        const Vec3& normal = Vec3::UnitZ())
	{
		const ContactPoint point { {}, {}, Vec3::Zero(), normal, overlap };
		elasticStep<Law, ContactPoint, double>(
		        law, pair, point, { (slide - approach * normal) / dt, spin }, dt, form, state);
	}
	double shearEnergy() const
	{
		return timber::shearEnergy<double>(state.shearForce, pair.shearRatio * state.stiffness);
	}
};

PairProperties pairOf(double shearRatio, double limit = 1) { return { 1, 0.5, shearRatio, limit }; }

} // namespace

/// Timber of the paper: E = 90e3 kgf/cm2 = 8.825985 GPa, nu = 0.4; E* = E / (2 (1 - 0.16)) = 5.253562 GPa.
TEST(PairConstants, WorkedByHand)
{
	const double young = 8.825985e9;
	EXPECT_NEAR(equivalentModulus(young, 0.4, young, 0.4), young / 1.68, rounding * young);
	EXPECT_NEAR(equivalentModulus(2e9, 0, 6e9, 0.5), 1 / (1 / 2e9 + 0.75 / 6e9), 1e-4); // 1.6e9 with 16 digits
	EXPECT_DOUBLE_EQ(reduced(2, 3), 1.2);
	EXPECT_DOUBLE_EQ(reduced(4, std::numeric_limits<double>::infinity()), 4);
	EXPECT_NEAR(equivalentRadius(4. / 3 * M_PI * 0.027), 0.3, rounding);
	const double column = 0.105 * 0.105 * 2.73; // 0.03009825 m3
	EXPECT_NEAR(equivalentRadius(column), 0.1929675, 1e-7); // seven digits by hand
}

/// n = 1 mm, E* = 5.25e9 Pa, r = 5 cm: F = 4/3 * 5.25e9 * sqrt(5e-11) = 49497.47 N, K = 1.5 F / n, E = 0.4 F n.
TEST(Hertz, WorkedByHand)
{
	EXPECT_NEAR(timberLaw.force(1e-3), 49497.4747, 1e-4); // nine digits by hand
	EXPECT_NEAR(timberLaw.stiffness(1e-3), 74246212.0, 1);
	EXPECT_NEAR(timberLaw.energy(1e-3), 19.7989899, 1e-7);
	EXPECT_EQ(timberLaw.force(0), 0);
	EXPECT_EQ(timberLaw.stiffness(0), 0);
	EXPECT_NEAR(timberLaw.force(4e-3) / timberLaw.force(1e-3), 8, 8 * rounding); // n^1.5
}

TEST(Hertz, DerivativesOfEnergyAndForce)
{
	for (const double n : { 1e-6, 1e-4, 1e-2 }) {
		const double h = 1e-4 * n; // central differences: truncation h^2 / n^2 = 1e-8, cancellation 1e-12
		EXPECT_NEAR((timberLaw.energy(n + h) - timberLaw.energy(n - h)) / (2 * h), timberLaw.force(n),
		        1e-7 * timberLaw.force(n));
		EXPECT_NEAR((timberLaw.force(n + h) - timberLaw.force(n - h)) / (2 * h), timberLaw.stiffness(n),
		        1e-7 * timberLaw.stiffness(n));
	}
}

TEST(Snow, IsLinear)
{
	const LinearLaw snow { 3.948e4 * 12 };
	EXPECT_DOUBLE_EQ(snow.force(2e-3), 947.52);
	EXPECT_DOUBLE_EQ(snow.stiffness(2e-3), 473760);
	EXPECT_DOUBLE_EQ(snow.energy(2e-3), 0.94752);
}

/// Eq. 38 summed: the error against Eq. 37 falls with the number of increments (first order).
TEST(IncrementForm, ConvergesToTheClosedForm)
{
	double before = 1;
	for (const int steps : { 10, 20, 40, 80, 160 }) {
		Spring<HertzLaw> spring { timberLaw, pairOf(0.4), NormalForm::Increment };
		for (int k = 1; k <= steps; ++k)
			spring.step(1e-3 * k / steps, 1e-3 / steps, Vec3::Zero());
		const double error = std::abs(spring.state.normalForce / 49497.4747 - 1);
		EXPECT_NEAR(error, 0.75 / steps, 0.1 / steps); // integral of the rule's first-order error
		EXPECT_LT(error, 0.6 * before);
		before = error;
	}
}

TEST(IncrementForm, NeverPulls)
{
	Spring<HertzLaw> spring { timberLaw, pairOf(0.4), NormalForm::Increment };
	for (const double n : { 1e-3, 5e-4, 1e-6, 1e-7 }) {
		spring.step(n, 0, Vec3::Zero());
		EXPECT_GE(spring.state.normalForce, 0);
	}
}

TEST(NormalSpring, ForceStaysConstantBeyondTheLimit)
{
	Spring<HertzLaw> spring { timberLaw, pairOf(0.4, 2e-3) };
	double energy = 0;
	for (const double n : { 1e-3, 2e-3, 3e-3, 8e-3 }) {
		spring.step(n, 0, Vec3::Zero());
		EXPECT_NEAR(spring.state.normalForce, timberLaw.force(std::min(n, 2e-3)), 1e-9); // same formula
		EXPECT_GT(spring.state.energy, energy); // beyond the limit it grows linearly
		energy = spring.state.energy;
	}
	EXPECT_NEAR(energy, timberLaw.energy(2e-3) + 6e-3 * timberLaw.force(2e-3), rounding * energy);
}

TEST(ShearSpring, OpposesTheSlide)
{
	Spring<LinearLaw> spring { { 1e6 }, pairOf(0.4) };
	spring.step(1e-3, 1e-3, { 1e-5, 0, 0 });
	EXPECT_LT((spring.state.shearForce - Vec3(-0.4 * 1e6 * 1e-5, 0, 0)).norm(), 1e-12); // rounding of 4 N
	EXPECT_NEAR(spring.shearEnergy(), 0.5 * 4e5 * 1e-10, 1e-18);
	spring.step(1e-3, 0, { 0, 2e-5, 0 });
	EXPECT_LT((spring.state.shearForce - Vec3(-4, -8, 0)).norm(), 1e-12);
}

/// The normal part of a displacement does not stretch the tangential spring, whatever the normal.
TEST(ShearSpring, IgnoresApproach)
{
	Random random(41);
	for (int trial = 0; trial < 100; ++trial) {
		Spring<HertzLaw> spring { timberLaw, pairOf(0.4) };
		spring.step(1e-3, 1e-3, Vec3::Zero(), Vec3::Zero(), randomDirection(random));
		// Cancellation of the approach speed
		EXPECT_LT(spring.state.shearForce.norm(), 1e-12 * timberLaw.force(1e-3));
	}
}

TEST(RotatedShear, PreservesTheMagnitudeAndFollowsTheNormal)
{
	Random random(42);
	for (int trial = 0; trial < 1000; ++trial) {
		const Vec3 n = randomDirection(random), next = (n + 0.3 * randomVector(random, 1)).normalized();
		const Vec3 shear = 100 * n.unitOrthogonal();
		const Vec3 result = rotatedShear<double>(shear, 0.01 * randomVector(random, 1), next);
		EXPECT_NEAR(result.norm(), 100, 1e-11); // rescaled to the length: rounding of 100 N
		EXPECT_NEAR(result.dot(next), 0, 1e-10);
	}
	EXPECT_EQ(rotatedShear<double>(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ()), Vec3::Zero());
	// No component in the plane
	EXPECT_EQ(rotatedShear<double>(Vec3(0, 0, 5), Vec3::Zero(), Vec3::UnitZ()), Vec3::Zero());
}

/// A quarter of a revolution about the normal, and about an axis in the plane, in small steps.
TEST(RotatedShear, FollowsAFiniteRotation)
{
	const int steps = 10000;
	for (const Vec3& axis : { Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, 2, 2).normalized() }) {
		Vec3 shear(7, 3, 0);
		const Quat small = about(axis, M_PI / 2 / steps);
		Vec3 normal = Vec3::UnitZ();
		for (int k = 0; k < steps; ++k) {
			normal = small * normal;
			shear = rotatedShear<double>(shear, axis * (M_PI / 2 / steps), normal);
		}
		// First order in the step: 10 (pi/2)^2 / steps
		EXPECT_LT((shear - about(axis, M_PI / 2) * Vec3(7, 3, 0)).norm(), 1e-3);
	}
}

/// The stored energy grows by at most the work done on the spring, in every step of a random path with rotation.
template <class Law> void expectNoEnergyFromNothing(const Law& law, unsigned seed)
{
	Random random(seed);
	Spring<Law> spring { law, pairOf(1 / 2.8) };
	double stored = 0, n = 1e-3;
	for (int step = 0; step < 2000; ++step) {
		n = std::max(1e-7, n + uniform(random, -1, 1) * (step % 7 ? 1e-4 : 1e-3));
		const Vec3 slide(uniform(random, -1e-4, 1e-4), uniform(random, -1e-4, 1e-4), 0);
		spring.step(n, 0, slide, Vec3(0, 0, uniform(random, -1, 1)) / dt);
		const double work = -(spring.state.shearForce.dot(slide)
		        + 0.5 * spring.pair.shearRatio * spring.state.stiffness * slide.squaredNorm());
		const double now = spring.shearEnergy();
		EXPECT_LE(now, stored + work + 1e-12 * (now + stored + std::abs(work))); // rounding of the terms
		stored = now;
	}
}

TEST(ShearSpring, NeverGainsEnergyOnRandomPaths)
{
	for (unsigned seed = 0; seed < 10; ++seed) {
		expectNoEnergyFromNothing(timberLaw, seed);
		expectNoEnergyFromNothing(LinearLaw { 1e6 }, seed);
	}
}

/// The work on normal and tangential spring over closed cycles of (n, s), by trapezoids with the force before and after
/// the slide; a cycle with negative work would create energy.
TEST(ShearSpring, ClosedCyclesDissipate)
{
	Random random(43);
	for (int trial = 0; trial < 200; ++trial) {
		Spring<HertzLaw> spring { timberLaw, pairOf(1 / 2.8) };
		spring.step(1e-3, 1e-3, Vec3::Zero());
		const double a = uniform(random, 0, 9e-4), p = uniform(random, 0, 2 * M_PI),
		             q = uniform(random, 0, 2 * M_PI), amplitude = uniform(random, 0, 1e-3);
		const auto overlap = [&](double t) { return 1e-3 + a * (std::sin(t + p) - std::sin(p)); };
		const auto place = [&](double t) {
			return Vec3(amplitude * (std::sin(2 * t + q) - std::sin(q)), amplitude * (std::cos(t) - 1), 0);
		};
		double work = 0, largest = 0;
		const int steps = 400;
		for (int k = 1; k <= steps; ++k) {
			const double t = 2 * M_PI * k / steps, last = 2 * M_PI * (k - 1) / steps;
			const Vec3 slide = place(t) - place(last);
			spring.step(std::max(1e-7, overlap(t)), 0, slide);
			work -= spring.state.shearForce.dot(slide)
			        + 0.5 * spring.pair.shearRatio * spring.state.stiffness * slide.squaredNorm();
			largest = std::max(largest, std::abs(work));
		}
		EXPECT_GE(work, spring.shearEnergy() - 1e-12 * largest) << trial; // rounding of the sum
	}
}

/// While n shrinks, the force decreases in proportion to the stiffness.
TEST(ShearSpring, LosesForceWithItsStiffness)
{
	Spring<HertzLaw> spring { timberLaw, pairOf(0.4) };
	spring.step(1e-3, 1e-3, { 1e-5, 0, 0 });
	const Vec3 full = spring.state.shearForce;
	spring.step(4e-3, 0, Vec3::Zero());
	// Rounding: the force stays while n grows
	EXPECT_LT((spring.state.shearForce - full).norm(), 1e-12 * full.norm());
	spring.step(1e-3, 0, Vec3::Zero());
	// Stiffness goes with sqrt(n): half
	EXPECT_LT((spring.state.shearForce - full / 2).norm(), 1e-12 * full.norm());
}

TEST(NewPoint, OverlapIsExplainedByApproachOrEnergy)
{
	EXPECT_EQ(initialOverlap(timberLaw, 5e-3, 0, 0), 0); // no approach: no force
	EXPECT_EQ(initialOverlap(timberLaw, 5e-3, 1e-3, 0), 1e-3);
	EXPECT_EQ(initialOverlap(timberLaw, 1e-3, 1, 0), 1e-3); // at most the overlap
	EXPECT_NEAR(initialOverlap(timberLaw, 5e-3, 0, timberLaw.energy(2e-3)), 2e-3, 1e-15); // rounding of pow
	EXPECT_NEAR(initialOverlap(LinearLaw { 1e6 }, 5e-3, 0, 2.), 2e-3, 1e-15); // sqrt(2 E / K)
	EXPECT_EQ(initialOverlap(timberLaw, 5e-3, 0, -1e-20), 0); // rounding of the available energy
}

/// A fast light member cannot compress the contact beyond its kinetic energy within a step.
TEST(NewPoint, ApproachIsBoundedByItsEnergy)
{
	constexpr double mass = 2.5, h = 4e-4, rounding = 1e-12;
	for (const double speed : { 0., 0.1, 1., 10., 60. }) {
		const double overlap = approachOverlap(timberLaw, mass, speed, h), energy = mass / 2 * speed * speed;
		EXPECT_LE(overlap, speed * h);
		EXPECT_LE(timberLaw.energy(overlap), energy * (1 + rounding));
		EXPECT_TRUE(overlap == speed * h || timberLaw.energy(overlap) > energy * (1 - rounding)) << speed;
	}
	EXPECT_EQ(approachOverlap(timberLaw, 1e6, 1., h), h); // a heavy one is not stopped
	EXPECT_EQ(approachOverlap(timberLaw, std::numeric_limits<double>::infinity(), 0., h), 0);
	EXPECT_NEAR(approachOverlap(LinearLaw { 1e8 }, 1., 10., 1.), 1e-3, 1e-3 * rounding); // v sqrt(m / K)
}

TEST(NewPoint, ExcessShrinksWithTheOverlap)
{
	Spring<HertzLaw> spring { timberLaw, pairOf(0.4) };
	spring.state.unloadedOverlap = 5e-3;
	spring.step(5e-3, 0, Vec3::Zero());
	EXPECT_EQ(spring.state.normalForce, 0);
	spring.step(5.5e-3, 0, Vec3::Zero());
	EXPECT_NEAR(spring.state.overlap, 5e-4, 1e-17);
	spring.step(2e-3, 0, Vec3::Zero()); // the excess shrinks with the overlap
	EXPECT_EQ(spring.state.normalForce, 0);
	EXPECT_EQ(spring.state.unloadedOverlap, 2e-3);
	spring.step(3e-3, 0, Vec3::Zero());
	EXPECT_NEAR(spring.state.overlap, 1e-3, 1e-17);
}

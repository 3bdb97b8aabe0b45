// SPDX-License-Identifier: GPL-2.0-or-later
/// Joint springs: numbers of the paper, force against the gradient of the energy, and the rule that breaks them.
#include "shapes.hpp"
#include <gtest/gtest.h>
#include <kernel/joint_law.hpp>

using namespace timber;
using namespace timber::shapes;

namespace {
constexpr double rounding = 1e-12; ///< of forces of some kN, relative 1e-15 times a few operations
} // namespace

/// Section 3.2: the corner fitting's spring of 58 800 N/m reaches 5 880 N at 10 cm.
TEST(JointSpring, NumbersOfThePaper)
{
	const SpringForce<double> f = springForce<double>({ 58800, 58800 }, { 0, 0, 0.1 }, Vec3::UnitZ());
	EXPECT_NEAR(f.normal, 5880, rounding * 5880);
	EXPECT_NEAR(f.energy, 294, rounding * 294);
	EXPECT_LT((f.force - Vec3(0, 0, 5880)).norm(), rounding * 5880); // stretched towards B: A is pulled to B
}

TEST(JointSpring, SplitStiffness)
{
	const SpringForce<double> f = springForce<double>({ 1000, 100 }, { 0.03, 0.04, -0.02 }, Vec3::UnitZ());
	EXPECT_NEAR(f.normal, -20, rounding * 20);
	EXPECT_LT((f.force - Vec3(3, 4, -20)).norm(), rounding * 20);
	EXPECT_NEAR(f.energy, 0.5 * 1000 * 0.0004 + 0.5 * 100 * 0.0025, rounding);
}

/// K_ps = 0: no force within the contact area, however far the bodies slide there.
TEST(JointSpring, NormalSpring)
{
	const SpringForce<double> f = springForce<double>({ 1000, 0 }, { 0.3, 0.4, -0.02 }, Vec3::UnitZ());
	EXPECT_NEAR(f.normal, -20, rounding * 20);
	EXPECT_LT((f.force - Vec3(0, 0, -20)).norm(), rounding * 20);
	EXPECT_NEAR(f.energy, 0.5 * 1000 * 0.0004, rounding);
	EXPECT_EQ(breakCause(f), BreakCause::Compression);
}

TEST(JointSpring, ForceIsTheGradientOfTheEnergy)
{
	Random random(51);
	for (int trial = 0; trial < 200; ++trial) {
		const JointStiffness k { uniform(random, 1e3, 1e5), uniform(random, 1e3, 1e5) };
		const Vec3 stretch = randomVector(random, 0.1), normal = randomDirection(random);
		const Vec3 force = springForce<double>(k, stretch, normal).force;
		const double h = 1e-5;
		for (int axis = 0; axis < 3; ++axis) {
			const Vec3 e = h * Vec3::Unit(axis);
			const double slope = (springForce<double>(k, stretch + e, normal).energy
			                             - springForce<double>(k, stretch - e, normal).energy)
			        / (2 * h);
			// The energy is quadratic: only cancellation, 500 J * 1e-16 / h
			EXPECT_NEAR(force[axis], slope, 1e-5);
		}
	}
}

TEST(JointSpring, EqualStiffnessesDoNotNeedTheNormal)
{
	Random random(52);
	for (int trial = 0; trial < 200; ++trial) {
		const Vec3 stretch = randomVector(random, 0.1);
		const SpringForce<double> f = springForce<double>({ 58800, 58800 }, stretch, randomDirection(random));
		EXPECT_LT((f.force - 58800 * stretch).norm(), rounding * 5880);
		EXPECT_NEAR(f.energy, 29400 * stretch.squaredNorm(), rounding * 294);
	}
}

TEST(JointSpring, TurnsWithTheScene)
{
	Random random(53);
	for (int trial = 0; trial < 100; ++trial) {
		const Vec3 stretch = randomVector(random, 0.1), normal = randomDirection(random);
		const Quat rotation = randomRotation(random);
		const SpringForce<double> here = springForce<double>({ 5e4, 2e4 }, stretch, normal),
		                          there
		        = springForce<double>({ 5e4, 2e4 }, rotation * stretch, rotation * normal);
		EXPECT_LT((rotation * here.force - there.force).norm(), rounding * 5000);
		EXPECT_NEAR(here.energy, there.energy, rounding * 500);
	}
}

TEST(BreakCause, LargerComponentAndItsSign)
{
	const JointStiffness k { 1000, 1000 };
	const auto cause
	        = [&](const Vec3& stretch) { return breakCause(springForce<double>(k, stretch, Vec3::UnitZ())); };
	EXPECT_EQ(cause({ 0, 0, 0.1 }), BreakCause::Tension);
	EXPECT_EQ(cause({ 0, 0, -0.1 }), BreakCause::Compression);
	EXPECT_EQ(cause({ 0.1, 0, 0.05 }), BreakCause::Shear);
	EXPECT_EQ(cause({ 0.1, 0, -0.05 }), BreakCause::Shear);
	EXPECT_EQ(cause({ 0.05, 0, -0.1 }), BreakCause::Compression);
	EXPECT_EQ(cause({ 0.05, 0.05, 0.1 }), BreakCause::Tension);
}

namespace {

/// Springs between body A, at rest at the origin, and body B, at the same place, with anchors off by the stretches.
struct Joint {
	JointStiffness stiffness { 1000, 1000 };
	JointStrength strength;
	Vec3 normal = Vec3::UnitZ(), velocity = Vec3::Zero();
	std::vector<SpringLanes> groups;
	JointSprings springs;

	/// stretched: stretches of the springs [m]
	Joint(const JointStrength& s, const std::vector<Vec3>& stretched)
	        : strength(s)
	        , groups(groupsOf(stretched.size()))
	        , springs { groups.data(), stretched.size() }
	{
		springs.assign(std::vector<Vec3>(stretched.size(), Vec3::Zero()), stretched,
		        std::vector<int>(stretched.size(), 0));
	}
	JointForce total()
	{
		JointForce total;
		springForces(stiffness, { axes, axes, Vec3::Zero() }, normal, springs, total);
		return total;
	}
	/// Pulls the springs; returns the breaks, if the joint is overloaded.
	std::vector<SpringBreak> breaks()
	{
		const Vec3 none = Vec3::Zero();
		if (!isOverloaded(strength, total())) return {};
		return springBreaks(stiffness, strength, { axes, axes, none }, normal, springs,
		        { { none, none, none }, { none, velocity, none }, h });
	}
	/// Indices of the springs that break.
	std::vector<size_t> breaking()
	{
		std::vector<size_t> indices;
		for (const SpringBreak& b : breaks())
			indices.push_back(b.spring);
		return indices;
	}

	const Mat3 axes = Mat3::Identity();
	static constexpr double h = 1e-3;
};

using Indices = std::vector<size_t>;
// 40, 60, 71, 10 N: 181 N in all
const std::vector<Vec3> uneven { { 0, 0, 0.04 }, { 0, 0, -0.06 }, { 0.07, 0, 0.01 }, { 0, 0, 0.01 } };

} // namespace

TEST(BreakRule, PerSpringOverloadedSpringsBreakOneByOne)
{
	EXPECT_EQ(Joint({ 75, false }, uneven).breaking(), Indices {});
	EXPECT_EQ(Joint({ 65, false }, uneven).breaking(), Indices { 2 });
	EXPECT_EQ(Joint({ 50, false }, uneven).breaking(), (Indices { 1, 2 }));
	EXPECT_EQ(Joint({ 5, false }, uneven).breaking(), (Indices { 0, 1, 2, 3 }));
}

/// Only the sum of the magnitudes decides, and then all springs break.
TEST(BreakRule, PerJointAllSpringsBreakTogether)
{
	EXPECT_EQ(Joint({ 182, true }, uneven).breaking(), Indices {});
	EXPECT_EQ(Joint({ 180, true }, uneven).breaking(), (Indices { 0, 1, 2, 3 }));
}

TEST(BreakRule, StrengthItselfIsCarried)
{
	for (const bool perJoint : { false, true }) {
		EXPECT_EQ(Joint({ 125, perJoint }, { { 0, 0, 0.125 } }).breaking(), Indices {}); // exact in binary
		EXPECT_EQ(Joint({ std::nextafter(125, 0), perJoint }, { { 0, 0, 0.125 } }).breaking(), Indices { 0 });
		EXPECT_EQ(Joint({ std::numeric_limits<double>::infinity(), perJoint }, uneven).breaking(), Indices {});
	}
}

TEST(BreakRule, BrokenSpringsNeitherLoadNorBreakAgain)
{
	for (const bool perJoint : { false, true }) {
		Joint joint({ perJoint ? 115. : 65., perJoint }, uneven);
		joint.springs.breakSpring(2);
		EXPECT_EQ(joint.breaking(), Indices {}) << perJoint; // the others carry 110 N, one of them 60 N
		joint.strength.strength = 20;
		EXPECT_EQ(joint.breaking(), perJoint ? (Indices { 0, 1, 3 }) : (Indices { 0, 1 }));
		EXPECT_EQ(joint.springs.force(2), Vec3(Vec3::Zero()));
		for (size_t i = 0; i < 4; ++i)
			joint.springs.breakSpring(i);
		EXPECT_EQ(joint.breaking(), Indices {});
	}
}

TEST(BreakRule, ReportsCauseForceAndEnergy)
{
	for (const bool perJoint : { false, true }) {
		Joint joint({ 1, perJoint }, uneven);
		const std::vector<SpringBreak> breaks = joint.breaks();
		const BreakCause causes[]
		        = { BreakCause::Tension, BreakCause::Compression, BreakCause::Shear, BreakCause::Tension };
		ASSERT_EQ(breaks.size(), 4u);
		double sum = 0;
		for (const Vec3& stretch : uneven)
			sum += stretch.norm();
		for (size_t k = 0; k < 4; ++k) {
			EXPECT_EQ(breaks[k].cause, causes[k]);
			// A spring breaks at its strength of 1 N, or with its share of the joint's
			EXPECT_NEAR(breaks[k].force, perJoint ? uneven[k].norm() / sum : 1, rounding);
			EXPECT_NEAR(breaks[k].energy, 500 * uneven[k].squaredNorm(), rounding * 10);
		}
	}
}

/// Velocities belong to the middle of the last step: there the spring was stretched by h/2 of the velocity less.
TEST(BreakRule, EnergyIsThatOfTheMiddleOfTheLastStep)
{
	Joint joint({ 1, false }, { { 0, 0, 0.1 } });
	joint.velocity = { 0, 0, 2 };
	const double earlier = 0.1 - joint.h / 2 * 2;
	// First order in the step: K (h v / 2)^2 / 2 remains
	EXPECT_NEAR(joint.breaks()[0].energy, 500 * earlier * earlier, 500 * 1e-6 * (1 + rounding));
	EXPECT_NEAR(joint.breaks()[0].energy, 5 - 0.1 * 1000 * 2 * joint.h / 2, rounding * 5);
}

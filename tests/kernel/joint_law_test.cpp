// SPDX-License-Identifier: GPL-2.0-or-later
/// Joint springs: numbers of the paper, force against the gradient of the energy, what counts as the cause of a break.
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
			const double slope = (springForce<double>(k, stretch + e, normal).energy - springForce<double>(k, stretch - e, normal).energy) / (2 * h);
			EXPECT_NEAR(force[axis], slope, 1e-5); // the energy is quadratic: only cancellation, 500 J * 1e-16 / h
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
		const SpringForce<double> here = springForce<double>({ 5e4, 2e4 }, stretch, normal), there = springForce<double>({ 5e4, 2e4 }, rotation * stretch, rotation * normal);
		EXPECT_LT((rotation * here.force - there.force).norm(), rounding * 5000);
		EXPECT_NEAR(here.energy, there.energy, rounding * 500);
	}
}

TEST(BreakCause, LargerComponentAndItsSign)
{
	const JointStiffness k { 1000, 1000 };
	const auto cause = [&](const Vec3& stretch) { return breakCause(springForce<double>(k, stretch, Vec3::UnitZ())); };
	EXPECT_EQ(cause({ 0, 0, 0.1 }), BreakCause::Tension);
	EXPECT_EQ(cause({ 0, 0, -0.1 }), BreakCause::Compression);
	EXPECT_EQ(cause({ 0.1, 0, 0.05 }), BreakCause::Shear);
	EXPECT_EQ(cause({ 0.1, 0, -0.05 }), BreakCause::Shear);
	EXPECT_EQ(cause({ 0.05, 0, -0.1 }), BreakCause::Compression);
	EXPECT_EQ(cause({ 0.05, 0.05, 0.1 }), BreakCause::Tension);
}

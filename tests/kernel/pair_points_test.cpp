// SPDX-License-Identifier: GPL-2.0-or-later
/// What is lost with a point that ceases to exist.
#include <gtest/gtest.h>
#include <kernel/pair_points.hpp>

using namespace timber;

namespace {

const HertzLaw law { 5e9, 0.1 };
constexpr double overlap = 1e-3; // [m]

/// Energy lost when a point with that overlap, and `beyond` the limit [m], goes in a step in which the bodies close by `closing` [m].
double lostWith(double closing, double beyond = 0)
{
	const Vec3 none = Vec3::Zero();
	const BodyMotion still { none, none, none };
	PointState state;
	state.overlap = overlap;
	state.normal = law.force(overlap);
	state.energy = law.energy(overlap) + beyond * state.normal;
	state.closing = closing;
	std::vector<PointState> states { state };
	const double lost = elasticPair(law, PairProperties {}, still, still, 1e-4, NormalForm::Closed, false, {}, states);
	EXPECT_TRUE(states.empty());
	return lost;
}

} // namespace

TEST(Leaving, WhatTheSpringHasGivenBackIsNotLost)
{
	EXPECT_EQ(lostWith(-2 * overlap), 0); // they parted
	EXPECT_EQ(lostWith(-overlap), 0);
	EXPECT_EQ(lostWith(-overlap / 2), law.energy(overlap / 2)); // half way out when its feature went
	EXPECT_EQ(lostWith(0), law.energy(overlap)); // a vertex that slides over a border
	EXPECT_EQ(lostWith(overlap), law.energy(overlap)); // what more would be pressed has not been paid for
}

/// Beyond the limit the force is constant.
TEST(Leaving, DeepPointsLoseWhatTheyHold)
{
	constexpr double beyond = 5e-3, rounding = 1e-12;
	const double limit = law.energy(overlap), force = law.force(overlap);
	EXPECT_NEAR(lostWith(0, beyond), limit + beyond * force, limit * rounding);
	EXPECT_NEAR(lostWith(-1e-3, beyond), limit + (beyond - 1e-3) * force, limit * rounding);
	EXPECT_NEAR(lostWith(-beyond - overlap / 2, beyond), law.energy(overlap / 2), limit * rounding);
	EXPECT_EQ(lostWith(-beyond - 2 * overlap, beyond), 0);
}

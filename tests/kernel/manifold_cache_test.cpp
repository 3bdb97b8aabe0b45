// SPDX-License-Identifier: GPL-2.0-or-later
/// The candidate cache holds no result: along any trajectory it gives the bits that an empty cache gives.
#include "shapes.hpp"
#include <gtest/gtest.h>
#include <kernel/constants.hpp>

using namespace timber;
using namespace timber::shapes;

namespace {

bool identical(const std::vector<ContactPoint>& a, const std::vector<ContactPoint>& b)
{
	if (a.size() != b.size()) return false;
	for (size_t k = 0; k < a.size(); ++k)
		if (!(a[k].id == b[k].id && a[k].overlap == b[k].overlap && a[k].position == b[k].position && a[k].normal == b[k].normal)) return false;
	return true;
}

/// Steps of random length and direction, from far below to far above the skin, drawn back towards contact.
class Walk {
public:
	Walk(unsigned seed, double width, double touching)
	        : random(seed)
	        , width(width)
	        , touching(touching)
	{
		pose.position = touching * randomDirection(random);
		pose.orientation = randomRotation(random);
	}
	const Pose& next()
	{
		const double step = width * std::pow(10, uniform(random, -6, -1));
		pose.position += step * randomDirection(random);
		pose.orientation = (about(randomDirection(random), uniform(random, 0, step / width)) * pose.orientation).normalized();
		if (pose.position.norm() > 1.5 * touching) pose.position *= 0.7;
		return pose;
	}

private:
	Random random;
	double width, touching;
	Pose pose;
};

/// Both bodies move; returns the number of steps with contact.
int follow(const RoundedPolyhedron& a, const RoundedPolyhedron& b, double width, double touching, const Patterns& patterns, unsigned seed, int steps)
{
	Walk walk(seed, width, touching);
	Random random(seed + 1);
	const Quat turn = randomRotation(random);
	const Vec3 place = randomVector(random, 10);
	CandidateCache cache;
	std::vector<ContactPoint> points;
	int inContact = 0;
	for (int step = 0; step < steps; ++step) {
		const Pose poseA = carried({}, about({ 1, 2, 3 }, 1e-3 * step) * turn, place), poseB = carried(walk.next(), about({ 1, 2, 3 }, 1e-3 * step) * turn, place);
		updateManifold(a, b, poseA, poseB, patterns, cache, points);
		EXPECT_TRUE(identical(points, contacts(a, b, poseA, poseB, patterns))) << "seed " << seed << " step " << step;
		inContact += !points.empty();
	}
	return inContact;
}

} // namespace

TEST(CandidateCache, SimilarBodies)
{
	int inContact = 0;
	for (unsigned seed = 0; seed < 20; ++seed)
		inContact += follow(roundedBox({ 1, 0.5, 0.3 }), rounded(hexagonalPrismVertices(0.2, 0.9), 0.02), 1, 0.5, { seed % 2 == 0, seed % 3 == 0 }, seed, 300);
	EXPECT_GT(inContact, 600);
}

TEST(CandidateCache, LongMembers)
{
	int inContact = 0;
	for (unsigned seed = 0; seed < 20; ++seed)
		inContact += follow(roundedBox({ 3, 0.1, 0.1 }), roundedBox({ 0.1, 0.1, 2.7 }), 0.3, 0.2, { seed % 2 == 0, true }, seed, 300);
	EXPECT_GT(inContact, 600);
}

/// The small body turns about itself: the large body's vertices and edges sweep past its faces within the large radius.
TEST(CandidateCache, SmallBodyTurningAtALargeCorner)
{
	const auto large = roundedBox({ 1, 1, 1 }, 0.2), small = roundedBox({ 0.05, 0.04, 0.03 });
	const Vec3 corner(0.3, 0.3, 0.3);
	int inContact = 0;
	for (unsigned seed = 0; seed < 30; ++seed) {
		Random random(seed);
		const Vec3 axis = randomDirection(random), place = corner + 0.19 * Vec3(1, 1, 1).cwiseProduct(randomDirection(random).cwiseAbs());
		CandidateCache cache;
		std::vector<ContactPoint> points;
		for (int step = 0; step < 300; ++step) {
			const Pose poseB { place, about(axis, step * 0.01) };
			updateManifold(large, small, {}, poseB, { true, true }, cache, points);
			ASSERT_TRUE(identical(points, contacts(large, small, {}, poseB, { true, true }))) << "seed " << seed << " step " << step;
			inContact += !points.empty();
		}
	}
	EXPECT_GT(inContact, 1000);
}

/// A corner sinks towards a place just beyond an edge, along the axis on which the gap was measured: the face still
/// supports it (flushTolerance) when the gap along the axis is a little larger than both radii together.
TEST(CandidateCache, ObliqueApproachFromAfar)
{
	const auto large = roundedBox({ 1, 1, 1 }, 0.001), small = roundedBox({ 0.1, 0.1, 0.1 }, 0.001);
	const double lean = 0.049;
	const Vec3 axis(std::sin(lean), 0, std::cos(lean)), along = Vec3(std::cos(lean), 1, -std::sin(lean)).normalized(), side = axis.cross(along);
	Mat3 turn;
	turn << along, (axis + side).normalized(), (axis - side).normalized();
	if (turn.determinant() < 0) turn.col(1).swap(turn.col(2));
	CandidateCache cache;
	std::vector<ContactPoint> points;
	bool supported = false;
	for (double distance = 0.0502; distance > 0.0019; distance -= distance > 0.004 ? 1e-3 : 2e-7) {
		const Pose poseB { Vec3(0.499, 0, 0.499) + distance * axis + turn * Vec3::Constant(0.049), Quat(turn) };
		updateManifold(large, small, {}, poseB, {}, cache, points);
		ASSERT_TRUE(identical(points, contacts(large, small, {}, poseB))) << distance;
		supported = supported || (distance > 0.002 && !points.empty());
	}
	EXPECT_TRUE(supported); // the case that the test is about did occur
}

/// Pairs that tremble for longer than quietSteps, and then move: what a still pair does not look at must come back in time.
TEST(CandidateCache, PairsThatWereQuiet)
{
	const auto beam = roundedBox({ 1, 0.12, 0.12 }), post = roundedBox({ 0.105, 0.105, 0.9 });
	int inContact = 0, quiet = 0, fewer = 0;
	for (unsigned seed = 0; seed < 40; ++seed) {
		Random random(seed);
		Pose poseB { { uniform(random, -0.4, 0.4), uniform(random, -0.02, 0.02), 0.5099 }, about(randomDirection(random), seed % 2 == 0 ? 0 : 1e-3) };
		CandidateCache cache;
		std::vector<ContactPoint> points;
		size_t most = 0;
		for (int step = 0; step < 4 * quietSteps; ++step) {
			const bool trembles = step % (2 * quietSteps) < 3 * quietSteps / 2;
			const double way = trembles ? 1e-7 : std::pow(10, uniform(random, -6, -2.5));
			poseB.position += way * randomDirection(random);
			poseB.orientation = (about(randomDirection(random), way) * poseB.orientation).normalized();
			updateManifold(beam, post, {}, poseB, { seed % 3 == 0, seed % 4 != 0 }, cache, points);
			ASSERT_TRUE(identical(points, contacts(beam, post, {}, poseB, { seed % 3 == 0, seed % 4 != 0 }))) << "seed " << seed << " step " << step;
			inContact += !points.empty();
			if (cache.skin == candidateSkin) most = std::max(most, cache.candidates.size());
			else ++quiet, fewer += cache.candidates.size() < most;
		}
	}
	EXPECT_GT(inContact, 8000);
	EXPECT_GT(quiet, 1000);
	EXPECT_GT(fewer, quiet / 2);
}

/// A pair that settles before it keeps still gets fewer candidates, too.
TEST(CandidateCache, PairsThatSettled)
{
	const auto beam = roundedBox({ 1, 0.12, 0.12 }), post = roundedBox({ 0.105, 0.105, 0.9 });
	CandidateCache cache;
	std::vector<ContactPoint> points;
	for (int step = 0; step < 3 * quietSteps; ++step)
		updateManifold(beam, post, {}, { { 0, 0, 0.51 - 2e-6 * std::min(step, 3 * quietSteps / 2) }, Quat::Identity() }, {}, cache, points);
	EXPECT_EQ(cache.skin, quietSkin);
}

/// A placement that is no number spoils its own step only.
/// A cube above another slides past its edge and down: the axis of the search no longer shows the gap, and is replaced within axisUses.
TEST(CandidateCache, APairThatSlidPastAnEdgeGetsANewAxis)
{
	const auto cube = roundedBox({ 1, 1, 1 });
	const double above = 1e-3, beside = 1.5e-3;
	CandidateCache cache;
	std::vector<ContactPoint> points;
	const auto gapAt = [&](double x, double z) { return updateManifold(cube, cube, {}, { { x, 0, z }, Quat::Identity() }, {}, cache, points); };
	gapAt(0.998, 1 + above);
	EXPECT_NEAR(gapAt(0.998, 1 + above), above - 2 * flushTolerance, 1e-15);
	EXPECT_EQ(gapAt(1 + beside, 0.9995), 0);
	double gap = 0;
	for (int use = 0; use < axisUses; ++use)
		gap = gapAt(1 + beside, 0.9995);
	EXPECT_NEAR(gap, beside - 2 * flushTolerance, 1e-15);
	EXPECT_EQ(gapAt(0.5, 0.9995), 0);
	EXPECT_FALSE(points.empty());
}

TEST(CandidateCache, APlacementThatIsNoNumberIsForgotten)
{
	const auto cube = roundedBox({ 1, 1, 1 });
	CandidateCache cache;
	std::vector<ContactPoint> points;
	updateManifold(cube, cube, {}, { Vec3::Constant(std::numeric_limits<double>::quiet_NaN()), Quat::Identity() }, {}, cache, points);
	updateManifold(cube, cube, {}, { { 0, 0, 0.999 }, Quat::Identity() }, {}, cache, points);
	EXPECT_EQ(points.size(), 4u);
}

TEST(CandidateCache, FindsNothingWhenApart)
{
	const auto cube = roundedBox({ 1, 1, 1 });
	CandidateCache cache;
	std::vector<ContactPoint> points;
	updateManifold(cube, cube, {}, { { 0, 0, 0.999 }, Quat::Identity() }, {}, cache, points);
	EXPECT_EQ(points.size(), 4u);
	EXPECT_FALSE(cache.candidates.empty());
	EXPECT_GT(cache.margin, 0);
	updateManifold(cube, cube, {}, { { 0, 0, 5 }, Quat::Identity() }, {}, cache, points);
	EXPECT_TRUE(points.empty());
}

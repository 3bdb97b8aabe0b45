// SPDX-License-Identifier: GPL-2.0-or-later
/// The candidate cache never changes a result: along any trajectory the points are bitwise those from an empty cache.
#include "shapes.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <kernel/constants.hpp>

using namespace timber;
using namespace timber::shapes;

namespace {

bool identical(const std::vector<ContactPoint>& a, const std::vector<ContactPoint>& b)
{
	if (a.size() != b.size()) return false;
	for (size_t k = 0; k < a.size(); ++k)
		if (!(a[k].id == b[k].id && a[k].overlap == b[k].overlap && a[k].position == b[k].position
		            && a[k].normal == b[k].normal))
			return false;
	return true;
}

/// Steps of random length and direction, from far below to far above the skin, biased towards contact.
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
		pose.orientation = (about(randomDirection(random), uniform(random, 0, step / width)) * pose.orientation)
		                           .normalized();
		if (pose.position.norm() > 1.5 * touching) pose.position *= 0.7;
		return pose;
	}

private:
	Random random;
	double width, touching;
	Pose pose;
};

/// Both bodies move; returns the number of steps with contact.
int follow(const RoundedPolyhedron& a, const RoundedPolyhedron& b, double width, double touching,
        const ContactKinds& kinds, unsigned seed, int steps)
{
	Walk walk(seed, width, touching);
	Random random(seed + 1);
	const Quat turn = randomRotation(random);
	const Vec3 place = randomVector(random, 10);
	CandidateCache cache;
	std::vector<ContactPoint> points;
	int inContact = 0;
	for (int step = 0; step < steps; ++step) {
		const Pose poseA = carried({}, about({ 1, 2, 3 }, 1e-3 * step) * turn, place),
		           poseB = carried(walk.next(), about({ 1, 2, 3 }, 1e-3 * step) * turn, place);
		updateManifold(a, b, poseA, poseB, kinds, cache, points);
		EXPECT_TRUE(identical(points, contacts(a, b, poseA, poseB, kinds)))
		        << "seed " << seed << " step " << step;
		inContact += !points.empty();
	}
	return inContact;
}

/// Points after a motion within the margin, from the candidates before it; compared with those from an empty cache.
std::vector<ContactPoint> afterMove(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& before,
        const Pose& after, const ContactKinds& kinds = {})
{
	CandidateCache cache;
	std::vector<ContactPoint> points;
	updateManifold(a, b, {}, before, kinds, cache, points);
	updateManifold(a, b, {}, after, kinds, cache, points);
	EXPECT_EQ(cache.updates, 1); // no second search
	EXPECT_TRUE(identical(points, contacts(a, b, {}, after, kinds)));
	return points;
}

constexpr double move = (1 - 1e-6) * candidateSkin; ///< just within the margin [m]
constexpr double touch = 0.002,
                 flush = flushShare * touch; ///< contact distance of bodies of 1 mm radius, flush limit [m]

} // namespace

TEST(CandidateCache, SimilarBodies)
{
	int inContact = 0;
	for (unsigned seed = 0; seed < 20; ++seed)
		inContact += follow(roundedBox({ 1, 0.5, 0.3 }), rounded(hexagonalPrismVertices(0.2, 0.9), 0.02), 1,
		        0.5, { seed % 2 == 0, seed % 3 == 0 }, seed, 300);
	EXPECT_GT(inContact, 600);
}

TEST(CandidateCache, LongMembers)
{
	int inContact = 0;
	for (unsigned seed = 0; seed < 20; ++seed)
		inContact += follow(roundedBox({ 3, 0.1, 0.1 }), roundedBox({ 0.1, 0.1, 2.7 }), 0.3, 0.2,
		        { seed % 2 == 0, true }, seed, 300);
	EXPECT_GT(inContact, 600);
}

/// The small body rotates about its centre: vertices and edges of the large body pass its faces within the large
/// radius.
TEST(CandidateCache, SmallBodyTurningAtALargeCorner)
{
	const auto large = roundedBox({ 1, 1, 1 }, 0.2), small = roundedBox({ 0.05, 0.04, 0.03 });
	const Vec3 corner(0.3, 0.3, 0.3);
	int inContact = 0;
	for (unsigned seed = 0; seed < 30; ++seed) {
		Random random(seed);
		const Vec3 axis = randomDirection(random),
		           place = corner + 0.19 * Vec3(1, 1, 1).cwiseProduct(randomDirection(random).cwiseAbs());
		CandidateCache cache;
		std::vector<ContactPoint> points;
		for (int step = 0; step < 300; ++step) {
			const Pose poseB { place, about(axis, step * 0.01) };
			updateManifold(large, small, {}, poseB, { true, true }, cache, points);
			ASSERT_TRUE(identical(points, contacts(large, small, {}, poseB, { true, true })))
			        << "seed " << seed << " step " << step;
			inContact += !points.empty();
		}
	}
	EXPECT_GT(inContact, 1000);
}

/// An edge moves towards a position just beyond another edge, along the normal of its own inclined face, along which
/// the gap is measured.
/// The face supports its vertices (flush limit) even if that gap is slightly larger than the sum of the radii. The
/// skin subtracted from the margin covers this, and so does the second skin within which candidates are searched.
TEST(CandidateCache, ObliqueApproachFromAfar)
{
	const auto large = roundedBox({ 1, 1, 1 }, 0.001), small = roundedBox({ 0.1, 0.1, 0.1 }, 0.001);
	const Quat lean = about(Vec3::UnitY(), 0.98 * flush / touch);
	const Vec3 axis = lean * Vec3::UnitZ(), upper(0.499, 0, 0.499), lower(0.049, 0, -0.049);
	for (const double start : { 0.05, touch + candidateSkin + 1e-6 }) {
		CandidateCache cache;
		std::vector<ContactPoint> points;
		bool supported = false;
		for (double distance = start; distance > touch - 1e-4; distance -= distance > 2 * touch ? 1e-3 : 5e-8) {
			const Pose poseB { upper + distance * axis - lean * lower, lean };
			updateManifold(large, small, {}, poseB, {}, cache, points);
			ASSERT_TRUE(identical(points, contacts(large, small, {}, poseB))) << distance;
			supported = supported || (distance > touch && !points.empty());
			if (distance == start) {
				// The gap is measured along the normal of the inclined face
				EXPECT_LT((cache.axis - axis).norm(), 1e-12);
			}
		}
		EXPECT_TRUE(supported); // the tested case occurred
	}
}

/// A corner beyond a border by the motion plus half of the flush limit: it is supported after the motion.
TEST(CandidateCache, AFaceReachesBeyondItsBorder)
{
	const auto large = roundedBox({ 1, 1, 1 }, 0.001), small = roundedBox({ 0.1, 0.1, 0.1 }, 0.001);
	const Vec3 above(0.499 + 0.049 + flush / 2, 0, 0.499 + 0.049 + 0.0015);
	EXPECT_EQ(count(afterMove(large, small, { above + move * Vec3::UnitX(), Quat::Identity() },
	                        { above, Quat::Identity() }),
	                  FeatureKind::FaceVertex),
	        2);
}

/// A corner approaches the end of an edge from beyond it: in contact is the vertex there.
TEST(CandidateCache, ACornerReachesTheEndOfAnEdge)
{
	const auto large = roundedBox({ 1, 1, 1 }, 0.001), small = roundedBox({ 0.1, 0.1, 0.1 }, 0.001);
	const Vec3 outward = Vec3(1, 0, 1).normalized(), along = Vec3::UnitY(),
	           beyond = (touch - 1e-8) * (outward + 0.98 * flush / touch * along).normalized();
	const Quat onCorner = Quat::FromTwoVectors(Vec3(1, 1, 1), -outward);
	const Vec3 centre = Vec3::Constant(0.499) + beyond + 0.049 * std::sqrt(3.) * outward;
	const auto points = afterMove(
	        large, small, { centre + move * beyond.normalized(), onCorner }, { centre, onCorner }, { true, true });
	EXPECT_EQ(count(points, FeatureKind::VertexVertex), 1);
	EXPECT_EQ(points.size(), 1u);
}

/// Parallel edges have no crossing until the upper box rotates.
TEST(CandidateCache, ParallelEdgesThatTurn)
{
	const auto cube = roundedBox({ 0.3, 0.3, 0.3 }, 0.01);
	const Vec3 above(0, 1e-3, 0.299);
	EXPECT_EQ(count(afterMove(cube, cube, { above, Quat::Identity() },
	                        { above, about(Vec3::UnitZ(), 2 * parallelSine) }),
	                  FeatureKind::EdgeEdge),
	        8);
}

/// Crossed laths pass through each other within one motion: the edges of the far sides come into contact, deeper than
/// the sum of the radii.
TEST(CandidateCache, LathsThatPassThroughEachOther)
{
	const double thickness = 0.8 * candidateSkin;
	const auto lath = roundedBox({ 0.2, thickness, thickness }, thickness / 32);
	const Quat across = about(Vec3::UnitZ(), M_PI / 2);
	const auto points = afterMove(lath, lath, { { 0, 0, move / 2 }, across }, { { 0, 0, -move / 2 }, across });
	EXPECT_EQ(count(points, FeatureKind::EdgeEdge), 4);
	for (const auto& p : points)
		EXPECT_NEAR(p.overlap, thickness - move / 2, 1e-13); // rounding of positions
}

/// Two ridges at a small angle in deep contact, whose edges do not cross yet. A small pitch shifts their crossing by
/// the depth times the pitch over the squared sine of the angle, onto both edges.
TEST(CandidateCache, CrossingsOfDeepEdgesRunFar)
{
	const Quat onEdge = about(Vec3::UnitX(), M_PI / 4);
	const auto lower = rounded(moved(boxVertices({ 1, 0.18, 0.18 }), onEdge, { -0.49, 0, 0 }), 0.01),
	           upper = roundedBox({ 2, 0.18, 0.18 }, 0.01);
	const double half = 0.08 * std::sqrt(2.), depth = 0.07, beyond = 0.04, sine = 0.21, pitch = 0.03;
	const Vec3 end(0, 0, half), along(std::sqrt(1 - sine * sine), sine, 0);
	const Pose before { { beyond, 0, 2 * half - depth }, about(Vec3::UnitZ(), std::asin(sine)) * onEdge };
	const Pose after
	        = carried({ before.position - end, before.orientation }, about(Vec3::UnitZ().cross(along), pitch), end);
	const auto isDeep = [&](const ContactPoint& p) { return p.overlap > 0.02 + depth; };
	for (const auto& p : contacts(lower, upper, {}, before))
		EXPECT_FALSE(isDeep(p));
	const auto points = afterMove(lower, upper, before, after);
	const auto crossing = std::find_if(points.begin(), points.end(), isDeep);
	ASSERT_NE(crossing, points.end());
	// To first order; (pitch / sine)^2 = 2 %
	EXPECT_NEAR(crossing->position.x(), beyond - depth * pitch / (sine * sine), 2e-3);
}

/// Pairs vibrate for longer than restInterval and then move: the features left out at rest must become candidates in
/// time.
TEST(CandidateCache, PairsAfterRest)
{
	const auto beam = roundedBox({ 1, 0.12, 0.12 }), post = roundedBox({ 0.105, 0.105, 0.9 });
	int inContact = 0, atRest = 0, fewer = 0;
	for (unsigned seed = 0; seed < 40; ++seed) {
		Random random(seed);
		Pose poseB { { uniform(random, -0.4, 0.4), uniform(random, -0.02, 0.02), 0.5099 },
			about(randomDirection(random), seed % 2 == 0 ? 0 : 1e-3) };
		CandidateCache cache;
		std::vector<ContactPoint> points;
		size_t most = 0;
		for (int step = 0; step < 4 * restInterval; ++step) {
			const bool vibrates = step % (2 * restInterval) < 3 * restInterval / 2;
			const double displacement = vibrates ? 1e-7 : std::pow(10, uniform(random, -6, -2.5));
			poseB.position += displacement * randomDirection(random);
			poseB.orientation
			        = (about(randomDirection(random), displacement) * poseB.orientation).normalized();
			updateManifold(beam, post, {}, poseB, { seed % 3 == 0, seed % 4 != 0 }, cache, points);
			ASSERT_TRUE(
			        identical(points, contacts(beam, post, {}, poseB, { seed % 3 == 0, seed % 4 != 0 })))
			        << "seed " << seed << " step " << step;
			inContact += !points.empty();
			if (cache.skin == candidateSkin) most = std::max(most, cache.candidates.size());
			else ++atRest, fewer += cache.candidates.size() < most;
		}
	}
	EXPECT_GT(inContact, 8000);
	EXPECT_GT(atRest, 1000);
	EXPECT_GT(fewer, atRest / 2);
}

/// The skin is also reduced for a pair that settles before it comes to rest.
TEST(CandidateCache, PairsAfterSettlement)
{
	const auto beam = roundedBox({ 1, 0.12, 0.12 }), post = roundedBox({ 0.105, 0.105, 0.9 });
	CandidateCache cache;
	std::vector<ContactPoint> points;
	for (int step = 0; step < 3 * restInterval; ++step)
		updateManifold(beam, post, {},
		        { { 0, 0, 0.51 - 2e-6 * std::min(step, 3 * restInterval / 2) }, Quat::Identity() }, {}, cache,
		        points);
	EXPECT_EQ(cache.skin, restSkin);
}

/// A cube above another slides past its edge and down: the axis of the search no longer separates the cores. It is
/// replaced within axisInterval updates.
TEST(CandidateCache, SeparatingAxisAfterSlidingPastAnEdge)
{
	const auto cube = roundedBox({ 1, 1, 1 });
	const double above = 1e-3, beside = 1.5e-3;
	CandidateCache cache;
	std::vector<ContactPoint> points;
	const auto gapAt = [&](double x, double z) {
		return updateManifold(cube, cube, {}, { { x, 0, z }, Quat::Identity() }, {}, cache, points);
	};
	gapAt(0.998, 1 + above);
	EXPECT_NEAR(gapAt(0.998, 1 + above), above - 2 * flushTolerance, 1e-15);
	EXPECT_EQ(gapAt(1 + beside, 0.9995), 0);
	double gap = 0;
	for (int update = 0; update < axisInterval; ++update)
		gap = gapAt(1 + beside, 0.9995);
	EXPECT_NEAR(gap, beside - 2 * flushTolerance, 1e-15);
	EXPECT_EQ(gapAt(0.5, 0.9995), 0);
	EXPECT_FALSE(points.empty());
}

/// A pose that is not finite violates the precondition: builds with assertions abort, others recover in the next step.
TEST(CandidateCache, NonFinitePose)
{
	const auto cube = roundedBox({ 1, 1, 1 });
	CandidateCache cache;
	std::vector<ContactPoint> points;
	const Pose invalid { Vec3::Constant(std::numeric_limits<double>::quiet_NaN()), Quat::Identity() };
	EXPECT_DEBUG_DEATH(updateManifold(cube, cube, {}, invalid, {}, cache, points), "isAdmissible");
	updateManifold(cube, cube, {}, { { 0, 0, 0.999 }, Quat::Identity() }, {}, cache, points);
	EXPECT_EQ(points.size(), 4u);
}

/// The cache is reset when the bodies or the kinds change.
TEST(CandidateCache, ResetForOtherBodiesOrPatterns)
{
	const auto cube = roundedBox({ 1, 1, 1 }), prism = rounded(hexagonalPrismVertices(0.5, 1), 0.02);
	const Pose above { { 0, 0, 0.999 }, Quat::Identity() };
	CandidateCache cache;
	std::vector<ContactPoint> points;
	const auto expectFresh
	        = [&](const RoundedPolyhedron& a, const RoundedPolyhedron& b, const ContactKinds& kinds) {
		          updateManifold(a, b, {}, above, kinds, cache, points);
		          EXPECT_TRUE(identical(points, contacts(a, b, {}, above, kinds)));
		          EXPECT_FALSE(points.empty());
	          };
	expectFresh(cube, cube, {});
	expectFresh(cube, prism, {});
	expectFresh(cube, cube, {});
	expectFresh(prism, cube, {});
	expectFresh(prism, prism, {});
	expectFresh(prism, prism, { true, false });
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

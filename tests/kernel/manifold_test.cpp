// SPDX-License-Identifier: GPL-2.0-or-later
/// Contact points of pairs whose overlaps, normals and positions are known in closed form.
/// Flush supports, caching and deep overlap have their own files.
#include "shapes.hpp"
#include <algorithm>
#include <gtest/gtest.h>

using namespace timber;
using namespace timber::shapes;

namespace {

/// Rounding error of positions of about 1 m after two rotations. [m]
constexpr double rounding = 1e-13;
constexpr double press = 1e-3; ///< overlap of the resting pairs [m]

void expectPoint(const ContactPoint& p, const Vec3& normal, double overlap, double tolerance = rounding)
{
	EXPECT_NEAR(p.overlap, overlap, tolerance);
	EXPECT_LT((p.normal - normal).norm(), tolerance * 100); // an angle: the error in m over lengths of some cm
}

/// Exactly one point at each of the positions.
void expectPositions(
        const std::vector<ContactPoint>& points, const std::vector<Vec3>& positions, double tolerance = rounding)
{
	EXPECT_EQ(points.size(), positions.size());
	for (const Vec3& position : positions)
		EXPECT_EQ(std::count_if(points.begin(), points.end(),
		                  [&](const ContactPoint& p) { return (p.position - position).norm() < tolerance; }),
		        1)
		        << position.transpose();
}

std::vector<Vec3> rectangle(double x, double y, double z)
{
	return { { x, y, z }, { -x, y, z }, { x, -y, z }, { -x, -y, z } };
}

/// Two aligned boxes, B on top of A and pressed in.
std::vector<ContactPoint> stacked(const RoundedPolyhedron& a, const RoundedPolyhedron& b, double heightA,
        double heightB, const Quat& turnB = Quat::Identity())
{
	return contacts(a, b, {}, { { 0, 0, (heightA + heightB) / 2 - press }, turnB });
}

} // namespace

TEST(FaceOnFace, SmallBoxOnLarge)
{
	const auto points = stacked(roundedBox({ 1, 1, 1 }), roundedBox({ 0.5, 0.5, 0.5 }), 1, 0.5);
	EXPECT_EQ(count(points, FeatureKind::FaceVertex), 4);
	expectPositions(points, rectangle(0.2, 0.2, 0.5 - press / 2));
	for (const auto& p : points)
		expectPoint(p, Vec3::UnitZ(), press);
}

TEST(FaceOnFace, LargeBoxOnSmall)
{
	const auto points = stacked(roundedBox({ 0.5, 0.5, 0.5 }), roundedBox({ 1, 1, 1 }), 0.5, 1);
	EXPECT_EQ(count(points, FeatureKind::VertexFace), 4);
	expectPositions(points, rectangle(0.2, 0.2, 0.25 - press / 2));
	for (const auto& p : points)
		expectPoint(p, Vec3::UnitZ(), press);
}

TEST(FaceOnFace, SameSizeHasFourPointsNotEight)
{
	const auto points = stacked(roundedBox({ 1, 1, 1 }), roundedBox({ 1, 1, 1 }), 1, 1);
	expectPositions(points, rectangle(0.4, 0.4, 0.5 - press / 2));
	for (const auto& p : points)
		expectPoint(p, Vec3::UnitZ(), press);
}

/// Intersection of two squares of half side 0.4, one rotated by 45 degrees: an octagon.
TEST(FaceOnFace, TurnedByFortyFiveDegrees)
{
	const auto points
	        = stacked(roundedBox({ 1, 1, 1 }), roundedBox({ 1, 1, 1 }), 1, 1, about({ 0, 0, 1 }, M_PI / 4));
	const double s = 0.4 * (std::sqrt(2.) - 1), z = 0.5 - press / 2;
	auto positions = rectangle(0.4, s, z);
	for (const Vec3& p : rectangle(s, 0.4, z))
		positions.push_back(p);
	EXPECT_EQ(count(points, FeatureKind::EdgeEdge), 8);
	expectPositions(points, positions);
	for (const auto& p : points)
		expectPoint(p, Vec3::UnitZ(), press);
}

TEST(FaceOnFace, CrossedBeams)
{
	const auto a = roundedBox({ 3, 0.105, 0.12 }), b = roundedBox({ 0.12, 3, 0.18 });
	const auto points = stacked(a, b, 0.12, 0.18);
	EXPECT_EQ(count(points, FeatureKind::EdgeEdge), 4);
	expectPositions(points, rectangle(0.06 - b.radius, 0.0525 - a.radius, 0.06 - press / 2));
	for (const auto& p : points)
		expectPoint(p, Vec3::UnitZ(), press);
}

/// Radii differ: the point is in the middle of the overlap of the outer faces, not in the middle between the cores.
TEST(FaceOnFace, PositionWithUnequalRadii)
{
	const auto points = stacked(roundedBox({ 1, 1, 1 }, 0.02), roundedBox({ 0.5, 0.5, 0.5 }, 0.1), 1, 0.5);
	expectPositions(points, rectangle(0.15, 0.15, 0.5 - press / 2));
}

/// The overlap at each corner follows from the rotated plane.
TEST(FaceOnFace, TiltedByTenMicroradians)
{
	const double tilt = 1e-5, z = 0.75 - press;
	const auto points = contacts(
	        roundedBox({ 1, 1, 1 }), roundedBox({ 0.5, 0.5, 0.5 }), {}, { { 0, 0, z }, about({ 0, 1, 0 }, tilt) });
	EXPECT_EQ(count(points, FeatureKind::FaceVertex), 4);
	for (const auto& p : points) {
		const double x = p.position.x() > 0 ? 0.2 : -0.2;
		const double bottom = z - x * std::sin(tilt) - 0.2 * std::cos(tilt) - 0.05;
		expectPoint(p, Vec3::UnitZ(), 0.5 - bottom);
	}
}

TEST(FaceOnFace, TiltedByTenDegreesStandsOnTwoCorners)
{
	const double tilt = M_PI / 18, lowest = 0.2 * std::sin(tilt) + 0.2 * std::cos(tilt) + 0.05;
	const auto points = contacts(roundedBox({ 1, 1, 1 }), roundedBox({ 0.5, 0.5, 0.5 }), {},
	        { { 0, 0, 0.5 + lowest - press }, about({ 0, 1, 0 }, tilt) });
	const double x = 0.2 * std::cos(tilt) - 0.2 * std::sin(tilt);
	expectPositions(points, { { x, 0.2, 0.5 - press / 2 }, { x, -0.2, 0.5 - press / 2 } });
	for (const auto& p : points)
		expectPoint(p, Vec3::UnitZ(), press);
}

/// Two bars resting on their edges, the upper one rotated in plan: the edges cross at one point.
TEST(EdgeOnEdge, CrossedAtNinetyAndThirtyDegrees)
{
	const auto bar = roundedBox({ 2, 0.2, 0.2 });
	const double core = (0.1 - bar.radius) * std::sqrt(2.);
	const Quat onEdge = about({ 1, 0, 0 }, M_PI / 4);
	for (const double angle : { M_PI / 2, M_PI / 6 }) {
		const double height = 2 * core + 2 * bar.radius - press;
		const auto points = contacts(
		        bar, bar, { { 0, 0, 0 }, onEdge }, { { 0, 0, height }, about({ 0, 0, 1 }, angle) * onEdge });
		EXPECT_EQ(count(points, FeatureKind::EdgeEdge), 1);
		expectPositions(points, { { 0, 0, height / 2 } });
		for (const auto& p : points)
			expectPoint(p, Vec3::UnitZ(), press);
	}
}

/// The paper ignores parallel edges; ContactKinds::vertexEdge adds the vertices that lie on an edge.
TEST(EdgeOnEdge, ParallelNeedsTheVertexEdgePattern)
{
	const auto lower = roundedBox({ 2, 0.2, 0.2 }), upper = roundedBox({ 1, 0.2, 0.2 });
	const double core = (0.1 - lower.radius) * std::sqrt(2.), height = 2 * core + 2 * lower.radius - press;
	const Quat onEdge = about({ 1, 0, 0 }, M_PI / 4);
	const Pose below { { 0, 0, 0 }, onEdge }, above { { 0, 0, height }, onEdge };
	EXPECT_TRUE(contacts(lower, upper, below, above).empty());
	const ContactKinds both { true, true };
	auto points = contacts(lower, upper, below, above, both);
	EXPECT_EQ(count(points, FeatureKind::EdgeVertex), 2);
	expectPositions(points, { { 0.48, 0, height / 2 }, { -0.48, 0, height / 2 } });
	for (const auto& p : points)
		expectPoint(p, Vec3::UnitZ(), press);
	points = contacts(lower, lower, below, above, both); // flush ends: one contact at each end
	expectPositions(points, { { 0.98, 0, height / 2 }, { -0.98, 0, height / 2 } });
}

TEST(CornerOnFace, OnePoint)
{
	const auto cube = roundedBox({ 0.4, 0.4, 0.4 });
	const double core = (0.2 - cube.radius) * std::sqrt(3.);
	const Quat onCorner = Quat::FromTwoVectors(Vec3(1, 1, 1), Vec3::UnitZ());
	const Vec3 centre(0.1, -0.05, 0.5 + core + cube.radius - press);
	const auto points = contacts(roundedBox({ 1, 1, 1 }), cube, {}, { centre, onCorner });
	EXPECT_EQ(count(points, FeatureKind::FaceVertex), 1);
	expectPositions(points, { { 0.1, -0.05, 0.5 - press / 2 } });
	for (const auto& p : points)
		expectPoint(p, Vec3::UnitZ(), press);
}

/// Corner on corner exists only with the extra kinds.
TEST(CornerOnCorner, NeedsTheVertexVertexPattern)
{
	const auto cube = roundedBox({ 0.4, 0.4, 0.4 });
	const double core = (0.2 - cube.radius) * std::sqrt(3.);
	const Quat onCorner = Quat::FromTwoVectors(Vec3(1, 1, 1), Vec3::UnitZ());
	const Pose above { { 0, 0, 2 * core + 2 * cube.radius - press }, onCorner };
	EXPECT_TRUE(contacts(cube, cube, { { 0, 0, 0 }, onCorner }, above).empty());
	const auto points = contacts(cube, cube, { { 0, 0, 0 }, onCorner }, above, { true, true });
	EXPECT_EQ(count(points, FeatureKind::VertexVertex), 1);
	ASSERT_EQ(points.size(), 1u);
	expectPoint(points[0], Vec3::UnitZ(), press, 1e-12); // rounding of the rotation onto the corner
}

/// Corner beside an edge: vertex-edge contact with the normal along the shortest distance.
TEST(CornerOnEdge, NormalAlongTheShortestConnection)
{
	const auto a = roundedBox({ 1, 1, 1 }), b = roundedBox({ 0.4, 0.4, 0.4 });
	const Vec3 towards = Vec3(1, 0, 1).normalized();
	const Quat onCorner = Quat::FromTwoVectors(Vec3(1, 1, 1), -towards);
	const double core = (0.2 - b.radius) * std::sqrt(3.), touch = a.radius + b.radius;
	const Vec3 edge(0.4, 0.05, 0.4);
	const Pose poseB { edge + towards * (touch - press + core), onCorner };
	EXPECT_TRUE(contacts(a, b, {}, poseB).empty());
	const auto points = contacts(a, b, {}, poseB, { true, true });
	EXPECT_EQ(count(points, FeatureKind::EdgeVertex), 1);
	// Rounding of the rotation onto the corner
	expectPositions(points, { edge + towards * (a.radius - press / 2) }, 1e-12);
	for (const auto& p : points)
		expectPoint(p, towards, press, 1e-12);
}

/// A corner on a slope just below a narrow ridge is also within the contact distance of the far edge of the ridge, but
/// behind it: only the slope is in contact.
TEST(CornerOnEdge, NoContactBehindAnEdge)
{
	const double radius = 0.01, width = 0.005, below = 0.005, rest = width / 2 + radius * (M_SQRT2 - 1);
	const auto ridge = rounded(
	        prismVertices({ { -rest - 0.2, -0.2 }, { rest + 0.2, -0.2 }, { rest, 0 }, { -rest, 0 } }, 0.5), radius);
	const auto cube = roundedBox({ 0.2, 0.2, 0.2 }, radius);
	const Vec3 slope = Vec3(-1, 1, 0).normalized(), down = Vec3(-1, -1, 0).normalized();
	const Vec3 foot = Vec3(-width / 2, -radius, 0) + below * down, corner = foot + radius * slope;
	const Vec3 towards = Vec3(width / 2, -radius, 0) - corner;
	ASSERT_LT(towards.norm(), 2 * radius); // within the contact distance of the far edge
	ASSERT_GT(towards.dot(Vec3(1, 1 + M_SQRT2, 0)), 0); // behind it
	const Pose poseB { corner + (0.1 - radius) * std::sqrt(3.) * slope,
		Quat::FromTwoVectors(Vec3(1, 1, 1), -slope) };
	for (const bool swapped : { false, true }) {
		const auto points = swapped ? contacts(cube, ridge, poseB, {}, { true, true })
		                            : contacts(ridge, cube, {}, poseB, { true, true });
		EXPECT_EQ(count(points, swapped ? FeatureKind::VertexFace : FeatureKind::FaceVertex), 1);
		// Rounding of the rotation onto the corner
		expectPositions(points, { foot + radius / 2 * slope }, 1e-12);
		for (const auto& p : points)
			expectPoint(p, swapped ? Vec3(-slope) : slope, radius, 1e-12);
	}
}

/// A brace in the corner of its bay: four points on the beam below, four on the column beside it.
class BraceInCorner : public testing::Test {
protected:
	const Brace shape { 0.805, 2.61, 0.09, 0.045 };
	const RoundedPolyhedron brace = rounded(shape.vertices());
	const RoundedPolyhedron beam = roundedBox({ 3, 0.105, 0.12 }), column = roundedBox({ 0.105, 0.105, 2.61 });
	const Pose beamPose { { 0.5, 0, -0.06 }, Quat::Identity() },
	        columnPose { { -0.0525, 0, 1.305 }, Quat::Identity() };
	const Pose bracePose { { -press, 0, -press }, Quat::Identity() };
};

TEST_F(BraceInCorner, OnTheBeam)
{
	const auto points = contacts(beam, brace, beamPose, bracePose);
	EXPECT_EQ(count(points, FeatureKind::FaceVertex), 4);
	EXPECT_EQ(points.size(), 4u);
	for (const auto& p : points) {
		expectPoint(p, Vec3::UnitZ(), press, 1e-12); // rounding of the intersection of three planes
		EXPECT_NEAR(std::abs(p.position.y()), shape.depth / 2 - brace.radius, 1e-12);
		EXPECT_NEAR(p.position.z(), -press / 2, 1e-12);
	}
}

/// The column's core ends 10.5 mm above the beam, above the lowest core vertices of the brace: the two vertical
/// edges of the brace cross its end edge.
TEST_F(BraceInCorner, OnTheColumn)
{
	const auto points = contacts(column, brace, columnPose, bracePose);
	EXPECT_EQ(count(points, FeatureKind::FaceVertex), 2);
	EXPECT_EQ(count(points, FeatureKind::EdgeEdge), 2);
	EXPECT_EQ(points.size(), 4u);
	for (const auto& p : points) {
		expectPoint(p, Vec3::UnitX(), press, 1e-12); // rounding of the intersection of three planes
		EXPECT_NEAR(p.position.x(), -press / 2, 1e-12);
		if (p.id.kind() == FeatureKind::EdgeEdge) {
			EXPECT_NEAR(p.position.z(), column.radius, 1e-12);
		}
	}
}

/// Two hip slabs, mirror images in the vertical hip plane x + y = eave / 2: all vertices of the contact faces coincide.
TEST(RoofSlabs, BearOnTheHipPlane)
{
	const HipSlab shape { 7.43, 0.3, 0.4, 0.12 };
	const Vec3 normal = Vec3(1, 1, 0).normalized();
	auto mirrored = shape.vertices();
	for (Vec3& p : mirrored)
		p -= 2 * (normal.dot(p) - shape.eave / 2 * normal.x()) * normal;
	const auto a = rounded(shape.vertices()), b = rounded(mirrored);
	const Pose pressed { -press * normal, Quat::Identity() };
	const auto points = contacts(a, b, {}, pressed);
	EXPECT_EQ(points.size(), 4u);
	for (const auto& p : points)
		expectPoint(p, normal, press, 1e-11); // three-plane solves at corners of 75 degrees, bodies of 7 m
	EXPECT_TRUE(contacts(a, b, {}, pressed, { false, false }).empty());
}

TEST(Separation, NoPointsApart)
{
	const auto cube = roundedBox({ 1, 1, 1 });
	for (const Vec3& at : { Vec3(0, 0, 1 + 1e-9), Vec3(1 + 1e-9, 0, 0), Vec3(5, 5, 5), Vec3(0, 0, 1e6) })
		for (const bool vertexEdge : { false, true })
			EXPECT_TRUE(contacts(cube, cube, {}, { at, Quat::Identity() }, { vertexEdge, true }).empty());
}

TEST(SizeRatio, OneToThousand)
{
	const auto large = roundedBox({ 10, 10, 10 }), small = roundedBox({ 0.01, 0.01, 0.01 });
	const double shallow = 1e-5;
	const Pose onTop { { 1, 2, 5.005 - shallow }, Quat::Identity() };
	const auto points = contacts(large, small, {}, onTop);
	EXPECT_EQ(count(points, FeatureKind::FaceVertex), 4);
	EXPECT_EQ(points.size(), 4u);
	for (const auto& p : points)
		expectPoint(p, Vec3::UnitZ(), shallow);
	const auto onLarge = contacts(small, large, onTop, {});
	EXPECT_EQ(count(onLarge, FeatureKind::VertexFace), 4);
	EXPECT_EQ(onLarge.size(), 4u);
}

/// The same positions and overlaps with opposite normals. Aligned flush pairs are in manifold_flush_test.cpp.
TEST(Symmetry, SwappedBodies)
{
	Random random(11);
	int touching = 0;
	for (int trial = 0; trial < 2000; ++trial) {
		const auto a = roundedBox({ 1, 0.5, 0.3 }), b = rounded(hexagonalPrismVertices(0.2, 0.9), 0.02);
		const Pose poseA { Vec3::Zero(), randomRotation(random) },
		        poseB { randomVector(random, 0.6), randomRotation(random) };
		const auto points = contacts(a, b, poseA, poseB), swapped = contacts(b, a, poseB, poseA);
		ASSERT_EQ(points.size(), swapped.size());
		touching += !points.empty();
		for (const auto& p : points)
			EXPECT_EQ(std::count_if(swapped.begin(), swapped.end(),
			                  [&](const ContactPoint& q) { // nearly parallel edges: rounding / parallelSine
				                  return (p.position - q.position).norm() < 1e-10
				                          && (p.normal + q.normal).norm() < 1e-10
				                          && std::abs(p.overlap - q.overlap) < 1e-10;
			                  }),
			        1)
			        << trial;
	}
	EXPECT_GT(touching, 500);
}

TEST(Symmetry, SceneTurnedAndMovedByAKilometre)
{
	Random random(12);
	const auto a = roundedBox({ 1, 0.5, 0.3 }), b = rounded(hexagonalPrismVertices(0.2, 0.9), 0.02);
	for (int trial = 0; trial < 500; ++trial) {
		const Pose poseA { Vec3::Zero(), randomRotation(random) },
		        poseB { randomVector(random, 0.6), randomRotation(random) };
		const Quat rotation = randomRotation(random);
		const Vec3 far = 1000 * randomDirection(random);
		const auto here = contacts(a, b, poseA, poseB),
		           there = contacts(a, b, carried(poseA, rotation, far), carried(poseB, rotation, far));
		ASSERT_EQ(here.size(), there.size());
		// Positions at 1 km are rounded to 1e-13 m, times 1 / parallelSine
		for (size_t k = 0; k < here.size(); ++k) {
			EXPECT_EQ(here[k].id, there[k].id);
			EXPECT_NEAR(here[k].overlap, there[k].overlap, 1e-9);
			EXPECT_LT((rotation * here[k].normal - there[k].normal).norm(), 1e-9);
			EXPECT_LT((rotation * here[k].position + far - there[k].position).norm(), 1e-9);
		}
	}
}

/// A pose moved by 1e-9 m and 1e-9 rad changes an overlap by 1e-9 over the sine of the edges' angle, at least 1e-3.
TEST(Continuity, OverlapFollowsThePose)
{
	Random random(13);
	const auto a = roundedBox({ 1, 0.5, 0.3 }), b = rounded(hexagonalPrismVertices(0.2, 0.9), 0.02);
	int compared = 0;
	for (int trial = 0; trial < 4000; ++trial) {
		const Pose poseB { randomVector(random, 0.6), randomRotation(random) };
		const Pose nearby { poseB.position + 1e-9 * randomDirection(random),
			about(randomDirection(random), 1e-9) * poseB.orientation };
		const auto before = contacts(a, b, {}, poseB), after = contacts(a, b, {}, nearby);
		for (const auto& p : before)
			for (const auto& q : after)
				if (p.id == q.id) {
					EXPECT_NEAR(p.overlap, q.overlap, 1e-5);
					++compared;
				}
	}
	EXPECT_GT(compared, 2000);
}

TEST(Order, SortedByUniqueIds)
{
	const FeatureId id(FeatureKind::EdgeVertex, 5000, 16383);
	EXPECT_EQ(id.kind(), FeatureKind::EdgeVertex);
	EXPECT_EQ(id.a(), 5000);
	EXPECT_EQ(id.b(), 16383);
	const auto points = contacts(
	        roundedBox({ 1, 1, 1 }), roundedBox({ 1, 1, 1 }), {}, { { 0.2, 0.1, 0.999 }, Quat::Identity() });
	EXPECT_EQ(points.size(), 4u); // one vertex of each in the other's face, two crossings
	for (size_t k = 1; k < points.size(); ++k)
		EXPECT_TRUE(points[k - 1].id < points[k].id);
}

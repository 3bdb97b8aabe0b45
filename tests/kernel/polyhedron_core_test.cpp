// SPDX-License-Identifier: GPL-2.0-or-later
/// Half-spaces, rounded cores, and the refusal of what is no convex polyhedron.
#include "topology.hpp"
#include <kernel/constants.hpp>
#include <algorithm>
#include <ctime>
#include <limits>

using namespace timber;
using namespace timber::shapes;

namespace {

/// Sums of some ten products of numbers of order one: rounding only.
constexpr double rounding = 1e-13;

#ifdef __SANITIZE_ADDRESS__
constexpr double slowdown = 50; ///< of instrumented code without optimisation, bound
#else
constexpr double slowdown = 1;
#endif

void expectRefusal(const std::vector<Vec3>& points, const std::string& part)
{
	try {
		Polyhedron::fromVertices(points);
		ADD_FAILURE() << "accepted; expected a refusal with: " << part;
	} catch (const PolyhedronError& error) {
		EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
	}
}

} // namespace

TEST(HalfSpaces, RoundTrip)
{
	for (const auto& points : { boxVertices({ 1, 2, 3 }), tetrahedronVertices(1), octahedronVertices(1),
	             hexagonalPrismVertices(1, 2), hip.vertices(), brace.vertices(), pyramidVertices(1, 2) }) {
		const Polyhedron body = Polyhedron::fromVertices(points), again = intersectionOf(planesOf(body)).body;
		expectCounts(again, body.vertices.size(), body.edges.size(), body.faces.size());
		// Three-plane solves
		EXPECT_NEAR(
		        massProperties(again).volume, massProperties(body).volume, 1e-12 * massProperties(body).volume);
	}
}

TEST(HalfSpaces, RedundantOnes)
{
	auto planes = planesOf(Polyhedron::fromVertices(boxVertices({ 1, 1, 1 })));
	planes.push_back({ Vec3(1, 1, 0).normalized(), 5 }); // misses the body
	planes.push_back({ Vec3(1, 1, 1).normalized(), 1.5 / std::sqrt(3) }); // touches one vertex
	expectCounts(intersectionOf(planes).body, 8, 12, 6);
}

TEST(HalfSpaces, CornersAtTheOrigin)
{
	Random random(8);
	for (int trial = 0; trial < 50; ++trial) {
		// Degree-4 apex at the origin
		const auto points = moved(pyramidVertices(1, 1), Quat::Identity(), { 0, 0, -1 });
		const Polyhedron body = Polyhedron::fromVertices(moved(points, randomRotation(random), Vec3::Zero()));
		expectCounts(intersectionOf(planesOf(body)).body, 5, 8, 5);
	}
}

TEST(HalfSpaces, WithoutVolume)
{
	const auto box = planesOf(Polyhedron::fromVertices(boxVertices({ 1, 1, 1 })));
	for (const double offset : { -2., -0.5 }) { // empty, flat
		auto planes = box;
		planes.push_back({ Vec3(1, 0, 0), offset });
		EXPECT_EQ(intersectionOf(planes).outcome, HullOutcome::NoVolume) << offset;
	}
	// The corners of a plate become one another within the tolerance
	EXPECT_EQ(intersectionOf(planesOf(Polyhedron::fromVertices(boxVertices({ 1, 1, 3e-6 })))).outcome,
	        HullOutcome::NoVolume);
}

TEST(Core, PlanesMoveByTheRadius)
{
	for (const auto& points : { boxVertices({ 1, 2, 3 }), tetrahedronVertices(1), octahedronVertices(1),
	             hexagonalPrismVertices(1, 2), hip.vertices(), brace.vertices(), pyramidVertices(1, 1) }) {
		const RoundedPolyhedron body = rounded(points, 0.004);
		expectCounts(body.core, body.sharp.vertices.size(), body.sharp.edges.size(), body.sharp.faces.size());
		for (const Face& inner : body.core.faces) {
			const auto& faces = body.sharp.faces;
			const auto outer
			        = std::max_element(faces.begin(), faces.end(), [&](const Face& p, const Face& q) {
				          return p.plane.normal.dot(inner.plane.normal)
				                  < q.plane.normal.dot(inner.plane.normal);
			          });
			// Three-plane solves, metre-sized
			EXPECT_NEAR(outer->plane.offset - inner.plane.offset, 0.004, 1e-12);
			EXPECT_NEAR(outer->plane.normal.dot(inner.plane.normal), 1, rounding);
		}
	}
}

TEST(Core, DerivedLengths)
{
	const RoundedPolyhedron column = roundedBox({ 0.105, 0.105, 2.73 });
	EXPECT_NEAR(column.radius, 0.0105, rounding);
	EXPECT_NEAR(column.coreHalfThickness, 0.042, rounding);
	EXPECT_NEAR(column.boundingRadius, Vec3(0.042, 0.042, 1.3545).norm(), rounding);
	EXPECT_NEAR(column.sharp.shortestEdge(), 0.105, rounding);
	EXPECT_NEAR(column.sharp.thickness(), 0.105, rounding);
}

/// Faces of slope 2 h / b that move inwards by r lower the apex by r sqrt(1 + (2 h / b)^2).
TEST(Core, ApexOfFourFaces)
{
	const double base = 1, height = 0.8, r = 0.03;
	const RoundedPolyhedron body = rounded(pyramidVertices(base, height), r);
	expectCounts(body.core, 5, 8, 5);
	double top = 0;
	for (const Vec3& v : body.core.vertices)
		top = std::max(top, v.z());
	EXPECT_NEAR(top, height - r * std::hypot(1, 2 * height / base), 1e-12); // three-plane solves
}

TEST(Core, Invariance)
{
	Random random(9);
	for (int trial = 0; trial < 20; ++trial) {
		const auto points = moved(hip.vertices(), randomRotation(random), 1000 * randomDirection(random));
		expectCounts(rounded(points, 0.01).core, 12, 18, 8);
	}
}

TEST(Core, RadiusTooLargeIsRefused)
{
	for (const double radius : { 0.05, 0.0501, 1. })
		EXPECT_THROW(roundedBox({ 0.1, 1, 1 }, radius), PolyhedronError) << radius;
	EXPECT_NO_THROW(roundedBox({ 0.1, 1, 1 }, 0.0499));
	try {
		roundedBox({ 0.1, 1, 1 }, 0.06);
	} catch (const PolyhedronError& error) {
		EXPECT_NE(std::string(error.what()).find("0.05"), std::string::npos) << error.what();
	}
}

/// Vertices typed to the millimetre, tenth of it and so on make warped faces: no body is refused, no two corners of its
/// core are so close that they would be one contact twice.
TEST(Core, WarpedFaces)
{
	Random random(10);
	for (const double grid : { 1e-3, 1e-4, 1e-5, 1e-6 })
		for (int trial = 0; trial < 60; ++trial) {
			const auto shape = trial % 3 == 0 ? hip.vertices()
			        : trial % 3 == 1          ? brace.vertices()
			                                  : boxVertices({ 0.105, 0.12, 2.73 });
			const auto exact = moved(shape, randomRotation(random), randomVector(random, 3));
			auto typed = exact;
			for (Vec3& p : typed)
				p = (p / grid).array().round() * grid;
			const RoundedPolyhedron body = rounded(typed, 0.004), wanted = rounded(exact, 0.004);
			expectSound(body.core, 1e-3); // warpShare
			EXPECT_GT(body.core.shortestEdge(), 2e-4); // twice flushTolerance
			EXPECT_NEAR(massProperties(body.sharp).volume, massProperties(wanted.sharp).volume,
			        0.06 * grid / 1e-3 * massProperties(wanted.sharp).volume); // 1 mm of 45 mm, both sides
		}
}

TEST(Refusals, SayWhatIsWrong)
{
	const auto box = boxVertices({ 1, 1, 1 });
	auto bad = box;
	bad[3].y() = std::numeric_limits<double>::quiet_NaN();
	expectRefusal(bad, "vertex 3 is not finite");
	bad[3].y() = std::numeric_limits<double>::infinity();
	expectRefusal(bad, "vertex 3 is not finite");
	expectRefusal({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, "at least 4 vertices, got 3");
	expectRefusal({}, "at least 4 vertices, got 0");
	bad = box;
	bad.push_back(box[2]);
	expectRefusal(bad, "vertices 2 and 8 are the same point");
	expectRefusal({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 0.5, 2, 0 } }, "in one plane");
	expectRefusal({ { 0, 0, 0 }, { 1, 1, 1 }, { 2, 2, 2 }, { 3, 3, 3 } }, "in one plane");
	expectRefusal({ { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } }, "same point");
	for (const double scale : { 1e-7, 2e6, 1e200, 1e308 }) // found by fuzzing: products of lengths overflowed
		expectRefusal(boxVertices(Vec3(1, 1, 0.5) * scale), "a polyhedron has 1e-06 to 1e+06 m");
}

TEST(Refusals, PointsThatAreNoCorners)
{
	const auto box = boxVertices({ 1, 1, 1 });
	// Inside, on an edge, on faces
	const std::vector<Vec3> extras { { 0.1, 0.2, 0.3 }, { 0.5, 0.5, 0 }, { 0.5, 0.1, 0.2 }, { 0, 0, 0.5 },
		{ 0.5, 0, 0 } };
	for (const Vec3& extra : extras) {
		auto bad = box;
		bad.push_back(extra);
		expectRefusal(bad, "vertex 8");
		bad = box;
		bad.insert(bad.begin(), extra);
		expectRefusal(bad, "vertex 0");
	}
	auto dented = box; // a vertex pushed in far enough is no corner any more
	dented[0] *= 0.2;
	expectRefusal(dented, "not convex");
}

/// Larger hulls are refused at once; shapes of the largest size are constructed in well below a second.
TEST(Refusals, TooManyVertices)
{
	Random random(12);
	for (const size_t count : { maxVertices + 1, size_t(2000), size_t(20000) })
		expectRefusal(ellipsoidPoints(random, int(count), { 1, 1, 1 }),
		        "at most 64 vertices, got " + std::to_string(count));
	const auto begin = std::clock();
	const auto points = ellipsoidPoints(random, int(maxVertices), { 1, 0.8, 0.6 });
	EXPECT_EQ(Polyhedron::fromVertices(points).vertices.size(), maxVertices);
	std::vector<Eigen::Vector2d> outline;
	for (int k = 0; k < int(maxVertices) / 2; ++k)
		outline.emplace_back(
		        0.3 * std::cos(4 * M_PI * k / maxVertices), 0.3 * std::sin(4 * M_PI * k / maxVertices));
	EXPECT_EQ(rounded(prismVertices(outline, 2)).core.vertices.size(), maxVertices);
	EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC, 0.5 * slowdown); // observed: 0.02 s of processor time
}

/// Plates, needles and slivers below and above the tolerance of 1e-6 of their size, roofs and dents of a cube.
TEST(Refusals, DegenerateHulls)
{
	const auto outcome = [](const std::vector<Vec3>& points) { return tryConvexHull(points, planarShare).outcome; };
	for (const double thin : { 0., 1e-8, 1e-7, 5e-7, 2e-6, 1e-5 }) {
		const HullOutcome expected = thin < planarShare ? HullOutcome::Coplanar : HullOutcome::Sound,
		                  // Half as thick
		        expectedHalf = thin < 4 * planarShare ? HullOutcome::Coplanar : HullOutcome::Sound;
		EXPECT_EQ(outcome(boxVertices({ 1, 1, thin })), expected) << "plate " << thin;
		EXPECT_EQ(outcome(boxVertices({ 1, thin, thin })), expected) << "needle " << thin;
		EXPECT_EQ(outcome({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, thin } }), expectedHalf) << thin;
		EXPECT_EQ(outcome({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, thin, 0 }, { 0.5, thin / 2, 1 } }), expectedHalf)
		        << "sliver " << thin;
		auto roof = boxVertices({ 1, 1, 1 }), dent = roof, warped = roof;
		roof.emplace_back(0, 0, 0.5 + thin);
		const Hull withRoof = tryConvexHull(roof, planarShare);
		EXPECT_EQ(withRoof.outcome, thin < planarShare ? HullOutcome::NoCorner : HullOutcome::Sound) << thin;
		if (thin < planarShare) {
			EXPECT_EQ(withRoof.point, 8u) << thin;
		}
		dent[7] *= 1 - thin; // nearly coplanar faces of the corner that is pushed in, and of one that is raised
		warped[7].z() += thin;
		EXPECT_EQ(outcome(dent), HullOutcome::Sound) << thin;
		EXPECT_EQ(outcome(warped), HullOutcome::Sound) << thin;
	}
}

/// A hull of 64 corners has 124 faces, its core up to 244 corners.
TEST(Core, LargestShapesTakeMilliseconds)
{
	Random random(14);
	const auto begin = std::clock();
	for (int trial = 0; trial < 10; ++trial)
		EXPECT_GE(rounded(ellipsoidPoints(random, int(maxVertices), { 1, 0.8, 0.6 })).core.faces.size(), 60u);
	EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC / 10, 0.1 * slowdown); // observed: 0.02 s
}

/// Just below and just above planarShare (1e-6 of the size): a roof on a face is a superfluous vertex or a corner.
TEST(Refusals, RoofJustBelowAndAboveTheTolerance)
{
	auto points = boxVertices({ 1, 1, 1 });
	points.emplace_back(0, 0, 0.5 + 0.5e-6);
	expectRefusal(points, "vertex 8");
	points.back().z() = 0.5 + 1e-5;
	expectCounts(Polyhedron::fromVertices(points), 9, 16, 9);
}

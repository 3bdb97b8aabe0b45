// SPDX-License-Identifier: GPL-2.0-or-later
/// Topology, volume, inertia, principal axes, half-spaces and cores against closed forms; refusals of bad input.
#include "shapes.hpp"
#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <limits>

using namespace timber;
using namespace timber::shapes;

namespace {

/// Sums of some ten products of numbers of order one: rounding only.
constexpr double rounding = 1e-13;

/// Closed surface, consistent orientation: Euler's formula, unit normals, all vertices inside all planes.
void expectSound(const Polyhedron& body)
{
	EXPECT_EQ(int(body.vertices.size()) - int(body.edges.size()) + int(body.faces.size()), 2);
	Vec3 low = body.vertices[0], high = low;
	for (const Vec3& v : body.vertices) {
		low = low.cwiseMin(v);
		high = high.cwiseMax(v);
	}
	const double tolerance = 1e-6 * (high - low).maxCoeff(); // planarShare: what counts as lying in a plane
	for (const Face& face : body.faces) {
		EXPECT_NEAR(face.plane.normal.norm(), 1, rounding);
		EXPECT_GE(face.corners.size(), 3u);
		for (const Vec3& v : body.vertices)
			EXPECT_LE(face.plane.normal.dot(v), face.plane.offset + tolerance);
	}
	for (const Edge& e : body.edges)
		EXPECT_GT(e.outward.dot(body.faces[e.left].plane.normal), 0);
}

void expectCounts(const Polyhedron& body, size_t vertices, size_t edges, size_t faces)
{
	EXPECT_EQ(body.vertices.size(), vertices);
	EXPECT_EQ(body.edges.size(), edges);
	EXPECT_EQ(body.faces.size(), faces);
	expectSound(body);
}

/// Relative to the size of the numbers: mass properties are sums of a few products.
void expectMass(const std::vector<Vec3>& points, double volume, const Vec3& centroid, const Vec3& moments)
{
	const MassProperties mass = massProperties(Polyhedron::fromVertices(points));
	EXPECT_NEAR(mass.volume, volume, rounding * volume);
	EXPECT_LT((mass.centroid - centroid).norm(), rounding * (1 + centroid.norm()));
	EXPECT_LT((mass.inertia.diagonal() - moments).norm(), 10 * rounding * moments.norm());
	const Mat3 products = mass.inertia - Mat3(mass.inertia.diagonal().asDiagonal());
	EXPECT_LT(products.norm(), 10 * rounding * moments.norm());
}

void expectRefusal(const std::vector<Vec3>& points, const std::string& part)
{
	try {
		Polyhedron::fromVertices(points);
		ADD_FAILURE() << "accepted; expected a refusal with: " << part;
	} catch (const PolyhedronError& error) {
		EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
	}
}

std::vector<HalfSpace> planesOf(const Polyhedron& body)
{
	std::vector<HalfSpace> planes;
	for (const Face& face : body.faces)
		planes.push_back(face.plane);
	return planes;
}

const HipSlab hip { 7.43, 0.3, 0.4, 0.12 };
const Brace brace { 0.805, 2.61, 0.09, 0.045 };

} // namespace

TEST(Topology, CountsOfKnownBodies)
{
	expectCounts(Polyhedron::fromVertices(boxVertices({ 1, 2, 3 })), 8, 12, 6);
	expectCounts(Polyhedron::fromVertices(tetrahedronVertices(1)), 4, 6, 4);
	expectCounts(Polyhedron::fromVertices(octahedronVertices(1)), 6, 12, 8);
	expectCounts(Polyhedron::fromVertices(hexagonalPrismVertices(1, 2)), 12, 18, 8);
	expectCounts(Polyhedron::fromVertices(hip.vertices()), 12, 18, 8);
	expectCounts(Polyhedron::fromVertices(brace.vertices()), 12, 18, 8);
	expectCounts(Polyhedron::fromVertices(pyramidVertices(1, 1)), 5, 8, 5);
}

TEST(Topology, FacesTurnCounterClockwiseAndBordersPointOut)
{
	const Polyhedron body = Polyhedron::fromVertices(hip.vertices());
	for (const Face& face : body.faces)
		for (size_t k = 0; k < face.corners.size(); ++k) {
			const size_t n = face.corners.size();
			const Vec3 &p = body.vertices[face.corners[k]], &q = body.vertices[face.corners[(k + 1) % n]], &r = body.vertices[face.corners[(k + 2) % n]];
			EXPECT_GT((q - p).cross(r - q).dot(face.plane.normal), 0);
			EXPECT_LT(face.outward[k].dot(r - q), 0);
			EXPECT_NEAR(face.outward[k].dot(q - p), 0, rounding * 10); // a few m long
		}
}

TEST(Topology, EdgesJoinTheirTwoFaces)
{
	const Polyhedron body = Polyhedron::fromVertices(brace.vertices());
	for (const Edge& e : body.edges)
		for (const int f : { e.left, e.right }) {
			const auto& corners = body.faces[f].corners;
			EXPECT_NE(std::find(corners.begin(), corners.end(), e.tail), corners.end());
			EXPECT_NE(std::find(corners.begin(), corners.end(), e.head), corners.end());
		}
}

TEST(Topology, RandomHulls)
{
	Random random(1);
	for (int trial = 0; trial < 60; ++trial) {
		const int corners = 4 + trial % 20;
		const Polyhedron body = Polyhedron::fromVertices(ellipsoidPoints(random, corners, { 1, 0.5, 0.3 }));
		EXPECT_EQ(int(body.vertices.size()), corners);
		EXPECT_EQ(body.faces.size(), 2 * body.vertices.size() - 4); // random points: triangles only
		expectSound(body);
	}
}

TEST(Topology, PlatesNeedlesAndSlivers)
{
	for (const Vec3& extents : { Vec3(1, 1, 1e-3), Vec3(1, 1e-3, 1e-3), Vec3(10, 1, 0.01) }) {
		expectCounts(Polyhedron::fromVertices(boxVertices(extents)), 8, 12, 6);
		expectCounts(Polyhedron::fromVertices(moved(boxVertices(extents), about({ 1, 2, 3 }, 1), { 5, 6, 7 })), 8, 12, 6);
	}
	expectCounts(Polyhedron::fromVertices({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 1e-3, 0 }, { 0.5, 0.3e-3, 1e-3 } }), 4, 6, 4);
}

/// Single precision moves vertices by 6e-8 of their coordinates; planarShare (1e-6) forgives that.
TEST(Topology, SinglePrecisionBoxKeepsSixPlaneFaces)
{
	Random random(2);
	for (const Vec3& extents : { Vec3(0.105, 0.105, 2.73), Vec3(8.34, 7.43, 0.2), Vec3(1, 1, 1), Vec3(1, 0.3, 0.01) })
		for (int trial = 0; trial < 50; ++trial) {
			auto points = moved(boxVertices(extents), randomRotation(random), Vec3::Zero());
			for (Vec3& p : points)
				p = p.cast<float>().cast<double>();
			expectCounts(Polyhedron::fromVertices(points), 8, 12, 6);
		}
}

TEST(Mass, Box)
{
	const double a = 0.105, b = 0.12, c = 2.73, v = a * b * c;
	expectMass(boxVertices({ a, b, c }), v, Vec3::Zero(), v / 12 * Vec3(b * b + c * c, a * a + c * c, a * a + b * b));
}

TEST(Mass, RegularSolids)
{
	const double e = 0.7, tetrahedron = e * e * e / (6 * std::sqrt(2.)), octahedron = std::sqrt(2.) / 3 * e * e * e;
	expectMass(tetrahedronVertices(e), tetrahedron, Vec3::Zero(), Vec3::Constant(tetrahedron * e * e / 20));
	expectMass(octahedronVertices(e), octahedron, Vec3::Zero(), Vec3::Constant(octahedron * e * e / 10));
}

TEST(Mass, HexagonalPrism)
{
	const double s = 0.4, h = 1.1, v = 1.5 * std::sqrt(3.) * s * s * h, across = v * (5 * s * s / 24 + h * h / 12);
	expectMass(hexagonalPrismVertices(s, h), v, Vec3::Zero(), { across, across, v * 5 * s * s / 12 });
}

/// Rectangle of the bay without its two corner triangles; symmetric about the bay's centre.
TEST(Mass, BraceVolume)
{
	const MassProperties mass = massProperties(Polyhedron::fromVertices(brace.vertices()));
	const double left = brace.rise - brace.cutZ();
	const double area = brace.run * brace.rise - brace.run / brace.rise * left * left;
	EXPECT_NEAR(mass.volume, area * brace.depth, rounding);
	EXPECT_LT((mass.centroid - Vec3(brace.run / 2, 0, brace.rise / 2)).norm(), 10 * rounding); // few-metre coordinates
}

/// Triangle without its three cut corners, sheared by the slope: shear changes neither volume nor plan centroid.
TEST(Mass, HipSlabVolumeAndCentroid)
{
	const MassProperties mass = massProperties(Polyhedron::fromVertices(hip.vertices()));
	const double w = hip.eave / 2, c = hip.cut, area = w * w - 2 * c * c;
	const double moment = w * w * w / 3 - 2 * (c * c / 2) * c / 3 - c * c * (w - 2 * c / 3);
	EXPECT_NEAR(mass.volume, area * hip.thickness, 100 * rounding); // areas of 14 m2
	EXPECT_LT((mass.centroid - Vec3(0, moment / area, hip.slope * moment / area)).norm(), 100 * rounding);
}

TEST(Mass, RotationAndKilometreTranslation)
{
	Random random(3);
	for (int trial = 0; trial < 20; ++trial) {
		const auto points = ellipsoidPoints(random, 12, { 1, 0.4, 0.2 });
		const MassProperties here = massProperties(Polyhedron::fromVertices(points));
		const Mat3 rotation = randomRotation(random).toRotationMatrix();
		const Vec3 far = 1000 * randomDirection(random);
		const MassProperties there = massProperties(Polyhedron::fromVertices(moved(points, Quat(rotation), far)));
		const double noise = 1e-11; // vertices at 1 km are rounded to 1e-13 m; relative to a width of 0.2 m
		EXPECT_NEAR(there.volume, here.volume, noise * here.volume);
		EXPECT_LT((there.centroid - rotation * here.centroid - far).norm(), noise);
		EXPECT_LT((there.inertia - rotation * here.inertia * rotation.transpose()).norm(), noise * here.inertia.norm());
	}
}

/// A plane cuts a body in two: volumes, first moments and inertias (about one point) of the parts add up.
TEST(Mass, PartsAddUp)
{
	Random random(4);
	const auto aboutOrigin = [](const MassProperties& m) {
		return Mat3(m.inertia + m.volume * (m.centroid.squaredNorm() * Mat3::Identity() - m.centroid * m.centroid.transpose()));
	};
	for (int trial = 0; trial < 30; ++trial) {
		const Polyhedron whole = Polyhedron::fromVertices(ellipsoidPoints(random, 10 + trial % 6, { 1, 0.7, 0.5 }));
		const MassProperties mass = massProperties(whole);
		const Vec3 normal = randomDirection(random);
		auto upper = planesOf(whole), lower = upper;
		upper.push_back({ -normal, -normal.dot(mass.centroid) });
		lower.push_back({ normal, normal.dot(mass.centroid) });
		const MassProperties u = massProperties(Polyhedron::fromHalfSpaces(upper)), l = massProperties(Polyhedron::fromHalfSpaces(lower));
		const double noise = 1e-5; // corners closer than 4e-6 of the size are merged by fromHalfSpaces
		EXPECT_NEAR(u.volume + l.volume, mass.volume, noise * mass.volume);
		EXPECT_LT((u.volume * u.centroid + l.volume * l.centroid - mass.volume * mass.centroid).norm(), noise * mass.volume);
		EXPECT_LT((aboutOrigin(u) + aboutOrigin(l) - aboutOrigin(mass)).norm(), noise * mass.inertia.norm());
	}
}

TEST(Mass, MonteCarlo)
{
	Random random(5);
	const Polyhedron body = Polyhedron::fromVertices(ellipsoidPoints(random, 14, { 1, 0.8, 0.6 }));
	const MassProperties mass = massProperties(body);
	const int samples = 200000;
	const double cell = 2 * 1.6 * 1.2 / samples;
	double volume = 0;
	Mat3 inertia = Mat3::Zero();
	for (int k = 0; k < samples; ++k) {
		const Vec3 x = randomVector(random, 1).cwiseProduct(Vec3(1, 0.8, 0.6));
		if (std::any_of(body.faces.begin(), body.faces.end(), [&](const Face& f) { return f.plane.normal.dot(x) > f.plane.offset; })) continue;
		const Vec3 r = x - mass.centroid;
		volume += cell;
		inertia += cell * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
	}
	const double share = mass.volume / (2 * 1.6 * 1.2), deviation = std::sqrt((1 - share) / (share * samples));
	EXPECT_NEAR(volume, mass.volume, 4 * deviation * mass.volume); // sampling error, four standard deviations
	EXPECT_LT((inertia - mass.inertia).norm(), 6 * deviation * mass.inertia.norm()); // the outer samples weigh more
}

TEST(PrincipalAxes, IdentityForAlignedBoxAndForCube)
{
	for (const Vec3& extents : { Vec3(1, 2, 3), Vec3(3, 2, 1), Vec3(0.105, 0.105, 2.73), Vec3(1, 1, 1) })
		EXPECT_EQ(principalAxes(massProperties(Polyhedron::fromVertices(boxVertices(extents))).inertia), Mat3::Identity());
	const auto turnedCube = moved(boxVertices({ 1, 1, 1 }), about({ 1, 2, 3 }, 0.7), Vec3::Zero());
	EXPECT_EQ(principalAxes(massProperties(Polyhedron::fromVertices(turnedCube)).inertia), Mat3::Identity());
}

TEST(PrincipalAxes, RightHandedAndDiagonal)
{
	Random random(6);
	for (int trial = 0; trial < 300; ++trial) {
		const Mat3 inertia = massProperties(Polyhedron::fromVertices(ellipsoidPoints(random, 8, { 1, 0.5, 0.3 }))).inertia;
		const Mat3 axes = principalAxes(inertia);
		EXPECT_NEAR(axes.determinant(), 1, rounding);
		EXPECT_LT((axes.transpose() * axes - Mat3::Identity()).norm(), 10 * rounding); // orthonormality of the solver
		const Mat3 inside = axes.transpose() * inertia * axes;
		EXPECT_LT((inside - Mat3(inside.diagonal().asDiagonal())).norm(), 10 * rounding * inertia.norm());
	}
}

/// No other order or sign of the same axes is a rotation by a smaller angle (a larger trace).
TEST(PrincipalAxes, ClosestToTheGivenAxes)
{
	Random random(7);
	for (int trial = 0; trial < 300; ++trial) {
		const Mat3 turn = randomRotation(random).toRotationMatrix();
		const Mat3 axes = principalAxes(turn * Vec3(1, 2, 3).asDiagonal() * turn.transpose());
		std::array<int, 3> order { 0, 1, 2 };
		do
			for (int signs = 0; signs < 8; ++signs) {
				Mat3 other;
				for (int k = 0; k < 3; ++k)
					other.col(k) = axes.col(order[k]) * (signs >> k & 1 ? -1 : 1);
				if (other.determinant() < 0) continue;
				EXPECT_LE(other.trace(), axes.trace() + rounding);
			}
		while (std::next_permutation(order.begin(), order.end()));
	}
}

TEST(HalfSpaces, RoundTrip)
{
	for (const auto& points : { boxVertices({ 1, 2, 3 }), tetrahedronVertices(1), octahedronVertices(1), hexagonalPrismVertices(1, 2), hip.vertices(), brace.vertices(), pyramidVertices(1, 2) }) {
		const Polyhedron body = Polyhedron::fromVertices(points), again = Polyhedron::fromHalfSpaces(planesOf(body));
		expectCounts(again, body.vertices.size(), body.edges.size(), body.faces.size());
		EXPECT_NEAR(massProperties(again).volume, massProperties(body).volume, 1e-12 * massProperties(body).volume); // three-plane solves
	}
}

TEST(HalfSpaces, RedundantAndUnnormalisedOnes)
{
	auto planes = planesOf(Polyhedron::fromVertices(boxVertices({ 1, 1, 1 })));
	planes.push_back({ Vec3(1, 1, 0), 5 }); // misses the body
	planes.push_back({ Vec3(2, 0, 0), 1 }); // the plane x = 0.5 again
	planes.push_back({ Vec3(1, 1, 1) * 3, 4.5 }); // touches one vertex
	expectCounts(Polyhedron::fromHalfSpaces(planes), 8, 12, 6);
}

TEST(HalfSpaces, CornersAtTheOrigin)
{
	Random random(8);
	for (int trial = 0; trial < 50; ++trial) {
		const auto points = moved(pyramidVertices(1, 1), Quat::Identity(), { 0, 0, -1 }); // degree-4 apex at the origin
		const Polyhedron body = Polyhedron::fromVertices(moved(points, randomRotation(random), Vec3::Zero()));
		expectCounts(Polyhedron::fromHalfSpaces(planesOf(body)), 5, 8, 5);
	}
}

TEST(HalfSpaces, Refusals)
{
	const auto box = planesOf(Polyhedron::fromVertices(boxVertices({ 1, 1, 1 })));
	auto unbounded = box;
	unbounded.pop_back();
	EXPECT_THROW(Polyhedron::fromHalfSpaces(unbounded), PolyhedronError);
	auto empty = box;
	empty.push_back({ Vec3(1, 0, 0), -2 });
	EXPECT_THROW(Polyhedron::fromHalfSpaces(empty), PolyhedronError);
	auto flat = box;
	flat.push_back({ Vec3(1, 0, 0), -0.5 });
	EXPECT_THROW(Polyhedron::fromHalfSpaces(flat), PolyhedronError);
	auto bad = box;
	bad.push_back({ Vec3::Zero(), 1 });
	EXPECT_THROW(Polyhedron::fromHalfSpaces(bad), PolyhedronError);
	bad.back() = { Vec3(1, 0, 0), std::numeric_limits<double>::quiet_NaN() };
	EXPECT_THROW(Polyhedron::fromHalfSpaces(bad), PolyhedronError);
	EXPECT_THROW(Polyhedron::fromHalfSpaces({}), PolyhedronError);
}

TEST(HalfSpaces, OpenPrismAndHalfSpaceAreUnbounded)
{
	const Polyhedron prism = Polyhedron::fromVertices(hexagonalPrismVertices(1, 2));
	std::vector<HalfSpace> open;
	for (const Face& face : prism.faces)
		if (face.plane.normal.z() < 0.5) open.push_back(face.plane);
	EXPECT_THROW(Polyhedron::fromHalfSpaces(open), PolyhedronError);
	EXPECT_THROW(Polyhedron::fromHalfSpaces({ { Vec3(0, 0, 1), 1 } }), PolyhedronError);
	auto tilted = planesOf(Polyhedron::fromVertices(pyramidVertices(1, 1))); // without its base: a cone downwards
	tilted.erase(std::remove_if(tilted.begin(), tilted.end(), [](const HalfSpace& h) { return h.normal.z() < -0.5; }), tilted.end());
	EXPECT_THROW(Polyhedron::fromHalfSpaces(tilted), PolyhedronError);
}

TEST(Core, PlanesMoveByTheRadius)
{
	for (const auto& points : { boxVertices({ 1, 2, 3 }), tetrahedronVertices(1), octahedronVertices(1), hexagonalPrismVertices(1, 2), hip.vertices(), brace.vertices(), pyramidVertices(1, 1) }) {
		const RoundedPolyhedron body = rounded(points, 0.004);
		expectCounts(body.core, body.sharp.vertices.size(), body.sharp.edges.size(), body.sharp.faces.size());
		for (const Face& inner : body.core.faces) {
			const auto& faces = body.sharp.faces;
			const auto outer = std::max_element(faces.begin(), faces.end(), [&](const Face& p, const Face& q) { return p.plane.normal.dot(inner.plane.normal) < q.plane.normal.dot(inner.plane.normal); });
			EXPECT_NEAR(outer->plane.offset - inner.plane.offset, 0.004, 1e-12); // three-plane solves, metre-sized
			EXPECT_NEAR(outer->plane.normal.dot(inner.plane.normal), 1, rounding);
		}
	}
}

TEST(Core, DerivedLengths)
{
	const RoundedPolyhedron column = roundedBox({ 0.105, 0.105, 2.73 });
	EXPECT_NEAR(column.radius, 0.0105, rounding);
	EXPECT_NEAR(column.coreHalfThickness, 0.042, rounding);
	EXPECT_NEAR(column.reach, Vec3(0.042, 0.042, 1.3545).norm(), rounding);
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
}

TEST(Refusals, PointsThatAreNoCorners)
{
	const auto box = boxVertices({ 1, 1, 1 });
	const std::vector<Vec3> extras { { 0.1, 0.2, 0.3 }, { 0.5, 0.5, 0 }, { 0.5, 0.1, 0.2 }, { 0, 0, 0.5 }, { 0.5, 0, 0 } }; // inside, on an edge, on faces
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

/// Just below and just above planarShare (1e-6 of the size): a roof on a face is a superfluous vertex or a corner.
TEST(Refusals, RoofJustBelowAndAboveTheTolerance)
{
	auto points = boxVertices({ 1, 1, 1 });
	points.emplace_back(0, 0, 0.5 + 0.5e-6);
	expectRefusal(points, "vertex 8");
	points.back().z() = 0.5 + 1e-5;
	expectCounts(Polyhedron::fromVertices(points), 9, 16, 9);
}

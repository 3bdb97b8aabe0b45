// SPDX-License-Identifier: GPL-2.0-or-later
/// Topology, volume, inertia and principal axes against closed forms.
#include "topology.hpp"
#include <algorithm>
#include <array>

using namespace timber;
using namespace timber::shapes;

namespace {

/// Sums of some ten products of numbers of order one: rounding only.
constexpr double rounding = 1e-13;

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

TEST(Topology, FacesTurnCounterClockwiseAndSidePlanesPointOut)
{
	const Polyhedron body = Polyhedron::fromVertices(hip.vertices());
	for (const Face& face : body.faces)
		for (size_t k = 0; k < face.corners.size(); ++k) {
			const size_t n = face.corners.size();
			const Vec3 &p = body.vertices[face.corners[k]], &q = body.vertices[face.corners[(k + 1) % n]],
			           &r = body.vertices[face.corners[(k + 2) % n]];
			EXPECT_GT((q - p).cross(r - q).dot(face.plane.normal), 0);
			EXPECT_LT(face.sidePlanes[k].normal.dot(r - q), 0);
			EXPECT_NEAR(face.sidePlanes[k].normal.dot(q - p), 0, rounding * 10); // a few m long
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
		expectCounts(Polyhedron::fromVertices(moved(boxVertices(extents), about({ 1, 2, 3 }, 1), { 5, 6, 7 })),
		        8, 12, 6);
	}
	expectCounts(Polyhedron::fromVertices({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 1e-3, 0 }, { 0.5, 0.3e-3, 1e-3 } }), 4,
	        6, 4);
}

/// Single precision moves vertices by 6e-8 of their coordinates; planarShare (1e-6) forgives that.
TEST(Topology, SinglePrecisionBoxKeepsSixPlaneFaces)
{
	Random random(2);
	for (const Vec3& extents :
	        { Vec3(0.105, 0.105, 2.73), Vec3(8.34, 7.43, 0.2), Vec3(1, 1, 1), Vec3(1, 0.3, 0.01) })
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
	expectMass(
	        boxVertices({ a, b, c }), v, Vec3::Zero(), v / 12 * Vec3(b * b + c * c, a * a + c * c, a * a + b * b));
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
	// Few-metre coordinates
	EXPECT_LT((mass.centroid - Vec3(brace.run / 2, 0, brace.rise / 2)).norm(), 10 * rounding);
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
		const MassProperties there
		        = massProperties(Polyhedron::fromVertices(moved(points, Quat(rotation), far)));
		const double noise = 1e-11; // vertices at 1 km are rounded to 1e-13 m; relative to a width of 0.2 m
		EXPECT_NEAR(there.volume, here.volume, noise * here.volume);
		EXPECT_LT((there.centroid - rotation * here.centroid - far).norm(), noise);
		EXPECT_LT((there.inertia - rotation * here.inertia * rotation.transpose()).norm(),
		        noise * here.inertia.norm());
	}
}

/// A plane cuts a body in two: volumes, first moments and inertias (about one point) of the parts add up.
TEST(Mass, PartsAddUp)
{
	Random random(4);
	const auto aboutOrigin = [](const MassProperties& m) {
		return Mat3(m.inertia
		        + m.volume
		                * (m.centroid.squaredNorm() * Mat3::Identity() - m.centroid * m.centroid.transpose()));
	};
	for (int trial = 0; trial < 30; ++trial) {
		const Polyhedron whole
		        = Polyhedron::fromVertices(ellipsoidPoints(random, 10 + trial % 6, { 1, 0.7, 0.5 }));
		const MassProperties mass = massProperties(whole);
		const Vec3 normal = randomDirection(random);
		auto upper = planesOf(whole), lower = upper;
		upper.push_back({ -normal, -normal.dot(mass.centroid) });
		lower.push_back({ normal, normal.dot(mass.centroid) });
		const MassProperties u = massProperties(intersectionOf(upper).body),
		                     l = massProperties(intersectionOf(lower).body);
		const double noise = 1e-5; // corners closer than 4e-6 of the size are merged
		EXPECT_NEAR(u.volume + l.volume, mass.volume, noise * mass.volume);
		EXPECT_LT((u.volume * u.centroid + l.volume * l.centroid - mass.volume * mass.centroid).norm(),
		        noise * mass.volume);
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
		if (std::any_of(body.faces.begin(), body.faces.end(),
		            [&](const Face& f) { return f.plane.normal.dot(x) > f.plane.offset; }))
			continue;
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
		EXPECT_EQ(principalAxes(massProperties(Polyhedron::fromVertices(boxVertices(extents))).inertia),
		        Mat3::Identity());
	const auto turnedCube = moved(boxVertices({ 1, 1, 1 }), about({ 1, 2, 3 }, 0.7), Vec3::Zero());
	EXPECT_EQ(principalAxes(massProperties(Polyhedron::fromVertices(turnedCube)).inertia), Mat3::Identity());
}

TEST(PrincipalAxes, RightHandedAndDiagonal)
{
	Random random(6);
	for (int trial = 0; trial < 300; ++trial) {
		const Mat3 inertia
		        = massProperties(Polyhedron::fromVertices(ellipsoidPoints(random, 8, { 1, 0.5, 0.3 }))).inertia;
		const Mat3 axes = principalAxes(inertia);
		EXPECT_NEAR(axes.determinant(), 1, rounding);
		// Orthonormality of the solver
		EXPECT_LT((axes.transpose() * axes - Mat3::Identity()).norm(), 10 * rounding);
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

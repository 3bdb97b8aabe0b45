// SPDX-License-Identifier: GPL-2.0-or-later
/// Flush members: vertices lie exactly above borders of faces. ContactKinds::flushSupports decides these contacts, not
/// rounding.
#include "shapes.hpp"
#include <gtest/gtest.h>

using namespace timber;
using namespace timber::shapes;

namespace {

constexpr double press = 1e-3; ///< overlap of the resting pairs [m]
const ContactKinds supported { false, true }, unsupported { false, false };

/// A column of the beam's width stands on the beam: its four vertices are exactly above two edges of the beam.
struct FlushColumn {
	RoundedPolyhedron beam = roundedBox({ 3, 0.105, 0.12 }), column = roundedBox({ 0.105, 0.105, 2.73 });
	Pose onBeam(double alongY = 0) const { return { { 0.2, alongY, 0.06 + 1.365 - press }, Quat::Identity() }; }
};

Pose noisy(const Pose& pose, Random& random, double size)
{
	return { pose.position + randomVector(random, size), about(randomDirection(random), size) * pose.orientation };
}

} // namespace

TEST(FlushColumn, FourPointsOrNoneByRule)
{
	const FlushColumn pair;
	const auto points = contacts(pair.beam, pair.column, {}, pair.onBeam(), supported);
	EXPECT_EQ(points.size(), 4u);
	for (const auto& p : points) {
		EXPECT_NEAR(p.overlap, press, 1e-13); // rounding at positions of metres
		EXPECT_NEAR(p.normal.z(), 1, 1e-13);
		EXPECT_NEAR(std::abs(p.position.y()), 0.042, 1e-13);
	}
	EXPECT_TRUE(contacts(pair.beam, pair.column, {}, pair.onBeam(), unsupported).empty());
	EXPECT_EQ(contacts(pair.column, pair.beam, pair.onBeam(), {}, supported).size(), 4u);
	EXPECT_TRUE(contacts(pair.column, pair.beam, pair.onBeam(), {}, unsupported).empty());
}

/// Vertex-edge contacts replace the support by the face if that is off, and add nothing if it is on.
TEST(FlushColumn, VertexEdgePatternReplacesFaceSupport)
{
	const FlushColumn pair;
	const auto points = contacts(pair.beam, pair.column, {}, pair.onBeam(), { true, false });
	EXPECT_EQ(count(points, FeatureKind::EdgeVertex), 4);
	EXPECT_EQ(points.size(), 4u);
	EXPECT_EQ(
	        count(contacts(pair.beam, pair.column, {}, pair.onBeam(), { true, true }), FeatureKind::FaceVertex), 4);
	EXPECT_EQ(contacts(pair.beam, pair.column, {}, pair.onBeam(), { true, true }).size(), 4u);
}

TEST(FlushColumn, CountSurvivesNoiseAndPlacement)
{
	const FlushColumn pair;
	Random random(21);
	for (int trial = 0; trial < 300; ++trial) {
		const double noise = trial < 100 ? 1e-12 : trial < 200 ? 1e-9 : 1e-6; // all far below flushTolerance
		const Quat rotation = randomRotation(random);
		const Vec3 far = 1000 * randomDirection(random);
		const Pose beam = carried(noisy({}, random, noise), rotation, far),
		           column = carried(noisy(pair.onBeam(), random, noise), rotation, far);
		EXPECT_EQ(contacts(pair.beam, pair.column, beam, column, supported).size(), 4u);
		EXPECT_EQ(contacts(pair.beam, pair.column, beam, column, unsupported).size(), 0u);
		EXPECT_EQ(contacts(pair.column, pair.beam, column, beam, supported).size(), 4u);
	}
}

/// Slid across the beam: the two vertices beyond the border lose contact after flushTolerance (0.1 mm). The column's
/// edges cross the border of the beam instead, so that four points remain. Vertices inside the border are in contact
/// with both settings.
TEST(FlushColumn, SlidAcrossTheBorder)
{
	const FlushColumn pair;
	for (const double slide : { 2e-5, 9e-5 }) {
		EXPECT_EQ(count(contacts(pair.beam, pair.column, {}, pair.onBeam(slide), supported),
		                  FeatureKind::FaceVertex),
		        4);
		EXPECT_EQ(contacts(pair.beam, pair.column, {}, pair.onBeam(slide), unsupported).size(), 0u);
	}
	for (const double slide : { 1.1e-4, 1e-3, 1e-2 })
		for (const ContactKinds& kinds : { supported, unsupported }) {
			const auto points = contacts(pair.beam, pair.column, {}, pair.onBeam(slide), kinds);
			EXPECT_EQ(count(points, FeatureKind::FaceVertex), 2) << slide;
			EXPECT_EQ(count(points, FeatureKind::EdgeEdge), 2) << slide;
			EXPECT_EQ(points.size(), 4u);
		}
}

/// All vertices coincide: one point per corner, for both orders of the bodies and any rounding errors.
TEST(CoincidentVertices, StackOfEqualBoxes)
{
	const auto cube = roundedBox({ 1, 1, 1 });
	const Pose onTop { { 0, 0, 1 - press }, Quat::Identity() };
	Random random(22);
	for (int trial = 0; trial < 200; ++trial) {
		const Quat rotation = randomRotation(random);
		const Vec3 far = 1000 * randomDirection(random);
		const Pose lower = carried(noisy({}, random, 1e-12), rotation, far),
		           upper = carried(noisy(onTop, random, 1e-12), rotation, far);
		EXPECT_EQ(contacts(cube, cube, lower, upper, supported).size(), 4u);
		EXPECT_EQ(contacts(cube, cube, upper, lower, supported).size(), 4u);
		EXPECT_EQ(contacts(cube, cube, lower, upper, unsupported).size(), 0u);
		EXPECT_EQ(contacts(cube, cube, lower, upper, { true, true }).size(), 4u);
	}
}

/// Without flushSupports, the extra kinds give the same four corners, once each.
TEST(CoincidentVertices, ExtraPatternsCountEachCornerOnce)
{
	const auto cube = roundedBox({ 1, 1, 1 });
	const auto points = contacts(cube, cube, {}, { { 0, 0, 1 - press }, Quat::Identity() }, { true, false });
	EXPECT_EQ(points.size(), 4u);
	for (const auto& p : points)
		EXPECT_NEAR(p.overlap, press, 1e-13); // rounding at positions of metres
}

/// A bar on its edge at the border of a box: its ends are in contact with the top of the box, and the corners of the
/// box with the side of the bar. The positions coincide, the normals differ: both are contacts.
TEST(CoincidentVertices, TwoNormalsAreTwoContacts)
{
	const auto box = roundedBox({ 1, 1, 1 }, 0.001), bar = roundedBox({ 0.1, 1, 0.1 }, 0.001);
	// Of the bar's core edge, from the box's
	const double inside = 1e-4, above = 5e-5, half = 0.049 * std::sqrt(2.);
	const auto points = contacts(
	        box, bar, {}, { { 0.499 - inside, 0, 0.499 + above + half }, about(Vec3::UnitY(), M_PI / 4) });
	EXPECT_EQ(count(points, FeatureKind::VertexFace), 2);
	EXPECT_EQ(count(points, FeatureKind::FaceVertex), 2);
	EXPECT_EQ(points.size(), 4u);
	for (const auto& p : points) {
		const bool side = p.id.kind() == FeatureKind::VertexFace;
		// Rounding at positions of metres
		EXPECT_NEAR(p.overlap, 0.002 - (side ? (inside + above) / std::sqrt(2.) : above), 1e-13);
		EXPECT_NEAR(p.normal.z(), side ? std::sqrt(0.5) : 1, 1e-13);
		EXPECT_LT((p.position - points[0].position).cwiseProduct(Vec3(1, 0, 1)).norm(), 2e-4);
	}
}

/// Corner of a core exactly on a corner: the shortest connection has no direction. The point of the cores has that of a
/// separating axis.
TEST(CoincidentVertices, CornerExactlyOnCorner)
{
	const auto cube = roundedBox({ 1, 1, 1 }, 0.125);
	const auto points = contacts(cube, cube, {}, { Vec3::Constant(0.75), Quat::Identity() }, { true, false });
	ASSERT_EQ(points.size(), 1u);
	EXPECT_EQ(points[0].id.kind(), FeatureKind::CoreCore);
	EXPECT_EQ(points[0].overlap, 0.25);
}

/// Equal boxes displaced along one side by less and more than the tolerance: always four points.
TEST(CoincidentVertices, SlidAlongOneSide)
{
	const auto cube = roundedBox({ 1, 1, 1 });
	for (const double slide : { 0., 5e-5, 9.9e-5, 1.5e-4, 3e-4, 0.1 })
		for (const double sign : { -1., 1. })
			EXPECT_EQ(contacts(cube, cube, {}, { { sign * slide, 0, 1 - press }, Quat::Identity() },
			                  supported)
			                  .size(),
			        4u)
			        << slide;
}

/// Displaced along the diagonal: one vertex of each box, two crossings.
TEST(CoincidentVertices, SlidAlongTheDiagonal)
{
	const auto cube = roundedBox({ 1, 1, 1 });
	for (const double slide : { 0., 5e-5, 9.9e-5, 1.5e-4, 3e-4, 0.1 })
		EXPECT_EQ(contacts(cube, cube, {}, { { slide, slide, 1 - press }, Quat::Identity() }, supported).size(),
		        4u)
		        << slide;
}

/// Zero overlap: no point, or one of rounding size; overlap 1e-9 m: all points.
TEST(FlushFaces, TouchingWithoutOverlap)
{
	const auto cube = roundedBox({ 1, 1, 1 });
	const Pose apart { { 0.1, 0.1, 1 + 1e-12 }, Quat::Identity() },
	        pressed { { 0.1, 0.1, 1 - 1e-9 }, Quat::Identity() };
	EXPECT_TRUE(contacts(cube, cube, {}, apart).empty());
	EXPECT_EQ(contacts(cube, cube, {}, pressed).size(), 4u);
	for (const auto& p : contacts(cube, cube, {}, { { 0.1, 0.1, 1 }, Quat::Identity() })) {
		EXPECT_GT(p.overlap, 0);
		EXPECT_LT(p.overlap, 1e-13); // rounding at positions of metres
	}
}

/// A floor beside a flush beam: the same number of points on both sides.
TEST(FlushFaces, PanelBesideBeamHasFourPoints)
{
	const auto beam = roundedBox({ 3, 0.105, 0.12 }), floor = roundedBox({ 3, 2, 0.2 });
	for (const double side : { -1., 1. }) { // tops flush, ends flush, floor lower than the beam's bottom
		const Pose beside { { 0, side * (0.0525 + 1 - press), -0.04 }, Quat::Identity() };
		const auto points = contacts(beam, floor, {}, beside);
		EXPECT_EQ(points.size(), 4u);
		for (const auto& p : points) {
			EXPECT_NEAR(p.normal.y(), side, 1e-13);
			EXPECT_NEAR(p.overlap, press, 1e-13); // rounding at positions of metres
		}
	}
}

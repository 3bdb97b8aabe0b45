// SPDX-License-Identifier: GPL-2.0-or-later
/// Overlapping cores, as after an impact: the overlap is bounded, and a displacement along the normals separates the
/// pair.
#include "shapes.hpp"
#include <kernel/separating_axis.hpp>
#include <algorithm>
#include <gtest/gtest.h>

using namespace timber;
using namespace timber::shapes;

namespace {

double gapOf(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseB)
{
	Vec3 axis;
	return coreGap(a.core, b.core, poseB.orientation.toRotationMatrix(), poseB.position, axis);
}

/// Overlap of feature points: at most the contact distance plus half the core. Overlap of the core point: that of the
/// cores.
void expectBounded(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseB,
        const std::vector<ContactPoint>& points)
{
	const double touch = a.radius + b.radius, half = std::max(a.coreHalfThickness, b.coreHalfThickness);
	const double depth = -gapOf(a, b, poseB) + 1e-12; // the same support function, rounding only
	for (const auto& p : points) {
		EXPECT_GT(p.overlap, 0);
		EXPECT_LE(p.overlap, touch + (p.id.kind() == FeatureKind::CoreCore ? depth : half));
		EXPECT_NEAR(p.normal.norm(), 1, 1e-12); // products of unit vectors and rotations
	}
}

/// Moves B in steps of `step` along the mean push until the cores separate; returns the number of steps, or -1.
int stepsToPart(const RoundedPolyhedron& a, const RoundedPolyhedron& b, Pose poseB, double step, int most)
{
	for (int k = 0; k < most; ++k) {
		if (gapOf(a, b, poseB) >= 0) return k;
		const auto points = contacts(a, b, {}, poseB);
		expectBounded(a, b, poseB, points);
		Vec3 push = Vec3::Zero();
		for (const auto& p : points)
			push += p.overlap * p.normal;
		if (push.norm() == 0) return -1;
		poseB.position += step * push.normalized();
	}
	return -1;
}

} // namespace

/// The four overlaps are continuous where the cores touch (overlap 0.1 m).
TEST(DeepOverlap, FaceOnFaceGrowsOn)
{
	const auto a = roundedBox({ 1, 1, 1 }), b = roundedBox({ 0.4, 0.4, 0.4 });
	for (const double overlap : { 0.01, 0.1399, 0.14, 0.1401, 0.2, 0.27 }) {
		const auto points = contacts(a, b, {}, { { 0.05, 0.1, 0.7 - overlap }, Quat::Identity() });
		ASSERT_GE(points.size(), 4u) << overlap;
		EXPECT_EQ(count(points, FeatureKind::FaceVertex), 4);
		for (const auto& p : points) {
			EXPECT_NEAR(p.overlap, overlap, 1e-13); // rounding at positions of metres
			EXPECT_NEAR(p.normal.z(), 1, 1e-13);
		}
	}
}

TEST(DeepOverlap, FlushFacesStayBoundedAndOutward)
{
	const auto cube = roundedBox({ 1, 1, 1 });
	for (const double overlap : { 0.19, 0.199, 0.19995, 0.201, 0.25, 0.4 }) {
		const Pose pose { { 0, 0, 1 - overlap }, Quat::Identity() };
		const auto points = contacts(cube, cube, {}, pose);
		ASSERT_FALSE(points.empty()) << overlap;
		for (const auto& p : points) {
			EXPECT_NEAR(p.overlap, overlap, 1e-13); // rounding at positions of metres
			EXPECT_NEAR(p.normal.z(), 1, 1e-13);
		}
	}
}

TEST(DeepOverlap, SmallBoxInsideALargeOneLeavesByTheNearestFace)
{
	const auto large = roundedBox({ 1, 1, 1 }), small = roundedBox({ 0.1, 0.1, 0.1 });
	const Vec3 inside(0.05, 0.25, -0.1);
	const auto points = contacts(large, small, {}, { inside, Quat::Identity() });
	EXPECT_EQ(points.size(), 8u);
	for (const auto& p : points)
		EXPECT_NEAR(p.normal.y(), 1, 1e-13); // a face normal, rounding only
	EXPECT_GE(stepsToPart(large, small, { inside, Quat::Identity() }, 1e-3, 1000), 0);
	EXPECT_GE(stepsToPart(small, large, { -inside, Quat::Identity() }, 1e-3, 1000), 0);
}

/// No vertex is inside the other body and no edges cross: one point along the axis of least overlap.
TEST(DeepOverlap, PlatesThroughEachOther)
{
	const auto plate = roundedBox({ 1, 1, 0.02 });
	for (const double angle : { 0.4, 1., M_PI / 2 }) {
		const Pose crossing { { 0.02, 0, 0.03 }, about({ 0, 1, 0 }, angle) };
		const auto points = contacts(plate, plate, {}, crossing);
		ASSERT_FALSE(points.empty()) << angle;
		EXPECT_GE(stepsToPart(plate, plate, crossing, 1e-3, 2000), 0) << angle;
	}
}

TEST(DeepOverlap, CorePointPartsThePairInOneMove)
{
	const auto plate = roundedBox({ 1, 1, 0.02 });
	const Pose crossing { { 0.02, 0, 0.03 }, about({ 0.1, 1, 0.2 }, 1.4) };
	const auto points = contacts(plate, plate, {}, crossing);
	ASSERT_EQ(points.size(), 1u);
	EXPECT_EQ(points[0].id.kind(), FeatureKind::CoreCore);
	const double depth = points[0].overlap - 2 * plate.radius;
	EXPECT_NEAR(depth, -gapOf(plate, plate, crossing), 1e-13); // the same support function, rounding only
	EXPECT_LT(
	        gapOf(plate, plate, { crossing.position + 0.99 * depth * points[0].normal, crossing.orientation }), 0);
	EXPECT_GE(
	        gapOf(plate, plate, { crossing.position + 1.000001 * depth * points[0].normal, crossing.orientation }),
	        0);
}

/// A block penetrates the top of a ridge with undercut sides. Two of its vertices leave the ridge through the side:
/// they project onto the top and are below its plane, but outside the ridge. They are not in contact.
TEST(DeepOverlap, NoContactOfAVertexOutsideTheBody)
{
	// Of the core's slope of 45 degrees at that depth
	const double radius = 0.01, depth = 0.05, side = 0.5 - radius * (1 + M_SQRT2) - depth;
	const auto ridge
	        = rounded(prismVertices({ { -0.5, 0 }, { -0.1, -0.4 }, { 0.1, -0.4 }, { 0.5, 0 } }, 1), radius);
	const auto block = roundedBox({ 0.2 + 2 * radius, 0.3, 0.3 }, radius);
	for (const double out : { -0.02, 0.02 }) {
		const auto points = contacts(
		        ridge, block, {}, { { side + out - 0.1, 0.15 - 2 * radius - depth, 0 }, Quat::Identity() });
		EXPECT_EQ(count(points, FeatureKind::FaceVertex), out > 0 ? 2 : 4);
		EXPECT_EQ(points.size(), out > 0 ? 2u : 4u);
		for (const auto& p : points) {
			EXPECT_NEAR(p.overlap, 2 * radius + depth, 1e-13); // rounding at positions of metres
			EXPECT_NEAR(p.normal.y(), 1, 1e-13);
			if (out > 0) {
				EXPECT_NEAR(p.position.x(), side + out - 0.2, 1e-13);
			}
		}
	}
}

/// Crossed beams from first contact to more than half their depth: always pushed upwards.
TEST(DeepOverlap, CrossedBeams)
{
	const auto beam = roundedBox({ 3, 0.12, 0.12 });
	const Quat across = about({ 0, 0, 1 }, M_PI / 2);
	for (double overlap = 0.001; overlap < 0.11; overlap += 0.001) {
		const auto points = contacts(beam, beam, {}, { { 0, 0, 0.12 - overlap }, across });
		ASSERT_FALSE(points.empty()) << overlap;
		for (const auto& p : points) {
			EXPECT_NEAR(p.normal.z(), 1, 1e-13); // rounding at positions of metres
			EXPECT_NEAR(p.overlap, overlap, 1e-13);
		}
	}
}

TEST(DeepOverlap, RandomPairsArePushedApart)
{
	Random random(31);
	const std::vector<RoundedPolyhedron> bodies { roundedBox({ 0.5, 0.5, 0.5 }), roundedBox({ 1, 0.1, 0.1 }),
		roundedBox({ 0.6, 0.5, 0.05 }), rounded(hexagonalPrismVertices(0.2, 0.5), 0.02),
		rounded(octahedronVertices(0.5)) };
	int deep = 0, stuck = 0;
	for (int trial = 0; trial < 400; ++trial) {
		const auto &a = bodies[trial % 5], &b = bodies[trial / 5 % 5];
		const Pose poseB { randomVector(random, 0.2), randomRotation(random) };
		if (gapOf(a, b, poseB) >= 0) continue;
		++deep;
		stuck += stepsToPart(a, b, poseB, 2e-3, 1500) < 0;
	}
	EXPECT_GT(deep, 200);
	EXPECT_EQ(stuck, 0) << "of " << deep;
}

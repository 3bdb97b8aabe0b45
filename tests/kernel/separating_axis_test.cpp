// SPDX-License-Identifier: GPL-2.0-or-later
/// Gap and penetration depth of two convex bodies: closed forms, symmetry, and comparison with random directions.
#include "shapes.hpp"
#include <kernel/separating_axis.hpp>
#include <algorithm>
#include <gtest/gtest.h>

using namespace timber;
using namespace timber::shapes;

namespace {

constexpr double rounding = 1e-13; ///< at positions of metres [m]

struct Placed {
	Polyhedron a, b;
	Mat3 rotation;
	Vec3 translation;
	double gap(Vec3& axis) const { return coreGap(a, b, rotation, translation, axis); }
	/// How far B lies beyond A along a direction. [m]
	double along(const Vec3& direction) const
	{
		double maxA = -1e9, minB = 1e9;
		for (const Vec3& v : a.vertices)
			maxA = std::max(maxA, v.dot(direction));
		for (const Vec3& v : b.vertices)
			minB = std::min(minB, (rotation * v + translation).dot(direction));
		return minB - maxA;
	}
};

Placed randomPair(Random& random, double distance)
{
	const auto hull = [&] {
		return Polyhedron::fromVertices(
		        ellipsoidPoints(random, 4 + int(uniform(random, 0, 5)), { 1, 0.6, 0.4 }));
	};
	const Polyhedron a = hull(), b = hull();
	const Mat3 rotation = randomRotation(random).toRotationMatrix();
	return { a, b, rotation, distance * randomDirection(random) };
}

} // namespace

TEST(CoreGap, AlignedBoxes)
{
	const Polyhedron box = Polyhedron::fromVertices(boxVertices({ 1, 2, 3 }));
	Vec3 axis;
	EXPECT_NEAR(coreGap(box, box, Mat3::Identity(), { 1.5, 0.3, 0.2 }, axis), 0.5, rounding);
	EXPECT_EQ(axis, Vec3::UnitX());
	EXPECT_NEAR(coreGap(box, box, Mat3::Identity(), { 0.9, -1.95, 0.2 }, axis), -0.05, rounding);
	EXPECT_EQ(axis, -Vec3::UnitY());
}

/// Edges crossed at a right angle, both bars rotated by 45 degrees.
TEST(CoreGap, CrossedEdges)
{
	const Polyhedron bar = Polyhedron::fromVertices(boxVertices({ 4, 1, 1 }));
	const Mat3 turn = (about({ 1, 0, 0 }, -M_PI / 4) * about({ 0, 0, 1 }, M_PI / 2) * about({ 1, 0, 0 }, M_PI / 4))
	                          .toRotationMatrix();
	const Vec3 up = about({ 1, 0, 0 }, -M_PI / 4) * Vec3::UnitZ();
	for (const double gap : { -0.1, 0.2 }) {
		Vec3 axis;
		EXPECT_NEAR(coreGap(bar, bar, turn, (std::sqrt(2.) + gap) * up, axis), gap, rounding);
		EXPECT_LT((axis - up).norm(), 10 * rounding); // an angle
	}
}

/// Largest gap along the normals of all faces and the cross products of all edges.
double gapOfAllAxes(const Placed& pair)
{
	double largest = -1e9;
	const auto test = [&](const Vec3& axis) { largest = std::max(largest, pair.along(axis)); };
	for (const Face& face : pair.a.faces)
		test(face.plane.normal);
	for (const Face& face : pair.b.faces)
		test(-(pair.rotation * face.plane.normal));
	for (const Edge& ea : pair.a.edges)
		for (const Edge& eb : pair.b.edges) {
			const Vec3 n = ea.direction.cross(pair.rotation * eb.direction);
			if (n.norm() < 1e-9) continue;
			test(n.normalized());
			test(-n.normalized());
		}
	return largest;
}

/// Whether the bodies overlap. Their gap is then the largest one of all axes.
bool checkOverlap(const Placed& pair)
{
	Vec3 axis;
	const double gap = pair.gap(axis);
	if (gap >= 0) return false;
	EXPECT_NEAR(gap, gapOfAllAxes(pair), rounding);
	return true;
}

TEST(CoreGap, AllAxesOfRandomHulls)
{
	Random random(84);
	int overlapping = 0;
	for (int trial = 0; trial < 150; ++trial)
		overlapping += checkOverlap(randomPair(random, uniform(random, 0, 1)));
	EXPECT_GT(overlapping, 60);
}

/// Edges and faces that are parallel but for small angles.
TEST(CoreGap, AllAxesOfNearlyAlignedBodies)
{
	Random random(85);
	const Polyhedron shapes[] { Polyhedron::fromVertices(boxVertices({ 1, 1, 1 })),
		Polyhedron::fromVertices(boxVertices({ 3, 0.1, 0.1 })),
		Polyhedron::fromVertices(hexagonalPrismVertices(0.5, 1)) };
	int overlapping = 0;
	for (int trial = 0; trial < 200; ++trial) {
		const auto shape = [&] { return shapes[int(uniform(random, 0, 3))]; };
		const Quat quarters = about(Vec3::Unit(trial % 3), M_PI / 4 * int(uniform(random, 0, 8))),
		           tilt = about(randomDirection(random), oneOf(random, 4) ? 0 : logUniform(random, 1e-14, 0.1));
		overlapping += checkOverlap({ shape(), shape(), (quarters * tilt).toRotationMatrix(),
		        uniform(random, 0, 1) * randomDirection(random) });
	}
	EXPECT_GT(overlapping, 80);
}

/// Overlapping bodies: no random direction gives a larger gap (a smaller overlap).
TEST(CoreGap, LeastOverlapOfAllDirections)
{
	Random random(81);
	int overlapping = 0;
	for (int trial = 0; trial < 300; ++trial) {
		const Placed pair = randomPair(random, uniform(random, 0, 1));
		Vec3 axis;
		const double gap = pair.gap(axis);
		EXPECT_NEAR(axis.norm(), 1, rounding);
		EXPECT_NEAR(pair.along(axis), gap, rounding);
		if (gap >= 0) continue;
		++overlapping;
		for (int k = 0; k < 300; ++k)
			EXPECT_LE(pair.along(randomDirection(random)), gap + rounding) << trial;
	}
	EXPECT_GT(overlapping, 100);
}

/// A point reflection and a swap of the bodies both keep the gap and reverse the axis.
TEST(CoreGap, PointReflectionAndSwap)
{
	Random random(82);
	for (int trial = 0; trial < 300; ++trial) {
		const Placed pair = randomPair(random, uniform(random, 0, 2));
		const auto reflected = [](std::vector<Vec3> points) {
			for (Vec3& p : points)
				p = -p;
			return Polyhedron::fromVertices(points);
		};
		const Placed mirror { reflected(pair.a.vertices), reflected(pair.b.vertices), pair.rotation,
			-pair.translation };
		const Placed swapped { pair.b, pair.a, pair.rotation.transpose(),
			-(pair.rotation.transpose() * pair.translation) };
		Vec3 axis, axisMirror, axisSwapped;
		EXPECT_NEAR(pair.gap(axis), mirror.gap(axisMirror), rounding);
		EXPECT_NEAR(pair.gap(axis), swapped.gap(axisSwapped), rounding);
		// Normals of random triangles: rounding over their sharpness
		EXPECT_LT((axis + axisMirror).norm(), 1e-9);
		EXPECT_LT((axis + pair.rotation * axisSwapped).norm(), 1e-9);
	}
}

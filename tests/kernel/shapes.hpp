// SPDX-License-Identifier: GPL-2.0-or-later
/// Bodies and poses shared by the kernel's tests. Lengths in m.
#pragma once
#include <cmath>
#include <kernel/manifold.hpp>
#include <kernel/polyhedron.hpp>
#include <random>
#include <vector>

namespace timber::shapes {

using Random = std::mt19937;

inline double uniform(Random& random, double low, double high)
{
	return std::uniform_real_distribution<double>(low, high)(random);
}

/// Random number whose logarithm is uniformly distributed.
inline double logUniform(Random& random, double low, double high)
{
	return std::exp(uniform(random, std::log(low), std::log(high)));
}
/// True once in n times.
inline bool oneOf(Random& random, int n) { return uniform(random, 0, n) < 1; }

inline Vec3 randomVector(Random& random, double size)
{
	const double x = uniform(random, -size, size), y = uniform(random, -size, size),
	             z = uniform(random, -size, size);
	return { x, y, z };
}

/// Uniformly distributed direction, by rejection.
inline Vec3 randomDirection(Random& random)
{
	while (true) {
		const Vec3 v = randomVector(random, 1);
		if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
	}
}

inline Quat about(const Vec3& axis, double angle) { return Quat(Eigen::AngleAxisd(angle, axis.normalized())); }
inline Quat randomRotation(Random& random)
{
	const Vec3 axis = randomDirection(random);
	return about(axis, uniform(random, 0, M_PI));
}

inline std::vector<Vec3> boxVertices(const Vec3& extents)
{
	std::vector<Vec3> points;
	for (const double x : { -0.5, 0.5 })
		for (const double y : { -0.5, 0.5 })
			for (const double z : { -0.5, 0.5 })
				points.push_back(extents.cwiseProduct(Vec3(x, y, z)));
	return points;
}

/// Regular tetrahedron around the origin.
inline std::vector<Vec3> tetrahedronVertices(double edge)
{
	const double s = edge / std::sqrt(8.);
	return { { s, s, s }, { s, -s, -s }, { -s, s, -s }, { -s, -s, s } };
}

/// Regular octahedron around the origin.
inline std::vector<Vec3> octahedronVertices(double edge)
{
	const double s = edge / std::sqrt(2.);
	return { { s, 0, 0 }, { -s, 0, 0 }, { 0, s, 0 }, { 0, -s, 0 }, { 0, 0, s }, { 0, 0, -s } };
}

/// Prism over a convex polygon in the xy plane, -height/2 <= z <= height/2.
inline std::vector<Vec3> prismVertices(const std::vector<Eigen::Vector2d>& outline, double height)
{
	std::vector<Vec3> points;
	for (const double z : { -height / 2, height / 2 })
		for (const auto& p : outline)
			points.emplace_back(p.x(), p.y(), z);
	return points;
}

inline std::vector<Vec3> hexagonalPrismVertices(double side, double height)
{
	std::vector<Eigen::Vector2d> outline;
	for (int k = 0; k < 6; ++k)
		outline.emplace_back(side * std::cos(k * M_PI / 3), side * std::sin(k * M_PI / 3));
	return prismVertices(outline, height);
}

/// A brace in its bay: a band of this width along the diagonal from (0, 0, 0) to (run, 0, rise), both ends cut by the
/// horizontal and the vertical plane of the bay's corner; |y| <= depth/2.
struct Brace {
	double run, rise, width, depth;
	double cutZ() const { return width / 2 * std::hypot(run, rise) / run; } ///< length of the vertical cut
	double cutX() const { return cutZ() * run / rise; } ///< length of the horizontal cut
	std::vector<Vec3> vertices() const
	{
		std::vector<Vec3> points;
		for (const double y : { -depth / 2, depth / 2 })
			for (const Vec3& p : { Vec3(0, y, 0), Vec3(cutX(), y, 0), Vec3(run, y, rise - cutZ()),
			             Vec3(run, y, rise), Vec3(run - cutX(), y, rise), Vec3(0, y, cutZ()) })
				points.push_back(p);
		return points;
	}
};

/// Hip end of a roof: triangle of the eave's length over the eave y = 0, hips at 45 degrees in plan, the three corners
/// cut off by `cut` (in plan); it rises with y at `slope` and has this vertical thickness.
struct HipSlab {
	double eave, cut, slope, thickness;
	std::vector<Vec3> vertices() const
	{
		const double w = eave / 2;
		std::vector<Vec3> points;
		for (const double z : { -thickness / 2, thickness / 2 })
			for (const auto& p : { Eigen::Vector2d(cut - w, 0), Eigen::Vector2d(w - cut, 0),
			             Eigen::Vector2d(w - cut, cut), Eigen::Vector2d(cut, w - cut),
			             Eigen::Vector2d(-cut, w - cut), Eigen::Vector2d(cut - w, cut) })
				points.emplace_back(p.x(), p.y(), z + slope * p.y());
		return points;
	}
};

/// Square pyramid, base in z = 0: four faces meet in its apex.
inline std::vector<Vec3> pyramidVertices(double base, double height)
{
	const double s = base / 2;
	return { { -s, -s, 0 }, { s, -s, 0 }, { s, s, 0 }, { -s, s, 0 }, { 0, 0, height } };
}

/// Convex hull of random points on an ellipsoid: all of them are corners.
inline std::vector<Vec3> ellipsoidPoints(Random& random, int count, const Vec3& semiAxes)
{
	std::vector<Vec3> points;
	for (int k = 0; k < count; ++k)
		points.push_back(semiAxes.cwiseProduct(randomDirection(random)));
	return points;
}

inline std::vector<Vec3> moved(std::vector<Vec3> points, const Quat& rotation, const Vec3& translation)
{
	for (Vec3& p : points)
		p = rotation * p + translation;
	return points;
}

inline RoundedPolyhedron rounded(const std::vector<Vec3>& points, double radius = 0)
{
	return RoundedPolyhedron::fromSharp(Polyhedron::fromVertices(points), radius);
}
inline RoundedPolyhedron roundedBox(const Vec3& extents, double radius = 0)
{
	return rounded(boxVertices(extents), radius);
}

/// The pose after a rotation and translation of the whole scene.
inline Pose carried(const Pose& pose, const Quat& rotation, const Vec3& translation)
{
	return { rotation * pose.position + translation, rotation * pose.orientation };
}

/// Contact points from an empty cache.
inline std::vector<ContactPoint> contacts(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseA,
        const Pose& poseB, const ContactKinds& kinds = {})
{
	CandidateCache cache;
	std::vector<ContactPoint> points;
	updateManifold(a, b, poseA, poseB, kinds, cache, points);
	return points;
}

inline int count(const std::vector<ContactPoint>& points, FeatureKind kind)
{
	int n = 0;
	for (const ContactPoint& p : points)
		n += p.id.kind() == kind;
	return n;
}

} // namespace timber::shapes

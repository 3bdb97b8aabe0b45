// SPDX-License-Identifier: GPL-2.0-or-later
/// Intersections of half-spaces that have a point inside, by duality: a plane at distance d from the point becomes the
/// point n / d, and the triangles of the convex hull of these points are the corners of the intersection.
#pragma once
#include "convex_hull.hpp"

namespace timber {

struct Sphere {
	Vec3 centre; ///< [m]
	double radius; ///< < 0: the half-spaces have no common point [m]
};

/// Largest sphere inside half-spaces whose normals are unit vectors. Their intersection, if any, lies within `size` of
/// `middle`.
Sphere inscribedSphere(const std::vector<HalfSpace>& planes, const Vec3& middle, double size);

/// Bounded intersection of half-spaces that contain `centre`. Corners on a common edge that are closer than `tolerance`
/// become one.
Hull intersectionAround(const Vec3& centre, const std::vector<HalfSpace>& planes, double tolerance);

} // namespace timber

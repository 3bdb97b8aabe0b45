// SPDX-License-Identifier: GPL-2.0-or-later
/// Convex hull of points that are all corners, with a tolerance for planar faces.
#pragma once
#include "polyhedron.hpp"

namespace timber {

/// Hull whose faces contain all points within `tolerance` of their plane. [m]
/// Throws PolyhedronError if the points are coplanar, if one is not a corner or if the faces do not close.
Polyhedron convexHull(const std::vector<Vec3>& points, double tolerance);

/// The same with the smallest tolerance of planarShare ... warpShare times the size at which the faces close. Also checks coordinates,
/// size and coincident points.
Polyhedron closedConvexHull(const std::vector<Vec3>& points);

/// Largest extent along a coordinate axis. [m]
double sizeOf(const std::vector<Vec3>& points);

/// For messages: "(x, y, z)".
std::string toText(const Vec3& v);

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
/// Convex hull of points that are all corners, with a tolerance for planar faces.
#pragma once
#include "polyhedron.hpp"

namespace timber {

/// Hull whose faces contain all points within `tolerance` of their plane [m]; less where no tolerance tells faces from
/// corners.
/// Throws PolyhedronError if the points are coplanar or if one is not a corner.
Polyhedron convexHull(const std::vector<Vec3>& points, double tolerance);

/// The same with planarShare of the size. Throws PolyhedronError also for coordinates that are not finite, an extent
/// outside smallestSize ... largestSize, and coincident points.
Polyhedron convexHull(const std::vector<Vec3>& points);

/// Body of faces that have their plane and corners. Throws PolyhedronError if they do not close.
Polyhedron closedBody(std::vector<Vec3> vertices, std::vector<Face> faces);

/// Largest extent along a coordinate axis. [m]
double sizeOf(const std::vector<Vec3>& points);

/// For messages: "(x, y, z)".
std::string toText(const Vec3& v);

} // namespace timber

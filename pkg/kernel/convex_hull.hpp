// SPDX-License-Identifier: GPL-2.0-or-later
/// Convex hull of points that are all corners, with a tolerance for planar faces.
#pragma once
#include "polyhedron.hpp"

namespace timber {

/// Hull whose faces contain all points within `tolerance` of their plane. [m]
/// Throws PolyhedronError if the points are coplanar, if one is not a corner or if the faces do not close.
Polyhedron convexHull(const std::vector<Vec3>& points, double tolerance);

/// Throws PolyhedronError for coordinates that are not finite, an extent outside smallestSize ... largestSize, and
/// coincident points.
void checkPoints(const std::vector<Vec3>& points);

/// The hull with the smallest tolerance of planarShare ... warpShare times the size at which the faces close. Checks
/// the points.
Polyhedron closedConvexHull(const std::vector<Vec3>& points);

/// The same from triangles, which always close; coplanar neighbours are one face. It serves where no tolerance tells
/// faces from corners.
Polyhedron triangulatedHull(const std::vector<Vec3>& points);

/// Body of faces that have their plane and corners. Throws PolyhedronError if they do not close.
Polyhedron closedBody(std::vector<Vec3> vertices, std::vector<Face> faces);

/// Largest extent along a coordinate axis. [m]
double sizeOf(const std::vector<Vec3>& points);

/// For messages: "(x, y, z)".
std::string toText(const Vec3& v);

} // namespace timber

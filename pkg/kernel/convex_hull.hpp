// SPDX-License-Identifier: GPL-2.0-or-later
/// Convex hull of points that are all corners, with a tolerance for planar faces.
#pragma once
#include "polyhedron.hpp"

namespace timber {

/// How the construction of a closed body ends.
enum class HullOutcome {
	Sound,
	Coplanar, ///< the points lie in one plane within the tolerance
	NoCorner, ///< a point is no corner of the hull
	NoVolume, ///< no point is inside all planes by more than the tolerance
	Open, ///< the faces do not close
};

struct Hull {
	HullOutcome outcome = HullOutcome::Sound;
	Polyhedron body = {}; ///< if sound
	size_t point = 0; ///< NoCorner: index of the point
};

/// Hull whose faces contain all points within `tolerance` of their plane [m]; less where no tolerance tells faces from
/// corners.
Hull tryConvexHull(const std::vector<Vec3>& points, double tolerance);

/// The same with planarShare of the size. Throws PolyhedronError if the hull is not sound, for coordinates that are not
/// finite, an extent outside smallestSize ... largestSize, and coincident points.
Polyhedron convexHull(const std::vector<Vec3>& points);

/// Body of faces whose corners are given, by index and counter-clockwise seen from outside.
Hull closedBody(const std::vector<Vec3>& vertices, const std::vector<std::vector<int>>& outlines);

/// Largest extent along a coordinate axis. [m]
double sizeOf(const std::vector<Vec3>& points);

/// For messages: "(x, y, z)".
std::string toText(const Vec3& v);

} // namespace timber

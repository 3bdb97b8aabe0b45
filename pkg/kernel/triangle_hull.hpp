// SPDX-License-Identifier: GPL-2.0-or-later
/// Convex hull as triangles, without a tolerance: nearly coplanar points, nearly collinear and close ones are no
/// special case.
#pragma once
#include "types.hpp"
#include <array>
#include <vector>

namespace timber {

using Triangle = std::array<int, 3>; ///< point indices, counter-clockwise seen from outside
using LongVec3 = Eigen::Matrix<long double, 3, 1>;

/// Triangles of the convex hull of points about the origin; a closed surface. Those of coplanar points are one of their
/// possible triangulations.
/// Empty if the points are coplanar.
std::vector<Triangle> hullTriangles(const std::vector<LongVec3>& points);

/// The same of points anywhere.
std::vector<Triangle> hullTriangles(const std::vector<Vec3>& points);

/// The corners around the triangles, counter-clockwise; empty unless they form one disc.
std::vector<int> outlineOf(const std::vector<Triangle>& triangles);

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
/// Separating axis test of two convex polyhedra (Gottschalk, Lin and Manocha 1996, SIGGRAPH, 171-180).
#pragma once
#include "polyhedron.hpp"
#include <limits>

namespace timber {

/// Largest gap between the cores over the candidate axes: all face normals, and the cross products of an edge of A and
/// an edge of B that form a face of the Minkowski difference.
/// > 0: the cores are separated by at least this distance; < 0: they overlap, and this is minus the penetration depth.
/// [m] rotation, translation: x_A = rotation x_B + translation. axis (out): unit, from A to B, frame of A: the axis of
/// the largest gap.
/// The cross products are skipped once the gap exceeds `sufficientGap`.
double coreGap(const Polyhedron& a, const Polyhedron& b, const Mat3& rotation, const Vec3& translation, Vec3& axis,
        double sufficientGap = std::numeric_limits<double>::infinity());

} // namespace timber

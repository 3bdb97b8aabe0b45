// SPDX-License-Identifier: GPL-2.0-or-later
/// Overlap of two rounded polyhedra as bodies, from the distance of their cores. It knows no contact points and judges
/// them.
#pragma once
#include "polyhedron.hpp"

namespace timber {

/// Shortest distance of two cores that do not overlap. x_A = rotation x_B + translation. [m]
double coreDistance(const Polyhedron& a, const Polyhedron& b, const Mat3& rotation, const Vec3& translation);

/// r_A + r_B - distance of the cores; where the cores overlap, r_A + r_B + their penetration depth. [m] Negative: the
/// bodies are apart by at least this.
double bodyOverlap(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseA, const Pose& poseB);

} // namespace timber

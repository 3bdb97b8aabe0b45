// SPDX-License-Identifier: GPL-2.0-or-later
/// Highest frequency of bodies joined by springs: what limits an explicit time step.
#pragma once
#include "contact_solver.hpp"

namespace timber {

/// A spring between two bodies at one point.
struct StiffPoint {
	int bodyA, bodyB;
	Vec3 armA, armB; ///< from the centres of mass to the point [m]
	Vec3 normal; ///< unit
	double normalStiffness, shearStiffness; ///< [N/m]
};

/// Largest eigenvalue of M^-1 K by power iteration, to 0.1 %. Masses and inertias from the bodies. [1/s2]
double largestEigenvalue(const std::vector<SolverBody>& bodies, const std::vector<StiffPoint>& points);

} // namespace timber

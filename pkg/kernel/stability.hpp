// SPDX-License-Identifier: GPL-2.0-or-later
/// Highest natural frequency of bodies connected by springs. It limits an explicit time step to 2 / omega.
#pragma once
#include "contact_solver.hpp"

namespace timber {

/// Linearised spring between two bodies at one point.
struct PointSpring {
	int bodyA, bodyB;
	Vec3 armA, armB; ///< from the centres of mass to the point [m]
	Vec3 normal; ///< unit
	double normalStiffness, shearStiffness; ///< [N/m]
	Vec3 force = Vec3::Zero(); ///< of the spring on body B [N]; `largestEigenvalue` ignores it
};

/// Largest eigenvalue omega^2 of M^-1 K by power iteration, to 0.1 %. Masses and inertias are those of the bodies.
/// [1/s2]
double largestEigenvalue(const std::vector<SolverBody>& bodies, const std::vector<PointSpring>& springs);

} // namespace timber

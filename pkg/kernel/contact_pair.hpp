// SPDX-License-Identifier: GPL-2.0-or-later
/// What a step does with all points of a pair, laneCount of them at a time: elastic forces, rows for the dashpots' solver, total
/// forces and energies.
#pragma once
#include "contact_law.hpp"

namespace timber {

/// Where a body is and how it moves.
struct BodyMotion {
	const Vec3 &position, &velocity, &spin; ///< world [m, m/s, rad/s]
};

/// Elastic step of all points. States follow their features; those of features that no longer meet go.
/// placed: the pair is new, its bodies were put where they are, overlap and all; else a new point starts with bornOverlap().
/// Velocities of a and b: those that led to the present placement, a step of length h [s] ago.
/// Returns the energy lost with points that ceased to exist, less what points born under load took of it. [J]
template <class Law>
double elasticPair(const Law& law, const PairProperties& pair, const BodyMotion& a, const BodyMotion& b, double h, NormalForm form, bool placed,
        const std::vector<ContactPoint>& points, std::vector<PointState>& states);

/// The k-th pair of the solver gets its rows. refresh: whether to find the points' responses anew.
void prepareContacts(ContactSolver& solver, size_t k, const std::vector<SolverBody>& bodies, const PairProperties& pair, double dampingRatio, double h, bool refresh,
        const std::vector<ContactPoint>& points, std::vector<PointState>& states);

/// Total force and torques of a pair's points, each torque about the body's own centre. [N, N m]
struct PairForce {
	Vec3 onB = Vec3::Zero(), torqueA = Vec3::Zero(), torqueB = Vec3::Zero();
};

/// What a step adds to the energies that have been dissipated, and the elastic energies now. [J]
struct PairEnergies {
	double dashpotNormal = 0, dashpotShear = 0, friction = 0;
	double elasticNormal = 0, elasticShear = 0;
	double elasticPower = 0; ///< rate at which the springs' energy grows with the velocities after the step [W]
};

/// Takes the solved rows of the k-th pair over into its states. energies: added to, if they are asked for.
PairForce storeForces(const ContactSolver& solver, size_t k, const std::vector<SolverBody>& bodies, const PairProperties& pair, double h, std::vector<PointState>& states,
        PairEnergies* energies);

} // namespace timber

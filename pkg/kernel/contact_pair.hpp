// SPDX-License-Identifier: GPL-2.0-or-later
/// One step of all contact points of a pair, SIMD-vectorised:
///     1. elasticPair(): elastic forces for the new contact points (contact loop);
///     2. prepareContacts(): constraints for the solver, warm start included;
///     3. storeForces(): forces on the bodies, history and energies from the solver's impulses.
#pragma once
#include "contact_law.hpp"

namespace timber {

/// Input of the elastic step. Velocities of a and b are those of the last step, which led to the present positions.
struct ElasticInput {
	const PairProperties& pair;
	BodyKinematics a, b;
	double h; ///< length of the step [s]
	NormalForm form = NormalForm::Closed;
	bool placedInContact = false; ///< the pair is new and its bodies were placed as they are: new points have their whole overlap, not initialOverlap()
};

/// Elastic step of all points. Records follow the features; those of features no longer in contact are removed.
/// points: sorted by id; records: in-out.
/// Returns the energy released with points that ceased to exist, minus the energy given to new points. [J]
template <class Law> double elasticPair(const Law& law, const ElasticInput& input, const std::vector<ContactPoint>& points, std::vector<PointRecord>& records);

/// Arguments that prepareContacts() and storeForces() share.
struct SolverStep {
	ContactSolver& solver;
	const std::vector<SolverBody>& bodies;
	double h; ///< length of the step [s]
};

/// Constraints of the k-th pair of the solver.
void prepareContacts(const SolverStep& step, size_t k, const PairProperties& pair, const std::vector<ContactPoint>& points, std::vector<PointRecord>& records);

/// Total force and torques of a pair's points; each torque about the body's own centre. [N, N m]
struct PairForce {
	Vec3 onB = Vec3::Zero(), torqueA = Vec3::Zero(), torqueB = Vec3::Zero();
};

/// Energies dissipated in a step, and elastic energies at its placement. [J]
struct PairEnergies {
	double dashpotNormal = 0, dashpotShear = 0, friction = 0;
	double elasticNormal = 0, elasticShear = 0;
	double elasticPower = 0; ///< rate of change of the elastic energy at the velocities after the step [W]
};

/// Stores the impulses of the k-th pair in its records. energies: added to, unless null.
PairForce storeForces(const SolverStep& step, size_t k, const PairProperties& pair, std::vector<PointRecord>& records, PairEnergies* energies);

} // namespace timber

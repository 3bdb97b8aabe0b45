// SPDX-License-Identifier: GPL-2.0-or-later
/// One step of all contact points of a pair, SIMD-vectorised:
///     1. elasticPair(): elastic forces for the new contact points (contact loop);
///     2. prepareContacts(): the points' steps for the solver, warm start included;
///     3. storeForces(): forces on the bodies, history and energies from the solver's impulses.
///
/// Account of a spring (PointRecord::normalStored, shearStored), between two placements: a step adds the work -p (v +
/// v') / 2 that the bodies do on the point with the impulse p of spring and dashpot. What exceeds the energy of the law
/// there has been dissipated. Rule (5) of the solver keeps the accounts from going below zero but for errors of the
/// sweeps, which later work settles. No dissipation is negative. The normal spring has at most the energy at its
/// strength; what a point at its strength dissipates is crushing.
#pragma once
#include "contact_law.hpp"
#include "contact_solver.hpp"

namespace timber {

/// Input of the elastic step. Velocities of a and b are those of the last step, which led to the present positions.
struct ElasticInput {
	const PairProperties& pair;
	BodyKinematics a, b;
	double h; ///< length of the step [s]
	NormalForm form = NormalForm::Closed;
	/// The pair is new and one of its bodies was placed as it is: new points have their whole overlap, not
	/// initialOverlap(). Those whose approach in a step explains it begin an impact.
	bool placedInContact = false;
	/// One of the bodies was moved by hand: the points that go on have the energy of their springs. Their history is kept.
	bool moved = false;
};

/// Elastic step of all points. Records follow the features; those of features no longer in contact are removed.
/// points: sorted by id; records: in-out.
/// Returns the energy released with points that ceased to exist, minus the energy given to new points. [J] Negative:
/// those points had returned more energy than they had stored.
template <class Law>
double elasticPair(const Law& law, const ElasticInput& input, const std::vector<ContactPoint>& points,
        std::vector<PointRecord>& records);

/// Prepares the points of the solver's k-th pair. records: in-out, impacts may begin.
void prepareContacts(ContactSolver& solver, size_t k, const PairProperties& pair,
        const std::vector<ContactPoint>& points, std::vector<PointRecord>& records);

/// Total force and torques of a pair's points; each torque about the body's own centre. [N, N m]
struct PairForce {
	Vec3 onB = Vec3::Zero(), torqueA = Vec3::Zero(), torqueB = Vec3::Zero();
	Vec3 normalOnB = Vec3::Zero(); ///< part of onB along the points' normals
};

/// Energies dissipated in a step, and those of the springs in the middle between its placement and the next one. [J]
struct PairEnergies {
	double dashpotNormal = 0, dashpotShear = 0, friction = 0;
	double elasticNormal = 0, elasticShear = 0;
	double crushing = 0; ///< dissipated by points at their strength
};

/// Stores forces, history and energies of the points of the k-th pair. records: in-out; energies: added to.
PairForce storeForces(ContactSolver& solver, size_t k, const PairProperties& pair, std::vector<PointRecord>& records,
        PairEnergies& energies);

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
/// Joints that the solver of ContactForces treats: damped or stiff ones. Law: kernel/joint_modes.hpp.
#pragma once
#include <JointEngine.hpp>
#include <kernel/contact_pair.hpp>

namespace yade {

/// Energies of joints in a step. [J]
struct JointEnergies {
	Real stored = 0; ///< by Newmark's term
	Real dissipated = 0;
	Real created = 0; ///< debt of Newmark's term of joints that are no longer implicit
};

/// A joint with the tangent stiffness of its springs over the initial one. [-]
struct ImplicitJoint {
	TimberJoint* joint;
	Real tangent;
};

/// Unbroken joints with dashpots, and on request joints too stiff for explicit springs, between bodies of which
/// at least one is free.
/// bodies: by id, those of the scene; implicit: out, in the order of the joints; energies: those of Newmark's term of
/// the others are added to.
void findImplicitJoints(const Scene&, const std::vector<timber::SolverBody>& bodies, bool alsoStiff,
        std::vector<ImplicitJoint>& implicit, JointEnergies& energies);

/// Constraint of a joint, the k-th of the solver.
void prepareJoint(timber::ContactSolver&, size_t k, const ImplicitJoint&, const Scene&);

/// Power that the dashpots of all joints take from bodies at these velocities, as in the last step. bodies: by id [W]
Real dashpotPower(const Scene&, const std::vector<timber::SolverBody>& bodies);

/// Force of the modes of the solver's k-th joint. energies: added to.
timber::PairForce storeJoint(
        const timber::ContactSolver&, size_t k, const Scene&, TimberJoint&, JointEnergies& energies);

} // namespace yade

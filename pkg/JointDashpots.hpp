// SPDX-License-Identifier: GPL-2.0-or-later
/// Dashpots and stiff springs of the joints in the solver of ContactForces. Law: kernel/joint_dashpot.hpp.
#pragma once
#include <Joints.hpp>
#include <kernel/contact_pair.hpp>

namespace yade {

/// Unbroken joints with a damping ratio, and on request joints too stiff for explicit springs, between bodies of which at least one is free.
/// bodies: by id, those of the scene; found: out, in the order of the joints.
void findImplicitJoints(const Scene&, const std::vector<timber::SolverBody>& bodies, bool alsoStiff, std::vector<TimberJoint*>& found);

/// Constraint of a joint, the k-th of the solver.
void prepareJoint(const timber::SolverStep&, size_t k, TimberJoint&, const Scene&);

/// Force of the dashpots of the solver's k-th joint. dissipated: added to [J].
timber::PairForce storeJoint(const timber::SolverStep&, size_t k, Real& dissipated);

} // namespace yade

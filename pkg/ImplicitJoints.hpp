// SPDX-License-Identifier: GPL-2.0-or-later
/// Joints that the solver of ContactForces treats: damped or stiff ones. Law: kernel/joint_modes.hpp.
#pragma once
#include <JointEngine.hpp>
#include <kernel/contact_pair.hpp>

namespace yade {

/// A joint in the solver.
struct ImplicitJoint {
	timber::JointEntry* joint;
	timber::JointModes* modes; ///< of it
	timber::JointSprings springs; ///< also broken ones
	size_t index; ///< in the engine
	bool isStiff; ///< its springs are in the solver
	Real tangent; ///< stiffness of its explicit springs over the initial one [-]
	bool isAxial; ///< a single spring acts along the normal: one mode
	timber::SpringAxis axis; ///< of an axial joint
	size_t place = 0; ///< in the solver, among the joints of as many modes
};

/// A spring that breaks in the solver.
struct ImplicitBreak {
	size_t joint; ///< index in the engine
	timber::SpringBreak spring;
};

/// What joints of the solver do in a step.
struct ImplicitJointResult {
	Real stored = 0; ///< by stiff joints [J]
	Real dashpots = 0; ///< dissipated by dashpots, and by stiff joints without a cause of the law [J]
	Real yielded = 0, released = 0; ///< dissipated by springs that yield, and with springs that break [J]
	Real debt = 0; ///< energy that stiff joints have returned beyond what they had stored [J]
	std::vector<ImplicitBreak> breaks;

	void add(const ImplicitJointResult&);
};

/// Unbroken joints with dashpots, and on request joints too stiff for explicit springs, between bodies of which
/// at least one is free.
/// bodies: by id, those of the scene; implicit: out, in the order of the joints. Returns the energies of joints that
/// are stiff no more.
ImplicitJointResult findImplicitJoints(const Scene&, const std::vector<timber::SolverBody>& bodies, bool alsoStiff,
        std::vector<ImplicitJoint>& implicit);

/// Lists a joint in the solver.
void addJoint(timber::ContactSolver&, ImplicitJoint&);

/// Constraint of a joint.
void prepareJoint(timber::ContactSolver&, const ImplicitJoint&, const std::vector<timber::SolverBody>& bodies);

/// Power that the dashpots of all joints take from bodies at these velocities, as in the last step. bodies: by id [W]
Real dashpotPower(const Scene&, const std::vector<timber::SolverBody>& bodies);

/// Force of a joint. result: added to.
timber::PairForce storeJoint(const timber::ContactSolver&, const ImplicitJoint&,
        const std::vector<timber::SolverBody>& bodies, ImplicitJointResult& result);

} // namespace yade

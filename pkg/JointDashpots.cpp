// SPDX-License-Identifier: GPL-2.0-or-later
#include <JointDashpots.hpp>
#include <kernel/constants.hpp>

namespace yade {

void findDampedJoints(const Scene& scene, const std::vector<timber::SolverBody>& bodies, std::vector<TimberJoint*>& damped)
{
	damped.clear();
	const JointEngine* engine = findEngine<JointEngine>(scene);
	if (!engine || engine->dead) return;
	for (const shared_ptr<TimberJoint>& joint : engine->joints) {
		if (joint->dampingRatio == 0 || joint->isBroken() || joint->id1 == joint->id2) continue;
		if (!bodyAt(scene, joint->id1) || !bodyAt(scene, joint->id2)) continue;
		if (timber::pairInverseMass(bodies[joint->id1], bodies[joint->id2]) > 0) damped.push_back(joint.get());
	}
}

void prepareJoint(const timber::SolverStep& step, size_t k, TimberJoint& joint, const Scene& scene)
{
	const timber::SolverBody &a = step.bodies[joint.id1], &b = step.bodies[joint.id2];
	const Matrix3r axes = Body::byId(joint.id1)->state->ori.toRotationMatrix();
	const timber::SpringGroup springs { joint.anchors1, joint.broken, joint.stiffness(), joint.normal };
	timber::DashpotHistory& dashpot = joint.dashpot;
	const bool refresh = (scene.iter + joint.id1 + joint.id2) % timber::modeSteps == 0; // spread over the steps, reproducible after a load
	if (refresh || !dashpot.modes.holdFor(springs, timber::pairInverseMass(a, b))) {
		const timber::JointModes modes = timber::jointModes(a, b, axes, springs);
		dashpot.force = timber::convertedImpulse(dashpot.force, dashpot.modes, modes);
		dashpot.modes = modes;
	}
	step.solver.prepareDashpot(k, step.bodies, { dashpot.modes, axes, joint.dampingRatio, step.h * dashpot.force }, step.h);
}

timber::PairForce storeJoint(const timber::SolverStep& step, size_t k, TimberJoint& joint, Real& dissipated)
{
	const timber::DashpotConstraint& c = step.solver.dashpot(k);
	const timber::DashpotForce f = timber::dashpotForce(c, step.bodies[joint.id1], step.bodies[joint.id2], step.h);
	joint.dashpot.force = c.impulse / step.h;
	dissipated += f.dissipated;
	return { f.force, -c.armA.cross(f.force) - f.torque, c.armB.cross(f.force) + f.torque };
}

} // namespace yade

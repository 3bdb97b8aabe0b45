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
	const Matrix3r axes = bodyAt(scene, joint.id1)->state->ori.toRotationMatrix();
	const timber::SpringGroup springs { joint.anchors1, joint.broken, joint.stiffness(), joint.normal };
	if (scene.iter % timber::modeSteps == 0 || !joint.modes.holdFor(springs, timber::pairInverseMass(a, b)))
		joint.modes = timber::jointModes(a, b, axes, springs);
	step.solver.prepareDashpot(k, step.bodies, joint.modes, axes, joint.dampingRatio, step.h);
}

timber::PairForce storeJoint(const timber::SolverStep& step, size_t k, Real& dissipated)
{
	const timber::DashpotConstraint& c = step.solver.dashpot(k);
	const timber::DashpotImpulse P = timber::dashpotImpulse(c);
	const Vector3r force = P.linear / step.h, torque = P.angular / step.h;
	dissipated += c.dissipated;
	return { force, -c.armA.cross(force) - torque, c.armB.cross(force) + torque };
}

} // namespace yade

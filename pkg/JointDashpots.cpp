// SPDX-License-Identifier: GPL-2.0-or-later
#include <JointDashpots.hpp>
#include <kernel/constants.hpp>

namespace yade {

namespace {
	Matrix3r axesOf(const Scene& scene, Body::id_t id) { return bodyAt(scene, id)->state->ori.toRotationMatrix(); }

	/// Modes of a joint's bodies, computed again after modeSteps, or when springs or masses have changed.
	void updateModes(TimberJoint& joint, const Scene& scene, const timber::SolverBody& a, const timber::SolverBody& b)
	{
		const timber::SpringGroup springs { joint.anchors1, joint.broken, joint.stiffness(), joint.normal };
		if (scene.iter % timber::modeSteps != 0 && joint.modes.holdFor(springs, timber::pairInverseMass(a, b))) return;
		joint.modes = timber::jointModes(a, b, axesOf(scene, joint.id1), springs);
	}
}

void findImplicitJoints(const Scene& scene, const std::vector<timber::SolverBody>& bodies, bool alsoStiff, std::vector<TimberJoint*>& found)
{
	found.clear();
	const JointEngine* engine = findEngine<JointEngine>(scene);
	if (!engine || engine->dead) return;
	const bool isDue = scene.iter % timber::modeSteps == 0;
	for (const shared_ptr<TimberJoint>& joint : engine->joints) {
		const bool mayBeStiff = alsoStiff && (isDue || !joint->modes.areResolved(scene.dt, joint->stiffness()));
		if ((joint->dampingRatio == 0 && !mayBeStiff) || joint->isBroken() || joint->id1 == joint->id2) continue;
		if (!bodyAt(scene, joint->id1) || !bodyAt(scene, joint->id2)) continue;
		const timber::SolverBody &a = bodies[joint->id1], &b = bodies[joint->id2];
		if (timber::pairInverseMass(a, b) == 0) continue;
		updateModes(*joint, scene, a, b);
		if (joint->dampingRatio > 0 || joint->modes.isStiff(scene.dt)) found.push_back(joint.get());
	}
}

void prepareJoint(const timber::SolverStep& step, size_t k, TimberJoint& joint, const Scene& scene)
{
	step.solver.prepareDashpot(k, step.bodies, joint.modes, axesOf(scene, joint.id1), joint.dampingRatio, step.h);
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

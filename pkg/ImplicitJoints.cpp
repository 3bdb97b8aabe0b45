// SPDX-License-Identifier: GPL-2.0-or-later
#include <ImplicitJoints.hpp>
#include <kernel/constants.hpp>

namespace yade {

namespace {
	Matrix3r axesOf(const Scene& scene, Body::id_t id) { return bodyAt(scene, id)->state->ori.toRotationMatrix(); }

	/// Modes of a joint's bodies, of which one is free. qA, qB: their orientations.
	void updateModes(TimberJoint& joint, const Quaternionr& qA, const Quaternionr& qB, const timber::SolverBody& a,
	        const timber::SolverBody& b)
	{
		const timber::JointState now { joint.intactSprings(), joint.stiffness(), timber::pairInverseMass(a, b),
			a.inverseInertia.trace() + b.inverseInertia.trace(), qA.conjugate() * qB };
		if (!joint.modes.state.fits(now))
			joint.modes = timber::jointModes(a, b, qA.toRotationMatrix(), joint.springGroup(), now);
	}

	bool isImplicit(
	        TimberJoint& joint, const Scene& scene, const std::vector<timber::SolverBody>& bodies, bool alsoStiff)
	{
		if ((!joint.isDamped() && !alsoStiff) || joint.isBroken() || joint.id1 == joint.id2) return false;
		const Body *b1 = bodyAt(scene, joint.id1), *b2 = bodyAt(scene, joint.id2);
		if (!b1 || !b2) return false;
		const timber::SolverBody &a = bodies[joint.id1], &b = bodies[joint.id2];
		if (timber::pairInverseMass(a, b) == 0) return false;
		updateModes(joint, b1->state->ori, b2->state->ori, a, b);
		return joint.isDamped() || joint.modes.isStiff(scene.dt);
	}
}

void findImplicitJoints(const Scene& scene, const std::vector<timber::SolverBody>& bodies, bool alsoStiff,
        std::vector<ImplicitJoint>& implicit, JointEnergies& energies)
{
	implicit.clear();
	const JointEngine* engine = findEngine<JointEngine>(scene);
	if (!engine) return;
	for (size_t k = 0; k < engine->joints.size(); ++k) {
		TimberJoint& joint = *engine->joints[k];
		if (isImplicit(joint, scene, bodies, alsoStiff))
			implicit.push_back({ &joint, engine->lastForce(k).tangent });
		else {
			const Real energy = joint.newmarkEnergy;
			joint.setNewmark({});
			(energy > 0 ? energies.dissipated : energies.created) += math::abs(energy);
		}
	}
}

Real dashpotPower(const Scene& scene, const std::vector<timber::SolverBody>& bodies)
{
	const JointEngine* engine = findEngine<JointEngine>(scene);
	Real power = 0;
	for (size_t k = 0; engine && k < engine->joints.size(); ++k) {
		TimberJoint& joint = *engine->joints[k];
		if (isImplicit(joint, scene, bodies, false))
			power += timber::dashpotPower(bodies[joint.id1], bodies[joint.id2], joint.modes,
			        axesOf(scene, joint.id1), joint.damping(engine->lastForce(k).tangent));
	}
	return power;
}

void prepareJoint(timber::ContactSolver& solver, size_t k, const ImplicitJoint& implicit, const Scene& scene)
{
	const TimberJoint& joint = *implicit.joint;
	solver.prepareJoint(
	        k, joint.modes, axesOf(scene, joint.id1), joint.damping(implicit.tangent), joint.newmark());
}

timber::PairForce storeJoint(
        const timber::ContactSolver& solver, size_t k, const Scene& scene, TimberJoint& joint, JointEnergies& energies)
{
	const timber::ModalConstraint& c = solver.joint(k);
	const timber::JointImpulse P = timber::jointImpulse(c);
	const Vector3r force = P.linear / scene.dt, torque = P.angular / scene.dt;
	joint.setNewmark(c.history);
	energies.stored += c.history.stored;
	energies.dissipated += c.dissipated;
	return { force, -c.armA.cross(force) - torque, c.armB.cross(force) + torque };
}

} // namespace yade

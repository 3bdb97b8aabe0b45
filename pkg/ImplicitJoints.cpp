// SPDX-License-Identifier: GPL-2.0-or-later
#include <ImplicitJoints.hpp>
#include <kernel/constants.hpp>

namespace yade {

namespace {
	Matrix3r axesOf(const Scene& scene, Body::id_t id) { return bodyAt(scene, id)->state->ori.toRotationMatrix(); }

	/// Modes of a joint's bodies, of which one is free, computed again where those of the last step no longer serve.
	/// qA, qB: orientations of the bodies; h: step [s].
	void updateModes(TimberJoint& joint, const Quaternionr& qA, const Quaternionr& qB, const timber::SolverBody& a,
	        const timber::SolverBody& b, Real h)
	{
		const timber::JointState now { joint.intactSprings(), joint.stiffness(), timber::pairInverseMass(a, b),
			a.inverseInertia.trace() + b.inverseInertia.trace(), qA.conjugate() * qB };
		if (!joint.modes.state.fits(now, joint.modes.largestTurn(h, joint.damping(1))))
			joint.modes = timber::jointModes(a, b, qA.toRotationMatrix(), joint.springGroup(), now);
	}

	/// Whether two bodies have a joint that may be in the solver; with its modes.
	bool hasModes(TimberJoint& joint, const Scene& scene, const std::vector<timber::SolverBody>& bodies)
	{
		if (joint.isBroken() || joint.id1 == joint.id2) return false;
		const Body *b1 = bodyAt(scene, joint.id1), *b2 = bodyAt(scene, joint.id2);
		if (!b1 || !b2) return false;
		const timber::SolverBody &a = bodies[joint.id1], &b = bodies[joint.id2];
		if (timber::pairInverseMass(a, b) == 0) return false;
		updateModes(joint, b1->state->ori, b2->state->ori, a, b, scene.dt);
		return true;
	}

	/// Energy by which a yielding joint errs in this step if its springs cross a corner of their law. [J]
	Real errorOfYielding(
	        const TimberJoint& joint, const Scene& scene, const std::vector<timber::SolverBody>& bodies)
	{
		const Quaternionr &qA = bodyAt(scene, joint.id1)->state->ori,
		                  &qB = bodyAt(scene, joint.id2)->state->ori;
		const timber::SolverBody &a = bodies[joint.id1], &b = bodies[joint.id2];
		Real error = 0;
		for (size_t k = 0; k < joint.broken.size(); ++k) {
			if (joint.broken[k]) continue;
			const Real way = scene.dt
			        * timber::relativeVelocity<double>(qA * joint.anchors1[k], qB * joint.anchors2[k],
			                a.newVelocity, a.newSpin, b.newVelocity, b.newSpin)
			                  .norm();
			if (way * joint.kn > timber::yieldTravel * joint.strength)
				error += joint.stiffness().normal * way * way / 8;
		}
		return error;
	}

	/// Kinetic energy of the bodies, and what the joints have stored and dissipated. [J]
	Real energyOf(const JointEngine& joints, const std::vector<timber::SolverBody>& bodies)
	{
		Real energy = joints.elastic + joints.yielded + joints.released;
		for (const timber::SolverBody& b : bodies)
			if (b.inverseMass > 0) energy += b.velocity.squaredNorm() / (2 * b.inverseMass);
		return energy;
	}

	/// A joint that stops being stiff without a step of the solver.
	void release(TimberJoint& joint, ImplicitJointResult& result)
	{
		(joint.storedEnergy > 0 ? result.dashpots : result.debt) += math::abs(joint.storedEnergy);
		joint.soften();
	}

	/// Power of the bodies on the unbroken springs. forces: of these, world frame [N]; returns [W].
	Real stretchingPower(const TimberJoint& joint, const State& a, const State& b, const vector<Vector3r>& forces)
	{
		Real power = 0;
		for (size_t k = 0; k < joint.broken.size(); ++k)
			if (!joint.broken[k])
				power += forces[k].dot(timber::relativeVelocity<double>(a.ori * joint.anchors1[k],
				        b.ori * joint.anchors2[k], a.vel, a.angVel, b.vel, b.angVel));
		return power;
	}

	timber::SpringSteps springSteps(TimberJoint& joint, const Scene& scene)
	{
		const State &s1 = *bodyAt(scene, joint.id1)->state, &s2 = *bodyAt(scene, joint.id2)->state;
		const Quaternionr toA = s1.ori.conjugate();
		const vector<Vector3r> forces = joint.springForces();
		std::unique_ptr<timber::SpringLaw> law = joint.springLaw();
		std::vector<timber::SpringStep> steps;
		for (size_t k = 0; k < joint.broken.size(); ++k) {
			if (joint.broken[k]) continue;
			const Vector3r end = toA * (s2.pos + s2.ori * joint.anchors2[k] - s1.pos),
			               stretch = end - joint.anchors1[k], force = toA * forces[k];
			timber::SpringStep step { k, stretch, stretch, Vector3r::Zero(), joint.modes.rates(end),
				force };
			if (joint.isStiff()) step.from = joint.halfStretches[k];
			else step.applied = force;
			steps.push_back(std::move(step));
		}
		const bool enters = !joint.isStiff();
		timber::SpringSteps result(std::move(law), std::move(steps), joint.storedEnergy, scene.dt);
		// The bodies' velocities are those of half a step before the placement
		if (enters)
			result.account = result.startEnergy() - scene.dt / 2 * stretchingPower(joint, s1, s2, forces);
		return result;
	}

	/// Stretches and forces of a stiff joint after the step, and its broken springs.
	void storeSprings(const timber::SpringSteps& steps, const Quaternionr& ori, const ImplicitJoint& implicit,
	        ImplicitJointResult& result)
	{
		TimberJoint& joint = *implicit.joint;
		joint.stiffen();
		for (const timber::SpringStep& s : steps.springs) {
			joint.halfStretches[s.spring] = s.stretch;
			joint.stretches[s.spring] = ori * s.placed;
			joint.forces[s.spring] = ori * s.force;
			if (!s.breaks) continue;
			const auto cause = timber::breakCause(
			        timber::springForce<double>(joint.stiffness(), s.stretch, joint.normal));
			result.breaks.push_back({ implicit.index, { s.spring, cause, s.end.force.norm(), 0 } });
		}
	}

	/// Forces of the springs about the bodies' centres. armA, armB: from these to the joint's centre
	timber::JointForce totalForce(const timber::ModalConstraint& c, const TimberJoint& joint)
	{
		timber::JointForce total;
		for (const timber::SpringStep& s : c.springs.springs) {
			const Vector3r force = c.axesA * s.force,
			               end = c.axesA * (s.placed + joint.anchors1[s.spring]); // from the centre of A
			total.force += force;
			total.torqueA += end.cross(force);
			total.torqueB -= (end - c.armA + c.armB).cross(force);
			total.sum += s.force.norm();
			total.largestSquared = math::max(total.largestSquared, Real(s.force.squaredNorm()));
		}
		return total;
	}

	/// Energies of a stiff joint after the step. A brittle one that the step resolves, and of which no spring breaks, goes
	/// back to JointEngine, with the energy of explicit springs; it counts what they have beyond the account.
	void storeEnergies(const timber::ModalConstraint& c, const ImplicitJoint& implicit, timber::JointForce& total,
	        ImplicitJointResult& result)
	{
		TimberJoint& joint = *implicit.joint;
		const bool breaks = std::any_of(c.springs.springs.begin(), c.springs.springs.end(),
		        [](const timber::SpringStep& s) { return s.breaks; });
		Real& dissipated = joint.yields() ? result.yielded : breaks ? result.released : result.dashpots;
		dissipated += c.springs.dissipated;
		joint.storedEnergy = c.springs.account;
		if (!breaks && !joint.yields() && !joint.modes.isStiff(c.h / timber::softPhase)) {
			const timber::SpringSteps::Leaving left = c.springs.leave(c.h, c.after);
			dissipated += left.dissipated;
			result.stored += total.energy = left.stored;
			total.isKnown = true;
			return joint.soften();
		}
		result.stored += joint.storedEnergy;
		result.debt += math::max(Real(0), -joint.storedEnergy);
	}
}

void ImplicitJointResult::add(const ImplicitJointResult& other)
{
	stored += other.stored;
	dashpots += other.dashpots;
	yielded += other.yielded;
	released += other.released;
	debt += other.debt;
	breaks.insert(breaks.end(), other.breaks.begin(), other.breaks.end());
}

ImplicitJointResult findImplicitJoints(const Scene& scene, const std::vector<timber::SolverBody>& bodies,
        bool alsoStiff, std::vector<ImplicitJoint>& implicit)
{
	ImplicitJointResult lost;
	implicit.clear();
	JointEngine* engine = findEngine<JointEngine>(scene);
	if (!engine) return lost;
	Real energy = -1; // of the scene, once a joint needs it
	const auto isFast = [&](const TimberJoint& joint) {
		const Real error = joint.yields() ? errorOfYielding(joint, scene, bodies) : 0;
		if (error > 0 && energy < 0) energy = energyOf(*engine, bodies);
		return error > 0 && error > timber::yieldError * energy;
	};
	for (size_t k = 0; k < engine->joints.size(); ++k) {
		TimberJoint& joint = *engine->joints[k];
		const bool may = (joint.isDamped() || alsoStiff) && hasModes(joint, scene, bodies);
		const bool isStiff
		        = may && alsoStiff && (joint.isStiff() || joint.modes.isStiff(scene.dt) || isFast(joint));
		if (may && (isStiff || joint.isDamped()))
			implicit.push_back({ &joint, k, isStiff, engine->lastForce(k).tangent });
		if (isStiff && !joint.isStiff()) engine->handOver(k);
		if (!isStiff && joint.isStiff()) release(joint, lost);
	}
	return lost;
}

Real dashpotPower(const Scene& scene, const std::vector<timber::SolverBody>& bodies)
{
	const JointEngine* engine = findEngine<JointEngine>(scene);
	Real power = 0;
	for (size_t k = 0; engine && k < engine->joints.size(); ++k) {
		TimberJoint& joint = *engine->joints[k];
		if (joint.isDamped() && hasModes(joint, scene, bodies))
			power += timber::dashpotPower(bodies[joint.id1], bodies[joint.id2], joint.modes,
			        axesOf(scene, joint.id1), joint.damping(engine->lastForce(k).tangent));
	}
	return power;
}

void prepareJoint(timber::ContactSolver& solver, size_t k, const ImplicitJoint& implicit, const Scene& scene)
{
	TimberJoint& joint = *implicit.joint;
	timber::SpringSteps springs;
	if (implicit.isStiff) springs = springSteps(joint, scene);
	const Real tangent = implicit.isStiff && joint.isDamped() ? springs.tangent() : implicit.tangent;
	timber::ModalConstraint& c
	        = solver.prepareJoint(k, joint.modes, axesOf(scene, joint.id1), joint.damping(tangent));
	if (implicit.isStiff) timber::addSprings(c, std::move(springs));
}

timber::PairForce storeJoint(const timber::ContactSolver& solver, size_t k, const Scene& scene,
        const ImplicitJoint& implicit, ImplicitJointResult& result)
{
	const timber::ModalConstraint& c = solver.joint(k);
	const timber::JointImpulse P = timber::jointImpulse(c);
	const Vector3r force = P.linear / scene.dt, torque = P.angular / scene.dt;
	result.dashpots += c.dissipated;
	if (implicit.isStiff) {
		const Quaternionr& ori = bodyAt(scene, implicit.joint->id1)->state->ori;
		storeSprings(c.springs, ori, implicit, result);
		timber::JointForce total = totalForce(c, *implicit.joint);
		storeEnergies(c, implicit, total, result);
		findEngine<JointEngine>(scene)->setForce(implicit.index, total);
	}
	return { force, -c.armA.cross(force) - torque, c.armB.cross(force) + torque };
}

} // namespace yade

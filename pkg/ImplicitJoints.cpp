// SPDX-License-Identifier: GPL-2.0-or-later
#include <ImplicitJoints.hpp>
#include <kernel/constants.hpp>

namespace yade {

namespace {
	Matrix3r axesOf(const Scene& scene, Body::id_t id) { return bodyAt(scene, id)->state->ori.toRotationMatrix(); }

	/// Modes of a joint's bodies, of which one is free, computed again where those of the last step no longer serve.
	/// qA, qB: orientations of the bodies; h: step [s].
	void updateModes(timber::JointEntry& joint, const timber::JointSprings& springs, const Quaternionr& qA,
	        const Quaternionr& qB, const timber::SolverBody& a, const timber::SolverBody& b, Real h)
	{
		const timber::JointState now { joint.intact, joint.stiffness, timber::pairInverseMass(a, b),
			a.inverseInertia.trace() + b.inverseInertia.trace(), qA.conjugate() * qB };
		if (joint.modes.state.fits(now, joint.modes.largestTurn(h, joint.dampingAt(1)))) return;
		const vector<Vector3r> anchors = springs.all(&timber::JointSprings::anchorA);
		const vector<int> broken = springs.broken();
		joint.modes = timber::jointModes(
		        a, b, qA.toRotationMatrix(), { anchors, broken, joint.stiffness, joint.normal }, now);
	}

	/// Whether two bodies have a joint that may be in the solver; with its modes.
	bool hasModes(timber::JointEntry& joint, const timber::JointSprings& springs, const Scene& scene,
	        const std::vector<timber::SolverBody>& bodies)
	{
		if (joint.isBroken() || joint.bodyA == joint.bodyB) return false;
		const Body *b1 = bodyAt(scene, joint.bodyA), *b2 = bodyAt(scene, joint.bodyB);
		if (!b1 || !b2) return false;
		const timber::SolverBody &a = bodies[joint.bodyA], &b = bodies[joint.bodyB];
		if (timber::pairInverseMass(a, b) == 0) return false;
		updateModes(joint, springs, b1->state->ori, b2->state->ori, a, b, scene.dt);
		return true;
	}

	/// Energy by which a yielding joint errs in this step if its springs cross a corner of their law. [J]
	Real errorOfYielding(const timber::JointEntry& joint, const timber::JointSprings& springs, const Scene& scene,
	        const std::vector<timber::SolverBody>& bodies)
	{
		const Quaternionr &qA = bodyAt(scene, joint.bodyA)->state->ori,
		                  &qB = bodyAt(scene, joint.bodyB)->state->ori;
		const timber::SolverBody &a = bodies[joint.bodyA], &b = bodies[joint.bodyB];
		const Real limit = timber::yieldTravel * joint.springStrength();
		Real error = 0;
		for (size_t k = 0; k < springs.count; ++k) {
			if (!springs.isIntact(k)) continue;
			const Real way = scene.dt
			        * timber::relativeVelocity<double>(qA * springs.anchorA(k), qB * springs.anchorB(k),
			                a.newVelocity, a.newSpin, b.newVelocity, b.newSpin)
			                  .norm();
			if (way * joint.stiffness.normal > limit) error += joint.stiffness.normal * way * way / 8;
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
	void release(timber::JointEntry& joint, ImplicitJointResult& result)
	{
		(joint.account > 0 ? result.dashpots : result.debt) += math::abs(joint.account);
		joint.soften();
	}

	/// Power of the bodies on the unbroken springs. [W]
	Real stretchingPower(const timber::JointSprings& springs, const State& a, const State& b)
	{
		Real power = 0;
		for (size_t k = 0; k < springs.count; ++k)
			if (springs.isIntact(k))
				power += springs.force(k).dot(
				        timber::relativeVelocity<double>(a.ori * springs.anchorA(k),
				                b.ori * springs.anchorB(k), a.vel, a.angVel, b.vel, b.angVel));
		return power;
	}

	timber::SpringSteps springSteps(
	        timber::JointEntry& joint, const timber::JointSprings& springs, const Scene& scene)
	{
		const State &s1 = *bodyAt(scene, joint.bodyA)->state, &s2 = *bodyAt(scene, joint.bodyB)->state;
		const Quaternionr toA = s1.ori.conjugate();
		std::vector<timber::SpringStep> steps;
		for (size_t k = 0; k < springs.count; ++k) {
			if (!springs.isIntact(k)) continue;
			const Vector3r end = toA * (s2.pos + s2.ori * springs.anchorB(k) - s1.pos),
			               stretch = end - springs.anchorA(k), force = toA * springs.force(k);
			timber::SpringStep step { k, stretch, stretch, Vector3r::Zero(), joint.modes.rates(end),
				force };
			if (joint.isStiff()) step.from = joint.half[k];
			else step.applied = force;
			steps.push_back(std::move(step));
		}
		timber::SpringSteps result(joint.springLaw(), std::move(steps), joint.account, scene.dt);
		// The bodies' velocities are those of half a step before the placement
		if (!joint.isStiff())
			result.account = result.startEnergy() - scene.dt / 2 * stretchingPower(springs, s1, s2);
		return result;
	}

	/// Stretches and forces of a stiff joint after the step, and its broken springs.
	void storeSprings(const timber::SpringSteps& steps, const Quaternionr& ori, const ImplicitJoint& implicit,
	        ImplicitJointResult& result)
	{
		timber::JointEntry& joint = *implicit.joint;
		joint.half.resize(implicit.all.count, Vector3r::Zero());
		for (const timber::SpringStep& s : steps.springs) {
			joint.half[s.spring] = s.stretch;
			implicit.all.set(s.spring, ori * s.placed, ori * s.force);
			if (!s.breaks) continue;
			const auto cause = timber::breakCause(
			        timber::springForce<double>(joint.stiffness, s.stretch, joint.normal));
			result.breaks.push_back({ implicit.index, { s.spring, cause, s.end.force.norm(), 0 } });
		}
	}

	/// Forces of the springs about the bodies' centres. armA, armB: from these to the joint's centre
	timber::JointForce totalForce(const timber::ModalConstraint& c, const timber::JointSprings& springs)
	{
		timber::JointForce total;
		for (const timber::SpringStep& s : c.springs.springs) {
			const Vector3r force = c.axesA * s.force,
			               end = c.axesA * (s.placed + springs.anchorA(s.spring)); // from the centre of A
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
	void storeEnergies(const timber::ModalConstraint& c, timber::JointEntry& joint, ImplicitJointResult& result)
	{
		const bool breaks = std::any_of(c.springs.springs.begin(), c.springs.springs.end(),
		        [](const timber::SpringStep& s) { return s.breaks; });
		Real& dissipated = joint.yields() ? result.yielded : breaks ? result.released : result.dashpots;
		dissipated += c.springs.dissipated;
		joint.account = c.springs.account;
		if (!breaks && !joint.yields() && !joint.modes.isStiff(c.h / timber::softPhase)) {
			const timber::SpringSteps::Leaving left = c.springs.leave(c.h, c.after);
			dissipated += left.dissipated;
			result.stored += joint.total.energy = left.stored;
			joint.total.isKnown = true;
			return joint.soften();
		}
		result.stored += joint.account;
		result.debt += math::max(Real(0), -joint.account);
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
	timber::JointSet& set = engine->jointSet();
	const auto isFast = [&](const timber::JointEntry& joint) {
		const Real error = joint.yields() ? errorOfYielding(joint, set.springs(joint), scene, bodies) : 0;
		if (error > 0 && energy < 0) energy = energyOf(*engine, bodies);
		return error > 0 && error > timber::yieldError * energy;
	};
	for (size_t k = 0; k < set.joints.size(); ++k) {
		timber::JointEntry& joint = set.joints[k];
		const bool may = (joint.isDamped() || alsoStiff) && hasModes(joint, set.springs(joint), scene, bodies);
		const bool isStiff
		        = may && alsoStiff && (joint.isStiff() || joint.modes.isStiff(scene.dt) || isFast(joint));
		if (may && (isStiff || joint.isDamped()))
			implicit.push_back({ &joint, set.springs(joint), k, isStiff, joint.total.tangent });
		if (isStiff && !joint.isStiff()) engine->handOver(joint);
		if (!isStiff && joint.isStiff()) release(joint, lost);
	}
	return lost;
}

Real dashpotPower(const Scene& scene, const std::vector<timber::SolverBody>& bodies)
{
	const JointEngine* engine = findEngine<JointEngine>(scene);
	Real power = 0;
	for (size_t k = 0; engine && k < engine->jointSet().joints.size(); ++k) {
		timber::JointEntry& joint = engine->jointSet().joints[k];
		if (joint.isDamped() && hasModes(joint, engine->jointSet().springs(joint), scene, bodies))
			power += timber::dashpotPower(bodies[joint.bodyA], bodies[joint.bodyB], joint.modes,
			        axesOf(scene, joint.bodyA), joint.dampingAt(joint.total.tangent));
	}
	return power;
}

void prepareJoint(timber::ContactSolver& solver, size_t k, const ImplicitJoint& implicit, const Scene& scene)
{
	timber::JointEntry& joint = *implicit.joint;
	timber::SpringSteps springs;
	if (implicit.isStiff) springs = springSteps(joint, implicit.all, scene);
	const Real tangent = implicit.isStiff && joint.isDamped() ? springs.tangent() : implicit.tangent;
	timber::ModalConstraint& c
	        = solver.prepareJoint(k, joint.modes, axesOf(scene, joint.bodyA), joint.dampingAt(tangent));
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
		const Quaternionr& ori = bodyAt(scene, implicit.joint->bodyA)->state->ori;
		storeSprings(c.springs, ori, implicit, result);
		implicit.joint->total = totalForce(c, implicit.all);
		storeEnergies(c, *implicit.joint, result);
	}
	return { force, -c.armA.cross(force) - torque, c.armB.cross(force) + torque };
}

} // namespace yade

// SPDX-License-Identifier: GPL-2.0-or-later
#include <ImplicitJoints.hpp>
#include <kernel/constants.hpp>

namespace yade {

namespace {
	Matrix3r axesOf(const Scene& scene, Body::id_t id) { return bodyAt(scene, id)->state->ori.toRotationMatrix(); }

	/// Modes of a joint's bodies, of which one is free, computed again where those of the last step no longer serve.
	void updateModes(
	        TimberJoint& joint, const Scene& scene, const timber::SolverBody& a, const timber::SolverBody& b)
	{
		timber::JointState now { joint.intactSprings(), joint.stiffness(), timber::pairInverseMass(a, b),
			a.inverseInertia.trace() + b.inverseInertia.trace() };
		const bool isExplicit = !joint.isDamped() && !joint.isStiff() && !joint.modes.mayBeStiff(scene.dt);
		if (isExplicit && joint.modes.state.hasSame(now)) return;
		const Quaternionr &qA = bodyAt(scene, joint.id1)->state->ori,
		                  &qB = bodyAt(scene, joint.id2)->state->ori;
		now.relative = qA.conjugate() * qB;
		if (!joint.modes.state.fits(now, joint.modes.largestTurn(scene.dt, joint.damping(1))))
			joint.modes = timber::jointModes(a, b, qA.toRotationMatrix(), joint.springGroup(), now);
	}

	/// Whether a joint holds two bodies, of which one is free.
	bool holds(const TimberJoint& joint, const Scene& scene, const std::vector<timber::SolverBody>& bodies)
	{
		return !joint.isBroken() && joint.id1 != joint.id2 && bodyAt(scene, joint.id1)
		        && bodyAt(scene, joint.id2)
		        && timber::pairInverseMass(bodies[joint.id1], bodies[joint.id2]) > 0;
	}

	timber::SpringAxis springAxis(
	        const TimberJoint& joint, const Scene& scene, const std::vector<timber::SolverBody>& bodies)
	{
		const State &s1 = *bodyAt(scene, joint.id1)->state, &s2 = *bodyAt(scene, joint.id2)->state;
		const size_t spring = std::find(joint.broken.begin(), joint.broken.end(), 0) - joint.broken.begin();
		const Vector3r armB = s2.ori * joint.anchors2[spring];
		return { bodies[joint.id1], bodies[joint.id2], s1.ori * joint.normal, s2.pos + armB - s1.pos, armB,
			joint.stiffness().normal };
	}

	/// A joint that may be in the solver, with its modes. isStiff: whether the step does not resolve its springs.
	ImplicitJoint withModes(TimberJoint& joint, size_t index, const JointEngine& engine, const Scene& scene,
	        const std::vector<timber::SolverBody>& bodies)
	{
		ImplicitJoint result { &joint, index, false, engine.lastForce(index).tangent, joint.isAxial(), {} };
		if (result.isAxial) {
			result.axis = springAxis(joint, scene, bodies);
			result.isStiff = scene.dt * result.axis.frequency() > timber::stiffPhase;
		} else {
			updateModes(joint, scene, bodies[joint.id1], bodies[joint.id2]);
			result.isStiff = joint.modes.isStiff(scene.dt);
		}
		return result;
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

	/// G of spring_step.hpp. end: of the spring in B, in the frame of A [m]
	template <int n> timber::ModalVectors<n> ratesOf(const ImplicitJoint& implicit, const Vector3r& end)
	{
		if constexpr (n == 1) return std::sqrt(implicit.axis.response) * implicit.joint->normal;
		else return implicit.joint->modes.rates(end);
	}

	template <int n> timber::SpringSteps<n> springSteps(const ImplicitJoint& implicit, const Scene& scene)
	{
		TimberJoint& joint = *implicit.joint;
		const State &s1 = *bodyAt(scene, joint.id1)->state, &s2 = *bodyAt(scene, joint.id2)->state;
		const Quaternionr toA = s1.ori.conjugate();
		const vector<Vector3r> forces = joint.springForces();
		const auto acting = [&](const Vector3r& stretch) -> Vector3r {
			if constexpr (n == 1) return joint.normal.dot(stretch) * joint.normal;
			else return stretch;
		};
		std::vector<timber::SpringStep<n>> steps;
		for (size_t k = 0; k < joint.broken.size(); ++k) {
			if (joint.broken[k]) continue;
			const Vector3r end = toA * (s2.pos + s2.ori * joint.anchors2[k] - s1.pos),
			               stretch = acting(end - joint.anchors1[k]), force = toA * forces[k];
			timber::SpringStep<n> step { k, stretch, stretch, Vector3r::Zero(), ratesOf<n>(implicit, end),
				force };
			if (joint.isStiff()) step.from = acting(joint.halfStretches[k]);
			else step.applied = force;
			steps.push_back(std::move(step));
		}
		const bool enters = !joint.isStiff();
		timber::SpringSteps<n> result(joint.springLaw(), std::move(steps), joint.storedEnergy, scene.dt);
		// The bodies' velocities are those of half a step before the placement
		if (enters)
			result.account = result.startEnergy() - scene.dt / 2 * stretchingPower(joint, s1, s2, forces);
		return result;
	}

	/// Stretches and forces of a stiff joint after the step, and its broken springs.
	template <int n>
	void storeSprings(const timber::SpringSteps<n>& steps, const Quaternionr& ori, const ImplicitJoint& implicit,
	        ImplicitJointResult& result)
	{
		TimberJoint& joint = *implicit.joint;
		joint.stiffen();
		for (const timber::SpringStep<n>& s : steps.springs) {
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
	template <int n> timber::JointForce totalForce(const timber::ModalConstraint<n>& c, const TimberJoint& joint)
	{
		timber::JointForce total;
		for (const timber::SpringStep<n>& s : c.springs.springs) {
			const Vector3r force = c.axesA * s.force, // end: from the centre of A
			        end = n == 1 ? c.armA : Vector3r(c.axesA * (s.placed + joint.anchors1[s.spring]));
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
	template <int n>
	void storeEnergies(const timber::ModalConstraint<n>& c, const ImplicitJoint& implicit,
	        timber::JointForce& total, ImplicitJointResult& result)
	{
		TimberJoint& joint = *implicit.joint;
		const bool breaks = std::any_of(c.springs.springs.begin(), c.springs.springs.end(),
		        [](const timber::SpringStep<n>& s) { return s.breaks; });
		Real& dissipated = joint.yields() ? result.yielded : breaks ? result.released : result.dashpots;
		dissipated += c.springs.dissipated;
		joint.storedEnergy = c.springs.account;
		if (!breaks && !joint.yields() && c.isSoft()) {
			const auto left = c.springs.leave(c.h, c.after);
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
		bool isStiff = false;
		if ((joint.isDamped() || alsoStiff) && holds(joint, scene, bodies)) {
			ImplicitJoint one = withModes(joint, k, *engine, scene, bodies);
			one.isStiff = isStiff = alsoStiff && (joint.isStiff() || one.isStiff || isFast(joint));
			if (isStiff || joint.isDamped()) implicit.push_back(one);
		}
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
		if (!joint.isDamped() || !holds(joint, scene, bodies)) continue;
		const ImplicitJoint one = withModes(joint, k, *engine, scene, bodies);
		const timber::SolverBody &a = bodies[joint.id1], &b = bodies[joint.id2];
		const timber::JointDamping damping = joint.damping(one.tangent);
		power += one.isAxial ? timber::dashpotPower(a, b, one.axis, damping)
		                     : timber::dashpotPower(a, b, joint.modes, axesOf(scene, joint.id1), damping);
	}
	return power;
}

void addJoint(timber::ContactSolver& solver, ImplicitJoint& implicit)
{
	const Body::id_t a = implicit.joint->id1, b = implicit.joint->id2;
	implicit.place = implicit.isAxial ? solver.addJoint<1>(a, b) : solver.addJoint<6>(a, b);
}

namespace {
	/// modes: of n
	template <int n, class Modes>
	void prepare(
	        timber::ContactSolver& solver, const ImplicitJoint& implicit, const Modes& modes, const Scene& scene)
	{
		TimberJoint& joint = *implicit.joint;
		timber::SpringSteps<n> springs;
		if (implicit.isStiff) springs = springSteps<n>(implicit, scene);
		const Real tangent = implicit.isStiff && joint.isDamped() ? springs.tangent() : implicit.tangent;
		timber::ModalConstraint<n>& c = solver.prepareJoint<n>(
		        implicit.place, modes, axesOf(scene, joint.id1), joint.damping(tangent));
		if (implicit.isStiff) timber::addSprings(c, std::move(springs));
	}

	template <int n>
	timber::PairForce store(const timber::ModalConstraint<n>& c, const Scene& scene, const ImplicitJoint& implicit,
	        ImplicitJointResult& result)
	{
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
}

void prepareJoint(timber::ContactSolver& solver, const ImplicitJoint& implicit, const Scene& scene)
{
	if (implicit.isAxial) prepare<1>(solver, implicit, implicit.axis, scene);
	else prepare<6>(solver, implicit, implicit.joint->modes, scene);
}

timber::PairForce storeJoint(const timber::ContactSolver& solver, const Scene& scene, const ImplicitJoint& implicit,
        ImplicitJointResult& result)
{
	return implicit.isAxial ? store(solver.joint<1>(implicit.place), scene, implicit, result)
	                        : store(solver.joint<6>(implicit.place), scene, implicit, result);
}

} // namespace yade

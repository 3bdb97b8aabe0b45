// SPDX-License-Identifier: GPL-2.0-or-later
#include <ImplicitJoints.hpp>
#include <kernel/constants.hpp>

namespace yade {

namespace {
	using Bodies = std::vector<timber::SolverBody>;

	/// Modes of a joint's bodies, of which one is free, computed again where those of the last step no longer serve.
	void updateModes(const ImplicitJoint& implicit, Real h, const Bodies& bodies)
	{
		const timber::JointEntry& joint = *implicit.joint;
		const timber::JointSprings& springs = implicit.springs;
		timber::JointModes& modes = *implicit.modes;
		const timber::SolverBody &a = bodies[joint.bodyA], &b = bodies[joint.bodyB];
		timber::JointState now { joint.intact, joint.stiffness, { a.inverseMass, b.inverseMass },
			{ a.inverseInertia.trace(), b.inverseInertia.trace() } };
		const bool isExplicit = !joint.isDamped() && !joint.isStiff() && !modes.mayBeStiff(h);
		if (isExplicit && modes.state.hasSame(now)) return;
		now.relative = a.axes.transpose() * b.axes;
		now.opening = a.axes.transpose() * (b.position + b.axes * joint.centreB - a.position) - joint.centreA;
		const double turn = modes.largestTurn(h, joint.dampingAt(1));
		if (modes.state.fits(now, turn, modes.shiftOf(turn))) return;
		timber::SpringGroup unbroken { {}, joint.stiffness, joint.normal };
		for (size_t k = 0; k < springs.count; ++k)
			if (springs.isIntact(k)) unbroken.anchors.push_back(springs.anchorA(k));
		modes = timber::jointModes(a, b, a.axes, unbroken, now);
	}

	/// Whether a joint holds two bodies, of which one is free.
	bool holds(const timber::JointEntry& joint, const Bodies& bodies)
	{
		const auto isBody = [&](int id) { return id >= 0 && size_t(id) < bodies.size(); };
		return !joint.isBroken() && joint.bodyA != joint.bodyB && isBody(joint.bodyA) && isBody(joint.bodyB)
		        && timber::pairInverseMass(bodies[joint.bodyA], bodies[joint.bodyB]) > 0;
	}

	timber::SpringAxis springAxis(
	        const timber::JointEntry& joint, const timber::JointSprings& springs, const Bodies& bodies)
	{
		const timber::SolverBody &a = bodies[joint.bodyA], &b = bodies[joint.bodyB];
		size_t spring = 0;
		while (!springs.isIntact(spring))
			++spring;
		const Vector3r armB = b.axes * springs.anchorB(spring);
		return { a, b, a.axes * joint.normal, b.position + armB - a.position, armB, joint.stiffness.normal };
	}

	/// Completes a joint that may be in the solver, with its modes. first: of its line, null if none is listed.
	void addModes(ImplicitJoint& one, const ImplicitJoint* first, Real h, const Bodies& bodies)
	{
		timber::JointEntry& joint = *one.joint;
		if (one.isAxial) {
			if (first) {
				one.axis = first->axis;
				one.axis.stiffness = joint.stiffness.normal;
				one.axis.others = 0;
			} else one.axis = springAxis(joint, one.springs, bodies);
			one.isStiff = h * one.axis.frequency() > timber::stiffPhase;
		} else {
			updateModes(one, h, bodies);
			one.isStiff = one.modes->isStiff(h);
		}
	}

	/// A joint that may be in the solver, without its modes.
	ImplicitJoint implicitJoint(timber::JointSet& set, size_t index)
	{
		timber::JointEntry& joint = set.joints[index];
		return { &joint, &set.modesOf(joint), set.springs(joint), index, false, joint.total.tangent,
			joint.isAxial(), {} };
	}

	/// Largest velocity of a spring's ends relative to each other, at most. [m/s]
	Real largestRate(const timber::JointEntry& joint, const timber::SolverBody& a, const timber::SolverBody& b)
	{
		const Vector3r between = timber::relativeVelocity<double>(a.axes * joint.centreA,
		        b.axes * joint.centreB, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin);
		return between.norm() + (a.newSpin.norm() + b.newSpin.norm()) * joint.reach;
	}

	/// Velocities of the unbroken springs, of those along an axis of A along it, at their ends, about which this axis
	/// turns them. [m/s]
	template <class Visit> void visitRates(const ImplicitJoint& implicit, const Bodies& bodies, Visit visit)
	{
		const timber::JointEntry& joint = *implicit.joint;
		const timber::JointSprings& springs = implicit.springs;
		const timber::SolverBody &a = bodies[joint.bodyA], &b = bodies[joint.bodyB];
		const bool actsAlong = joint.stiffness.shear == 0;
		const Vector3r line = a.axes * joint.normal;
		for (size_t i = 0; i < springs.count; ++i) {
			if (!springs.isIntact(i)) continue;
			const Vector3r armB = b.axes * springs.anchorB(i),
			               armA = actsAlong ? Vector3r(b.position + armB - a.position)
			                                : Vector3r(a.axes * springs.anchorA(i)),
			               velocity = timber::relativeVelocity<double>(
			                       armA, armB, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin);
			visit(actsAlong ? math::abs(line.dot(velocity)) : velocity.norm());
		}
	}

	/// Energy by which a yielding joint errs in this step if its springs cross a corner of their law. [J]
	Real errorOfYielding(const ImplicitJoint& implicit, Real h, const Bodies& bodies)
	{
		const timber::JointEntry& joint = *implicit.joint;
		const Real k = joint.stiffness.normal, limit = timber::yieldTravel * joint.springStrength() / (h * k);
		Real error = 0;
		const auto add = [&](Real rate) {
			if (rate > limit) error += k * (h * rate) * (h * rate) / 8;
		};
		if (implicit.isAxial) add(math::abs(implicit.axis.rate));
		else if (joint.stiffness.shear == 0
		        || largestRate(joint, bodies[joint.bodyA], bodies[joint.bodyB]) > limit)
			visitRates(implicit, bodies, add);
		return error;
	}

	/// Kinetic energy of the bodies, and what the joints have stored and dissipated. [J]
	Real energyOf(const JointEngine& joints, const Bodies& bodies)
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
	Real stretchingPower(
	        const timber::JointSprings& springs, const timber::SolverBody& a, const timber::SolverBody& b)
	{
		Real power = 0;
		for (size_t k = 0; k < springs.count; ++k)
			if (springs.isIntact(k))
				power += springs.force(k).dot(
				        timber::relativeVelocity<double>(a.axes * springs.anchorA(k),
				                b.axes * springs.anchorB(k), a.velocity, a.spin, b.velocity, b.spin));
		return power;
	}

	/// Parts along the axis of springs that act along one; zero: in all directions.
	template <int columns>
	Eigen::Matrix<Real, 3, columns> acting(const Vector3r& axis, const Eigen::Matrix<Real, 3, columns>& x)
	{
		if (axis.isZero(0)) return x;
		return axis * (axis.transpose() * x);
	}

	/// G of spring_step.hpp. end: of the spring in B, in the frame of A [m]
	template <int n> timber::ModalVectors<n> ratesOf(const ImplicitJoint& implicit, const Vector3r& end)
	{
		if constexpr (n == 1) return std::sqrt(implicit.axis.response) * implicit.joint->normal;
		else return implicit.modes->rates(end);
	}

	template <int n> timber::SpringSteps<n> springSteps(const ImplicitJoint& implicit, Real h, const Bodies& bodies)
	{
		timber::JointEntry& joint = *implicit.joint;
		const timber::JointSprings& springs = implicit.springs;
		const timber::SolverBody &a = bodies[joint.bodyA], &b = bodies[joint.bodyB];
		const Matrix3r toA = a.axes.transpose();
		const Vector3r axis = joint.axis();
		std::vector<timber::SpringStep<n>> steps;
		for (size_t k = 0; k < springs.count; ++k) {
			if (!springs.isIntact(k)) continue;
			const Vector3r end = toA * (b.position + b.axes * springs.anchorB(k) - a.position),
			               stretch = acting<1>(axis, end - springs.anchorA(k)),
			               force = toA * springs.force(k);
			timber::SpringStep<n> step { k, stretch, stretch, Vector3r::Zero(),
				acting<n>(axis, ratesOf<n>(implicit, end)), force };
			if (joint.isStiff()) step.from = acting<1>(axis, joint.half[k]);
			else step.applied = force;
			steps.push_back(std::move(step));
		}
		timber::SpringSteps<n> result(joint.springLaw(), std::move(steps), joint.account, h);
		// The bodies' velocities are those of half a step before the placement
		if (!joint.isStiff()) result.account = result.startEnergy() - h / 2 * stretchingPower(springs, a, b);
		return result;
	}

	/// Stretches and forces of a stiff joint after the step, and its broken springs.
	template <int n>
	void storeSprings(const timber::SpringSteps<n>& steps, const Matrix3r& axes, const ImplicitJoint& implicit,
	        ImplicitJointResult& result)
	{
		timber::JointEntry& joint = *implicit.joint;
		joint.half.resize(implicit.springs.count, Vector3r::Zero());
		for (const timber::SpringStep<n>& s : steps.springs) {
			joint.half[s.spring] = s.stretch;
			implicit.springs.set(s.spring, axes * s.placed, axes * s.force);
			if (!s.breaks) continue;
			const auto cause = timber::breakCause(
			        timber::springForce<double>(joint.stiffness, s.stretch, joint.normal));
			result.breaks.push_back({ implicit.index, { s.spring, cause, s.end.force.norm(), 0 } });
		}
	}

	/// Forces of the springs about the centres of bodies in these states.
	template <int n>
	timber::JointForce totalForce(const timber::ModalConstraint<n>& c, const timber::JointSprings& springs,
	        const timber::SolverBody& a, const timber::SolverBody& b)
	{
		timber::JointForce total;
		for (const timber::SpringStep<n>& s : c.springs.springs) {
			const Vector3r force = c.axesA * s.force, armB = b.axes * springs.anchorB(s.spring);
			total.force += force;
			total.torqueA += (b.position + armB - a.position).cross(force);
			total.torqueB -= armB.cross(force);
			total.sum += s.force.norm();
			total.largestSquared = math::max(total.largestSquared, Real(s.force.squaredNorm()));
		}
		return total;
	}

	/// Energies of a stiff joint after the step. A brittle one that the step resolves, and of which no spring breaks, goes
	/// back to JointEngine, with the energy of explicit springs; it counts what they have beyond the account.
	template <int n>
	void storeEnergies(const timber::ModalConstraint<n>& c, timber::JointEntry& joint, ImplicitJointResult& result)
	{
		const bool breaks = std::any_of(c.springs.springs.begin(), c.springs.springs.end(),
		        [](const timber::SpringStep<n>& s) { return s.breaks; });
		Real& dissipated = joint.yields() ? result.yielded : breaks ? result.released : result.dashpots;
		dissipated += c.springs.dissipated;
		joint.account = c.springs.account;
		if (!breaks && !joint.yields() && c.isSoft()) {
			const auto left = c.springs.leave(c.h, c.after);
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

namespace {
	/// Search for the joints that are in the solver in a step of h [s].
	struct JointSearch {
		static constexpr size_t none = std::numeric_limits<size_t>::max();
		JointEngine& engine;
		const Bodies& bodies;
		const Real h;
		const bool alsoStiff;
		std::vector<ImplicitJoint>& found;
		std::vector<size_t> firsts; ///< place of the first dashpot of each line in `found`
		Real energy = -1; ///< of the scene, once a joint needs it [J]

		bool isFast(const ImplicitJoint& one)
		{
			const Real error = one.joint->yields() ? errorOfYielding(one, h, bodies) : 0;
			if (error > 0 && energy < 0) energy = energyOf(engine, bodies);
			return error > 0 && error > timber::yieldError * energy;
		}
		/// Lists a joint that acts in the solver; the first dashpot of a line acts for all. Returns whether it is stiff.
		bool list(size_t index)
		{
			timber::JointEntry& joint = engine.jointSet().joints[index];
			if (!(joint.isDamped() || alsoStiff) || !holds(joint, bodies)) return false;
			size_t& place = firsts[joint.line];
			ImplicitJoint* const first = place == none ? nullptr : &found[place];
			ImplicitJoint one = implicitJoint(engine.jointSet(), index);
			addModes(one, first, h, bodies);
			one.isStiff = alsoStiff && (joint.isStiff() || one.isStiff || isFast(one));
			if (!one.isStiff && !joint.isDamped()) return false;
			if (!one.isStiff && one.isAxial) {
				if (first) {
					first->axis.others += joint.dampingAt(one.tangent).of(one.axis.frequency());
					return false;
				}
				place = found.size();
			}
			found.push_back(one);
			return one.isStiff;
		}
	};
}

ImplicitJointResult findImplicitJoints(
        const Scene& scene, const Bodies& bodies, bool alsoStiff, std::vector<ImplicitJoint>& implicit)
{
	ImplicitJointResult lost;
	implicit.clear();
	JointEngine* engine = findEngine<JointEngine>(scene);
	if (!engine) return lost;
	std::vector<timber::JointEntry>& joints = engine->jointSet().joints;
	JointSearch search { *engine, bodies, scene.dt, alsoStiff, implicit,
		std::vector<size_t>(joints.size(), JointSearch::none) };
	for (size_t k = 0; k < joints.size(); ++k) {
		timber::JointEntry& joint = joints[k];
		const bool isStiff = search.list(k);
		if (isStiff && !joint.isStiff()) { // its forces act in this step already
			engine->elastic -= joint.total.energy;
			joint.total = {};
		}
		if (!isStiff && joint.isStiff()) release(joint, lost);
	}
	return lost;
}

Real dashpotPower(const Scene& scene, const Bodies& bodies)
{
	const JointEngine* engine = findEngine<JointEngine>(scene);
	Real power = 0;
	for (size_t k = 0; engine && k < engine->jointSet().joints.size(); ++k) {
		const timber::JointEntry& joint = engine->jointSet().joints[k];
		const bool areThere = bodyAt(scene, joint.bodyA) && bodyAt(scene, joint.bodyB);
		if (!joint.isDamped() || !areThere || !holds(joint, bodies)) continue;
		ImplicitJoint one = implicitJoint(engine->jointSet(), k);
		addModes(one, nullptr, scene.dt, bodies);
		const timber::SolverBody &a = bodies[joint.bodyA], &b = bodies[joint.bodyB];
		const timber::JointDamping damping = joint.dampingAt(one.tangent);
		power += one.isAxial ? timber::dashpotPower(a, b, one.axis, damping)
		                     : timber::dashpotPower(a, b, *one.modes, a.axes, damping);
	}
	return power;
}

void addJoint(timber::ContactSolver& solver, ImplicitJoint& implicit)
{
	const int a = implicit.joint->bodyA, b = implicit.joint->bodyB;
	implicit.place = implicit.isAxial ? solver.addJoint<1>(a, b) : solver.addJoint<6>(a, b);
}

namespace {
	/// modes: of n
	template <int n, class Modes>
	void prepare(
	        timber::ContactSolver& solver, const ImplicitJoint& implicit, const Modes& modes, const Bodies& bodies)
	{
		const timber::JointEntry& joint = *implicit.joint;
		timber::SpringSteps<n> springs;
		if (implicit.isStiff) springs = springSteps<n>(implicit, solver.stepLength(), bodies);
		const Real tangent = implicit.isStiff && joint.isDamped() ? springs.tangent() : implicit.tangent;
		timber::ModalConstraint<n>& c = solver.prepareJoint<n>(
		        implicit.place, modes, bodies[joint.bodyA].axes, joint.dampingAt(tangent));
		if (implicit.isStiff) timber::addSprings(c, std::move(springs));
	}

	template <int n>
	timber::PairForce store(const timber::ModalConstraint<n>& c, const ImplicitJoint& implicit,
	        const Bodies& bodies, ImplicitJointResult& result)
	{
		const timber::JointImpulse P = timber::jointImpulse(c);
		const Vector3r force = P.linear / c.h, torque = P.angular / c.h;
		result.dashpots += c.dissipated;
		if (implicit.isStiff) {
			const timber::SolverBody &a = bodies[implicit.joint->bodyA], &b = bodies[implicit.joint->bodyB];
			storeSprings(c.springs, a.axes, implicit, result);
			implicit.joint->total = totalForce(c, implicit.springs, a, b);
			storeEnergies(c, *implicit.joint, result);
		}
		return { force, -c.armA.cross(force) - torque, c.armB.cross(force) + torque };
	}
}

void prepareJoint(timber::ContactSolver& solver, const ImplicitJoint& implicit, const Bodies& bodies)
{
	if (implicit.isAxial) prepare<1>(solver, implicit, implicit.axis, bodies);
	else prepare<6>(solver, implicit, *implicit.modes, bodies);
}

timber::PairForce storeJoint(const timber::ContactSolver& solver, const ImplicitJoint& implicit, const Bodies& bodies,
        ImplicitJointResult& result)
{
	return implicit.isAxial ? store(solver.joint<1>(implicit.place), implicit, bodies, result)
	                        : store(solver.joint<6>(implicit.place), implicit, bodies, result);
}

} // namespace yade

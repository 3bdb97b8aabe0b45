// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_pair.hpp"
#include "constants.hpp"
#include <type_traits>

namespace timber {
namespace {

	using Points = std::vector<ContactPoint>;
	using Records = std::vector<PointRecord>;

	/// Relative motion at a contact point x, from the velocities that led to the present placement. They belong to the middle of the last
	/// step, and so do the lever arms: with the present arms, a pair that rotates as a whole would seem to slide, by h/2 omega^2 per metre
	/// between the centres.
	template <class Number> [[gnu::always_inline]] inline RelativeMotion<Number> relativeMotion(const Vec3Of<Number>& x, const ElasticInput& input)
	{
		const auto velocity = [&](const BodyKinematics& body) {
			const Vec3Of<Number> arm = x - broadcast<Number>(body.position), spin = broadcast<Number>(body.spin);
			return Vec3Of<Number>(broadcast<Number>(body.velocity) + spin.cross(arm - Number(input.h / 2) * spin.cross(arm)));
		};
		return { velocity(input.b) - velocity(input.a), (input.a.spin + input.b.spin) / 2 };
	}

	bool haveSameFeatures(const Points& points, const Records& records)
	{
		return std::equal(points.begin(), points.end(), records.begin(), records.end(), [](const auto& p, const auto& r) { return p.id == r.id; });
	}

	template <class Law> void elasticPoint(const Law& law, const ElasticInput& input, const ContactPoint& point, PointRecord& record)
	{
		static_cast<ShearIncrement<double>&>(record) = elasticStep<Law, ContactPoint, double>(
		        law, input.pair, point, relativeMotion<double>(point.position, input), input.h, input.form, record);
	}

	/// First step of a new point, with its initial overlap. available: energy released so far; returns the part of it that the point takes. [J]
	template <class Law> double initialisePoint(const Law& law, const ElasticInput& input, const ContactPoint& point, double available, PointRecord& record)
	{
		const double speed = std::max(0., -relativeMotion<double>(point.position, input).velocity.dot(point.normal)),
		             approach = approachOverlap(law, input.pair.mass, speed, input.h);
		const double initial = initialOverlap(law, point.overlap, approach, available);
		record.excess = point.overlap - initial;
		elasticPoint(law, input, point, record);
		const double taken = law.energy(initial) - law.energy(std::min(initial, approach));
		if (input.form == NormalForm::Closed) record.impact.expect(taken);
		return taken;
	}

	using SpringsOf = PointSprings<double>;
	using IncrementOf = ShearIncrement<double>;

	/// Springs before the step; the increment form also needs the normal force.
	template <class Number> [[gnu::always_inline]] inline PointSprings<Number> loadSprings(const Group<Number, PointRecord>& record, NormalForm form)
	{
		PointSprings<Number> s;
		s.excess = record.get(&SpringsOf::excess);
		s.overlap = record.get(&SpringsOf::overlap);
		s.stiffness = record.get(&SpringsOf::stiffness);
		if (form == NormalForm::Increment) s.normalForce = record.get(&SpringsOf::normalForce);
		s.shearForce = record.get(&SpringsOf::shearForce);
		return s;
	}

	template <class Number>
	[[gnu::always_inline]] inline void saveSprings(
	        const PointSprings<Number>& s, const ShearIncrement<Number>& increment, const Group<Number, PointRecord>& record)
	{
		record.set(&SpringsOf::excess, s.excess);
		record.set(&SpringsOf::overlap, s.overlap);
		record.set(&SpringsOf::stiffness, s.stiffness);
		record.set(&SpringsOf::normalForce, s.normalForce);
		record.set(&SpringsOf::energy, s.energy);
		record.set(&SpringsOf::shearForce, s.shearForce);
		record.set(&IncrementOf::slip, increment.slip);
		record.set(&IncrementOf::shearBefore, increment.shearBefore);
		record.set(&IncrementOf::shearEnergyBefore, increment.shearEnergyBefore);
	}

	/// Elastic step of points whose features are those of the last step.
	template <class Law> void stepSameFeatures(const Law& law, const ElasticInput& input, const Points& points, Records& records)
	{
		inLanes(points.size(), [&](auto number, size_t k) {
			using Number = decltype(number);
			struct Placement {
				Vec3Of<Number> normal;
				Number overlap;
			};
			const Group<Number, const ContactPoint> point(&points[k], points.size() - k);
			const Group<Number, PointRecord> record(&records[k], points.size() - k);
			PointSprings<Number> springs = loadSprings<Number>(record, input.form);
			const Placement placement { point.get(&ContactPoint::normal), point.get(&ContactPoint::overlap) };
			const ShearIncrement<Number> increment = elasticStep<Law, Placement, Number>(
			        law, input.pair, placement, relativeMotion<Number>(point.get(&ContactPoint::position), input), input.h, input.form, springs);
			saveSprings<Number>(springs, increment, record);
		});
	}

	/// Elastic step when features have changed: 1. move the records of persistent features and sum the energy of the others, which do not act
	/// any more; 2. step all points. Returns the energy released minus that given to new points. [J]
	template <class Law> double stepChangedFeatures(const Law& law, const ElasticInput& input, const Points& points, Records& records)
	{
		Records next(points.size());
		double released = 0;
		auto old = records.begin();
		for (size_t k = 0; k < next.size(); ++k) { // 1.
			for (; old != records.end() && old->id < points[k].id; ++old)
				released += old->ahead;
			if (old != records.end() && old->id == points[k].id) next[k] = *old++;
		}
		for (; old != records.end(); ++old)
			released += old->ahead;
		for (size_t k = 0; k < next.size(); ++k) { // 2.
			const bool isNew = !(next[k].id == points[k].id);
			next[k].id = points[k].id;
			if (isNew && !input.placedInContact) released -= initialisePoint(law, input, points[k], released, next[k]);
			else elasticPoint(law, input, points[k], next[k]);
		}
		records.swap(next);
		return released;
	}

	/// Constraints of the k-th pair from a point on, as many as a Number has lanes.
	template <class Number> decltype(auto) constraintsFrom(const ContactSolver& solver, size_t k, size_t point)
	{
		if constexpr (std::is_same_v<Number, double>) return solver.constraint(k, point);
		else return solver.constraintGroup(k, point);
	}

	/// Solver input of points. record: after the elastic step.
	template <class Number>
	[[gnu::always_inline]] inline ContactInput<Number> contactInput(const SolverBody& a, const SolverBody& b, const PairProperties& pair, double h,
	        const Group<Number, const ContactPoint>& point, const Group<Number, const PointRecord>& record)
	{
		const Vec3Of<Number> position = point.get(&ContactPoint::position);
		ContactInput<Number> p;
		p.armA = position - broadcast<Number>(a.position);
		p.armB = position - broadcast<Number>(b.position);
		p.normal = point.get(&ContactPoint::normal);
		p.elasticNormal = record.get(&PointRecord::normalForce);
		p.elasticShear = record.get(&PointRecord::shearForce);
		p.normalDamping = normalDamping<Number>(pair, record.get(&PointRecord::stiffness));
		p.shearDamping = shearDamping<Number>(pair, p.normalDamping);
		p.friction = pair.friction;
		p.impulse = Number(h) * (p.elasticNormal * p.normal + p.elasticShear + record.get(&PointRecord::dashpotForce));
		p.normalStiffness = record.get(&PointRecord::stiffness);
		p.shearStiffness = Number(pair.shearRatio) * p.normalStiffness;
		p.release = (point.get(&ContactPoint::overlap) - record.get(&PointRecord::excess)) / Number(h);
		p.energy = record.get(&PointRecord::energy);
		p.overlap = record.get(&PointRecord::overlap);
		const auto isHertz = p.normalStiffness * p.overlap > Number(1.25) * p.elasticNormal; // 1.5; linear: 1
		p.hardening
		        = select(logicalAnd(isHertz, p.overlap > Number(roundingOverlap)), Number(p.elasticNormal / (p.overlap * sqrt(p.overlap))), Number(0.));
		return p;
	}

	/// Velocity of B relative to A along the normal of a constraint, before and after the step. [m/s]
	struct NormalVelocity {
		double before, after;
		NormalVelocity(const ContactSolver::Constraint& c, const SolverBody& a, const SolverBody& b)
		        : before(relativeVelocity<double>(c.armA, c.armB, a.velocity, a.spin, b.velocity, b.spin).dot(c.normal))
		        , after(relativeVelocity<double>(c.armA, c.armB, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin).dot(c.normal))
		{
		}
		double mean() const { return (before + after) / 2; }
	};

	/// Starts the impact of a point whose surfaces have touched in the last step.
	void touch(const ContactSolver::Constraint& c, const SolverBody& a, const SolverBody& b, const PairProperties& pair, double h, PointRecord& r)
	{
		const Vec3 v = relativeVelocity<double>(c.armA, c.armB, a.velocity, a.spin, b.velocity, b.spin);
		const PowerSpring spring { r.overlap, r.normalForce, r.stiffness };
		startImpact(r.impact, spring, pair.dampingRatio, pair.mass, c.response, -v.dot(c.normal), h);
	}

	/// Points of a pair in an impact: prepare phase.
	void prepareImpacts(const SolverStep& step, size_t k, const PairProperties& pair, Records& records)
	{
		const SolverPair& ids = step.solver.pair(k);
		for (size_t i = 0; i < records.size(); ++i) {
			PointRecord& r = records[i];
			if (r.impact.isPast() && r.overlap == 0) r.impact.expect(0);
			if (r.impact.isPending() && r.normalForce > 0)
				touch(step.solver.constraint(k, i), step.bodies[ids.bodyA], step.bodies[ids.bodyB], pair, step.h, r);
			if (r.impact.isActive()) step.solver.setImpact(k, i, r.impact.rebound);
		}
	}

	/// Whether the other forces on the bodies change the velocity too much for the restitution of this point alone. change: velocity of
	/// separation after the step minus before [m/s]; own: the part of it by the point's impulse [m/s]. In impacts shorter than a step the change
	/// within the step counts: otherwise a load that returns the point to the contact in each step would push it through.
	bool isLoaded(const ImpactState& impact, double change, double own, double h)
	{
		return (own - change) * std::max(impact.duration / h, 1.) > impactLoadShare * impact.touchSpeed;
	}

	/// The normal spring has no force any more. The rest of the overlap, which the step does not resolve, is excess.
	void endImpact(PointRecord& r)
	{
		r.excess = largestSize;
		r.overlap = r.energy = 0;
		r.impact.expect(0);
	}

	/// Elastic normal force over the half step after the placement. A point that separates returns its energy and no more: (5) of the solver.
	/// force: at the placement [N]; after: velocity of separation [m/s].
	template <class Number> [[gnu::always_inline]] inline Number forceAhead(const ContactConstraint<Number>& c, Number force, Number after, double h)
	{
		return selectLazily(
		        after > c.release, [&] { return Number(Number(2.) * c.energy / (Number(h) * after)); }, [&] { return force; });
	}

	/// Energy that the normal dashpot dissipates in a step. impulse: of the contact [N s]; force, ahead: elastic, see forceAhead() [N].
	template <class Number>
	[[gnu::always_inline]] inline Number normalDissipation(Number impulse, Number force, Number ahead, Number before, Number after, double h)
	{
		return -((impulse - Number(h) * force) * before + (impulse - Number(h) * ahead) * after) / Number(2.);
	}

	/// Impact of a point after a step. Its dashpot dissipates the work that the normal spring does not store. That is at most the energy of the
	/// law. energies: with those of spring and dashpot without an impact.
	void followImpact(const ContactSolver::Constraint& c, const NormalVelocity& v, double h, PointRecord& r, PairEnergies& energies)
	{
		const double impulse = c.impulse.dot(c.normal), available = r.impact.stored - impulse * v.mean(), energy = r.energy;
		const double force = r.normalForce, ahead = forceAhead(c, force, v.after, h), byLaw = energy - ahead * v.after * h / 2;
		r.impact.timeLeft -= h;
		double stored = byLaw;
		const bool loaded = isLoaded(r.impact, v.after - v.before, impulse * c.response, h);
		if (loaded) r.impact.rebound = noRebound;
		if (v.after > (loaded ? c.release : std::min(c.rebound, c.release)) * (1 - reboundRounding)) stored = 0, endImpact(r);
		else if (r.impact.timeLeft <= 0) r.impact.cancel();
		else stored = std::max(0., std::min(available, byLaw));
		r.impact.stored = stored;
		r.ahead += stored - byLaw;
		energies.dashpotNormal += available - stored - normalDissipation(impulse, force, ahead, v.before, v.after, h);
		energies.elasticNormal += stored - energy;
		energies.elasticPower += ahead * v.after;
	}

	void followImpacts(const SolverStep& step, size_t k, Records& records, PairEnergies& energies)
	{
		const SolverBody &a = step.bodies[step.solver.pair(k).bodyA], &b = step.bodies[step.solver.pair(k).bodyB];
		for (size_t i = 0; i < records.size(); ++i) {
			if (!records[i].impact.isActive()) continue;
			const ContactSolver::Constraint c = step.solver.constraint(k, i);
			followImpact(c, { c, a, b }, step.h, records[i], energies);
		}
	}

	[[maybe_unused]] bool isValid(const ElasticInput& input)
	{
		const auto isValidBody = [](const BodyKinematics& body) { return isFinite(body.position) && isFinite(body.velocity) && isFinite(body.spin); };
		return input.h > 0 && std::isfinite(input.h) && input.pair.mass > 0 && isValidBody(input.a) && isValidBody(input.b) && input.pair.shearRatio > 0
		        && input.pair.overlapLimit >= 0;
	}
	[[maybe_unused]] bool isValid(const Points& points)
	{
		const auto isBefore = [](const ContactPoint& p, const ContactPoint& q) { return p.id < q.id; };
		const auto isValidPoint
		        = [](const ContactPoint& p) { return isFinite(p.position) && isUnit(p.normal) && p.overlap > 0 && std::isfinite(p.overlap); };
		return std::is_sorted(points.begin(), points.end(), isBefore) && std::all_of(points.begin(), points.end(), isValidPoint);
	}

} // namespace

template <class Law> double elasticPair(const Law& law, const ElasticInput& input, const Points& points, Records& records)
{
	assert(isValid(input) && isValid(points));
	if (!haveSameFeatures(points, records)) return stepChangedFeatures(law, input, points, records);
	stepSameFeatures(law, input, points, records);
	return 0;
}
template double elasticPair(const HertzLaw&, const ElasticInput&, const Points&, Records&);
template double elasticPair(const LinearLaw&, const ElasticInput&, const Points&, Records&);

void prepareContacts(const SolverStep& step, size_t k, const PairProperties& pair, const Points& points, Records& records)
{
	assert(points.size() == records.size() && points.size() == step.solver.pair(k).count);
	assert(step.h > 0 && pair.mass > 0 && pair.friction >= 0 && pair.shearRatio > 0 && pair.dampingRatio >= 0);
	const SolverBody &a = step.bodies[step.solver.pair(k).bodyA], &b = step.bodies[step.solver.pair(k).bodyB];
	inLanes(points.size(), [&](auto number, size_t i) {
		using Number = decltype(number);
		const Group<Number, const ContactPoint> point(&points[i], points.size() - i);
		const Group<Number, const PointRecord> record(&records[i], points.size() - i);
		step.solver.prepare<Number>(k, i, step.bodies, contactInput<Number>(a, b, pair, step.h, point, record), step.h);
	});
	if (!step.solver.isExplicit()) prepareImpacts(step, k, pair, records);
}

PairForce storeForces(const SolverStep& step, size_t k, const PairProperties& pair, Records& records, PairEnergies* energies)
{
	assert(step.h > 0 && records.size() == step.solver.pair(k).count && pair.friction >= 0 && pair.shearRatio > 0);
	const SolverBody &a = step.bodies[step.solver.pair(k).bodyA], &b = step.bodies[step.solver.pair(k).bodyB];
	const double h = step.h;
	Sums<9> forces;
	PairEnergies unused;
	PairEnergies& result = energies ? *energies : unused;
	Sums<6> sums(result.dashpotNormal, result.dashpotShear, result.friction, result.elasticNormal, result.elasticShear, result.elasticPower);
	inLanes(records.size(), [&](auto number, size_t i) {
		using Number = decltype(number);
		using Vec = Vec3Of<Number>;
		const size_t count = records.size() - i;
		decltype(auto) constraint = constraintsFrom<Number>(step.solver, k, i);
		const Group<Number, PointRecord> record(&records[i], count);
		const Vec &normal = constraint.normal, &armA = constraint.armA, &armB = constraint.armB;
		const Vec force = constraint.impulse / Number(h), torqueA = -armA.cross(force), torqueB = armB.cross(force);
		const Number elasticNormal = record.get(&PointRecord::normalForce);
		const Vec shearForce = limitedShear<Number>(record.get(&PointRecord::shearForce), Number(pair.friction), force.dot(normal));
		const Vec dashpotForce = force - elasticNormal * normal - shearForce;
		record.set(&PointRecord::shearForce, shearForce);
		record.set(&PointRecord::dashpotForce, dashpotForce);
		forces.add<Number>(count, force, torqueA, torqueB);
		const Vec after = relativeVelocity<Number>(armA, armB, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin);
		const Number separation = after.dot(normal), ahead = forceAhead<Number>(constraint, elasticNormal, separation, h),
		             power = -(ahead * separation + shearForce.dot(after)), energy = record.get(&PointRecord::energy),
		             stored = shearEnergy<Number>(shearForce, Number(pair.shearRatio) * record.get(&PointRecord::stiffness));
		record.set(&PointRecord::ahead, Number(energy + stored + Number(h / 2) * power));
		if (!energies) return;
		const Vec before = relativeVelocity<Number>(armA, armB, a.velocity, a.spin, b.velocity, b.spin);
		const Number impulse = constraint.impulse.dot(normal);
		const Number normalWork = normalDissipation<Number>(impulse, elasticNormal, ahead, before.dot(normal), separation, h),
		             shearWork = -(Number(h / 2) * (dashpotForce - dashpotForce.dot(normal) * normal).dot(before + after));
		const Number friction = -(record.get(&PointRecord::slip).dot(record.get(&PointRecord::shearBefore) + shearForce) / Number(2.) + stored
		        - record.get(&PointRecord::shearEnergyBefore));
		sums.add<Number>(count, normalWork, shearWork, friction, energy, stored, power);
	});
	result = { sums[0], sums[1], sums[2], sums[3], sums[4], sums[5] };
	followImpacts(step, k, records, result);
	return { forces.vector(0), forces.vector(3), forces.vector(6) };
}

} // namespace timber

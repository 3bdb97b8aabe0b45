// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_pair.hpp"
#include "constants.hpp"
#include <type_traits>

namespace timber {
namespace {

	using Points = std::vector<ContactPoint>;
	using Records = std::vector<PointRecord>;

	/// Relative motion at a contact point x, from the velocities that led to the present placement. They belong to
	/// the middle of the last step, and so do the lever arms: with the present arms, a pair that rotates as a whole
	/// would seem to slide, by h/2 omega^2 per metre between the centres.
	template <class Number>
	[[gnu::always_inline]] inline RelativeMotion<Number> relativeMotion(
	        const Vec3Of<Number>& x, const ElasticInput& input)
	{
		const auto velocity = [&](const BodyKinematics& body) {
			const Vec3Of<Number> arm = x - broadcast<Number>(body.position),
			                     spin = broadcast<Number>(body.spin);
			return Vec3Of<Number>(broadcast<Number>(body.velocity)
			        + spin.cross(arm - Number(input.h / 2) * spin.cross(arm)));
		};
		return { velocity(input.b) - velocity(input.a), (input.a.spin + input.b.spin) / 2 };
	}

	bool haveSameFeatures(const Points& points, const Records& records)
	{
		return std::equal(points.begin(), points.end(), records.begin(), records.end(),
		        [](const auto& p, const auto& r) { return p.id == r.id; });
	}

	template <class Law>
	void elasticPoint(const Law& law, const ElasticInput& input, const ContactPoint& point, PointRecord& record)
	{
		elasticStep<Law, ContactPoint, double>(law, input.pair, point,
		        relativeMotion<double>(point.position, input), input.h, input.form, record);
	}

	/// Overlap that the approach of the bodies in the last step explains. [m]
	template <class Law> double approachAt(const Law& law, const ElasticInput& input, const ContactPoint& point)
	{
		const double speed
		        = std::max(0., -relativeMotion<double>(point.position, input).velocity.dot(point.normal));
		return approachOverlap(law, input.pair.mass, speed, input.h);
	}

	/// First step of a new point, with its initial overlap, whose force is at most the strength, and the plastic one
	/// that the record has. available: energy released so far; returns the part of it that the point takes. [J]
	template <class Law>
	double initialisePoint(const Law& law, const ElasticInput& input, const ContactPoint& point, double available,
	        PointRecord& record)
	{
		const double approach = approachAt(law, input, point);
		const double initial = elasticOverlap(law, input.pair.strength.at(record.crushed), 0,
		        initialOverlap(law, point.overlap, approach, available), point.overlap);
		record.crushed = std::min(record.crushed, point.overlap - initial);
		record.excess = point.overlap - record.crushed - initial;
		elasticPoint(law, input, point, record);
		if (input.form == NormalForm::Increment) record.impact = ImpactState::over();
		record.normalStored = law.energy(initial) - law.energy(std::min(initial, approach));
		return record.normalStored;
	}

	/// First step of a point whose bodies were placed in contact: the spring is loaded, without an impact.
	template <class Law>
	void placePoint(const Law& law, const ElasticInput& input, const ContactPoint& point, PointRecord& record)
	{
		elasticPoint(law, input, point, record);
		record.normalStored = record.energy;
		record.impact = ImpactState::over();
	}

	using SpringsOf = PointSprings<double>;

	/// Springs before the step; the increment form also needs the normal force.
	template <class Number>
	[[gnu::always_inline]] inline PointSprings<Number> loadSprings(
	        const Group<Number, PointRecord>& record, NormalForm form)
	{
		PointSprings<Number> s;
		s.excess = record.get(&SpringsOf::excess);
		s.crushed = record.get(&SpringsOf::crushed);
		s.overlap = record.get(&SpringsOf::overlap);
		s.stiffness = record.get(&SpringsOf::stiffness);
		if (form == NormalForm::Increment) s.normalForce = record.get(&SpringsOf::normalForce);
		s.shearForce = record.get(&SpringsOf::shearForce);
		return s;
	}

	template <class Number>
	[[gnu::always_inline]] inline void saveSprings(
	        const PointSprings<Number>& s, const Group<Number, PointRecord>& record)
	{
		record.set(&SpringsOf::excess, s.excess);
		record.set(&SpringsOf::crushed, s.crushed);
		record.set(&SpringsOf::overlap, s.overlap);
		record.set(&SpringsOf::stiffness, s.stiffness);
		record.set(&SpringsOf::normalForce, s.normalForce);
		record.set(&SpringsOf::energy, s.energy);
		record.set(&SpringsOf::shearForce, s.shearForce);
	}

	/// Elastic step of points whose features are those of the last step.
	template <class Law>
	void stepSameFeatures(const Law& law, const ElasticInput& input, const Points& points, Records& records)
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
			const Placement placement { point.get(&ContactPoint::normal),
				point.get(&ContactPoint::overlap) };
			elasticStep<Law, Placement, Number>(law, input.pair, placement,
			        relativeMotion<Number>(point.get(&ContactPoint::position), input), input.h, input.form,
			        springs);
			saveSprings<Number>(springs, record);
		});
	}

	/// The record that a point continues with other features; null: none.
	const PointRecord* predecessorOf(const ContactPoint& point, const Records& records)
	{
		if (point.predecessor == FeatureId()) return nullptr;
		const auto at = std::find_if(records.begin(), records.end(),
		        [&](const PointRecord& r) { return r.id == point.predecessor; });
		return at != records.end() ? &*at : nullptr;
	}

	bool isContinued(const PointRecord& record, const Points& points)
	{
		return std::any_of(points.begin(), points.end(),
		        [&](const ContactPoint& p) { return p.predecessor == record.id; });
	}

	/// Elastic step when features have changed: 1. move the records of persistent features, and of points that
	/// continue others, and sum the energy of the rest, which do not act any more; 2. step all points. New ones take
	/// over the largest plastic overlap of the rest: a member that slides keeps its dent. Returns the energy released
	/// minus that given to new points. [J]
	template <class Law>
	double stepChangedFeatures(const Law& law, const ElasticInput& input, const Points& points, Records& records)
	{
		Records next(points.size());
		double released = 0, crushed = 0;
		const auto release = [&](const PointRecord& r) {
			if (isContinued(r, points)) return;
			released += r.normalStored + r.shearStored;
			crushed = std::max(crushed, r.crushed);
		};
		auto old = records.begin();
		for (size_t k = 0; k < next.size(); ++k) { // 1.
			for (; old != records.end() && old->id < points[k].id; ++old)
				release(*old);
			if (old != records.end() && old->id == points[k].id) next[k] = *old++;
			else if (const PointRecord* r = predecessorOf(points[k], records)) {
				next[k] = *r;
				next[k].id = points[k].id;
			}
		}
		for (; old != records.end(); ++old)
			release(*old);
		for (size_t k = 0; k < next.size(); ++k) { // 2.
			const bool isNew = !(next[k].id == points[k].id);
			next[k].id = points[k].id;
			if (isNew) next[k].crushed = crushed;
			const bool isPlaced = isNew && input.placedInContact
			        && points[k].overlap > approachAt(law, input, points[k]);
			if (isPlaced) placePoint(law, input, points[k], next[k]);
			else if (isNew) released -= initialisePoint(law, input, points[k], released, next[k]);
			else elasticPoint(law, input, points[k], next[k]);
		}
		records.swap(next);
		return released;
	}

	/// Physics of points in a step. record: after the elastic step.
	template <class Number>
	[[gnu::always_inline]] inline StepInput<Number> stepInput(const SolverBodies& bodies,
	        const PairProperties& pair, double h, const Group<Number, const ContactPoint>& point,
	        const Group<Number, const PointRecord>& record)
	{
		const Vec3Of<Number> position = point.get(&ContactPoint::position);
		StepInput<Number> p;
		p.armA = position - broadcast<Number>(bodies.a.position);
		p.armB = position - broadcast<Number>(bodies.b.position);
		p.normal = point.get(&ContactPoint::normal);
		p.elasticNormal = record.get(&PointRecord::normalForce);
		p.elasticShear = record.get(&PointRecord::shearForce);
		p.normalStiffness = record.get(&PointRecord::stiffness);
		p.shearStiffness = Number(pair.shearRatio) * p.normalStiffness;
		p.normalDamping = normalDamping<Number>(pair, p.normalStiffness);
		p.shearDamping = shearDamping<Number>(pair, p.normalDamping);
		p.friction = pair.friction;
		p.impulse = Number(h)
		        * (p.elasticNormal * p.normal + p.elasticShear + record.get(&PointRecord::dashpotForce));
		p.energy = max(Number(0.), Number(record.get(&PointRecord::normalStored)));
		p.shearEnergy = max(Number(0.), Number(record.get(&PointRecord::shearStored)));
		p.overlap = record.get(&PointRecord::overlap);
		if (pair.strength.isLimited())
			p.strength = pair.strength.force<Number>(record.get(&PointRecord::crushed));
		if (pair.power == 1) return p;
		// K n - F = (q - 1) c n^q for F = k n + c n^q
		p.power = pair.power;
		p.room = max(Number(0.), Number(Number(pair.overlapLimit) - p.overlap));
		const Number excess = p.normalStiffness * p.overlap - p.elasticNormal;
		p.hardening = select(p.overlap > Number(roundingOverlap),
		        max(Number(0.), Number(excess * Number(1 / (pair.power - 1)))), Number(0.));
		return p;
	}

	/// A point whose surfaces have separated may touch again. In the increment form its force is no function of the
	/// overlap, and it has no impacts.
	void rearmImpacts(NormalForm form, Records& records)
	{
		if (form == NormalForm::Increment) return;
		for (PointRecord& r : records)
			if (r.overlap == 0) r.impact = {};
	}

	/// Impacts of a pair's points: prepare phase. Those that touch in this step, and those that are in an impact.
	struct Impacts {
		const SolverPair& pair;

		static bool begins(const PointRecord& r)
		{
			return r.impact.isPending() && r.normalForce > 0 && r.step.response() > 0
			        && r.step.before[0] < 0;
		}
		/// Change of a point's normal velocity by unit impulses of all of them: points of a face share the
		/// impulse. Not less than its own one over their number: they do not hold each other down. [1/kg]
		double commonResponse(const PointStep& step) const
		{
			PairVector all {};
			int count = 0;
			for (size_t i = 0; i < pair.count; ++i) {
				const PointRecord& r = pair.points[i];
				if (!begins(r) && !r.impact.isActive()) continue;
				all.add(r.step.rows[0], 1);
				++count;
			}
			return std::max(all.dots(step.rows)[0], step.response() / count);
		}
	};

	void prepareImpacts(const SolverPair& solverPair, const PairProperties& pair, double h)
	{
		const Impacts impacts { solverPair };
		std::vector<ImpactState> started;
		for (size_t i = 0; i < solverPair.count; ++i) {
			const PointRecord& r = solverPair.points[i];
			if (!Impacts::begins(r)) continue;
			started.resize(solverPair.count);
			started[i] = startImpact({ r.overlap, r.normalForce, r.stiffness },
			        { pair.dampingRatio, pair.mass, impacts.commonResponse(r.step), -r.step.before[0],
			                pair.strength, r.crushed },
			        h);
		}
		for (size_t i = 0; i < solverPair.count; ++i) {
			PointRecord& r = solverPair.points[i];
			if (!started.empty() && Impacts::begins(r)) r.impact = started[i];
			r.step.rebound = r.impact.rebound;
		}
	}

	/// Velocity change of B relative to A at a point that the impulses of the pair's points explain. [m/s]
	double changeByPair(const PointStep& point, const SolverBodies& bodies, const PairForce& impulse)
	{
		const Vec3 vA = -bodies.a.inverseMass * impulse.onB, wA = bodies.a.inverseInertia * impulse.torqueA,
		           vB = bodies.b.inverseMass * impulse.onB, wB = bodies.b.inverseInertia * impulse.torqueB;
		return relativeVelocity<double>(point.armA, point.armB, vA, wA, vB, wB).dot(point.axes[0]);
	}

	/// Impacts of a pair's points after a step. impulse: of the pair, with angular impulses [N s, N m s].
	void followImpacts(const SolverPair& solverPair, const SolverBodies& bodies, const PairForce& impulse, double h)
	{
		for (size_t i = 0; i < solverPair.count; ++i) {
			PointRecord& r = solverPair.points[i];
			if (!r.impact.isActive()) continue;
			const double change = bodies.velocity<double>(r.step.armA, r.step.armB).dot(r.step.axes[0])
			        - r.step.before[0];
			r.impact.pass(h, r.step.bounded, changeByPair(r.step, bodies, impulse) - change);
		}
	}

	/// Normal spring after a closing displacement from the placement.
	template <class Number> struct SpringAfter {
		Number force, stiffness, energy; ///< [N, N/m, J]
	};

	/// Normal spring after a closing displacement `way` from the placement, F = k n + c n^q.
	/// U, F, K, n: energy [J], force [N], stiffness [N/m] and overlap [m] at the placement; room: overlap left
	/// until the force is constant [m].
	template <class Number>
	[[gnu::always_inline]] inline SpringAfter<Number> springAfter(
	        Number U, Number F, Number K, Number n, Number room, Number way, double q)
	{
		const Number none = 0., g = min(max(way, Number(-n)), room),
		             rest = max(none, Number(way - room)); // of the way, with and without change of the force
		Number change = F * g + K * g * g / Number(2.), force = F + K * g, stiffness = K;
		if (q > 1) {
			const Number floor = max(n, Number(roundingOverlap)), s = Number(1.) + g / floor,
			             hard = (K * n - F) / Number(q - 1), ratio = g / floor,
			             power = powerOf<Number>(s, q);
			// c ((n + g)^(q+1) - n^(q+1)) / (q+1), less the linear and square terms of the above
			change += hard * floor
			        * ((s * power - Number(1.)) / Number(q + 1) - ratio - Number(q / 2) * ratio * ratio);
			force += hard * (power - Number(1.) - Number(q) * ratio);
			stiffness += hard * Number(q) / floor * (power / s - Number(1.));
		}
		return { force, stiffness, select(way > -n, max(none, Number(U + change + rest * force)), none) };
	}

	/// Energy of a normal spring that has at most the strength [N], as springAfter(): Newton's method from above
	/// finds the displacement at which it is reached. [J]
	inline double energyAtStrength(
	        double U, double F, double K, double n, double room, double way, double q, double strength)
	{
		SpringAfter<double> after = springAfter(U, F, K, n, room, way, q);
		for (int k = 0; k < yieldSteps && way > 0 && after.force > strength * (1 + yieldTolerance); ++k) {
			way = std::max(0., std::min(way, room) - (after.force - strength) / after.stiffness);
			after = springAfter(U, F, K, n, room, way, q);
		}
		return after.energy;
	}
	inline Lanes energyAtStrength(const Lanes& U, const Lanes& F, const Lanes& K, const Lanes& n, const Lanes& room,
	        const Lanes& way, double q, const Lanes& strength)
	{
		Lanes energy;
		for (int i = 0; i < laneCount; ++i)
			energy.v[i] = energyAtStrength(
			        U.v[i], F.v[i], K.v[i], n.v[i], room.v[i], way.v[i], q, strength.v[i]);
		return energy;
	}

	/// What a spring has after a step, and what was dissipated. The account is negative after a step whose sweeps
	/// ended with a small error: the point has returned too much, and the next work on it settles the debt.
	template <class Number> struct Account {
		Number stored, dissipated; ///< [J]

		/// before: account before the step; work: of the impulse on the bodies; law: energy that the spring may
		/// have after the step. [J]
		Account(Number before, Number work, Number law)
		{
			const Number available = before - work;
			stored = min(available, law);
			dissipated = available - stored;
		}
	};

	[[maybe_unused]] bool isValid(const ElasticInput& input)
	{
		const auto isValidBody = [](const BodyKinematics& body) {
			return isFinite(body.position) && isFinite(body.velocity) && isFinite(body.spin);
		};
		return input.h > 0 && std::isfinite(input.h) && input.pair.mass > 0 && isValidBody(input.a)
		        && isValidBody(input.b) && input.pair.shearRatio > 0 && input.pair.overlapLimit >= 0;
	}
	[[maybe_unused]] bool isValid(const Points& points)
	{
		const auto isBefore = [](const ContactPoint& p, const ContactPoint& q) { return p.id < q.id; };
		const auto isValidPoint = [](const ContactPoint& p) {
			return isFinite(p.position) && isUnit(p.normal) && p.overlap > 0 && std::isfinite(p.overlap);
		};
		return std::is_sorted(points.begin(), points.end(), isBefore)
		        && std::all_of(points.begin(), points.end(), isValidPoint);
	}

} // namespace

template <class Law>
double elasticPair(const Law& law, const ElasticInput& input, const Points& points, Records& records)
{
	assert(isValid(input) && isValid(points));
	double released = 0;
	if (haveSameFeatures(points, records)) stepSameFeatures(law, input, points, records);
	else released = stepChangedFeatures(law, input, points, records);
	rearmImpacts(input.form, records);
	return released;
}
template double elasticPair(const HertzLaw&, const ElasticInput&, const Points&, Records&);
template double elasticPair(const LinearLaw&, const ElasticInput&, const Points&, Records&);

void prepareContacts(ContactSolver& solver, size_t k, const PairProperties& pair, const Points& points)
{
	const SolverPair& solverPair = solver.pair(k);
	assert(points.size() == solverPair.count);
	assert(pair.mass > 0 && pair.friction >= 0 && pair.shearRatio > 0 && pair.dampingRatio >= 0 && pair.power >= 1);
	const SolverBodies bodies = solver.bodiesOf(solverPair);
	inLanes(points.size(), [&](auto number, size_t i) {
		using Number = decltype(number);
		const Group<Number, const ContactPoint> point(&points[i], points.size() - i);
		const Group<Number, const PointRecord> record(solverPair.points + i, points.size() - i);
		solver.prepare<Number>(k, i, stepInput<Number>(bodies, pair, solver.stepLength(), point, record));
	});
	for (size_t i = 0; i < solverPair.count; ++i)
		solverPair.points[i].step.idle = solverPair.points[i].isIdle();
	if (!solver.isExplicit()) prepareImpacts(solverPair, pair, solver.stepLength());
}

PairForce storeForces(ContactSolver& solver, size_t k, const PairProperties& pair, PairEnergies& energies)
{
	const SolverPair& solverPair = solver.pair(k);
	const SolverBodies bodies = solver.bodiesOf(solverPair);
	const double h = solver.stepLength();
	Sums<12> impulses;
	Sums<6> sums(energies.dashpotNormal, energies.dashpotShear, energies.friction, energies.elasticNormal,
	        energies.elasticShear, energies.crushing);
	inLanes(solverPair.count, [&](auto number, size_t i) {
		using Number = decltype(number);
		using Vec = Vec3Of<Number>;
		const size_t count = solverPair.count - i;
		const Group<Number, PointRecord> record(solverPair.points + i, count);
		const Group<Number, PointStep> step(count, [&](size_t n) { return &solverPair.points[i + n].step; });
		const Vec armA = step.get(&PointStep::armA), armB = step.get(&PointStep::armB);
		Vec axes[3];
		Number p[3];
		for (int c = 0; c < 3; ++c) {
			axes[c] = step.get(&PointStep::axes, c);
			p[c] = step.get(&PointStep::impulse, c);
		}
		const Vec impulse = p[0] * axes[0] + p[1] * axes[1] + p[2] * axes[2], force = impulse / Number(h);
		impulses.add<Number>(
		        count, impulse, Vec(-armA.cross(impulse)), Vec(armB.cross(impulse)), Vec(p[0] * axes[0]));
		const Number e = record.get(&PointRecord::normalForce), K = record.get(&PointRecord::stiffness),
		             n = record.get(&PointRecord::overlap), limit = Number(pair.friction) * (p[0] / Number(h)),
		             none = 0.;
		const Vec shear = clipped(Vec(record.get(&PointRecord::shearForce)), limit);
		record.set(&PointRecord::shearForce, shear);
		record.set(&PointRecord::dashpotForce, Vec(force - e * axes[0] - shear));

		const Vec after = bodies.velocity<Number>(armA, armB),
		          mean = (after + bodies.velocityBefore<Number>(armA, armB)) / Number(2.);
		// Closing way to the middle of the step
		const Number separation = after.dot(axes[0]), way = Number(-h / 2) * separation;
		const Number room = max(none, Number(Number(pair.overlapLimit) - n)),
		             U = record.get(&PointRecord::energy), most = step.get(&PointStep::strength),
		             strength = most / Number(h);
		const SpringAfter<Number> spring = springAfter<Number>(U, e, K, n, room, way, pair.power);
		const Number normalLaw = selectLazily(
		        spring.force > strength,
		        [&] { return energyAtStrength(U, e, K, n, room, way, pair.power, strength); },
		        [&] { return spring.energy; });
		const Account<Number> normal(
		        record.get(&PointRecord::normalStored), p[0] * mean.dot(axes[0]), normalLaw);

		// The total force is at the strength, or the spring is while the surfaces close
		const Number yield = most * Number(1 - strengthRounding);
		const auto yields
		        = logicalOr(p[0] >= yield, logicalAnd(Number(h) * e >= yield, mean.dot(axes[0]) < none));
		const Number crushing = select(yields, normal.dissipated, none);
		const Number shearStiffness = Number(pair.shearRatio) * K;
		// Spring in the middle of the step
		const Vec slip = Number(h / 2) * (after - separation * axes[0]), ahead = shear - shearStiffness * slip;
		const auto sliding
		        = (p[1] * p[1] + p[2] * p[2]) >= (limit * limit) * Number(h * h * (1 - slidingRounding));
		const Vec shearSpring = select(sliding, shear, ahead);
		const Account<Number> tangential(record.get(&PointRecord::shearStored),
		        p[1] * mean.dot(axes[1]) + p[2] * mean.dot(axes[2]),
		        shearEnergy<Number>(shearSpring, shearStiffness));
		record.set(&PointRecord::normalStored, normal.stored);
		record.set(&PointRecord::shearStored, tangential.stored);
		const Number friction = select(sliding, tangential.dissipated, none),
		             dashpot = tangential.dissipated - friction;
		sums.add<Number>(count, Number(normal.dissipated - crushing), dashpot, friction, normal.stored,
		        tangential.stored, crushing);
	});
	energies = { sums[0], sums[1], sums[2], sums[3], sums[4], sums[5] };
	const PairForce impulse { impulses.vector(0), impulses.vector(3), impulses.vector(6), impulses.vector(9) };
	followImpacts(solverPair, bodies, impulse, h);
	return { impulse.onB / h, impulse.torqueA / h, impulse.torqueB / h, impulse.normalOnB / h };
}

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_pair.hpp"
#include "constants.hpp"
#include <type_traits>

namespace timber {
namespace {

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
		if (pair.exponent == 1) return p;
		// K n - F = (q - 1) c n^q for F = k n + c n^q
		p.exponent = pair.exponent;
		p.overlapLeft = max(Number(0.), Number(Number(pair.overlapLimit) - p.overlap));
		const Number excess = p.normalStiffness * p.overlap - p.elasticNormal;
		p.hardening = select(p.overlap > Number(roundingOverlap),
		        max(Number(0.), Number(excess * Number(1 / (pair.exponent - 1)))), Number(0.));
		return p;
	}

	/// Prepare phase: points of a pair that begin an impact in this step, and those that are in one.
	struct Impacts {
		PointRecord* records;
		PointStep* steps;
		size_t count;

		bool begins(size_t i) const
		{
			const PointRecord& r = records[i];
			return r.impact.isPending() && r.normalForce > 0 && steps[i].response() > 0
			        && steps[i].before[0] < 0;
		}
		/// Change of a point's normal velocity by unit impulses of all points in an impact: points of a face share
		/// the impulse. At least the point's own response over their number. [1/kg]
		double commonResponse(const PointStep& step) const
		{
			PairVector all {};
			int sharing = 0;
			for (size_t i = 0; i < count; ++i) {
				if (!begins(i) && !records[i].impact.isActive()) continue;
				all.add(steps[i].rows[0], 1);
				++sharing;
			}
			return std::max(all.dots(step.rows)[0], step.response() / sharing);
		}
	};

	void prepareImpacts(const Impacts& impacts, const PairProperties& pair, double h)
	{
		std::vector<ImpactState> started;
		for (size_t i = 0; i < impacts.count; ++i) {
			if (!impacts.begins(i)) continue;
			const PointRecord& r = impacts.records[i];
			const PointStep& step = impacts.steps[i];
			started.resize(impacts.count);
			started[i] = startImpact({ r.overlap, r.normalForce, r.stiffness },
			        { pair.dampingRatio, pair.mass, impacts.commonResponse(step), -step.before[0],
			                pair.strength, r.crushed },
			        h);
		}
		for (size_t i = 0; i < impacts.count; ++i) {
			PointRecord& r = impacts.records[i];
			if (!started.empty() && impacts.begins(i)) r.impact = started[i];
			impacts.steps[i].rebound = r.impact.rebound;
		}
	}

	/// Velocity change of B relative to A along a point's normal, by the impulses of the pair's points. [m/s]
	double changeByPair(const PointStep& point, const SolverBodies& bodies, const PairForce& impulse)
	{
		const Vec3 vA = -bodies.a.inverseMass * impulse.onB, wA = bodies.a.inverseInertia * impulse.torqueA,
		           vB = bodies.b.inverseMass * impulse.onB, wB = bodies.b.inverseInertia * impulse.torqueB;
		return relativeVelocity<double>(point.armA, point.armB, vA, wA, vB, wB).dot(point.axes[0]);
	}

	/// Impacts of a pair's points after a step. impulse: of the pair, with angular impulses [N s, N m s].
	void followImpacts(const SolverPair& pair, const PointStep* steps, const SolverBodies& bodies,
	        const PairForce& impulse, double h, PointRecord* records)
	{
		for (size_t i = 0; i < pair.count; ++i) {
			if (!records[i].impact.isActive()) continue;
			const PointStep& step = steps[i];
			const double change
			        = bodies.velocity<double>(step.armA, step.armB).dot(step.axes[0]) - step.before[0];
			records[i].impact.pass(h, step.bounded, changeByPair(step, bodies, impulse) - change);
		}
	}

	template <class Number> struct SpringAfter {
		Number force, stiffness, energy; ///< [N, N/m, J]
	};

	/// Normal spring F = k n + c n^q after the displacement `closing` [m] from the placement, where it has the energy U
	/// [J], force F [N], stiffness K [N/m] and overlap n [m]. overlapLeft: overlap left until the force is constant [m].
	template <class Number>
	[[gnu::always_inline]] inline SpringAfter<Number> springAfter(
	        Number U, Number F, Number K, Number n, Number overlapLeft, Number closing, double q)
	{
		// Displacement with a varying force, and the rest with a constant one
		const Number none = 0., g = min(max(closing, Number(-n)), overlapLeft),
		             rest = max(none, Number(closing - overlapLeft));
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
		return { force, stiffness, select(closing > -n, max(none, Number(U + change + rest * force)), none) };
	}

	/// The same for at most the strength [N]: Newton's method from above finds the displacement at which it is reached.
	template <class Number>
	[[gnu::always_inline]] inline SpringAfter<Number> springWithin(const Number& strength, const Number& U,
	        const Number& F, const Number& K, const Number& n, const Number& overlapLeft, Number closing, double q)
	{
		const Number none = 0., most = strength * Number(1 + yieldTolerance);
		SpringAfter<Number> after = springAfter<Number>(U, F, K, n, overlapLeft, closing, q);
		for (int k = 0; k < yieldSteps; ++k) {
			const auto exceeds = logicalAnd(closing > none, after.force > most);
			if (!any(exceeds)) break;
			const Number less = min(closing, overlapLeft) - (after.force - strength) / after.stiffness;
			closing = select(exceeds, max(none, less), closing);
			after = springAfter<Number>(U, F, K, n, overlapLeft, closing, q);
		}
		return after;
	}

	/// Energy that a spring has stored after a step, and the energy dissipated in it. stored is negative after sweeps
	/// that ended with a small error: the point has returned too much energy, which is taken from later work on it.
	template <class Number> struct Account {
		Number stored, dissipated; ///< [J]
		Number yielding = 0.; ///< part of dissipated by crushing (normal) or friction (shear) [J]

		/// before: stored before the step; work: of the impulse on the bodies; law: energy that the spring may
		/// have after the step. [J]
		Account(Number before, Number work, Number law)
		{
			const Number available = before - work;
			stored = min(available, law);
			dissipated = available - stored;
		}
		Number dashpot() const { return dissipated - yielding; }
	};

	/// Points after the sweeps.
	template <class Number> struct SolvedPoints {
		using Vec = Vec3Of<Number>;
		const PairProperties& pair;
		const double h; ///< step [s]
		const Group<Number, PointRecord> record;
		const Number stiffness, strength; ///< of the normal springs [N/m], h F_Y [N s]
		const Vec armA, armB, after,
		        mean; ///< arms [m]; relative velocity after the step, and in its middle [m/s]
		Vec axes[3];
		Number p[3]; ///< impulse along the axes [N s]

		[[gnu::always_inline]] SolvedPoints(const PairProperties& pair, double h, const SolverBodies& bodies,
		        const Group<Number, PointRecord>& record, const Group<Number, const PointStep>& step)
		        : pair(pair)
		        , h(h)
		        , record(record)
		        , stiffness(record.get(&PointRecord::stiffness))
		        , strength(step.get(&PointStep::strength))
		        , armA(step.get(&PointStep::armA))
		        , armB(step.get(&PointStep::armB))
		        , after(bodies.velocity<Number>(armA, armB))
		        , mean((after + bodies.velocityBefore<Number>(armA, armB)) / Number(2.))
		{
			for (int c = 0; c < 3; ++c) {
				axes[c] = step.get(&PointStep::axes, c);
				p[c] = step.get(&PointStep::impulse, c);
			}
		}

		/// Account of the normal springs in the middle of the step.
		[[gnu::always_inline]] Account<Number> storeNormal() const
		{
			const Number e = record.get(&PointRecord::normalForce), n = record.get(&PointRecord::overlap),
			             U = record.get(&PointRecord::energy), none = 0.,
			             closing = Number(-h / 2) * after.dot(axes[0]),
			             overlapLeft = max(none, Number(Number(pair.overlapLimit) - n));
			const SpringAfter<Number> spring = springWithin<Number>(
			        strength / Number(h), U, e, stiffness, n, overlapLeft, closing, pair.exponent);
			Account<Number> account(
			        record.get(&PointRecord::normalStored), p[0] * mean.dot(axes[0]), spring.energy);
			record.set(&PointRecord::normalStored, account.stored);
			// The total force is at the strength, or the spring is while the surfaces close
			const Number yield = strength * Number(1 - strengthRounding);
			const auto yields = logicalOr(
			        p[0] >= yield, logicalAnd(Number(h) * e >= yield, mean.dot(axes[0]) < none));
			account.yielding = select(yields, account.dissipated, none);
			return account;
		}

		/// The same of the shear springs. shear: their force at the placement, within Coulomb's limit [N]
		[[gnu::always_inline]] Account<Number> storeShear(const Vec& shear, Number limit) const
		{
			const Number shearStiffness = Number(pair.shearRatio) * stiffness;
			const Vec slip = Number(h / 2) * (after - after.dot(axes[0]) * axes[0]),
			          ahead = shear - shearStiffness * slip;
			const auto sliding = (p[1] * p[1] + p[2] * p[2])
			        >= (limit * limit) * Number(h * h * (1 - slidingRounding));
			Account<Number> account(record.get(&PointRecord::shearStored),
			        p[1] * mean.dot(axes[1]) + p[2] * mean.dot(axes[2]),
			        shearEnergy<Number>(select(sliding, shear, ahead), shearStiffness));
			record.set(&PointRecord::shearStored, account.stored);
			account.yielding = select(sliding, account.dissipated, Number(0.));
			return account;
		}
	};

} // namespace

void prepareContacts(ContactSolver& solver, size_t k, const PairProperties& pair,
        const std::vector<ContactPoint>& points, std::vector<PointRecord>& records)
{
	const SolverPair& solverPair = solver.pair(k);
	const size_t count = solverPair.count;
	assert(points.size() == count && records.size() == count);
	assert(pair.mass > 0 && pair.friction >= 0 && pair.shearRatio > 0 && pair.dampingRatio >= 0
	        && pair.exponent >= 1);
	const SolverBodies bodies = solver.bodiesOf(solverPair);
	inLanes(count, [&](auto number, size_t i) {
		using Number = decltype(number);
		const Group<Number, const ContactPoint> point(&points[i], count - i);
		const Group<Number, const PointRecord> record(&records[i], count - i);
		solver.prepare<Number>(k, i, stepInput<Number>(bodies, pair, solver.stepLength(), point, record));
	});
	PointStep* steps = solver.stepsOf(solverPair);
	for (size_t i = 0; i < count; ++i)
		steps[i].idle = records[i].isIdle();
	if (!solver.isExplicit()) prepareImpacts({ records.data(), steps, count }, pair, solver.stepLength());
}

PairForce storeForces(ContactSolver& solver, size_t k, const PairProperties& pair, std::vector<PointRecord>& records,
        PairEnergies& energies)
{
	const SolverPair& solverPair = solver.pair(k);
	assert(records.size() == solverPair.count);
	const SolverBodies bodies = solver.bodiesOf(solverPair);
	const PointStep* steps = solver.stepsOf(solverPair);
	const double h = solver.stepLength();
	Sums<12> impulses;
	Sums<6> sums(energies.dashpotNormal, energies.dashpotShear, energies.friction, energies.elasticNormal,
	        energies.elasticShear, energies.crushing);
	inLanes(solverPair.count, [&](auto number, size_t i) {
		using Number = decltype(number);
		using Vec = Vec3Of<Number>;
		const size_t count = solverPair.count - i;
		const Group<Number, PointRecord> record(&records[i], count);
		const SolvedPoints<Number> s(pair, h, bodies, record, Group<Number, const PointStep>(steps + i, count));
		const Vec normalImpulse = s.p[0] * s.axes[0],
		          impulse = normalImpulse + s.p[1] * s.axes[1] + s.p[2] * s.axes[2];
		impulses.add<Number>(
		        count, impulse, Vec(-s.armA.cross(impulse)), Vec(s.armB.cross(impulse)), normalImpulse);
		const Number elastic = record.get(&PointRecord::normalForce),
		             limit = Number(pair.friction) * (s.p[0] / Number(h));
		const Vec shear = clipped(Vec(record.get(&PointRecord::shearForce)), limit);
		record.set(&PointRecord::shearForce, shear);
		record.set(&PointRecord::dashpotForce, Vec(impulse / Number(h) - elastic * s.axes[0] - shear));
		const Account<Number> normal = s.storeNormal(), tangential = s.storeShear(shear, limit);
		sums.add<Number>(count, normal.dashpot(), tangential.dashpot(), tangential.yielding, normal.stored,
		        tangential.stored, normal.yielding);
	});
	energies = { sums[0], sums[1], sums[2], sums[3], sums[4], sums[5] };
	const PairForce impulse { impulses.vector(0), impulses.vector(3), impulses.vector(6), impulses.vector(9) };
	followImpacts(solverPair, steps, bodies, impulse, h, records.data());
	return { impulse.onB / h, impulse.torqueA / h, impulse.torqueB / h, impulse.normalOnB / h };
}

} // namespace timber

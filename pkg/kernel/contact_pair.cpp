// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_pair.hpp"
#include <type_traits>

namespace timber {
namespace {

	using Points = std::vector<ContactPoint>;
	using States = std::vector<PointState>;

	/// Relative motion at a contact point, from the velocities that led to the present placement. They belong to the middle of
	/// the last step, and so do the arms: with those of now, a pair that turns as a whole would seem to slide, by h/2 omega^2 per
	/// metre between the centres.
	template <class Number> [[gnu::always_inline]] inline PointMotion<Number> motionAt(const Vec3Of<Number>& x, const BodyMotion& a, const BodyMotion& b, double h)
	{
		const auto velocity = [&](const BodyMotion& body) {
			const Vec3Of<Number> arm = x - wide<Number>(body.position), spin = wide<Number>(body.spin);
			return Vec3Of<Number>(wide<Number>(body.velocity) + spin.cross(arm - Number(h / 2) * spin.cross(arm)));
		};
		return { velocity(b) - velocity(a), (a.spin + b.spin) / 2 };
	}

	bool sameFeatures(const Points& points, const States& states)
	{
		return std::equal(points.begin(), points.end(), states.begin(), states.end(), [](const auto& p, const auto& s) { return p.id == s.id; });
	}

	template <class Law> class ElasticPair {
		const Law& law;
		const PairProperties& pair;
		const BodyMotion &a, &b;
		const double h;
		const NormalForm form;

		void step(const ContactPoint& point, PointState& state) const { elasticStep<Law, ContactPoint, double>(law, pair, point, motionAt<double>(point.position, a, b, h), h, form, state); }
		/// Energy that goes with a point. What its normal spring has given back on the way is not lost: all of it, when the bodies simply parted. [J]
		double leaving(const PointState& s) const
		{
			const double beyond = s.normal > 0 ? (s.energy - law.energy(s.overlap)) / s.normal : 0; // the limit, from where on the force is constant
			const double left = std::max(0., s.overlap + beyond + std::min(0., s.closing)), pressed = std::min(left, s.overlap);
			return law.energy(pressed) + (left - pressed) * s.normal + shearEnergy<double>(s, pair);
		}

		/// First step of a new point, with the overlap it may start with; returns what it takes of `energy`. [J]
		double bear(const ContactPoint& point, double energy, PointState& state) const
		{
			const double speed = std::max(0., -motionAt<double>(point.position, a, b, h).velocity.dot(point.normal)), approach = approachOverlap(law, pair.mass, speed, h);
			const double counted = bornOverlap(law, point.overlap, approach, energy);
			state.excess = point.overlap - counted;
			step(point, state);
			if (counted <= std::min(approach, pair.overlapLimit) && form == NormalForm::Closed) state.arrival = std::max(speed * h, state.overlap);
			return law.energy(counted) - law.energy(std::min(counted, approach));
		}

	public:
		ElasticPair(const Law& l, const PairProperties& p, const BodyMotion& motionA, const BodyMotion& motionB, double step, NormalForm f)
		        : law(l)
		        , pair(p)
		        , a(motionA)
		        , b(motionB)
		        , h(step)
		        , form(f)
		{
		}

		/// The same features meet as in the last step.
		void run(const Points& points, States& states) const
		{
			using Kept = Springs<double>;
			inLanes(points.size(), [&](auto number, size_t k) {
				using Number = decltype(number);
				struct Place {
					Vec3Of<Number> normal;
					Number overlap;
				};
				const Group<Number, const ContactPoint> at(&points[k], points.size() - k);
				const Group<Number, PointState> kept(&states[k], points.size() - k);
				Springs<Number> s;
				s.excess = kept.get(&Kept::excess);
				s.overlap = kept.get(&Kept::overlap);
				s.stiffness = kept.get(&Kept::stiffness);
				if (form == NormalForm::Increment) s.normal = kept.get(&Kept::normal);
				s.shear = kept.get(&Kept::shear);
				const Place place { at.get(&ContactPoint::normal), at.get(&ContactPoint::overlap) };
				elasticStep<Law, Place, Number>(law, pair, place, motionAt<Number>(at.get(&ContactPoint::position), a, b, h), h, form, s);
				kept.set(&Kept::excess, s.excess);
				kept.set(&Kept::overlap, s.overlap);
				kept.set(&Kept::stiffness, s.stiffness);
				kept.set(&Kept::normal, s.normal);
				kept.set(&Kept::energy, s.energy);
				kept.set(&Kept::shear, s.shear);
				kept.set(&Kept::slide, s.slide);
				kept.set(&Kept::shearBefore, s.shearBefore);
				kept.set(&Kept::shearEnergyBefore, s.shearEnergyBefore);
			});
		}

		/// Other features meet than in the last step. Returns the energy lost.
		double runChanged(const Points& points, States& states, bool placed) const
		{
			States next(points.size());
			double lost = 0;
			auto old = states.begin();
			for (size_t k = 0; k < next.size(); ++k) {
				for (; old != states.end() && old->id < points[k].id; ++old)
					lost += leaving(*old);
				if (old != states.end() && old->id == points[k].id) next[k] = *old++;
			}
			for (; old != states.end(); ++old)
				lost += leaving(*old);
			for (size_t k = 0; k < next.size(); ++k) {
				const bool isNew = !(next[k].id == points[k].id);
				next[k].id = points[k].id;
				if (isNew && !placed) lost -= bear(points[k], lost, next[k]);
				else step(points[k], next[k]);
			}
			states.swap(next);
			return lost;
		}
	};

	/// Books the springs of new points with arrivalForce(), and what they were booked with besides to the dashpots.
	void bookArrivals(const ContactSolver& solver, size_t k, const SolverBody& a, const SolverBody& b, double h, States& states, PairEnergies& books)
	{
		for (size_t i = 0; i < states.size(); ++i) {
			PointState& s = states[i];
			if (s.arrival == 0) continue;
			const ContactSolver::Row row = solver.row(k, i);
			const double before = -relativeVelocity<double>(row.armA, row.armB, a.velocity, a.spin, b.velocity, b.spin).dot(row.normal) * h;
			const double besides = s.normal - arrivalForce(s.energy, s.stiffness, s.overlap, s.arrival, s.closing);
			books.dashpotNormal += besides * (before + s.closing) / 2;
			books.elasticPower -= besides * s.closing / h;
			s.arrival = 0;
		}
	}

	/// Rows of the k-th pair from a point on, as many as a Number has lanes.
	template <class Number> decltype(auto) rowsOf(const ContactSolver& solver, size_t k, size_t point)
	{
		if constexpr (std::is_same_v<Number, double>) return solver.row(k, point);
		else return solver.rowsFrom(k, point);
	}

} // namespace

template <class Law>
double elasticPair(const Law& law, const PairProperties& pair, const BodyMotion& a, const BodyMotion& b, double h, NormalForm form, bool placed, const Points& points, States& states)
{
	const ElasticPair<Law> step(law, pair, a, b, h, form);
	if (!sameFeatures(points, states)) return step.runChanged(points, states, placed);
	step.run(points, states);
	return 0;
}
template double elasticPair(const HertzLaw&, const PairProperties&, const BodyMotion&, const BodyMotion&, double, NormalForm, bool, const Points&, States&);
template double elasticPair(const LinearLaw&, const PairProperties&, const BodyMotion&, const BodyMotion&, double, NormalForm, bool, const Points&, States&);

void prepareContacts(ContactSolver& solver, size_t k, const std::vector<SolverBody>& bodies, const PairProperties& pair, double dampingRatio, double h, bool refresh,
        const Points& points, States& states)
{
	const SolverBody &a = bodies[solver.pair(k).bodyA], &b = bodies[solver.pair(k).bodyB];
	for (size_t i = 0; i < points.size(); ++i)
		if (refresh || states[i].responseMass != inverseMass(a, b))
			static_cast<PointResponse&>(states[i]) = responseAt(a, b, points[i].position - a.position, points[i].position - b.position, points[i].normal);
	inLanes(points.size(), [&](auto number, size_t i) {
		using Number = decltype(number);
		const Group<Number, const ContactPoint> at(&points[i], points.size() - i);
		const Group<Number, const PointState> kept(&states[i], points.size() - i);
		const Vec3Of<Number> position = at.get(&ContactPoint::position);
		ContactInput<Number> p;
		p.armA = position - wide<Number>(a.position);
		p.armB = position - wide<Number>(b.position);
		p.normal = at.get(&ContactPoint::normal);
		p.elasticNormal = kept.get(&PointState::normal);
		p.elasticShear = kept.get(&PointState::shear);
		p.normalDamping = Number(2 * dampingRatio) * root(Number(pair.mass) * kept.get(&PointState::stiffness));
		p.shearDamping = p.normalDamping * Number(std::sqrt(pair.shearRatio));
		p.friction = pair.friction;
		p.impulse = Number(h) * (p.elasticNormal * p.normal + p.elasticShear + kept.get(&PointState::dashpot));
		p.normalResponse = kept.get(&PointState::normalResponse);
		p.shearResponse = kept.get(&PointState::shearResponse);
		p.normalStiffness = kept.get(&PointState::stiffness);
		p.shearStiffness = Number(pair.shearRatio) * p.normalStiffness;
		solver.set<Number>(k, i, bodies, p, h);
	});
}

PairForce storeForces(const ContactSolver& solver, size_t k, const std::vector<SolverBody>& bodies, const PairProperties& pair, double h, States& states, PairEnergies* energies)
{
	const SolverBody &a = bodies[solver.pair(k).bodyA], &b = bodies[solver.pair(k).bodyB];
	Sums<9> sums;
	PairEnergies none;
	PairEnergies& own = energies ? *energies : none;
	Sums<6> books(own.dashpotNormal, own.dashpotShear, own.friction, own.elasticNormal, own.elasticShear, own.elasticPower);
	inLanes(states.size(), [&](auto number, size_t i) {
		using Number = decltype(number);
		using Vec = Vec3Of<Number>;
		const size_t count = states.size() - i;
		decltype(auto) row = rowsOf<Number>(solver, k, i);
		const Group<Number, PointState> kept(&states[i], count);
		const Vec &normal = row.normal, &armA = row.armA, &armB = row.armB;
		const Vec force = row.impulse / Number(h), torqueA = -armA.cross(force), torqueB = armB.cross(force);
		const Number elasticNormal = kept.get(&PointState::normal);
		const Vec shear = limitedShear<Number>(kept.get(&PointState::shear), Number(pair.friction), force.dot(normal));
		const Vec dashpot = force - elasticNormal * normal - shear;
		kept.set(&PointState::shear, shear);
		kept.set(&PointState::dashpot, dashpot);
		sums.add<Number>(count, force, torqueA, torqueB);
		const Vec after = relativeVelocity<Number>(armA, armB, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin);
		kept.set(&PointState::closing, Number(-after.dot(normal) * Number(h)));
		if (!energies) return;
		const Vec before = relativeVelocity<Number>(armA, armB, a.velocity, a.spin, b.velocity, b.spin);
		const Vec mean = (before + after) / Number(2.);
		const Number along = dashpot.dot(normal), stored = shearEnergy<Number>(shear, Number(pair.shearRatio) * kept.get(&PointState::stiffness));
		const Number normalWork = -(Number(h) * along * mean.dot(normal)), shearWork = -(Number(h) * (dashpot - along * normal).dot(mean));
		const Number slid = -(kept.get(&PointState::slide).dot(kept.get(&PointState::shearBefore) + shear) / Number(2.) + stored - kept.get(&PointState::shearEnergyBefore));
		books.add<Number>(count, normalWork, shearWork, slid, Number(kept.get(&PointState::energy)), stored, Number(-(elasticNormal * normal + shear).dot(after)));
	});
	own = { books[0], books[1], books[2], books[3], books[4], books[5] };
	bookArrivals(solver, k, a, b, h, states, own);
	return { sums.vector(0), sums.vector(3), sums.vector(6) };
}

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_solver.hpp"
#include "constants.hpp"
#include <algorithm>
#include <cmath>
#include <type_traits>

namespace timber {
namespace {

	/// Change of a body's velocity at the arm per unit impulse there: 1/m - [r] I^-1 [r]. [1/kg]
	Mat3 pointResponse(const SolverBody& body, const Vec3& arm)
	{
		Mat3 s;
		s << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
		Mat3 response = -(s * body.inverseInertia * s);
		response.diagonal().array() += body.inverseMass;
		return response;
	}

	/// Largest response to a unit impulse in the plane normal to n. [1/kg]
	double largestShearResponse(const Mat3& response, const Vec3& n)
	{
		const Vec3 t = n.unitOrthogonal(), u = n.cross(t);
		const Vec3 rt = response * t;
		const double tt = t.dot(rt), tu = u.dot(rt), uu = u.dot(response * u);
		return (tt + uu) / 2 + std::sqrt((tt - uu) * (tt - uu) / 4 + tu * tu);
	}

	/// One direction of a point: p = h e - h C ((1 - theta) v_before + theta v_after) - beta h2 K (v_after - v_before).
	template <class Number> struct Direction {
		Number before; ///< what v_before is multiplied with in it [kg]
		Number kept, gain, share; ///< a visit makes kept p + share (what is known) - gain v of an impulse p that acted on v [-, kg, -]

		/// rate: h C; stiff: h2 K [kg]; a: response of the velocity to an impulse [1/kg].
		Direction(Number rate, Number stiff, Number a)
		{
			const Number x = rate * a, theta = Number(0.5) + x / (Number(12.) + Number(2.) * x);
			const Number y = stiff * a, inertia = stiff * (y / (Number(4.) * y + Number(2.)));
			const Number after = rate * theta + inertia;
			before = inertia - rate * (Number(1.) - theta);
			share = Number(1.) / (Number(1.) + after * a);
			gain = share * after;
			kept = gain * a;
		}
	};

	template <class Number> ContactConstraint<Number> rowOf(const ContactInput<Number>& p, const SolverBody& a, const SolverBody& b, double step)
	{
		const Number h = step, square = step * step, response = p.normal.dot(p.normalResponse);
		const Direction<Number> along(h * p.normalDamping, square * p.normalStiffness, response);
		const Direction<Number> across(h * p.shearDamping, square * p.shearStiffness, p.shearResponse);
		const Vec3Of<Number> before = relativeVelocity<Number>(p.armA, p.armB, a.velocity, a.spin, b.velocity, b.spin);
		const Number vn = before.dot(p.normal);
		ContactConstraint<Number> row;
		row.armA = p.armA;
		row.armB = p.armB;
		row.normal = p.normal;
		row.impulse = p.impulse;
		row.friction = p.friction;
		row.normalKept = along.kept;
		row.normalGain = along.gain;
		row.normalDrive = along.share * (h * p.elasticNormal + along.before * vn);
		row.shearKept = across.kept;
		row.shearGain = across.gain;
		row.shearDrive = across.share * Vec3Of<Number>(h * p.elasticShear + across.before * (before - vn * p.normal));
		row.coupling = across.gain * Vec3Of<Number>(p.normalResponse - response * p.normal);
		return row;
	}

	/// Impulse of explicit springs and dashpots. As the paper has it, the elastic force alone decides whether a point slides, and one
	/// that slides has no dashpot; with long steps loaded light members would chatter from limit to limit.
	template <class Number> Vec3Of<Number> explicitImpulse(const ContactInput<Number>& p, const SolverBody& a, const SolverBody& b, double h)
	{
		const Vec3Of<Number> v = relativeVelocity<Number>(p.armA, p.armB, a.velocity, a.spin, b.velocity, b.spin);
		const Number vn = v.dot(p.normal), normal = most(Number(0.), Number(p.elasticNormal - p.normalDamping * vn)), limit = p.friction * normal;
		const Vec3Of<Number> dashpot = p.shearDamping * (v - vn * p.normal);
		const Vec3Of<Number> shear = chosen(p.elasticShear.squaredNorm() > limit * limit, [&] { return p.elasticShear; }, [&] { return Vec3Of<Number>(p.elasticShear - dashpot); });
		return Number(h) * (normal * p.normal + clipped<Number>(shear, limit));
	}

	/// Velocities of a pair while its points are worked on.
	struct Motion {
		Vec3 velocityA, spinA, velocityB, spinB;

		Motion(const SolverBody& a, const SolverBody& b)
		        : velocityA(a.newVelocity)
		        , spinA(a.newSpin)
		        , velocityB(b.newVelocity)
		        , spinB(b.newSpin)
		{
		}
		explicit Motion(const Sums<12>& sums)
		        : velocityA(sums.vector(0))
		        , spinA(sums.vector(3))
		        , velocityB(sums.vector(6))
		        , spinB(sums.vector(9))
		{
		}
		Vec3 at(const ContactSolver::Row& row) const { return velocityB + spinB.cross(row.armB) - velocityA - spinA.cross(row.armA); } // relativeVelocity(), but in registers
		void push(const SolverBody& a, const SolverBody& b, const ContactSolver::Row& row, const Vec3& impulse)
		{
			velocityA -= a.inverseMass * impulse;
			spinA -= a.inverseInertia * row.armA.cross(impulse);
			velocityB += b.inverseMass * impulse;
			spinB += b.inverseInertia * row.armB.cross(impulse);
		}
		void store(SolverBody& a, SolverBody& b) const
		{
			if (a.inverseMass > 0) a.newVelocity = velocityA, a.newSpin = spinA;
			if (b.inverseMass > 0) b.newVelocity = velocityB, b.newSpin = spinB;
		}
	};

} // namespace

PointResponse responseAt(const SolverBody& a, const SolverBody& b, const Vec3& armA, const Vec3& armB, const Vec3& normal)
{
	const Mat3 response = pointResponse(a, armA) + pointResponse(b, armB);
	return { response * normal, largestShearResponse(response, normal), inverseMass(a, b) };
}

void ContactSolver::clear(int mostSweeps)
{
	sweeps = mostSweeps;
	pairs.clear();
}

size_t ContactSolver::addPair(int bodyA, int bodyB, size_t count)
{
	const size_t first = pairs.empty() ? 0 : pairs.back().first + groupsOf(pairs.back().count), end = first + groupsOf(count);
	pairs.push_back({ bodyA, bodyB, first, count, 0 });
	if (rows.size() < end) rows.resize(end); // rows of the last step are overwritten by set(), but for lanes to spare
	return pairs.size() - 1;
}

template <class Number> void ContactSolver::set(size_t k, size_t first, const std::vector<SolverBody>& bodies, const ContactInput<Number>& points, double h)
{
	const Pair& pair = pairs[k];
	const SolverBody &a = bodies[pair.bodyA], &b = bodies[pair.bodyB];
	ContactConstraint<Number> row = rowOf<Number>(points, a, b, h);
	if (sweeps == 0) row.impulse = explicitImpulse<Number>(points, a, b, h);
	Rows& to = rows[pair.first + first / laneCount];
	if constexpr (std::is_same_v<Number, Lanes>) to = row;
	else forMembers(to, row, [&](auto& all, const auto& one) { setLane(all, first % laneCount, one); });
}
template void ContactSolver::set(size_t, size_t, const std::vector<SolverBody>&, const ContactInput<double>&, double);
template void ContactSolver::set(size_t, size_t, const std::vector<SolverBody>&, const ContactInput<Lanes>&, double);

void ContactSolver::relax(std::vector<SolverBody>& bodies, Pair& pair, bool forwards)
{
	SolverBody &a = bodies[pair.bodyA], &b = bodies[pair.bodyB];
	Motion motion(a, b);
	pair.change = 0;
	for (size_t k = 0; k < pair.count; ++k) {
		const size_t point = forwards ? k : pair.count - 1 - k;
		const Row row = rowAt(pair, point);
		const Vec3 v = motion.at(row);
		const double vn = v.dot(row.normal), normal = row.impulse.dot(row.normal);
		const double newNormal = std::max(0., row.normalKept * normal + row.normalDrive - row.normalGain * vn);
		const Vec3 tangential = row.shearKept * (row.impulse - normal * row.normal) + row.shearDrive - row.shearGain * (v - vn * row.normal);
		const Vec3 impulse = newNormal * row.normal + clipped<double>(tangential - (newNormal - normal) * row.coupling, row.friction * newNormal);
		const Vec3 change = impulse - row.impulse;
		motion.push(a, b, row, change);
		setLane(rows[pair.first + point / laneCount].impulse, point % laneCount, impulse);
		pair.change += change.squaredNorm();
	}
	pair.change *= inverseMass(a, b);
	motion.store(a, b);
}

/// Change of a point, as in Pair::change, that counts as none. [J]
double ContactSolver::threshold(const std::vector<SolverBody>& bodies, double tolerance) const
{
	double size = 0;
	size_t count = 0;
	for (const Pair& pair : pairs) {
		Sums<1> squares(0.);
		for (size_t point = 0; point < pair.count; point += laneCount)
			squares.add<Lanes>(pair.count - point, rowsAt(pair, point).impulse.squaredNorm());
		size += squares[0] * inverseMass(bodies[pair.bodyA], bodies[pair.bodyB]);
		count += pair.count;
	}
	return tolerance * tolerance * size / std::max(1., double(count));
}

/// Has the neighbours of a pair looked at in this pass (if their turn is still to come) and in the next one, if the pair
/// has changed by more than `allowed` per point.
bool ContactSolver::wake(const std::vector<SolverBody>& bodies, const Pair& pair, double allowed)
{
	if (pair.change <= allowed * double(pair.count)) return false;
	for (const int body : { pair.bodyA, pair.bodyB })
		if (bodies[body].inverseMass > 0) awake[body] = passes + 1;
	return true;
}

/// A pass over the pairs that are awake. Returns whether another one is needed.
bool ContactSolver::sweepOn(std::vector<SolverBody>& bodies, double allowed, bool forwards)
{
	bool changed = false;
	++passes;
	for (Pair& pair : pairs) {
		if (awake[pair.bodyA] < passes && awake[pair.bodyB] < passes) continue;
		relax(bodies, pair, forwards);
		changed = wake(bodies, pair, allowed) || changed;
	}
	return changed;
}

/// Returns the number of passes.
int ContactSolver::sweepAll(std::vector<SolverBody>& bodies, double tolerance)
{
	awake.resize(bodies.size(), 0);
	++passes;
	for (Pair& pair : pairs)
		relax(bodies, pair, true);
	const double allowed = threshold(bodies, tolerance);
	bool changed = false;
	for (const Pair& pair : pairs)
		changed = wake(bodies, pair, firstSweepShare * firstSweepShare * allowed) || changed;
	int done = 1;
	for (; changed && done < sweeps; ++done)
		changed = sweepOn(bodies, allowed, done % 2 == 0);
	return done;
}

/// Lets the impulses of a pair's points act on its bodies: Motion::push() in lanes.
void ContactSolver::pushAll(std::vector<SolverBody>& bodies, const Pair& pair)
{
	SolverBody &a = bodies[pair.bodyA], &b = bodies[pair.bodyB];
	Sums<12> all(a.newVelocity, a.newSpin, b.newVelocity, b.newSpin);
	for (size_t point = 0; point < pair.count; point += laneCount) {
		const Rows& row = rowsAt(pair, point);
		const Vec3s turnA = wide<Lanes>(a.inverseInertia) * row.armA.cross(row.impulse), turnB = wide<Lanes>(b.inverseInertia) * row.armB.cross(row.impulse);
		all.add<Lanes>(pair.count - point, Vec3s(Lanes(-a.inverseMass) * row.impulse), Vec3s(-turnA), Vec3s(Lanes(b.inverseMass) * row.impulse), turnB);
	}
	Motion(all).store(a, b);
}

int ContactSolver::solve(std::vector<SolverBody>& bodies, double tolerance)
{
	for (const Pair& pair : pairs)
		pushAll(bodies, pair);
	return sweeps == 0 ? 0 : sweepAll(bodies, tolerance);
}

} // namespace timber

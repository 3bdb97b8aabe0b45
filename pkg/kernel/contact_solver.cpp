// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_solver.hpp"
#include "constants.hpp"
#include "preconditions.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <type_traits>

namespace timber {
namespace {

	/// Largest eigenvalue of the response in the plane normal to n. [1/kg]
	double largestShearResponse(const Mat3& response, const Vec3& n)
	{
		const Vec3 t = n.unitOrthogonal(), u = n.cross(t);
		const Vec3 rt = response * t;
		const double tt = t.dot(rt), tu = u.dot(rt), uu = u.dot(response * u);
		return (tt + uu) / 2 + std::sqrt((tt - uu) * (tt - uu) / 4 + tu * tu);
	}

	/// Coefficients of (2) in one direction of a point.
	template <class Number> struct ImplicitDirection {
		Number G; ///< weight of the velocity before the step [kg]
		Number mass, factor; ///< M [kg], f [-]
		Number scale; ///< 1 / (1 + a D) [-]

		/// hC: h C [kg]; hhK: h2 K [kg]; a: response [1/kg].
		ImplicitDirection(Number hC, Number hhK, Number a)
		{
			const Number x = hC * a, theta = Number(0.5) + x / (Number(12.) + Number(2.) * x);
			const Number y = hhK * a, newmark = hhK * (y / (Number(4.) * y + Number(2.))); // beta h2 K
			const Number D = hC * theta + newmark;
			G = newmark - hC * (Number(1.) - theta);
			scale = Number(1.) / (Number(1.) + D * a);
			mass = scale * D;
			factor = mass * a;
		}
	};

	template <class Number> ContactConstraint<Number> constraintOf(const ContactInput<Number>& p, const SolverBody& a, const SolverBody& b, double h)
	{
		const Number response = p.normal.dot(p.normalResponse);
		const ImplicitDirection<Number> normal(Number(h) * p.normalDamping, Number(h * h) * p.normalStiffness, response);
		const ImplicitDirection<Number> shear(Number(h) * p.shearDamping, Number(h * h) * p.shearStiffness, p.shearResponse);
		const Vec3Of<Number> v = relativeVelocity<Number>(p.armA, p.armB, a.velocity, a.spin, b.velocity, b.spin);
		const Number vn = v.dot(p.normal);
		ContactConstraint<Number> c;
		c.armA = p.armA;
		c.armB = p.armB;
		c.normal = p.normal;
		c.impulse = p.impulse;
		c.friction = p.friction;
		c.normalFactor = normal.factor;
		c.normalMass = normal.mass;
		c.normalBias = normal.scale * (Number(h) * p.elasticNormal + normal.G * vn);
		c.shearFactor = shear.factor;
		c.shearMass = shear.mass;
		c.shearBias = shear.scale * Vec3Of<Number>(Number(h) * p.elasticShear + shear.G * (v - vn * p.normal));
		c.rebound = noRebound;
		c.release = p.release;
		c.response = response;
		c.energy = p.energy;
		c.coupling = shear.mass * Vec3Of<Number>(p.normalResponse - response * p.normal);
		return c;
	}

	/// Impulse of explicit springs and dashpots (Eqs. 17, 18, 21-24). As in the paper, the elastic force alone decides whether a point
	/// slides, and a sliding point has no dashpot. With long steps this rule makes loaded light members chatter between the limits.
	template <class Number> Vec3Of<Number> explicitImpulse(const ContactInput<Number>& p, const SolverBody& a, const SolverBody& b, double h)
	{
		const Vec3Of<Number> v = relativeVelocity<Number>(p.armA, p.armB, a.velocity, a.spin, b.velocity, b.spin);
		const Number vn = v.dot(p.normal);
		const Number normalForce = max(Number(0.), Number(p.elasticNormal - p.normalDamping * vn)), limit = p.friction * normalForce;
		const Vec3Of<Number> dashpotForce = p.shearDamping * (v - vn * p.normal);
		const Vec3Of<Number> shearForce = selectLazily(
		        p.elasticShear.squaredNorm() > limit * limit, [&] { return p.elasticShear; },
		        [&] { return Vec3Of<Number>(p.elasticShear - dashpotForce); });
		return Number(h) * (normalForce * p.normal + clipped<Number>(shearForce, limit));
	}

	/// Velocities of a pair while its points are solved.
	struct PairVelocity {
		Vec3 velocityA, spinA, velocityB, spinB;

		PairVelocity(const SolverBody& a, const SolverBody& b)
		        : velocityA(a.newVelocity)
		        , spinA(a.newSpin)
		        , velocityB(b.newVelocity)
		        , spinB(b.newSpin)
		{
		}
		explicit PairVelocity(const Sums<12>& sums)
		        : velocityA(sums.vector(0))
		        , spinA(sums.vector(3))
		        , velocityB(sums.vector(6))
		        , spinB(sums.vector(9))
		{
		}
		Vec3 at(const ContactSolver::Constraint& c) const
		{
			return velocityB + spinB.cross(c.armB) - velocityA - spinA.cross(c.armA);
		} // relativeVelocity(), but in registers
		void apply(const SolverBody& a, const SolverBody& b, const ContactSolver::Constraint& c, const Vec3& impulse)
		{
			velocityA -= a.inverseMass * impulse;
			spinA -= a.inverseInertia * c.armA.cross(impulse);
			velocityB += b.inverseMass * impulse;
			spinB += b.inverseInertia * c.armB.cross(impulse);
		}
		void store(SolverBody& a, SolverBody& b) const
		{
			if (a.inverseMass > 0) a.newVelocity = velocityA, a.newSpin = spinA;
			if (b.inverseMass > 0) b.newVelocity = velocityB, b.newSpin = spinB;
		}
	};

	/// Impulse with which a spring does the work U: p_U of (5). base: velocity of separation without it.
	double energyImpulse(const ContactSolver::Constraint& c, double base)
	{
		const double root = std::sqrt(base * base + 8 * c.response * c.energy);
		return base > 0 ? 4 * c.energy / (base + root) : (root - base) / (2 * c.response);
	}

	/// Normal impulse of a point that separates or whose impact ends: (5), (6). pn: by (3).
	double endingImpulse(const ContactSolver::Constraint& c, double pn0, double un, double pn)
	{
		const double base = un - c.response * pn0;
		if (c.rebound < noRebound) return std::max(0., (c.rebound - base) / c.response);
		return std::min(pn, std::max((c.release - base) / c.response, energyImpulse(c, base)));
	}

	/// Normal impulse: (3), (5), (6). un: current velocity of separation.
	[[gnu::always_inline]] inline double normalImpulse(const ContactSolver::Constraint& c, double pn0, double un)
	{
		const double pn = std::max(0., c.normalFactor * pn0 + c.normalBias - c.normalMass * un), after = un + c.response * (pn - pn0);
		const bool ends = after > std::min(c.rebound, c.release) || (pn == 0 && after > 0 && c.rebound < noRebound);
		return ends ? endingImpulse(c, pn0, un, pn) : pn;
	}

	template <class Number> [[maybe_unused]] bool isValid(const ContactInput<Number>& p)
	{
		return isFinite(p.armA) && isFinite(p.armB) && isUnit(p.normal) && isFinite(p.elasticNormal) && isNonNegative(p.elasticNormal)
		        && isFinite(p.elasticShear) && isFinite(p.impulse) && isNonNegative(p.normalDamping) && isNonNegative(p.shearDamping)
		        && isNonNegative(p.friction) && isNonNegative(p.normalStiffness) && isNonNegative(p.shearStiffness) && isFinite(p.normalResponse)
		        && isNonNegative(p.shearResponse) && isNonNegative(p.release) && isNonNegative(p.energy);
	}

} // namespace

PointResponse responseAt(const SolverBody& a, const SolverBody& b, const Vec3& armA, const Vec3& armB, const Vec3& normal)
{
	assert(isFinite(armA) && isFinite(armB) && isUnit(normal));
	assert(a.inverseMass >= 0 && b.inverseMass >= 0 && isFinite(a.inverseInertia) && isFinite(b.inverseInertia));
	const Mat3 response = bodyResponse(a, armA) + bodyResponse(b, armB);
	return { response * normal, largestShearResponse(response, normal), pairInverseMass(a, b) };
}

void ContactSolver::begin(int sweepLimit)
{
	assert(sweepLimit >= 0);
	maxSweeps = sweepLimit;
	pairs.clear();
	dashpots.clear();
}

size_t ContactSolver::addPair(int bodyA, int bodyB, size_t count)
{
	assert(bodyA >= 0 && bodyB >= 0 && bodyA != bodyB);
	const size_t first = pairs.empty() ? 0 : pairs.back().first + groupsOf(pairs.back().count), end = first + groupsOf(count);
	pairs.push_back({ bodyA, bodyB, first, count, 0 });
	if (groups.size() < end) groups.resize(end); // prepare() overwrites those of the last step, except unused lanes
	return pairs.size() - 1;
}

size_t ContactSolver::addDashpot(int bodyA, int bodyB)
{
	assert(bodyA >= 0 && bodyB >= 0 && bodyA != bodyB);
	dashpots.emplace_back();
	dashpots.back().bodyA = bodyA;
	dashpots.back().bodyB = bodyB;
	return dashpots.size() - 1;
}

void ContactSolver::prepareDashpot(size_t k, const std::vector<SolverBody>& bodies, const JointModes& modes, const Mat3& axesA, double ratio, double h)
{
	assert(k < dashpots.size() && size_t(std::max(dashpots[k].bodyA, dashpots[k].bodyB)) < bodies.size());
	timber::prepareDashpot(dashpots[k], bodies[dashpots[k].bodyA], bodies[dashpots[k].bodyB], modes, axesA, ratio, h);
}

template <class Number> void ContactSolver::prepare(size_t k, size_t first, const std::vector<SolverBody>& bodies, const ContactInput<Number>& points, double h)
{
	assert(k < pairs.size() && first < pairs[k].count && size_t(std::max(pairs[k].bodyA, pairs[k].bodyB)) < bodies.size());
	assert((std::is_same_v<Number, double>) || first % laneCount == 0);
	assert(h > 0 && std::isfinite(h) && isValid(points));
	const SolverPair& pair = pairs[k];
	const SolverBody &a = bodies[pair.bodyA], &b = bodies[pair.bodyB];
	ContactConstraint<Number> constraint = constraintOf<Number>(points, a, b, h);
	if (maxSweeps == 0) {
		constraint.impulse = explicitImpulse<Number>(points, a, b, h);
		constraint.release = noRebound; // (5) is not applied
	}
	ConstraintGroup& group = groups[pair.first + first / laneCount];
	if constexpr (std::is_same_v<Number, Lanes>) group = constraint;
	else forMembers(group, constraint, [&](auto& all, const auto& one) { setLane(all, first % laneCount, one); });
}
template void ContactSolver::prepare(size_t, size_t, const std::vector<SolverBody>&, const ContactInput<double>&, double);
template void ContactSolver::prepare(size_t, size_t, const std::vector<SolverBody>&, const ContactInput<Lanes>&, double);

void ContactSolver::setImpact(size_t k, size_t point, double rebound)
{
	assert(maxSweeps > 0 && k < pairs.size() && point < pairs[k].count && rebound >= 0);
	setLane(groups[pairs[k].first + point / laneCount].rebound, point % laneCount, rebound);
}

/// Applies the impulses of a pair's points to its bodies: PairVelocity::apply(), SIMD-vectorised.
void ContactSolver::warmStart(std::vector<SolverBody>& bodies, const SolverPair& pair)
{
	SolverBody &a = bodies[pair.bodyA], &b = bodies[pair.bodyB];
	Sums<12> all(a.newVelocity, a.newSpin, b.newVelocity, b.newSpin);
	for (size_t point = 0; point < pair.count; point += laneCount) {
		const ConstraintGroup& group = groupAt(pair, point);
		const Vec3s spinA = broadcast<Lanes>(a.inverseInertia) * group.armA.cross(group.impulse),
		            spinB = broadcast<Lanes>(b.inverseInertia) * group.armB.cross(group.impulse);
		all.add<Lanes>(
		        pair.count - point, Vec3s(Lanes(-a.inverseMass) * group.impulse), Vec3s(-spinA), Vec3s(Lanes(b.inverseMass) * group.impulse), spinB);
	}
	PairVelocity(all).store(a, b);
}

/// One Gauss-Seidel visit of each point of a pair: (3) to (6).
void ContactSolver::solvePair(std::vector<SolverBody>& bodies, SolverPair& pair, bool forwards)
{
	SolverBody &a = bodies[pair.bodyA], &b = bodies[pair.bodyB];
	PairVelocity velocity(a, b);
	pair.squaredChange = 0;
	for (size_t k = 0; k < pair.count; ++k) {
		const size_t point = forwards ? k : pair.count - 1 - k;
		const Constraint c = constraintAt(pair, point);
		const Vec3 u = velocity.at(c);
		const double un = u.dot(c.normal), pn0 = c.impulse.dot(c.normal);
		const double pn = normalImpulse(c, pn0, un);
		const Vec3 ps = c.shearFactor * (c.impulse - pn0 * c.normal) + c.shearBias - c.shearMass * (u - un * c.normal);
		const Vec3 impulse = pn * c.normal + clipped<double>(ps - (pn - pn0) * c.coupling, c.friction * pn); // (4)
		const Vec3 change = impulse - c.impulse;
		velocity.apply(a, b, c, change);
		setLane(groups[pair.first + point / laneCount].impulse, point % laneCount, impulse);
		pair.squaredChange += change.squaredNorm();
	}
	pair.squaredChange *= pairInverseMass(a, b);
	velocity.store(a, b);
}

/// Convergence threshold of SolverPair::squaredChange per point, after the first sweep. [J]
double ContactSolver::squaredThreshold(const std::vector<SolverBody>& bodies, double tolerance) const
{
	double size = 0, changes = 0;
	size_t count = 0;
	for (const SolverPair& pair : pairs) {
		Sums<1> squares(0.);
		for (size_t point = 0; point < pair.count; point += laneCount)
			squares.add<Lanes>(pair.count - point, groupAt(pair, point).impulse.squaredNorm());
		size += squares[0] * pairInverseMass(bodies[pair.bodyA], bodies[pair.bodyB]);
		changes += pair.squaredChange;
		count += pair.count;
	}
	for (const DashpotConstraint& joint : dashpots) {
		size += joint.impulse.squaredNorm();
		changes += joint.squaredChange;
		count += joint.count;
	}
	const double least = std::min(tolerance, restTolerance);
	return std::max(std::min(tolerance * tolerance * size, changes), least * least * size) / std::max(1., double(count));
}

/// If a pair has changed by more than the threshold, all pairs of its free bodies are visited in the rest of this sweep and in the next one.
template <class Connection> bool ContactSolver::activateNeighbours(const std::vector<SolverBody>& bodies, const Connection& c, double threshold)
{
	if (c.squaredChange <= threshold * double(c.count)) return false;
	for (const int body : { c.bodyA, c.bodyB })
		if (bodies[body].inverseMass > 0) activeUntil[body] = sweepCount + 1;
	return true;
}

/// A sweep over the active pairs, and over all joints once no pair changes: the impulses of dashpots vary little with those of contacts.
/// Returns whether another sweep is needed.
bool ContactSolver::sweepOnce(std::vector<SolverBody>& bodies, double threshold, bool forwards)
{
	bool changed = false;
	++sweepCount;
	for (SolverPair& pair : pairs) {
		if (activeUntil[pair.bodyA] < sweepCount && activeUntil[pair.bodyB] < sweepCount) continue;
		solvePair(bodies, pair, forwards);
		changed = activateNeighbours(bodies, pair, threshold) || changed;
	}
	return changed || sweepDashpots(bodies, threshold);
}

/// Returns whether another sweep over the pairs is needed.
bool ContactSolver::sweepDashpots(std::vector<SolverBody>& bodies, double threshold)
{
	bool changed = false;
	for (DashpotConstraint& joint : dashpots) {
		solveDashpot(joint, bodies[joint.bodyA], bodies[joint.bodyB], threshold * double(joint.count));
		changed = activateNeighbours(bodies, joint, threshold) || changed;
	}
	return changed;
}

/// All sweeps of a step: the first one over all joints and pairs. Returns their number.
int ContactSolver::sweepToConvergence(std::vector<SolverBody>& bodies, double tolerance)
{
	activeUntil.resize(bodies.size(), 0);
	++sweepCount;
	for (DashpotConstraint& joint : dashpots)
		solveDashpot(joint, bodies[joint.bodyA], bodies[joint.bodyB], 0);
	for (SolverPair& pair : pairs)
		solvePair(bodies, pair, true);
	const double threshold = squaredThreshold(bodies, tolerance);
	bool changed = false;
	for (const SolverPair& pair : pairs)
		changed = activateNeighbours(bodies, pair, firstSweepShare * firstSweepShare * threshold) || changed;
	changed = changed || sweepDashpots(bodies, threshold);
	int done = 1;
	for (; changed && done < maxSweeps; ++done)
		changed = sweepOnce(bodies, threshold, done % 2 == 0);
	if (changed) sweepDashpots(bodies, std::numeric_limits<double>::infinity()); // changes nothing but the dissipated energies
	return done;
}

int ContactSolver::solve(std::vector<SolverBody>& bodies, double tolerance)
{
	assert(tolerance >= 0);
	for (const SolverPair& pair : pairs) {
		assert(size_t(std::max(pair.bodyA, pair.bodyB)) < bodies.size());
		warmStart(bodies, pair);
	}
	if (maxSweeps > 0) return sweepToConvergence(bodies, tolerance);
	for (DashpotConstraint& joint : dashpots)
		applyExplicitDashpot(joint, bodies[joint.bodyA], bodies[joint.bodyB]);
	return 0;
}

} // namespace timber

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

	/// Impulse with which a spring does the work U: p_U of (5). base: velocity of separation without it.
	double energyImpulse(const SweepPoint& c, double base)
	{
		const double root = std::sqrt(base * base + 8 * c.response * c.energy);
		return base > 0 ? 4 * c.energy / (base + root) : (root - base) / (2 * c.response);
	}

	/// Normal impulse of a point that separates or whose impact ends: (5), (6). pn: by (3).
	double endingImpulse(const SweepPoint& c, double pn0, double un, double pn)
	{
		const double base = un - c.response * pn0;
		if (c.rebound < noRebound) return std::max(0., (c.rebound - base) / c.response);
		return std::min(pn, std::max((c.release - base) / c.response, energyImpulse(c, base)));
	}

	/// Normal impulse of a point whose spring hardens within the step: (7), by Newton's method. linear: p_n by (2).
	double hardenedImpulse(const SweepPoint& c, double un, double linear)
	{
		const double h = c.step, a = c.response, scale = 1 - a * c.mass[0];
		const auto stiffness = [&](double n) { return 1.5 * c.hardening * std::sqrt(n); };
		const auto force = [&](double n) { return n * stiffness(n) / 1.5; };
		const double F = force(c.overlap), K = stiffness(c.overlap);
		double p = linear;
		for (int k = 0; k < hardeningSteps; ++k) {
			const double d = -h * (un + a * (p - c.impulse[0])) - hardeningShare * c.overlap;
			if (d <= 0) break;
			const double y = a * h * h * (force(c.overlap + d) - F) / d, beta = y / (4 * y + 2);
			const double middle = c.overlap + std::max(0., d - c.closing) / 2, C = c.damping * std::sqrt(std::sqrt(middle / c.overlap));
			const double more = beta * h * (force(c.overlap + d) - F - K * d) + (C - c.damping) * d;
			const double slope = beta * h * (stiffness(c.overlap + d) - K) + C - c.damping + C * d / (8 * middle); // of `more` by d
			p -= (p - linear - scale * more) / (1 + scale * slope * h * a);
		}
		return p;
	}

	/// Normal impulse by (2), or (7). un: current velocity of separation.
	[[gnu::always_inline]] inline double unlimitedImpulse(const SweepPoint& c, double un, double linear)
	{
		const double closing = -c.step * (un + c.response * (linear - c.impulse[0]));
		return c.hardening > 0 && closing > hardeningShare * c.overlap ? hardenedImpulse(c, un, linear) : linear;
	}

	/// Normal impulse: (3), (5), (6). un: current velocity of separation; unlimited: by (2) or (7).
	[[gnu::always_inline]] inline double normalImpulse(const SweepPoint& c, double un, double unlimited)
	{
		const double pn0 = c.impulse[0], pn = std::max(0., unlimited), after = un + c.response * (pn - pn0);
		const bool ends = after > std::min(c.rebound, c.release) || (pn == 0 && after > 0 && c.rebound < noRebound);
		return ends ? endingImpulse(c, pn0, un, pn) : pn;
	}

	/// One Gauss-Seidel visit of a point: (3) to (8). velocity: change of the pair's weighted velocities. Returns the squared change of the impulse.
	[[gnu::always_inline]] inline double solvePoint(SweepPoint& c, PairVector& velocity)
	{
		const SweepPoint::Quad u = c.velocity + velocity.dots(c.rows), unlimited = c.factor * c.impulse + c.bias - c.mass * u; // (2)
		const double pn = normalImpulse(c, u[0], unlimitedImpulse(c, u[0], unlimited[0]));
		SweepPoint::Quad p = unlimited - (pn - c.impulse[0]) * c.coupling; // (4)
		p[0] = pn;
		const double limit = c.friction * pn, square = p[1] * p[1] + p[2] * p[2];
		if (square > limit * limit) {
			const double share = limit / std::sqrt(square);
			p *= SweepPoint::Quad { 1, share, share, 0 };
		}
		const SweepPoint::Quad change = p - c.impulse, squares = change * change;
		for (int i = 0; i < 3; ++i)
			velocity.add(c.rows[i], change[i]);
		c.impulse = p;
		return squares[0] + squares[1] + squares[2];
	}

	template <class Number> [[maybe_unused]] bool isValid(const ContactInput<Number>& p)
	{
		return isFinite(p.armA) && isFinite(p.armB) && isUnit(p.normal) && isFinite(p.elasticNormal) && isNonNegative(p.elasticNormal)
		        && isFinite(p.elasticShear) && isFinite(p.impulse) && isNonNegative(p.normalDamping) && isNonNegative(p.shearDamping)
		        && isNonNegative(p.friction) && isNonNegative(p.normalStiffness) && isNonNegative(p.shearStiffness) && isNonNegative(p.release)
		        && isNonNegative(p.energy) && isNonNegative(p.hardening) && isNonNegative(p.overlap);
	}

} // namespace

void ContactSolver::begin(const std::vector<SolverBody>& bodies, int sweepLimit)
{
	assert(sweepLimit >= 0);
	allBodies = &bodies;
	maxSweeps = sweepLimit;
	pairs.clear();
	dashpots.clear();
	weighted.resize(bodies.size());
	++solveCount;
}

/// Starts a body of the island, once a step.
void ContactSolver::startBody(int k)
{
	assert(k >= 0 && size_t(k) < weighted.size());
	if (weighted[k].step == solveCount) return;
	weighted[k] = {};
	weighted[k].root = InverseRootMass((*allBodies)[k]);
	weighted[k].step = solveCount;
}

size_t ContactSolver::addPair(int bodyA, int bodyB, size_t count)
{
	assert(bodyA >= 0 && bodyB >= 0 && bodyA != bodyB);
	const size_t first = pairs.empty() ? 0 : pairs.back().first + groupsOf(pairs.back().count), end = first + groupsOf(count);
	pairs.push_back({ bodyA, bodyB, first, count, 0 });
	startBody(bodyA);
	startBody(bodyB);
	if (groups.size() < end) { // prepare() overwrites those of the last step, except unused lanes
		groups.resize(end);
		points.resize(end * laneCount);
	}
	return pairs.size() - 1;
}

size_t ContactSolver::addDashpot(int bodyA, int bodyB)
{
	assert(bodyA >= 0 && bodyB >= 0 && bodyA != bodyB);
	dashpots.emplace_back();
	dashpots.back().bodyA = bodyA;
	dashpots.back().bodyB = bodyB;
	startBody(bodyA);
	startBody(bodyB);
	return dashpots.size() - 1;
}

void ContactSolver::prepareDashpot(size_t k, const std::vector<SolverBody>& bodies, const JointModes& modes, const Mat3& axesA, double ratio, double h)
{
	assert(k < dashpots.size() && size_t(std::max(dashpots[k].bodyA, dashpots[k].bodyB)) < bodies.size());
	timber::prepareDashpot(dashpots[k], bodies[dashpots[k].bodyA], bodies[dashpots[k].bodyB], modes, axesA, ratio, h);
}

template <class Number> void ContactSolver::prepare(size_t k, size_t first, const std::vector<SolverBody>& bodies, const ContactInput<Number>& given, double h)
{
	assert(k < pairs.size() && first < pairs[k].count && size_t(std::max(pairs[k].bodyA, pairs[k].bodyB)) < bodies.size());
	assert((std::is_same_v<Number, double>) || first % laneCount == 0);
	assert(h > 0 && std::isfinite(h) && isValid(given));
	const SolverPair& pair = pairs[k];
	const SolverBody &a = bodies[pair.bodyA], &b = bodies[pair.bodyB];
	ContactInput<Number> input = given;
	if (maxSweeps == 0) {
		input.impulse = explicitImpulse<Number>(given, a, b, h);
		input.release = noRebound; // (5) is not applied
	}
	const PreparedPoint<Number> prepared(input, a, b, weighted[pair.bodyA].root, weighted[pair.bodyB].root, h);
	ConstraintGroup& group = groups[pair.first + first / laneCount];
	if constexpr (std::is_same_v<Number, Lanes>) group = prepared.constraint;
	else forMembers(group, prepared.constraint, [&](auto& all, const auto& one) { setLane(all, first % laneCount, one); });
	prepared.store(pointsOf(pair) + first, std::is_same_v<Number, Lanes> ? std::min(size_t(laneCount), pair.count - first) : 1);
}
template void ContactSolver::prepare(size_t, size_t, const std::vector<SolverBody>&, const ContactInput<double>&, double);
template void ContactSolver::prepare(size_t, size_t, const std::vector<SolverBody>&, const ContactInput<Lanes>&, double);

void ContactSolver::setImpact(size_t k, size_t point, double rebound)
{
	assert(maxSweeps > 0 && k < pairs.size() && point < pairs[k].count && rebound >= 0);
	setLane(groups[pairs[k].first + point / laneCount].rebound, point % laneCount, rebound);
	pointsOf(pairs[k])[point].rebound = rebound;
}

/// Fixed bodies are not written: they may belong to several islands, which other threads solve.
void ContactSolver::finishBodies(std::vector<SolverBody>& bodies)
{
	const auto finish = [&](int k) {
		WeightedBody& w = weighted[k];
		if (w.step != solveCount || bodies[k].inverseMass == 0) return;
		const BodyMotion motion = motionOf(bodies, k);
		const Vec3 velocity = motion.velocity(), spin = motion.spin();
		bodies[k].newVelocity = velocity;
		bodies[k].newSpin = spin;
		w.step = -1; // finished
	};
	for (const SolverPair& pair : pairs)
		finish(pair.bodyA), finish(pair.bodyB);
	for (const DashpotConstraint& joint : dashpots)
		finish(joint.bodyA), finish(joint.bodyB);
}

/// Total impulses in the world frame.
void ContactSolver::finishImpulses(const SolverPair& pair)
{
	for (size_t g = pair.first; g < pair.first + groupsOf(pair.count); ++g) {
		Lanes impulse[3];
		for (int c = 0; c < 3; ++c)
			for (size_t i = 0; i < laneCount; ++i)
				impulse[c].v[i] = points[g * laneCount + i].impulse[c];
		groups[g].impulse = worldImpulse(groups[g], impulse);
	}
}

/// Applies the impulses of a pair's points to its bodies.
void ContactSolver::warmStart(const SolverPair& pair)
{
	PairVector velocity = PairVector::of(weighted[pair.bodyA].change, weighted[pair.bodyB].change);
	for (size_t k = 0; k < pair.count; ++k)
		for (int i = 0; i < 3; ++i)
			velocity.add(pointsOf(pair)[k].rows[i], pointsOf(pair)[k].impulse[i]);
	velocity.store(weighted[pair.bodyA].change, weighted[pair.bodyB].change);
}

/// One Gauss-Seidel visit of each point of a pair.
void ContactSolver::solvePair(const std::vector<SolverBody>& bodies, SolverPair& pair, bool forwards)
{
	double *changeA = weighted[pair.bodyA].change, *changeB = weighted[pair.bodyB].change;
	PairVector velocity = PairVector::of(changeA, changeB);
	SweepPoint* all = pointsOf(pair);
	double squaredChange = 0;
	for (size_t k = 0; k < pair.count; ++k)
		squaredChange += solvePoint(all[forwards ? k : pair.count - 1 - k], velocity);
	pair.squaredChange = squaredChange * pairInverseMass(bodies[pair.bodyA], bodies[pair.bodyB]);
	velocity.store(changeA, changeB);
}

/// Convergence threshold of SolverPair::squaredChange per point, after the first sweep. [J]
double ContactSolver::squaredThreshold(const std::vector<SolverBody>& bodies, double tolerance) const
{
	double size = 0, changes = 0;
	size_t count = 0;
	for (const SolverPair& pair : pairs) {
		double squares = 0;
		for (const SweepPoint *c = &points[pair.first * laneCount], *end = c + pair.count; c < end; ++c)
			squares += c->impulse[0] * c->impulse[0] + c->impulse[1] * c->impulse[1] + c->impulse[2] * c->impulse[2];
		size += squares * pairInverseMass(bodies[pair.bodyA], bodies[pair.bodyB]);
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
bool ContactSolver::sweepOnce(const std::vector<SolverBody>& bodies, double threshold, bool forwards)
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
bool ContactSolver::sweepDashpots(const std::vector<SolverBody>& bodies, double threshold)
{
	bool changed = false;
	for (DashpotConstraint& joint : dashpots) {
		const double limit = threshold * joint.thresholdShare;
		solveDashpot(joint, motionOf(bodies, joint.bodyA), motionOf(bodies, joint.bodyB), limit * double(joint.count));
		changed = activateNeighbours(bodies, joint, limit) || changed;
	}
	return changed;
}

/// All sweeps of a step: the first one over all joints and pairs. Returns their number.
int ContactSolver::sweepToConvergence(const std::vector<SolverBody>& bodies, double tolerance)
{
	activeUntil.resize(bodies.size(), 0);
	++sweepCount;
	for (DashpotConstraint& joint : dashpots)
		solveDashpot(joint, motionOf(bodies, joint.bodyA), motionOf(bodies, joint.bodyB), 0);
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
	assert(allBodies == &bodies);
	for (const SolverPair& pair : pairs)
		warmStart(pair);
	int sweeps = 0;
	if (maxSweeps > 0) sweeps = sweepToConvergence(bodies, tolerance);
	else
		for (DashpotConstraint& joint : dashpots)
			applyExplicitDashpot(joint, motionOf(bodies, joint.bodyA), motionOf(bodies, joint.bodyB));
	for (const SolverPair& pair : pairs)
		finishImpulses(pair);
	finishBodies(bodies);
	return sweeps;
}

} // namespace timber

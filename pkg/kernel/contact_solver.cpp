// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_solver.hpp"
#include "constants.hpp"
#include "contact_visit.hpp"
#include "preconditions.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <type_traits>

namespace timber {
namespace {

	template <class Number> [[maybe_unused]] bool isValid(const StepInput<Number>& p)
	{
		return isFinite(p.armA) && isFinite(p.armB) && isUnit(p.normal) && isFinite(p.elasticNormal)
		        && isNonNegative(p.elasticNormal) && isFinite(p.elasticShear) && isFinite(p.impulse)
		        && isNonNegative(p.normalDamping) && isNonNegative(p.shearDamping) && isNonNegative(p.friction)
		        && isNonNegative(p.normalStiffness) && isNonNegative(p.shearStiffness)
		        && isNonNegative(p.energy) && isNonNegative(p.shearEnergy) && isNonNegative(p.hardening)
		        && isNonNegative(p.overlap) && isNonNegative(p.overlapLeft) && p.exponent >= 1;
	}

} // namespace

void ContactSolver::begin(std::vector<SolverBody>& sceneBodies, double step, int sweepLimit)
{
	assert(sweepLimit >= 0 && step > 0 && std::isfinite(step));
	bodies = &sceneBodies;
	h = step;
	maxSweeps = sweepLimit;
	pairs.clear();
	pointCount = 0;
	joints<6>().clear();
	joints<1>().clear();
	weighted.resize(sceneBodies.size());
	freeBodies.clear();
	++solveCount;
	twiceKinetic = 0;
}

/// Starts a body of the island.
void ContactSolver::startBody(int k)
{
	const SolverBody& body = (*bodies)[k];
	weighted[k] = {};
	weighted[k].root = InverseRootMass(body);
	weighted[k].step = solveCount;
	if (body.inverseMass == 0) return;
	freeBodies.push_back(k);
	twiceKinetic += body.newVelocity.squaredNorm() / body.inverseMass
	        + weighted[k].root.weightedSpin(body.newSpin).squaredNorm();
}

size_t ContactSolver::addPair(int bodyA, int bodyB, size_t count)
{
	assert(bodyA >= 0 && bodyB >= 0 && bodyA != bodyB);
	pairs.push_back({ bodyA, bodyB, pointCount, count, pairInverseMass((*bodies)[bodyA], (*bodies)[bodyB]), 0 });
	pointCount += count;
	if (pointCount > steps.size()) steps.resize(pointCount);
	useBody(bodyA);
	useBody(bodyB);
	return pairs.size() - 1;
}

template <int n> size_t ContactSolver::addJoint(int bodyA, int bodyB)
{
	assert(bodyA >= 0 && bodyB >= 0 && bodyA != bodyB);
	ModalConstraint<n>& joint = joints<n>().add();
	joint.bodyA = bodyA;
	joint.bodyB = bodyB;
	useBody(bodyA);
	useBody(bodyB);
	return joints<n>().size() - 1;
}
template size_t ContactSolver::addJoint<1>(int, int);
template size_t ContactSolver::addJoint<6>(int, int);

template <class Number> void ContactSolver::prepare(size_t k, size_t first, const StepInput<Number>& data)
{
	assert(k < pairs.size() && first < pairs[k].count && isValid(data));
	const SolverPair& pair = pairs[k];
	const SolverBodies both = bodiesOf(pair);
	const size_t count = std::is_same_v<Number, Lanes> ? std::min(size_t(laneCount), pair.count - first) : 1;
	const auto at = [&](size_t i) -> PointStep& { return stepsOf(pair)[first + i]; };
	if (!isExplicit()) return prepareSteps<Number>(data, both, h, count, at);
	StepInput<Number> input = data;
	input.impulse = explicitImpulse<Number>(data, both, h);
	prepareSteps<Number>(input, both, h, count, at);
}
template void ContactSolver::prepare(size_t, size_t, const StepInput<double>&);
template void ContactSolver::prepare(size_t, size_t, const StepInput<Lanes>&);

/// Fixed bodies are not written: they may belong to several islands, which other threads solve.
void ContactSolver::finishBodies()
{
	for (const int k : freeBodies) {
		const double* w = weighted[k].change;
		(*bodies)[k].newVelocity += weighted[k].root.linear * Vec3(w[0], w[1], w[2]);
		(*bodies)[k].newSpin += weighted[k].root.spinOf(w + 3);
	}
}

/// Applies the impulses of a pair's points to its bodies.
void ContactSolver::warmStart(const SolverPair& pair)
{
	PairVector velocity = changeOf(pair);
	const PointStep* points = stepsOf(pair);
	for (size_t k = 0; k < pair.count; ++k)
		for (int i = 0; i < 3; ++i)
			velocity.add(points[k].rows[i], points[k].impulse[i]);
	setChange(pair, velocity);
}

/// One Gauss-Seidel visit of each point of a pair.
void ContactSolver::solvePair(SolverPair& pair, bool forwards)
{
	PairVector velocity = changeOf(pair);
	PointStep* points = stepsOf(pair);
	double squaredChange = 0;
	for (size_t k = 0; k < pair.count; ++k) {
		PointStep& step = points[forwards ? k : pair.count - 1 - k];
		if (!step.idle) squaredChange += visitPoint(step, velocity);
	}
	pair.squaredChange = squaredChange * pair.inverseMass;
	setChange(pair, velocity);
}

/// One Gauss-Seidel visit of a joint.
template <int n> void ContactSolver::solveJoint(ModalConstraint<n>& joint, double share)
{
	PairVector velocity = changeOf(joint);
	solveModes(joint, velocity, share);
	setChange(joint, velocity);
}

/// Squared changes of all pairs and joints in their last visits. [J]
double ContactSolver::sumOfChanges() const
{
	double sum = 0;
	for (const SolverPair& pair : pairs)
		sum += pair.squaredChange;
	visitJoints([&](const auto& joint) { sum += joint.squaredChange; });
	return sum;
}

/// Convergence threshold of SolverPair::squaredChange per point for the present impulses. firstChanges: sumOfChanges()
/// of the first sweep. [J]
double ContactSolver::squaredThreshold(double tolerance, double firstChanges) const
{
	double size = 0, resultants = 0;
	size_t count = 0;
	for (const SolverPair& pair : pairs) {
		double squares = 0;
		for (size_t k = 0; k < pair.count; ++k) {
			const PointStep& c = stepsOf(pair)[k];
			squares += c.impulse[0] * c.impulse[0] + c.impulse[1] * c.impulse[1]
			        + c.impulse[2] * c.impulse[2];
		}
		size += squares * pair.inverseMass;
		count += pair.count;
	}
	visitJoints([&](const auto& joint) {
		size += joint.impulse.squaredNorm();
		count += joint.count;
	});
	for (const int k : freeBodies)
		for (const double w : weighted[k].change)
			resultants += w * w;
	const double rest = std::min(tolerance, restTolerance), rounding = std::min(tolerance, roundingTolerance);
	const double reduced
	        = std::min(tolerance * tolerance * resultants, sweepReduction * sweepReduction * firstChanges),
	        least = std::max(rest * rest * size, rounding * rounding * twiceKinetic);
	return std::max(reduced, least) / std::max(1., double(count));
}

/// If a pair has changed by more than the threshold, all pairs of its free bodies are visited in the rest of this sweep
/// and in the next one.
template <class Connection> bool ContactSolver::activateNeighbours(const Connection& c, double threshold)
{
	if (c.squaredChange <= threshold * double(c.count)) return false;
	for (const int body : { c.bodyA, c.bodyB })
		if (weighted[body].root.linear > 0) activeUntil[body] = sweepCount + 1;
	return true;
}

/// Activates the neighbours of all pairs that changed by more than the threshold in their last visits. Returns whether
/// there is one.
bool ContactSolver::activateChanged(double threshold)
{
	bool changed = false;
	for (const SolverPair& pair : pairs)
		changed = activateNeighbours(pair, threshold) || changed;
	return changed;
}

/// A sweep over the active pairs, and over all joints once no pair changes: the impulses of dashpots vary little with
/// those of contacts.
/// share: of the changes of stiff joints [-]. Returns whether another sweep is needed.
bool ContactSolver::sweepOnce(double threshold, bool forwards, double share)
{
	bool changed = false;
	++sweepCount;
	for (SolverPair& pair : pairs) {
		if (activeUntil[pair.bodyA] < sweepCount && activeUntil[pair.bodyB] < sweepCount) continue;
		solvePair(pair, forwards);
		changed = activateNeighbours(pair, threshold) || changed;
	}
	return changed || sweepJoints(threshold, share);
}

/// Returns whether another sweep over the pairs is needed. Changes below the threshold are applied as well: they may be
/// large for a weak dashpot, which must not return energy. share: of the changes of stiff joints [-]
bool ContactSolver::sweepJoints(double threshold, double share)
{
	bool changed = false;
	visitJoints([&](auto& joint) {
		solveJoint(joint, share);
		changed = activateNeighbours(joint, threshold * joint.thresholdShare) || changed;
	});
	return changed;
}

/// Of the pairs and joints in their last visits. [J]
double ContactSolver::largestChange() const
{
	double largest = 0;
	const auto add = [&](const auto& c) { largest = std::max(largest, c.squaredChange); };
	std::for_each(pairs.begin(), pairs.end(), add);
	visitJoints(add);
	return largest;
}

/// Velocity of separation w of an impact whose single point leaves its overlap within the step, or has no force any
/// more.
void ContactSolver::applyRestitution(const SolverPair& pair)
{
	PointStep* alone = nullptr;
	for (size_t k = 0; k < pair.count; ++k) {
		PointStep& c = stepsOf(pair)[k];
		if (c.impulse[0] == 0 && c.rebound == noRebound) continue;
		if (alone) return;
		alone = &c;
	}
	if (!alone || alone->rebound == noRebound) return;
	PairVector velocity = changeOf(pair);
	const double p = alone->impulse[0], un = alone->velocity[0] + velocity.dots(alone->rows)[0],
	             a = alone->response();
	const bool separates = un > 0 && (p == 0 || un * h > alone->overlap);
	if (!separates || un >= alone->rebound) return;
	const double more
	        = std::min({ p + (alone->rebound - un) / a, energyImpulse(*alone, un - a * p), alone->strength }) - p;
	if (more <= 0) return;
	alone->impulse[0] += more;
	velocity.add(alone->rows[0], more);
	setChange(pair, velocity);
}

/// Whether points have returned more energy beyond their accounts (5) than a share of the kinetic energy and the
/// accounts.
bool ContactSolver::returnsTooMuch() const
{
	double excess = 0, energy = twiceKinetic / 2;
	for (const SolverPair& pair : pairs) {
		const PairVector velocity = changeOf(pair);
		for (size_t k = 0; k < pair.count; ++k) {
			const PointStep& c = stepsOf(pair)[k];
			const PointStep::Quad work = c.impulse * (c.before + c.velocity + velocity.dots(c.rows)) / 2;
			excess += std::max(0., work[0] - c.energy) + std::max(0., work[1] + work[2] - c.shearEnergy);
			energy += c.energy + c.shearEnergy;
		}
	}
	return excess > returnTolerance * energy;
}

template <class Visit> void ContactSolver::visitUnknowns(Visit visit)
{
	for (const SolverPair& pair : pairs)
		for (size_t k = 0; k < pair.count; ++k)
			for (int i = 0; i < 3; ++i) {
				PointStep& c = stepsOf(pair)[k];
				double p = c.impulse[i];
				visit(p, pair.inverseMass);
				c.impulse[i] = p;
			}
	visitJoints([&](auto& joint) {
		for (double& q : joint.impulse)
			visit(q, 1.);
	});
	for (const int k : freeBodies)
		for (double& w : weighted[k].change)
			visit(w, 0.); // follows from the impulses
}

/// (9)
struct ContactSolver::ConjugateDirection {
	std::vector<double> before, direction; ///< x, d
	double square = 0; ///< |x' - x|^2 of the last sweep
};

void ContactSolver::stepAlong(ConjugateDirection& d)
{
	double square = 0;
	size_t n = 0;
	visitUnknowns([&](double& x, double weight) {
		const double change = x - d.before[n++];
		square += weight * change * change;
	});
	const double gamma = square < d.square ? square / d.square : 0;
	n = 0;
	visitUnknowns([&](double& x, double) {
		const double change = x - d.before[n];
		x += gamma * d.direction[n];
		d.direction[n] = gamma * d.direction[n] + change;
		d.before[n++] = x;
	});
	d.square = square;
}

/// A sweep over all joints and pairs. Returns whether one has changed.
bool ContactSolver::sweepAll(double threshold)
{
	++sweepCount;
	bool changed = sweepJoints(threshold);
	for (SolverPair& pair : pairs) {
		solvePair(pair, true);
		changed = changed || pair.squaredChange > threshold * double(pair.count);
	}
	return changed;
}

/// solveByNewton() for small islands. If it fails, all impulses and velocities are as before.
bool ContactSolver::tryNewton()
{
	if (freeBodies.size() > size_t(newtonBodies)) return false;
	std::vector<double> before;
	visitUnknowns([&](double& x, double) { before.push_back(x); });
	if (solveByNewton()) return true;
	size_t n = 0;
	visitUnknowns([&](double& x, double) { x = before[n++]; });
	return false;
}

/// Whether they have converged within the limit of all sweeps.
bool ContactSolver::sweepAccelerated(double threshold, int& sweeps)
{
	ConjugateDirection direction;
	visitUnknowns([&](double& x, double) { direction.before.push_back(x); });
	direction.direction.resize(direction.before.size(), 0);
	for (int k = 0;; ++k) {
		if (k > 0 && k % newtonInterval == 0 && tryNewton()) return true;
		++sweeps;
		if (!sweepAll(threshold) && !returnsTooMuch()) return true;
		if (sweeps >= maxSweeps) return false;
		stepAlong(direction);
	}
}

/// All sweeps of a step: the first one over all joints and pairs.
Convergence ContactSolver::sweepToConvergence(double tolerance)
{
	activeUntil.resize(bodies->size(), 0);
	++sweepCount;
	visitJoints([&](auto& joint) { solveJoint(joint, 1); });
	for (SolverPair& pair : pairs)
		solvePair(pair, true);
	const double firstChanges = sumOfChanges();
	double threshold = squaredThreshold(tolerance, firstChanges);
	bool changed = activateChanged(firstSweepShare * firstSweepShare * threshold);
	changed = changed || sweepJoints(threshold);
	Convergence result { 1, true, 0 };
	while (changed && result.sweeps < std::min(maxSweeps, plainSweeps)) {
		const double share = result.sweeps < relaxedSweeps ? 1 : 0.5;
		changed = sweepOnce(threshold, result.sweeps % 2 == 0, share);
		if (changed && result.sweeps % jointInterval == 0) sweepJoints(threshold, share);
		++result.sweeps;
		if (changed) continue;
		// The impulses of the warm start may have been much larger
		const double next = squaredThreshold(tolerance, firstChanges);
		if (next < thresholdDrop * threshold) {
			threshold = next;
			changed = activateChanged(threshold) || sweepJoints(threshold);
		}
	}
	result.converged = !changed && (result.sweeps < checkedSweeps || !returnsTooMuch());
	if (!result.converged && result.sweeps < maxSweeps)
		result.converged = sweepAccelerated(threshold, result.sweeps);
	if (!result.converged) result.change = largestChange();
	return result;
}

Convergence ContactSolver::solve(double tolerance)
{
	assert(tolerance >= 0);
	for (const SolverPair& pair : pairs)
		warmStart(pair);
	visitJoints([&](auto& joint) {
		PairVector velocity = changeOf(joint);
		isExplicit() ? applyExplicitModes(joint, velocity) : timber::warmStart(joint, velocity);
		setChange(joint, velocity);
	});
	Convergence result;
	if (!isExplicit()) {
		result = sweepToConvergence(tolerance);
		for (const SolverPair& pair : pairs)
			applyRestitution(pair);
	}
	visitJoints([&](auto& joint) { finishModes(joint, changeOf(joint)); });
	finishBodies();
	return result;
}

} // namespace timber

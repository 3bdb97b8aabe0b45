// SPDX-License-Identifier: GPL-2.0-or-later
#include "spring_step.hpp"
#include "preconditions.hpp"
#include "solver_body.hpp"
#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>

namespace timber {
namespace {

	/// F by (2) of a spring whose state at z1 is `end`. way: z1 - z0 [m].
	Vec3 meanForce(const SpringState& start, const SpringState& end, const Vec3& way)
	{
		const Vec3 mean = (start.force + end.force) / 2;
		const double square = way.squaredNorm();
		if (square == 0) return mean;
		const double missing = end.energy - start.energy + end.dissipated - mean.dot(way),
		             largest = (end.force - start.force).norm() / 2 * std::sqrt(square);
		// On a short way the rounding of the energies would be a force
		if (std::abs(missing) <= springTolerance * (start.energy + end.energy + end.dissipated)) return mean;
		return mean + std::max(-largest, std::min(missing, largest)) / square * way;
	}

	/// Tangent of F by z1: half of that of f1, with the exact slope along the way, at least `least`.
	Mat3 meanTangent(const SpringTrial& end, const Vec3& force, const Vec3& way, double least)
	{
		Mat3 tangent = end.tangent / 2;
		const double square = way.squaredNorm();
		if (square == 0) return tangent;
		const Vec3 along = way / std::sqrt(square), turned = tangent * along;
		const double half = along.dot(turned), slope = std::max(least, (end.force - force).dot(way) / square);
		if (slope >= half || slope < 0) tangent += (slope - half) * along * along.transpose();
		else tangent -= (1 - slope / half) / half * turned * turned.transpose();
		return tangent;
	}

	/// M^-1 r with M = 1 + x + h2/2 G^T T G of a single spring with the tangent T: Woodbury's formula, matrices 3 x 3.
	Vec6 singleSpringStep(const SpringStep<6>& spring, const Mat3& tangent, const ModalStep<6>& step, const Vec6& r)
	{
		const Vec6 inverse = (1 + step.decay.array()).inverse();
		const Mat36 weighted = spring.rates * inverse.asDiagonal();
		const Mat3 T = step.h * step.h / 2 * tangent,
		           matrix = Mat3::Identity() + T * (weighted * spring.rates.transpose());
		return inverse.cwiseProduct(r) - weighted.transpose() * (matrix.inverse() * (T * (weighted * r)));
	}

} // namespace

template <int n>
SpringSteps<n>::SpringSteps(SpringLaw& l, std::vector<SpringStep<n>> steps, double stored, double h)
        : law(&l)
        , states(steps.size())
        , shared(steps.size(), Vec3::Zero())
        , forces(steps.size())
        , springs(std::move(steps))
        , account(stored)
{
	assert(h > 0);
	double rates = 0;
	for (SpringStep<n>& s : springs) {
		assert(isFinite(s.from) && isFinite(s.placed) && isFinite(s.applied) && isFinite(s.rates));
		s.start = law->trial(s.spring, s.from, keepsForce);
		applied -= h * s.rates.transpose() * s.applied;
		rates += s.rates.squaredNorm();
	}
	keepsForce = h * h * law->steepestFall() * rates >= 1;
}

template <int n> double SpringSteps<n>::tangent() const
{
	double sum = 0;
	for (const SpringStep<n>& s : springs)
		sum += law->trial(s.spring, s.placed, keepsForce).share;
	return sum / double(springs.size());
}

template <int n> double SpringSteps<n>::startEnergy() const
{
	double energy = 0;
	for (const SpringStep<n>& s : springs)
		energy += s.start.energy;
	return energy;
}

template <int n> typename SpringSteps<n>::Leaving SpringSteps<n>::leave(double h, const Vec& after) const
{
	double atHalfStep = 0, work = 0; // of explicit springs; since the placement
	for (const SpringStep<n>& s : springs) {
		const Vec3 half = h / 2 * (s.rates * after);
		const SpringState next = law->trial(s.spring, s.stretch + half, keepsForce);
		atHalfStep += next.energy + next.dissipated - next.force.dot(half);
		work += s.force.dot(half);
	}
	return { std::min(account, atHalfStep) - work, std::max(0., account - atHalfStep) };
}

template <int n> Modal<n> SpringSteps<n>::warmStart(double h) const
{
	Vec impulse = -applied;
	for (const SpringStep<n>& s : springs)
		impulse -= h * s.rates.transpose() * s.force;
	return impulse;
}

/// Stretches (1) and forces (2) for the modal velocities after the step. Returns kappa of SpringLaw::limit().
template <int n> double SpringSteps<n>::tryStretches(double h, const Vec& after)
{
	for (size_t i = 0; i < springs.size(); ++i) {
		SpringStep<n>& s = springs[i];
		s.stretch = s.placed + h / 2 * (s.rates * after);
		states[i] = law->trial(s.spring, s.stretch, keepsForce);
	}
	const double kappa = law->limit(states, shared);
	for (size_t i = 0; i < springs.size(); ++i)
		springs[i].force = meanForce(springs[i].start, states[i], springs[i].stretch - springs[i].from);
	return kappa;
}

/// r of (3).
template <int n> Modal<n> SpringSteps<n>::residual(const Step& step, const Vec& free, const Vec& after) const
{
	Vec r = after - free + step.decay.cwiseProduct(step.before + after) + applied;
	for (const SpringStep<n>& s : springs)
		r += step.h * s.rates.transpose() * s.force;
	return r;
}

/// Tangent of the force (2) of a spring by z1. kappa: of SpringLaw::limit()
template <int n> Mat3 SpringSteps<n>::tangentOf(size_t i, double kappa) const
{
	// With a shared strength the slope along one spring's way depends on the other springs
	if (kappa > 0) return states[i].tangent / 2;
	const SpringStep<n>& s = springs[i];
	return meanTangent(states[i], s.force, s.stretch - s.from, keepsForce ? 0 : -law->steepestFall());
}

/// Of r by eta'.
template <int n> ModalMatrix<n> SpringSteps<n>::slope(const Step& step, double kappa) const
{
	Mat matrix = Mat::Zero();
	Vec together = Vec::Zero();
	for (size_t i = 0; i < springs.size(); ++i) {
		const SpringStep<n>& s = springs[i];
		matrix += s.rates.transpose() * tangentOf(i, kappa) * s.rates;
		if (kappa > 0) together += s.rates.transpose() * shared[i];
	}
	matrix = step.h * step.h / 2 * (matrix - kappa / 2 * together * together.transpose());
	matrix.diagonal().array() += 1 + step.decay.array();
	return matrix;
}

/// tryStretches() of linear springs, whose force (2) is the mean of both ends. Returns whether none reaches the
/// strength.
template <int n> bool SpringSteps<n>::tryLinear(double h, const Vec& after)
{
	for (size_t i = 0; i < springs.size(); ++i)
		forces[i] = springs[i].stretch = springs[i].placed + h / 2 * (springs[i].rates * after);
	if (!law->linearForces(forces)) return false;
	for (size_t i = 0; i < springs.size(); ++i)
		springs[i].force = (springs[i].start.force + forces[i]) / 2;
	return true;
}

/// M^-1 r with the slope M of (3) at `after`.
template <int n>
Modal<n> SpringSteps<n>::newtonStep(const Step& step, const Vec& free, const Vec& after, const NewtonPoint& point)
{
	if constexpr (n == 1) return point.residual / slope(step, point.kappa)(0, 0);
	else {
		if (springs.size() == 1 && !law->isLinear())
			return singleSpringStep(springs[0], tangentOf(0, point.kappa), step, point.residual);
		const Eigen::LDLT<Mat> factors(slope(step, point.kappa));
		// A spring beyond its strength at z0, whose strength was lowered, has a force that is no mean
		isAffine = law->isLinear() && std::none_of(springs.begin(), springs.end(), [](const SpringStep<n>& s) {
			return s.start.breaks;
		}) && tryLinear(step.h, after);
		if (isAffine) {
			inverseSlope = factors.solve(Mat::Identity());
			base = after - inverseSlope * (point.residual + free);
		}
		return factors.solve(point.residual);
	}
}

/// A Newton step from `after`, shortened until r falls. Returns whether it does.
template <int n> bool SpringSteps<n>::improve(const Step& step, const Vec& free, Vec& after, NewtonPoint& point)
{
	const Vec change = newtonStep(step, free, after, point), last = after;
	for (double share = 1; share > springLeastShare; share /= 2) {
		after = last - share * change;
		const double kappa = tryStretches(step.h, after);
		const Vec r = residual(step, free, after);
		if (r.squaredNorm() < point.residual.squaredNorm()) {
			point = { r, kappa };
			return true;
		}
		if (change.squaredNorm() <= springTolerance * after.squaredNorm()) break; // rounding
	}
	after = last;
	tryStretches(step.h, after);
	return false;
}

template <int n> Modal<n> SpringSteps<n>::impulse(const Step& step, const Vec& free, Vec after)
{
	if (isAffine) {
		const Vec root = base + inverseSlope * free;
		if (tryLinear(step.h, root)) return withinAccount(step, free, root - free);
	}
	const double kappa = tryStretches(step.h, after),
	             size = (free - applied).squaredNorm() + free.squaredNorm() + step.before.squaredNorm();
	NewtonPoint point { residual(step, free, after), kappa };
	for (int k = 0; k < springIterations; ++k) {
		if (point.residual.squaredNorm() <= springTolerance * springTolerance * size) break;
		if (!improve(step, free, after, point)) break;
	}
	// The law's impulse also where the method has not converged: within the strength
	return withinAccount(step, free, after - free - point.residual);
}

template <int n> Modal<n> SpringSteps<n>::impulseAt(const Step& step, const Vec& after, Mat& derivative)
{
	const double kappa = tryStretches(step.h, after);
	derivative = slope(step, kappa) - Mat::Identity();
	return -residual(step, after, after);
}

template <int n> bool SpringSteps<n>::keepsAccount(const Step& step, const Vec& impulse, const Vec& after) const
{
	return withinAccount(step, after - impulse, impulse) == impulse;
}

/// Impulse whose springs return at most the account: (4).
template <int n> Modal<n> SpringSteps<n>::withinAccount(const Step& step, const Vec& free, const Vec& impulse) const
{
	const Vec sum = step.before + free + impulse, dashpots = -step.decay.cwiseProduct(sum),
	          spring = impulse - dashpots + applied;
	// Rounding of both sides is no excess: linear springs return all that they have stored
	const double available = std::max(0., account), rounding = springTolerance * spring.norm() * sum.norm();
	if (spring.dot(sum) <= 2 * available + rounding) return impulse;
	// With the share s of `spring` the velocity after the step is (base + s spring) / (1 + x)
	const Vec weight = (1 + step.decay.array()).inverse(),
	          base = free - applied - step.decay.cwiseProduct(step.before);
	const double linear = spring.dot(step.before + weight.cwiseProduct(base)),
	             square = spring.dot(weight.cwiseProduct(spring));
	if (linear + square <= 2 * available) return impulse;
	const Vec after = weight.cwiseProduct(base + largestShare(linear, square, available) * spring);
	return after - free;
}

template <int n> void SpringSteps<n>::finish(const Step& step, const Vec& impulse, const Vec& after)
{
	const Vec sum = step.before + after;
	account -= (impulse + step.decay.cwiseProduct(sum) + applied).dot(sum) / 2;
	for (size_t i = 0; i < springs.size(); ++i)
		forces[i] = springs[i].force;
	tryStretches(step.h, after);
	double energy = 0;
	for (size_t i = 0; i < springs.size(); ++i) {
		SpringStep<n>& s = springs[i];
		s.end = states[i].breaks ? states[i] : law->commit(s.spring, s.stretch);
		s.force = forces[i];
		s.breaks = s.end.breaks;
		if (!s.breaks) energy += s.end.energy;
	}
	dissipated += std::max(0., account - energy);
	account = std::min(account, energy);
}

template class SpringSteps<1>;
template class SpringSteps<6>;

} // namespace timber

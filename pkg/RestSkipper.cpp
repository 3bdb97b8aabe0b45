// SPDX-License-Identifier: GPL-2.0-or-later
#include <GroundMotion.hpp>
#include <RestSkipper.hpp>
#include <bodies.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((RestSkipper));

void RestSkipper::validate() const
{
	require(stride >= 1, "RestSkipper.stride", stride, ">= 1");
	requirePositive("RestSkipper.restTime", restTime);
	requireNonNegative("RestSkipper.speed", speed);
	requireNonNegative("RestSkipper.displacement", displacement);
	requireNonNegative("RestSkipper.growth", growth);
	requireNonNegative("RestSkipper.groundThreshold", groundThreshold);
}

namespace {
	/// In place of the position of a body that was erased.
	const Vector3r noPosition = Vector3r::Constant(std::numeric_limits<Real>::max());
}

vector<Vector3r> RestSkipper::positions() const
{
	vector<Vector3r> centres(scene->bodies->size(), noPosition);
	for (const shared_ptr<Body>& b : *scene->bodies)
		if (b) centres[b->getId()] = b->state->pos;
	return centres;
}

Real RestSkipper::largestSpeed() const
{
	Real largest = 0;
	for (const shared_ptr<Body>& b : *scene->bodies)
		if (b) largest = math::max(largest, b->state->vel.norm() + b->state->angVel.norm());
	return largest;
}

Real RestSkipper::largestDisplacement(const vector<Vector3r>& from) const
{
	Real largest = 0;
	for (size_t id = 0; id < from.size(); ++id) {
		const Body* b = bodyAt(*scene, Body::id_t(id));
		if (bool(b) == (from[id] == noPosition)) return std::numeric_limits<Real>::infinity();
		if (b) largest = math::max(largest, (b->state->pos - from[id]).norm());
	}
	return largest;
}

void RestSkipper::restart()
{
	startPositions = positions();
	observedStrides = 0;
	middlePositions.clear();
}

long RestSkipper::stridesPerHalf() const { return math::max(1L, std::lround(restTime / (2 * stride * scene->dt))); }

/// Displacements are compared, not speeds: residuals of the contact solver make light members vibrate on the spot.
void RestSkipper::observe()
{
	if (startPositions.size() != scene->bodies->size() || largestSpeed() > speed
	        || largestDisplacement(startPositions) > displacement)
		return restart();
	const long half = stridesPerHalf();
	++observedStrides;
	const bool halfway = middlePositions.empty() && observedStrides >= half;
	const bool grows = !middlePositions.empty() && observedStrides >= 2 * half
	        && largestDisplacement(middlePositions) > growth * firstHalfDisplacement;
	if (!halfway && !grows) return;
	if (grows) startPositions = middlePositions; // the second half becomes the first one of a new observation
	middlePositions = positions();
	firstHalfDisplacement = largestDisplacement(startPositions);
	observedStrides = half;
}

bool RestSkipper::isResting() const { return !middlePositions.empty() && observedStrides >= 2 * stridesPerHalf(); }

bool RestSkipper::isGroundAtRest() const
{
	const auto* motion = findEngine<GroundMotionEngine>(*scene);
	return !motion || motion->peakBetween(scene->time, scene->time + (stride + 1) * scene->dt) <= groundThreshold;
}

/// YADE ends O.run(n) and O.stopAtTime at exactly that step or never: neither they nor the step `last` may be skipped.
bool RestSkipper::isEndBeyondStride() const
{
	const long next = scene->iter + stride;
	const auto isBefore = [next](long end) { return end <= 0 || next < end; };
	return isBefore(last) && isBefore(scene->stopAtIter)
	        && (scene->stopAtTime <= 0 || scene->time + stride * scene->dt < scene->stopAtTime);
}

void RestSkipper::action()
{
	if (scene->iter % stride != 0) return;
	observe();
	if (!isResting() || !isGroundAtRest() || !isEndBeyondStride()) return;
	scene->iter += stride - 1; // YADE adds the computed step
	scene->time += (stride - 1) * scene->dt;
	skipped += (stride - 1) * scene->dt;
}

} // namespace yade

// SPDX-License-Identifier: GPL-2.0-or-later
#include <GroundMotionEngine.hpp>
#include <bodies.hpp>
#include <RestSkipper.hpp>

namespace yade {

YADE_PLUGIN((RestSkipper));

Real RestSkipper::fastest() const
{
	Real most = 0;
	for (const shared_ptr<Body>& b : *scene->bodies)
		if (b && isFree(*b->state)) most = math::max(most, b->state->vel.norm() + b->state->angVel.norm());
	return most;
}

Real RestSkipper::farthest() const
{
	Real most = 0;
	for (const shared_ptr<Body>& b : *scene->bodies)
		if (b) most = math::max(most, (b->state->pos - places[b->getId()]).norm());
	return most;
}

void RestSkipper::watchAnew()
{
	speeds.clear();
	places.assign(scene->bodies->size(), Vector3r::Zero());
	for (const shared_ptr<Body>& b : *scene->bodies)
		if (b) places[b->getId()] = b->state->pos;
}

bool RestSkipper::resting() const
{
	const auto half  = speeds.begin() + speeds.size() / 2;
	const Real early = *std::max_element(speeds.begin(), half), late = *std::max_element(half, speeds.end());
	return math::max(early, late) < speed && late <= growth * early;
}

bool RestSkipper::groundIsQuiet() const
{
	for (const shared_ptr<Engine>& e : scene->engines) {
		const auto motion = dynamic_cast<GroundMotionEngine*>(e.get());
		if (!motion) continue;
		const Real until = scene->time + (grain + 1) * scene->dt;
		for (Real t = scene->time; t < until + motion->step; t += math::min(motion->step, scene->dt * grain)) // linear between samples
			if (motion->at(t).norm() > quiet) return false;
	}
	return true;
}

/// Neither the step `last` nor where YADE's O.run(n) or O.stopAtTime ends is skipped over: YADE stops at just that step, or never.
bool RestSkipper::mayGoOn() const
{
	const long next = scene->iter + grain;
	const auto isBefore = [next](long end) { return end <= 0 || next < end; };
	return isBefore(last) && isBefore(scene->stopAtIter) && (scene->stopAtTime <= 0 || scene->time + grain * scene->dt < scene->stopAtTime);
}

void RestSkipper::action()
{
	if (scene->iter % grain != 0) return;
	if (places.size() != scene->bodies->size() || farthest() > way) watchAnew();
	const size_t count = math::max(Real(2), math::round(hold / (grain * scene->dt)));
	speeds.push_back(fastest());
	if (speeds.size() > count) speeds.erase(speeds.begin(), speeds.end() - count);
	if (speeds.size() < count || !resting() || !groundIsQuiet() || !mayGoOn()) return;
	scene->iter += grain - 1; // the step that ends now makes it a whole grain
	scene->time += (grain - 1) * scene->dt;
	skipped += (grain - 1) * scene->dt;
}

} // namespace yade

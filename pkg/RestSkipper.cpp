// SPDX-License-Identifier: GPL-2.0-or-later
#include <GroundMotion.hpp>
#include <bodies.hpp>
#include <RestSkipper.hpp>

namespace yade {

YADE_PLUGIN((RestSkipper));

void RestSkipper::postLoad(RestSkipper&)
{
	if (grain < 1) throw std::invalid_argument("RestSkipper.grain = " + std::to_string(grain) + ": it must be > 0");
}

vector<Vector3r> RestSkipper::places() const
{
	vector<Vector3r> all(scene->bodies->size(), Vector3r::Zero());
	for (const shared_ptr<Body>& b : *scene->bodies)
		if (b) all[b->getId()] = b->state->pos;
	return all;
}

Real RestSkipper::fastest() const
{
	Real most = 0;
	for (const shared_ptr<Body>& b : *scene->bodies)
		if (b && isFree(*b->state)) most = math::max(most, b->state->vel.norm() + b->state->angVel.norm());
	return most;
}

Real RestSkipper::farthest(const vector<Vector3r>& from) const
{
	Real most = 0;
	for (const shared_ptr<Body>& b : *scene->bodies)
		if (b) most = math::max(most, (b->state->pos - from[b->getId()]).norm());
	return most;
}

void RestSkipper::watchAnew()
{
	start   = places();
	watched = 0;
	middle.clear();
}

long RestSkipper::grainsOfHalf() const { return math::max(1L, std::lround(hold / (2 * grain * scene->dt))); }

/// Ways are compared, not speeds: light members tremble by what the sweeps over the dashpots leave over, and go nowhere.
void RestSkipper::watch()
{
	if (start.size() != scene->bodies->size() || fastest() > speed || farthest(start) > way) return watchAnew();
	const long half = grainsOfHalf();
	++watched;
	const bool halfway = middle.empty() && watched >= half;
	const bool grows   = !middle.empty() && watched >= 2 * half && farthest(middle) > growth * early; // its second half may be the first of a rest
	if (!halfway && !grows) return;
	if (grows) start = middle;
	middle  = places();
	early   = farthest(start);
	watched = half;
}

bool RestSkipper::resting() const { return !middle.empty() && watched >= 2 * grainsOfHalf(); }

bool RestSkipper::groundIsQuiet() const
{
	const auto* motion = findEngine<GroundMotionEngine>(*scene);
	return !motion || motion->strongest(scene->time, scene->time + (grain + 1) * scene->dt) <= quiet;
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
	watch();
	if (!resting() || !groundIsQuiet() || !mayGoOn()) return;
	scene->iter += grain - 1; // the step that ends now makes it a whole grain
	scene->time += (grain - 1) * scene->dt;
	skipped += (grain - 1) * scene->dt;
}

} // namespace yade

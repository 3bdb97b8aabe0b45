// SPDX-License-Identifier: GPL-2.0-or-later
#include <GroundMotion.hpp>
#include <bodies.hpp>

namespace yade {

YADE_PLUGIN((GroundMotionEngine));

void GroundMotionEngine::postLoad(GroundMotionEngine&)
{
	if (acceleration.empty()) return;
	if (!(step > 0)) throw std::invalid_argument("GroundMotionEngine.step = " + std::to_string(step) + ": it must be > 0");
	for (size_t k = 0; k < acceleration.size(); ++k)
		if (!acceleration[k].allFinite()) throw std::invalid_argument("GroundMotionEngine.acceleration[" + std::to_string(k) + "] is not finite");
}

Vector3r GroundMotionEngine::at(Real time) const
{
	const Real place = (time - start) / step;
	if (acceleration.empty() || !(place >= 0) || place > acceleration.size() - 1) return Vector3r::Zero();
	const size_t k     = math::min(size_t(place), acceleration.size() - 1);
	const Real   share = place - k;
	const Vector3r next = k + 1 < acceleration.size() ? acceleration[k + 1] : acceleration[k];
	return scale * ((1 - share) * acceleration[k] + share * next);
}

Real GroundMotionEngine::strongest(Real from, Real until) const
{
	Real most = math::max(at(from).norm(), at(until).norm());
	for (Real k = math::max(Real(0), math::ceil((from - start) / step)); k < acceleration.size() && start + k * step < until; ++k) // linear between samples
		most = math::max(most, math::abs(scale) * acceleration[size_t(k)].norm());
	return most;
}

Vector3r GroundMotionEngine::freeMomentum() const
{
	Vector3r sum = Vector3r::Zero();
	for (const shared_ptr<Body>& b : *scene->bodies)
		if (b && isFree(*b->state)) sum += b->state->mass * b->state->vel;
	return sum;
}

Real GroundMotionEngine::workNow() const { return work - scene->dt * lastAcceleration.dot(lastMomentum + freeMomentum()) / 2; }

void GroundMotionEngine::action()
{
	work             = workNow();
	lastMomentum     = freeMomentum();
	lastAcceleration = at(scene->time);
	addBodyForce(*scene, -lastAcceleration);
}

} // namespace yade

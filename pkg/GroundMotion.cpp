// SPDX-License-Identifier: GPL-2.0-or-later
#include <GroundMotion.hpp>
#include <bodies.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((GroundMotionEngine));

void GroundMotionEngine::validate() const
{
	requireFinite("GroundMotionEngine.start", start);
	requireFinite("GroundMotionEngine.scale", scale);
	if (acceleration.empty() && std::isnan(step)) return; // default-constructed
	requirePositive("GroundMotionEngine.step", step);
	for (size_t k = 0; k < acceleration.size(); ++k)
		if (!acceleration[k].allFinite())
			throw std::invalid_argument(
			        "GroundMotionEngine.acceleration[" + std::to_string(k) + "]: it must be finite");
}

Vector3r GroundMotionEngine::at(Real time) const
{
	const Real sample = (time - start) / step;
	if (acceleration.empty() || !(sample >= 0) || sample > acceleration.size() - 1) return Vector3r::Zero();
	const size_t k = math::min(size_t(sample), acceleration.size() - 1);
	const Real weight = sample - k;
	const Vector3r next = k + 1 < acceleration.size() ? acceleration[k + 1] : acceleration[k];
	return scale * ((1 - weight) * acceleration[k] + weight * next);
}

Real GroundMotionEngine::peakBetween(Real from, Real until) const
{
	Real peak = math::max(at(from).norm(), at(until).norm());
	// Linear between samples
	for (Real k = math::max(Real(0), math::ceil((from - start) / step));
	        k < acceleration.size() && start + k * step < until; ++k)
		peak = math::max(peak, math::abs(scale) * acceleration[size_t(k)].norm());
	return peak;
}

namespace {
	/// Momentum of the free bodies. [kg m/s]
	Vector3r freeMomentum(const Scene& scene)
	{
		Vector3r sum = Vector3r::Zero();
		for (const shared_ptr<Body>& b : *scene.bodies)
			if (b && isFree(*b->state)) sum += b->state->mass * b->state->vel;
		return sum;
	}
}

Real GroundMotionEngine::workUntil(const Vector3r& momentum) const
{
	return work - lastStep * lastAcceleration.dot(lastMomentum + momentum) / 2;
}

Real GroundMotionEngine::workUntilNow(const Scene& current) const
{
	return dead ? work : workUntil(freeMomentum(current));
}

void GroundMotionEngine::action()
{
	const Vector3r momentum = freeMomentum(*scene);
	work = workUntil(momentum);
	lastMomentum = momentum;
	lastStep = scene->dt;
	lastAcceleration = at(scene->time);
	addBodyForce(*scene, -lastAcceleration);
}

} // namespace yade

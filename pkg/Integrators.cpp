// SPDX-License-Identifier: GPL-2.0-or-later
#include <Integrators.hpp>
#include <RoundedPolyhedron.hpp>
#include <kernel/rotation.hpp>

namespace yade {

YADE_PLUGIN((SymplecticIntegrator)(CollisionTrigger));

namespace {
	/// Zeroes the components of blocked directions; `first` is the flag of the x component.
	Vector3r unblocked(Vector3r v, unsigned blocked, unsigned first)
	{
		for (int axis = 0; axis < 3; ++axis)
			if (blocked & (first << axis)) v[axis] = 0;
		return v;
	}
}

void SymplecticIntegrator::action()
{
	const Real dt = scene->dt;
	scene->forces.sync();
	for (const shared_ptr<Body>& b : *scene->bodies) {
		if (!b) continue;
		State& s = *b->state;
		if (s.blockedDOFs == State::DOF_ALL) {
			s.pos += dt * s.vel;
			continue;
		}
		s.vel += dt / s.mass * unblocked(scene->forces.getForce(b->getId()), s.blockedDOFs, State::DOF_X);
		s.pos += dt * s.vel;
		s.angMom += dt * unblocked(scene->forces.getTorque(b->getId()), s.blockedDOFs, State::DOF_RX);
		s.angVel = timber::freeRotation(s.ori, s.angMom, s.inertia, dt);
	}
}

void CollisionTrigger::action()
{
	if (!collider)
		for (const shared_ptr<Engine>& e : scene->engines)
			if (e->getClassName().find("Collider") != string::npos) collider = e.get();
	if (!collider) return;
	Real fastest = 0;
	for (const shared_ptr<Body>& b : *scene->bodies) {
		if (!b) continue;
		const auto shape = dynamic_cast<RoundedPolyhedron*>(b->shape.get());
		fastest          = math::max(fastest, b->state->vel.norm() + (shape ? b->state->angVel.norm() * shape->geometry.reach : 0));
	}
	moved += fastest * scene->dt;
	const bool changed = bodyCount != scene->bodies->size() || scene->interactions->dirty;
	collider->dead     = !(changed || !(moved < margin));
	if (collider->dead) return;
	bodyCount = scene->bodies->size();
	moved     = 0;
	++runs;
}

} // namespace yade

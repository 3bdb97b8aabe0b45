// SPDX-License-Identifier: GPL-2.0-or-later
#include <Integrators.hpp>
#include <bodies.hpp>
#include <RoundedPolyhedron.hpp>
#include <threads.hpp>
#include <kernel/rotation.hpp>

namespace yade {

YADE_PLUGIN((SymplecticIntegrator)(CollisionTrigger));

namespace {
	/// Zeroes the components of blocked directions; `first` is the flag of the x component.
	Vector3r unblocked(Vector3r v, unsigned blocked, unsigned first)
	{
		for (int axis = 0; blocked && axis < 3; ++axis)
			if (blocked & (first << axis)) v[axis] = 0;
		return v;
	}
}

void SymplecticIntegrator::move(Body& b) const
{
	const Real dt = scene->dt;
	State&     s  = *b.state;
	if (!isFree(s)) {
		s.pos += dt * s.vel;
		return;
	}
	s.vel += dt / s.mass * unblocked(scene->forces.getForce(b.getId()), s.blockedDOFs, State::DOF_X);
	s.pos += dt * s.vel;
	s.angMom += dt * unblocked(scene->forces.getTorque(b.getId()), s.blockedDOFs, State::DOF_RX);
	s.angVel = timber::freeRotation(s.ori, s.angMom, s.inertia, dt);
}

void SymplecticIntegrator::action()
{
	scene->forces.sync();
	const int count = int(scene->bodies->size());
#pragma omp parallel for schedule(static) if (count > smallLoop)
	for (int id = 0; id < count; ++id)
		if (const shared_ptr<Body>& b = (*scene->bodies)[id]) move(*b);
}

CollisionTrigger::Motion CollisionTrigger::motionOf(const Body& b) const
{
	const Seen& then = seen[b.getId()];
	return { b.state->pos - then.place, timber::turnedWay(then.turn.conjugate() * b.state->ori, then.span) };
}

/// Whether any body has gone farther than its box reaches.
bool CollisionTrigger::mayHaveLeft()
{
	const int count = int(scene->bodies->size());
	motions.assign(count, { Vector3r::Zero(), 0 });
#pragma omp parallel for schedule(static) if (count > smallLoop)
	for (int id = 0; id < count; ++id)
		if (const shared_ptr<Body>& b = (*scene->bodies)[id]) motions[id] = motionOf(*b);
	const auto isInside = [](const Motion& m, const Seen& then) { return m.way.norm() + m.turned < then.margin; };
	return !std::equal(motions.begin(), motions.end(), seen.begin(), isInside);
}

void CollisionTrigger::remember()
{
	seen.assign(scene->bodies->size(), { Vector3r::Zero(), Quaternionr::Identity(), Vector3r::Zero(), std::numeric_limits<Real>::infinity() }); // as of bodies that are gone
	for (const shared_ptr<Body>& b : *scene->bodies) {
		if (!b) continue;
		const auto shape = dynamic_cast<RoundedPolyhedron*>(b->shape.get());
		seen[b->getId()] = { b->state->pos, b->state->ori, shape ? shape->geometry->span : Vector3r(Vector3r::Zero()), boxMargin(*b, margin, scene->dt) };
	}
}

void CollisionTrigger::action()
{
	const auto isCollider = [](const shared_ptr<Engine>& e) { return e->getClassName().find("Collider") != string::npos; };
	const auto collider   = std::find_if(scene->engines.begin(), scene->engines.end(), isCollider);
	if (collider == scene->engines.end()) return;
	const bool changed = seen.size() != scene->bodies->size() || scene->interactions->dirty;
	(*collider)->dead  = !changed && !mayHaveLeft();
	if ((*collider)->dead) return;
	remember();
	++runs;
}

} // namespace yade

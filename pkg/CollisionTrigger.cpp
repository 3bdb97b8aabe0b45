// SPDX-License-Identifier: GPL-2.0-or-later
#include <CollisionTrigger.hpp>
#include <Shape.hpp>
#include <kernel/rotation.hpp>
#include <kernel/threads.hpp>
#include <pkg/common/Collider.hpp>

namespace yade {

YADE_PLUGIN((CollisionTrigger));

CollisionTrigger::Motion CollisionTrigger::motionOf(const Body& b) const
{
	const Seen&    then = seen[b.getId()];
	const State&   now  = *b.state;
	const Vector3r way  = now.pos - then.place;
	if (then.isRounded) return { way, timber::rotationDisplacement(then.turn.conjugate() * now.ori, then.span) };
	return { way, now.ori.coeffs() == then.turn.coeffs() ? 0 : std::numeric_limits<Real>::infinity() };
}

/// Whether any body has gone farther than its box reaches.
bool CollisionTrigger::mayHaveLeft()
{
	const int count = int(scene->bodies->size());
	motions.assign(count, { Vector3r::Zero(), 0 });
	timber::forAll(count, [this](int id) {
		if (const shared_ptr<Body>& b = (*scene->bodies)[id]) motions[id] = motionOf(*b);
	});
	const auto isInside = [](const Motion& m, const Seen& then) { return m.way.norm() + m.turned <= then.margin; };
	return !std::equal(motions.begin(), motions.end(), seen.begin(), isInside);
}

/// Of the boxes of slow bodies. [m]
Real CollisionTrigger::boxMargin() const
{
	for (const shared_ptr<BoundFunctor>& f : static_cast<Collider*>(collider.get())->boundDispatcher->functors)
		if (const auto ours = dynamic_cast<Bo1_RoundedPolyhedron_Aabb*>(f.get())) return ours->margin;
	return 0;
}

void CollisionTrigger::remember()
{
	const Real margin = boxMargin();
	seen.assign(scene->bodies->size(), { Vector3r::Zero(), Quaternionr::Identity(), true, Vector3r::Zero(), std::numeric_limits<Real>::infinity() }); // as of bodies that are gone
	for (const shared_ptr<Body>& b : *scene->bodies) {
		if (!b) continue;
		const auto shape = dynamic_cast<RoundedPolyhedron*>(b->shape.get());
		seen[b->getId()] = { b->state->pos, b->state->ori, bool(shape), shape ? shape->geometry->span : Vector3r(Vector3r::Zero()), yade::boxMargin(*b, margin, scene->dt) };
	}
}

void CollisionTrigger::action()
{
	if (!dynamic_cast<Collider*>(collider.get())) throw std::invalid_argument("CollisionTrigger.collider: it needs a collider");
	lastLook = scene->iter;
	const bool changed = seen.size() != scene->bodies->size() || scene->interactions->dirty || scene->doSort; // doSort: bodies came
	if (!changed && !mayHaveLeft()) return;
	collider->scene = scene;
	collider->action();
	remember();
	motions.assign(seen.size(), { Vector3r::Zero(), 0 });
	++runs;
}

} // namespace yade

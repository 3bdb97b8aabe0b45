// SPDX-License-Identifier: GPL-2.0-or-later
#include <CollisionTrigger.hpp>
#include <Shape.hpp>
#include <bodies.hpp>
#include <validation.hpp>
#include <kernel/rotation.hpp>
#include <kernel/threads.hpp>
#include <pkg/common/Collider.hpp>

namespace yade {

YADE_PLUGIN((CollisionTrigger));

namespace {
	constexpr Real infinity = std::numeric_limits<Real>::infinity();
}

CollisionTrigger::MotionSinceCollision CollisionTrigger::motionOf(const Body& b) const
{
	const BodySnapshot& before = snapshots[b.getId()];
	const State& now = *b.state;
	const Vector3r displacement = now.pos - before.position;
	if (before.isRounded)
		return { displacement,
			timber::rotationDisplacement(before.orientation.conjugate() * now.ori, before.halfExtents) };
	return { displacement, now.ori.coeffs() == before.orientation.coeffs() ? 0 : infinity };
}

/// Updates the motions and compares them with the margins of the boxes.
bool CollisionTrigger::mayHaveLeftBox()
{
	const int count = int(scene->bodies->size());
	motions.assign(count, { Vector3r::Zero(), 0 });
	timber::forAll(count, [this](int id) {
		if (const shared_ptr<Body>& b = (*scene->bodies)[id]) motions[id] = motionOf(*b);
	});
	const auto isInside = [](const MotionSinceCollision& m, const BodySnapshot& before) {
		return m.displacement.norm() + m.rotationBound <= before.margin;
	};
	return !std::equal(motions.begin(), motions.end(), snapshots.begin(), isInside);
}

/// Margin of the boxes of slow bodies. [m]
Real CollisionTrigger::baseMargin() const
{
	for (const shared_ptr<BoundFunctor>& f : static_cast<Collider*>(collider.get())->boundDispatcher->functors)
		if (const auto bound = dynamic_cast<Bo1_RoundedPolyhedron_Aabb*>(f.get())) return bound->margin;
	return 0;
}

void CollisionTrigger::takeSnapshots()
{
	const Real margin = baseMargin();
	const BodySnapshot erased { Vector3r::Zero(), Quaternionr::Identity(), true, Vector3r::Zero(), infinity };
	snapshots.assign(scene->bodies->size(), erased);
	for (const shared_ptr<Body>& b : *scene->bodies) {
		if (!b) continue;
		const RoundedPolyhedron* shape = roundedShape(*b);
		const Vector3r halfExtents = shape ? shape->geometry->halfExtents : Vector3r(Vector3r::Zero());
		snapshots[b->getId()]
		        = { b->state->pos, b->state->ori, bool(shape), halfExtents, boxMargin(*b, margin, scene->dt) };
	}
}

void CollisionTrigger::action()
{
	if (!dynamic_cast<Collider*>(collider.get())) stopRun("CollisionTrigger.collider: a Collider is required");
	lastStep = scene->iter;
	// DoSort: bodies were added
	const bool changed = snapshots.size() != scene->bodies->size() || scene->interactions->dirty || scene->doSort;
	if (!changed && !mayHaveLeftBox()) return;
	collider->scene = scene;
	const OneThread serial;
	collider->action();
	takeSnapshots();
	motions.assign(snapshots.size(), { Vector3r::Zero(), 0 });
	++runs;
}

} // namespace yade

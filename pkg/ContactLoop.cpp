// SPDX-License-Identifier: GPL-2.0-or-later
#include <ContactLoop.hpp>
#include <CollisionTrigger.hpp>
#include <ContactPhysics.hpp>
#include <Integrator.hpp>
#include <bodies.hpp>
#include <validation.hpp>
#include <kernel/threads.hpp>

namespace yade {

YADE_PLUGIN((ContactLoop));

bool ContactLoop::areBothFixed(const TrackedInteraction& t) const
{
	const Body *b1 = bodyAt(*scene, t.id1), *b2 = bodyAt(*scene, t.id2);
	return b1 && b2 && !isFree(*b1->state) && !isFree(*b2->state);
}

/// Whether the tracked interactions are valid: the trigger ran in this step and the collider did not, no interaction
/// was added, erased or reset, and no fixed body was freed.
bool ContactLoop::isCurrent(const CollisionTrigger* trigger) const
{
	return trigger && trigger->isCurrent() && colliderRuns == trigger->runs
	        && interactionCount == scene->interactions->size()
	        && std::all_of(tracked.begin(), tracked.end(),
	                [](const TrackedInteraction& t) { return t.interaction->isReal(); })
	        && std::all_of(fixedPairs.begin(), fixedPairs.end(),
	                [this](const TrackedInteraction& t) { return areBothFixed(t); });
}

void ContactLoop::runInteractionLoop(const CollisionTrigger* trigger)
{
	if (!loop) stopRun("ContactLoop.loop: an InteractionLoop is required");
	loop->scene = scene;
	{
		const OneThread serial;
		loop->action();
	}
	++runs;
	tracked.clear();
	fixedPairs.clear();
	bool allRounded = true;
	for (const shared_ptr<Interaction>& I : *scene->interactions) {
		const TrackedInteraction t { I, I->getId1(), I->getId2(), 0 };
		if (I->isReal()) tracked.push_back(t);
		else if (areBothFixed(t)) fixedPairs.push_back(t);
		for (const Body::id_t id : { t.id1, t.id2 })
			allRounded = allRounded && bodyAt(*scene, id) && roundedShape(*bodyAt(*scene, id));
	}
	interactionCount = scene->interactions->size();
	colliderRuns = trigger && allRounded ? trigger->runs : -1;
}

/// As InteractionLoop does for one pair. A pair without points and history needs no law until the collider runs.
void ContactLoop::updateContact(TrackedInteraction& t, const CollisionTrigger& trigger) const
{
	const Real approach = trigger.approach(t.id1, t.id2);
	if (approach < t.separation) return;
	const shared_ptr<Interaction>& I = t.interaction;
	const Body &b1 = *(*scene->bodies)[t.id1], &b2 = *(*scene->bodies)[t.id2];
	I->functorCache.geom->go(b1.shape, b2.shape, *b1.state, *b2.state, Vector3r::Zero(), false, I);
	const ManifoldGeom& geom = *static_cast<ManifoldGeom*>(I->geom.get());
	const ManifoldPhys& phys = *static_cast<ManifoldPhys*>(I->phys.get());
	if (!geom.contactPoints.empty() || !phys.isIdle()) {
		I->functorCache.phys->go(b1.material, b2.material, I); // for changed materials and masses
		if (!I->functorCache.constLaw->go(I->geom, I->phys, I.get()))
			return scene->interactions->requestErase(I);
	}
	t.separation = phys.isIdle() ? geom.safeDisplacement - approach : 0;
}

/// Bodies moved by hand, or by an engine after the last ContactLoop, load the springs of their contacts.
void ContactLoop::markMoved() const
{
	const std::vector<bool> moved = movedByHand(*scene, true);
	if (moved.empty()) return;
	for (const shared_ptr<Interaction>& I : *scene->interactions)
		if (I->isReal() && (moved[I->getId1()] || moved[I->getId2()]))
			if (auto* phys = dynamic_cast<ManifoldPhys*>(I->phys.get()))
				phys->isMoved = !phys->records.empty();
}

void ContactLoop::action()
{
	markMoved();
	const CollisionTrigger* trigger = findEngine<CollisionTrigger>(*scene);
	if (!isCurrent(trigger)) return runInteractionLoop(trigger);
	timber::forAll(int(tracked.size()), [&](int k) { updateContact(tracked[k], *trigger); });
}

} // namespace yade

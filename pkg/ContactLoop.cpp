// SPDX-License-Identifier: GPL-2.0-or-later
#include <ContactLoop.hpp>
#include <CollisionTrigger.hpp>
#include <ContactPhysics.hpp>
#include <bodies.hpp>
#include <kernel/threads.hpp>

namespace yade {

YADE_PLUGIN((ContactLoop));

namespace {
	bool isRounded(const Scene& scene, Body::id_t id)
	{
		const Body* b = bodyAt(scene, id);
		return b && dynamic_cast<RoundedPolyhedron*>(b->shape.get());
	}
}

bool ContactLoop::isHeld(const Pair& p) const
{
	const Body *b1 = bodyAt(*scene, p.id1), *b2 = bodyAt(*scene, p.id2);
	return b1 && b2 && !isFree(*b1->state) && !isFree(*b2->state);
}

/// Nothing has happened that only the wrapped loop can deal with: the trigger has looked in this step, the collider has not run, no pair was reset, no held body released.
bool ContactLoop::isCurrent(const CollisionTrigger* trigger) const
{
	return trigger && trigger->isCurrent() && colliderRuns == trigger->runs && seen == scene->interactions->size()
	        && std::all_of(pairs.begin(), pairs.end(), [](const Pair& p) { return p.interaction->isReal(); })
	        && std::all_of(held.begin(), held.end(), [this](const Pair& p) { return isHeld(p); });
}

void ContactLoop::lookAtAll(const CollisionTrigger* trigger)
{
	if (!loop) throw std::invalid_argument("ContactLoop.loop: it needs an InteractionLoop");
	loop->scene = scene;
	loop->action();
	++runs;
	pairs.clear();
	held.clear();
	bool ours = !scene->isPeriodic;
	for (const shared_ptr<Interaction>& I : *scene->interactions) {
		const Pair pair { I, I->getId1(), I->getId2(), 0 };
		if (I->isReal()) pairs.push_back(pair);
		else if (isHeld(pair)) held.push_back(pair);
		ours = ours && isRounded(*scene, pair.id1) && isRounded(*scene, pair.id2);
	}
	seen = scene->interactions->size();
	colliderRuns = trigger && ours ? trigger->runs : -1;
}

void ContactLoop::look(Pair& pair, const CollisionTrigger& trigger) const
{
	const Real approach = trigger.approach(pair.id1, pair.id2);
	if (approach < pair.shut) return;
	const shared_ptr<Interaction>& I = pair.interaction;
	const Body &                   b1 = *(*scene->bodies)[pair.id1], &b2 = *(*scene->bodies)[pair.id2];
	I->functorCache.geom->go(b1.shape, b2.shape, *b1.state, *b2.state, Vector3r::Zero(), false, I);
	const ManifoldGeom& geom = *static_cast<ManifoldGeom*>(I->geom.get());
	const ManifoldPhys& phys = *static_cast<ManifoldPhys*>(I->phys.get());
	const bool          law  = !geom.contactPoints.empty() || !phys.isIdle(); // else it does nothing until the collider runs
	if (law && !I->functorCache.constLaw->go(I->geom, I->phys, I.get())) return scene->interactions->requestErase(I);
	pair.shut = phys.isIdle() ? geom.gap - approach : 0;
}

void ContactLoop::action()
{
	const CollisionTrigger* trigger = findEngine<CollisionTrigger>(*scene);
	if (!isCurrent(trigger)) return lookAtAll(trigger);
	timber::forAll(int(pairs.size()), [&](int k) { look(pairs[k], *trigger); });
}

} // namespace yade

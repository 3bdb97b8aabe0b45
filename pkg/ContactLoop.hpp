// SPDX-License-Identifier: GPL-2.0-or-later
/// The loop over contacts, without what YADE's does again in each step and without pairs that cannot touch.
#pragma once
#include <pch.hpp>

namespace yade {

class CollisionTrigger;

class ContactLoop : public GlobalEngine {
	struct Pair {
		shared_ptr<Interaction> interaction;
		Body::id_t              id1, id2;
		Real                    shut; ///< it cannot touch while its bodies' approach since the collider ran is less [m]
	};
	std::vector<Pair> pairs; ///< those that have geometry and physics
	std::vector<Pair> held; ///< those of two held bodies, which have none
	size_t            seen = 0; ///< interactions in the container when the wrapped loop ran
	long              colliderRuns = -1; ///< by then; < 0: the wrapped loop must run in each step

	bool isHeld(const Pair&) const;
	bool isCurrent(const CollisionTrigger*) const;
	void lookAtAll(const CollisionTrigger*);
	void look(Pair&, const CollisionTrigger&) const;

public:
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(ContactLoop, GlobalEngine,
		"Wraps an :yref:`InteractionLoop`, which runs when the collider has run or pairs came or went. In all other steps the functors that it has found for each pair are called at once, and only where bodies may touch: "
		"a pair is left alone as long as its bodies have moved against each other by less than the gap between them. The result is that of the InteractionLoop, which may stand here by itself. "
		"The InteractionLoop runs in each step of a scene that has no :yref:`CollisionTrigger` before it, is periodic, or has pairs of other shapes than :yref:`RoundedPolyhedron`. One with callbacks must stand by itself.",
		((shared_ptr<Engine>, loop, , , "The InteractionLoop. [-]"))
		((long, runs, 0, Attr::readonly, "How often the InteractionLoop ran. [-]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(ContactLoop);

} // namespace yade

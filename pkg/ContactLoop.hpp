// SPDX-License-Identifier: GPL-2.0-or-later
/// The loop over interactions, without the pairs that cannot be in contact.
///
/// * The wrapped InteractionLoop runs when the collider has run, or when interactions were added or erased. It creates
///   geometry and physics, erases interactions, and selects the functors of each pair.
/// * In all other steps, these functors are called directly.
/// * A pair is skipped as long as the approach of its bodies since the collider ran (CollisionTrigger) is less than
///   their separation.
/// * The result is that of the InteractionLoop, bit for bit.
/// * Pairs of two fixed bodies have neither geometry nor physics. If one of the bodies is freed, the InteractionLoop
///   runs.
/// * Without a CollisionTrigger, or with shapes other than RoundedPolyhedron, the InteractionLoop runs in each step.
#pragma once
#include <pch.hpp>

namespace yade {

class CollisionTrigger;

class ContactLoop : public GlobalEngine {
	struct TrackedInteraction {
		shared_ptr<Interaction> interaction;
		Body::id_t id1, id2;
		Real separation; ///< no contact while the approach since the collider ran is less than this [m]
	};
	std::vector<TrackedInteraction> tracked; ///< with geometry and physics
	std::vector<TrackedInteraction> fixedPairs; ///< of two fixed bodies
	size_t interactionCount = 0; ///< when the InteractionLoop ran
	long colliderRuns = -1; ///< when the InteractionLoop ran; < 0: it must run in each step

	bool areBothFixed(const TrackedInteraction&) const;
	bool isCurrent(const CollisionTrigger*) const;
	void runInteractionLoop(const CollisionTrigger*);
	void markMoved() const;
	void updateContact(TrackedInteraction&, const CollisionTrigger&) const;

public:
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(ContactLoop, GlobalEngine,
		"Wraps an :yref:`InteractionLoop`, which runs only when the collider has run or when interactions were "
		"added or erased. In all other steps the functors of each pair are called directly, "
		"and pairs are skipped while their bodies have approached by less than the gap between them. The "
		"result is that of the InteractionLoop, which can replace this engine. "
		"The InteractionLoop runs in each step if the scene has no :yref:`CollisionTrigger` before it, or "
		"pairs of shapes other than :yref:`RoundedPolyhedron`. An InteractionLoop with callbacks must not be "
		"wrapped.",
		((shared_ptr<Engine>, loop, , , "The InteractionLoop. [-]"))
		((long, runs, 0, Attr::readonly, "Number of runs of the InteractionLoop. [-]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(ContactLoop);

} // namespace yade

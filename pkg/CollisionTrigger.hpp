// SPDX-License-Identifier: GPL-2.0-or-later
/// When the collider must run again.
#pragma once
#include <pch.hpp>

namespace yade {

class CollisionTrigger : public GlobalEngine {
	/// A body when the collider ran.
	struct Seen {
		Vector3r    place;
		Quaternionr turn;
		bool        isRounded; ///< of other shapes nothing is known
		Vector3r    span; ///< largest distance of its core's points from the centre along its axes [m]
		Real        margin; ///< of its box [m]
	};
	/// How a body has moved since then.
	struct Motion {
		Vector3r way; ///< of its centre [m]
		Real     turned; ///< bound of the way of its points against the centre [m]
	};
	std::vector<Seen>   seen; ///< by id
	std::vector<Motion> motions; ///< by id
	Motion motionOf(const Body&) const;
	long                lastLook = -1; ///< step
	Real boxMargin() const;
	bool mayHaveLeft();
	void remember();

public:
	void action() override;
	/// Whether approach() tells of this step.
	bool isCurrent() const { return lastLook == scene->iter; }
	/// Bound of how much nearer any points of two bodies can be than they were when the collider ran. [m]
	Real approach(Body::id_t id1, Body::id_t id2) const { return (motions[id2].way - motions[id1].way).norm() + motions[id1].turned + motions[id2].turned; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(CollisionTrigger, GlobalEngine,
		"Wraps a collider, which runs only when a body may have left its bounding box, or bodies came or went. Boxes of other shapes than :yref:`RoundedPolyhedron` have no margin: where one moves, the collider runs in each step.",
		((shared_ptr<Engine>, collider, , , "The collider, with a :yref:`Bo1_RoundedPolyhedron_Aabb`. [-]"))
		((int, runs, 0, Attr::readonly, "How often the collider ran. [-]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(CollisionTrigger);

} // namespace yade

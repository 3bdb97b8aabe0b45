// SPDX-License-Identifier: GPL-2.0-or-later
/// Runs the collider only when a body may have left its bounding box.
///
/// * The boxes of RoundedPolyhedron are larger than the body by a margin (Bo1_RoundedPolyhedron_Aabb), as the skin of a
///   Verlet list.
/// * After each run of the collider, a snapshot stores the pose and the margin of each body.
/// * In each step, the motion since the snapshot is bounded: displacement of the centre plus displacement of the
///   surface by rotation.
/// * The collider runs again if a bound exceeds a margin, if bodies were added or erased, or if interactions were
///   reset.
/// * Boxes of other shapes have no margin: any motion of these bodies starts the collider.
#pragma once
#include <pch.hpp>

namespace yade {

class CollisionTrigger : public GlobalEngine {
	/// A body when the collider last ran.
	struct BodySnapshot {
		Vector3r position; ///< [m]
		Quaternionr orientation;
		bool isRounded; ///< RoundedPolyhedron
		Vector3r halfExtents; ///< of its core [m]
		Real margin; ///< of its bounding box [m]
	};
	struct MotionSinceCollision {
		Vector3r displacement; ///< of the centre [m]
		Real rotationBound; ///< bound of the displacement of the surface relative to the centre [m]
	};
	std::vector<BodySnapshot> snapshots; ///< by body id
	std::vector<MotionSinceCollision> motions; ///< by body id
	long lastStep = -1; ///< in which the motions were computed

	MotionSinceCollision motionOf(const Body&) const;
	bool mayHaveLeftBox();
	Real baseMargin() const;
	void takeSnapshots();

public:
	void action() override;
	/// Whether approach() is valid for the current step.
	bool isCurrent() const { return lastStep == scene->iter; }
	/// Bound of the decrease of the distance of two bodies since the collider last ran. [m]
	Real approach(Body::id_t id1, Body::id_t id2) const
	{
		return (motions[id2].displacement - motions[id1].displacement).norm() + motions[id1].rotationBound
		        + motions[id2].rotationBound;
	}
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(CollisionTrigger, GlobalEngine,
		"Wraps a collider and runs it only when a body may have left its bounding box, or when bodies were "
		"added or erased. "
		"Boxes of shapes other than :yref:`RoundedPolyhedron` have no margin: the collider runs in each step "
		"in which one of these bodies moves.",
		((shared_ptr<Engine>, collider, , , "The collider, with a :yref:`Bo1_RoundedPolyhedron_Aabb`. [-]"))
		((int, runs, 0, Attr::readonly, "Number of runs of the collider. [-]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(CollisionTrigger);

} // namespace yade

// SPDX-License-Identifier: GPL-2.0-or-later
/// Motion of rigid bodies, and when the collider must look again.
#pragma once
#include <pch.hpp>

namespace yade {

class SymplecticIntegrator : public GlobalEngine {
	void push(Body::id_t, State&) const;
	void carryOn(State&) const;
	template <class Number> void turn(State* const* states, size_t count) const;
	void move(Body::id_t first) const;

public:
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC(SymplecticIntegrator, GlobalEngine,
		"Leapfrog for rigid bodies: positions at full, velocities and angular momenta at half steps. The free rotation within a step is composed of exact rotations about the principal axes "
		"(Dullweber, Leimkuhler and McLachlan 1997): second order, time-reversible, symplectic, and it keeps the angular momentum exactly. It replaces NewtonIntegrator, which gains energy in free rotation. "
		"No numerical damping. Blocked degrees of freedom get no force; a body with all of them blocked keeps its velocity and angular velocity, and moves with them.");
	// clang-format on
};
REGISTER_SERIALIZABLE(SymplecticIntegrator);

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

// SPDX-License-Identifier: GPL-2.0-or-later
/// Motion of rigid bodies.
#pragma once
#include <pch.hpp>

namespace yade {

/// A body as the integrator left it at the end of a step.
struct SteppedBody {
	Vector3r position; ///< [m]
	Quaternionr orientation;
	long born = -1; ///< step in which the body was appended; -1: there is no body, or its contacts begin anew
	int mask; ///< of its group
	int blockedDOFs;
	bool wasMoved = false; ///< it had been given another pose before that step moved it

	SteppedBody() = default;
	explicit SteppedBody(const Body* b);
	bool isSame(const Body& b) const { return born >= 0 && born == b.iterBorn; }
	/// Whether the body was given another pose since the last step.
	bool isMoved(const Body& b) const { return isSame(b) && !hasPoseOf(b); }
	bool hasPoseOf(const Body& b) const
	{
		return position == b.state->pos && orientation.coeffs() == b.state->ori.coeffs();
	}
	/// Whether a body is the same, in the same pose and group, and neither fixed nor freed since.
	bool isStill(const Body&) const;
	template <class Archive> void serialize(Archive& ar, const unsigned int)
	{
		ar& BOOST_SERIALIZATION_NVP(position) & BOOST_SERIALIZATION_NVP(orientation)
		        & BOOST_SERIALIZATION_NVP(born) & BOOST_SERIALIZATION_NVP(mask)
		        & BOOST_SERIALIZATION_NVP(blockedDOFs) & BOOST_SERIALIZATION_NVP(wasMoved);
	}
};

/// Whether a body was appended, replaced, given another pose, fixed or freed since the last step of its scene: what it
/// overlaps was not reached by motion. In the first step of an integrator all bodies of a new scene were placed, in a
/// scene that runs only those that were appended.
bool wasPlaced(const Scene&, const Body&);

/// Whether each body, by id, was given another pose since the last step; alsoWithin: or before its motion in that step,
/// maybe by an engine. Empty: none was.
std::vector<bool> movedByHand(const Scene&, bool alsoWithin);

/// Contacts of a body that begin in the next step are those of a body that was placed.
void markPlaced(const Scene&, Body::id_t);

class SymplecticIntegrator : public GlobalEngine {
	void kickAndDrift(Body::id_t, State&) const;
	void moveFixed(State&) const;
	template <class Number> void rotate(State* const* states, size_t count) const;
	void moveGroup(Body::id_t first);

public:
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(SymplecticIntegrator, GlobalEngine,
		"Leapfrog for rigid bodies: positions at full, velocities and angular momenta at half steps. The free "
		"rotation within a step is composed of exact rotations about the principal axes "
		"(Dullweber, Leimkuhler and McLachlan 1997): second order, time-reversible, symplectic, with exact "
		"conservation of angular momentum. It replaces NewtonIntegrator, whose energy grows in free rotation. "
		"No numerical damping. A body with all degrees of freedom blocked moves with its prescribed velocity "
		"and angular velocity.",
		((vector<SteppedBody>, stepped, , Attr::hidden, "The bodies at the end of the last step, by id. [-]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(SymplecticIntegrator);

} // namespace yade

// SPDX-License-Identifier: GPL-2.0-or-later
/// Names bodies that overlap without a contact force.
#pragma once
#include <pch.hpp>

namespace yade {

class OverlapCheck : public GlobalEngine {
public:
	void postLoad(OverlapCheck&) { validate(); }
	void validate() const;
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(OverlapCheck, GlobalEngine,
		"Compares at an interval the overlap of each pair of bodies, from the distance of their cores, with the "
		"largest overlap from which their contact points have a force, plastic parts included. The difference is "
		"uncarried: the bodies have sunk into each other. Prints one line when it exceeds a share of the "
		"smaller rounding radius and all earlier ones. It changes no motion. Must come after the contact loop.",
		((Real, interval, 1, Attr::triggerPostLoad, "Simulated time between checks; 0: every step. [s]"))
		((Real, share, 0.1, Attr::triggerPostLoad, "Uncarried overlap that is reported, over the smaller "
			"rounding radius. [-]"))
		((Real, largest, 0, Attr::readonly, "Largest uncarried overlap so far, among the reported ones. [m]"))
		((Real, time, NaN, Attr::readonly, "Simulated time of the largest uncarried overlap. [s]"))
		((int, id1, -1, Attr::readonly, "First body of the pair with the largest uncarried overlap. [-]"))
		((int, id2, -1, Attr::readonly, "Second body of that pair. [-]"))
		((Real, nextCheck, 0, Attr::readonly, "Simulated time of the next check. [s]")),
		,
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(OverlapCheck);

} // namespace yade

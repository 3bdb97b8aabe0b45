// SPDX-License-Identifier: GPL-2.0-or-later
/// Gravity as an external force (paper, Eqs. 1-3).
#pragma once
#include <pch.hpp>

namespace yade {

class UniformGravity : public GlobalEngine {
public:
	void postLoad(UniformGravity&) { validate(); }
	void validate() const;
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(UniformGravity, GlobalEngine,
		"Adds m g to every free body. Unlike YADE's GravityEngine it runs on one thread, so that sums do not "
		"depend on the number of threads by rounding.",
		((Vector3r, gravity, Vector3r(0, 0, -9.81), Attr::triggerPostLoad, "Acceleration of gravity. [m/s2]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(UniformGravity);

/// Acceleration of gravity in a scene, from this package's engine or YADE's. [m/s2]
Vector3r gravityOf(const Scene&);

} // namespace yade

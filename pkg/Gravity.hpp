// SPDX-License-Identifier: GPL-2.0-or-later
/// Gravity as an external force (paper, Eqs. 1-3).
#pragma once
#include <pch.hpp>

namespace yade {

class UniformGravity : public GlobalEngine {
public:
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(UniformGravity, GlobalEngine,
		"Adds m g to every free body. YADE's GravityEngine adds on several threads, and the sums on bodies then depend on their number by rounding.",
		((Vector3r, gravity, Vector3r(0, 0, -9.81), , "Acceleration of gravity. [m/s2]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(UniformGravity);

} // namespace yade

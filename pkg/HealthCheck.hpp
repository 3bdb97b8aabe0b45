// SPDX-License-Identifier: GPL-2.0-or-later
/// Stops a run whose numbers are no longer physical.
#pragma once
#include <pch.hpp>

namespace yade {

class HealthCheck : public GlobalEngine {
public:
	void postLoad(HealthCheck&);
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(HealthCheck, GlobalEngine, "Stops a run with an error that names the body and the step when a position or velocity is not finite or a speed is beyond all physics.",
		((int, every, 100, Attr::triggerPostLoad, "Steps between checks. [-]"))
		((Real, speedLimit, 200, , "Largest believable speed of a body. [m/s]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(HealthCheck);

} // namespace yade

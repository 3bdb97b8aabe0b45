// SPDX-License-Identifier: GPL-2.0-or-later
/// Stops a run whose scene cannot be computed or whose numbers are no longer physical.
#pragma once
#include <pch.hpp>

namespace yade {

class HealthCheck : public GlobalEngine {
	using CheckedEngine = std::pair<const Engine*, bool>; ///< engine, whether it is dead
	std::vector<CheckedEngine> checkedEngines; ///< at the last check of the scene
	boost::weak_ptr<Scene> checkedScene;

	bool hasSceneChanged() const;
	void checkScene();
	void checkBodies() const;
	void checkState(const Body&) const;

public:
	void postLoad(HealthCheck&) { validate(); }
	void validate() const;
	void action() override;
	/// The bodies' numbers now. Throws runtime_error.
	void check() const;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(HealthCheck, GlobalEngine,
		"Stops a run with an error before a step that cannot be computed. Must come before the collider. "
		"When bodies were added or the list of engines was changed it checks that the list is complete, in order and of this scene, that all pairs of shapes and materials have functors, and that materials and masses are valid. "
		"Then and at an interval it checks that positions and velocities are finite, speeds and rotations plausible.",
		((int, every, 100, Attr::triggerPostLoad, "Steps between checks of the bodies. [-]"))
		((Real, speedLimit, 200, Attr::triggerPostLoad, "Largest plausible speed of a body. [m/s]"))
		((Real, turnLimit, 1.5, Attr::triggerPostLoad, "Largest plausible rotation of a free body in a step. [rad]")),
		,
		.def("check", &HealthCheck::check, "Checks the bodies' numbers now; raises RuntimeError.")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(HealthCheck);

} // namespace yade

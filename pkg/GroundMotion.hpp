// SPDX-License-Identifier: GPL-2.0-or-later
/// Earthquake as an external force in the frame of the ground (paper, Eqs. 1-3).
#pragma once
#include <pch.hpp>

namespace yade {

class GroundMotionEngine : public GlobalEngine {
	/// Work done on the bodies until the end of the last step. momentum: of the free bodies then [kg m/s]. [J]
	Real workUntil(const Vector3r& momentum) const;

public:
	void postLoad(GroundMotionEngine&) { validate(); }
	void validate() const;
	void action() override;
	/// Work done on the bodies of a scene until the end of the last step. [J]
	Real workUntilNow(const Scene&) const;
	/// Ground acceleration at a time, linear between samples, zero before the first and after the last. [m/s2]
	Vector3r at(Real time) const;
	/// Largest ground acceleration between two times. [m/s2]
	Real peakBetween(Real from, Real until) const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(GroundMotionEngine, GlobalEngine,
		"Adds -m a_g(t) to every free body (paper, Eqs. 1-3, external force). The frame of reference moves "
		"with the ground: fixed bodies are at rest.",
		((Real, step, NaN, Attr::triggerPostLoad, "Time between two samples. [s]"))
		((vector<Vector3r>, acceleration, , Attr::triggerPostLoad, "Ground acceleration: east, north, up. "
			"[m/s2]"))
		((Real, start, 0, Attr::triggerPostLoad, "Simulated time of the first sample. [s]"))
		((Real, scale, 1, Attr::triggerPostLoad, "Factor on the acceleration. [-]"))
		((Real, work, 0, , "Work done on the bodies until the start of the last step. [J]"))
		((Vector3r, lastMomentum, Vector3r::Zero(), Attr::hidden, "Momentum of the free bodies at the start of "
			"the last step. [kg m/s]"))
		((Real, lastStep, 0, Attr::hidden, "Length of the last step. [s]"))
		((Vector3r, lastAcceleration, Vector3r::Zero(), Attr::hidden, "Ground acceleration in the last step. "
			"[m/s2]")),
		,
		.def("at", &GroundMotionEngine::at, (boost::python::arg("time")), "Ground acceleration at a simulated "
			"time. [m/s2]")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(GroundMotionEngine);

} // namespace yade

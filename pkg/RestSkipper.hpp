// SPDX-License-Identifier: GPL-2.0-or-later
/// Skips steps while scene and ground are at rest.
#pragma once
#include <pch.hpp>

namespace yade {

class RestSkipper : public GlobalEngine {
	vector<Vector3r> positions() const;
	Real largestSpeed() const;
	/// Infinite after a body was erased, or appended in the place of one.
	Real largestDisplacement(const vector<Vector3r>& from) const;
	long stridesPerHalf() const;
	void restart();
	void observe();
	bool isResting() const;
	bool isGroundAtRest() const;
	bool isEndBeyondStride() const;

public:
	void postLoad(RestSkipper&) { validate(); }
	void validate() const;
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(RestSkipper, GlobalEngine,
		"Skips steps while scene and ground are at rest. One step of each stride is computed, so that motion "
		"ends the skipping. Must be the last engine. "
		"The scene is at rest when three conditions hold over the time restTime. No body was faster than "
		"speed; none was displaced by more than displacement; "
		"the largest displacement of the second half is at most growth times that of the first half, so that a "
		"house that begins to tilt is not skipped. Displacements are those of the bodies' centres in the "
		"computed steps.",
		((int, stride, 200, Attr::triggerPostLoad, "Number of steps of which one is computed at rest. [-]"))
		((Real, restTime, 1.5, Attr::triggerPostLoad, "Time over which the scene is observed before steps are "
			"skipped. [s]"))
		((Real, speed, 1e-3, Attr::triggerPostLoad, "Largest speed of a body at rest, plus its angular "
			"velocity times 1 m. [m/s]"))
		((Real, displacement, 1e-5, Attr::triggerPostLoad, "Largest displacement of a body's centre at rest. "
			"[m]"))
		((Real, growth, 1.5, Attr::triggerPostLoad, "Largest ratio of the displacement in the second half of "
			"restTime to that in the first half at rest. [-]"))
		((Real, groundThreshold, 1e-2, Attr::triggerPostLoad, "Largest ground acceleration that counts as "
			"rest: 1 gal, about the threshold of perception. [m/s2]"))
		((long, last, 0, , "Step that is always computed, if > 0. [-]"))
		((Real, skipped, 0, Attr::readonly, "Simulated time skipped so far. [s]"))
		((long, observedStrides, 0, Attr::hidden, "Strides since the start of the observation. [-]"))
		((vector<Vector3r>, startPositions, , Attr::hidden, "Positions of the bodies at the start of the "
			"observation, by id. [m]"))
		((vector<Vector3r>, middlePositions, , Attr::hidden, "Positions after the first half of restTime. [m]"))
		((Real, firstHalfDisplacement, 0, Attr::hidden, "Largest displacement of a body between the two. "
			"[m]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(RestSkipper);

} // namespace yade

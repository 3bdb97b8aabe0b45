// SPDX-License-Identifier: GPL-2.0-or-later
/// Time in which nothing happens costs nothing.
#pragma once
#include <pch.hpp>

namespace yade {

class RestSkipper : public GlobalEngine {
	vector<Vector3r> places() const;
	Real fastest() const;
	Real farthest(const vector<Vector3r>& from) const;
	long grainsOfHalf() const;
	void watchAnew();
	void watch();
	bool resting() const;
	bool groundIsQuiet() const;
	bool mayGoOn() const;

public:
	void postLoad(RestSkipper&);
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(RestSkipper, GlobalEngine,
		"Moves the time on by a whole grain of steps where the scene rests and the ground is quiet. Must be the last engine. One step in each grain is computed, so that whatever stirs is seen. "
		"The scene rests when for the time `hold` no body was faster than `speed` or went by more than `way`, and the ways of the second half are not longer than those of the first by more than `growth`: a house that begins to tilt is not skipped. Ways are those of the bodies' centres in the steps that are computed.",
		((int, grain, 250, Attr::triggerPostLoad, "Steps that are skipped at a time, less the computed one. [-]"))
		((Real, hold, 1.5, , "Time that the scene must have rested. [s]"))
		((Real, speed, 1e-3, , "Largest speed of a body at rest, that of its turning taken at 1 m. [m/s]"))
		((Real, way, 1e-5, , "Largest motion of a body's centre at rest. [m]"))
		((Real, growth, 1.5, , "The scene does not rest when the longest way since the first half of `hold` is longer than that in the first half by this factor. [-]"))
		((Real, quiet, 1e-2, , "Ground accelerations below this do not wake a scene at rest: 1 gal, about what people begin to feel. [m/s2]"))
		((long, last, 0, , "Step that is never skipped over, if > 0. [-]"))
		((Real, skipped, 0, Attr::readonly, "Simulated time that was skipped so far. [s]"))
		((long, watched, 0, Attr::hidden, "Grains since the scene is watched. [-]"))
		((vector<Vector3r>, start, , Attr::hidden, "Positions of the bodies when the watch began, by id. [m]"))
		((vector<Vector3r>, middle, , Attr::hidden, "The same half of `hold` later. [m]"))
		((Real, early, 0, Attr::hidden, "Longest way of a body between the two. [m]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(RestSkipper);

} // namespace yade

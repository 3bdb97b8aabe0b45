// SPDX-License-Identifier: GPL-2.0-or-later
/// Time in which nothing happens costs nothing.
#pragma once
#include <pch.hpp>

namespace yade {

class RestSkipper : public GlobalEngine {
	Real fastest() const;
	Real farthest() const;
	void watchAnew();
	bool resting() const;
	bool groundIsQuiet() const;
	bool mayGoOn() const;

public:
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(RestSkipper, GlobalEngine,
		"Moves the time on by a whole grain of steps where the scene rests and the ground is quiet. Must be the last engine. One step in each grain is computed, so that whatever stirs is seen. "
		"The scene rests when for the time `hold` no body was faster than `speed` or moved by more than `way`, and the fastest did not become faster: a house that begins to tilt is not skipped.",
		((int, grain, 250, , "Steps that are skipped at a time, less the computed one. [-]"))
		((Real, hold, 3, , "Time that the scene must have rested. [s]"))
		((Real, speed, 1e-3, , "Largest speed of a body at rest, that of its turning taken at 1 m. [m/s]"))
		((Real, way, 1e-5, , "Largest motion of a body's centre at rest. [m]"))
		((Real, growth, 1.5, , "The scene does not rest when the fastest speed of the second half of `hold` is larger than that of the first by this factor. [-]"))
		((Real, quiet, 1e-2, , "Ground accelerations below this do not wake a scene at rest: 1 gal, about what people begin to feel. [m/s2]"))
		((long, last, 0, , "Step that is never skipped over, if > 0. [-]"))
		((Real, skipped, 0, Attr::readonly, "Simulated time that was skipped so far. [s]"))
		((vector<Vector3r>, places, , Attr::hidden, "Positions of the bodies since when they are watched, by id. [m]"))
		((vector<Real>, speeds, , Attr::hidden, "Fastest speeds seen, one a grain, over the time `hold`. [m/s]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(RestSkipper);

} // namespace yade

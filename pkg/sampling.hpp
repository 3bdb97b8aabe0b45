// SPDX-License-Identifier: GPL-2.0-or-later
/// Rule of the engines that sample a scene at an interval.
#pragma once
#include <pch.hpp>

namespace yade {

/// Whether a sample is due: at the multiples of the interval, to half a step. If so, `next` becomes the time of the
/// following sample.
/// next: simulated time of the next sample [s]; interval: between samples, 0 for each step [s]
inline bool isSampleDue(const Scene& scene, Real interval, Real& next)
{
	if (next > scene.time + interval + scene.dt) next = scene.time; // O.resetTime()
	if (scene.time < next - scene.dt / 2) return false;
	next = interval > 0 ? (math::floor((scene.time + scene.dt / 2) / interval) + 1) * interval : scene.time;
	return true;
}

} // namespace yade

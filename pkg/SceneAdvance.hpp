// SPDX-License-Identifier: GPL-2.0-or-later
/// Several independent scenes of one process, computed one after the other for many steps each: a scene's data stay in
/// the processor's cache.
#pragma once
#include <pch.hpp>

namespace yade {

/// Makes `next` YADE's current scene and returns the previous one. setScene() is inline and would assume Omega's
/// layout, so the reference that getScene() returns is used.
shared_ptr<Scene> swapScene(const shared_ptr<Scene>& next);

/// Advances each scene to a step of its own, on all threads. scenes: list of Scene; steps: list of int; idle: an empty
/// Scene, YADE's current one meanwhile, because some of YADE's functions read the current scene. The first step of a
/// scene must have been made while it was the current one.
/// Returns a list of (wall time [s], message of the error that ended the scene's steps or "").
boost::python::list advanceScenes(
        const boost::python::list& scenes, const boost::python::list& steps, const shared_ptr<Scene>& idle);

} // namespace yade

// SPDX-License-Identifier: GPL-2.0-or-later
/// Checks of a scene before a step. Errors in YADE's contact loop end the process, so they have to be found before it
/// runs.
#pragma once
#include <pch.hpp>

namespace yade {

/// Largest step for joints, over the stability limit of explicit springs. Stiff joints are implicit and stay stable at
/// 47 times that limit. [-]
constexpr Real jointStepFactor = 20;

/// The list of engines is complete, without duplicates and in order. Throws std::runtime_error.
void checkEngines(const Scene&);

/// Each pair of shapes, materials and contact laws that can occur has a functor. Throws std::runtime_error.
void checkContacts(const Scene&);

/// The time step is finite and not too large for contacts under gravity and for joints. Throws std::runtime_error.
void checkStep(const Scene&);

/// Addresses of the live engines, also of those inside others, of the dispatchers of loop and collider, and of their
/// functors, in order.
/// parts: out.
void findParts(const Scene&, std::vector<const void*>& parts);

/// Shape, material, state and mass of a body are those that the package's engines can deal with. Throws
/// std::runtime_error.
void checkBody(const Body&);

} // namespace yade

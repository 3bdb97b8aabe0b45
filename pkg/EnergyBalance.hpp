// SPDX-License-Identifier: GPL-2.0-or-later
/// Energy balance of a scene.
#pragma once
#include <pch.hpp>

namespace yade {

class ContactForces;
class GroundMotionEngine;
class JointEngine;

/// Scene and the engines that store energies, also those that are switched off; null if there is none.
struct EnergySources {
	const Scene& scene;
	const ContactForces* contacts;
	const JointEngine* joints;
	const GroundMotionEngine* motion;
};
EnergySources energySources(const Scene&);

/// A term of the energy balance after a whole step, see ``yade_timber.energy``.
struct EnergyTerm {
	const char* name;
	Real (*value)(const EnergySources&); ///< [J]
};
extern const std::vector<EnergyTerm> energyTerms;

/// Energy that contacts and joints have returned beyond what they had stored, so far. [J]
Real createdEnergy(const Scene&);
/// Kinetic, elastic and dissipated energy: what was put into the scene. [J]
Real energyTurnover(const Scene&);

/// Of the current scene: before its first step, an engine of a loaded scene points to the previous one.
boost::python::dict pyEnergy();
double pyCreatedEnergy();

} // namespace yade

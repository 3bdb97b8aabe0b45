// SPDX-License-Identifier: GPL-2.0-or-later
/// Quantities of a structure: momenta of its parts, from which storey shears and floor accelerations follow, and the
/// peaks of its joints.
#pragma once
#include <JointEngine.hpp>

namespace yade {

class StructureMonitor : public GlobalEngine {
	void recordMomenta();
	void recordJoint(const TimberJoint&, const timber::JointForce&, size_t k);
	void recordJoints();

public:
	void postLoad(StructureMonitor&) { validate(); }
	void validate() const;
	void action() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(StructureMonitor, GlobalEngine,
		"Samples the momentum of parts of the scene, each a set of bodies, and keeps the largest forces and "
		"openings of all joints. It changes no motion.",
		((Real, interval, 0.01, Attr::triggerPostLoad, "Simulated time between samples of the momenta; 0: "
			"every step. [s]"))
		((Real, jointInterval, 0.002, Attr::triggerPostLoad, "Simulated time between evaluations of the "
			"joints; 0: every step. [s]"))
		((vector<int>, bodies, , Attr::triggerPostLoad, "Ids of the bodies of all parts. [-]"))
		((vector<int>, parts, , Attr::triggerPostLoad, "Part of each of these bodies, from 0. [-]"))
		((vector<Real>, pull, , , "Largest tension of each joint so far, the normal component of the sum of "
			"its spring forces; none of a wall. [N]"))
		((vector<Real>, shear, , , "Largest shear of each joint so far, the tangential component of that sum; "
			"of a wall the force in its plane. [N]"))
		((vector<Real>, load, , , "Largest load of each joint so far (TimberJoint.load). [-]"))
		((vector<Real>, opening, , , "Largest separation of the two bodies of each joint so far, along the "
			"joint's normal in the mean of the springs' ends. [m]"))
		((Real, nextSample, 0, Attr::readonly, "Simulated time of the next sample of the momenta. [s]"))
		((Real, nextJoints, 0, Attr::readonly, "Simulated time of the next evaluation of the joints. [s]"))
		((vector<Real>, rows, , , "Samples, one after the other: time [s], then the momentum of each part, "
			"east, north, up. [kg m/s]")),
		,
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(StructureMonitor);

} // namespace yade

// SPDX-License-Identifier: GPL-2.0-or-later
/// Samples of a run: displacements and momenta of groups of bodies, axes of members, breaks, energies, and the peaks
/// of the joints. It knows no limits: timber_houses/recording/judge.py judges the samples.
#pragma once
#include <JointEngine.hpp>

namespace yade {

class Sampler : public GlobalEngine {
	void recordRow();
	void recordGroups();
	void recordAxes();
	void recordJoint(const timber::JointEntry&, size_t k);
	void recordJoints();

public:
	void postLoad(Sampler&) { validate(); }
	void validate() const;
	void action() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(Sampler, GlobalEngine,
		"Samples groups of bodies, axes of members, broken joints and energies at an interval, and keeps the largest "
		"forces and openings of all joints. It changes no motion and must come after the integrator. Energies are "
		"those at the half step to which the velocities belong: elastic energies of the last placement are "
		"extrapolated with their rate.",
		((Real, interval, 0.01, Attr::triggerPostLoad, "Simulated time between samples; 0: every step. [s]"))
		((Real, jointInterval, 0.002, Attr::triggerPostLoad, "Simulated time between evaluations of the "
			"joints; 0: every step. [s]"))
		((vector<int>, bodies, , Attr::triggerPostLoad, "Ids of the bodies of all groups. A body may belong to "
			"several groups. [-]"))
		((vector<int>, groups, , Attr::triggerPostLoad, "Group of each of these bodies, from 0. [-]"))
		((vector<int>, members, , , "Ids of the members whose axes are sampled; they stand vertically at the "
			"start. [-]"))
		((vector<Real>, pull, , , "Largest tension of each joint so far, the normal component of the sum of "
			"its spring forces; none of a wall. [N]"))
		((vector<Real>, shear, , , "Largest shear of each joint so far, the tangential component of that sum; "
			"of a wall the force in its plane. [N]"))
		((vector<Real>, load, , , "Largest load of each joint so far (TimberJoint.load). [-]"))
		((vector<Real>, opening, , , "Largest separation of the two bodies of each joint so far, along the "
			"joint's normal in the mean of the springs' ends. [m]"))
		((Real, nextSample, 0, Attr::readonly, "Simulated time of the next sample. [s]"))
		((Real, nextJoints, 0, Attr::readonly, "Simulated time of the next evaluation of the joints. [s]"))
		((vector<Real>, rows, , , "Samples, one after the other, in the order of columns(). Displacements of "
			"groups are those of their centres of mass since the start, NaN without a body. [-]"))
		((vector<Real>, axes, , , "Axes of the members at the samples, one after the other: unit vectors, east, "
			"north, up; NaN for a member without a joint that has a spring left. [-]")),
		,
		.def("columns", &Sampler::pyColumns, "Names of the columns of rows, with units. [-]")
		.def("take", &Sampler::pyTake, "Takes the samples out: rows and axes as bytes of float64. [-]")
		.def("peaks", &Sampler::pyPeaks, "load, pull, shear and opening, one after the other, as bytes of float64. [-]")
	);
	// clang-format on
	boost::python::list pyColumns() const;
	boost::python::tuple pyTake();
	boost::python::object pyPeaks() const;
};
REGISTER_SERIALIZABLE(Sampler);

} // namespace yade

// SPDX-License-Identifier: GPL-2.0-or-later
/// History of a run: storey drift, breaks, energies.
#pragma once
#include <pch.hpp>

namespace yade {

class HouseMonitor : public GlobalEngine {
	/// Of the centre of mass of a level since the start. [m]
	Vector3r displacementOf(int level) const;
	void recordColumns();
	void record();

public:
	void postLoad(HouseMonitor&) { validate(); }
	void validate() const;
	void action() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(HouseMonitor, GlobalEngine,
		"Samples storey drifts, broken joints and energies at an interval. Drift of a storey is the "
		"horizontal displacement of the level above it minus that of the level below, over the storey's "
		"height. A level's displacement is that of the centre of mass of its bodies. Drifts at columns are the horizontal "
		"displacements of their heads relative to their feet, over their length. "
		"Must come after the integrator. Energies are those at the half step to which the velocities belong: "
		"elastic energies of the last placement are extrapolated with their rate.",
		((Real, interval, 0.01, Attr::triggerPostLoad, "Simulated time between samples; 0: every step. [s]"))
		((vector<Real>, heights, , Attr::triggerPostLoad, "Height of each storey: its drift is a displacement "
			"over this height. [m]"))
		((vector<int>, bodies, , Attr::triggerPostLoad, "Ids of the bodies that mark levels. [-]"))
		((vector<int>, levels, , Attr::triggerPostLoad, "Level of each of these bodies: 1 is the top of the "
			"first storey; level 0 is the ground, which does not move. [-]"))
		((Real, tiltDrift, std::numeric_limits<Real>::infinity(), Attr::triggerPostLoad, "Drift at which a storey "
			"counts as tilted. [-]"))
		((Real, fallDrop, std::numeric_limits<Real>::infinity(), Attr::triggerPostLoad, "Drop at which a level "
			"counts as collapsed, over the height of its storey. [-]"))
		((Real, fallenAngle, std::numeric_limits<Real>::infinity(), Attr::triggerPostLoad, "Inclination from "
			"which a column counts as fallen. [rad]"))
		((Real, tiltTime, NaN, , "Time at which the first storey drift exceeded tiltDrift. [s]"))
		((string, tiltDirection, , , "Direction of the drift that exceeded tiltDrift first: ns or ew. [-]"))
		((Real, collapseTime, NaN, , "Time at which a level had dropped by fallDrop. [s]"))
		((vector<Real>, peak, , , "Largest drift so far: north-south and east-west of storey 1, of storey 2, "
			"... [-]"))
		((vector<int>, columnBodies, , Attr::triggerPostLoad, "Ids of the columns, which stand vertically at the "
			"start. [-]"))
		((vector<int>, columnStoreys, , Attr::triggerPostLoad, "Storey of each of these columns, from 1. [-]"))
		((vector<Real>, columnPeak, , , "Largest drift at a column so far, in the order of peak; without columns "
			"that have fallen or have no joint. [-]"))
		((vector<Real>, medianPeak, , , "Largest median of the drifts at these columns so far, in the order of "
			"peak. [-]"))
		((Real, nextSample, 0, Attr::readonly, "Simulated time of the next sample. [s]"))
		((vector<Real>, rows, , , "Samples, one after the other, in the order of columns(). [-]")),
		,
		.def("columns", &HouseMonitor::pyColumns, "Names of the columns of rows, with units. [-]")
	);
	// clang-format on
	boost::python::list pyColumns() const;
};
REGISTER_SERIALIZABLE(HouseMonitor);

} // namespace yade

// SPDX-License-Identifier: GPL-2.0-or-later
/// A breakable joint between two bodies (paper, sections 2.4 and 3.2): its attributes, their ranges and what is saved.
/// It states the parameters of a joint of a set (kernel/joint_set.hpp), which has all that a step changes.
#pragma once
#include <kernel/joint_set.hpp>
#include <pch.hpp>

namespace boost {
namespace serialization {
	template <class Archive> void serialize(Archive& ar, timber::JointModes& m, const unsigned int)
	{
		ar& make_nvp("centre", m.centre) & make_nvp("modes", m.modes) & make_nvp("frequencies", m.frequencies);
		ar& make_nvp("twists", m.twists) & make_nvp("sensitivity", m.sensitivity);
		ar& make_nvp("springs", m.state.springs) & make_nvp("normal", m.state.stiffness.normal)
		        & make_nvp("shear", m.state.stiffness.shear);
		ar& make_nvp("inverseMassA", m.state.inverseMass[0]) & make_nvp("inverseMassB", m.state.inverseMass[1]);
		ar& make_nvp("inverseInertiaA", m.state.inverseInertia[0])
		        & make_nvp("inverseInertiaB", m.state.inverseInertia[1]);
		ar& make_nvp("relative", m.state.relative) & make_nvp("opening", m.state.opening);
		ar& make_nvp("shiftSensitivity", m.shiftSensitivity);
	}
	template <class Archive> void serialize(Archive& ar, timber::WallHistory& h, const unsigned int)
	{
		ar& make_nvp("stretch", h.stretch) & make_nvp("force", h.force) & make_nvp("largest", h.largest)
		        & make_nvp("reversed", h.reversed);
	}
	template <class Archive> void serialize(Archive& ar, timber::SpringsState& s, const unsigned int)
	{
		ar& make_nvp("broken", s.broken) & make_nvp("stretches", s.stretches) & make_nvp("forces", s.forces);
		ar& make_nvp("plastic", s.plastic) & make_nvp("largest", s.largest) & make_nvp("wall", s.wall);
		ar& make_nvp("half", s.half) & make_nvp("account", s.account) & make_nvp("modes", s.modes);
	}
}
}

namespace yade {

class TimberJoint : public Serializable {
	/// Its own until a JointEngine takes the joint into its set.
	shared_ptr<timber::JointSet> set { new timber::JointSet };
	size_t index = 0; ///< in the set

	timber::JointEntry& entry() const { return set->joints[index]; }
	timber::JointSprings springs() const { return set->springs(entry()); }
	timber::SpringsState takeState();
	void validateLaw() const;
	void validateWall() const;
	void validateEnvelope() const;
	/// Of a spring in the joint's stiffness and strength.
	Real share() const { return perJoint ? Real(1) / anchors1.size() : 1; }
	/// Points of the envelope, with a share of its forces.
	std::vector<timber::BackbonePoint> envelopePoints(Real share) const;
	/// Backbone of a spring that yields; perJoint: with its share of the joint's strength.
	std::vector<timber::BackbonePoint> backbone() const;
	/// Law of a wall with a share of its forces.
	timber::WallCycles wallCycles(Real share) const;
	timber::JointEntry parameters() const;

public:
	void preSave(TimberJoint&) { saved = set->state(entry()); }
	void postSave(TimberJoint&) { saved = {}; }
	void postLoad(TimberJoint&);
	/// springs: number of those that are known to be broken or not
	void validate(size_t springs) const;
	bool yields() const { return law != "brittle"; }
	bool isBroken() const { return entry().isBroken(); }
	vector<int> areBroken() const { return springs().broken(); }
	void setBroken(const vector<int>&);
	vector<Vector3r> springForces() const { return springs().all(&timber::JointSprings::force); }
	vector<Vector3r> springStretches() const { return springs().all(&timber::JointSprings::stretch); }
	vector<Vector3r> plastic() const { return set->state(entry()).plastic; }
	vector<Real> largest() const { return set->state(entry()).largest; }
	Real account() const { return entry().account; }
	Real load() const { return set->load(entry()); }
	boost::python::list pySprings() const;
	boost::python::list pyWallHistories() const;
	boost::python::dict pyDictCustom() const override;
	/// Appends the joint to a set, which has it from then on.
	void moveTo(const shared_ptr<timber::JointSet>&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(TimberJoint, Serializable, "Springs between two bodies, each anchored in "
		"both (paper, section 4: at the four corners of the contact area). It acts beside contact.",
		((Body::id_t, id1, -1, Attr::triggerPostLoad, "First body. [-]"))
		((Body::id_t, id2, -1, Attr::triggerPostLoad, "Second body. [-]"))
		((vector<Vector3r>, anchors1, , Attr::triggerPostLoad, "Ends of the springs in the frame of body 1. "
			"[m]"))
		((vector<Vector3r>, anchors2, , Attr::triggerPostLoad, "Ends of the springs in the frame of body 2. "
			"[m]"))
		((Vector3r, normal, Vector3r(0, 0, 1), Attr::triggerPostLoad, "Unit normal of the contact area in the "
			"frame of body 1, towards body 2. [-]"))
		((Real, kn, NaN, Attr::triggerPostLoad, "Normal stiffness, of each spring or of the whole joint, see "
			"perJoint. [N/m] (paper, Table 1)"))
		((Real, ks, NaN, Attr::triggerPostLoad, "Tangential stiffness, of each spring or of the whole joint; "
			"0: the springs act along the normal only. Law slip: that of kn, or 0. [N/m] (paper, Table 1)"))
		((Real, strength, NaN, Attr::triggerPostLoad, "P_max, of each spring or of the whole joint; law slip: "
			"the yield force. [N] (paper, section 3.2)"))
		((bool, perJoint, false, Attr::triggerPostLoad, "Whether stiffness and strength are those of the "
			"joint: the springs share the stiffness equally, and all break when the sum of their forces "
			"exceeds the strength. With the law slip they share the strength as well, yield and break one "
			"by one. [-]"))
		((string, law, "brittle", Attr::triggerPostLoad, "brittle: elastic to the strength; slip: yields at "
			"the strength, slips in cycles and loses its strength between softeningStretch and "
			"ultimateStretch, or follows envelope; wall: follows envelope along the normal, with the "
			"cycles of tested walls. [-]"))
		((Real, frictionShare, 0, Attr::triggerPostLoad, "Law slip: share of stiffness and strength that is "
			"elastic-perfectly plastic; the rest slips. [-]"))
		((Real, softeningStretch, std::numeric_limits<Real>::infinity(), Attr::triggerPostLoad, "Law slip: "
			"stretch of a spring beyond which its strength falls. [m]"))
		((Real, ultimateStretch, std::numeric_limits<Real>::infinity(), Attr::triggerPostLoad, "Law slip: "
			"stretch of a spring at which its strength is zero and it breaks. [m]"))
		((vector<Vector2r>, envelope, , Attr::triggerPostLoad, "Laws slip and wall: points (stretch, force) of "
			"the first loading of each spring or of the whole joint, see perJoint. The stretches ascend, "
			"the largest force is the strength, and no line is steeper than kn. Law slip: in place of "
			"softeningStretch and ultimateStretch, the last force is 0; empty: yields at the strength, "
			"which falls from softeningStretch to ultimateStretch. Law wall: a last force above 0 "
			"remains. [m, N]"))
		((Real, frictionForce, 0, Attr::triggerPostLoad, "Law wall: force at zero stretch after yielding, of "
			"each spring or of the whole joint. [N]"))
		((Real, pinchedStiffness, 0, Attr::triggerPostLoad, "Law wall: stiffness within the slack, likewise. "
			"[N/m]"))
		((Real, reloadTarget, 1, Attr::triggerPostLoad, "Law wall: stretch at which reloading meets the "
			"envelope, over the largest one so far. [-]"))
		((Real, reloadShare, 0, Attr::triggerPostLoad, "Law wall: share of the slack from which it reloads, "
			"unless reloadStiffness says otherwise. [-]"))
		((Real, reloadStiffness, 0, Attr::triggerPostLoad, "Law wall: k0 in the stiffness of reloading, k0 "
			"(reloadStretch / target)^reloadPower, of each spring or of the whole joint; 0: reloadShare "
			"says where it begins. [N/m]"))
		((Real, reloadStretch, 0, Attr::triggerPostLoad, "Law wall: see reloadStiffness. [m]"))
		((Real, reloadPower, 0, Attr::triggerPostLoad, "Law wall: see reloadStiffness. [-]"))
		((Real, dampingRatio, 0, Attr::triggerPostLoad, "Damping ratio of each vibration mode of the two "
			"bodies, if they were connected by the unbroken springs and free otherwise, in [0, 1]. [-]"))
		((Real, dampingTime, 0, Attr::triggerPostLoad, "Damping coefficient of the dashpots at the springs over "
			"their tangent stiffness, of a house that which gives its sway the stated damping ratio. [s]"))
		((bool, initialDamping, false, Attr::triggerPostLoad, "Whether dashpots keep the initial stiffness of "
			"unbroken springs that have yielded, in place of the tangent stiffness. [-]"))
		((string, kind, , , "Kind of the joint: column_beam, brace_beam, ... [-]"))
		((string, name, , , "Name of the joint, for reports. [-]"))
		((timber::SpringsState, saved, , Attr::hidden, "State while the scene is saved and loaded. [-]"))
		((vector<int>, broken, , Attr::hidden | Attr::noSave, "Of an update of attributes. [-]"))
		((vector<Vector3r>, forces, , Attr::hidden | Attr::noSave, "Likewise. [N]"))
		((vector<Vector3r>, stretches, , Attr::hidden | Attr::noSave, "Likewise. [m]"))
		((vector<Vector3r>, plasticStretches, , Attr::hidden | Attr::noSave, "Likewise. [m]"))
		((vector<Real>, largestStretches, , Attr::hidden | Attr::noSave, "Likewise. [m]")),
		set->joints.resize(1),
		.add_property("broken", &TimberJoint::areBroken, &TimberJoint::setBroken, "1 for each broken spring, "
			"else 0. [-] :yattrtype:`vector<int>`")
		.add_property("forces", &TimberJoint::springForces, "Force of each spring on body 1 in the last step, "
			"world frame. [N]")
		.add_property("stretches", &TimberJoint::springStretches, "From the end in body 1 to the end in body 2 "
			"of each spring in the last step, world frame. [m]")
		.add_property("plasticStretches", &TimberJoint::plastic, "Law slip: plastic stretch of each spring, "
			"frame of body 1. [m]")
		.add_property("largestStretches", &TimberJoint::largest, "Law slip: largest length of each spring's "
			"stretch so far. [m]")
		.add_property("storedEnergy", &TimberJoint::account, "Energy that the springs of a stiff joint can "
			"return. [J]")
		.add_property("springs", &TimberJoint::pySprings, "List of dictionaries: force on body 1 [N], stretch "
			"[m], broken.")
		.add_property("cycles", &TimberJoint::pyWallHistories, "Law wall: list of dictionaries, one of each "
			"spring: stretch [m] and force [N] of the last step along the normal, largest stretches of both "
			"sides [m], and those from which it reloads [m].")
		.add_property("isBroken", &TimberJoint::isBroken, "Whether all springs are broken. [-]")
		.add_property("load", &TimberJoint::load, "Largest spring force over the strength; perJoint: sum of "
			"the spring forces over the strength. A spring of the law slip that has yielded carries less "
			"than its strength once it softens. [-]")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(TimberJoint);

} // namespace yade

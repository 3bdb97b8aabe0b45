// SPDX-License-Identifier: GPL-2.0-or-later
/// A breakable joint between two bodies (paper, sections 2.4 and 3.2): its attributes, their ranges and what is saved.
/// JointEngine computes it.
#pragma once
#include <kernel/joint_modes.hpp>
#include <kernel/packed_joints.hpp>
#include <kernel/slip_law.hpp>
#include <kernel/wall_springs.hpp>
#include <pch.hpp>

namespace boost {
namespace serialization {
	template <class Archive> void serialize(Archive& ar, timber::JointModes& m, const unsigned int)
	{
		ar& make_nvp("centre", m.centre) & make_nvp("modes", m.modes) & make_nvp("frequencies", m.frequencies);
		ar& make_nvp("twists", m.twists) & make_nvp("sensitivity", m.sensitivity);
		ar& make_nvp("springs", m.state.springs) & make_nvp("normal", m.state.stiffness.normal)
		        & make_nvp("shear", m.state.stiffness.shear);
		ar& make_nvp("pairInverseMass", m.state.pairInverseMass)
		        & make_nvp("inverseInertia", m.state.inverseInertia);
		ar& make_nvp("relative", m.state.relative);
	}
	template <class Archive> void serialize(Archive& ar, timber::WallHistory& h, const unsigned int)
	{
		ar& make_nvp("stretch", h.stretch) & make_nvp("force", h.force) & make_nvp("largest", h.largest)
		        & make_nvp("reversed", h.reversed);
	}
}
}

namespace yade {

class TimberJoint : public Serializable {
	bool isRead = false; ///< attributes were read or set: those set later decide about the modes
	bool isSlip = false; ///< law == "slip": a comparison of strings for each joint and step takes 2 % of a step
	bool isWall = false; ///< law == "wall"
	timber::SlipLaw slip; ///< of a spring, from the attributes
	timber::WallLaw wall; ///< likewise
	/// Of the engine: they have the springs' stretches and forces of the last step. Null: the attributes have them,
	/// and may have been changed.
	shared_ptr<timber::PackedJoints> packed;
	size_t index = 0; ///< in `packed`
	size_t intact = 0; ///< number of unbroken springs
	Vector3r mean1 = Vector3r::Zero(), mean2 = Vector3r::Zero(); ///< of the anchors [m]

	struct SpringVectors {
		vector<Vector3r> stretches, forces;
	};
	/// Whether `packed` has stretches and forces.
	bool isPacked() const { return packed && !yields() && !isStiff(); }
	/// In the last step.
	SpringVectors lastSprings() const;
	/// Sets the attributes to those of the last step.
	void storeSprings();
	timber::WallSprings wallSprings() { return { wall, normal, wallHistories }; }
	timber::SlipSprings slipSprings() { return { slip, axis(), { plasticStretches, largestStretches } }; }
	/// Of a spring in the joint's stiffness and strength.
	Real share() const { return perJoint ? Real(1) / anchors1.size() : 1; }

public:
	void preSave(TimberJoint&) { storeSprings(); }
	void postLoad(TimberJoint&);
	void validate() const;
	void validateLaw() const;
	void validateWall() const;
	void validateEnvelope() const;
	/// Stiffness of a spring; perJoint: its share of the joint's stiffness.
	timber::JointStiffness stiffness() const { return { share() * kn, share() * ks }; }
	/// Mean of the springs' ends, in the frame of each body. [m]
	const Vector3r& centre1() const { return mean1; }
	const Vector3r& centre2() const { return mean2; }
	size_t intactSprings() const { return intact; }
	bool isBroken() const { return intact == 0; }
	bool isDamped() const { return dampingRatio > 0 || dampingTime > 0; }
	/// Dashpots at a tangent stiffness of the unbroken springs over their initial one. [-]
	timber::JointDamping damping(Real tangent) const
	{
		return { dampingRatio, dampingTime, initialDamping ? 1 : tangent };
	}
	/// Largest spring force over the strength; perJoint: sum of the spring forces over the strength. [-]
	Real load() const;
	/// Of a joint with these forces.
	Real loadOf(const timber::JointForce&) const;
	vector<Vector3r> springForces() const { return lastSprings().forces; }
	vector<Vector3r> springStretches() const { return lastSprings().stretches; }
	boost::python::list pySprings() const;
	boost::python::dict pyDictCustom() const override;
	/// Appends the joint to packed joints, which have its forces and stretches from then on.
	void pack(const shared_ptr<timber::PackedJoints>&);
	timber::JointStrength jointStrength() const { return { strength, perJoint }; }
	/// With the stretches and forces of the last step. For the thread that computes the steps: others must not
	/// write them.
	timber::JointSprings springs();
	bool yields() const { return isSlip || isWall; }
	/// Points of the envelope, with a share of its forces.
	std::vector<timber::BackbonePoint> envelopePoints(Real share) const;
	/// Backbone of a spring that yields; perJoint: with its share of the joint's strength.
	std::vector<timber::BackbonePoint> backbone() const;
	/// Whether a single unbroken spring acts along the normal.
	bool isAxial() const { return ks == 0 && intact == 1; }
	/// Of springs that yield along the normal only (ks = 0), else zero. [-]
	Vector3r axis() const { return ks == 0 ? normal : Vector3r::Zero(); }
	/// Forces and new histories of springs that yield.
	timber::JointForce yield(const timber::JointPlacement&);
	/// Springs that yield and have no strength left. axes1: rotation matrix of body 1
	std::vector<timber::SpringBreak> spentSprings(const Matrix3r& axes1);
	/// Law of a wall with a share of its forces.
	timber::WallCycles wallCycles(Real share) const;
	boost::python::list pyWallHistories() const;
	timber::SpringGroup springGroup() const { return { anchors1, broken, stiffness(), normal }; }
	void breakSpring(size_t spring);
	void breakAll();
	/// Law of the springs in the contact solver. Valid until an attribute is set.
	std::unique_ptr<timber::SpringLaw> springLaw();
	/// Whether the contact solver moves the springs: the step does not resolve them.
	bool isStiff() const { return !halfStretches.empty(); }
	/// From this step on the contact solver moves the springs.
	void stiffen();
	/// From the next step on JointEngine moves the springs.
	void soften();

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
		((vector<int>, broken, , Attr::triggerPostLoad, "1 for each broken spring, else 0. [-]"))
		((vector<Vector3r>, forces, , Attr::hidden, "Force of each spring when the scene was saved. [N]"))
		((vector<Vector3r>, stretches, , Attr::hidden, "Stretch of each spring when the scene was saved. [m]"))
		((vector<Vector3r>, plasticStretches, , Attr::readonly, "Law slip: plastic stretch of each spring, "
			"frame of body 1. [m]"))
		((vector<Real>, largestStretches, , Attr::readonly, "Law slip: largest length of each spring's stretch "
			"so far. [m]"))
		((vector<timber::WallHistory>, wallHistories, , Attr::hidden, "Law wall: history of each spring. "
			"[m, N]"))
		((Real, storedEnergy, 0, Attr::readonly, "Energy that the springs of a stiff joint can return. [J]"))
		((vector<Vector3r>, halfStretches, , Attr::hidden, "Stretches of a stiff joint in the middle between "
			"the last placement and the next one, frame of body 1; empty: not stiff. [m]"))
		((timber::JointModes, modes, , Attr::hidden, "Vibration modes of a damped joint. [-]")),
		,
		.add_property("forces", &TimberJoint::springForces, "Force of each spring on body 1 in the last step, "
			"world frame. [N]")
		.add_property("stretches", &TimberJoint::springStretches, "From the end in body 1 to the end in body 2 "
			"of each spring in the last step, world frame. [m]")
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

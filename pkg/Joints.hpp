// SPDX-License-Identifier: GPL-2.0-or-later
/// Breakable joints between two bodies (paper, sections 2.4 and 3.2). The law and the rule of breaking: kernel/joint_law.hpp.
#pragma once
#include <bodies.hpp>
#include <kernel/joint_dashpot.hpp>
#include <kernel/stability.hpp>

namespace boost {
namespace serialization {
	template <class Archive> void serialize(Archive& ar, timber::JointModes& m, const unsigned int)
	{
		ar& make_nvp("centre", m.centre) & make_nvp("modes", m.modes) & make_nvp("frequencies", m.frequencies) & make_nvp("springs", m.springs);
		ar& make_nvp("normal", m.stiffness.normal) & make_nvp("shear", m.stiffness.shear) & make_nvp("pairInverseMass", m.pairInverseMass);
	}
}
}

namespace yade {

class TimberJoint : public Serializable {
public:
	void postLoad(TimberJoint&);
	void validate() const;
	/// Stiffness of a spring; perJoint: its share of the joint's stiffness.
	timber::JointStiffness stiffness() const;
	bool isBroken() const { return std::find(broken.begin(), broken.end(), 0) == broken.end(); }
	/// Largest spring force over the strength; perJoint: sum of the spring forces over the strength. [-]
	Real load() const;
	boost::python::list pySprings() const;
	timber::JointStrength jointStrength() const { return { strength, perJoint }; }
	timber::JointSprings springs() { return { anchors1, anchors2, broken, stretches, forces }; }
	void breakSpring(size_t spring);
	void breakAll();

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(TimberJoint, Serializable, "Springs between two bodies, each anchored in both (paper, section 4: at the four corners of the contact area). It acts beside contact.",
		((Body::id_t, id1, -1, , "First body. [-]"))
		((Body::id_t, id2, -1, , "Second body. [-]"))
		((vector<Vector3r>, anchors1, , Attr::triggerPostLoad, "Ends of the springs in the frame of body 1. [m]"))
		((vector<Vector3r>, anchors2, , Attr::triggerPostLoad, "Ends of the springs in the frame of body 2. [m]"))
		((Vector3r, normal, Vector3r(0, 0, 1), Attr::triggerPostLoad, "Unit normal of the contact area in the frame of body 1, towards body 2. [-]"))
		((Real, kn, NaN, Attr::triggerPostLoad, "Normal stiffness, of each spring or of the whole joint, see perJoint. [N/m] (paper, Table 1)"))
		((Real, ks, NaN, Attr::triggerPostLoad, "Tangential stiffness, of each spring or of the whole joint. [N/m] (paper, Table 1)"))
		((Real, strength, NaN, Attr::triggerPostLoad, "P_max, of each spring or of the whole joint. [N] (paper, section 3.2)"))
		((bool, perJoint, false, , "Whether stiffness and strength are those of the joint: the springs share the stiffness equally, and all break when the sum of their forces exceeds the strength. [-]"))
		((Real, dampingRatio, 0, Attr::triggerPostLoad, "Damping ratio of each vibration mode of the two bodies, if they were connected by the unbroken springs and free otherwise, in [0, 1]. [-]"))
		((string, kind, , , "Kind of the joint: column_beam, brace_beam, ... [-]"))
		((string, name, , , "Name of the joint, for reports. [-]"))
		((vector<int>, broken, , Attr::triggerPostLoad, "1 for each broken spring, else 0. [-]"))
		((vector<Vector3r>, forces, , Attr::readonly, "Force of each spring on body 1 in the last step, world frame. [N]"))
		((vector<Vector3r>, stretches, , Attr::readonly, "From the end in body 1 to the end in body 2 of each spring in the last step, world frame. [m]"))
		((timber::JointModes, modes, , Attr::hidden, "Vibration modes of a damped joint. [-]")),
		,
		.add_property("springs", &TimberJoint::pySprings, "List of dictionaries: force on body 1 [N], stretch [m], broken.")
		.add_property("isBroken", &TimberJoint::isBroken, "Whether all springs are broken. [-]")
		.add_property("load", &TimberJoint::load, "Largest spring force over the strength; perJoint: sum of the spring forces over the strength. [-]")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(TimberJoint);

class JointBreak : public Serializable {
public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(JointBreak, Serializable, "A spring that broke.",
		((Real, time, NaN, , "Simulated time. [s]"))
		((int, joint, -1, , "Index of the joint in the engine. [-]"))
		((int, spring, -1, , "Index of the spring in the joint. [-]"))
		((string, cause, , , "tension, compression or shear. [-]"))
		((Real, force, NaN, , "Force of the spring when it broke. [N]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(JointBreak);

class JointEngine : public GlobalEngine {
	std::vector<Matrix3r> axes; ///< rotation matrices of the bodies, by id
	std::vector<timber::JointForce> jointForces; ///< of the joints' unbroken springs in this step
	BodyForces sums; ///< of the joints

	void collectAxes();
	timber::JointPlacement placement(const TimberJoint& joint, const State& s1, const State& s2) const
	{
		return { axes[joint.id1], axes[joint.id2], s2.pos - s1.pos };
	}
	timber::JointForce forceOf(TimberJoint&) const;
	void computeForces();
	void breakSprings(size_t joint);
	void breakAndSum();

public:
	void action() override;
	int append(const shared_ptr<TimberJoint>&);
	boost::python::list pyJoints() const;
	boost::python::list pyBreaks() const;
	/// Rate of change of the springs' elastic energy at the present velocities of a scene's bodies. [W]
	Real elasticPower(const Scene&) const;
	/// Adds the linearised unbroken springs, with the larger one of their two stiffnesses in all directions.
	void addSprings(const Scene&, std::vector<timber::PointSpring>&) const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(JointEngine, GlobalEngine, "Forces of all joints; a spring whose force exceeds the strength breaks and never acts again.",
		((vector<shared_ptr<TimberJoint>>, joints, , Attr::hidden, "The joints. [-]"))
		((vector<shared_ptr<JointBreak>>, breaks, , Attr::hidden, "Log of the broken springs. [-]"))
		((Real, released, 0, , "Energy stored in springs when they broke. [J]"))
		((Real, elastic, 0, , "Elastic energy of the springs at the placement of the last step. [J]")),
		,
		.def("append", &JointEngine::append, (boost::python::arg("joint")), "Adds a joint and returns its index. [-]")
		.add_property("joints", &JointEngine::pyJoints, "List of all joints. [-]")
		.add_property("breaks", &JointEngine::pyBreaks, "List of the springs that broke, in order. [-]")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(JointEngine);

} // namespace yade

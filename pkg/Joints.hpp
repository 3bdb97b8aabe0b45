// SPDX-License-Identifier: GPL-2.0-or-later
/// Breakable joints between two bodies (paper, sections 2.4 and 3.2).
#pragma once
#include <bodies.hpp>
#include <kernel/joint_law.hpp>

namespace yade {

class TimberJoint : public Serializable {
public:
	void postLoad(TimberJoint&);
	/// Of one of the springs, which share the joint's if it is per joint.
	timber::JointStiffness stiffness() const;
	bool                isFinished() const { return std::find(broken.begin(), broken.end(), 0) == broken.end(); }
	/// Largest spring force, or of a joint that acts as a whole their sum, by the strength. [-]
	Real                load() const;
	boost::python::list pySprings() const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(TimberJoint, Serializable, "Springs between two bodies, each anchored in both (paper, section 4: at the four corners of the contact area). It acts beside contact.",
		((Body::id_t, id1, -1, , "First body. [-]"))
		((Body::id_t, id2, -1, , "Second body. [-]"))
		((vector<Vector3r>, anchors1, , Attr::triggerPostLoad, "Ends of the springs in the frame of body 1. [m]"))
		((vector<Vector3r>, anchors2, , Attr::triggerPostLoad, "Ends of the springs in the frame of body 2. [m]"))
		((Vector3r, normal, Vector3r(0, 0, 1), , "Unit normal of the contact area in the frame of body 1, towards body 2. [-]"))
		((Real, kn, NaN, , "Normal stiffness, of each spring or of the whole joint, see perJoint. [N/m] (paper, Table 1)"))
		((Real, ks, NaN, , "Tangential stiffness, likewise. [N/m] (paper, Table 1)"))
		((Real, strength, NaN, , "P_max, of each spring or of the whole joint. [N] (paper, section 3.2)"))
		((bool, perJoint, false, , "Whether stiffness and strength belong to the joint: each spring has its share of the stiffness and all break when the sum of their forces exceeds the strength. [-]"))
		((string, kind, , , "Kind of the joint: column_beam, brace_beam, ... [-]"))
		((string, name, , , "Name of the joint, for reports. [-]"))
		((vector<int>, broken, , Attr::triggerPostLoad, "1 for each broken spring, else 0. [-]"))
		((vector<Vector3r>, forces, , Attr::readonly, "Force of each spring on body 1 in the last step, world frame. [N]"))
		((vector<Vector3r>, stretches, , Attr::readonly, "From the end in body 1 to the end in body 2 of each spring in the last step, world frame. [m]")),
		,
		.add_property("springs", &TimberJoint::pySprings, "List of dictionaries: force on body 1 [N], stretch [m], broken.")
		.add_property("isFinished", &TimberJoint::isFinished, "Whether all springs are broken. [-]")
		.add_property("load", &TimberJoint::load, "Largest spring force, or of a joint that acts as a whole their sum, by the strength. [-]")
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
	std::vector<Matrix3r>          axes; ///< of the bodies, by id
	std::vector<timber::JointPull> pulls; ///< of the joints in this step, by their springs that are left
	BodyForces                     sums; ///< of the joints

	void collectAxes();
	timber::JointPull pullOf(TimberJoint&) const;
	bool isOverloaded(size_t joint) const;
	void stretchAll();
	void breakSprings(size_t joint);
	void breakSpring(size_t joint, size_t spring, const State&, const State&);
	void sumPulls();

public:
	void                action() override;
	int                 append(const shared_ptr<TimberJoint>&);
	boost::python::list pyJoints() const;
	boost::python::list pyBreaks() const;
	/// Rate at which the springs' elastic energy grows with the present velocities of a scene's bodies. [W]
	Real                elasticPower(const Scene&) const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(JointEngine, GlobalEngine, "Forces of all joints; a spring whose force exceeds the strength breaks and never acts again.",
		((vector<shared_ptr<TimberJoint>>, joints, , Attr::hidden, "The joints. [-]"))
		((vector<shared_ptr<JointBreak>>, breaks, , Attr::hidden, "Log of the broken springs. [-]"))
		((Real, released, 0, , "Energy that was stored in springs when they broke. [J]"))
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

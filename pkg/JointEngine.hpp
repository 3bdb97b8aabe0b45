// SPDX-License-Identifier: GPL-2.0-or-later
/// Owner of the set of joints (kernel/joint_set.hpp): forces, breaks and energies of their springs. Brittle springs and the rule of breaking:
/// kernel/joint_law.hpp. Yielding springs: kernel/slip_law.hpp, kernel/wall_law.hpp. Joints that a step does not
/// resolve go to the contact solver (kernel/spring_step.hpp).
#pragma once
#include <TimberJoint.hpp>
#include <bodies.hpp>
#include <kernel/stability.hpp>

namespace yade {

class JointBreak : public Serializable {
public:
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(JointBreak, Serializable, "A spring that broke.",
		((Real, time, NaN, , "Simulated time. [s]"))
		((int, joint, -1, , "Index of the joint in the engine. [-]"))
		((int, spring, -1, , "Index of the spring in the joint. [-]"))
		((string, cause, , , "tension, compression or shear. [-]"))
		((Real, force, NaN, , "Force of the spring when it broke; 0 with the law slip. [N]")));
	// clang-format on
};
REGISTER_SERIALIZABLE(JointBreak);

class JointEngine : public GlobalEngine {
	struct Placement {
		Matrix3r axes; ///< rotation matrix, body to world
		Vector3r position; ///< of the centre [m]
		Vector3r velocity, spin; ///< [m/s, rad/s]
		bool exists = false;
		/// The body itself; no owner, which would have to release bodies of Python without its lock.
		boost::weak_ptr<Body> body;
		bool isOther = false; ///< than in the step before, with the same id
	};
	std::vector<Placement> bodies; ///< by id
	shared_ptr<timber::JointSet> set { new timber::JointSet }; ///< of the joints
	size_t computed = 0; ///< number of joints in the last step
	BodyForces sums; ///< of the joints

	bool hasBody(Body::id_t) const;
	void collectBodies();
	void breakReplaced();
	void softenMoved();
	void checkJoints() const;
	void takeJoints();
	timber::JointPlacement placement(const timber::JointEntry& joint) const
	{
		const Placement &a = bodies[joint.bodyA], &b = bodies[joint.bodyB];
		return { a.axes, b.axes, b.position - a.position };
	}
	timber::BodyKinematics motion(Body::id_t id) const
	{
		return { bodies[id].position, bodies[id].velocity, bodies[id].spin };
	}
	void computeForce(size_t joint);
	Real halfWork(const timber::JointEntry&) const;
	void computeForces();
	void breakSprings(size_t joint);
	void breakAndSum();

public:
	void action() override;
	void postLoad(JointEngine&) { takeJoints(); }
	/// The joints with their springs.
	timber::JointSet& jointSet() const { return *set; }
	/// Forces of the joints' springs on the bodies in the last step.
	const BodyForces& forces() const { return sums; }
	int append(const shared_ptr<TimberJoint>&);
	/// Whether an unbroken joint with the same springs between the same bodies is there.
	bool hasSame(const TimberJoint&) const;
	/// Breaks the joints of a body that is erased: another one may get its id.
	void breakJointsOf(Body::id_t);
	boost::python::list pyJoints() const;
	boost::python::list pyBreaks() const;
	/// Breaks a spring and logs it.
	void breakSpring(size_t joint, const timber::SpringBreak&);
	/// Power of the springs' forces at the present velocities of a scene's bodies, > 0 if they are stretched: the
	/// rate of change of the elastic energy. What yielding springs dissipate of it is known after the next step.
	/// [W]
	Real elasticPower(const Scene&) const;
	/// Adds the linearised unbroken springs. Those that yield have their initial stiffness, with which they unload.
	void addSprings(const Scene&, std::vector<timber::PointSpring>&) const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(JointEngine, GlobalEngine, "Forces of all joints; a brittle spring whose "
		"force exceeds the strength breaks and never acts again, a yielding one breaks at its ultimate "
		"stretch.",
		((vector<shared_ptr<TimberJoint>>, joints, , Attr::hidden, "The joints. [-]"))
		((vector<shared_ptr<JointBreak>>, breaks, , Attr::hidden, "Log of the broken springs. [-]"))
		((Real, released, 0, , "Energy stored in springs when they broke, without those that were set to broken "
			"or lost a body. [J]"))
		((Real, elastic, 0, , "Elastic energy of the springs at the placement of the last step. [J]"))
		((Real, yielded, 0, , "Energy dissipated by yielding springs. [J]"))
		((Real, created, 0, , "Energy that springs have stored and dissipated beyond the work of the bodies on "
			"them: error of explicit yielding springs, and of joints that leave the contact solver. [J]")),
		,
		.def("append", &JointEngine::append, (boost::python::arg("joint")), "Adds a joint and returns its "
			"index. [-]")
		.def("hasSame", &JointEngine::hasSame, (boost::python::arg("joint")), "Whether an unbroken joint with "
			"the same springs is there.")
		.add_property("joints", &JointEngine::pyJoints, "List of all joints. [-]")
		.add_property("breaks", &JointEngine::pyBreaks, "List of the springs that broke, in order, "
			"without those that were set to broken or lost a body. [-]")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(JointEngine);

} // namespace yade

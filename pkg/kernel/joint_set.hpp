// SPDX-License-Identifier: GPL-2.0-or-later
/// Joints with all that a step reads and changes, side by side in memory: those of an engine, or a single one that no
/// engine has yet. Adapters: TimberJoint states the parameters and shows the state, JointEngine computes the steps.
#pragma once
#include "joint_modes.hpp"
#include "slip_law.hpp"
#include "wall_law.hpp"
#include <limits>
#include <variant>

namespace timber {

/// The springs' law, with their histories if they yield.
using JointLaw = std::variant<BrittleSprings, SlipSprings, WallSprings>;

struct JointEntry {
	int bodyA = -1, bodyB = -1; ///< indices
	Vec3 normal = Vec3::UnitZ(); ///< unit, in the frame of A
	JointStiffness stiffness { 0, 0 }; ///< of each spring
	JointStrength strength { std::numeric_limits<double>::infinity(), false };
	JointDamping damping { 0 }; ///< at the initial stiffness
	bool initialDamping = false; ///< the dashpots keep it

	size_t firstGroup = 0, springs = 0; ///< its groups of lanes; number of its springs
	size_t intact = 0; ///< number of the unbroken ones
	JointForce total; ///< of the springs in the last step
	double created = 0; ///< energy that explicit springs err by in it [J]
	JointLaw law; ///< of a spring
	/// z0 of the springs of a stiff joint (spring_step.hpp), frame of A; empty: it is not stiff [m]
	std::vector<Vec3> half;
	double account = 0; ///< A of a stiff joint [J]
	Vec3 centreA = Vec3::Zero(), centreB = Vec3::Zero(); ///< means of the springs' ends in the bodies' frames [m]
	double reach = 0; ///< largest distance of an end from its mean [m]
	size_t line = 0; ///< index of the first joint along the line of this one, JointSet::findLines()

	bool isBroken() const { return intact == 0; }
	bool isStiff() const { return !half.empty(); } ///< the contact solver moves its springs
	/// A single unbroken spring acts along the normal.
	bool isAxial() const { return stiffness.shear == 0 && intact == 1; }
	bool isDamped() const { return damping.ratio > 0 || damping.time > 0; }
	bool yields() const { return !std::holds_alternative<BrittleSprings>(law); }
	double springStrength() const { return strength.strength / (strength.perJoint ? double(springs) : 1); } ///< [N]
	/// On which the stretches of springs that yield are projected (yieldingForces()).
	Vec3 axis() const { return stiffness.shear == 0 ? normal : Vec3(Vec3::Zero()); }
	SpringLaw& springLaw()
	{
		return std::visit([](SpringLaw& one) -> SpringLaw& { return one; }, law);
	}
	/// kappa: tangent stiffness of the unbroken springs over their initial one [-]
	JointDamping dampingAt(double kappa) const
	{
		return { damping.ratio, damping.time, initialDamping ? 1 : kappa };
	}
	/// Leaves the contact solver.
	void soften()
	{
		half.clear();
		account = 0;
	}
};

/// State of a joint as it is read, set and saved. Vectors have one entry for each spring.
struct SpringsState {
	std::vector<int> broken; ///< 1 for a broken spring, else 0
	std::vector<Vec3> stretches, forces; ///< as in SpringLanes
	std::vector<Vec3> plastic; ///< SlipSprings alone
	std::vector<double> largest; ///< likewise
	std::vector<WallHistory> wall; ///< WallSprings alone
	std::vector<Vec3> half; ///< stiff joints alone
	double account = 0; ///< likewise
	JointModes modes;
};

class JointSet {
	std::vector<SpringLanes> groups; ///< of all joints
	std::vector<JointModes> modes; ///< of damped and stiff joints, by index; apart, since walls have none

public:
	std::vector<JointEntry> joints; ///< new ones have no springs
	bool isChanged = true; ///< joints were added, changed or taken since the last step

	/// Valid until a joint is added or changed.
	JointSprings springs(const JointEntry& joint) { return { groups.data() + joint.firstGroup, joint.springs }; }
	JointModes& modesOf(const JointEntry& joint)
	{
		if (modes.size() < joints.size()) modes.resize(joints.size());
		return modes[size_t(&joint - joints.data())];
	}
	/// Load at the forces of the last step. [-]
	double load(const JointEntry&);
	SpringsState state(const JointEntry&);
	/// Sets parameters and state of a joint. anchors: ends of its springs in the bodies' frames [m]. The state's
	/// vectors get their number.
	void change(size_t joint, JointEntry parameters, const std::vector<Vec3>& anchorsA,
	        const std::vector<Vec3>& anchorsB, SpringsState);
	/// Appends a joint of a set, which keeps one without springs in its place. Returns the index.
	size_t take(JointSet& from, size_t joint);
	/// Joints of one spring each that act along the same line between the same bodies: sheets of a wall.
	void findLines();
	void breakSpring(JointEntry&, size_t spring);
	void breakAll(JointEntry&);
};

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
/// The numbers of all joints of a scene that a step needs, side by side in memory: attributes of a joint are scattered,
/// and reading them takes most of the time of a joint. Adapter: JointEngine (pkg/JointEngine.hpp).
#pragma once
#include "joint_law.hpp"

namespace timber {

struct PackedJoint {
	int bodyA, bodyB; ///< indices
	bool yields; ///< slip_law.hpp; its springs are not packed
	bool isStiff; ///< the contact solver moves its springs (spring_step.hpp)
	JointStiffness stiffness; ///< of each spring
	JointStrength strength;
	Vec3 normal; ///< in the frame of A
	bool isActive = false; ///< whether any spring is unbroken
	size_t firstGroup = 0, endGroup = 0; ///< of its springs
};

class PackedJoints {
	std::vector<SpringLanes> groups; ///< of all joints in turn

public:
	std::vector<PackedJoint> joints;
	bool isCurrent = false; ///< whether they are those of the joints' attributes

	SpringLanes* first(const PackedJoint& joint) { return groups.data() + joint.firstGroup; }
	const SpringLanes* end(const PackedJoint& joint) { return groups.data() + joint.endGroup; }

	/// Appends a joint with these springs.
	void add(PackedJoint joint, const JointSprings& springs)
	{
		joint.firstGroup = groups.size();
		joint.endGroup = joint.firstGroup + (joint.yields ? 0 : groupsOf(springs.broken.size()));
		groups.resize(joint.endGroup);
		joints.push_back(joint);
		set(joints.size() - 1, springs);
	}
	/// Sets the springs of a joint, of which some may have broken.
	void set(size_t joint, const JointSprings& springs)
	{
		PackedJoint& j = joints[joint];
		j.isActive = std::find(springs.broken.begin(), springs.broken.end(), 0) != springs.broken.end();
		if (!j.yields) packSprings(springs, first(j));
	}
};

} // namespace timber

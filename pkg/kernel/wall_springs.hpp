// SPDX-License-Identifier: GPL-2.0-or-later
/// Springs of walls between two bodies: wall_law.hpp along one axis of body A. Adapter: JointEngine
/// (pkg/JointEngine.hpp). Signs and frames as in slip_law.hpp: the stretch of a spring is projected on the axis, and
/// the force acts on both bodies at the anchor of B.
#pragma once
#include "joint_law.hpp"
#include "wall_law.hpp"

namespace timber {

/// Stretches, forces and new histories of a wall's unbroken springs. The entries of broken springs stay as they are.
/// axis: unit vector in the frame of A; histories: one of each spring.
JointForce wallForces(const WallLaw& law, const JointPlacement& placement, const Vec3& axis,
        const JointSprings& springs, std::vector<WallHistory>& histories);

/// The springs in a step that does not resolve them. law and histories are not copied.
class WallSprings : public SpringLaw {
	const WallLaw& law;
	Vec3 axis;
	std::vector<WallHistory>& histories;

	SpringState along(const WallForce& force) const;

public:
	/// axis: as of wallForces()
	WallSprings(const WallLaw& law_, const Vec3& axis_, std::vector<WallHistory>& histories_);
	SpringState trial(size_t spring, const Vec3& from, const Vec3& to) const override;
	SpringState commit(size_t spring, const Vec3& from, const Vec3& to) override;
};

/// Springs without strength, in their order. They have no force and no energy left.
std::vector<SpringBreak> wallBreaks(
        const WallLaw& law, const JointSprings& springs, const std::vector<WallHistory>& histories);

} // namespace timber

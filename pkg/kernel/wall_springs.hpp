// SPDX-License-Identifier: GPL-2.0-or-later
/// Springs of walls between two bodies: wall_law.hpp along one axis of body A. Adapter: JointEngine
/// (pkg/JointEngine.hpp). Signs and frames as in slip_law.hpp: the stretch of a spring is projected on the axis, and
/// the force acts on both bodies at the anchor of B.
#pragma once
#include "joint_law.hpp"
#include "wall_law.hpp"

namespace timber {

/// The springs of a wall.
class WallSprings : public SpringLaw {
	WallLaw law;
	Vec3 axis;

	SpringState along(const WallForce& force) const;

public:
	std::vector<WallHistory> histories; ///< of each spring

	/// axis: unit vector in the frame of A
	WallSprings(const WallLaw& law_, const Vec3& axis_);
	SpringState trial(size_t spring, const Vec3& to) const override;
	SpringState commit(size_t spring, const Vec3& to) override;
	bool isSpent(size_t spring) const override { return law.isSpent(histories[spring]); }
	double steepestFall() const override { return law.steepestFall(); }
};

} // namespace timber

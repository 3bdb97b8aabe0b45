// SPDX-License-Identifier: GPL-2.0-or-later
/// Vocabulary of the kernel. SI units everywhere: m, s, kg, N, J, rad.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace timber {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat2 = Eigen::Matrix2d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

/// Pose of a body: x_world = position + orientation * x_body.
struct Pose {
	Vec3 position = Vec3::Zero();
	Quat orientation = Quat::Identity(); ///< unit
};

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
/// Vocabulary of the kernel. SI units everywhere: m, s, kg, N, J, rad.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace timber {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

/// Pose of a body: x_world = position + orientation * x_body.
struct Pose {
	Vec3 position = Vec3::Zero();
	Quat orientation = Quat::Identity(); ///< unit
};

// Preconditions, for assert().
inline bool isUnitVector(const Vec3& v) { return std::abs(v.squaredNorm() - 1) < 1e-9; }
inline bool isRotation(const Mat3& m) { return (m * m.transpose() - Mat3::Identity()).norm() < 1e-9; }
inline bool isAdmissible(const Pose& p) { return p.position.allFinite() && std::abs(p.orientation.squaredNorm() - 1) < 1e-9; }

} // namespace timber

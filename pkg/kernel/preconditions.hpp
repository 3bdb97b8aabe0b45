// SPDX-License-Identifier: GPL-2.0-or-later
/// Predicates for assert() at the kernel's entries; a Release build compiles them away.
#pragma once
#include "simd.hpp"

namespace timber {

inline bool isFinite(double x) { return std::isfinite(x); }
inline bool isFinite(const Lanes& x)
{
	for (size_t i = 0; i < laneCount; ++i)
		if (!std::isfinite(lane(x, i))) return false;
	return true;
}
template <class Matrix> bool isFinite(const Matrix& x)
{
	for (Eigen::Index i = 0; i < x.size(); ++i)
		if (!isFinite(x.data()[i])) return false;
	return true;
}

inline bool isNonNegative(double x) { return x >= 0; }
inline bool isNonNegative(const Lanes& x) { return !any(x < Lanes(0.)); }

/// Length 1 to the rounding of a few operations.
template <class Number> bool isUnit(const Eigen::Matrix<Number, 3, 1>& n)
{
	const Number square = n.squaredNorm();
	return isFinite(square) && !any(logicalOr(square<Number(1 - 1e-9), square> Number(1 + 1e-9)));
}

inline bool isRotation(const Mat3& m) { return (m * m.transpose() - Mat3::Identity()).norm() < 1e-9; }

/// Finite, with a unit quaternion.
inline bool isAdmissible(const Pose& p)
{
	return isFinite(p.position) && std::abs(p.orientation.squaredNorm() - 1) < 1e-9;
}

} // namespace timber

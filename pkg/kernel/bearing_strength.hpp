// SPDX-License-Identifier: GPL-2.0-or-later
/// Bearing strength of timber at a contact point: the total normal force at which it is crushed.
#pragma once
#include "manifold.hpp"
#include <limits>

namespace timber {

/// F_Y(c) = constant + linear c + square c^2 [N] for the plastic overlap c [m]: the load spreads with it.
struct BearingStrength {
	double constant = std::numeric_limits<double>::infinity(); ///< infinite: elastic [N]
	double linear = 0, square = 0; ///< [N/m, N/m2]

	bool isLimited() const { return constant < std::numeric_limits<double>::infinity(); }
	template <class Number> Number force(Number c) const
	{
		return Number(constant) + c * (Number(linear) + c * Number(square));
	}
	double slope(double c) const { return linear + 2 * square * c; } ///< dF_Y/dc [N/m]
	/// Without spreading, for the plastic overlap c.
	BearingStrength at(double c) const { return { force(c), 0, 0 }; }
};

/// Of each point of a pair: pressure times the pair's bearing area over the number N of its points. The area is that of
/// the rectangle with the points' second moments, of sides 2a and 2b, widened by the radius and the plastic overlap on
/// all sides: 4 (a + r + c) (b + r + c). Four corners of the core of a face give the whole face, two points a strip, one
/// a square.
/// Points have the squares of their overlaps as weights w, N = (sum w)^2 / sum w^2: the strength is continuous when a
/// point begins or ends, and a load off the middle bears on less than the whole face.
/// pressure: bearing strength [Pa], infinite: elastic; radius: the smaller one of the two bodies [m].
BearingStrength bearingStrength(double pressure, double radius, const std::vector<ContactPoint>& points);

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
#include "bearing_strength.hpp"
#include <algorithm>

namespace timber {

/// With the invariants I1 and I2 of the covariance of the points, of which one principal value is nearly zero:
/// a b = I2^1/2 and a + b = (I1 + 2 a b)^1/2.
BearingStrength bearingStrength(double pressure, double radius, const std::vector<ContactPoint>& points)
{
	if (points.empty() || !std::isfinite(pressure)) return {};
	assert(pressure > 0 && radius > 0);
	double weights = 0, weightSquares = 0;
	Vec3 mean = Vec3::Zero(), squares = Vec3::Zero(), products = Vec3::Zero();
	for (const ContactPoint& point : points) {
		assert(point.overlap > 0);
		const Vec3 x
		        = point.position - points.front().position; // far from the origin squares would lose digits
		const double w = point.overlap * point.overlap;
		weights += w;
		weightSquares += w * w;
		mean += w * x;
		squares += w * x.cwiseProduct(x);
		products += w * Vec3(x.y() * x.z(), x.z() * x.x(), x.x() * x.y());
	}
	mean /= weights;
	const Vec3 variance = squares / weights - mean.cwiseProduct(mean),
	           mixed = products / weights - Vec3(mean.y() * mean.z(), mean.z() * mean.x(), mean.x() * mean.y());
	const double first = std::max(0., variance.sum()),
	             second = variance.y() * variance.z() + variance.z() * variance.x() + variance.x() * variance.y()
	        - mixed.squaredNorm();
	const double product = std::sqrt(std::max(0., second)), sum = std::sqrt(first + 2 * product), // a b, a + b
	        factor = 4 * pressure * weightSquares / (weights * weights);
	return { factor * (product + radius * (sum + radius)), factor * (sum + 2 * radius), factor };
}

} // namespace timber

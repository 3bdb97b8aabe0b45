// SPDX-License-Identifier: GPL-2.0-or-later
#include "impact.hpp"
#include "constants.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>

namespace timber {

double restitution(double ratio)
{
	assert(ratio >= 0);
	const double root = std::sqrt(std::abs(1 - ratio * ratio));
	if (root < 1e-6) return std::exp(-2.); // the limit for critical damping
	return std::exp(-2 * ratio * (ratio < 1 ? std::acos(ratio) : std::acosh(ratio)) / root);
}

/// 2 d / v int_0^1 dx / sqrt(1 - x^(q+1)) with the largest overlap d.
double PowerSpring::duration(double mass, double speed) const
{
	const double s = 1 / (power() + 1), integral = std::sqrt(M_PI) * s * std::tgamma(s) / std::tgamma(s + 0.5);
	const double largest = overlap * std::pow(mass * speed * speed / (2 * energy()), s);
	return 2 * integral * largest / speed;
}

ImpactState startImpact(
        const PowerSpring& spring, double dampingRatio, double mass, double response, double speed, double h)
{
	assert(spring.force > 0 && spring.stiffness > 0 && spring.overlap > 0 && mass > 0 && response > 0 && speed > 0
	        && h > 0);
	const double q = spring.power(), duration = spring.duration(1 / response, speed);
	if (duration > impactSteps * h) return ImpactState::over();
	return { impactDurations * duration + h,
		speed * restitution(dampingRatio * std::sqrt(response * mass * 2 * q / (q + 1))),
		impactLoadShare * speed / std::max(duration / h, 1.) };
}

} // namespace timber

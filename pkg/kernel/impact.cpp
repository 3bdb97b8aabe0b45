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

/// (3) for s = n/d and y = (v/v(d))^2, dy/ds = -(q + 1) min(1, s^q + 2 D s^((q-1)/2) y^1/2), in the variable z = s^1/4, of
/// which Hertz's dashpot is a smooth function, by the classical Runge-Kutta method.
double reboundAtStrength(double ratio, double q, double speed, double& rest)
{
	assert(ratio >= 0 && q >= 1 && speed > 0);
	const auto rate = [&](double z, double y) {
		const double force
		        = std::pow(z, 4 * q) + 2 * ratio * std::pow(z, 2 * (q - 1)) * std::sqrt(std::max(0., y));
		return -4 * (q + 1) * z * z * z * std::min(1., force);
	};
	const double dz = 1. / crushingSteps, unloading = std::sqrt(restitution(ratio));
	rest = 0;
	double y = speed * speed;
	for (int k = 0; k < crushingSteps; ++k) {
		const double z = k * dz, a = rate(z, y), b = rate(z + dz / 2, y + dz / 2 * a),
		             c = rate(z + dz / 2, y + dz / 2 * b), d = rate(z + dz, y + dz * c),
		             next = y + dz / 6 * (a + 2 * b + 2 * c + d);
		if (next <= 0) return unloading * std::pow(z + dz * y / (y - next), 2 * (q + 1)); // s^((q+1)/2)
		y = next;
	}
	rest = y / (speed * speed);
	return unloading;
}

namespace {

	/// Plastic overlap at which crushing has dissipated an energy [J], Newton's method from above. [m]
	double plasticOverlap(const BearingStrength& s, double crushed, double energy)
	{
		double c = energy / s.force(crushed);
		for (int k = 0; k < yieldSteps; ++k) {
			const double work = c * (s.force(crushed) + c * (s.slope(crushed) / 2 + c * s.square / 3)),
			             last = c;
			c -= (work - energy) / s.force(crushed + c);
			if (last - c <= yieldTolerance * last) break;
		}
		return crushed + c;
	}

	/// Velocity of separation w. [m/s]
	double reboundOf(const PowerSpring& spring, const Touch& t)
	{
		const double q = spring.power(),
		             ratio = t.dampingRatio * std::sqrt(t.response * t.mass * 2 * q / (q + 1)),
		             elastic = t.speed * restitution(ratio);
		if (!t.strength.isLimited()) return elastic;
		const double strength = t.strength.force(t.crushed), a = t.response,
		             limit = std::sqrt(2 * a * spring.energyAt(strength)), speed = t.speed / limit;
		// Below it the largest force, at most that of an undamped spring and of its dashpot at the first speed
		if ((1 + 2 * ratio) * std::pow(speed, 2 * q / (q + 1)) <= 1) return elastic;
		double rest;
		const double rebound = reboundAtStrength(ratio, q, speed, rest) * limit;
		if (rest == 0) return rebound;
		const double plastic = plasticOverlap(t.strength, t.crushed, rest * t.speed * t.speed / (2 * a));
		return rebound * std::pow(t.strength.force(plastic) / strength, (1 + 1 / q) / 2);
	}

	/// Durations of an impact: of the undamped elastic one, or the one at the strength, and with crushing. [s]
	struct Durations {
		double elastic, whole;

		Durations(const PowerSpring& spring, const Touch& t)
		        : elastic(spring.duration(1 / t.response, t.speed))
		        , whole(elastic)
		{
			if (!t.strength.isLimited()) return;
			const double strength = t.strength.force(t.crushed),
			             excess = t.speed * t.speed - 2 * t.response * spring.energyAt(strength);
			if (excess <= 0) return;
			elastic = spring.duration(1 / t.response, std::sqrt(t.speed * t.speed - excess));
			whole = elastic + std::sqrt(excess) / (t.response * strength);
		}
	};

} // namespace

ImpactState startImpact(const PowerSpring& spring, const Touch& touch, double h)
{
	assert(spring.force > 0 && spring.stiffness > 0 && spring.overlap > 0 && touch.mass > 0 && touch.response > 0
	        && touch.speed > 0 && h > 0);
	const Durations duration(spring, touch);
	if (duration.elastic > impactSteps * h) return ImpactState::over();
	return { impactDurations * duration.whole + h, reboundOf(spring, touch),
		impactLoadShare * touch.speed / std::max(duration.whole / h, 1.) };
}

} // namespace timber

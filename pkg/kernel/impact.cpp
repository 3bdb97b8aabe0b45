// SPDX-License-Identifier: GPL-2.0-or-later
#include "impact.hpp"
#include "constants.hpp"
#include "portable_math.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>

namespace timber {

namespace {

	/// artanh(x)/x for x^2 = -square, arctan(x)/x for x^2 = square, square > -1: halved arguments, then the series.
	double arctangentShare(double square)
	{
		double factor = 1;
		while (std::abs(square) > 0.01) {
			const double half = 1 + std::sqrt(1 + square);
			factor *= 2 / half;
			square /= half * half;
		}
		double sum = 0;
		for (int k = 17; k > 0; k -= 2)
			sum = 1. / k - square * sum;
		return factor * sum;
	}

	/// int_0^1 dx / sqrt(1 - x^(1/s)) = pi^1/2 Gamma(s + 1) / Gamma(s + 1/2): by recurrence from the asymptotic series
	/// of the quotient at s + 12.
	double quarterPeriod(double s)
	{
		double factor = std::sqrt(M_PI);
		for (int k = 0; k < 12; ++k, ++s)
			factor *= (s + 0.5) / (s + 1);
		const double w = s + 0.25, y = 1 / (w * w);
		return factor * std::sqrt(w)
		        * (1 + y / 64 * (1 - y * (19. / 128 - y * (631. / 8192 - y * (174317. / 2097152)))));
	}

} // namespace

double restitution(double ratio)
{
	assert(ratio >= 0);
	// acos(D) / sqrt(1 - D^2) = 2 / (1 + D) arctan(t) / t, t^2 = (1 - D) / (1 + D), D: zeta_c
	const double over = 1 / (1 + ratio);
	return exponential(-4 * ratio * over * arctangentShare((1 - ratio) * over));
}

double PowerSpring::exponent() const
{
	constexpr double unit = 0x1p40;
	return std::floor(stiffness * overlap / force * unit + 0.5) / unit;
}

double PowerSpring::energyAt(double otherForce) const
{
	return energy() * timber::power(otherForce / force, 1 + 1 / exponent());
}

/// 2 d / v int_0^1 dx / sqrt(1 - x^(q+1)) with the largest overlap d.
double PowerSpring::duration(double mass, double speed) const
{
	const double s = 1 / (exponent() + 1),
	             largest = overlap * timber::power(mass * speed * speed / (2 * energy()), s);
	return 2 * quarterPeriod(s) * largest / speed;
}

/// (3) for s = n/d and y = (v/v(d))^2, dy/ds = -(q + 1) min(1, s^q + 2 zeta_c s^((q-1)/2) y^1/2), in the variable
/// z = s^1/4, of which Hertz's dashpot is a smooth function, by the classical Runge-Kutta method.
double reboundAtStrength(double ratio, double q, double speed, double& crushing)
{
	assert(ratio >= 0 && q >= 1 && speed > 0);
	struct Powers {
		double spring, dashpot; ///< z^4q, z^2(q-1)
	};
	const auto powersOf = [q](double z) {
		return q == 1.5 ? Powers { z * z * z * z * z * z, z }
		                : Powers { power(z, 4 * q), power(z, 2 * (q - 1)) };
	};
	const auto rate = [&](double z, const Powers& p, double y) {
		const double force = p.spring + 2 * ratio * p.dashpot * std::sqrt(std::max(0., y));
		return -4 * (q + 1) * z * z * z * std::min(1., force);
	};
	const double dz = 1. / crushingSteps, unloading = std::sqrt(restitution(ratio));
	crushing = 0;
	double y = speed * speed;
	Powers now = powersOf(0);
	for (int k = 0; k < crushingSteps; ++k) {
		const double z = k * dz, middle = z + dz / 2;
		const Powers half = powersOf(middle), end = powersOf(z + dz);
		const double a = rate(z, now, y), b = rate(middle, half, y + dz / 2 * a),
		             c = rate(middle, half, y + dz / 2 * b), d = rate(z + dz, end, y + dz * c),
		             next = y + dz / 6 * (a + 2 * b + 2 * c + d);
		if (next <= 0) return unloading * power(z + dz * y / (y - next), 2 * (q + 1)); // s^((q+1)/2)
		y = next;
		now = end;
	}
	crushing = y / (speed * speed);
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
		const double q = spring.exponent(),
		             ratio = t.dampingRatio * std::sqrt(t.response * t.mass * 2 * q / (q + 1)),
		             elastic = t.speed * restitution(ratio);
		if (!t.strength.isLimited()) return elastic;
		const double strength = t.strength.force(t.crushed), a = t.response,
		             limit = std::sqrt(2 * a * spring.energyAt(strength)), speed = t.speed / limit;
		// No crushing: the force is at most that of the undamped spring plus that of its dashpot at the touch speed
		if ((1 + 2 * ratio) * power(speed, 2 * q / (q + 1)) <= 1) return elastic;
		double crushing;
		const double rebound = reboundAtStrength(ratio, q, speed, crushing) * limit;
		if (crushing == 0) return rebound;
		const double plastic = plasticOverlap(t.strength, t.crushed, crushing * t.speed * t.speed / (2 * a));
		return rebound * power(t.strength.force(plastic) / strength, (1 + 1 / q) / 2);
	}

	/// Durations of an undamped impact: of its elastic part, up to the strength, and of all. [s]
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

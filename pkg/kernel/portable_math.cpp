// SPDX-License-Identifier: GPL-2.0-or-later
#include "portable_math.hpp"
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace timber {
namespace {

	/// Unevaluated sum of two numbers, the second one a rounding error of the first.
	struct Sum {
		double high, low;
	};

	/// a + b, |a| >= |b| or a = 0.
	Sum sum(double a, double b)
	{
		const double high = a + b;
		return { high, b - (high - a) };
	}
	/// Upper half of the digits. (Dekker, Numer. Math. 18 (1971), 224)
	double upper(double x)
	{
		const double c = 134217729 * x; // 2^27 + 1
		return c - (c - x);
	}
	Sum product(double a, double b)
	{
		const double high = a * b, a1 = upper(a), b1 = upper(b), a2 = a - a1, b2 = b - b1;
		return { high, ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2 };
	}

	constexpr double ln2High = 0x1.62e42feep-1, ln2Low = 0x1.a39ef35793c76p-33; ///< of 32 and 53 bits

	long nearest(double x) { return long(x < 0 ? x - 0.5 : x + 0.5); }

	/// x 2^n
	double scaled(double x, long n)
	{
		const auto two = [](long exponent) {
			const std::uint64_t bits = std::uint64_t(exponent + 1023) << 52;
			double value;
			std::memcpy(&value, &bits, sizeof value);
			return value;
		};
		const long half = n / 2;
		return x * two(half) * two(n - half);
	}

	constexpr int factorialCount = 24;
	/// 1 / n!
	constexpr auto inverseFactorials = [] {
		std::array<double, factorialCount> inverse {};
		double factorial = 1;
		for (int n = 0; n < factorialCount; ++n) {
			if (n > 0) factorial *= n;
			inverse[size_t(n)] = 1 / factorial;
		}
		return inverse;
	}();

	/// Sum of x^k / (first + k step)!, k = 0, 1 ...
	double series(double x, int first, int step)
	{
		int n = first;
		while (n + step < factorialCount)
			n += step;
		double value = 0;
		for (; n >= first; n -= step)
			value = value * x + inverseFactorials[size_t(n)];
		return value;
	}

	/// exp(x.high + x.low)
	double exponential(const Sum& x)
	{
		if (!(x.high < 709.7)) return x.high > 0 ? std::numeric_limits<double>::infinity() : x.high;
		if (x.high < -745.2) return 0;
		const long n = nearest(x.high * M_LOG2E);
		const Sum r = sum(x.high - double(n) * ln2High, x.low - double(n) * ln2Low);
		const double rest = r.high * r.high * series(r.high, 2, 1) + r.low * (1 + r.high);
		return scaled(1 + (r.high + rest), n);
	}

	/// log(x), x > 0
	Sum logarithm(double x)
	{
		long n = 0;
		if (x < std::numeric_limits<double>::min()) x *= 0x1p54, n = -54;
		std::uint64_t bits;
		std::memcpy(&bits, &x, sizeof bits);
		n += long(bits >> 52) - 1023;
		bits = (bits & 0xfffffffffffff) | std::uint64_t(1023) << 52;
		double m;
		std::memcpy(&m, &bits, sizeof m);
		if (m > M_SQRT2) m /= 2, ++n;
		// 2 artanh(s), s = f / (2 + f)
		const double f = m - 1;
		const Sum below = sum(2, f);
		const double s = f / below.high;
		const Sum back = product(s, below.high);
		const double low = ((f - back.high) - back.low - s * below.low) / below.high, square = s * s;
		double tail = 0;
		for (int k = 25; k >= 3; k -= 2)
			tail = square * (tail + 2. / k);
		const Sum first = sum(double(n) * ln2High, 2 * s);
		return sum(first.high, first.low + (double(n) * ln2Low + 2 * low + s * tail));
	}

	/// Quadrant n and rest of an angle: x = n pi/2 + rest
	long quadrant(double x, Sum& rest)
	{
		constexpr double high = 0x1.921fb544p+0, middle = 0x1.0b4611a6p-34, low = 0x1.3198a2e037073p-69; // pi/2
		assert(std::abs(x) <= 1e5);
		const long n = nearest(x / high);
		const double near = x - double(n) * high, correction = double(n) * middle, a = near - correction;
		rest = sum(a, ((near - a) - correction) - double(n) * low);
		return n & 3;
	}
	double sineOf(const Sum& x)
	{
		const double square = x.high * x.high, tail = -square * series(-square, 3, 2);
		return x.high + (x.high * tail + x.low * (1 - square / 2));
	}
	double cosineOf(const Sum& x)
	{
		const double square = x.high * x.high, half = square / 2, one = 1 - half;
		const double tail = square * square * series(-square, 4, 2);
		return one + (((1 - one) - half) + (tail - x.high * x.low));
	}
	double sineIn(long n, const Sum& x)
	{
		const double value = n & 1 ? cosineOf(x) : sineOf(x);
		return n & 2 ? -value : value;
	}

} // namespace

double exponential(double x) { return exponential(Sum { x, 0 }); }

double power(double x, double y)
{
	assert(x >= 0);
	if (y == 0 || x == 1) return 1;
	if (x == 0 || std::isinf(x)) return (x == 0) == (y > 0) ? 0 : std::numeric_limits<double>::infinity();
	const Sum log = logarithm(x), high = product(y, log.high);
	return exponential(sum(high.high, high.low + y * log.low));
}

double sine(double x)
{
	Sum rest;
	const long n = quadrant(x, rest);
	return sineIn(n, rest);
}

double cosine(double x)
{
	Sum rest;
	const long n = quadrant(x, rest);
	return sineIn(n + 1, rest);
}

} // namespace timber

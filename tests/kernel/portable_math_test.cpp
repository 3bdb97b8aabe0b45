// SPDX-License-Identifier: GPL-2.0-or-later
/// The kernel's own functions against those of the C library in long double.
#include <cmath>
#include <gtest/gtest.h>
#include <kernel/portable_math.hpp>
#include <random>

using namespace timber;

namespace {

constexpr int count = 20000; ///< of random arguments

/// Largest error over arguments between two bounds. [ulp]
template <class Function, class Exact> double largestError(double low, double high, Function function, Exact exact)
{
	std::mt19937 random(1);
	std::uniform_real_distribution<double> arguments(low, high);
	double largest = 0;
	for (int k = 0; k < count; ++k) {
		const double x = arguments(random), value = function(x);
		const long double error = std::abs(exact((long double)x) - (long double)value);
		const double above = std::abs(value);
		largest = std::max(largest, double(error / (std::nextafter(above, INFINITY) - above)));
	}
	return largest;
}

} // namespace

TEST(PortableMath, Exponential)
{
	const auto exact = [](long double x) { return std::exp(x); };
	EXPECT_LT(largestError(-700, 700, exponential, exact), 1);
	EXPECT_LT(largestError(-1, 1, exponential, exact), 1);
	EXPECT_EQ(exponential(0), 1);
	EXPECT_EQ(exponential(1000), INFINITY);
	EXPECT_EQ(exponential(-1000), 0);
}

TEST(PortableMath, Power)
{
	for (const double y : { 0.1, 0.4, 1. / 3, 0.5, 0.8, 1.2, 1.5, 5. / 3, 3., 6., -0.7, -2.5 }) {
		const auto function = [y](double x) { return power(x, y); };
		const auto exact = [y](long double x) { return std::pow(x, (long double)y); };
		EXPECT_LT(largestError(0, 2, function, exact), 1) << y;
		EXPECT_LT(largestError(0.99, 1.01, function, exact), 1) << y;
		EXPECT_LT(largestError(0, 1e4 / (1 + 10 * std::abs(y)), function, exact), 1) << y;
	}
	EXPECT_EQ(power(0, 0.4), 0);
	EXPECT_EQ(power(1, 0.4), 1);
	EXPECT_EQ(power(5, 0), 1);
	EXPECT_EQ(power(0, -1), INFINITY);
	EXPECT_NEAR(power(1e-310, 0.1), 1e-31, 1e-44); // the argument has 14 digits
}

TEST(PortableMath, SineAndCosine)
{
	const auto exactSine = [](long double x) { return std::sin(x); };
	const auto exactCosine = [](long double x) { return std::cos(x); };
	for (const double most : { 0.02, 1., 10., 1e5 }) {
		EXPECT_LT(largestError(-most, most, sine, exactSine), 1) << most;
		EXPECT_LT(largestError(-most, most, cosine, exactCosine), 1) << most;
	}
}

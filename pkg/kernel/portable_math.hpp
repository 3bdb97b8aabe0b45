// SPDX-License-Identifier: GPL-2.0-or-later
/// Functions of the C library whose last bits depend on the processor, from operations that IEEE 754 fixes: + - * / and
/// sqrt. The results are the same on every processor, within 1 ulp of the exact ones
/// (tests/kernel/portable_math_test.cpp).
#pragma once

namespace timber {

double exponential(double x);
/// x^y for x >= 0; within 1 ulp for results from 1e-12 to 1e12.
double power(double x, double y);
/// For |x| <= 1e5.
double sine(double x);
double cosine(double x);

} // namespace timber

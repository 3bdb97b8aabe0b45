// SPDX-License-Identifier: GPL-2.0-or-later
/// Range checks of attributes, and the end of a run by an error.
#pragma once
#include <pch.hpp>
#include <lib/pyutil/gil.hpp>

namespace yade {

/// Throws std::invalid_argument "Class.attribute = value: it must be range" unless the condition holds.
template <class T> void require(bool condition, const char* attribute, const T& value, const char* range)
{
	if (condition) return;
	std::ostringstream message;
	message << attribute << " = " << value << ": it must be " << range;
	throw std::invalid_argument(message.str());
}
inline void requirePositive(const char* attribute, Real value)
{
	require(value > 0 && std::isfinite(value), attribute, value, "finite and > 0");
}
inline void requireNonNegative(const char* attribute, Real value)
{
	require(value >= 0 && std::isfinite(value), attribute, value, "finite and >= 0");
}
inline void requireFinite(const char* attribute, Real value)
{
	require(std::isfinite(value), attribute, value, "finite");
}

/// Ends a step with std::runtime_error. O.run(n, True) returns without the error of a step that ends before it looks
/// whether the loop runs; it holds Python's lock until then.
[[noreturn]] inline void stopRun(const std::string& message)
{
	const gilLock caller;
	throw std::runtime_error(message);
}

} // namespace yade

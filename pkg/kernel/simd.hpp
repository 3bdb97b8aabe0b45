// SPDX-License-Identifier: GPL-2.0-or-later
/// SIMD vectors of doubles: the points of a contact, the springs of a joint, the rotations of bodies. Formulas are
/// templates over Number, double or Lanes; SIMD results are bitwise identical to scalar ones. Calls pass Lanes through
/// memory: small functions with many of them are always inlined.
#pragma once
#include "types.hpp"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace timber {

#if defined(__AVX2__)
constexpr int laneCount = 4;
#else
constexpr int laneCount = 2;
#endif

struct Lanes {
	typedef double Vector __attribute__((vector_size(laneCount * sizeof(double))));
	/// Each lane: all bits set (true) or none (false).
	typedef std::int64_t Mask __attribute__((vector_size(laneCount * sizeof(double))));

	Vector v;

	Lanes() = default;
	Lanes(double x)
	        : v(x - Vector {})
	{
	}
	explicit Lanes(Vector x)
	        : v(x)
	{
	}
	Lanes& operator+=(Lanes o) { return v += o.v, *this; }
	Lanes& operator-=(Lanes o) { return v -= o.v, *this; }
	Lanes& operator*=(Lanes o) { return v *= o.v, *this; }
	Lanes& operator/=(Lanes o) { return v /= o.v, *this; }
	friend Lanes operator-(Lanes a) { return Lanes(-a.v); }
	friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.v + b.v); }
	friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.v - b.v); }
	friend Lanes operator*(Lanes a, Lanes b) { return Lanes(a.v * b.v); }
	friend Lanes operator/(Lanes a, Lanes b) { return Lanes(a.v / b.v); }
	friend Mask operator<(Lanes a, Lanes b) { return a.v < b.v; }
	friend Mask operator>(Lanes a, Lanes b) { return a.v > b.v; }
	friend Mask operator<=(Lanes a, Lanes b) { return a.v <= b.v; }
	friend Mask operator>=(Lanes a, Lanes b) { return a.v >= b.v; }
	friend Lanes sqrt(Lanes a)
	{
#if defined(__AVX2__)
		return Lanes(Vector(_mm256_sqrt_pd(a.v)));
#elif defined(__SSE2__)
		return Lanes(Vector(_mm_sqrt_pd(a.v)));
#else
		for (int i = 0; i < laneCount; ++i)
			a.v[i] = std::sqrt(a.v[i]);
		return a;
#endif
	}
};

} // namespace timber

namespace Eigen {
template <> struct NumTraits<timber::Lanes> : GenericNumTraits<double> {
	using Real = timber::Lanes;
	using NonInteger = timber::Lanes;
	using Nested = timber::Lanes;
};
}

namespace timber {

inline double sqrt(double x) { return std::sqrt(x); }

template <class Number> using Vec3Of = Eigen::Matrix<Number, 3, 1>;
using Vec3s = Vec3Of<Lanes>;

/// a where the condition is true, b elsewhere. Both are evaluated.
inline double select(bool condition, double a, double b) { return condition ? a : b; }
inline Lanes select(Lanes::Mask condition, Lanes a, Lanes b) { return Lanes(condition ? a.v : b.v); }
template <class Condition, class Number>
Vec3Of<Number> select(Condition condition, const Vec3Of<Number>& a, const Vec3Of<Number>& b)
{
	return { select(condition, a.x(), b.x()), select(condition, a.y(), b.y()), select(condition, a.z(), b.z()) };
}

inline bool logicalAnd(bool a, bool b) { return a && b; }
inline bool logicalOr(bool a, bool b) { return a || b; }
inline Lanes::Mask logicalAnd(Lanes::Mask a, Lanes::Mask b) { return a & b; }
inline Lanes::Mask logicalOr(Lanes::Mask a, Lanes::Mask b) { return a | b; }

/// Whether the condition is true in any lane.
inline bool any(bool condition) { return condition; }
inline bool any(Lanes::Mask condition)
{
#if defined(__AVX2__)
	return !_mm256_testz_si256(__m256i(condition), __m256i(condition));
#else
	std::int64_t bits = 0;
	for (int i = 0; i < laneCount; ++i)
		bits |= condition[i];
	return bits != 0;
#endif
}

/// select() for expensive values: first() is evaluated only if any lane needs it; for a double, only the selected one
/// is.
template <class First, class Other> auto selectLazily(bool condition, First first, Other other) -> decltype(other())
{
	return condition ? first() : other();
}
template <class First, class Other>
auto selectLazily(Lanes::Mask condition, First first, Other other) -> decltype(other())
{
	return any(condition) ? select(condition, first(), other()) : other();
}

/// As std::min and std::max.
template <class Number> Number min(Number a, Number b) { return select(b < a, b, a); }
template <class Number> Number max(Number a, Number b) { return select(a < b, b, a); }

/// A vector or matrix in all lanes; for double, the argument itself.
template <class Number> decltype(auto) broadcast(const Vec3& v)
{
	if constexpr (std::is_same_v<Number, double>) return (v);
	else return Vec3Of<Number>(Number(v.x()), Number(v.y()), Number(v.z()));
}
template <class Number> decltype(auto) broadcast(const Mat3& m)
{
	if constexpr (std::is_same_v<Number, double>) return (m);
	else {
		Eigen::Matrix<Number, 3, 3> wide;
		for (int k = 0; k < 9; ++k)
			wide(k) = Number(m(k));
		return wide;
	}
}

/// The i-th lane.
inline double lane(double x, size_t) { return x; }
inline double lane(const Lanes& x, size_t i) { return x.v[i]; } // by reference: only the lane is loaded
inline bool lane(bool x, size_t) { return x; }
inline bool lane(Lanes::Mask x, size_t i) { return x[i] != 0; }
inline const Vec3& lane(const Vec3& v, size_t) { return v; }
inline Vec3 lane(const Vec3s& v, size_t i) { return { v.x().v[i], v.y().v[i], v.z().v[i] }; }

inline void clearLane(bool& x, size_t) { x = false; }
inline void clearLane(Lanes::Mask& x, size_t i) { x[i] = 0; }
inline void setLane(Lanes& x, size_t i, double one) { x.v[i] = one; }
inline void setLane(Vec3s& v, size_t i, const Vec3& one)
{
	for (int c = 0; c < 3; ++c)
		setLane(v[c], i, one[c]);
}

/// work(x) applied lane by lane.
template <class Work> Lanes eachLane(Lanes x, Work work)
{
	for (int i = 0; i < laneCount; ++i)
		x.v[i] = work(x.v[i]);
	return x;
}

/// Transposes laneCount vectors in place: the k-th gets the k-th lane of each.
inline void transpose(Lanes* x)
{
	const auto v = [x](int k) { return x[k].v; };
#if defined(__AVX2__)
	const Lanes::Vector even01 = __builtin_shufflevector(v(0), v(1), 0, 4, 2, 6),
	                    odd01 = __builtin_shufflevector(v(0), v(1), 1, 5, 3, 7);
	const Lanes::Vector even23 = __builtin_shufflevector(v(2), v(3), 0, 4, 2, 6),
	                    odd23 = __builtin_shufflevector(v(2), v(3), 1, 5, 3, 7);
	x[0].v = __builtin_shufflevector(even01, even23, 0, 1, 4, 5);
	x[1].v = __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5);
	x[2].v = __builtin_shufflevector(even01, even23, 2, 3, 6, 7);
	x[3].v = __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7);
#else
	const Lanes::Vector first = __builtin_shufflevector(v(0), v(1), 0, 2);
	x[1].v = __builtin_shufflevector(v(0), v(1), 1, 3);
	x[0].v = first;
#endif
}

/// Number of groups of laneCount for that many items.
constexpr size_t groupsOf(size_t count) { return (count + laneCount - 1) / laneCount; }

/// N sums over items that are processed in lanes. Each sum adds item by item, in the order of a scalar loop; the N sums
/// are vectorised.
template <size_t N> class Sums {
	Lanes total[groupsOf(N)];

	template <class Part>
	static constexpr size_t sizeOf = std::is_same_v<Part, double> || std::is_same_v<Part, Lanes> ? 1 : 3;
	template <class Number> static void put(Number*& to, Number x) { *to++ = x; }
	template <class Number> static void put(Number*& to, const Vec3Of<Number>& x)
	{
		for (int c = 0; c < 3; ++c)
			*to++ = x[c];
	}

public:
	/// Initial values: numbers and vectors, N numbers in all; none: zero.
	template <class... Parts> [[gnu::always_inline]] explicit Sums(const Parts&... start)
	{
		static_assert(sizeof...(start) == 0 || (sizeOf<Parts> + ... + 0) == N, "N initial values, or none");
		double x[groupsOf(N) * laneCount] = {};
		[[maybe_unused]] double* to = x;
		(put(to, start), ...);
		for (size_t g = 0; g < groupsOf(N); ++g)
			for (size_t i = 0; i < laneCount; ++i)
				total[g].v[i] = x[g * laneCount + i];
	}
	/// Adds the first min(count, laneCount) lanes of N numbers, given as numbers and vectors.
	template <class Number, class... Parts> [[gnu::always_inline]] void add(size_t count, const Parts&... parts)
	{
		static_assert((sizeOf<Parts> + ... + 0) == N, "N numbers to add");
		Number x[groupsOf(N) * laneCount] = {}, *to = x;
		(put(to, parts), ...);
		if constexpr (std::is_same_v<Number, double>)
			for (size_t k = 0; k < N; ++k)
				total[k / laneCount].v[k % laneCount] += x[k];
		else
			for (size_t g = 0; g < groupsOf(N); ++g) {
				transpose(x + g * laneCount);
				for (size_t i = 0; i < laneCount && i < count; ++i)
					total[g] += x[g * laneCount + i];
			}
	}
	double operator[](size_t k) const { return total[k / laneCount].v[k % laneCount]; }
	Vec3 vector(size_t k) const { return { (*this)[k], (*this)[k + 1], (*this)[k + 2] }; }
};

/// work(number, k) for `count` items in groups of laneCount: k is the first item of a group, the type of `number` the
/// Number to use: Lanes, or double for a single last item.
template <class Work> void inLanes(size_t count, Work work)
{
	for (size_t k = 0; k < count; k += laneCount)
		if (count - k == 1) work(double(), k);
		else work(Lanes(), k);
}

/// Gather and scatter: structures or vectors in memory, one for each lane. Unused lanes load the last item; set()
/// stores lanes in descending order, so that the last item gets the value of its own lane.
template <class Number, class Item> class Group {
	Item* item[laneCount];

	template <class Read> [[gnu::always_inline]] static Lanes gathered(Read read)
	{
		if constexpr (laneCount == 4) return Lanes(Lanes::Vector { read(0), read(1), read(2), read(3) });
		else return Lanes(Lanes::Vector { read(0), read(1) });
	}

public:
	/// Items from `first` on; count >= 1, of which at most laneCount are used.
	Group(Item* first, size_t count)
	        : Group(count, [first](size_t i) { return first + i; })
	{
	}
	/// at(i): address of the i-th of `count` items.
	template <class Address> Group(size_t count, Address at)
	{
		item[0] = at(0);
		for (size_t i = 1; i < laneCount; ++i)
			item[i] = i < count ? at(i) : item[i - 1];
	}
	/// The items themselves.
	[[gnu::always_inline]] Lanes numbers() const
	{
		return gathered([&](int i) { return double(*item[i]); });
	}
	/// Vectors of any length.
	[[gnu::always_inline]] auto vectors() const
	{
		constexpr int size = Item::RowsAtCompileTime;
		Eigen::Matrix<Lanes, size, 1> wide;
		for (int c = 0; c < size; ++c)
			wide[c] = gathered([&](int i) { return (*item[i])[c]; });
		return wide;
	}
	template <int size> [[gnu::always_inline]] void set(const Eigen::Matrix<Lanes, size, 1>& x) const
	{
		for (int i = laneCount; i-- > 0;)
			for (int c = 0; c < size; ++c)
				(*item[i])[c] = lane(x[c], i);
	}
	/// A member of each item.
	template <class Class> [[gnu::always_inline]] Lanes get(double Class::*member) const
	{
		return gathered([&](int i) { return item[i]->*member; });
	}
	template <class Class> [[gnu::always_inline]] Vec3s get(Vec3 Class::*member) const
	{
		const auto component = [&](int c) { return gathered([&](int i) { return (item[i]->*member)[c]; }); };
		return { component(0), component(1), component(2) };
	}
	/// A component of a member: of an array of vectors, or of a vector of numbers.
	template <class Class> [[gnu::always_inline]] Vec3s get(Vec3 (Class::*member)[3], int k) const
	{
		const auto component = [&](int c) { return gathered([&](int i) { return (item[i]->*member)[k][c]; }); };
		return { component(0), component(1), component(2) };
	}
	template <class Array, class Class> [[gnu::always_inline]] Lanes get(Array Class::*member, int k) const
	{
		return gathered([&](int i) { return (item[i]->*member)[k]; });
	}
	template <class Value, class Class, class Wide>
	[[gnu::always_inline]] void set(Value Class::*member, const Wide& x) const
	{
		for (int i = laneCount; i-- > 0;)
			item[i]->*member = lane(x, i);
	}
};

/// Scalar version: one item.
template <class Item> class Group<double, Item> {
	Item& item;

public:
	Group(Item* first, size_t)
	        : item(*first)
	{
	}
	template <class Address>
	Group(size_t, Address at)
	        : item(*at(0))
	{
	}
	double numbers() const { return double(item); }
	const Item& vectors() const { return item; }
	template <class Vector> void set(const Vector& x) const { item = x; }
	template <class Value, class Class> const Value& get(Value Class::*member) const { return item.*member; }
	template <class Class> const Vec3& get(Vec3 (Class::*member)[3], int k) const { return (item.*member)[k]; }
	template <class Array, class Class> double get(Array Class::*member, int k) const { return (item.*member)[k]; }
	template <class Value, class Class> void set(Value Class::*member, const Value& x) const { item.*member = x; }
};

} // namespace timber

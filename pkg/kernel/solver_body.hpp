// SPDX-License-Identifier: GPL-2.0-or-later
/// Bodies as the solver sees them, in the world frame.
#pragma once
#include "kinematics.hpp"
#include <cstring>

namespace timber {

/// v, shortened to the length if it is longer. Vector: of two or three Numbers.
template <class Vector, class Number> Vector clipped(const Vector& v, Number length)
{
	const Number square = v.squaredNorm();
	return selectLazily(
	        square > length * length, [&] { return Vector(v * Number(length / sqrt(square))); }, [&] { return v; });
}

/// Largest factor s of an impulse whose work on the bodies, s (linear + s square) / 2, is at most the account. [-]
/// linear, square: two parts of the work, one of them > 0; account: >= 0 [J].
inline double largestShare(double linear, double square, double account)
{
	const double root = std::sqrt(linear * linear + 8 * square * account);
	return linear > 0 ? 4 * account / (linear + root) : (root - linear) / (2 * square);
}

struct SolverBody {
	Vec3 velocity, spin; ///< before the step [m/s, rad/s]
	Vec3 newVelocity, newSpin; ///< in: after all forces except contacts and joint dashpots; out: after these, too
	double inverseMass; ///< 0 for a fixed body [1/kg]
	Mat3 inverseInertia; ///< world axes [1/(kg m2)]
	Vec3 position = Vec3::Zero(); ///< [m]
	Mat3 axes = Mat3::Identity(); ///< rotation matrix from the body's frame to the world
};

/// Inverse of the equivalent mass of two bodies (Eq. 43). [1/kg]
inline double pairInverseMass(const SolverBody& a, const SolverBody& b) { return a.inverseMass + b.inverseMass; }

/// [v]: [v] x = v cross x.
inline Mat3 crossMatrix(const Vec3& v)
{
	Mat3 m;
	m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
	return m;
}

/// Inverse effective mass of a body at a point: change of the point's velocity per unit impulse, 1/m - [r] I^-1 [r].
/// [1/kg] arm: r, from the centre of mass to the point [m].
inline Mat3 bodyResponse(const SolverBody& body, const Vec3& arm)
{
	const Mat3 s = crossMatrix(arm);
	Mat3 response = -(s * body.inverseInertia * s);
	response.diagonal().array() += body.inverseMass;
	return response;
}

/// R with R R^T = M^-1 for one body; zero for a fixed one.
struct InverseRootMass {
	double linear = 0; ///< [kg^-1/2]
	Mat3 angular = Mat3::Zero(); ///< lower triangle [kg^-1/2 m^-1]

	InverseRootMass() = default;
	explicit InverseRootMass(const SolverBody& body)
	        : linear(std::sqrt(body.inverseMass))
	{
		const Mat3& I = body.inverseInertia;
		Mat3& L = angular;
		const auto root = [](double square) { return square > 0 ? std::sqrt(square) : 0; };
		const auto over = [](double x, double y) { return y > 0 ? x / y : 0; };
		L(0, 0) = root(I(0, 0));
		L(1, 0) = over(I(1, 0), L(0, 0));
		L(2, 0) = over(I(2, 0), L(0, 0));
		L(1, 1) = root(I(1, 1) - L(1, 0) * L(1, 0));
		L(2, 1) = over(I(2, 1) - L(2, 0) * L(1, 0), L(1, 1));
		L(2, 2) = root(I(2, 2) - L(2, 0) * L(2, 0) - L(2, 1) * L(2, 1));
	}
	/// R^T times a torque, or the angular part of a row.
	template <class Number> Vec3Of<Number> weightedTorque(const Vec3Of<Number>& t) const
	{
		const Mat3& L = angular;
		return { Number(L(0, 0)) * t.x() + Number(L(1, 0)) * t.y() + Number(L(2, 0)) * t.z(),
			Number(L(1, 1)) * t.y() + Number(L(2, 1)) * t.z(), Number(L(2, 2)) * t.z() };
	}
	/// Mass-weighted spin: R^-1 times a spin. [kg^1/2 m/s]
	Vec3 weightedSpin(const Vec3& spin) const
	{
		const Mat3& L = angular;
		const auto over = [](double x, double y) { return y > 0 ? x / y : 0; };
		const double x = over(spin.x(), L(0, 0)), y = over(spin.y() - L(1, 0) * x, L(1, 1));
		return { x, y, over(spin.z() - L(2, 0) * x - L(2, 1) * y, L(2, 2)) };
	}
	/// Change of spin of the angular part of a change of W. [rad/s]
	Vec3 spinOf(const double* w) const
	{
		const Mat3& L = angular;
		return { L(0, 0) * w[0], L(1, 0) * w[0] + L(1, 1) * w[1],
			L(2, 0) * w[0] + L(2, 1) * w[1] + L(2, 2) * w[2] };
	}
};

/// A body in the sweeps: change of its mass-weighted velocity and spin. [kg^1/2 m/s]
struct WeightedBody {
	double change[6] = {};
	InverseRootMass root;
	long step = -1; ///< of the solver, for which it was started
};

/// The two bodies of a pair in a step of the solver.
struct SolverBodies {
	const SolverBody &a, &b;
	const InverseRootMass &rootA, &rootB;

	/// Velocity of B relative to A at a point, before the step, and at present. [m/s]
	template <class Number>
	Vec3Of<Number> velocityBefore(const Vec3Of<Number>& armA, const Vec3Of<Number>& armB) const
	{
		return relativeVelocity<Number>(armA, armB, a.velocity, a.spin, b.velocity, b.spin);
	}
	template <class Number> Vec3Of<Number> velocity(const Vec3Of<Number>& armA, const Vec3Of<Number>& armB) const
	{
		return relativeVelocity<Number>(armA, armB, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin);
	}
};

/// Twelve numbers of a pair: six of A, six of B. Sums are those of any processor, to the last bit.
struct PairVector {
	typedef double Quad __attribute__((vector_size(4 * sizeof(double))));
	Quad part[3];

	static PairVector of(const double* a, const double* b)
	{
		const Half end = loaded<Half>(a + 4), start = loaded<Half>(b);
		return { { loaded<Quad>(a), __builtin_shufflevector(end, start, 0, 1, 2, 3), loaded<Quad>(b + 2) } };
	}
	void store(double* a, double* b) const
	{
		const Half end = __builtin_shufflevector(part[1], part[1], 0, 1),
		           start = __builtin_shufflevector(part[1], part[1], 2, 3);
		std::memcpy(a, &part[0], sizeof(Quad));
		std::memcpy(a + 4, &end, sizeof(Half));
		std::memcpy(b, &start, sizeof(Half));
		std::memcpy(b + 2, &part[2], sizeof(Quad));
	}
	/// Four partial sums of the scalar product.
	[[gnu::always_inline]] Quad partialDot(const PairVector& o) const
	{
		return part[0] * o.part[0] + part[1] * o.part[1] + part[2] * o.part[2];
	}
	/// Scalar products with the three vectors from `rows` on, and 0.
	[[gnu::always_inline]] Quad dots(const PairVector* rows) const
	{
		const Quad a = rows[0].partialDot(*this), b = rows[1].partialDot(*this), c = rows[2].partialDot(*this),
		           zero = {};
		const Quad ab = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
		const Quad c0
		        = __builtin_shufflevector(c, zero, 0, 4, 2, 6) + __builtin_shufflevector(c, zero, 1, 5, 3, 7);
		return __builtin_shufflevector(ab, c0, 0, 1, 4, 5) + __builtin_shufflevector(ab, c0, 2, 3, 6, 7);
	}
	[[gnu::always_inline]] double dot(const PairVector& o) const
	{
		const Quad sums = partialDot(o);
		return (sums[0] + sums[1]) + (sums[2] + sums[3]);
	}
	[[gnu::always_inline]] void add(const PairVector& o, double factor)
	{
		for (int i = 0; i < 3; ++i)
			part[i] += o.part[i] * factor;
	}

private:
	typedef double Half __attribute__((vector_size(2 * sizeof(double))));
	template <class Vector> static Vector loaded(const double* x)
	{
		Vector v;
		std::memcpy(&v, x, sizeof(Vector));
		return v;
	}
};

} // namespace timber

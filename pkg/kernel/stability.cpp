// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability.hpp"
#include "preconditions.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>

namespace timber {
namespace {

	using Twist = Eigen::Matrix<double, 6, 1>; ///< velocity and spin of a body

	/// M^-1 K x.
	std::vector<Twist> accelerations(const std::vector<SolverBody>& bodies, const std::vector<PointSpring>& springs,
	        const std::vector<Twist>& x)
	{
		std::vector<Twist> force(bodies.size(), Twist::Zero());
		for (const PointSpring& p : springs) {
			const Twist &a = x[p.bodyA], &b = x[p.bodyB];
			const Vec3 stretch
			        = b.head<3>() + b.tail<3>().cross(p.armB) - a.head<3>() - a.tail<3>().cross(p.armA);
			const double along = stretch.dot(p.normal);
			const Vec3 f = p.normalStiffness * along * p.normal
			        + p.shearStiffness * (stretch - along * p.normal);
			force[p.bodyA].head<3>() -= f;
			force[p.bodyA].tail<3>() -= p.armA.cross(f);
			force[p.bodyB].head<3>() += f;
			force[p.bodyB].tail<3>() += p.armB.cross(f);
		}
		for (size_t k = 0; k < bodies.size(); ++k) {
			force[k].head<3>() *= bodies[k].inverseMass;
			force[k].tail<3>() = (bodies[k].inverseInertia * force[k].tail<3>()).eval();
		}
		return force;
	}

	[[maybe_unused]] bool isValid(const PointSpring& p, size_t bodies)
	{
		return p.bodyA >= 0 && p.bodyB >= 0 && size_t(std::max(p.bodyA, p.bodyB)) < bodies && isFinite(p.armA)
		        && isFinite(p.armB) && isUnit(p.normal) && p.normalStiffness >= 0 && p.shearStiffness >= 0;
	}

	double norm(const std::vector<Twist>& x)
	{
		double sum = 0;
		for (const Twist& m : x)
			sum += m.squaredNorm();
		return std::sqrt(sum);
	}

} // namespace

double largestEigenvalue(const std::vector<SolverBody>& bodies, const std::vector<PointSpring>& springs)
{
	assert(std::all_of(
	        springs.begin(), springs.end(), [&](const PointSpring& p) { return isValid(p, bodies.size()); }));
	constexpr int rounds = 2000;
	constexpr double accuracy = 1e-6; // relative change per round; the remaining error is some hundred times larger
	std::vector<Twist> x(bodies.size());
	for (size_t k = 0; k < x.size(); ++k) // a start vector that is orthogonal to no eigenvector by symmetry
		for (int i = 0; i < 6; ++i)
			x[k][i] = double((6 * k + size_t(i) + 1) * 40503 % 65536) / 32768 - 1;
	double value = 0;
	for (int round = 0; round < rounds; ++round) {
		const double length = norm(x);
		if (length == 0) return 0;
		for (Twist& m : x)
			m /= length;
		x = accelerations(bodies, springs, x);
		const double next = norm(x);
		if (std::abs(next - value) <= accuracy * next) return next;
		value = next;
	}
	return value;
}

} // namespace timber

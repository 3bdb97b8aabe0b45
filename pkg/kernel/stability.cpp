// SPDX-License-Identifier: GPL-2.0-or-later
#include "stability.hpp"
#include <cmath>

namespace timber {
namespace {

	using Motion = Eigen::Matrix<double, 6, 1>; ///< velocity and spin of a body

	/// M^-1 K x.
	std::vector<Motion> accelerations(const std::vector<SolverBody>& bodies, const std::vector<StiffPoint>& points, const std::vector<Motion>& x)
	{
		std::vector<Motion> force(bodies.size(), Motion::Zero());
		for (const StiffPoint& p : points) {
			const Motion &a = x[p.bodyA], &b = x[p.bodyB];
			const Vec3 stretch = b.head<3>() + b.tail<3>().cross(p.armB) - a.head<3>() - a.tail<3>().cross(p.armA);
			const double along = stretch.dot(p.normal);
			const Vec3 f = p.normalStiffness * along * p.normal + p.shearStiffness * (stretch - along * p.normal);
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

	double norm(const std::vector<Motion>& x)
	{
		double sum = 0;
		for (const Motion& m : x)
			sum += m.squaredNorm();
		return std::sqrt(sum);
	}

} // namespace

double largestEigenvalue(const std::vector<SolverBody>& bodies, const std::vector<StiffPoint>& points)
{
	constexpr int rounds = 2000;
	constexpr double accuracy = 1e-6; // change per round; the error left is some hundred times larger
	std::vector<Motion> x(bodies.size());
	for (size_t k = 0; k < x.size(); ++k) // no symmetry that an eigenvector could hide behind
		for (int i = 0; i < 6; ++i)
			x[k][i] = std::sin(1 + 7.3 * double(k) + 2.9 * i);
	double value = 0;
	for (int round = 0; round < rounds; ++round) {
		const double length = norm(x);
		if (length == 0) return 0;
		for (Motion& m : x)
			m /= length;
		x = accelerations(bodies, points, x);
		const double next = norm(x);
		if (std::abs(next - value) <= accuracy * next) return next;
		value = next;
	}
	return value;
}

} // namespace timber

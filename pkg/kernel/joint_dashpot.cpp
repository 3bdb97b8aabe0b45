// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint_dashpot.hpp"
#include "kinematics.hpp"
#include "preconditions.hpp"
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>

namespace timber {
namespace {

	/// K in the axes of A.
	Mat6 stiffnessMatrix(const SpringGroup& springs, const Vec3& centre)
	{
		const Mat3 k = springs.stiffness.shear * Mat3::Identity()
		        + (springs.stiffness.normal - springs.stiffness.shear) * springs.normal * springs.normal.transpose();
		Mat6 all = Mat6::Zero();
		for (size_t i = 0; i < springs.broken.size(); ++i) {
			if (springs.broken[i]) continue;
			const Mat3 r = crossMatrix(springs.anchors[i] - centre);
			all.topLeftCorner<3, 3>() += k;
			all.bottomRightCorner<3, 3>() -= r * k * r;
		}
		return all;
	}

	Vec3 centreOf(const SpringGroup& springs)
	{
		Vec3 sum = Vec3::Zero();
		for (size_t i = 0; i < springs.broken.size(); ++i)
			if (!springs.broken[i]) sum += springs.anchors[i];
		return sum / double(springs.count());
	}

	/// Part of a body in R.
	Mat6 twistResponse(const SolverBody& body, const Vec3& arm)
	{
		const Mat3 turned = body.inverseInertia * crossMatrix(arm);
		Mat6 response;
		response << bodyResponse(body, arm), turned.transpose(), turned, body.inverseInertia;
		return response;
	}

	/// R in the axes of A.
	Mat6 response(const SolverBody& a, const SolverBody& b, const Mat3& axesA, const Vec3& centre)
	{
		const Vec3 arm = axesA * centre;
		Mat6 axes = Mat6::Zero();
		axes.topLeftCorner<3, 3>() = axes.bottomRightCorner<3, 3>() = axesA;
		return axes.transpose() * (twistResponse(a, arm) + twistResponse(b, arm + a.position - b.position)) * axes;
	}

	Vec6 twist(const DashpotConstraint& c, const Vec3& vA, const Vec3& wA, const Vec3& vB, const Vec3& wB)
	{
		Vec6 w;
		w << relativeVelocity<double>(c.armA, c.armB, vA, wA, vB, wB), wB - wA;
		return w;
	}

	/// eta_u; after the sweeps: eta'.
	Vec6 currentModalVelocity(const DashpotConstraint& c, const SolverBody& a, const SolverBody& b)
	{
		return c.modes.transpose() * twist(c, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin);
	}

	/// Changes the velocities of a free body by an impulse and an angular impulse about its centre.
	void accelerate(SolverBody& body, const Vec3& impulse, const Vec3& angular)
	{
		if (body.inverseMass == 0) return; // only read: it may belong to several islands, which other threads solve
		body.newVelocity += body.inverseMass * impulse;
		body.newSpin += body.inverseInertia * angular;
	}

	void apply(const DashpotConstraint& c, SolverBody& a, SolverBody& b, const Vec6& modalImpulse)
	{
		const Vec6 P = c.modes * modalImpulse;
		const Vec3 impulse = P.head<3>(), angular = P.tail<3>();
		accelerate(a, -impulse, -c.armA.cross(impulse) - angular);
		accelerate(b, impulse, c.armB.cross(impulse) + angular);
	}

} // namespace

JointModes jointModes(const SolverBody& a, const SolverBody& b, const Mat3& axesA, const SpringGroup& springs)
{
	assert(isRotation(axesA) && isUnit(springs.normal) && springs.anchors.size() == springs.broken.size() && springs.count() > 0);
	assert(springs.stiffness.normal > 0 && springs.stiffness.shear > 0 && pairInverseMass(a, b) > 0);
	JointModes result;
	result.springs = springs.count();
	result.stiffness = springs.stiffness;
	result.pairInverseMass = pairInverseMass(a, b);
	result.centre = centreOf(springs);
	const Mat6 L = response(a, b, axesA, result.centre).llt().matrixL(); // R = L L^T
	const Eigen::SelfAdjointEigenSolver<Mat6> solver(L.transpose() * stiffnessMatrix(springs, result.centre) * L);
	result.frequencies = solver.eigenvalues().cwiseMax(0).cwiseSqrt(); // rounding may make the eigenvalue of a free rotation negative
	result.modes = L.transpose().triangularView<Eigen::Upper>().solve(solver.eigenvectors());
	return result;
}

Vec6 convertedImpulse(const Vec6& q, const JointModes& from, const JointModes& to)
{
	assert(to.springs > 0 && isFinite(q));
	return to.modes.partialPivLu().solve(from.modes * q);
}

void prepareDashpot(DashpotConstraint& c, const SolverBody& a, const SolverBody& b, const DashpotInput& input, double h, bool isExplicit)
{
	assert(h > 0 && input.ratio >= 0 && input.modes.springs > 0 && isRotation(input.axesA) && isFinite(input.impulse));
	c.armA = input.axesA * input.modes.centre;
	c.armB = c.armA + a.position - b.position;
	c.modes.topRows<3>() = input.axesA * input.modes.modes.topRows<3>();
	c.modes.bottomRows<3>() = input.axesA * input.modes.modes.bottomRows<3>();
	c.before = c.modes.transpose() * twist(c, a.velocity, a.spin, b.velocity, b.spin);
	const Vec6 x = h * input.ratio * input.modes.frequencies;
	c.share = x.array() / (1 + x.array());
	c.impulse = isExplicit ? Vec6(-2 * x.cwiseProduct(c.before)) : input.impulse;
}

void warmStartDashpot(const DashpotConstraint& c, SolverBody& a, SolverBody& b) { apply(c, a, b, c.impulse); }

void solveDashpot(DashpotConstraint& c, SolverBody& a, SolverBody& b)
{
	const Vec6 impulse = c.share.cwiseProduct(c.impulse - c.before - currentModalVelocity(c, a, b)); // (3)
	const Vec6 change = impulse - c.impulse;
	c.impulse = impulse;
	c.squaredChange = change.squaredNorm();
	apply(c, a, b, change);
}

DashpotForce dashpotForce(const DashpotConstraint& c, const SolverBody& a, const SolverBody& b, double h)
{
	assert(h > 0);
	const Vec6 force = c.modes * c.impulse / h;
	return { force.head<3>(), force.tail<3>(), -c.impulse.dot(c.before + currentModalVelocity(c, a, b)) / 2 };
}

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint_modes.hpp"
#include "kinematics.hpp"
#include "preconditions.hpp"
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>

namespace timber {
namespace {

	/// K in the axes of A.
	Mat6 stiffnessMatrix(const SpringGroup& springs, const Vec3& centre)
	{
		const Mat3 k = springs.stiffness.shear * Mat3::Identity()
		        + (springs.stiffness.normal - springs.stiffness.shear) * springs.normal
		                * springs.normal.transpose();
		Mat6 matrix = Mat6::Zero();
		for (size_t i = 0; i < springs.broken.size(); ++i) {
			if (springs.broken[i]) continue;
			const Mat3 r = crossMatrix(springs.anchors[i] - centre);
			matrix.topLeftCorner<3, 3>() += k;
			matrix.bottomRightCorner<3, 3>() -= r * k * r;
		}
		return matrix;
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

	/// The same 3x3 matrix for translations and rotations.
	Mat6 twice(const Mat3& block)
	{
		Mat6 matrix = Mat6::Zero();
		matrix.topLeftCorner<3, 3>() = matrix.bottomRightCorner<3, 3>() = block;
		return matrix;
	}

	/// |E| / phi of (4) for the worst axis, at most. response: R_B, in the axes of A.
	double sensitivityOf(const Mat6& modes, const Mat6& response)
	{
		double squares = 0;
		for (int axis = 0; axis < 3; ++axis) {
			const Mat6 turned = twice(crossMatrix(Vec3::Unit(axis))) * response;
			squares += (modes.transpose() * (turned + turned.transpose()) * modes).squaredNorm();
		}
		return std::sqrt(squares);
	}

	/// w of these velocities and spins, in world axes.
	[[gnu::always_inline]] inline Vec6 twist(
	        const ModalConstraint& c, const Vec3& vA, const Vec3& wA, const Vec3& vB, const Vec3& wB)
	{
		Vec6 w;
		w.head<3>() = relativeVelocity<double>(c.armA, c.armB, vA, wA, vB, wB);
		w.tail<3>() = wB - wA;
		return w;
	}

	/// x^T y of six numbers; x: every stride-th number. In pairs, so that the processor need not wait for each sum.
	[[gnu::always_inline]] inline double dot(const double* x, int stride, const Vec6& y)
	{
		return (x[0] * y[0] + x[stride] * y[1]) + (x[2 * stride] * y[2] + x[3 * stride] * y[3])
		        + (x[4 * stride] * y[4] + x[5 * stride] * y[5]);
	}

	/// Z^T times a twist in world axes.
	[[gnu::always_inline]] inline Vec6 modalVelocity(const ModalConstraint& c, const Vec6& twist)
	{
		Vec6 turned, result;
		turned.head<3>() = c.axesA.transpose() * twist.head<3>();
		turned.tail<3>() = c.axesA.transpose() * twist.tail<3>();
		for (int k = 0; k < 6; ++k)
			result[k] = dot(c.modes->modes.data() + 6 * k, 1, turned);
		return result;
	}

	/// Sets modes, axes, arms and eta.
	void place(ModalConstraint& c, const SolverBody& a, const SolverBody& b, const JointModes& modes,
	        const Mat3& axesA)
	{
		c.modes = &modes;
		c.axesA = axesA;
		c.armA = axesA * modes.centre;
		c.armB = c.armA + a.position - b.position;
		c.before = modalVelocity(c, twist(c, a.velocity, a.spin, b.velocity, b.spin));
	}

	/// Z q, in world axes.
	[[gnu::always_inline]] inline JointImpulse impulseOf(const ModalConstraint& c, const Vec6& q)
	{
		Vec6 P;
		for (int i = 0; i < 6; ++i)
			P[i] = dot(c.modes->modes.data() + i, 6, q);
		return { c.axesA * P.head<3>(), c.axesA * P.tail<3>() };
	}

	[[gnu::always_inline]] inline void apply(
	        const ModalConstraint& c, const BodyMotion& a, const BodyMotion& b, const Vec6& q)
	{
		const JointImpulse P = impulseOf(c, q);
		a.accelerate(-P.linear, -c.armA.cross(P.linear) - P.angular);
		b.accelerate(P.linear, c.armB.cross(P.linear) + P.angular);
	}

	/// Z^T u; after the sweeps: eta'.
	[[gnu::always_inline]] inline Vec6 modalNow(const ModalConstraint& c, const BodyMotion& a, const BodyMotion& b)
	{
		return modalVelocity(c, twist(c, a.velocity(), a.spin(), b.velocity(), b.spin()));
	}

} // namespace

JointModes jointModes(const SolverBody& a, const SolverBody& b, const Mat3& axesA, const SpringGroup& springs,
        const JointState& state)
{
	assert(isRotation(axesA) && isUnit(springs.normal) && springs.anchors.size() == springs.broken.size()
	        && springs.count() > 0);
	assert(springs.stiffness.normal > 0 && springs.stiffness.shear >= 0 && pairInverseMass(a, b) > 0);
	JointModes result;
	result.state = state;
	result.centre = centreOf(springs);
	const Vec3 arm = axesA * result.centre;
	const Mat6 axes = twice(axesA),
	           responseB = axes.transpose() * twistResponse(b, arm + a.position - b.position) * axes,
	           L = (axes.transpose() * twistResponse(a, arm) * axes + responseB).llt().matrixL(); // R = L L^T
	const Eigen::SelfAdjointEigenSolver<Mat6> solver(L.transpose() * stiffnessMatrix(springs, result.centre) * L);
	// Rounding may make the eigenvalue of a free rotation negative
	result.frequencies = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
	result.twists = L * solver.eigenvectors();
	result.modes = L.transpose().triangularView<Eigen::Upper>().solve(solver.eigenvectors());
	result.sensitivity = sensitivityOf(result.modes, responseB);
	return result;
}

double dashpotPower(const SolverBody& a, const SolverBody& b, const JointModes& modes, const Mat3& axesA,
        const JointDamping& damping)
{
	ModalConstraint c;
	place(c, a, b, modes, axesA);
	return modes.frequencies.unaryExpr([&](double omega) { return damping.of(omega); }).dot(c.before.cwiseAbs2());
}

void prepareModes(ModalConstraint& c, const SolverBody& a, const SolverBody& b, const JointModes& modes,
        const Mat3& axesA, const JointDamping& damping, double h)
{
	assert(h > 0 && damping.ratio >= 0 && damping.time >= 0 && damping.tangent >= 0);
	assert(modes.state.springs > 0 && isRotation(axesA));
	place(c, a, b, modes, axesA);
	const Eigen::Array<double, 6, 1> phase = h * modes.frequencies.array(),
	                                 x
	        = h / 2 * modes.frequencies.array().unaryExpr([&](double omega) { return damping.of(omega); });
	const double stiffest = std::max(stiffPhase, phase[5]), square = stiffest * stiffest; // frequencies increase
	c.thresholdShare = stiffest > stiffPhase ? stiffToleranceShare / (square * square) : 1;
	c.decay = x;
	c.share = x / (1 + x);
	c.bias = -x / (1 + x) * c.before.array();
	c.impulse.setZero();
	c.h = h;
	c.dissipated = 0;
}

void addSprings(ModalConstraint& c, SpringSteps springs)
{
	c.springs = std::move(springs);
	c.impulse = c.springs.warmStart(c.h);
}

void warmStart(const ModalConstraint& c, const BodyMotion& a, const BodyMotion& b)
{
	if (!c.springs.empty()) apply(c, a, b, c.impulse);
}

namespace {
	/// q by (3), within the energy that dashpots dissipate.
	Vec6 dashpotImpulse(const ModalConstraint& c, const Vec6& now)
	{
		const Vec6 sum = c.before + now - c.impulse; // eta + eta' without q
		Vec6 q = c.share.cwiseProduct(c.impulse - now) + c.bias;
		const double square = q.squaredNorm(), linear = q.dot(sum); // work: (linear + square) / 2
		if (linear + square > 0) q *= largestShare(linear, square, 0);
		return q;
	}
}

void solveModes(ModalConstraint& c, const BodyMotion& a, const BodyMotion& b, double threshold)
{
	const Vec6 now = modalNow(c, a, b);
	const Vec6 q = c.springs.empty() ? dashpotImpulse(c, now) : c.springs.impulse(c.step(), now - c.impulse, now),
	           change = q - c.impulse;
	c.squaredChange = change.squaredNorm();
	if (c.squaredChange <= threshold) return;
	c.impulse += change;
	apply(c, a, b, change);
}

void applyExplicitModes(ModalConstraint& c, const BodyMotion& a, const BodyMotion& b)
{
	c.impulse = -2 * c.decay.cwiseProduct(c.before);
	apply(c, a, b, c.impulse);
}

void finishModes(ModalConstraint& c, const BodyMotion& a, const BodyMotion& b)
{
	const Vec6 now = modalNow(c, a, b), sum = c.before + now;
	c.after = now;
	if (c.springs.empty()) c.dissipated = -c.impulse.dot(sum) / 2;
	else {
		c.dissipated = sum.dot(c.decay.cwiseProduct(sum)) / 2;
		c.springs.finish(c.step(), c.impulse, now);
	}
}

JointImpulse jointImpulse(const ModalConstraint& c) { return impulseOf(c, c.impulse); }

} // namespace timber

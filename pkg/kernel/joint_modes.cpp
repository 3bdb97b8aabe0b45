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

	/// Modes in world axes: eta = linear^T (vB - vA) + onB^T wB - onA^T wA.
	struct ModalAxes {
		Mat36 linear; ///< [kg^1/2]
		Mat36 onA, onB; ///< about the centres of mass [kg^1/2 m]

		ModalAxes(const JointModes& modes, const Mat3& axesA, const Vec3& armA, const Vec3& armB)
		{
			linear = axesA * modes.modes.topRows<3>();
			const Mat36 angular = axesA * modes.modes.bottomRows<3>();
			for (int k = 0; k < 6; ++k) {
				onA.col(k) = armA.cross(linear.col(k)) + angular.col(k);
				onB.col(k) = armB.cross(linear.col(k)) + angular.col(k);
			}
		}
		Vec6 velocity(const Vec3& vA, const Vec3& wA, const Vec3& vB, const Vec3& wB) const
		{
			return linear.transpose() * (vB - vA) + onB.transpose() * wB - onA.transpose() * wA;
		}
	};

	/// J R of contact_solver.hpp for one mode.
	PairVector rowOf(const ModalAxes& axes, int k, const InverseRootMass& rootA, const InverseRootMass& rootB)
	{
		const Vec3 linear = axes.linear.col(k), angularA = rootA.weightedTorque<double>(axes.onA.col(k)),
		           angularB = rootB.weightedTorque<double>(axes.onB.col(k));
		const Vec3 a = -rootA.linear * linear, b = rootB.linear * linear;
		using Quad = PairVector::Quad; // no array of numbers, from which the processor loads vectors late
		return { { Quad { a[0], a[1], a[2], -angularA[0] }, Quad { -angularA[1], -angularA[2], b[0], b[1] },
			Quad { b[2], angularB[0], angularB[1], angularB[2] } } };
	}

	[[gnu::always_inline]] inline void apply(const ModalConstraint& c, PairVector& change, const Vec6& q)
	{
		for (int k = 0; k < 6; ++k)
			change.add(c.rows[k / 3][k % 3], q[k]);
	}

	/// Z^T u; after the sweeps: eta'.
	[[gnu::always_inline]] inline Vec6 modalNow(const ModalConstraint& c, const PairVector& change)
	{
		Vec6 now = c.velocity;
		for (int half = 0; half < 2; ++half) {
			const PairVector::Quad rates = change.dots(c.rows[half]);
			for (int i = 0; i < 3; ++i)
				now[3 * half + i] += rates[i];
		}
		return now;
	}

	Vec3 armOfB(const Vec3& armA, const SolverBody& a, const SolverBody& b)
	{
		return armA + a.position - b.position;
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
	const Vec3 armA = axesA * modes.centre;
	const Vec6 eta
	        = ModalAxes(modes, axesA, armA, armOfB(armA, a, b)).velocity(a.velocity, a.spin, b.velocity, b.spin);
	return modes.frequencies.unaryExpr([&](double omega) { return damping.of(omega); }).dot(eta.cwiseAbs2());
}

void prepareModes(ModalConstraint& c, const SolverBodies& bodies, const JointModes& modes, const Mat3& axesA,
        const JointDamping& damping, double h)
{
	assert(h > 0 && damping.ratio >= 0 && damping.time >= 0 && damping.tangent >= 0);
	assert(modes.state.springs > 0 && isRotation(axesA));
	const auto& [a, b, rootA, rootB] = bodies;
	c.modes = &modes;
	c.axesA = axesA;
	c.armA = axesA * modes.centre;
	c.armB = armOfB(c.armA, a, b);
	const ModalAxes axes(modes, axesA, c.armA, c.armB);
	for (int k = 0; k < 6; ++k)
		c.rows[k / 3][k % 3] = rowOf(axes, k, rootA, rootB);
	c.before = axes.velocity(a.velocity, a.spin, b.velocity, b.spin);
	c.velocity = axes.velocity(a.newVelocity, a.newSpin, b.newVelocity, b.newSpin);
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

void warmStart(const ModalConstraint& c, PairVector& change)
{
	if (!c.springs.empty()) apply(c, change, c.impulse);
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

void solveModes(ModalConstraint& c, PairVector& velocity, double threshold, double share)
{
	const Vec6 now = modalNow(c, velocity);
	const Vec6 q = c.springs.empty() ? dashpotImpulse(c, now) : c.springs.impulse(c.step(), now - c.impulse, now),
	           change = q - c.impulse;
	c.squaredChange = change.squaredNorm();
	if (c.squaredChange <= threshold) return;
	const Vec6 applied = (c.springs.empty() ? 1 : share) * change;
	c.impulse += applied;
	apply(c, velocity, applied);
}

ModalLaw modalLaw(ModalConstraint& c, const Vec6& after)
{
	if (c.springs.empty()) return { -c.decay.cwiseProduct(c.before + after), c.decay.asDiagonal() };
	Mat6 slope;
	const Vec6 impulse = c.springs.impulseAt(c.step(), after, slope);
	return { impulse, slope };
}

bool keepsAccount(const ModalConstraint& c, const PairVector& change)
{
	return c.springs.empty() || c.springs.keepsAccount(c.step(), c.impulse, modalNow(c, change));
}

void applyExplicitModes(ModalConstraint& c, PairVector& change)
{
	c.impulse = -2 * c.decay.cwiseProduct(c.before);
	apply(c, change, c.impulse);
}

void finishModes(ModalConstraint& c, const PairVector& change)
{
	const Vec6 now = modalNow(c, change), sum = c.before + now;
	c.after = now;
	if (c.springs.empty()) c.dissipated = -c.impulse.dot(sum) / 2;
	else {
		c.dissipated = sum.dot(c.decay.cwiseProduct(sum)) / 2;
		c.springs.finish(c.step(), c.impulse, now);
	}
}

JointImpulse jointImpulse(const ModalConstraint& c)
{
	const Vec6 P = c.modes->modes * c.impulse;
	return { c.axesA * P.head<3>(), c.axesA * P.tail<3>() };
}

} // namespace timber

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
		for (const Vec3& anchor : springs.anchors) {
			const Mat3 r = crossMatrix(anchor - centre);
			matrix.topLeftCorner<3, 3>() += k;
			matrix.bottomRightCorner<3, 3>() -= r * k * r;
		}
		return matrix;
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

	/// The same for a shift of the centre of B by a unit length.
	double shiftSensitivityOf(const Mat6& modes, const Mat6& response)
	{
		double squares = 0;
		for (int axis = 0; axis < 3; ++axis) {
			Mat6 shift = Mat6::Zero();
			shift.topRightCorner<3, 3>() = crossMatrix(Vec3::Unit(axis));
			const Mat6 shifted = shift * response;
			squares += (modes.transpose() * (shifted + shifted.transpose()) * modes).squaredNorm();
		}
		return std::sqrt(squares);
	}

	/// J R of contact_solver.hpp of an impulse `linear` on B, with the torques onA, onB about the centres of mass.
	[[gnu::always_inline]] inline PairVector rowOf(
	        const Vec3& linear, const Vec3& onA, const Vec3& onB, const SolverBodies& bodies)
	{
		const auto& [bodyA, bodyB, rootA, rootB] = bodies;
		const Vec3 angularA = rootA.weightedTorque<double>(onA), angularB = rootB.weightedTorque<double>(onB),
		           a = -rootA.linear * linear, b = rootB.linear * linear;
		using Quad = PairVector::Quad; // no array of numbers, from which the processor loads vectors late
		return { { Quad { a[0], a[1], a[2], -angularA[0] }, Quad { -angularA[1], -angularA[2], b[0], b[1] },
			Quad { b[2], angularB[0], angularB[1], angularB[2] } } };
	}

	/// Velocity and spin of B relative to A at a joint's centre, in the axes of A.
	[[gnu::always_inline]] inline Vec6 twistOf(
	        const Mat3& axesA, const Vec3& velocity, const Vec3& wA, const Vec3& wB)
	{
		const Vec3 spin = wB - wA;
		Vec6 twist;
		for (int i = 0; i < 3; ++i) {
			twist[i] = axesA.col(i).dot(velocity);
			twist[3 + i] = axesA.col(i).dot(spin);
		}
		return twist;
	}

	template <int n>
	[[gnu::always_inline]] inline void apply(const ModalConstraint<n>& c, PairVector& change, const Modal<n>& q)
	{
		for (int k = 0; k < n; ++k)
			change.add(c.rows[k], q[k]);
	}

	/// Z^T u; after the sweeps: eta'.
	template <int n>
	[[gnu::always_inline]] inline Modal<n> modalNow(const ModalConstraint<n>& c, const PairVector& change)
	{
		Modal<n> now = c.velocity;
		if constexpr (n == 1) now[0] += change.dot(c.rows[0]);
		else
			for (int k = 0; k < n; k += 3) {
				const PairVector::Quad rates = change.dots(c.rows + k);
				for (int i = 0; i < 3; ++i)
					now[k + i] += rates[i];
			}
		return now;
	}

	/// D of each mode. [1/s]
	Vec6 damped(const JointDamping& damping, const Vec6& frequencies)
	{
		return frequencies.unaryExpr([&](double omega) { return damping.of(omega); });
	}

	Vec3 armOfB(const Vec3& armA, const SolverBody& a, const SolverBody& b)
	{
		return armA + a.position - b.position;
	}

} // namespace

JointModes jointModes(const SolverBody& a, const SolverBody& b, const Mat3& axesA, const SpringGroup& springs,
        const JointState& state)
{
	assert(isRotation(axesA) && isUnit(springs.normal) && !springs.anchors.empty());
	assert(springs.stiffness.normal > 0 && springs.stiffness.shear >= 0 && pairInverseMass(a, b) > 0);
	JointModes result;
	result.state = state;
	result.centre = mean(springs.anchors);
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
	result.shiftSensitivity = shiftSensitivityOf(result.modes, responseB);
	return result;
}

SpringAxis::SpringAxis(
        const SolverBody& a, const SolverBody& b, const Vec3& line, const Vec3& toEndA, const Vec3& toEndB, double k)
        : axis(line)
        , armA(toEndA)
        , armB(toEndB)
        , onA(armA.cross(axis))
        , onB(armB.cross(axis))
        , stiffness(k)
        , rate(axis.dot(relativeVelocity<double>(armA, armB, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin)))
        , others(0)
{
	assert(isUnit(axis) && stiffness > 0);
	response = a.inverseMass + b.inverseMass + onA.dot(a.inverseInertia * onA) + onB.dot(b.inverseInertia * onB);
}

double dashpotPower(const SolverBody& a, const SolverBody& b, const JointModes& modes, const Mat3& axesA,
        const JointDamping& damping)
{
	const Vec3 armA = axesA * modes.centre, armB = armOfB(armA, a, b),
	           v = relativeVelocity<double>(armA, armB, a.velocity, a.spin, b.velocity, b.spin);
	const Vec6 eta = modes.modes.transpose() * twistOf(axesA, v, a.spin, b.spin);
	return damped(damping, modes.frequencies).dot(eta.cwiseAbs2());
}

double dashpotPower(const SolverBody& a, const SolverBody& b, const SpringAxis& line, const JointDamping& damping)
{
	const Vec3 v = relativeVelocity<double>(line.armA, line.armB, a.velocity, a.spin, b.velocity, b.spin);
	const double omega = line.frequency(), along = line.axis.dot(v);
	return damping.of(omega) * along * along / line.response;
}

namespace {
	/// before, now: modal velocities before the step and without impulses of the solver; D: of each mode [1/s];
	/// highest: frequency
	template <int n>
	void prepare(ModalConstraint<n>& c, const Modal<n>& before, const Modal<n>& now, const Modal<n>& D,
	        double highest, double h)
	{
		assert(h > 0 && D.minCoeff() >= 0 && isRotation(c.axesA));
		c.before = before;
		c.velocity = now;
		const Eigen::Array<double, n, 1> x = h / 2 * D;
		c.phase = h * highest;
		const double stiffest = std::max(stiffPhase, c.phase), square = stiffest * stiffest;
		c.thresholdShare = stiffest > stiffPhase ? stiffToleranceShare / (square * square) : 1;
		c.decay = x;
		c.share = x / (1 + x);
		c.bias = -c.share.array() * before.array();
		c.impulse.setZero();
		c.h = h;
		c.dissipated = 0;
	}
}

/// The rows of the modes are sums of those of the six axes of A at the joint's centre.
void prepareModes(ModalConstraint<6>& c, const SolverBodies& bodies, const JointModes& modes, const Mat3& axesA,
        const JointDamping& damping, double h)
{
	assert(modes.state.springs > 0);
	const auto& [a, b, rootA, rootB] = bodies;
	const Vec3 none = Vec3::Zero();
	c.basis = &modes.modes;
	c.axesA = axesA;
	c.armA = axesA * modes.centre;
	c.armB = armOfB(c.armA, a, b);
	PairVector ofAxes[6];
	for (int i = 0; i < 3; ++i) {
		const Vec3 axis = axesA.col(i);
		ofAxes[i] = rowOf(axis, c.armA.cross(axis), c.armB.cross(axis), bodies);
		ofAxes[3 + i] = rowOf(none, axis, axis, bodies);
	}
	for (int k = 0; k < 6; ++k) {
		PairVector row {};
		for (int i = 0; i < 6; ++i)
			row.add(ofAxes[i], modes.modes(i, k));
		c.rows[k] = row;
	}
	const Vec6 before = twistOf(axesA, bodies.velocityBefore<double>(c.armA, c.armB), a.spin, b.spin),
	           now = twistOf(axesA, bodies.velocity<double>(c.armA, c.armB), a.newSpin, b.newSpin);
	prepare<6>(c, modes.modes.transpose() * before, modes.modes.transpose() * now,
	        damped(damping, modes.frequencies), modes.frequencies[5], h);
}

void prepareModes(ModalConstraint<1>& c, const SolverBodies& bodies, const SpringAxis& line, const Mat3& axesA,
        const JointDamping& damping, double h)
{
	const double scale = 1 / std::sqrt(line.response);
	c.basis = scale * line.axis;
	c.axesA = axesA;
	c.armA = line.armA;
	c.armB = line.armB;
	c.rows[0] = rowOf(c.basis, scale * line.onA, scale * line.onB, bodies);
	const double before = c.basis.dot(bodies.velocityBefore<double>(line.armA, line.armB)),
	             omega = line.frequency(), D = damping.of(omega) + line.others;
	prepare<1>(c, Modal<1>(before), Modal<1>(scale * line.rate), Modal<1>(D), omega, h);
}

template <int n> void addSprings(ModalConstraint<n>& c, SpringSteps<n> springs)
{
	c.springs = std::move(springs);
	c.impulse = c.springs.warmStart(c.h);
}

template <int n> void warmStart(const ModalConstraint<n>& c, PairVector& change)
{
	if (!c.springs.empty()) apply(c, change, c.impulse);
}

namespace {
	/// q by (3), within the energy that dashpots dissipate.
	template <int n> Modal<n> dashpotImpulse(const ModalConstraint<n>& c, const Modal<n>& now)
	{
		const Modal<n> sum = c.before + now - c.impulse; // eta + eta' without q
		Modal<n> q = c.share.cwiseProduct(c.impulse - now) + c.bias;
		const double square = q.squaredNorm(), linear = q.dot(sum); // work: (linear + square) / 2
		if (linear + square > 0) q *= largestShare(linear, square, 0);
		return q;
	}
}

template <int n> void solveModes(ModalConstraint<n>& c, PairVector& velocity, double share)
{
	const Modal<n> now = modalNow(c, velocity);
	const Modal<n> q
	        = c.springs.empty() ? dashpotImpulse(c, now) : c.springs.impulse(c.step(), now - c.impulse, now),
	        change = q - c.impulse;
	c.squaredChange = change.squaredNorm();
	const Modal<n> applied = (c.springs.empty() ? 1 : share) * change;
	c.impulse += applied;
	apply(c, velocity, applied);
}

template <int n> ModalLaw<n> modalLaw(ModalConstraint<n>& c, const Modal<n>& after)
{
	if (c.springs.empty()) return { -c.decay.cwiseProduct(c.before + after), c.decay.asDiagonal().toDenseMatrix() };
	ModalMatrix<n> slope;
	const Modal<n> impulse = c.springs.impulseAt(c.step(), after, slope);
	return { impulse, slope };
}

template <int n> bool keepsAccount(const ModalConstraint<n>& c, const PairVector& change)
{
	return c.springs.empty() || c.springs.keepsAccount(c.step(), c.impulse, modalNow(c, change));
}

template <int n> void applyExplicitModes(ModalConstraint<n>& c, PairVector& change)
{
	c.impulse = -2 * c.decay.cwiseProduct(c.before);
	apply(c, change, c.impulse);
}

template <int n> void finishModes(ModalConstraint<n>& c, const PairVector& change)
{
	const Modal<n> now = modalNow(c, change), sum = c.before + now;
	c.after = now;
	if (c.springs.empty()) c.dissipated = -c.impulse.dot(sum) / 2;
	else {
		c.dissipated = sum.dot(c.decay.cwiseProduct(sum)) / 2;
		c.springs.finish(c.step(), c.impulse, now);
	}
}

#define TIMBER_INSTANTIATE(n)                                                                                          \
	template void addSprings(ModalConstraint<n>&, SpringSteps<n>);                                                 \
	template void warmStart(const ModalConstraint<n>&, PairVector&);                                               \
	template void solveModes(ModalConstraint<n>&, PairVector&, double);                                            \
	template ModalLaw<n> modalLaw(ModalConstraint<n>&, const Modal<n>&);                                           \
	template bool keepsAccount(const ModalConstraint<n>&, const PairVector&);                                      \
	template void applyExplicitModes(ModalConstraint<n>&, PairVector&);                                            \
	template void finishModes(ModalConstraint<n>&, const PairVector&);
TIMBER_INSTANTIATE(1)
TIMBER_INSTANTIATE(6)
#undef TIMBER_INSTANTIATE

} // namespace timber

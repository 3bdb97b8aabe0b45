// SPDX-License-Identifier: GPL-2.0-or-later
/// Newton's method for an island whose sweeps converge slowly: light members that are pressed between heavy ones.
/// Impulses are functions P of the velocities after the step (point_law.hpp; modalLaw() for joints). The changes W of
/// the mass-weighted velocities of all free bodies are the root of
///     r(W) = W - sum (J R)^T P(u_0 + J R W)                                                     (10)
/// Without friction r is the gradient of a convex function, and the method converges from any start.
/// 1. r, and its derivative A = 1 - sum (J R)^T P' (J R);
/// 2. the direction D = -A^-1 r;
/// 3. W <- W + t D with the root t of D.r(W + t D), at most 1: the minimum of the convex function on the line;
/// 4. again from 1., until |r| is small.
/// The softness of P (point_law.hpp) falls from firstSoftness to leastSoftness, each root being the start of the next;
/// where a root is not found, it falls by less.
/// The impulses obey (3), (4) and (6), and (5) with a reserve.
#include "contact_solver.hpp"
#include "point_law.hpp"
#include <Eigen/LU>
#include <algorithm>

namespace timber {

namespace {

	using Vec12 = Eigen::Matrix<double, 12, 1>;
	using Mat12 = Eigen::Matrix<double, 12, 12>;

	/// Rows of J R from `rows` on.
	template <int n> Eigen::Matrix<double, n, 12> matrixOf(const PairVector* rows)
	{
		Eigen::Matrix<double, n, 12> J;
		for (int i = 0; i < n; ++i)
			for (int k = 0; k < 12; ++k)
				J(i, k) = rows[i].part[k / 4][k % 4];
		return J;
	}

	Vec3 firstThree(const PointStep::Quad& q) { return { q[0], q[1], q[2] }; }

} // namespace

class ContactSolver::Newton {
	ContactSolver& solver;
	std::vector<int> place; ///< of each body: of its six numbers in W; -1: fixed
	double softness = firstSoftness;
	Eigen::VectorXd W;
	Eigen::MatrixXd A;

	template <class Connection> Vec12 changeOf(const Connection& c, const Eigen::VectorXd& x) const
	{
		Vec12 change = Vec12::Zero();
		if (place[c.bodyA] >= 0) change.head<6>() = x.segment<6>(place[c.bodyA]);
		if (place[c.bodyB] >= 0) change.tail<6>() = x.segment<6>(place[c.bodyB]);
		return change;
	}
	/// Adds to r and A the change `push` of W and its derivative.
	template <class Connection>
	void add(const Connection& c, const Vec12& push, const Mat12* slope, Eigen::VectorXd& r)
	{
		const int at[2] = { place[c.bodyA], place[c.bodyB] };
		for (int i = 0; i < 2; ++i) {
			if (at[i] < 0) continue;
			r.segment<6>(at[i]) -= push.segment<6>(6 * i);
			for (int j = 0; j < 2 && slope; ++j)
				if (at[j] >= 0) A.block<6, 6>(at[i], at[j]) += slope->block<6, 6>(6 * i, 6 * j);
		}
	}
	void addPair(const SolverPair& pair, const Eigen::VectorXd& x, bool withSlope, Eigen::VectorXd& r)
	{
		const Vec12 change = changeOf(pair, x);
		Vec12 push = Vec12::Zero();
		Mat12 slope = Mat12::Zero();
		for (size_t k = 0; k < pair.count; ++k) {
			PointStep& c = solver.stepsOf(pair)[k];
			if (c.idle || c.response() == 0) continue;
			const auto J = matrixOf<3>(c.rows);
			const Vec3 after = firstThree(c.velocity) + J * change, p = impulseAt(c, after, softness);
			c.impulse = PointStep::Quad { p[0], p[1], p[2], 0 };
			push += J.transpose() * p;
			if (withSlope) slope += J.transpose() * impulseSlope(c, after, p, softness) * J;
		}
		add(pair, push, withSlope ? &slope : nullptr, r);
	}
	template <int n>
	void addJoint(ModalConstraint<n>& joint, const Eigen::VectorXd& x, bool withSlope, Eigen::VectorXd& r)
	{
		const auto J = matrixOf<n>(joint.rows);
		const ModalLaw<n> law = modalLaw<n>(joint, joint.velocity + J * changeOf(joint, x));
		joint.impulse = law.impulse;
		const Mat12 slope = withSlope ? Mat12(J.transpose() * law.slope * J) : Mat12();
		add(joint, J.transpose() * law.impulse, withSlope ? &slope : nullptr, r);
	}
	/// r at W = x, and sets the impulses; withSlope: sets A, too.
	Eigen::VectorXd residual(const Eigen::VectorXd& x, bool withSlope)
	{
		Eigen::VectorXd r = x;
		if (withSlope) A.setIdentity(x.size(), x.size());
		for (const SolverPair& pair : solver.pairs)
			addPair(pair, x, withSlope, r);
		solver.visitJoints([&](auto& joint) { addJoint(joint, x, withSlope, r); });
		return r;
	}
	/// t of step 3: regula falsi (Illinois), to a share of D.r at t = 0.
	double lengthOfStep(const Eigen::VectorXd& direction, double atStart)
	{
		const auto along = [&](double t) { return direction.dot(residual(W + t * direction, false)); };
		double low = 0, high = 1, atLow = atStart, atHigh = along(1), t = 1;
		if (atHigh * atStart >= 0) return 1;
		for (int k = 0; k < lineSteps; ++k) {
			t = (low * atHigh - high * atLow) / (atHigh - atLow);
			const double now = along(t);
			if (std::abs(now) <= lineTolerance * std::abs(atStart)) break;
			const bool isHigh = now * atStart < 0;
			(isHigh ? high : low) = t;
			(isHigh ? atHigh : atLow) = now;
			(isHigh ? atLow : atHigh) /= 2;
		}
		return t;
	}
	/// Steps 1 to 4 with the present softness. Returns whether they converge. The last root is found to rounding: its
	/// error would be created energy.
	bool findRoot()
	{
		const double kinetic = std::sqrt(solver.twiceKinetic);
		double last = std::numeric_limits<double>::infinity();
		for (int k = 0; k < newtonSteps; ++k) {
			const Eigen::VectorXd r = residual(W, true);
			const double size = r.norm();
			if (size <= newtonTolerance * (W.norm() + kinetic)) {
				if (softness > leastSoftness || size == 0 || size > 0.1 * last) return true;
				last = size;
			}
			const Eigen::VectorXd direction = -A.partialPivLu().solve(r);
			if (!direction.allFinite()) return false;
			W += lengthOfStep(direction, direction.dot(r)) * direction;
		}
		return false;
	}

public:
	explicit Newton(ContactSolver& island)
	        : solver(island)
	        , place(island.bodies->size(), -1)
	        , W(6 * island.freeBodies.size())
	{
		int n = 0;
		for (const int k : solver.freeBodies) {
			place[k] = n;
			for (const double w : solver.weighted[k].change)
				W[n++] = w;
		}
	}
	/// Whether the method converges down to leastSoftness.
	bool converges()
	{
		double reached = firstSoftness / softnessShare, share = softnessShare;
		for (int k = 0; k < softnessLevels; ++k) {
			const Eigen::VectorXd start = W;
			softness = std::max(leastSoftness, reached * share);
			if (!findRoot()) {
				W = start;
				share = std::sqrt(share);
			} else if (softness == leastSoftness) return true;
			else reached = softness;
		}
		return false;
	}
	/// Hands over the changes of the velocities by the impulses at W. Returns whether all joints keep their accounts.
	bool finish()
	{
		W -= residual(W, false);
		int n = 0;
		for (const int k : solver.freeBodies)
			for (double& w : solver.weighted[k].change)
				w = W[n++];
		bool kept = true;
		solver.visitJoints(
		        [&](const auto& joint) { kept = kept && keepsAccount(joint, solver.changeOf(joint)); });
		return kept;
	}
};

bool ContactSolver::solveByNewton()
{
	Newton newton(*this);
	return newton.converges() && newton.finish();
}

} // namespace timber

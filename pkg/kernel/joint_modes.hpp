// SPDX-License-Identifier: GPL-2.0-or-later
/// Vibration modes of a joint in the solver: dashpots, with which its two bodies vibrate against each other with a
/// given damping ratio, and the springs of stiff joints, which then set no limit to the step. Adapter: ImplicitJoints.
///
/// Two bodies that are connected by one joint, and free otherwise, have six vibration modes: translations and rotations
/// of B relative to A.
/// Let w be the relative velocity and spin at the joint's centre, P the impulse and angular impulse on B, R the
/// response, so that dw = R P, and K the stiffness of the unbroken springs. The modes z_k, columns of Z, have the
/// frequencies omega_k, with
///     Z^T R Z = 1,   K = Z omega^2 Z^T                                                          (1)
/// The damping matrix D = 2 zeta Z omega Z^T gives each mode the damping ratio zeta, rotations of a slender member
/// about its end included. D = tau K is that of springs with dashpots of tau times their stiffness; motions to which
/// further masses contribute, as the sway of a house, have the ratio tau omega_1 / 2 at their own frequency omega_1.
/// Springs that have yielded have the tangent stiffness kappa K, modes of the frequency kappa^1/2 omega:
///     D = Z (2 zeta kappa^1/2 omega + tau kappa omega^2) Z^T                                    (1a)
/// (Dashpots at the points of the springs, C = 2 zeta sqrt(m K), would damp these rotations some thirty times less.)
/// About the centroid of the springs' ends, translation and rotation are uncoupled: K is block diagonal.
///
/// Impulse of a step h: P = -h D (w + w') / 2, w before and w' after the step: second order, stable at any zeta h, and
/// the dissipated energy h (w + w')^T D (w + w') / 4 is never negative. In terms of the modes, P = Z q, eta = Z^T w,
/// these are six scalars:
///     q = -x (eta + eta'),   x = h (zeta kappa^1/2 omega + tau kappa omega^2 / 2)               (2)
/// With the current twist u, in which q0 acts already, eta' = Z^T u + q - q0, and a visit of the joint is
///     q = s (q0 - Z^T u) - x eta / (1 + x),   s = x / (1 + x)                                    (3)
/// The first visit of a step starts from q0 = 0, after the warm start of the contacts. Its error is small like s, so
/// that no impulse has to be kept from step to step.
/// Stiff joints, h omega > stiffPhase, have their springs in the solver, too (spring_step.hpp); a visit solves dashpots
/// and springs together. They start from the spring forces of the last step.
/// Z is fixed in the axes of A. It is reused while springs, masses and moments of inertia are the same and the bodies
/// have turned little against each other: (2) holds for any Z, and Z decides with (1) about the damping ratio and the
/// convergence of (3) only. With modes of another placement, Z^T R Z = 1 + E, the error of q is multiplied by -s E in
/// each visit. A turn by the angle phi about the axis n changes R by the response of B, R_B:
///     E = phi Z^T (N R_B + R_B N^T) Z,   N = diag([n], [n])                                      (4)
/// which is large for slender bodies and for long arms.
///
/// A single spring that acts along an axis n has one mode with a stiffness, of the present placement:
///     Z = n / a^1/2,   omega = (k a)^1/2                                                         (5)
/// with the response a along n where its force acts. Such joints have one scalar instead of six. The dashpots of several
/// of them along one line, as of the sheets of a wall, add up to one.
///
/// Glossary
///     D        damping       matrix of the joint's dashpots [N s/m, N s, N m s]
///     eta      -             modal velocity before the step; eta': after the step [kg^1/2 m/s]
///     K        stiffness     of the unbroken springs about the centre [N/m, N m]
///     kappa    tangent       tangent stiffness over K, 0 to 1 [-]
///     omega    frequency     angular, of a mode [rad/s]
///     P        impulse       on B at the joint's centre [N s, N m s]
///     q, q0    modal impulse after and before a visit [kg^1/2 m/s]
///     R        response      of w to P [1/kg, 1/(kg m), 1/(kg m2)]
///     s        share         of the modal impulse of a joint that is infinitely damped [-]
///     tau      time          of the dashpots: damping coefficient over stiffness [s]
///     w, u     twist         velocity and spin of B relative to A at the joint's centre: before the step, current
///                            [m/s, rad/s]
///     x        decay         decay rate of the mode times h [-]
///     Z        modes         in the axes of A [kg^1/2, kg^1/2 m]
///     zeta     ratio         damping ratio [-]
#pragma once
#include "constants.hpp"
#include "joint_law.hpp"
#include "solver_body.hpp"
#include "spring_step.hpp"
#include <algorithm>
#include <limits>
#include <type_traits>

namespace timber {

/// The unbroken springs of a joint.
struct SpringGroup {
	std::vector<Vec3> anchors; ///< their ends in A, in the frame of A [m]
	JointStiffness stiffness; ///< of each
	Vec3 normal; ///< unit, in the axes of A
};

/// What the vibration modes of a joint depend on.
struct JointState {
	size_t springs = 0; ///< number of the unbroken springs; 0: not computed
	JointStiffness stiffness { 0, 0 }; ///< of each
	/// Of A and B: inverse masses [1/kg], traces of the inverse moments of inertia [1/(kg m2)]
	Eigen::Array2d inverseMass = { 0, 0 }, inverseInertia = { 0, 0 };
	Mat3 relative = Mat3::Identity(); ///< rotation matrix from the frame of B to that of A
	Vec3 opening = Vec3::Zero(); ///< from the joint's centre in A to that in B, frame of A [m]

	/// Whether springs and bodies are the same but for their orientations.
	bool hasSame(const JointState& now) const
	{
		return springs == now.springs && stiffness.normal == now.stiffness.normal
		        && stiffness.shear == now.stiffness.shear && (inverseMass == now.inverseMass).all()
		        && ((inverseInertia - now.inverseInertia).abs() <= 1e-9 * inverseInertia).all();
	}
	/// Whether modes of this state serve for another one. largestTurn: of the bodies against each other [rad];
	/// largestShift: of the centre of B against the joint [m]
	bool fits(const JointState& now, double largestTurn, double largestShift) const
	{
		const double cosine = (relative.cwiseProduct(now.relative).sum() - 1) / 2;
		return hasSame(now) && cosine > 1 - largestTurn * largestTurn / 2
		        && (opening - now.opening).squaredNorm() <= largestShift * largestShift;
	}
};

/// Dashpots of a joint in a step.
struct JointDamping {
	double ratio; ///< zeta
	double time = 0; ///< tau
	double tangent = 1; ///< kappa
	/// D for (1a) in a mode of frequency omega. [1/s]
	double of(double omega) const
	{
		return 2 * ratio * std::sqrt(tangent) * omega + time * tangent * omega * omega;
	}
};

/// Vibration modes of two bodies with a joint.
struct JointModes {
	JointState state; ///< for which they were computed
	Vec3 centre = Vec3::Zero(); ///< of the unbroken springs, in the frame of A [m]
	Mat6 modes = Mat6::Zero(); ///< Z, in the axes of A
	Mat6 twists = Mat6::Zero(); ///< Z^-T: w = Z^-T eta
	Vec6 frequencies = Vec6::Zero(); ///< omega
	double sensitivity = 0; ///< bound of |E| / phi, (4) [1/rad]
	double shiftSensitivity = 0; ///< bound of |E| over a shift of the centre of B [1/m]

	/// Whether explicit springs would not resolve a step of h [s]. Frequencies increase.
	bool isStiff(double h) const { return h * frequencies[5] > stiffPhase; }
	/// Whether explicit springs might not resolve a step of h [s] once the bodies have turned against each other. With
	/// either body fixed, springs of one stiffness have the same frequencies at any turn, at most omega; with both
	/// free, the squares of the largest ones at most add up.
	bool mayBeStiff(double h) const
	{
		const auto [low, high] = std::minmax(state.stiffness.normal, state.stiffness.shear);
		const double phase = h * frequencies[5];
		return 2 * high * phase * phase > low * stiffPhase * stiffPhase;
	}
	/// Rotation of the bodies against each other up to which the modes serve. h: step [s]; returns [rad].
	double largestTurn(double h, const JointDamping& damping) const
	{
		const double x = h / 2 * damping.of(frequencies[5]), share = isStiff(h) ? 1 : x / (1 + x);
		return modeError / std::max(share * sensitivity, modeError / modeAngle);
	}
	/// Shift of the centre of B against the joint that changes the modes as much as such a rotation. [m]
	double shiftOf(double turn) const
	{
		return shiftSensitivity > 0 ? turn * sensitivity / shiftSensitivity
		                            : std::numeric_limits<double>::infinity();
	}
	/// Rates of a stretch by the modal velocities. end: where the spring's force acts, in the frame of A [m].
	Mat36 rates(const Vec3& end) const
	{
		return twists.topRows<3>() - crossMatrix(end - centre) * twists.bottomRows<3>();
	}
};
/// axesA: rotation matrix from the frame of A to the world. At least one spring is unbroken, and one body free.
JointModes jointModes(const SolverBody& a, const SolverBody& b, const Mat3& axesA, const SpringGroup& springs,
        const JointState& state);

/// The line along which the single spring of a joint acts: the only mode with a stiffness.
struct SpringAxis {
	Vec3 axis; ///< unit, fixed in A, world
	Vec3 armA, armB; ///< from the centres of mass to the end in B, where forces act [m]
	Vec3 onA, onB; ///< arms x axis [m]
	double stiffness; ///< [N/m]
	double response; ///< of the relative velocity along the axis to an impulse along it [1/kg]
	double rate; ///< velocity of B relative to A along the axis after all forces but those of the solver [m/s]
	double others; ///< D of the dashpots of other joints along the line [1/s]

	SpringAxis() { } // numbers are not set: joints of six modes have no line
	SpringAxis(const SolverBody& a, const SolverBody& b, const Vec3& axis, const Vec3& armA, const Vec3& armB,
	        double stiffness);
	double frequency() const { return std::sqrt(stiffness * response); } ///< omega
};

/// Power that a joint's dashpots take from its bodies at the velocities before the step. [W]
double dashpotPower(const SolverBody& a, const SolverBody& b, const JointModes& modes, const Mat3& axesA,
        const JointDamping& damping);
double dashpotPower(const SolverBody& a, const SolverBody& b, const SpringAxis& line, const JointDamping& damping);

/// A joint's n modes in a step: 6, or 1 of a spring that acts along an axis.
template <int n> struct ModalConstraint {
	ModalConstraint() { } // numbers are not set: zeros take 2 % of a step of a house with walls
	int bodyA, bodyB;
	PairVector rows[n]; ///< of J R (contact_solver.hpp)
	Modal<n> velocity; ///< Z^T u_0
	/// Z: in the axes of A, that of JointModes; n = 1: its part of translation, in world axes
	std::conditional_t<n == 1, Vec3, const Mat6*> basis;
	Mat3 axesA; ///< rotation matrix from the frame of A to the world
	Vec3 armA, armB; ///< from the centres of mass to the joint's centre [m]
	Modal<n> before; ///< eta
	Modal<n> decay, share; ///< x, s
	Modal<n> bias; ///< -x eta / (1 + x)
	Modal<n> impulse; ///< q: in-out of the sweeps
	SpringSteps<n> springs; ///< of a stiff joint
	double squaredChange; ///< of q in the last visit: twice the kinetic energy of the change [J]
	double h; ///< [s]
	double phase; ///< h omega of the stiffest mode
	Modal<n> after; ///< eta', after finishModes()
	double dissipated; ///< by the dashpots in the step, after finishModes() [J]
	/// Of the convergence threshold of the sweeps: squared changes are compared with this share of it. (h omega)^-4
	/// of the stiffest mode: errors change elastic forces by (h omega)^2 times as much [-]
	double thresholdShare;
	ModalStep<n> step() const { return { h, before, decay }; }
	/// Whether explicit springs would resolve the step with a reserve: the joint may leave the solver.
	bool isSoft() const { return phase <= softPhase * stiffPhase; }
	static constexpr size_t count = 1; ///< contact points for which a joint counts in the convergence of the sweeps
};

/// Constraint for a step of h [s], with zero impulse. modes: they must live as long.
void prepareModes(ModalConstraint<6>& constraint, const SolverBodies& bodies, const JointModes& modes,
        const Mat3& axesA, const JointDamping& damping, double h);
void prepareModes(ModalConstraint<1>& constraint, const SolverBodies& bodies, const SpringAxis& axis, const Mat3& axesA,
        const JointDamping& damping, double h);

/// Adds the springs of a stiff joint, with the impulse of their last forces.
template <int n> void addSprings(ModalConstraint<n>& constraint, SpringSteps<n> springs);

/// Applies the impulse of a stiff joint's last forces. change: dW of (8), contact_solver.hpp, in-out.
template <int n> void warmStart(const ModalConstraint<n>& constraint, PairVector& change);

/// One Gauss-Seidel visit: (3), or (3) of spring_step.hpp. share: of the change of a stiff joint that is applied [-]
template <int n> void solveModes(ModalConstraint<n>& constraint, PairVector& change, double share);

/// Impulse of the modes as a function of eta'. after: eta' [kg^1/2 m/s].
template <int n> struct ModalLaw {
	Modal<n> impulse; ///< q
	ModalMatrix<n> slope; ///< -dq/deta' [-]
};
template <int n> ModalLaw<n> modalLaw(ModalConstraint<n>& constraint, const Modal<n>& after);
/// Whether the springs of a stiff joint return at most their account with the impulse q. change: as of warmStart().
template <int n> bool keepsAccount(const ModalConstraint<n>& constraint, const PairVector& change);

/// Impulse of explicit dashpots, of the velocities before the step.
template <int n> void applyExplicitModes(ModalConstraint<n>& constraint, PairVector& change);

/// History and dissipated energy after the step. change: after the sweeps.
template <int n> void finishModes(ModalConstraint<n>& constraint, const PairVector& change);

/// Impulse of the modes on B at the joint's centre.
struct JointImpulse {
	Vec3 linear, angular; ///< [N s, N m s]
};
template <int n> JointImpulse jointImpulse(const ModalConstraint<n>& c)
{
	if constexpr (n == 1) return { c.basis * c.impulse[0], Vec3::Zero() };
	else {
		const Vec6 P = *c.basis * c.impulse;
		return { c.axesA * P.template head<3>(), c.axesA * P.template tail<3>() };
	}
}

} // namespace timber

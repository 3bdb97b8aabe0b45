// SPDX-License-Identifier: GPL-2.0-or-later
/// Vibration modes of a joint in the solver: dashpots, with which its two bodies vibrate against each other with a
/// given damping ratio, and Newmark's term of its springs, with which stiff joints set no limit to the step (as in
/// contact_solver.hpp). Adapter: ImplicitJoints.
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
/// the dissipated energy h (w + w')^T D (w + w') / 4 is never negative. Newmark's term adds -beta h2 K (w' - w), as a
/// mass beta h2 K would. In terms of the modes, P = Z q, eta = Z^T w, these are six scalars:
///     q = -x (eta + eta') - (g eta' - m),   g = beta y,   beta = y / (4 y + 2),   y = (h omega)2
///     x = h (zeta kappa^1/2 omega + tau kappa omega^2 / 2)                                      (2)
/// with beta = 0 for modes that the step resolves, h omega <= stiffPhase. The mass has the momentum m = g eta of the
/// step before, 0 for a new joint: velocities that are imposed between steps are those of the bodies alone. (With g eta
/// of the present velocity, an imposed one stretches a stiff spring by h omega times its exact amplitude.) The mass of
/// Newmark's term has the energy sum g eta'^2 / 2, at most the work that the bodies have done on the joint and that is
/// neither returned nor dissipated (the account N). The rest of that work is dissipated.
/// With the current twist u, in which q0 acts already, eta' = Z^T u + q - q0, and a visit of the joint is
///     q = s (q0 - Z^T u) + (m - x Z^T w) / (1 + x + g),   s = (x + g) / (1 + x + g)             (3)
/// Newmark's term may put back what it has stored and no more, whatever the modes: q is shortened to
///     q^T (eta + eta') / 2 <= N                                                                 (4)
/// The first visit of a step starts from q0 = 0, after the warm start of the contacts. Its error is small like s, so
/// that no impulse has to be kept from step to step.
/// Z is fixed in the axes of A. It is reused while springs, masses and moments of inertia are the same and the bodies
/// have turned against each other by less than modeAngle: (2) holds for any Z, and Z decides with (1) about the damping
/// ratio and the convergence of (3) only.
///
/// Glossary
///     D        damping       matrix of the joint's dashpots [N s/m, N s, N m s]
///     beta     -             Newmark's parameter of a mode [-]
///     eta      -             modal velocity before the step; eta': after the step [kg^1/2 m/s]
///     g        -             weight of Newmark's term [-]
///     m        momentum      of Newmark's term [kg^1/2 m/s]
///     N        stored        account of Newmark's term [J]
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
///     y        -             square of the mode's frequency times h [-]
///     Z        modes         in the axes of A [kg^1/2, kg^1/2 m]
///     zeta     ratio         damping ratio [-]
#pragma once
#include "constants.hpp"
#include "joint_law.hpp"
#include "solver_body.hpp"
#include <algorithm>

namespace timber {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// The unbroken springs of a joint.
struct SpringGroup {
	const std::vector<Vec3>& anchors; ///< ends of all springs in A, in the frame of A [m]
	const std::vector<int>& broken; ///< 1 for a broken spring, else 0
	JointStiffness stiffness; ///< of each
	Vec3 normal; ///< unit, in the axes of A
	size_t count() const { return size_t(std::count(broken.begin(), broken.end(), 0)); }
};

/// What the vibration modes of a joint depend on.
struct JointState {
	size_t springs = 0; ///< number of the unbroken springs; 0: not computed
	JointStiffness stiffness { 0, 0 }; ///< of each
	double pairInverseMass = 0; ///< [1/kg]
	double inverseInertia = 0; ///< traces of both bodies [1/(kg m2)]
	Quat relative = Quat::Identity(); ///< orientation of B in the axes of A

	/// Whether modes of this state serve for another one.
	bool fits(const JointState& now) const
	{
		return springs == now.springs && stiffness.normal == now.stiffness.normal
		        && stiffness.shear == now.stiffness.shear && pairInverseMass == now.pairInverseMass
		        && std::abs(inverseInertia - now.inverseInertia) <= 1e-9 * inverseInertia
		        && std::abs(relative.dot(now.relative)) > std::cos(modeAngle / 2);
	}
};

/// Vibration modes of two bodies with a joint.
struct JointModes {
	JointState state; ///< for which they were computed
	Vec3 centre = Vec3::Zero(); ///< of the unbroken springs, in the frame of A [m]
	Mat6 modes = Mat6::Zero(); ///< Z, in the axes of A
	Vec6 frequencies = Vec6::Zero(); ///< omega

	/// Whether explicit springs would not resolve a step of h [s]. Frequencies increase.
	bool isStiff(double h) const { return h * frequencies[5] > stiffPhase; }
};
/// axesA: rotation matrix from the frame of A to the world. At least one spring is unbroken, and one body free.
JointModes jointModes(const SolverBody& a, const SolverBody& b, const Mat3& axesA, const SpringGroup& springs,
        const JointState& state);

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

/// Newmark's term of a joint from step to step.
struct NewmarkHistory {
	double stored = 0; ///< N [J]
	Vec3 linear = Vec3::Zero(), angular = Vec3::Zero(); ///< Z m, in the axes of A [N s, N m s]
};

/// Power that a joint's dashpots take from its bodies at the velocities before the step. [W]
double dashpotPower(const SolverBody& a, const SolverBody& b, const JointModes& modes, const Mat3& axesA,
        const JointDamping& damping);

/// A joint's modes in a step.
struct ModalConstraint {
	int bodyA, bodyB;
	const JointModes* modes; ///< Z in the axes of A
	Mat3 axesA; ///< rotation matrix from the frame of A to the world
	Vec3 armA, armB; ///< from the centres of mass to the joint's centre [m]
	Vec6 before; ///< eta
	Vec6 decay, share; ///< x, s
	Vec6 bias; ///< (m - x eta) / (1 + x + g)
	Vec6 impulse; ///< q: in-out of the sweeps
	double squaredChange; ///< of q in the last visit: twice the kinetic energy of the change [J]
	Vec6 newmark; ///< g
	NewmarkHistory history; ///< N, m: in-out
	double dissipated; ///< in the step, after finishModes() [J]
	/// Of the convergence threshold of the sweeps: squared changes are compared with this share of it. (h omega)^-4
	/// of the stiffest mode: errors change elastic forces by (h omega)^2 times as much [-]
	double thresholdShare;
	static constexpr size_t count = 1; ///< contact points for which a joint counts in the convergence of the sweeps
};

/// Constraint for a step of h [s], with zero impulse. modes are not copied.
void prepareModes(ModalConstraint& constraint, const SolverBody& a, const SolverBody& b, const JointModes& modes,
        const Mat3& axesA, const JointDamping& damping, double h, const NewmarkHistory& history);

/// One Gauss-Seidel visit: (3), (4). A squared change of at most `threshold` [J] is not applied.
void solveModes(ModalConstraint& constraint, const BodyMotion& a, const BodyMotion& b, double threshold);

/// Impulse of explicit dashpots, of the velocities before the step, without Newmark's term.
void applyExplicitModes(ModalConstraint& constraint, const BodyMotion& a, const BodyMotion& b);

/// History and dissipated energy after the step. a, b: after the sweeps.
void finishModes(ModalConstraint& constraint, const BodyMotion& a, const BodyMotion& b);

/// Impulse of the modes on B at the joint's centre.
struct JointImpulse {
	Vec3 linear, angular; ///< [N s, N m s]
};
JointImpulse jointImpulse(const ModalConstraint& constraint);

} // namespace timber

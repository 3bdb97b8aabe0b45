// SPDX-License-Identifier: GPL-2.0-or-later
/// Springs of a joint that a step h does not resolve: implicit, exact in energy, within the strength of the joint.
///
/// Velocities are those of the half steps. The state of these springs is, too: z is the stretch in the middle between
/// two placements, z0 before the step and
///     z1 = d + h/2 G eta'                                                                       (1)
/// after it, with the stretch d at the placement, the modal velocities eta' after the step (joint_modes.hpp) and the
/// rates G of the stretch by them. From the states of the law (spring_law.hpp) at both ends follows the force of the
/// step, the discrete gradient
///     F = (f0 + f1) / 2 + lambda (z1 - z0),   F.(z1 - z0) = U1 - U0 + D                          (2)
/// (Gonzalez, J. Nonlinear Sci. 6 (1996) 449-467), whose work is what the spring stores and dissipates. Of a linear
/// spring it is the trapezoidal rule, Newmark's method with beta = 1/4. F lies between f0 and f1 as far as their
/// difference is concerned: |lambda (z1 - z0)| <= |f1 - f0| / 2. It exceeds no strength that f0 and f1 keep.
///
/// With the impulses -x (eta + eta') of the dashpots, E the modal velocity without impulses of the joint, and q_a the
/// part of its spring impulses that E contains already, the velocity after the step is the root of
///     r = eta' - E + x (eta + eta') + h sum G^T F + q_a                                           (3)
/// which increases with eta' (forces do not fall): Newton's method with the matrix 1 + x + h2/4 sum G^T f' G, f' the
/// tangents. Below the strength linear springs need one matrix a step: eta' is an affine function of E.
///
/// A law that softens does so within the step where its steepest fall k_f leaves the slope of (3) above 1/2,
///     h2 k_f sum |G|2 < 1,
/// and keeps its force to the end of the step otherwise.
///
/// Account A: the work that the bodies have done on the springs as far as it is neither returned nor dissipated. The
/// springs return at most A,
///     q_s.(eta + eta') / 2 <= A,   q_s = -h sum G^T F                                             (4)
/// After the step A is at most U1; the rest is dissipated: by yielding, with springs that break, and where velocities
/// were imposed between two steps. In other steps (4) follows from (2).
#pragma once
#include "constants.hpp"
#include "joint_law.hpp"
#include "spring_law.hpp"
#include <Eigen/Core>

namespace timber {

/// Modal velocities and impulses of a joint of n modes: 6, or 1 (joint_modes.hpp).
template <int n> using Modal = Eigen::Matrix<double, n, 1>;
template <int n> using ModalMatrix = Eigen::Matrix<double, n, n>;
/// Vectors by modal numbers, a column each.
template <int n> using ModalVectors = Eigen::Matrix<double, 3, n>;
using Vec6 = Modal<6>;
using Mat6 = ModalMatrix<6>;
using Mat36 = ModalVectors<6>;

/// An unbroken spring in a step. Stretches and forces in the axes of A.
template <int n> struct SpringStep {
	size_t spring; ///< index in the joint
	Vec3 from; ///< z0 [m]
	Vec3 placed; ///< d [m]
	Vec3 applied; ///< force on A by which other engines have accelerated the bodies already [N]
	ModalVectors<n> rates; ///< G [kg^-1/2]
	Vec3 force; ///< F; before the sweeps: of the last step [N]
	SpringState start = {}; ///< at z0
	Vec3 stretch = Vec3::Zero(); ///< z1 [m]
	SpringState end = {}; ///< at z1, after SpringSteps::finish()
	bool breaks = false; ///< after SpringSteps::finish()
};

/// Modal velocities and damping of a joint in a step.
template <int n> struct ModalStep {
	double h; ///< [s]
	const Modal<n>&before, &decay; ///< eta, x
};

/// Springs of a joint of n modes in a step.
template <int n> class SpringSteps {
	using Vec = Modal<n>;
	using Mat = ModalMatrix<n>;
	using Step = ModalStep<n>;

	SpringLaw* law = nullptr;
	std::vector<SpringTrial> states; ///< of the springs at z1
	std::vector<Vec3> shared; ///< of SpringLaw::limit()
	std::vector<Vec3> forces; ///< of SpringLaw::linearForces()
	Vec applied = Vec::Zero(); ///< q_a
	Mat inverseSlope; ///< of linear springs below the strength: eta' = base + inverseSlope E is the root of (3)
	Vec base; ///< likewise
	bool isAffine = false; ///< both are known
	bool keepsForce = true; ///< the step does not resolve the fall of the force

	/// r of (3), and kappa of SpringLaw::limit().
	struct NewtonPoint {
		Vec residual;
		double kappa;
	};

	double tryStretches(double h, const Vec& after);
	Vec residual(const Step& step, const Vec& free, const Vec& after) const;
	Mat3 tangentOf(size_t spring, double kappa) const;
	Mat slope(const Step& step, double kappa) const;
	Vec newtonStep(const Step& step, const Vec& free, const Vec& after, const NewtonPoint& point);
	bool tryLinear(double h, const Vec& after);
	bool improve(const Step& step, const Vec& free, Vec& after, NewtonPoint& point);
	Vec withinAccount(const Step& step, const Vec& free, const Vec& impulse) const;

public:
	std::vector<SpringStep<n>> springs;
	double account = 0; ///< A [J]
	double dissipated = 0; ///< by the springs before the step; after finish() also in the step [J]

	SpringSteps() = default;
	/// Springs with the members of SpringStep up to `rates`, and the forces of the last step. The law is not copied.
	SpringSteps(SpringLaw&, std::vector<SpringStep<n>>, double account, double h);
	bool empty() const { return springs.empty(); }
	/// Sum of the energies at z0. [J]
	double startEnergy() const;
	/// Tangent stiffness of the line on which the springs move from z0 to d over the initial one, in the mean. [-]
	double tangent() const;
	/// Energies of springs that are explicit from the next step on.
	struct Leaving {
		double stored; ///< at the placement of this step, where their forces were F, at most A's part [J]
		double dissipated; ///< what A has beyond explicit springs [J]
	};
	/// After finish(). after: eta'
	Leaving leave(double h, const Vec& after) const;
	/// Impulse of the forces of the last step, without q_a.
	Vec warmStart(double h) const;
	/// Impulse of springs and dashpots without q_a: eta' - E by (3), (4). free: E; after: an estimate of eta'.
	Vec impulse(const Step& step, const Vec& free, Vec after);
	/// The same as a function of eta' without (4), and minus its derivative.
	Vec impulseAt(const Step& step, const Vec& after, Mat& slope);
	/// Whether (4) admits the impulse at eta'.
	bool keepsAccount(const Step& step, const Vec& impulse, const Vec& after) const;
	/// Account and history after the step. impulse: without q_a; after: eta'.
	void finish(const Step& step, const Vec& impulse, const Vec& after);
};

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
/// Yielding joint spring: bilinear with slip, as used for nailed and plated timber joints (law: slip), isotropic in three dimensions.
/// Adapter: JointEngine (pkg/Joints.hpp). Signs as in joint_law.hpp.
///
/// Parameters: k stiffness, F yield force, phi friction share, d_c softening stretch, d_u ultimate stretch; F/k < d_c < d_u.
/// State: p plastic stretch (vector), R largest length of the stretch so far. d is the stretch, r = |d|.
///
///     g(R) = 1 up to d_c, linear to 0 at d_u         strength left
///     y(R) = F g(R) / k                              elastic limit of both parts [m]
///     s(R) = max(0, R - y(R))                        slack of the slip part [m]
///
/// Friction part (share phi): elastic and perfectly plastic with the elastic stretch e = d - p, |e| <= y. Beyond y, p moves along e
/// (radial return). It gives parallelogram loops, which dissipate energy in every cycle.
/// Slip part (share 1 - phi): acts along d with the elastic stretch x = max(0, r - s), a nail in a hole that has widened to s. It has no force
/// within the slack (pinching) and returns on the same line to the backbone. At constant R it is conservative: it dissipates as R grows.
///
///     force      = phi k e + (1 - phi) k x d / r
///     stored     = k/2 (phi e^2 + (1 - phi) x^2)
///     dissipated = k (phi integral y |dp| + (1 - phi) P(R))        P(R) = integral y ds
///
/// Balance. Friction part: e.dd = e.de + y |dp|, because dp is parallel to e and |e| = y while it yields. Slip part: on the backbone x = y
/// and R = s + y, so that y dR = y dy + y ds; elsewhere s is constant. Both dissipate at no negative rate.
/// First loading along a line gives the backbone min(k r, F g(r)), and energy F (d_c + d_u) / 2 - F^2 / 2k dissipated at d_u.
///
/// Update for a straight path from the previous to the new stretch, whose largest length is at an end:
///     1. R grows to r; y, s and P follow in closed form;
///     2. radial return of e to y(R);
///     3. dissipated energy k (phi m |dp| + (1 - phi) dP), with m = dP / ds the mean elastic limit while s grows, else y.
/// Radial paths: forces and history do not depend on the length of the steps. Energies do not, either, but for a step that begins below R and
/// ends beyond both R and d_c. Other paths: error of first order in forces (radial return), of second order in the energy balance.
///
/// Springs that act along one axis of body A only, as those of a wall in its plane: d is the projection of the stretch on the axis.
///
/// Frames. d, p and the force are in the frame of body A, so that the history turns with the body. The force acts on both bodies at the anchor
/// of B. Its power is then that of the rate of d in the frame of A: the balance is exact and angular momentum is conserved, although the
/// force is not parallel to the stretch. With the bodies swapped, p would turn with the other body. The results differ by the rotation
/// of the bodies relative to each other since p arose.
///
/// Sources: joints of timber-frame houses as elements with slip: Nakagawa, Ohta, Tsuchimoto and Kawai, J. Wood Sci. 56 (2010) 284-292;
/// radial return: Simo and Hughes, Computational Inelasticity (1998), section 3.3.
#pragma once
#include "joint_law.hpp"

namespace timber {

/// Parameters of a spring.
struct SlipLaw {
	double stiffness; ///< k [N/m]
	double strength; ///< yield force F [N]
	double frictionShare; ///< phi, 0 to 1 [-]
	double softeningStretch; ///< d_c: the strength falls beyond it [m]
	double ultimateStretch; ///< d_u: the spring breaks [m]

	bool isValid() const;
	double remaining(double largest) const; ///< g [-]
	double elasticLimit(double largest) const { return strength * remaining(largest) / stiffness; } ///< y [m]
	double slack(double largest) const { return std::max(0., largest - elasticLimit(largest)); } ///< s [m]
	double limitIntegral(double largest) const; ///< P [m2]
};

struct SlipHistory {
	Vec3 plastic = Vec3::Zero(); ///< p, in the frame of A [m]
	double largest = 0; ///< R [m]
};

struct SlipForce {
	Vec3 force; ///< on A, in the frame of the stretch [N]
	double energy; ///< stored [J]
	double dissipated; ///< in this update, >= 0 [J]
	SlipHistory history; ///< after the update
};

/// stretch: anchor of B minus anchor of A, in the frame of A [m]. An update with the same stretch again changes nothing.
SlipForce slipForce(const SlipLaw& law, const SlipHistory& history, const Vec3& stretch);

/// Histories of a joint's springs, one entry each.
struct SlipHistories {
	std::vector<Vec3>& plastic; ///< p, in the frame of A [m]
	std::vector<double>& largest; ///< R [m]
};

/// Stretches, forces and new histories of a joint's unbroken springs. The entries of broken springs stay as they are.
/// axis: unit vector in the frame of A, on which the stretches are projected; zero: the springs act in all directions.
JointForce slipForces(const SlipLaw& law, const JointPlacement& placement, const Vec3& axis, const JointSprings& springs, const SlipHistories& histories);

/// Springs that have reached the ultimate stretch, in their order. They have no force and no energy left.
std::vector<SpringBreak> slipBreaks(
        const SlipLaw& law, const JointPlacement& placement, const Vec3& normal, const JointSprings& springs, const SlipHistories& histories);

} // namespace timber

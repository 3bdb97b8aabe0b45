// SPDX-License-Identifier: GPL-2.0-or-later
/// Yielding joint spring: backbone with slip, as used for nailed and plated timber joints and for walls (law: slip),
/// isotropic in three dimensions. Adapter: JointEngine (pkg/JointEngine.hpp). Signs as in joint_law.hpp.
///
/// Parameters: k stiffness of unloading, phi friction share, B(r) backbone: force of the first loading, straight lines
/// from the origin through given points to zero force at the ultimate stretch d_u; none is steeper than k. Bilinear
/// with loss of strength: the points (F/k, F), (d_c, F), (d_u, 0) with the yield force F and the softening stretch d_c.
/// State: p plastic stretch (vector), R largest length of the stretch so far. d is the stretch, r = |d|.
///
///     y(R) = B(R) / k          elastic limit of both parts [m]
///     s(R) = R - y(R)          slack of the slip part [m], which does not fall
///
/// Friction part (share phi): elastic-perfectly plastic with the elastic stretch e = d - p, |e| <= y. Beyond y, p
/// moves along e (radial return). It gives parallelogram loops, which dissipate energy in every cycle.
/// Slip part (share 1 - phi): acts along d with the elastic stretch x = max(0, r - s), a nail in a hole that has
/// widened to s. It has no force within the slack (pinching) and returns on the same line to the backbone. At constant
/// R it is conservative: it dissipates as R grows.
///
///     force      = phi k e + (1 - phi) k x d / r
///     stored     = k/2 (phi e^2 + (1 - phi) x^2)
///     dissipated = k (phi integral y |dp| + (1 - phi) P(R))        P(R) = integral y ds
///
/// Balance. Friction part: e.dd = e.de + y |dp|, because dp is parallel to e and |e| = y while it yields. Slip part: on
/// the backbone x = y and R = s + y, so that y dR = y dy + y ds; elsewhere s is constant. Both dissipate at no negative
/// rate.
/// First loading along a line gives the backbone. At d_u all work is dissipated: the area under it.
///
/// Update for a straight path from the previous to the new stretch, whose largest length is at an end:
///     1. R grows to r; y, s and P follow in closed form;
///     2. radial return of e to y(R);
///     3. dissipated energy k (phi m |dp| + (1 - phi) dP), with m = dP / ds the mean elastic limit while s grows, else
///       y.
/// Radial paths: forces and history do not depend on the length of the steps. Energies do not, either, but for a step
/// that begins below R and ends beyond R where y changes. Other paths: error of first order in forces (radial return),
/// of second order in the energy balance.
///
/// Springs that act along one axis of body A only, as those of a wall in its plane: d is the projection of the stretch
/// on the axis.
///
/// Frames. d, p and the force are in the frame of body A, so that the history turns with the body. The force acts on
/// both bodies at the anchor of B. Its power is then that of the rate of d in the frame of A: the balance is exact and
/// angular momentum is conserved, although the force is not parallel to the stretch. With the bodies swapped, p would
/// turn with the other body. The results differ by the rotation of the bodies relative to each other since p arose.
///
/// Sources: joints of timber-frame houses as elements with slip: Nakagawa, Ohta, Tsuchimoto and Kawai, J. Wood Sci. 56
/// (2010) 284-292;
/// radial return: Simo and Hughes, Computational Inelasticity (1998), section 3.3.
#pragma once
#include "joint_law.hpp"

namespace timber {

/// A point of the backbone.
struct BackbonePoint {
	double stretch; ///< [m]
	double force; ///< [N]
};

/// Parameters of a spring.
class SlipLaw {
	/// A point of the backbone with what follows from it; s and P are known between two points from those at both.
	struct Knot {
		double stretch; ///< [m]
		double slack; ///< s [m]
		double limitIntegral; ///< P [m2]
		double limit() const { return stretch - slack; } ///< y [m]
	};
	std::vector<Knot> knots; ///< the origin first, the ultimate stretch last

public:
	double stiffness = 0; ///< k [N/m]
	double frictionShare = 0; ///< phi, 0 to 1 [-]

	SlipLaw() = default;
	/// points: behind the origin; their stretches ascend, the last one has no force.
	SlipLaw(double stiffness, double frictionShare, const std::vector<BackbonePoint>& points);

	/// Condition on a backbone that the points violate for this stiffness; null if none.
	static const char* unmetBy(double stiffness, const std::vector<BackbonePoint>& points);
	bool isValid() const { return knots.size() > 1 && stiffness > 0 && frictionShare >= 0 && frictionShare <= 1; }
	double ultimateStretch() const { return knots.back().stretch; } ///< d_u: the spring breaks [m]
	/// s and P when the largest length of the stretch is R.
	struct Slack {
		double slack; ///< s [m]
		double limitIntegral; ///< P [m2]
	};
	Slack slackAt(double largest) const;
	/// Largest elastic limit y while the largest length of the stretch grows between two values [m].
	double largestLimit(double from, double to) const;
	double steepestFall() const; ///< of the backbone, >= 0 [N/m]
};

struct SlipHistory {
	Vec3 plastic = Vec3::Zero(); ///< p, in the frame of A [m]
	double largest = 0; ///< R [m]
};

struct SlipForce {
	Vec3 force; ///< on A, in the frame of the stretch [N]
	double energy; ///< stored [J]
	double dissipated; ///< in this update, >= 0 [J]
	/// Tangent stiffness along the stretch over k, 0 where the force falls [-]
	double share;
	SlipHistory history; ///< after the update
};

/// stretch: anchor of B minus anchor of A, in the frame of A [m]. An update with the same stretch again changes
/// nothing.
SlipForce slipForce(const SlipLaw& law, const SlipHistory& history, const Vec3& stretch);

/// The same with the tangent of the force by the stretch, which does not fall. keepsForce: a backbone that falls on the
/// path keeps its largest force. tangent: out [N/m].
SlipForce slipForce(
        const SlipLaw& law, const SlipHistory& history, const Vec3& stretch, bool keepsForce, Mat3& tangent);

/// The springs of a joint.
class SlipSprings : public SpringLaw {
	SlipLaw law;
	Vec3 axis;

	// Of each spring:
	std::vector<Vec3> plasticStretches; ///< p, in the frame of A [m]
	std::vector<double> largestStretches; ///< R [m]
	std::vector<double> limits; ///< y at R [m]

	Vec3 onAxis(const Vec3& stretch) const { return axis.isZero(0) ? stretch : Vec3(axis.dot(stretch) * axis); }
	SlipHistory history(size_t spring) const { return { plasticStretches[spring], largestStretches[spring] }; }

public:
	/// axis: unit vector in the frame of A, on which the stretches are projected; zero: they act in all directions.
	SlipSprings(const SlipLaw&, const Vec3& axis, size_t count = 0);
	const std::vector<Vec3>& plastic() const { return plasticStretches; }
	const std::vector<double>& largest() const { return largestStretches; }
	void setHistories(std::vector<Vec3> plastic, std::vector<double> largest);
	SpringTrial trial(size_t spring, const Vec3& to, bool keepsForce) const override;
	SpringState commit(size_t spring, const Vec3& to) override;
	bool steadyForces(size_t first, const Vec3s& to, Lanes::Mask acting, SteadySprings& state) const override;
	bool isSpent(size_t spring) const override { return largestStretches[spring] >= law.ultimateStretch(); }
	double steepestFall() const override { return law.steepestFall(); }
};

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
/// What a law of joint springs states for a step that does not resolve them (spring_step.hpp). Signs as in
/// joint_law.hpp; stretches and forces in the frame of body A.
#pragma once
#include "simd.hpp"
#include <vector>

namespace timber {

/// A spring at the end of a step.
struct SpringState {
	Vec3 force = Vec3::Zero(); ///< f on A [N]
	double energy = 0; ///< U: what it could return [J]
	double dissipated = 0; ///< D >= 0, on the straight path from the stretch before the step [J]
	bool breaks = false; ///< exceeds its strength or ultimate stretch
	/// Tangent stiffness along the stretch over the initial one, 0 to 1, of the line that the path has reached [-]
	double share = 1;
};

/// A spring at a stretch that is tried.
struct SpringTrial : SpringState {
	/// Of the force by the stretch: symmetric, positive semidefinite [N/m]
	Mat3 tangent = Mat3::Zero();
};

/// laneCount springs whose histories stay and dissipate nothing: members of SpringState.
struct SteadySprings {
	Vec3s force;
	Lanes energy, share;
};

/// Springs of a joint with their histories.
class SpringLaw {
public:
	virtual ~SpringLaw() = default;
	/// State at the end of the straight path from the stretch of the history to another one [m].
	/// The history stays. With keepsForce the force must not fall along a path that goes on: a law that softens
	/// keeps its force here, and loses it in commit().
	virtual SpringTrial trial(size_t spring, const Vec3& to, bool keepsForce) const = 0;
	/// The same with all of the law; the history goes on to the other stretch.
	virtual SpringState commit(size_t spring, const Vec3& to) = 0;
	/// What commit() gives for the springs from `first` on, if their histories stay; else false. acting: lanes that count.
	virtual bool steadyForces(size_t first, const Vec3s& to, Lanes::Mask acting, SteadySprings& state) const
	{
		(void)first, (void)to, (void)acting, (void)state;
		return false;
	}
	/// Whether no strength is left. Springs that reach their strength without a history break in other ways.
	virtual bool isSpent(size_t) const { return false; }
	/// Largest rate at which the force of the first loading falls with the stretch; 0: it never does. [N/m]
	virtual double steepestFall() const { return 0; }
	/// Whether forces are linear in the stretches up to the strength.
	virtual bool isLinear() const { return false; }
	/// Replaces trial stretches of linear springs by their forces. Returns whether the strength admits these.
	virtual bool linearForces(std::vector<Vec3>& springs) const
	{
		(void)springs;
		return false;
	}
	/// Applies a strength that the springs share to trial states. shared: out, unit vectors of the forces that it
	/// limits, of each spring. Returns kappa: the tangent of all forces is that of the states minus kappa s s^T
	/// with the vector s of all entries of `shared` [N/m]; 0 without such a limit, or below it.
	virtual double limit(std::vector<SpringTrial>& states, std::vector<Vec3>& shared) const
	{
		(void)states, (void)shared;
		return 0;
	}
};

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
/// Breakable joint: springs between two bodies, each anchored in both (paper, sections 2.4 and 3.2). Adapter:
/// JointEngine (pkg/JointEngine.hpp).
/// Signs: the normal points from body A to body B; forces act on A, B gets the opposite. Contacts have the opposite
/// convention (contact_law.hpp).
/// A step:
///     1. springForces() computes stretches and forces for the bodies' placement;
///     2. isOverloaded() applies the strength, of each spring or of the whole joint;
///     3. springBreaks() lists the springs of an overloaded joint that break. The caller marks them broken and computes
///       the forces again.
#pragma once
#include "kinematics.hpp"
#include "spring_law.hpp"
#include <numeric>

namespace timber {

/// Of one spring.
struct JointStiffness {
	double normal, shear; ///< K_pn > 0, K_ps >= 0: with 0 the springs act along the normal only [N/m]
};

template <class Number> struct SpringForce {
	Vec3Of<Number> force; ///< on A, world [N]
	Number normal; ///< component along the joint's normal, > 0 in tension [N]
	Number energy; ///< stored [J]
};

/// Of a spring with equal stiffnesses k [N/m]. stretch, normal: as in springForce().
template <class Number> SpringForce<Number> isotropicForce(double k, const Vec3Of<Number>& stretch, const Vec3& normal)
{
	const Number half = 0.5, stiffness = k;
	return { stiffness * stretch, stiffness * stretch.dot(broadcast<Number>(normal)),
		half * (stiffness * stretch.squaredNorm()) };
}

/// Total form of Eqs. 25, 26, 29, 30 (the sum of the increments, without their drift).
/// stretch: anchor of B minus anchor of A, world [m]; normal: of the joint, world. With equal stiffnesses the normal
/// does not matter.
template <class Number>
SpringForce<Number> springForce(const JointStiffness& k, const Vec3Of<Number>& stretch, const Vec3& normal)
{
	if (k.normal == k.shear) return isotropicForce<Number>(k.shear, stretch, normal);
	const Vec3Of<Number> n = broadcast<Number>(normal), shear = Number(k.shear) * stretch;
	const Number along = stretch.dot(n), square = Number(k.shear) * stretch.squaredNorm(),
	             extra = k.normal - k.shear, half = 0.5;
	return { shear + extra * along * n, Number(k.normal) * along, half * (square + extra * along * along) };
}

/// Placement of a joint's two bodies: rotation matrices from their frames to the world, and the vector from the centre
/// of A to that of B [m].
struct JointPlacement {
	const Mat3 &axesA, &axesB;
	Vec3 distance;
};

/// laneCount springs of a joint. Lanes without a spring count as broken.
struct SpringLanes {
	Vec3s anchorsA, anchorsB; ///< in the bodies' frames [m]
	Lanes::Mask intact; ///< springs that are not broken
	Vec3s stretches; ///< anchor of B minus anchor of A, world; zero for a broken spring [m]
	Vec3s forces; ///< on A, world; zero for a broken spring [N]
};

/// The springs of a joint, in groupsOf(count) groups, which it does not own.
struct JointSprings {
	SpringLanes* groups;
	size_t count;

	SpringLanes& group(size_t i) const { return groups[i / laneCount]; }
	bool isIntact(size_t i) const { return lane(group(i).intact, i % laneCount); }
	Vec3 anchorA(size_t i) const { return lane(group(i).anchorsA, i % laneCount); }
	Vec3 anchorB(size_t i) const { return lane(group(i).anchorsB, i % laneCount); }
	Vec3 stretch(size_t i) const { return lane(group(i).stretches, i % laneCount); }
	Vec3 force(size_t i) const { return lane(group(i).forces, i % laneCount); }
	/// One of these vectors of each spring.
	std::vector<Vec3> all(Vec3 (JointSprings::*value)(size_t) const) const;
	std::vector<int> broken() const; ///< 1 for each broken spring, else 0
	/// Stretch and force of an unbroken spring.
	void set(size_t i, const Vec3& stretch, const Vec3& force) const
	{
		setLane(group(i).stretches, i % laneCount, stretch);
		setLane(group(i).forces, i % laneCount, force);
	}
	void breakSpring(size_t i) const
	{
		clearLane(group(i).intact, i % laneCount);
		set(i, Vec3::Zero(), Vec3::Zero());
	}
	/// Springs without stretch and force. Vectors of `count` entries.
	void assign(const std::vector<Vec3>& anchorsA, const std::vector<Vec3>& anchorsB,
	        const std::vector<int>& broken) const;
};

/// Of vectors, of which there is at least one.
inline Vec3 mean(const std::vector<Vec3>& v)
{
	return std::accumulate(v.begin(), v.end(), Vec3(Vec3::Zero())) / double(v.size());
}

/// Sums over a joint's unbroken springs; forces on A, torques about the bodies' own centres.
struct JointForce {
	Vec3 force = Vec3::Zero(), torqueA = Vec3::Zero(), torqueB = Vec3::Zero(); ///< [N, N m]
	double energy = 0; ///< [J]
	double dissipated = 0; ///< in this step, by yielding (slip_law.hpp) [J]
	/// Tangent stiffness of the unbroken springs over the initial one, in the mean, never negative [-]
	double tangent = 1;
	double largestSquared = 0; ///< square of the largest spring force [N2]
	double sum = 0; ///< of the magnitudes of the spring forces [N]
	bool isKnown = false; ///< a law has computed it
	bool isSpent = false; ///< a spring that yields has no strength left

	/// Power of the forces on the bodies. [W]
	double power(const BodyKinematics& a, const BodyKinematics& b) const
	{
		return force.dot(a.velocity - b.velocity) + torqueA.dot(a.spin) + torqueB.dot(b.spin);
	}
};

/// Stretches and forces of a joint's springs. normal: in the frame of A; total: out.
void springForces(const JointStiffness& stiffness, const JointPlacement& placement, const Vec3& normal,
        const JointSprings& springs, JointForce& total);

/// The same of springs with a history, which goes on; the entries of broken springs stay as they are. axis: unit vector
/// in the frame of A, on which the stretches are projected; zero: the springs act in all directions.
JointForce yieldingForces(
        SpringLaw& law, const JointPlacement& placement, const Vec3& axis, const JointSprings& springs);

/// Strength of a joint (section 3.2).
struct JointStrength {
	double strength; ///< P_max [N]
	/// Whether P_max is that of the joint: all springs break when the sum of their forces exceeds it; else of each
	/// spring.
	bool perJoint;
	/// Largest spring force over the strength; perJoint: sum of the spring forces over the strength. [-]
	double load(const JointForce& f) const { return (perJoint ? f.sum : std::sqrt(f.largestSquared)) / strength; }
};
bool isOverloaded(const JointStrength& limit, const JointForce& force);

/// Cause of a break: the larger component of the spring's force, and the sign of the normal one.
enum class BreakCause { Tension, Compression, Shear };
BreakCause breakCause(const SpringForce<double>& f);

struct SpringBreak {
	size_t spring; ///< index in the joint
	BreakCause cause;
	double force; ///< magnitude [N]
	double energy; ///< released: stored at the middle of the last step [J]
};

/// Motion of a joint's bodies; velocities are those of the last step.
struct JointMotion {
	BodyKinematics a, b;
	double h; ///< length of the step [s]
};

/// Breaks of an overloaded joint, in the order of its springs. springs: with the stretches and forces of
/// springForces().
std::vector<SpringBreak> springBreaks(const JointStiffness& k, const JointStrength& limit,
        const JointPlacement& placement, const Vec3& normal, const JointSprings& springs, const JointMotion& motion);

/// Springs that yield and have no strength left, in their order. They have no force and no energy. axesA: rotation
/// matrix from the frame of A to the world; normal: in the frame of A.
std::vector<SpringBreak> spentSprings(const SpringLaw& law, const JointStiffness& k, const Mat3& axesA,
        const Vec3& normal, const JointSprings& springs);

/// The springs in a step that does not resolve them: forces within the strength, springs that reach it break at the
/// end of the step.
class BrittleSprings : public SpringLaw {
	Mat3 stiffness = Mat3::Zero(); ///< K, in the axes of A [N/m]
	JointStrength strength { 0, false };

	SpringTrial elastic(const Vec3& stretch) const;
	void weaken(SpringTrial& state, double share) const;

public:
	BrittleSprings() = default;
	/// normal: in the frame of A
	BrittleSprings(const JointStiffness&, const JointStrength&, const Vec3& normal);
	SpringTrial trial(size_t spring, const Vec3& to, bool keepsForce) const override;
	SpringState commit(size_t spring, const Vec3& to) override { return trial(spring, to, false); }
	bool isLinear() const override { return true; }
	bool linearForces(std::vector<Vec3>& springs) const override;
	/// With P_max of the joint, the forces beyond it fall by the same number: the closest ones in terms of energy.
	double limit(std::vector<SpringTrial>& states, std::vector<Vec3>& shared) const override;
};

} // namespace timber

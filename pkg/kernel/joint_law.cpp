// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint_law.hpp"
#include "preconditions.hpp"
#include <cassert>

namespace timber {
namespace {

	[[maybe_unused]] bool isValid(const JointStiffness& k) { return k.normal > 0 && k.shear >= 0 && std::isfinite(k.normal) && std::isfinite(k.shear); }
	[[maybe_unused]] bool isValid(const JointPlacement& p) { return isFinite(p.axesA) && isFinite(p.axesB) && isFinite(p.distance); }
	[[maybe_unused]] bool isValid(const JointSprings& s)
	{
		const size_t count = s.broken.size();
		return s.anchorsA.size() == count && s.anchorsB.size() == count && s.stretches.size() == count && s.forces.size() == count;
	}

	/// Energy of a spring at the middle of the last step, the time of the velocities: it does not act in this step any more. [J]
	double energyAtBreak(const SpringForce<double>& f, const Vec3& anchorB, const JointMotion& motion)
	{
		const BodyKinematics &a = motion.a, &b = motion.b;
		const Vec3 end = b.position + anchorB; // the force acts on both bodies here
		const Vec3 velocity = relativeVelocity<double>(end - a.position, end - b.position, a.velocity, a.spin, b.velocity, b.spin);
		return f.energy - motion.h / 2 * f.force.dot(velocity);
	}

} // namespace

JointForce springForces(const JointStiffness& k, const JointPlacement& placement, const Vec3& normal, const JointSprings& springs)
{
	assert(isValid(k) && isValid(placement) && isValid(springs) && isUnit(normal));
	JointForce total;
	Sums<11> sums;
	const Vec3 worldNormal = placement.axesA * normal;
	inLanes(
	        springs.broken.size(), [&](auto number, size_t i) __attribute__((always_inline)) {
		        using Number = decltype(number);
		        using Vec = Vec3Of<Number>;
		        const size_t count = springs.broken.size() - i;
		        const auto vectors = [&](const std::vector<Vec3>& all) -> Vec { return Group<Number, const Vec3>(&all[i], count).vectors(); };
		        const auto intact = Group<Number, const int>(&springs.broken[i], count).numbers() <= Number(0.);
		        const Vec armB = broadcast<Number>(placement.axesB) * vectors(springs.anchorsB),
		                  armA = broadcast<Number>(placement.axesA) * vectors(springs.anchorsA), end = broadcast<Number>(placement.distance) + armB;
		        const Vec stretch = select(intact, Vec(end - armA), Vec(Vec::Constant(Number(0.))));
		        const SpringForce<Number> f = springForce<Number>(k, stretch, worldNormal);
		        Group<Number, Vec3>(&springs.stretches[i], count).set(stretch);
		        Group<Number, Vec3>(&springs.forces[i], count).set(f.force);
		        const Number square = f.force.squaredNorm();
		        // with unequal stiffnesses the force is not along the stretch: it acts on both bodies at the anchor of B
		        const Vec torqueA = end.cross(f.force), torqueB = -armB.cross(f.force);
		        sums.add<Number>(count, f.force, torqueA, torqueB, f.energy, sqrt(square));
		        for (size_t l = 0; l < laneCount; ++l)
			        total.largestSquared = std::max(total.largestSquared, lane(square, l));
	        });
	total.force = sums.vector(0);
	total.torqueA = sums.vector(3);
	total.torqueB = sums.vector(6);
	total.energy = sums[9];
	total.sum = sums[10];
	return total;
}

bool isOverloaded(const JointStrength& limit, const JointForce& force)
{
	assert(limit.strength > 0);
	return limit.perJoint ? force.sum > limit.strength : force.largestSquared > limit.strength * limit.strength;
}

BreakCause breakCause(const SpringForce<double>& f)
{
	if (f.force.squaredNorm() > 2 * f.normal * f.normal) return BreakCause::Shear;
	return f.normal > 0 ? BreakCause::Tension : BreakCause::Compression;
}

std::vector<SpringBreak> springBreaks(const JointStiffness& k, const JointStrength& limit, const JointPlacement& placement, const Vec3& normal,
        const JointSprings& springs, const JointMotion& motion)
{
	assert(limit.strength > 0 && isValid(k) && isValid(springs) && isUnit(normal) && motion.h > 0);
	std::vector<SpringBreak> breaks;
	for (size_t i = 0; i < springs.broken.size(); ++i) {
		const bool exceeds = limit.perJoint || springs.forces[i].squaredNorm() > limit.strength * limit.strength;
		if (springs.broken[i] || !exceeds) continue;
		SpringForce<double> f = springForce<double>(k, springs.stretches[i], placement.axesA * normal);
		breaks.push_back({ i, breakCause(f), springs.forces[i].norm(), energyAtBreak(f, placement.axesB * springs.anchorsB[i], motion) });
	}
	return breaks;
}

} // namespace timber

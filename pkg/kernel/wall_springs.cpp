// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_springs.hpp"
#include "preconditions.hpp"
#include <algorithm>
#include <cassert>

namespace timber {

JointForce wallForces(const WallLaw& law, const JointPlacement& placement, const Vec3& axis,
        const JointSprings& springs, std::vector<WallHistory>& histories)
{
	assert(isUnit(axis) && isFinite(placement.distance) && histories.size() == springs.broken.size());
	const Vec3 worldAxis = placement.axesA * axis;
	JointForce total;
	total.isKnown = true;
	double tangents = 0, intact = 0;
	for (size_t i = 0; i < springs.broken.size(); ++i) {
		if (springs.broken[i]) continue;
		const Vec3 armB = placement.axesB * springs.anchorsB[i], end = placement.distance + armB;
		const double stretch = worldAxis.dot(end - placement.axesA * springs.anchorsA[i]);
		const WallForce f = law.advance(histories[i], stretch);
		const Vec3 force = f.history.force * worldAxis;
		histories[i] = f.history;
		springs.stretches[i] = stretch * worldAxis;
		springs.forces[i] = force;
		total.force += force;
		total.torqueA += end.cross(force);
		total.torqueB -= armB.cross(force);
		total.largestSquared = std::max(total.largestSquared, f.history.force * f.history.force);
		total.sum += std::abs(f.history.force);
		total.energy += f.energy;
		total.dissipated += f.dissipated;
		tangents += std::clamp(f.tangent / law.stiffness(), 0., 1.);
		++intact;
	}
	if (intact > 0) total.tangent = tangents / intact;
	return total;
}

WallSprings::WallSprings(const WallLaw& law_, const Vec3& axis_, std::vector<WallHistory>& histories_)
        : law(law_)
        , axis(axis_)
        , histories(histories_)
{
	assert(law.isValid() && isUnit(axis));
}

SpringState WallSprings::along(const WallForce& force) const
{
	SpringState state;
	state.force = force.history.force * axis;
	state.tangent = std::max(0., force.tangent) * axis * axis.transpose();
	state.energy = force.energy;
	state.dissipated = force.dissipated;
	return state;
}

SpringState WallSprings::trial(size_t spring, const Vec3&, const Vec3& to) const
{
	return along(law.hold(histories[spring], axis.dot(to)));
}

SpringState WallSprings::commit(size_t spring, const Vec3&, const Vec3& to)
{
	const WallForce force = law.advance(histories[spring], axis.dot(to));
	histories[spring] = force.history;
	SpringState state = along(force);
	state.breaks = law.isSpent(force.history);
	return state;
}

std::vector<SpringBreak> wallBreaks(
        const WallLaw& law, const JointSprings& springs, const std::vector<WallHistory>& histories)
{
	assert(law.isValid() && histories.size() == springs.broken.size());
	std::vector<SpringBreak> breaks;
	for (size_t i = 0; i < springs.broken.size(); ++i) {
		if (springs.broken[i] || !law.isSpent(histories[i])) continue;
		breaks.push_back({ i, histories[i].stretch > 0 ? BreakCause::Tension : BreakCause::Compression, 0, 0 });
	}
	return breaks;
}

} // namespace timber

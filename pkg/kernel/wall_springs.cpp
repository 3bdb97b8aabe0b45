// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_springs.hpp"
#include "preconditions.hpp"
#include <algorithm>
#include <cassert>

namespace timber {

WallSprings::WallSprings(const WallLaw& law_, const Vec3& axis_)
        : law(law_)
        , axis(axis_)
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
	state.share = std::clamp(force.tangent / law.stiffness(), 0., 1.);
	return state;
}

SpringState WallSprings::trial(size_t spring, const Vec3& to) const
{
	const WallHistory& history = histories[spring];
	return along(keepsForce ? law.hold(history, axis.dot(to)) : law.advance(history, axis.dot(to)));
}

SpringState WallSprings::commit(size_t spring, const Vec3& to)
{
	const WallForce force = law.advance(histories[spring], axis.dot(to));
	histories[spring] = force.history;
	SpringState state = along(force);
	state.breaks = isSpent(spring);
	return state;
}

} // namespace timber

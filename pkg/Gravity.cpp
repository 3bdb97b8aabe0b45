// SPDX-License-Identifier: GPL-2.0-or-later
#include <Gravity.hpp>
#include <bodies.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((UniformGravity));

void UniformGravity::validate() const
{
	require(gravity.allFinite(), "UniformGravity.gravity", gravity.transpose(), "finite");
}

void UniformGravity::action() { addBodyForce(*scene, gravity); }

} // namespace yade

// SPDX-License-Identifier: GPL-2.0-or-later
#include <Gravity.hpp>
#include <bodies.hpp>

namespace yade {

YADE_PLUGIN((UniformGravity));

void UniformGravity::action() { addBodyForce(*scene, gravity); }

} // namespace yade

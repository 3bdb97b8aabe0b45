// SPDX-License-Identifier: GPL-2.0-or-later
#include <Gravity.hpp>
#include <bodies.hpp>
#include <validation.hpp>
#include <pkg/common/GravityEngines.hpp>

namespace yade {

YADE_PLUGIN((UniformGravity));

void UniformGravity::validate() const
{
	require(gravity.allFinite(), "UniformGravity.gravity", gravity.transpose(), "finite");
}

Vector3r gravityOf(const Scene& scene)
{
	if (const auto* engine = findEngine<UniformGravity>(scene)) return engine->gravity;
	const auto* other = findEngine<GravityEngine>(scene);
	return other ? other->gravity : Vector3r(Vector3r::Zero());
}

void UniformGravity::action() { addBodyForce(*scene, gravity); }

} // namespace yade

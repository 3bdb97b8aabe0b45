// SPDX-License-Identifier: GPL-2.0-or-later
#include <Materials.hpp>

namespace yade {

YADE_PLUGIN((ElementMat)(TimberMat)(SnowMat));

namespace {
	void requirePositive(const char* name, Real value, const char* range = "> 0")
	{
		if (!(value > 0) || !std::isfinite(value)) throw std::invalid_argument(string(name) + " = " + std::to_string(value) + ": it must be finite and " + range);
	}
	void requireFriction(Real value)
	{
		if (!(value >= 0) || !std::isfinite(value)) throw std::invalid_argument("friction = " + std::to_string(value) + ": it must be finite and >= 0");
	}
}

void TimberMat::postLoad(TimberMat&)
{
	requirePositive("TimberMat.young", young);
	requirePositive("TimberMat.density", density);
	if (!(poisson > -1 && poisson <= 0.5)) throw std::invalid_argument("TimberMat.poisson = " + std::to_string(poisson) + ": it must be in (-1, 0.5]");
	requireFriction(friction);
}

void SnowMat::postLoad(SnowMat&)
{
	requirePositive("SnowMat.stiffnessPerMass", stiffnessPerMass);
	requirePositive("SnowMat.density", density);
	requireFriction(friction);
}

} // namespace yade

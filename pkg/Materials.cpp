// SPDX-License-Identifier: GPL-2.0-or-later
#include <Materials.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((ElementMat)(TimberMat)(SnowMat));

void ElementMat::validate() const
{
	requirePositive((getClassName() + ".density").c_str(), density);
	requireNonNegative((getClassName() + ".friction").c_str(), friction);
}

void TimberMat::validate() const
{
	requirePositive("TimberMat.young", young);
	require(poisson > -1 && poisson <= 0.5, "TimberMat.poisson", poisson, "in (-1, 0.5]");
}

void SnowMat::validate() const { requirePositive("SnowMat.stiffnessPerMass", stiffnessPerMass); }

} // namespace yade

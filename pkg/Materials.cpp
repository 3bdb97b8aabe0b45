// SPDX-License-Identifier: GPL-2.0-or-later
#include <Materials.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((ElementMat)(TimberMat)(SnowMat));

void ElementMat::validate() const
{
	require(density >= 1e-3 && std::isfinite(density), (getClassName() + ".density").c_str(), density,
	        ">= 0.001 kg/m3");
	require(friction >= 0 && friction <= 1e6, (getClassName() + ".friction").c_str(), friction, "from 0 to 1e6");
}

void TimberMat::validate() const
{
	require(young >= 1e5 && young <= 1e15, "TimberMat.young", young, "from 1e5 to 1e15 Pa (timber: about 1e10)");
	require(poisson > -1 && poisson <= 0.5, "TimberMat.poisson", poisson, "in (-1, 0.5]");
	require(bearing >= 1e3, "TimberMat.bearing", bearing, ">= 1000 Pa, or infinite");
}

void SnowMat::validate() const
{
	require(stiffnessPerMass >= 1 && stiffnessPerMass <= 1e9, "SnowMat.stiffnessPerMass", stiffnessPerMass,
	        "from 1 to 1e9 N/m/kg");
}

} // namespace yade

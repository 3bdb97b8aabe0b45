// SPDX-License-Identifier: GPL-2.0-or-later
#include "slip_law.hpp"
#include "preconditions.hpp"
#include <cassert>

namespace timber {

bool SlipLaw::isValid() const
{
	return stiffness > 0 && strength > 0 && frictionShare >= 0 && frictionShare <= 1 && strength < stiffness * softeningStretch
	        && softeningStretch < ultimateStretch && std::isfinite(stiffness) && std::isfinite(ultimateStretch);
}

double SlipLaw::remaining(double largest) const
{
	if (largest <= softeningStretch) return 1;
	return std::max(0., (ultimateStretch - largest) / (ultimateStretch - softeningStretch));
}

/// y is constant in s up to d_c and linear beyond it.
double SlipLaw::limitIntegral(double largest) const
{
	const double yield = strength / stiffness, plateau = yield * std::max(0., std::min(largest, softeningStretch) - yield);
	if (largest <= softeningStretch) return plateau;
	const double reached = std::min(largest, ultimateStretch); // no force and no work beyond it
	return plateau + (yield + elasticLimit(reached)) / 2 * (slack(reached) - slack(softeningStretch));
}

SlipForce slipForce(const SlipLaw& law, const SlipHistory& history, const Vec3& stretch)
{
	assert(law.isValid() && isFinite(history.plastic) && history.largest >= 0 && isFinite(stretch));
	const double phi = law.frictionShare, k = law.stiffness, r = stretch.norm();
	const double largest = std::max(history.largest, r), limit = law.elasticLimit(largest), slack = law.slack(largest);
	const double slackGrowth = slack - law.slack(history.largest), growth = law.limitIntegral(largest) - law.limitIntegral(history.largest);
	const double mean = slackGrowth > 0 ? growth / slackGrowth : limit;

	Vec3 elastic = stretch - history.plastic;
	const double trial = elastic.norm(), flow = std::max(0., trial - limit);
	if (flow > 0) elastic *= limit / trial;
	const Vec3 plastic = flow > 0 ? Vec3(stretch - elastic) : history.plastic;

	const double slip = std::max(0., r - slack), along = slip > 0 ? slip / r : 0;
	return { k * (phi * elastic + (1 - phi) * along * stretch), k / 2 * (phi * elastic.squaredNorm() + (1 - phi) * slip * slip),
		k * (phi * mean * flow + (1 - phi) * growth), { plastic, largest } };
}

JointForce slipForces(const SlipLaw& law, const JointPlacement& placement, const Vec3& axis, const JointSprings& springs, const SlipHistories& histories)
{
	assert(axis.isZero() || isUnit(axis));
	assert(isFinite(placement.distance) && histories.plastic.size() == springs.broken.size() && histories.largest.size() == springs.broken.size());
	const Vec3 worldAxis = placement.axesA * axis;
	JointForce total;
	for (size_t i = 0; i < springs.broken.size(); ++i) {
		if (springs.broken[i]) continue;
		const Vec3 armB = placement.axesB * springs.anchorsB[i], end = placement.distance + armB;
		Vec3 stretch = end - placement.axesA * springs.anchorsA[i];
		if (!worldAxis.isZero()) stretch = worldAxis.dot(stretch) * worldAxis;
		const SlipForce f = slipForce(law, { histories.plastic[i], histories.largest[i] }, placement.axesA.transpose() * stretch);
		const Vec3 force = placement.axesA * f.force;
		springs.stretches[i] = stretch;
		springs.forces[i] = force;
		histories.plastic[i] = f.history.plastic;
		histories.largest[i] = f.history.largest;
		total.force += force;
		total.torqueA += end.cross(force); // the force is not along the stretch: it acts on both bodies at the anchor of B
		total.torqueB -= armB.cross(force);
		total.largestSquared = std::max(total.largestSquared, force.squaredNorm());
		total.sum += force.norm();
		total.energy += f.energy;
		total.dissipated += f.dissipated;
	}
	return total;
}

std::vector<SpringBreak> slipBreaks(
        const SlipLaw& law, const JointPlacement& placement, const Vec3& normal, const JointSprings& springs, const SlipHistories& histories)
{
	assert(law.isValid() && isUnit(normal));
	std::vector<SpringBreak> breaks;
	for (size_t i = 0; i < springs.broken.size(); ++i) {
		if (springs.broken[i] || histories.largest[i] < law.ultimateStretch) continue;
		const JointStiffness k { law.stiffness, law.stiffness };
		breaks.push_back({ i, breakCause(springForce<double>(k, springs.stretches[i], placement.axesA * normal)), 0, 0 });
	}
	return breaks;
}

} // namespace timber

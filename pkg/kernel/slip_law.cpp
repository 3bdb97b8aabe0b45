// SPDX-License-Identifier: GPL-2.0-or-later
#include "slip_law.hpp"
#include "preconditions.hpp"
#include <cassert>

namespace timber {

namespace {
	/// Relative rounding of the stretches and forces of a backbone. [-]
	constexpr double rounding = 1e-9;

	/// Tangent stiffness of a spring along its stretch of length r, over k; 0 where its force falls. [-]
	/// before, after: histories before and after the update to this stretch
	double tangentAlong(const SlipLaw& law, const SlipHistory& before, const SlipHistory& after, double r)
	{
		const double slack = law.slackAt(after.largest).slack, grown = after.largest - before.largest,
		             limits = after.largest - slack - before.largest + law.slackAt(before.largest).slack;
		const double onBackbone = grown > 0 ? std::max(0., limits / grown) : 0;
		const double friction = after.plastic == before.plastic ? 1 : onBackbone,
		             slip = r <= slack ? 0 : grown > 0 ? onBackbone : 1;
		return law.frictionShare * friction + (1 - law.frictionShare) * slip;
	}
}

const char* SlipLaw::unmetBy(double stiffness, const std::vector<BackbonePoint>& points)
{
	if (points.size() < 2) return "of two or more points";
	BackbonePoint last { 0, 0 };
	for (const BackbonePoint& point : points) {
		if (!(std::isfinite(point.stretch) && std::isfinite(point.force))) return "finite";
		if (!(point.stretch > last.stretch)) return "of ascending stretches > 0";
		if (&point == &points.back() ? point.force != 0 : !(point.force > 0))
			return "of forces > 0, the last one 0";
		if (point.force - last.force > (1 + rounding) * stiffness * (point.stretch - last.stretch))
			return "nowhere steeper than kn";
		last = point;
	}
	return nullptr;
}

SlipLaw::SlipLaw(double k, double phi, const std::vector<BackbonePoint>& points)
        : stiffness(k)
        , frictionShare(phi)
{
	assert(!unmetBy(k, points));
	knots.push_back({ 0, 0, 0 });
	for (const BackbonePoint& point : points) {
		const Knot& last = knots.back();
		const double slack = point.stretch - point.force / k, growth = slack - last.slack;
		Knot next { point.stretch, growth > rounding * point.stretch ? slack : last.slack, 0 };
		next.limitIntegral = last.limitIntegral + (last.limit() + next.limit()) / 2 * (next.slack - last.slack);
		knots.push_back(next);
	}
}

/// s is linear between two points. There is no strength and no work beyond the last one.
SlipLaw::Slack SlipLaw::slackAt(double largest) const
{
	if (largest >= ultimateStretch()) return { largest, knots.back().limitIntegral };
	size_t i = 1;
	while (largest > knots[i].stretch)
		++i;
	const Knot &a = knots[i - 1], &b = knots[i];
	const double slack = a.slack + (b.slack - a.slack) * ((largest - a.stretch) / (b.stretch - a.stretch));
	return { slack, a.limitIntegral + (a.limit() + (largest - slack)) / 2 * (slack - a.slack) };
}

SlipForce slipForce(const SlipLaw& law, const SlipHistory& history, const Vec3& stretch)
{
	assert(law.isValid() && isFinite(history.plastic) && history.largest >= 0 && isFinite(stretch));
	const double phi = law.frictionShare, k = law.stiffness, r = stretch.norm();
	const double largest = std::max(history.largest, r);
	const SlipLaw::Slack now = law.slackAt(largest),
	                     before = largest > history.largest ? law.slackAt(history.largest) : now;
	const double limit = largest - now.slack, slackGrowth = now.slack - before.slack,
	             growth = now.limitIntegral - before.limitIntegral;
	const double mean = slackGrowth > 0 ? growth / slackGrowth : limit;

	Vec3 elastic = stretch - history.plastic;
	const double trial = elastic.norm(), flow = std::max(0., trial - limit);
	if (flow > 0) elastic *= limit / trial;
	const Vec3 plastic = flow > 0 ? Vec3(stretch - elastic) : history.plastic;

	const double slip = std::max(0., r - now.slack), along = slip > 0 ? slip / r : 0;
	return { k * (phi * elastic + (1 - phi) * along * stretch),
		k / 2 * (phi * elastic.squaredNorm() + (1 - phi) * slip * slip),
		k * (phi * mean * flow + (1 - phi) * growth), { plastic, largest } };
}

JointForce slipForces(const SlipLaw& law, const JointPlacement& placement, const Vec3& axis,
        const JointSprings& springs, const SlipHistories& histories)
{
	assert(axis.isZero() || isUnit(axis));
	assert(isFinite(placement.distance) && histories.plastic.size() == springs.broken.size()
	        && histories.largest.size() == springs.broken.size());
	const Vec3 worldAxis = placement.axesA * axis;
	JointForce total;
	double tangents = 0, intact = 0;
	for (size_t i = 0; i < springs.broken.size(); ++i) {
		if (springs.broken[i]) continue;
		const Vec3 armB = placement.axesB * springs.anchorsB[i], end = placement.distance + armB;
		Vec3 stretch = end - placement.axesA * springs.anchorsA[i];
		if (!worldAxis.isZero()) stretch = worldAxis.dot(stretch) * worldAxis;
		const SlipHistory before { histories.plastic[i], histories.largest[i] };
		const SlipForce f = slipForce(law, before, placement.axesA.transpose() * stretch);
		tangents += tangentAlong(law, before, f.history, stretch.norm());
		++intact;
		const Vec3 force = placement.axesA * f.force;
		springs.stretches[i] = stretch;
		springs.forces[i] = force;
		histories.plastic[i] = f.history.plastic;
		histories.largest[i] = f.history.largest;
		total.force += force;
		// The force is not along the stretch: it acts on both bodies at the anchor of B
		total.torqueA += end.cross(force);
		total.torqueB -= armB.cross(force);
		total.largestSquared = std::max(total.largestSquared, force.squaredNorm());
		total.sum += force.norm();
		total.energy += f.energy;
		total.dissipated += f.dissipated;
	}
	if (intact > 0) total.tangent = tangents / intact;
	return total;
}

std::vector<SpringBreak> slipBreaks(const SlipLaw& law, const JointPlacement& placement, const Vec3& normal,
        const JointSprings& springs, const SlipHistories& histories)
{
	assert(law.isValid() && isUnit(normal));
	std::vector<SpringBreak> breaks;
	for (size_t i = 0; i < springs.broken.size(); ++i) {
		if (springs.broken[i] || histories.largest[i] < law.ultimateStretch()) continue;
		const JointStiffness k { law.stiffness, law.stiffness };
		breaks.push_back({ i,
		        breakCause(springForce<double>(k, springs.stretches[i], placement.axesA * normal)), 0, 0 });
	}
	return breaks;
}

} // namespace timber

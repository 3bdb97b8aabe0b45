// SPDX-License-Identifier: GPL-2.0-or-later
#include "slip_law.hpp"
#include "constants.hpp"
#include "preconditions.hpp"
#include <cassert>

namespace timber {

namespace {

	/// Tangent stiffness of a spring along its stretch of length r, over k; 0 where its force falls. [-]
	/// before, after: histories before and after the update to this stretch
	double tangentAlong(const SlipLaw& law, const SlipHistory& before, const SlipHistory& after, double r)
	{
		const double slack = law.slackAt(after.largest).slack, grown = after.largest - before.largest,
		             limits = after.largest - slack - before.largest + law.slackAt(before.largest).slack;
		const double onBackbone = grown > 0 ? std::max(0., limits / grown) : 0;
		const double friction = after.plastic == before.plastic ? 1 : onBackbone,
		             slip = r <= slack ? 0
		        : grown > 0            ? onBackbone
		                               : 1;
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
		if (point.force - last.force > (1 + backboneRounding) * stiffness * (point.stretch - last.stretch))
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
		Knot next { point.stretch, growth > backboneRounding * point.stretch ? slack : last.slack, 0 };
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

double SlipLaw::steepestFall() const
{
	double steepest = 0;
	for (size_t i = 1; i < knots.size(); ++i)
		steepest = std::max(steepest,
		        stiffness * (knots[i - 1].limit() - knots[i].limit())
		                / (knots[i].stretch - knots[i - 1].stretch));
	return steepest;
}

double SlipLaw::largestLimit(double from, double to) const
{
	const auto limitAt = [this](double largest) { return largest - slackAt(largest).slack; };
	double limit = std::max(limitAt(from), limitAt(to));
	for (const Knot& knot : knots)
		if (knot.stretch > from && knot.stretch < to) limit = std::max(limit, knot.limit());
	return limit;
}

namespace {
	/// The slip law while the largest length of the stretch grows to R.
	struct SlipGrowth {
		double largest; ///< R [m]
		double limit, slack; ///< y, s at R [m]
		double mean; ///< elastic limit while s grows, else y [m]
		double work; ///< P at R minus P before [m2]
	};

	SlipGrowth growth(const SlipLaw& law, double before, double largest)
	{
		const SlipLaw::Slack now = law.slackAt(largest), then = largest > before ? law.slackAt(before) : now;
		const double limit = largest - now.slack, slackGrowth = now.slack - then.slack,
		             work = now.limitIntegral - then.limitIntegral;
		return { largest, limit, now.slack, slackGrowth > 0 ? work / slackGrowth : limit, work };
	}

	/// With the largest limit between both ends in place of the last one.
	SlipGrowth heldGrowth(const SlipLaw& law, double before, double largest)
	{
		const double limit = law.largestLimit(before, largest), slack = largest - limit,
		             then = law.slackAt(before).slack, mean = (limit + before - then) / 2;
		return { largest, limit, slack, mean, mean * (slack - then) };
	}

	/// Elastic stretch of the friction part by radial return.
	struct RadialReturn {
		Vec3 elastic; ///< e [m]
		double trial; ///< its length before the return [m]
		double flow; ///< |dp| [m]
	};

	RadialReturn radialReturn(const Vec3& trial, double limit)
	{
		const double length = trial.norm(), flow = std::max(0., length - limit);
		return { flow > 0 ? Vec3(trial * (limit / length)) : trial, length, flow };
	}

	SlipForce forceOf(const SlipLaw& law, const SlipHistory& history, const Vec3& stretch, const SlipGrowth& g)
	{
		const double phi = law.frictionShare, k = law.stiffness, r = stretch.norm();
		const RadialReturn part = radialReturn(stretch - history.plastic, g.limit);
		const Vec3 plastic = part.flow > 0 ? Vec3(stretch - part.elastic) : history.plastic;
		const double slip = std::max(0., r - g.slack), along = slip > 0 ? slip / r : 0;
		return { k * (phi * part.elastic + (1 - phi) * along * stretch),
			k / 2 * (phi * part.elastic.squaredNorm() + (1 - phi) * slip * slip),
			k * (phi * g.mean * part.flow + (1 - phi) * g.work), { plastic, g.largest } };
	}

	/// Tangent of both parts, without the change of the friction part's limit across the stretch.
	Mat3 tangentOf(const SlipLaw& law, const SlipHistory& history, const Vec3& stretch, const SlipGrowth& g)
	{
		const double phi = law.frictionShare, k = law.stiffness, r = stretch.norm(),
		             slip = std::max(0., r - g.slack), grown = g.largest - history.largest,
		             then = history.largest - law.slackAt(history.largest).slack,
		             rise = grown > 0 ? std::max(0., (g.limit - then) / grown) : 1;
		const Mat3 one = Mat3::Identity();
		const Vec3 normal = r > 0 ? Vec3(stretch / r) : Vec3(Vec3::Zero());
		const Mat3 radial = normal * normal.transpose();
		const Vec3 trial = stretch - history.plastic;
		const RadialReturn part = radialReturn(trial, g.limit);
		Mat3 friction = one;
		if (part.flow > 0)
			friction = g.limit / part.trial * (one - trial * trial.transpose() / (part.trial * part.trial))
			        + (grown > 0 ? rise : 0) * radial;
		Mat3 slipping = Mat3::Zero();
		if (slip > 0) slipping = slip / r * (one - radial) + rise * radial;
		return k * (phi * friction + (1 - phi) * slipping);
	}
}

SlipForce slipForce(const SlipLaw& law, const SlipHistory& history, const Vec3& stretch)
{
	assert(law.isValid() && isFinite(history.plastic) && history.largest >= 0 && isFinite(stretch));
	return forceOf(law, history, stretch, growth(law, history.largest, std::max(history.largest, stretch.norm())));
}

SlipForce slipForce(const SlipLaw& law, const SlipHistory& history, const Vec3& stretch, bool keepsForce, Mat3& tangent)
{
	assert(law.isValid() && isFinite(history.plastic) && history.largest >= 0 && isFinite(stretch));
	const SlipGrowth g
	        = (keepsForce ? heldGrowth : growth)(law, history.largest, std::max(history.largest, stretch.norm()));
	tangent = tangentOf(law, history, stretch, g);
	return forceOf(law, history, stretch, g);
}

SlipSprings::SlipSprings(const SlipLaw& l, const Vec3& a, size_t count)
        : law(l)
        , axis(a)
        , plastic(count, Vec3::Zero())
        , largest(count, 0)
{
	assert(law.isValid() && (axis.isZero(0) || isUnit(axis)));
}

SpringState SlipSprings::projected(const SlipForce& force, const Mat3& tangent) const
{
	SpringState state;
	state.force = force.force;
	state.energy = force.energy;
	state.dissipated = force.dissipated;
	state.tangent = axis.isZero(0) ? tangent : Mat3(axis.dot(tangent * axis) * axis * axis.transpose());
	return state;
}

SpringState SlipSprings::trial(size_t spring, const Vec3& to, bool keepsForce) const
{
	const SlipHistory before { plastic[spring], largest[spring] };
	const Vec3 stretch = onAxis(to);
	Mat3 tangent;
	const SlipForce force = slipForce(law, before, stretch, keepsForce, tangent);
	SpringState state = projected(force, tangent);
	state.share = tangentAlong(law, before, force.history, stretch.norm());
	return state;
}

SpringState SlipSprings::commit(size_t spring, const Vec3& to)
{
	const SlipHistory before { plastic[spring], largest[spring] };
	const Vec3 stretch = onAxis(to);
	const SlipForce force = slipForce(law, before, stretch);
	plastic[spring] = force.history.plastic;
	largest[spring] = force.history.largest;
	SpringState state = projected(force, Mat3::Zero());
	state.share = tangentAlong(law, before, force.history, stretch.norm());
	state.breaks = isSpent(spring);
	return state;
}

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
#include "slip_law.hpp"
#include "constants.hpp"
#include "preconditions.hpp"
#include <cassert>

namespace timber {

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
		/// dy / dR >= 0 of each part: where p moves, and where d is beyond the slack. [-]
		double friction, slip;
	};

	SlipGrowth growthTo(double largest, double limit, double mean, double work, double before, double then)
	{
		const double grown = largest - before, rise = grown > 0 ? std::max(0., (limit - then) / grown) : 0;
		return { largest, limit, largest - limit, mean, work, rise, grown > 0 ? rise : 1 };
	}

	SlipGrowth growth(const SlipLaw& law, double before, double largest)
	{
		const SlipLaw::Slack now = law.slackAt(largest), then = largest > before ? law.slackAt(before) : now;
		const double limit = largest - now.slack, slackGrowth = now.slack - then.slack,
		             work = now.limitIntegral - then.limitIntegral;
		return growthTo(largest, limit, slackGrowth > 0 ? work / slackGrowth : limit, work, before,
		        before - then.slack);
	}

	/// With the largest limit between both ends in place of the last one.
	SlipGrowth heldGrowth(const SlipLaw& law, double before, double largest)
	{
		const double limit = law.largestLimit(before, largest), slack = law.slackAt(before).slack,
		             mean = (limit + before - slack) / 2;
		return growthTo(largest, limit, mean, mean * (largest - limit - slack), before, before - slack);
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

	/// Both parts: elastic: e, r: length of the stretch d, slack: s; friction, slip: as in SlipGrowth, of each.
	template <class Number> struct SlipParts {
		Vec3Of<Number> force; ///< [N]
		Number energy, share; ///< [J, -]

		[[gnu::always_inline]] SlipParts(const SlipLaw& law, const Vec3Of<Number>& elastic,
		        const Vec3Of<Number>& stretch, Number r, Number slack, double friction, double slipping)
		{
			const double phi = law.frictionShare, k = law.stiffness;
			const Number none = 0., slip = max(none, Number(r - slack));
			const auto acts = slip > none;
			const Number along = select(acts, Number(slip / select(acts, r, Number(1.))), none);
			force = Number(k) * (Number(phi) * elastic + Number(1 - phi) * along * stretch);
			energy = Number(k / 2) * (Number(phi) * elastic.squaredNorm() + Number(1 - phi) * slip * slip);
			share = Number(phi * friction) + select(acts, Number((1 - phi) * slipping), none);
		}
	};

	SlipForce forceOf(const SlipLaw& law, const SlipHistory& history, const Vec3& stretch, const SlipGrowth& g)
	{
		const double phi = law.frictionShare;
		const RadialReturn part = radialReturn(stretch - history.plastic, g.limit);
		const Vec3 plastic = part.flow > 0 ? Vec3(stretch - part.elastic) : history.plastic;
		const SlipParts<double> both(
		        law, part.elastic, stretch, stretch.norm(), g.slack, part.flow > 0 ? g.friction : 1, g.slip);
		return { both.force, both.energy, law.stiffness * (phi * g.mean * part.flow + (1 - phi) * g.work),
			both.share, { plastic, g.largest } };
	}

	/// Tangent of both parts, without the change of the friction part's limit across the stretch.
	Mat3 tangentOf(const SlipLaw& law, const SlipHistory& history, const Vec3& stretch, const SlipGrowth& g)
	{
		const double phi = law.frictionShare, k = law.stiffness, r = stretch.norm(),
		             slip = std::max(0., r - g.slack);
		const Mat3 one = Mat3::Identity();
		const Vec3 normal = r > 0 ? Vec3(stretch / r) : Vec3(Vec3::Zero());
		const Mat3 radial = normal * normal.transpose();
		const Vec3 trial = stretch - history.plastic;
		const RadialReturn part = radialReturn(trial, g.limit);
		Mat3 friction = one;
		if (part.flow > 0)
			friction = g.limit / part.trial * (one - trial * trial.transpose() / (part.trial * part.trial))
			        + g.friction * radial;
		Mat3 slipping = Mat3::Zero();
		if (slip > 0) slipping = slip / r * (one - radial) + g.slip * radial;
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
{
	assert(law.isValid() && (axis.isZero(0) || isUnit(axis)));
	setHistories(std::vector<Vec3>(count, Vec3::Zero()), std::vector<double>(count, 0));
}

void SlipSprings::setHistories(std::vector<Vec3> plastic, std::vector<double> largest)
{
	assert(plastic.size() == largest.size());
	plasticStretches = std::move(plastic);
	largestStretches = std::move(largest);
	limits.clear();
	for (const double R : largestStretches)
		limits.push_back(R - law.slackAt(R).slack);
}

SpringTrial SlipSprings::trial(size_t spring, const Vec3& to, bool keepsForce) const
{
	Mat3 tangent;
	const SlipForce force = slipForce(law, history(spring), onAxis(to), keepsForce, tangent);
	if (!axis.isZero(0)) tangent = axis.dot(tangent * axis) * axis * axis.transpose();
	return { { force.force, force.energy, force.dissipated, false, force.share }, tangent };
}

SpringState SlipSprings::commit(size_t spring, const Vec3& to)
{
	const SlipForce force = slipForce(law, history(spring), onAxis(to));
	plasticStretches[spring] = force.history.plastic;
	if (force.history.largest > largestStretches[spring]) {
		largestStretches[spring] = force.history.largest;
		limits[spring] = force.history.largest - law.slackAt(force.history.largest).slack;
	}
	return { force.force, force.energy, force.dissipated, isSpent(spring), force.share };
}

bool SlipSprings::steadyForces(size_t first, const Vec3s& to, Lanes::Mask acting, SteadySprings& state) const
{
	if (!axis.isZero(0)) return false;
	const size_t count = largestStretches.size() - first;
	const auto numbers
	        = [&](const std::vector<double>& x) { return Group<Lanes, const double>(&x[first], count).numbers(); };
	const Lanes largest = numbers(largestStretches), limit = numbers(limits), r = sqrt(to.squaredNorm());
	const Vec3s elastic = to - Group<Lanes, const Vec3>(&plasticStretches[first], count).vectors();
	const auto grows = logicalOr(r > largest, largest >= Lanes(law.ultimateStretch())),
	           yields = sqrt(elastic.squaredNorm()) > limit;
	if (any(logicalAnd(acting, logicalOr(grows, yields)))) return false;
	const SlipParts<Lanes> both(law, elastic, to, r, largest - limit, 1, 1);
	state = { both.force, both.energy, both.share };
	return true;
}

} // namespace timber

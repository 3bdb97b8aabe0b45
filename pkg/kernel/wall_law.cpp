// SPDX-License-Identifier: GPL-2.0-or-later
#include "wall_law.hpp"
#include "constants.hpp"
#include "portable_math.hpp"
#include "preconditions.hpp"
#include "slip_law.hpp"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace timber {

namespace {
	/// Of d_2, up to which a spring is elastic. [-] (SAWS)
	constexpr double elasticRange = 1.05;
	constexpr double infinity = std::numeric_limits<double>::infinity();

	const char* unmetPoints(double k, const std::vector<BackbonePoint>& points)
	{
		if (points.size() < 2) return "of two or more points";
		BackbonePoint last { 0, 0 };
		for (const BackbonePoint& point : points) {
			if (!(std::isfinite(point.stretch) && std::isfinite(point.force))) return "finite";
			if (!(point.stretch > last.stretch)) return "of ascending stretches > 0";
			if (!(point.force > 0 || (point.force == 0 && &point == &points.back())))
				return "of forces > 0, the last one >= 0";
			if (point.force - last.force > (1 + backboneRounding) * k * (point.stretch - last.stretch))
				return "nowhere steeper than kn";
			last = point;
		}
		return nullptr;
	}

	BackbonePoint peakOf(const std::vector<BackbonePoint>& points)
	{
		return *std::max_element(points.begin(), points.end(),
		        [](const BackbonePoint& a, const BackbonePoint& b) { return a.force < b.force; });
	}
}

const char* WallLaw::unmetBy(const WallCycles& c, const std::vector<BackbonePoint>& points)
{
	if (const char* const unmet = unmetPoints(c.stiffness, points)) return unmet;
	const BackbonePoint top = peakOf(points);
	if (!(c.friction >= 0 && c.pinchedStiffness >= 0)) return "with a friction force and a pinched stiffness >= 0";
	if (!(c.friction + c.pinchedStiffness * top.stretch < top.force))
		return "with a pinched line below the largest force";
	if (!(c.target >= 1 && std::isfinite(c.target))) return "with a target >= 1";
	if (!(c.reloadShare >= 0 && c.reloadShare <= 1)) return "with a share of reloading in [0, 1]";
	return nullptr;
}

WallLaw::WallLaw(const WallCycles& c, const std::vector<BackbonePoint>& points)
        : cycles(c)
        , peak(peakOf(points).stretch)
{
	assert(!unmetBy(c, points));
	knots.push_back({ 0, 0, 0 });
	for (const BackbonePoint& point : points) {
		const Knot& last = knots.back();
		knots.push_back({ point.stretch, point.force,
		        last.work + (last.force + point.force) / 2 * (point.stretch - last.stretch) });
	}
	meeting = meetingWith({ c.pinchedStiffness, c.friction }, 0);
}

/// Index of the knot at the end of the segment of x >= 0; that of the last knot + 1 beyond it.
std::size_t WallLaw::segment(double x) const
{
	const auto behind = std::upper_bound(
	        knots.begin() + 1, knots.end(), x, [](double value, const Knot& knot) { return value < knot.stretch; });
	return std::size_t(behind - knots.begin());
}

double WallLaw::slopeOf(std::size_t i) const
{
	if (i == knots.size()) return 0;
	return (knots[i].force - knots[i - 1].force) / (knots[i].stretch - knots[i - 1].stretch);
}

double WallLaw::steepestFall() const
{
	double steepest = 0;
	for (std::size_t i = 1; i < knots.size(); ++i)
		steepest = std::max(steepest, -slopeOf(i));
	return steepest;
}

double WallLaw::force(double x) const
{
	const size_t i = segment(x);
	return knots[i - 1].force + slopeOf(i) * (x - knots[i - 1].stretch);
}

/// Integral of B. [J]
double WallLaw::workTo(double x) const
{
	const size_t i = segment(x);
	const double along = x - knots[i - 1].stretch;
	return knots[i - 1].work + along * (knots[i - 1].force + slopeOf(i) * along / 2);
}

/// First stretch from `from` on at which the backbone is not below a line. There is one.
double WallLaw::meetingWith(const Line& line, double from) const
{
	double x = from, below = line.at(from) - force(from);
	for (std::size_t i = segment(from); below > 0 && i < knots.size(); ++i) {
		const double end = knots[i].stretch, closing = slopeOf(i) - line.slope;
		if (below <= closing * (end - x)) return x + below / closing;
		below = line.at(end) - knots[i].force;
		x = end;
	}
	return x;
}

/// First stretch from `from` on at which the backbone falls below a line; infinite if there is none.
double WallLaw::crossing(const Line& line, double from) const
{
	double x = from, above = force(from) - line.at(from);
	for (std::size_t i = segment(from);; ++i) {
		const double closing = line.slope - slopeOf(i), end = i < knots.size() ? knots[i].stretch : infinity;
		const double met = closing > 0 ? x + std::max(0., above) / closing : infinity;
		if (met <= end || i == knots.size()) return met;
		x = end;
		above = knots[i].force - line.at(x);
	}
}

/// k_p and F_f: less where the backbone has fallen.
WallLaw::Line WallLaw::pinched(const WallHistory& history) const
{
	Line p { cycles.pinchedStiffness, cycles.friction };
	for (const double largest : history.largest) {
		if (largest <= peak) continue;
		const double left = std::max(0., force(largest));
		p.offset = std::min(p.offset, left);
		p.slope = std::min(p.slope, (left - p.offset) / largest);
	}
	return p;
}

/// s of the largest displacement u. [m]
double WallLaw::slackOf(double u, const Line& p) const
{
	return u - std::max(0., force(u) - p.at(u)) / (cycles.stiffness - p.slope);
}

WallLaw::Bound WallLaw::bound(double u, const Line& p) const
{
	const bool isWhole = p.slope == cycles.pinchedStiffness && p.offset == cycles.friction;
	const double least = isWhole ? meeting : meetingWith(p, 0), aim = cycles.target * u, end = force(aim);
	if (u == 0 || aim <= least) return { p, least, least, p };
	if (end <= p.at(aim)) {
		const double meets = crossing(p, u);
		return { p, meets, meets, p };
	}
	if (cycles.reloadStiffness == 0) {
		const double start = std::min(std::max(least, cycles.reloadShare * slackOf(u, p)), aim);
		const double slope = start < aim ? (end - p.at(start)) / (aim - start) : p.slope;
		return { p, start, aim, { slope, p.at(start) - slope * start } };
	}
	const double slope = std::min(
	        cycles.stiffness, cycles.reloadStiffness * power(cycles.reloadStretch / aim, cycles.reloadPower));
	const Line reload { slope, end - slope * aim };
	const double start = slope > p.slope ? (p.offset - reload.offset) / (slope - p.slope) : least;
	return { p, std::max(least, start), aim, reload };
}

const WallLaw::Bound& WallLaw::bound(Bounds::Known& known, double u, const Line& p) const
{
	if (known.u != u || !(known.bound.pinched == p)) known = { u, bound(u, p) };
	return known.bound;
}

double WallLaw::valueAt(const Bound& b, double x) const
{
	if (x <= b.start) return b.pinched.at(x);
	if (x >= b.end) return force(x);
	return std::min(b.pinched.at(b.start) + cycles.stiffness * (x - b.start), b.reload.at(x));
}

double WallLaw::energyOf(const Line& p, double x, double force) const
{
	const double rest = force - p.slope * x;
	return (p.slope * x * x + rest * rest / (cycles.stiffness - p.slope)) / 2;
}

double WallLaw::energy(const WallHistory& history) const
{
	if (isElastic(history)) return workTo(std::abs(history.stretch));
	return energyOf(pinched(history), history.stretch, history.force);
}

bool WallLaw::isElastic(const WallHistory& history) const
{
	return std::max(history.largest[0], history.largest[1]) <= elasticRange * meeting;
}

/// Way of a spring up to x1, which is beyond the meeting of the unloading line with the bound: first along the
/// unloading line, then along pieces of the bound.
class WallLaw::Path {
	const WallLaw& law;
	Line unloading; ///< through the point that has been reached
	double x; ///< reached [m]

	/// The spring is on the bound at `to`.
	void reach(double to, double force)
	{
		x = to;
		unloading.offset = force - unloading.slope * to;
	}

public:
	double dissipated = 0; ///< [J]

	Path(const WallLaw& law_, double x0, double force0)
	        : law(law_)
	        , unloading { law_.cycles.stiffness, force0 - law_.cycles.stiffness * x0 }
	        , x(x0)
	{
	}

	/// A line of the bound up to `end`, beside the pinched line p.
	void follow(const Line& line, const Line& p, double end)
	{
		if (x >= end) return;
		const double closing = unloading.slope - line.slope, gap = std::max(0., line.at(x) - unloading.at(x));
		if (gap >= closing * (end - x)) {
			x = end;
			return;
		}
		const double from = x + gap / closing,
		             rest = line.at((from + end) / 2) - p.at((from + end) / 2) + p.offset;
		dissipated += closing / (unloading.slope - p.slope) * rest * (end - from);
		reach(end, line.at(end));
	}

	/// The backbone up to `end`. after: k_p, F_f there.
	void followBackbone(double end, const Line& before, const Line& after)
	{
		if (x >= end) return;
		const double from = std::min(end, law.crossing(unloading, x)), met = law.force(from),
		             reached = law.force(end);
		const double lost = law.workTo(end) - law.workTo(from)
		        - (law.energyOf(after, end, reached) - law.energyOf(before, from, met));
		dissipated += std::max(0., lost);
		from < end ? reach(end, reached) : void(x = end);
	}
};

/// Moves up from (x0, force0) to x1, beyond the bound's meeting with the unloading line. after: k_p, F_f at x1.
WallLaw::Arrival WallLaw::moveAlong(const Bound& b, double x0, double force0, double x1, const Line& after) const
{
	Path path(*this, x0, force0);
	path.follow(b.pinched, b.pinched, std::min(x1, b.start));
	path.follow(b.reload, b.pinched, std::min(x1, b.end));
	path.followBackbone(x1, b.pinched, after);
	const double slope = x1 <= b.start ? b.pinched.slope : x1 < b.end ? b.reload.slope : slopeOf(segment(x1));
	return { valueAt(b, x1), slope, path.dissipated };
}

/// On the backbone up to the stretch of the next history, whose force it sets.
WallForce WallLaw::elastic(double stretch, const WallHistory& next) const
{
	const double x = std::abs(stretch), reached = force(x);
	WallForce now { slopeOf(segment(x)), workTo(x), 0, next };
	now.history.force = stretch < 0 ? -reached : reached;
	if (isElastic(next)) return now;
	now.energy = energyOf(pinched(next), x, reached);
	now.dissipated = std::max(0., workTo(x) - now.energy);
	return now;
}

WallForce WallLaw::advance(const WallHistory& history, Bounds& bounds, double stretch) const
{
	assert(isValid() && std::isfinite(stretch));
	if (stretch == history.stretch) return { cycles.stiffness, energy(history), 0, history };
	const double sign = stretch > history.stretch ? 1 : -1;
	const int side = sign > 0 ? 0 : 1, other = 1 - side;
	const double x0 = sign * history.stretch, x1 = sign * stretch, k = cycles.stiffness;

	WallHistory next = history;
	next.stretch = stretch;
	next.largest[side] = std::max(next.largest[side], x1);
	if (isElastic(history)) return elastic(stretch, next);

	const Line before = pinched(history),
	           after = next.largest[side] > history.largest[side] ? pinched(next) : before;
	const Bound& upper = bound(bounds.ofReversed[side], history.reversed[side], before);
	const double trial = sign * history.force + k * (x1 - x0);
	const Arrival arrival = trial <= valueAt(upper, x1) ? Arrival { trial, k, 0 }
	                                                    : moveAlong(upper, x0, sign * history.force, x1, after);
	next.force = sign * arrival.force;
	// The other side reloads to its largest displacement once the force has fallen below that line
	const double largest = next.largest[other];
	if (largest > next.reversed[other]
	        && -arrival.force <= valueAt(bound(bounds.ofLargest[other], largest, after), -x1))
		next.reversed[other] = largest;
	return { arrival.slope, energyOf(after, stretch, next.force), arrival.dissipated, next };
}

/// Stretch of the largest force on the backbone that a spring follows up to another stretch, away from zero.
double WallLaw::strongest(const WallHistory& history, double stretch) const
{
	const double sign = stretch > history.stretch ? 1 : -1, k = cycles.stiffness, x1 = sign * stretch,
	             x0 = sign * history.stretch, force0 = sign * history.force;
	const Bound upper = bound(history.reversed[sign > 0 ? 0 : 1], pinched(history));
	const double first = std::max({ 0., x0, isElastic(history) ? 0 : upper.end });
	double best = isElastic(history) ? first : std::min(x1, crossing({ k, force0 - k * x0 }, first));
	for (const Knot& knot : knots)
		if (knot.stretch > best && knot.stretch < x1 && knot.force > force(best)) best = knot.stretch;
	return force(x1) < force(best) ? sign * best : stretch;
}

WallForce WallLaw::hold(const WallHistory& history, double stretch) const
{
	WallForce whole = advance(history, stretch);
	if (whole.tangent >= 0) return whole;
	whole.tangent = 0;
	const double from = strongest(history, stretch);
	if (from == stretch) return whole;
	WallForce held
	        = from == history.stretch ? WallForce { 0, energy(history), 0, history } : advance(history, from);
	const double force = held.history.force, before = held.energy;
	held.history.stretch = stretch;
	held.tangent = 0;
	held.energy = energyOf(pinched(held.history), stretch, force);
	held.dissipated += std::max(0., force * (stretch - from) - (held.energy - before));
	return held;
}

WallSprings::WallSprings(const WallLaw& law_, const Vec3& axis_)
        : law(law_)
        , axis(axis_)
{
	assert(law.isValid() && isUnit(axis));
}

std::vector<WallHistory> WallSprings::histories() const
{
	std::vector<WallHistory> all;
	for (const Spring& spring : springs)
		all.push_back(spring.history);
	return all;
}

void WallSprings::setHistories(const std::vector<WallHistory>& all)
{
	springs.assign(all.size(), {});
	for (size_t i = 0; i < all.size(); ++i)
		springs[i].history = all[i];
}

SpringState WallSprings::along(const WallForce& force) const
{
	return { force.history.force * axis, force.energy, force.dissipated, false,
		std::clamp(force.tangent / law.stiffness(), 0., 1.) };
}

SpringTrial WallSprings::trial(size_t spring, const Vec3& to, bool keepsForce) const
{
	const WallHistory& history = springs[spring].history;
	const WallForce force = keepsForce ? law.hold(history, axis.dot(to)) : law.advance(history, axis.dot(to));
	return { along(force), std::max(0., force.tangent) * axis * axis.transpose() };
}

SpringState WallSprings::commit(size_t spring, const Vec3& to)
{
	auto& [history, bounds] = springs[spring];
	const WallForce force = law.advance(history, bounds, axis.dot(to));
	history = force.history;
	SpringState state = along(force);
	state.breaks = isSpent(spring);
	return state;
}

} // namespace timber

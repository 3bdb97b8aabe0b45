// SPDX-License-Identifier: GPL-2.0-or-later
/// Elastic step of contact_pair.hpp, also when the features of points change.
#include "constants.hpp"
#include "contact_pair.hpp"
#include <algorithm>
#include <cassert>

namespace timber {
namespace {

	using Points = std::vector<ContactPoint>;
	using Records = std::vector<PointRecord>;

	/// Relative motion at a contact point x, from the velocities that led to the present placement. They belong to
	/// the middle of the last step, and so do the lever arms: with the present arms, a pair that rotates as a whole
	/// would seem to slide, by h/2 omega^2 per metre between the centres.
	template <class Number>
	[[gnu::always_inline]] inline RelativeMotion<Number> relativeMotion(
	        const Vec3Of<Number>& x, const ElasticInput& input)
	{
		const auto velocity = [&](const BodyKinematics& body) {
			const Vec3Of<Number> arm = x - broadcast<Number>(body.position),
			                     spin = broadcast<Number>(body.spin);
			return Vec3Of<Number>(broadcast<Number>(body.velocity)
			        + spin.cross(arm - Number(input.h / 2) * spin.cross(arm)));
		};
		return { velocity(input.b) - velocity(input.a), (input.a.spin + input.b.spin) / 2 };
	}

	bool haveSameFeatures(const Points& points, const Records& records)
	{
		return std::equal(points.begin(), points.end(), records.begin(), records.end(),
		        [](const auto& p, const auto& r) { return p.id == r.id; });
	}

	template <class Law>
	void elasticPoint(const Law& law, const ElasticInput& input, const ContactPoint& point, PointRecord& record)
	{
		elasticStep<Law, ContactPoint, double>(law, input.pair, point,
		        relativeMotion<double>(point.position, input), input.h, input.form, record);
	}

	/// Overlap that the approach of the bodies in the last step explains. [m]
	template <class Law> double approachAt(const Law& law, const ElasticInput& input, const ContactPoint& point)
	{
		const double speed
		        = std::max(0., -relativeMotion<double>(point.position, input).velocity.dot(point.normal));
		return approachOverlap(law, input.pair.mass, speed, input.h);
	}

	/// First step of a new point, with its initial overlap, whose force is at most the strength, and the plastic one
	/// that the record has. available: energy released so far; returns the part of it that the point takes. [J]
	template <class Law>
	double initialisePoint(const Law& law, const ElasticInput& input, const ContactPoint& point, double available,
	        PointRecord& record)
	{
		const double approach = approachAt(law, input, point);
		const double initial = elasticOverlap(law, input.pair.strength.at(record.crushed), 0,
		        initialOverlap(law, point.overlap, approach, available), point.overlap);
		record.crushed = std::min(record.crushed, point.overlap - initial);
		record.unloadedOverlap = point.overlap - record.crushed - initial;
		elasticPoint(law, input, point, record);
		if (input.form == NormalForm::Increment) record.impact = ImpactState::over();
		record.normalStored = law.energy(initial) - law.energy(std::min(initial, approach));
		return record.normalStored;
	}

	/// First step of a point whose bodies were placed in contact: the spring is loaded, without an impact.
	template <class Law>
	void placePoint(const Law& law, const ElasticInput& input, const ContactPoint& point, PointRecord& record)
	{
		elasticPoint(law, input, point, record);
		record.normalStored = record.energy;
		record.impact = ImpactState::over();
	}

	using SpringsOf = PointSprings<double>;

	/// Springs before the step; the increment form also needs the normal force.
	template <class Number>
	[[gnu::always_inline]] inline PointSprings<Number> loadSprings(
	        const Group<Number, PointRecord>& record, NormalForm form)
	{
		PointSprings<Number> s;
		s.unloadedOverlap = record.get(&SpringsOf::unloadedOverlap);
		s.crushed = record.get(&SpringsOf::crushed);
		s.overlap = record.get(&SpringsOf::overlap);
		s.stiffness = record.get(&SpringsOf::stiffness);
		if (form == NormalForm::Increment) s.normalForce = record.get(&SpringsOf::normalForce);
		s.shearForce = record.get(&SpringsOf::shearForce);
		return s;
	}

	template <class Number>
	[[gnu::always_inline]] inline void saveSprings(
	        const PointSprings<Number>& s, const Group<Number, PointRecord>& record)
	{
		record.set(&SpringsOf::unloadedOverlap, s.unloadedOverlap);
		record.set(&SpringsOf::crushed, s.crushed);
		record.set(&SpringsOf::overlap, s.overlap);
		record.set(&SpringsOf::stiffness, s.stiffness);
		record.set(&SpringsOf::normalForce, s.normalForce);
		record.set(&SpringsOf::energy, s.energy);
		record.set(&SpringsOf::shearForce, s.shearForce);
	}

	/// Elastic step of points whose features are those of the last step.
	template <class Law>
	void stepSameFeatures(const Law& law, const ElasticInput& input, const Points& points, Records& records)
	{
		inLanes(points.size(), [&](auto number, size_t k) {
			using Number = decltype(number);
			struct Placement {
				Vec3Of<Number> normal;
				Number overlap;
			};
			const Group<Number, const ContactPoint> point(&points[k], points.size() - k);
			const Group<Number, PointRecord> record(&records[k], points.size() - k);
			PointSprings<Number> springs = loadSprings<Number>(record, input.form);
			const Placement placement { point.get(&ContactPoint::normal),
				point.get(&ContactPoint::overlap) };
			elasticStep<Law, Placement, Number>(law, input.pair, placement,
			        relativeMotion<Number>(point.get(&ContactPoint::position), input), input.h, input.form,
			        springs);
			saveSprings<Number>(springs, record);
		});
	}

	/// The record that a point continues with other features; null: none.
	const PointRecord* predecessorOf(const ContactPoint& point, const Records& records)
	{
		if (point.predecessor == FeatureId()) return nullptr;
		const auto at = std::find_if(records.begin(), records.end(),
		        [&](const PointRecord& r) { return r.id == point.predecessor; });
		return at != records.end() ? &*at : nullptr;
	}

	bool isContinued(const PointRecord& record, const Points& points)
	{
		return std::any_of(points.begin(), points.end(),
		        [&](const ContactPoint& p) { return p.predecessor == record.id; });
	}

	/// Elastic step when features have changed: 1. move the records of persistent features, and of points that
	/// continue others, and sum the energy of the rest, which do not act any more; 2. step all points. New ones take
	/// over the largest plastic overlap of the pair: a member that slides or rolls keeps its dent. Returns the energy
	/// released minus that given to new points. [J]
	template <class Law>
	double stepChangedFeatures(const Law& law, const ElasticInput& input, const Points& points, Records& records)
	{
		Records next(points.size());
		double released = 0, crushed = 0;
		for (const PointRecord& r : records)
			crushed = std::max(crushed, r.crushed);
		const auto release = [&](const PointRecord& r) {
			if (!isContinued(r, points)) released += r.normalStored + r.shearStored;
		};
		auto old = records.begin();
		for (size_t k = 0; k < next.size(); ++k) { // 1.
			for (; old != records.end() && old->id < points[k].id; ++old)
				release(*old);
			if (old != records.end() && old->id == points[k].id) next[k] = *old++;
			else if (const PointRecord* r = predecessorOf(points[k], records)) {
				next[k] = *r;
				next[k].id = points[k].id;
			}
		}
		for (; old != records.end(); ++old)
			release(*old);
		for (size_t k = 0; k < next.size(); ++k) { // 2.
			const bool isNew = !(next[k].id == points[k].id);
			next[k].id = points[k].id;
			if (isNew) next[k].crushed = crushed;
			const bool isPlaced = isNew && input.placedInContact
			        && points[k].overlap > approachAt(law, input, points[k]);
			if (isPlaced) placePoint(law, input, points[k], next[k]);
			else if (isNew) released -= initialisePoint(law, input, points[k], released, next[k]);
			else elasticPoint(law, input, points[k], next[k]);
		}
		records.swap(next);
		return released;
	}

	/// A point whose surfaces have separated may touch again. In the increment form its force is no function of the
	/// overlap, and it has no impacts.
	void rearmImpacts(NormalForm form, Records& records)
	{
		if (form == NormalForm::Increment) return;
		for (PointRecord& r : records)
			if (r.overlap == 0) r.impact = {};
	}

	[[maybe_unused]] bool isValid(const ElasticInput& input)
	{
		const auto isValidBody = [](const BodyKinematics& body) {
			return isFinite(body.position) && isFinite(body.velocity) && isFinite(body.spin);
		};
		return input.h > 0 && std::isfinite(input.h) && input.pair.mass > 0 && isValidBody(input.a)
		        && isValidBody(input.b) && input.pair.shearRatio > 0 && input.pair.overlapLimit >= 0;
	}
	[[maybe_unused]] bool isValid(const Points& points)
	{
		const auto isBefore = [](const ContactPoint& p, const ContactPoint& q) { return p.id < q.id; };
		const auto isValidPoint = [](const ContactPoint& p) {
			return isFinite(p.position) && isUnit(p.normal) && p.overlap > 0 && std::isfinite(p.overlap);
		};
		return std::is_sorted(points.begin(), points.end(), isBefore)
		        && std::all_of(points.begin(), points.end(), isValidPoint);
	}

} // namespace

template <class Law>
double elasticPair(const Law& law, const ElasticInput& input, const Points& points, Records& records)
{
	assert(isValid(input) && isValid(points));
	double released = 0;
	if (haveSameFeatures(points, records)) stepSameFeatures(law, input, points, records);
	else released = stepChangedFeatures(law, input, points, records);
	if (input.moved)
		for (PointRecord& r : records)
			r.normalStored = r.energy;
	rearmImpacts(input.form, records);
	return released;
}
template double elasticPair(const HertzLaw&, const ElasticInput&, const Points&, Records&);
template double elasticPair(const LinearLaw&, const ElasticInput&, const Points&, Records&);

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
#include <OverlapCheck.hpp>
#include <ContactPhysics.hpp>
#include <bodies.hpp>
#include <kernel/core_distance.hpp>
#include <sampling.hpp>
#include <validation.hpp>

namespace yade {

YADE_PLUGIN((OverlapCheck));

namespace {

	/// Growth of the largest uncarried overlap for which another line is printed. [-]
	constexpr Real reportedGrowth = 1.1;

	/// Overlap of a pair and what its contact points carry. [m]
	struct PairOverlap {
		Real total = 0, carried = 0, radius = 0;
		Body::id_t id1 = -1, id2 = -1;

		Real uncarried() const { return total - carried; }
	};

	PairOverlap overlapOf(const Interaction& I, const Body& b1, const Body& b2)
	{
		const auto &a = *static_cast<RoundedPolyhedron*>(b1.shape.get())->geometry,
		           &b = *static_cast<RoundedPolyhedron*>(b2.shape.get())->geometry;
		PairOverlap pair;
		pair.id1 = I.getId1();
		pair.id2 = I.getId2();
		pair.radius = math::min(a.radius, b.radius);
		// The force of a contact is constant beyond the contact of the cores
		pair.total = math::min(a.radius + b.radius,
		        timber::bodyOverlap(a, b, { b1.state->pos, b1.state->ori }, { b2.state->pos, b2.state->ori }));
		if (const auto phys = dynamic_cast<const ManifoldPhys*>(I.phys.get()))
			for (const timber::PointRecord& r : phys->records)
				pair.carried = math::max(pair.carried, Real(r.overlap + r.crushed));
		return pair;
	}

	void report(const PairOverlap& worst, int others, Real time)
	{
		std::ostringstream line;
		line << "t = " << time << " s: bodies " << worst.id1 << " and " << worst.id2 << " overlap by "
		     << 1e3 * worst.total << " mm, of which their contacts carry " << 1e3 * worst.carried << " mm";
		if (others > 0) line << " (and " << others << " more pairs)";
		std::cerr << line.str() << "\n";
	}

} // namespace

void OverlapCheck::validate() const
{
	requireNonNegative("OverlapCheck.interval", interval);
	require(share > 0, "OverlapCheck.share", share, "> 0");
}

void OverlapCheck::action()
{
	if (!isSampleDue(*scene, interval, nextCheck)) return;
	PairOverlap worst;
	int count = 0;
	for (const shared_ptr<Interaction>& I : *scene->interactions) {
		const Body *b1 = bodyAt(*scene, I->getId1()), *b2 = bodyAt(*scene, I->getId2());
		if (!b1 || !b2 || !I->geom || !roundedShape(*b1) || !roundedShape(*b2)) continue;
		if (!isFree(*b1->state) && !isFree(*b2->state)) continue;
		const PairOverlap pair = overlapOf(*I, *b1, *b2);
		if (!(pair.uncarried() > share * pair.radius)) continue;
		++count;
		if (pair.uncarried() > worst.uncarried()) worst = pair;
	}
	if (worst.uncarried() <= largest) return;
	if (worst.uncarried() > reportedGrowth * largest) report(worst, count - 1, scene->time);
	largest = worst.uncarried();
	time = scene->time;
	id1 = worst.id1;
	id2 = worst.id2;
}

} // namespace yade

// SPDX-License-Identifier: GPL-2.0-or-later
/// Energy released with points that cease to exist, and initial overlap of new points.
#include <algorithm>
#include <gtest/gtest.h>
#include <kernel/contact_pair.hpp>

using namespace timber;

namespace {

const HertzLaw law { 5e9, 0.1 };
constexpr double overlap = 1e-3; // [m]
constexpr double h = 1e-4; // [s]
constexpr double rounding = 1e-12; ///< of a root and a few products, relative
const PairProperties pair { 1e6, 0.5, 0.4, 1 }; ///< heavy: contacts do not stop it within a step
const FeatureId vertex(FeatureKind::VertexFace, 3, 1), face(FeatureKind::FaceVertex, 2, 5), edge(FeatureKind::EdgeEdge, 4, 7),
        otherEdge(FeatureKind::EdgeEdge, 4, 8);

ContactPoint pointOf(FeatureId id, double at) { return { id, Vec3::Zero(), Vec3::UnitZ(), at }; }

/// A persistent point with that overlap.
PointRecord loaded(FeatureId id, double at)
{
	PointRecord record;
	record.id = id;
	record.overlap = at;
	record.stiffness = law.stiffness(at);
	record.normalForce = law.force(at);
	record.energy = law.energy(at);
	return record;
}

/// A step in which B approached with that speed [m/s]. Returns the energy released. [J]
double step(const std::vector<ContactPoint>& points, std::vector<PointRecord>& records, double speed = 0, bool placedInContact = false)
{
	const Vec3 none = Vec3::Zero(), approach(0, 0, -speed);
	const double released
	        = elasticPair(law, { pair, { none, none, none }, { none, approach, none }, h, NormalForm::Closed, placedInContact }, points, records);
	EXPECT_TRUE(std::equal(
	        points.begin(), points.end(), records.begin(), records.end(), [](const ContactPoint& p, const PointRecord& s) { return p.id == s.id; }));
	return released;
}

void expectOverlap(const PointRecord& record, double effective, double total)
{
	EXPECT_NEAR(record.overlap, effective, rounding * overlap);
	EXPECT_NEAR(record.excess, total - effective, rounding * overlap);
}

/// Energy released with a point of that overlap, and `beyond` the limit [m], in a step in which the bodies close by `closing` [m].
double releasedWith(double closing, double beyond = 0)
{
	const Vec3 none = Vec3::Zero();
	const BodyKinematics still { none, none, none };
	PointRecord record;
	record.overlap = overlap;
	record.normalForce = law.force(overlap);
	record.energy = law.energy(overlap) + beyond * record.normalForce;
	record.closing = closing;
	std::vector<PointRecord> records { record };
	const double released = elasticPair(law, { pair, still, still, h }, {}, records);
	EXPECT_TRUE(records.empty());
	return released;
}

} // namespace

TEST(ReleasedEnergy, ExcludesThePartThatTheSpringReturns)
{
	EXPECT_EQ(releasedWith(-2 * overlap), 0); // the bodies separated
	EXPECT_EQ(releasedWith(-overlap), 0);
	EXPECT_EQ(releasedWith(-overlap / 2), law.energy(overlap / 2)); // half of the overlap was left when its feature ended
	EXPECT_EQ(releasedWith(0), law.energy(overlap)); // a vertex that slides over a border
	EXPECT_EQ(releasedWith(overlap), law.energy(overlap)); // compression still to come is not stored yet
}

/// Beyond the limit the force is constant.
TEST(ReleasedEnergy, IncludesTheOverlapBeyondTheLimit)
{
	constexpr double beyond = 5e-3;
	const double limit = law.energy(overlap), force = law.force(overlap);
	EXPECT_NEAR(releasedWith(0, beyond), limit + beyond * force, limit * rounding);
	EXPECT_NEAR(releasedWith(-1e-3, beyond), limit + (beyond - 1e-3) * force, limit * rounding);
	EXPECT_NEAR(releasedWith(-beyond - overlap / 2, beyond), law.energy(overlap / 2), limit * rounding);
	EXPECT_EQ(releasedWith(-beyond - 2 * overlap, beyond), 0);
}

/// The tangential spring returns nothing within the step, whether the bodies separate or not.
TEST(ReleasedEnergy, IncludesAllShearEnergy)
{
	PointRecord record = loaded(vertex, overlap);
	record.shearForce = { 3e3, 4e3, 0 };
	const double shear = 25e6 / (2 * 0.4 * law.stiffness(overlap));
	for (const double closing : { 0., -2 * overlap }) {
		record.closing = closing;
		std::vector<PointRecord> records { record };
		EXPECT_NEAR(step({}, records), shear + (closing < 0 ? 0 : record.energy), rounding * record.energy);
	}
}

/// Points end before, between and after persistent points, which retain their history and are not treated as new.
TEST(ReleasedEnergy, ExcludesPersistentPoints)
{
	std::vector<PointRecord> records { loaded(vertex, overlap), loaded(face, 2 * overlap), loaded(edge, 3 * overlap), loaded(otherEdge, 4 * overlap) };
	records[1].shearForce = Vec3::UnitX();
	const double released = step({ pointOf(face, 2 * overlap), pointOf(otherEdge, 4 * overlap) }, records);
	EXPECT_NEAR(released, law.energy(overlap) + law.energy(3 * overlap), rounding * released);
	expectOverlap(records[0], 2 * overlap, 2 * overlap);
	expectOverlap(records[1], 4 * overlap, 4 * overlap);
	EXPECT_EQ(records[0].shearForce, Vec3::UnitX());
	EXPECT_NEAR(step({ pointOf(face, 2 * overlap) }, records), law.energy(4 * overlap), rounding * law.energy(overlap));
}

/// A vertex slides over a border and an edge takes its place: the edge gets at most the energy of the vertex, and the rest is released.
TEST(InitialOverlap, UsesTheReleasedEnergy)
{
	for (const double total : { overlap / 2, overlap, 3 * overlap }) {
		const double effective = std::min(total, overlap), whole = law.energy(overlap);
		std::vector<PointRecord> records { loaded(vertex, overlap) };
		EXPECT_NEAR(step({ pointOf(edge, total) }, records), whole - law.energy(effective), rounding * whole);
		expectOverlap(records[0], effective, total);
		EXPECT_NEAR(records[0].normalForce, law.force(effective), rounding * law.force(overlap));
	}
}

/// The released energy is distributed in the order of the points.
TEST(InitialOverlap, UsesTheReleasedEnergyOnce)
{
	std::vector<PointRecord> records { loaded(vertex, overlap) };
	EXPECT_NEAR(step({ pointOf(edge, overlap / 2), pointOf(otherEdge, 3 * overlap) }, records), 0, rounding * law.energy(overlap));
	const double left = law.overlapOf(law.energy(overlap) - law.energy(overlap / 2));
	expectOverlap(records[0], overlap / 2, overlap / 2);
	expectOverlap(records[1], left, 3 * overlap);
}

/// The approach explains its part of the overlap; only the rest takes released energy.
TEST(InitialOverlap, ApproachTakesNoReleasedEnergy)
{
	const double speed = overlap / 2 / h, whole = law.energy(overlap);
	std::vector<PointRecord> records;
	EXPECT_EQ(step({ pointOf(edge, 3 * overlap) }, records, speed), 0);
	expectOverlap(records[0], overlap / 2, 3 * overlap);
	records = { loaded(vertex, overlap) };
	EXPECT_NEAR(step({ pointOf(edge, 3 * overlap) }, records, speed), law.energy(overlap / 2), rounding * whole);
	expectOverlap(records[0], overlap, 3 * overlap);
	records = { loaded(vertex, overlap) };
	EXPECT_NEAR(step({ pointOf(edge, overlap / 4) }, records, speed), whole, rounding * whole); // the approach explains more than the overlap
	expectOverlap(records[0], overlap / 4, overlap / 4);
	records.clear();
	EXPECT_EQ(step({ pointOf(edge, 3 * overlap) }, records, -speed), 0); // separating bodies explain none
	expectOverlap(records[0], 0, 3 * overlap);
}

/// Bodies placedInContact in contact start with their whole overlap, others without approach with none.
TEST(InitialOverlap, IsTheWholeOverlapOfBodiesPlacedInContact)
{
	for (const bool placedInContact : { false, true }) {
		std::vector<PointRecord> records;
		EXPECT_EQ(step({ pointOf(vertex, overlap), pointOf(edge, 2 * overlap) }, records, 0, placedInContact), 0);
		for (size_t k = 0; k < 2; ++k)
			expectOverlap(records[k], placedInContact ? double(k + 1) * overlap : 0, double(k + 1) * overlap);
	}
}

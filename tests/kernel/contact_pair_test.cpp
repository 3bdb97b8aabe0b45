// SPDX-License-Identifier: GPL-2.0-or-later
/// Energy of points that separate or cease to exist, and initial overlap of new points.
#include "../../benchmarks/timber_pair.hpp"
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
const FeatureId vertex(FeatureKind::VertexFace, 3, 1), face(FeatureKind::FaceVertex, 2, 5),
        edge(FeatureKind::EdgeEdge, 4, 7), otherEdge(FeatureKind::EdgeEdge, 4, 8);

ContactPoint pointOf(FeatureId id, double at) { return { id, {}, Vec3::Zero(), Vec3::UnitZ(), at }; }

/// A persistent point with that overlap.
PointRecord loaded(FeatureId id, double at)
{
	PointRecord record;
	record.id = id;
	record.overlap = at;
	record.stiffness = law.stiffness(at);
	record.normalForce = law.force(at);
	record.energy = record.normalStored = law.energy(at);
	return record;
}

/// A step in which B approached with that speed [m/s]. Returns the energy released. [J]
double step(const std::vector<ContactPoint>& points, std::vector<PointRecord>& records, double speed = 0,
        bool placedInContact = false)
{
	const Vec3 none = Vec3::Zero(), approach(0, 0, -speed);
	const double released = elasticPair(law,
	        { pair, { none, none, none }, { none, approach, none }, h, NormalForm::Closed, placedInContact },
	        points, records);
	EXPECT_TRUE(std::equal(points.begin(), points.end(), records.begin(), records.end(),
	        [](const ContactPoint& p, const PointRecord& s) { return p.id == s.id; }));
	return released;
}

void expectOverlap(const PointRecord& record, double effective, double total)
{
	EXPECT_NEAR(record.overlap, effective, rounding * overlap);
	EXPECT_NEAR(record.unloadedOverlap, total - effective, rounding * overlap);
}

/// A body of that mass [kg] on a fixed one, with one point of the overlap, moves with the speed of separation [m/s] in
/// a step of hh [s].
struct Separation {
	std::vector<SolverBody> bodies { 2 };
	std::vector<PointRecord> records { loaded(vertex, overlap) };
	PairEnergies energies;

	Separation(double mass, double speed, double hh, double ratio, const Vec3& shear = Vec3::Zero())
	{
		for (SolverBody& b : bodies) {
			b.velocity = b.newVelocity = b.spin = b.newSpin = Vec3::Zero();
			b.inverseInertia = Mat3::Zero();
			b.inverseMass = 0;
		}
		bodies[1].inverseMass = 1 / mass;
		bodies[1].velocity = bodies[1].newVelocity = { 0, 0, speed };
		records[0].shearForce = shear;
		records[0].shearStored = shear.squaredNorm() / (2 * 0.4 * law.stiffness(overlap));
		records[0].impact = ImpactState::over();
		const PairProperties properties { mass, 0.5, 0.4, 1, ratio };
		const std::vector<ContactPoint> points { pointOf(vertex, overlap) };
		ContactSolver solver;
		solver.begin(bodies, hh, 100);
		solver.addPair(0, 1, 1);
		prepareContacts(solver, 0, properties, points, records);
		solver.solve(1e-12);
		storeForces(solver, 0, properties, records, energies);
	}
	double after() const { return bodies[1].newVelocity.z(); }
};

} // namespace

/// A point that separates within the step gives the body its account A and no more: m (v'^2 - v^2) / 2 = A for the
/// velocity v' after the step.
TEST(SeparatingPoint, ReturnsItsAccount)
{
	const double mass = 2, hh = std::sqrt(3 * mass / law.stiffness(overlap)), energy = law.energy(overlap);
	for (const double share : { 0.5, 0.1, 1e-3 }) { // of the step, in which the overlap ends
		const double speed = overlap / hh / share, after = Separation(mass, speed, hh, 0).after();
		EXPECT_NEAR(after, std::sqrt(speed * speed + 2 * energy / mass), after * rounding) << share;
	}
}

/// What the body does not get, the dashpot dissipates or the spring still has.
TEST(SeparatingPoint, ClosesTheEnergyBalance)
{
	const double mass = 2, energy = law.energy(overlap);
	for (const double ratio : { 0., 0.3, 1. })
		for (const double y : { 0.1, 1., 3., 30. }) // h^2 K / m
			for (const double share : { 100., 2., 0.5, 1e-3 }) {
				const double hh = std::sqrt(y * mass / law.stiffness(overlap)),
				             speed = overlap / hh / share;
				const Separation s(mass, speed, hh, ratio);
				const double gained = mass / 2 * (s.after() * s.after() - speed * speed);
				EXPECT_NEAR(gained + s.energies.dashpotNormal + s.records[0].normalStored, energy,
				        (energy + mass * speed * speed) * rounding)
				        << y << " " << share;
				EXPECT_GE(s.energies.dashpotNormal, -energy * rounding);
				EXPECT_LE(share < 1 ? s.records[0].normalStored : 0, energy * rounding);
			}
}

/// A point that ceases to exist loses what both springs have in the middle between the last placement and the next one.
TEST(ReleasedEnergy, IsThatOfBothAccounts)
{
	const Vec3 shear(300, 400, 0);
	for (const double speed : { 0., 0.3, -0.3 }) { // [m/s], of a heavy body: its velocity is constant
		Separation s(1e9, speed, h, 0, shear);
		const double way = -speed * h / 2, normal = law.energy(overlap + way),
		             tangential = shear.squaredNorm() / (2 * 0.4 * law.stiffness(overlap));
		EXPECT_LE(s.records[0].normalStored, normal * (1 + 1e-6));
		EXPECT_NEAR(s.records[0].shearStored, tangential, 1e-9 * tangential);
		const double both = s.records[0].normalStored + s.records[0].shearStored;
		EXPECT_EQ(step({}, s.records), both);
		EXPECT_TRUE(s.records.empty());
	}
}

/// Points end before, between and after persistent points, which retain their history and are not treated as new.
TEST(ReleasedEnergy, ExcludesPersistentPoints)
{
	std::vector<PointRecord> records { loaded(vertex, overlap), loaded(face, 2 * overlap),
		loaded(edge, 3 * overlap), loaded(otherEdge, 4 * overlap) };
	records[1].shearForce = Vec3::UnitX();
	const double released = step({ pointOf(face, 2 * overlap), pointOf(otherEdge, 4 * overlap) }, records);
	EXPECT_NEAR(released, law.energy(overlap) + law.energy(3 * overlap), rounding * released);
	expectOverlap(records[0], 2 * overlap, 2 * overlap);
	expectOverlap(records[1], 4 * overlap, 4 * overlap);
	EXPECT_EQ(records[0].shearForce, Vec3::UnitX());
	EXPECT_NEAR(
	        step({ pointOf(face, 2 * overlap) }, records), law.energy(4 * overlap), rounding * law.energy(overlap));
}

/// A vertex slides over a border and an edge takes its place: the edge gets at most the energy of the vertex, and the
/// rest is released.
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
	EXPECT_NEAR(step({ pointOf(edge, overlap / 2), pointOf(otherEdge, 3 * overlap) }, records), 0,
	        rounding * law.energy(overlap));
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
	// The approach explains more than the overlap
	EXPECT_NEAR(step({ pointOf(edge, overlap / 4) }, records, speed), whole, rounding * whole);
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
		EXPECT_EQ(
		        step({ pointOf(vertex, overlap), pointOf(edge, 2 * overlap) }, records, 0, placedInContact), 0);
		for (size_t k = 0; k < 2; ++k)
			expectOverlap(
			        records[k], placedInContact ? double(k + 1) * overlap : 0, double(k + 1) * overlap);
	}
}

/// Bodies that are placed in contact and approach each other: an overlap that the approach in a step explains begins an
/// impact, and has no energy of its own.
TEST(InitialOverlap, OfBodiesPlacedInApproach)
{
	for (const double share : { 0.5, 1.5 }) {
		std::vector<PointRecord> records;
		EXPECT_EQ(step({ pointOf(vertex, overlap) }, records, share * overlap / h, true), 0);
		expectOverlap(records[0], overlap, overlap);
		EXPECT_EQ(records[0].impact.isPending(), share > 1);
		EXPECT_NEAR(records[0].normalStored, share > 1 ? 0 : law.energy(overlap), 1e-12 * law.energy(overlap));
	}
}

/// A point with an excess separates and is loaded again. In the increment form its force starts at zero, and it has no
/// impacts; in the closed form the next touch is one.
TEST(Separation, EndsForceAndImpact)
{
	for (const NormalForm form : { NormalForm::Closed, NormalForm::Increment }) {
		std::vector<PointRecord> records;
		const auto place = [&](double at, double speed) {
			const Vec3 none = Vec3::Zero(), approach(0, 0, -speed);
			elasticPair(law, { pair, { none, none, none }, { none, approach, none }, h, form },
			        { pointOf(vertex, at) }, records);
		};
		place(overlap, overlap / 2 / h); // half of the overlap is an excess
		EXPECT_GT(records[0].unloadedOverlap, 0);
		place(1.5 * overlap, 0);
		EXPECT_GT(records[0].normalForce, 0);
		place(0.4 * overlap, 0); // within the excess
		EXPECT_EQ(records[0].overlap, 0);
		EXPECT_EQ(records[0].normalForce, 0);
		EXPECT_EQ(records[0].impact.isPending(), form == NormalForm::Closed);
		place(0.5 * overlap, 0);
		const double n = 0.1 * overlap,
		             force = form == NormalForm::Closed ? law.force(n) : law.stiffness(n) * n;
		EXPECT_NEAR(records[0].normalForce, force, 1e-12 * force);
	}
}

/// The pairs of benchmarks/ have the points and depths that they state, and their solver converges.
TEST(Benchmark, PairsHaveTheirPoints)
{
	for (const bench::Configuration& c : bench::configurations()) {
		bench::TimberPair pair(c);
		for (int k = 0; k < 20; ++k)
			pair.step(k);
		EXPECT_EQ(pair.found().points, c.points) << c.name;
		EXPECT_LT(pair.found().depthError, 1e-12) << c.name;
		EXPECT_LT(pair.sweepsPerStep(), 20) << c.name;
	}
}

// SPDX-License-Identifier: GPL-2.0-or-later
/// What is lost with a point that ceases to exist, and what another that comes in its stead may start with.
#include <algorithm>
#include <gtest/gtest.h>
#include <kernel/contact_pair.hpp>

using namespace timber;

namespace {

const HertzLaw law { 5e9, 0.1 };
constexpr double overlap = 1e-3; // [m]
constexpr double h = 1e-4; // [s]
constexpr double rounding = 1e-12; ///< of a root and a few products, relative
const PairProperties pair { 1e6, 0.5, 0.4, 1 }; ///< heavy: approaches are not stopped within a step
const FeatureId vertex(FeatureKind::VertexFace, 3, 1), face(FeatureKind::FaceVertex, 2, 5), edge(FeatureKind::EdgeEdge, 4, 7), otherEdge(FeatureKind::EdgeEdge, 4, 8);

ContactPoint pointOf(FeatureId id, double at) { return { id, Vec3::Zero(), Vec3::UnitZ(), at }; }

/// A point that has had that overlap for a while.
PointState held(FeatureId id, double at)
{
	PointState state;
	state.id = id;
	state.overlap = at;
	state.stiffness = law.stiffness(at);
	state.normal = law.force(at);
	state.energy = law.energy(at);
	return state;
}

/// A step in which B came nearer with that speed [m/s]. Returns the energy lost. [J]
double step(const std::vector<ContactPoint>& points, std::vector<PointState>& states, double speed = 0, bool placed = false)
{
	const Vec3 none = Vec3::Zero(), nearer(0, 0, -speed);
	const double lost = elasticPair(law, pair, { none, none, none }, { none, nearer, none }, h, NormalForm::Closed, placed, points, states);
	EXPECT_TRUE(std::equal(points.begin(), points.end(), states.begin(), states.end(), [](const ContactPoint& p, const PointState& s) { return p.id == s.id; }));
	return lost;
}

void expectOverlap(const PointState& state, double counted, double there)
{
	EXPECT_NEAR(state.overlap, counted, rounding * overlap);
	EXPECT_NEAR(state.excess, there - counted, rounding * overlap);
}

/// Energy lost when a point with that overlap, and `beyond` the limit [m], goes in a step in which the bodies close by `closing` [m].
double lostWith(double closing, double beyond = 0)
{
	const Vec3 none = Vec3::Zero();
	const BodyMotion still { none, none, none };
	PointState state;
	state.overlap = overlap;
	state.normal = law.force(overlap);
	state.energy = law.energy(overlap) + beyond * state.normal;
	state.closing = closing;
	std::vector<PointState> states { state };
	const double lost = elasticPair(law, PairProperties {}, still, still, h, NormalForm::Closed, false, {}, states);
	EXPECT_TRUE(states.empty());
	return lost;
}

} // namespace

TEST(Leaving, WhatTheSpringHasGivenBackIsNotLost)
{
	EXPECT_EQ(lostWith(-2 * overlap), 0); // they parted
	EXPECT_EQ(lostWith(-overlap), 0);
	EXPECT_EQ(lostWith(-overlap / 2), law.energy(overlap / 2)); // half way out when its feature went
	EXPECT_EQ(lostWith(0), law.energy(overlap)); // a vertex that slides over a border
	EXPECT_EQ(lostWith(overlap), law.energy(overlap)); // what more would be pressed has not been paid for
}

/// Beyond the limit the force is constant.
TEST(Leaving, DeepPointsLoseWhatTheyHold)
{
	constexpr double beyond = 5e-3;
	const double limit = law.energy(overlap), force = law.force(overlap);
	EXPECT_NEAR(lostWith(0, beyond), limit + beyond * force, limit * rounding);
	EXPECT_NEAR(lostWith(-1e-3, beyond), limit + (beyond - 1e-3) * force, limit * rounding);
	EXPECT_NEAR(lostWith(-beyond - overlap / 2, beyond), law.energy(overlap / 2), limit * rounding);
	EXPECT_EQ(lostWith(-beyond - 2 * overlap, beyond), 0);
}

/// The tangential spring gives nothing back on the way, whether the bodies part or not.
TEST(Leaving, ShearEnergyIsLostWhole)
{
	PointState state = held(vertex, overlap);
	state.shear = { 3e3, 4e3, 0 };
	const double shear = 25e6 / (2 * 0.4 * law.stiffness(overlap));
	for (const double closing : { 0., -2 * overlap }) {
		state.closing = closing;
		std::vector<PointState> states { state };
		EXPECT_NEAR(step({}, states), shear + (closing < 0 ? 0 : state.energy), rounding * state.energy);
	}
}

/// Before, between and behind the points that stay, which keep what they had, and are not charged as new ones.
TEST(Leaving, PointsThatStayAreNotLost)
{
	std::vector<PointState> states { held(vertex, overlap), held(face, 2 * overlap), held(edge, 3 * overlap), held(otherEdge, 4 * overlap) };
	states[1].shear = Vec3::UnitX();
	const double lost = step({ pointOf(face, 2 * overlap), pointOf(otherEdge, 4 * overlap) }, states);
	EXPECT_NEAR(lost, law.energy(overlap) + law.energy(3 * overlap), rounding * lost);
	expectOverlap(states[0], 2 * overlap, 2 * overlap);
	expectOverlap(states[1], 4 * overlap, 4 * overlap);
	EXPECT_EQ(states[0].shear, Vec3::UnitX());
	EXPECT_NEAR(step({ pointOf(face, 2 * overlap) }, states), law.energy(4 * overlap), rounding * law.energy(overlap));
}

/// A vertex slides over a border and an edge answers in its stead: it starts with no more than the vertex has lost, and that is no longer lost.
TEST(Handover, TheNewPointPaysForItsOverlap)
{
	for (const double there : { overlap / 2, overlap, 3 * overlap }) {
		const double counted = std::min(there, overlap), whole = law.energy(overlap);
		std::vector<PointState> states { held(vertex, overlap) };
		EXPECT_NEAR(step({ pointOf(edge, there) }, states), whole - law.energy(counted), rounding * whole);
		expectOverlap(states[0], counted, there);
		EXPECT_NEAR(states[0].normal, law.force(counted), rounding * law.force(overlap));
	}
}

/// The energy lost is shared out in the order of the points.
TEST(Handover, WhatOnePointHasTakenIsNotThereForTheNext)
{
	std::vector<PointState> states { held(vertex, overlap) };
	EXPECT_NEAR(step({ pointOf(edge, overlap / 2), pointOf(otherEdge, 3 * overlap) }, states), 0, rounding * law.energy(overlap));
	const double left = law.overlapOf(law.energy(overlap) - law.energy(overlap / 2));
	expectOverlap(states[0], overlap / 2, overlap / 2);
	expectOverlap(states[1], left, 3 * overlap);
}

/// What the bodies came nearer in the step explains an overlap by itself: it takes nothing of the lost energy, only what is beyond it does.
TEST(Handover, AnApproachIsNotCharged)
{
	const double speed = overlap / 2 / h, whole = law.energy(overlap);
	std::vector<PointState> states;
	EXPECT_EQ(step({ pointOf(edge, 3 * overlap) }, states, speed), 0);
	expectOverlap(states[0], overlap / 2, 3 * overlap);
	states = { held(vertex, overlap) };
	EXPECT_NEAR(step({ pointOf(edge, 3 * overlap) }, states, speed), law.energy(overlap / 2), rounding * whole);
	expectOverlap(states[0], overlap, 3 * overlap);
	states = { held(vertex, overlap) };
	EXPECT_NEAR(step({ pointOf(edge, overlap / 4) }, states, speed), whole, rounding * whole); // the approach explains more than there is
	expectOverlap(states[0], overlap / 4, overlap / 4);
	states.clear();
	EXPECT_EQ(step({ pointOf(edge, 3 * overlap) }, states, -speed), 0); // parting bodies explain none
	expectOverlap(states[0], 0, 3 * overlap);
}

/// Bodies put where they are start with all of their overlap; others that touch all at once with none.
TEST(Handover, OnlyPlacedBodiesStartPressed)
{
	for (const bool placed : { false, true }) {
		std::vector<PointState> states;
		EXPECT_EQ(step({ pointOf(vertex, overlap), pointOf(edge, 2 * overlap) }, states, 0, placed), 0);
		for (size_t k = 0; k < 2; ++k)
			expectOverlap(states[k], placed ? double(k + 1) * overlap : 0, double(k + 1) * overlap);
	}
}

/// A light body flies against a fixed one: springs and dashpots take up what it loses, although it is stopped within a step or two.
/// Seen: up to 0.9 %, from the way out, on which a step is the whole of the spring and Hertz's law is not linear in it; 14 % before new points were booked anew.
TEST(Books, ABlowOfAStepOrTwoIsBalanced)
{
	constexpr double mass = 3, speed = 5, dt = 2.5e-4; // a brace: 34 J, stopped by 1.2 mm
	PairProperties light = pair;
	light.mass = mass;
	for (const double share : { 0.05, 0.2, 0.4, 0.6, 0.8, 0.95 }) { // of the step in which it touches
		std::vector<SolverBody> bodies(2);
		bodies[0].velocity = bodies[0].spin = bodies[1].spin = Vec3::Zero();
		bodies[0].inverseMass = 0;
		bodies[0].inverseInertia = bodies[1].inverseInertia = Mat3::Zero();
		bodies[1].inverseMass = 1 / mass;
		bodies[1].velocity = { 0, 0, -speed };
		double at = share * speed * dt, booked = 0, elastic = 0, lost = 0;
		std::vector<PointState> states;
		for (int k = 0; k < 20; ++k) {
			std::vector<ContactPoint> points;
			if (at > 0) points.push_back(pointOf(vertex, at));
			const Vec3 none = Vec3::Zero();
			lost += elasticPair(law, light, { none, none, none }, { none, bodies[1].velocity, none }, dt, NormalForm::Closed, false, points, states);
			for (SolverBody& b : bodies)
				b.newVelocity = b.velocity, b.newSpin = b.spin;
			ContactSolver solver;
			solver.clear(100);
			solver.addPair(0, 1, points.size());
			prepareContacts(solver, 0, bodies, light, 1, dt, true, points, states);
			solver.solve(bodies, 1e-12);
			PairEnergies own;
			storeForces(solver, 0, bodies, light, dt, states, &own);
			booked += own.dashpotNormal;
			elastic = own.elasticNormal + dt / 2 * own.elasticPower;
			bodies[1].velocity = bodies[1].newVelocity;
			at -= bodies[1].velocity.z() * dt;
		}
		EXPECT_TRUE(states.empty());
		const double start = mass / 2 * speed * speed, left = mass / 2 * bodies[1].velocity.squaredNorm();
		EXPECT_LT(left, start);
		EXPECT_NEAR((booked + elastic + lost + left) / start, 1, 0.01) << share;
	}
}

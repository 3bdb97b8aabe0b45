// SPDX-License-Identifier: GPL-2.0-or-later
/// Contacts with a bearing strength: its area, paths of loading, impacts and energy.
#include <array>
#include <gtest/gtest.h>
#include <kernel/contact_pair.hpp>

using namespace timber;

namespace {

const HertzLaw hertz { 5e9, 0.1 };
constexpr double mass = 3; // [kg]
constexpr double pressure = 6e6; // [Pa]
constexpr double rounding = 1e-12; ///< of a root and a few products, relative
const FeatureId vertex(FeatureKind::VertexFace, 3, 1), edge(FeatureKind::EdgeEdge, 4, 7);

std::vector<ContactPoint> pointsAt(const std::vector<Vec3>& positions)
{
	std::vector<ContactPoint> points;
	for (const Vec3& x : positions)
		points.push_back(
		        { FeatureId(FeatureKind::VertexFace, int(points.size()), 1), {}, x, Vec3::UnitZ(), 1e-4 });
	return points;
}
double areaOf(const std::vector<Vec3>& positions, double radius)
{
	return bearingStrength(pressure, radius, pointsAt(positions)).constant * double(positions.size()) / pressure;
}

/// Elastic overlap of Hertz's law at a force. [m]
double overlapAt(double force) { return std::cbrt(std::pow(force / hertz.force(1.), 2)); }

/// A point that is pressed together and released at constant velocity, without dashpot.
struct Path {
	PairProperties pair { mass, 0, 0.4, 1, 0 };
	FeatureId id = vertex;
	std::vector<PointRecord> records;
	double at = 0, released = 0;

	/// Moves to an overlap [m] in equal steps.
	void to(double overlap, int steps)
	{
		const double h = 1e-4, way = (overlap - at) / steps;
		const Vec3 none = Vec3::Zero();
		for (int k = 0; k < steps; ++k) {
			at += way;
			std::vector<ContactPoint> points;
			if (at > 0) points.push_back({ id, {}, none, Vec3::UnitZ(), at });
			released += elasticPair(hertz,
			        { pair, { none, none, none }, { none, { 0, 0, -way / h }, none }, h }, points, records);
		}
	}
	double force() const { return records.at(0).normalForce; }
	double crushed() const { return records.at(0).crushed; }
};

/// A body hits a fixed plate at one point.
class Drop {
	double h, speed, depth;
	PairProperties pair;
	std::vector<SolverBody> bodies { 2 };
	std::vector<PointRecord> records;
	double dashpot = 0, elastic = 0, released = 0; ///< [J]

public:
	double crushing = 0, least = 0, largest = 0; ///< [J], [J] of a step, force over the strength [-]

	/// share: of a step, at the end of which the surfaces touch.
	Drop(double speed_, double ratio, const BearingStrength& strength, double h_, double share)
	        : h(h_)
	        , speed(speed_)
	        , depth((share - 1) * speed * h)
	        , pair { mass, 0.5, 0.4, 1, ratio, HertzLaw::exponent, strength }
	{
		for (SolverBody& b : bodies)
			b = { Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 0, Mat3::Zero(), Vec3::Zero() };
		bodies[1].inverseMass = 1 / mass;
		bodies[1].velocity = { 0, 0, -speed };
	}
	void step(int sweeps)
	{
		const Vec3 none = Vec3::Zero();
		std::vector<ContactPoint> points;
		if (depth > 0) points.push_back({ vertex, {}, none, Vec3::UnitZ(), depth });
		released += elasticPair(
		        hertz, { pair, { none, none, none }, { none, bodies[1].velocity, none }, h }, points, records);
		for (SolverBody& b : bodies)
			b.newVelocity = b.velocity, b.newSpin = b.spin;
		ContactSolver solver;
		solver.begin(bodies, h, sweeps);
		solver.addPair(0, 1, records.size());
		prepareContacts(solver, 0, pair, points, records);
		const double strength = records.empty() ? 0 : pair.strength.force(records[0].crushed);
		solver.solve(1e-12);
		PairEnergies energies;
		const PairForce force = storeForces(solver, 0, pair, records, energies);
		if (!records.empty()) largest = std::max(largest, force.onB.z() / strength);
		crushing += energies.crushing;
		dashpot += energies.dashpotNormal;
		least = std::min({ least, energies.crushing, energies.dashpotNormal });
		elastic = energies.elasticNormal;
		bodies[1].velocity = bodies[1].newVelocity;
		depth -= bodies[1].velocity.z() * h;
	}
	/// Until it leaves.
	double restitution(int sweeps = 100)
	{
		for (int k = 0; k < 100000 && !(depth <= 0 && bodies[1].velocity.z() > 0); ++k)
			step(sweeps);
		return bodies[1].velocity.z() / speed;
	}
	double residual() const
	{
		const double kinetic = mass / 2 * (bodies[1].velocity.squaredNorm() - speed * speed);
		return (kinetic + elastic + dashpot + crushing + released) / (mass / 2 * speed * speed);
	}
};

/// Independent solution: m x'' = -min(F_Y(c), max(0, F(n) + C(n) x')), n = x - c, F(n) <= F_Y(c), in steps of a
/// fraction of the impact by the midpoint rule.
double exactRestitution(double speed, double ratio, const BearingStrength& strength)
{
	double x = 0, v = speed, c = 0;
	const double yield = overlapAt(strength.force(0.)), dt = 1e-3 * yield / speed;
	const auto force = [&](double depth, double rate) {
		const double n = std::max(0., depth - c);
		return std::min(strength.force(c),
		        std::max(0., hertz.force(n) + 2 * ratio * std::sqrt(mass * hertz.stiffness(n)) * rate));
	};
	for (int k = 0; k < 20000000; ++k) {
		const double half = v - dt / 2 / mass * force(x, v), middle = x + dt / 2 * v;
		v -= dt / mass * force(middle, half);
		x += dt * half;
		c = std::max(c, x - overlapAt(strength.force(c)));
		if (v < 0 && force(x, v) == 0) break;
	}
	return -v / speed;
}

} // namespace

/// Corners of the core of a face of 2a x 2b give the face, two points a strip of twice the radius, one a square; in any
/// order and placement. 1e-9: of positions a kilometre away.
TEST(BearingStrength, IsThatOfTheArea)
{
	const double a = 0.3, b = 0.05, r = 0.01;
	const std::vector<Vec3> face { { a - r, b - r, 0 }, { r - a, b - r, 0 }, { a - r, r - b, 0 },
		{ r - a, r - b, 0 } };
	EXPECT_NEAR(areaOf(face, r), 4 * a * b, rounding);
	EXPECT_NEAR(areaOf({ face[0], face[1] }, r), 4 * a * r, 1e-9); // root of the rounding error of the moments
	EXPECT_NEAR(areaOf({ face[0] }, r), 4 * r * r, rounding);
	const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
	std::vector<Vec3> moved;
	for (const int k : { 2, 0, 3, 1 })
		moved.push_back(turn * face[k] + Vec3(1000, -500, 20));
	EXPECT_NEAR(areaOf(moved, r), 4 * a * b, 1e-9);
	const BearingStrength one = bearingStrength(pressure, r, pointsAt({ face[0] }));
	EXPECT_NEAR(one.force(0.004), pressure * 4 * (r + 0.004) * (r + 0.004), 1e-6); // spreads
	EXPECT_FALSE(bearingStrength(std::numeric_limits<double>::infinity(), r, pointsAt(face)).isLimited());
	EXPECT_FALSE(bearingStrength(pressure, r, {}).isLimited());
}

/// Two corners under a tilted face are joined by two that begin to touch. First order in their overlap: the strip is
/// widened by 2 b phi, phi: ratio of the overlaps.
TEST(BearingStrength, IsContinuousWhenPointsBegin)
{
	const double a = 0.3, b = 0.05, r = 0.01;
	for (const double phi : { 1e-3, 1e-5, 1e-7 }) {
		std::vector<ContactPoint> points
		        = pointsAt({ { a - r, b, 0 }, { r - a, b, 0 }, { a - r, -b, 0 }, { r - a, -b, 0 } });
		points[2].overlap = points[3].overlap = phi * points[0].overlap;
		const double width = bearingStrength(pressure, r, points).constant * 2 / pressure / (4 * a) - r;
		EXPECT_NEAR(width, 2 * b * phi, 4 * b * phi * phi + 1e-9); // second order; 1e-9: as above
	}
}

/// Loading along Hertz's law up to the strength and along it from there on, in one step or many; unloading along the
/// shifted law, a gap, and reloading along it.
TEST(Crushing, FollowsThePath)
{
	for (const BearingStrength& strength : { BearingStrength { 2e4, 0, 0 }, BearingStrength { 2e4, 3e6, 1e8 } })
		for (const int steps : { 1, 7, 100 }) {
			Path p;
			p.pair.strength = strength;
			const double yield = overlapAt(2e4);
			p.to(0.9 * yield, steps + 10); // the first steps are those of a new point
			EXPECT_NEAR(p.force(), hertz.force(0.9 * yield), 1e-9 * p.force());
			EXPECT_EQ(p.crushed(), 0);
			p.to(5 * yield, steps);
			const double c = p.crushed(), n = 5 * yield - c;
			EXPECT_NEAR(p.force(), strength.force(c), 1e-9 * p.force());
			EXPECT_NEAR(p.force(), hertz.force(n), 1e-9 * p.force());
			p.to(c + n / 2, steps);
			EXPECT_NEAR(p.force(), hertz.force(n / 2), 1e-9 * p.force());
			p.to(c / 2, steps);
			EXPECT_EQ(p.force(), 0);
			p.to(c + n / 2, steps);
			EXPECT_NEAR(p.force(), hertz.force(n / 2), 1e-9 * p.force());
			p.to(c + n, steps);
			EXPECT_NEAR(p.crushed(), c, 1e-9 * c);
			p.to(0, 1); // it separates, and the next contact begins at the surface
			p.to(0.5 * yield, 20);
			EXPECT_NEAR(p.force(), hertz.force(0.5 * yield), 1e-9 * p.force());
		}
}

/// A point takes the place of another one: it takes over the dent, returns no more energy than that had, and its force
/// is at most its strength.
TEST(Crushing, PassesToTheNextPoint)
{
	Path p;
	p.pair.strength = { 2e4, 0, 0 };
	const double yield = overlapAt(2e4);
	p.to(5 * yield, 100);
	p.records[0].normalStored = hertz.energy(yield);
	const double c = p.crushed();
	p.id = edge;
	p.released = 0;
	p.to(p.at, 1);
	EXPECT_NEAR(p.crushed(), c, rounding);
	EXPECT_NEAR(p.force(), 2e4, 1e-6 * 2e4);
	EXPECT_NEAR(p.released, 0, 1e-6 * hertz.energy(yield));
	p.records[0].normalStored = hertz.energy(yield);
	p.pair.strength = { 5e3, 0, 0 };
	p.id = vertex;
	p.to(p.at, 1);
	EXPECT_NEAR(p.force(), 5e3, 1e-6 * 5e3);
	EXPECT_NEAR(p.released, hertz.energy(yield) - hertz.energy(overlapAt(5e3)), 1e-6 * hertz.energy(yield));
}

/// A point that begins beside a crushed one, on surfaces that do not approach, is in the dent: it has no force, and its
/// strength is that of the dent.
TEST(Crushing, HoldsForPointsThatBeginBesideADent)
{
	Path p;
	p.pair.strength = { 2e4, 3e6, 1e8 };
	p.to(5 * overlapAt(2e4), 100);
	const double c = p.crushed(), overlap = 0.9 * c;
	const Vec3 none = Vec3::Zero();
	elasticPair(hertz, { p.pair, { none, none, none }, { none, none, none }, 1e-4 },
	        { { vertex, {}, none, Vec3::UnitZ(), p.at }, { edge, {}, none, Vec3::UnitZ(), overlap } }, p.records);
	EXPECT_EQ(p.crushed(), c);
	EXPECT_EQ(p.records.at(1).crushed, overlap);
	EXPECT_EQ(p.records.at(1).unloadedOverlap, 0);
	EXPECT_EQ(p.records.at(1).normalForce, 0);
}

/// Velocity of separation at the strength against the independent solution, from elastic impacts to those of ten times
/// the velocity at which crushing begins. 2e-3: of the quadrature.
TEST(Crushing, RestitutionIsThatOfTheEquationOfMotion)
{
	const BearingStrength strength { 2e4, 0, 0 };
	const double limit = std::sqrt(2 / mass * hertz.energy(overlapAt(2e4)));
	for (const double ratio : { 0., 0.3, 1. })
		for (const double speed : { 0.5, 1.1, 1.4, 1.8, 2.5, 10. }) {
			double rest;
			const double exact = exactRestitution(speed * limit, ratio, strength);
			const double found = reboundAtStrength(ratio * std::sqrt(1.2), 1.5, speed, rest) / speed;
			EXPECT_NEAR(found, exact, 2e-3) << ratio << " " << speed;
			EXPECT_EQ(rest > 0, found * speed > 0.999 * std::sqrt(restitution(ratio * std::sqrt(1.2))));
		}
}

/// Impacts in any phase of a step, shorter and longer than it: the restitution of the equation of motion, with a
/// strength that is constant or grows, to 0.0112 of the speed observed. Without a dashpot the steps decide how much energy the spring stores: never
/// faster. The force never exceeds the strength, no dissipation is negative, the energy balance closes to rounding.
TEST(Crushing, ImpactsAreExactAtAnyStep)
{
	for (const BearingStrength& strength : { BearingStrength { 2e4, 0, 0 }, BearingStrength { 2e4, 3e6, 1e8 } })
		for (const double ratio : { 0., 0.3, 1. })
			for (const double speed : { 0.3, 1., 3., 10. }) {
				const double exact = exactRestitution(speed, ratio, strength);
				for (const double h : { 5e-4, 2e-4, 1e-4 })
					for (const double share : { 0.05, 0.3, 0.6, 0.95 }) {
						Drop drop(speed, ratio, strength, h, share);
						const double found = drop.restitution();
						EXPECT_LE(found, exact + 0.012) << ratio << " " << speed << " " << h;
						if (ratio > 0)
							EXPECT_GE(found, exact - 0.012)
							        << ratio << " " << speed << " " << h << " " << share;
						EXPECT_LE(drop.largest, 1 + rounding);
						EXPECT_GE(drop.least, -rounding * mass * speed * speed);
						EXPECT_NEAR(drop.residual(), 0, rounding);
					}
			}
}

/// Small steps, also of explicit dashpots: the order of the step.
TEST(Crushing, ConvergesToTheEquationOfMotion)
{
	for (const int sweeps : { 0, 100 })
		for (const double ratio : { 0., 0.3, 1. }) {
			const BearingStrength strength { 2e4, 3e6, 1e8 };
			const double exact = exactRestitution(3, ratio, strength);
			Drop drop(3, ratio, strength, 1e-6, 0.5);
			EXPECT_NEAR(drop.restitution(sweeps), exact, 2e-3) << sweeps << " " << ratio;
			EXPECT_LE(drop.largest, 1 + rounding);
		}
}

/// A crushed point whose surfaces have parted is idle: the step is that of the other point alone, to the last bit.
TEST(Crushing, LeavesOutIdlePoints)
{
	const Vec3 none = Vec3::Zero();
	const double h = 1e-4;
	PairProperties pair { mass, 0.5, 0.4, 1, 0.1 };
	pair.strength = { 1e3, 1e5, 0 };
	const auto step = [&](const std::vector<ContactPoint>& points, std::vector<PointRecord>& records) {
		elasticPair(
		        hertz, { pair, { none, none, none }, { none, { 0.01, 0, -0.01 }, none }, h }, points, records);
		std::vector<SolverBody> bodies(2, { none, none, none, none, 0, Mat3::Zero(), none });
		bodies[1] = { none, none, { 0.01, 0, -0.01 }, { 0, 0.1, 0 }, 1 / mass, Mat3::Identity(), none };
		ContactSolver solver;
		solver.begin(bodies, h, 100);
		solver.addPair(0, 1, records.size());
		prepareContacts(solver, 0, pair, points, records);
		solver.solve(1e-12);
		PairEnergies energies;
		const PairForce force = storeForces(solver, 0, pair, records, energies);
		return std::array<double, 5> { bodies[1].newVelocity.x(), bodies[1].newVelocity.z(),
			bodies[1].newSpin.y(), force.torqueB.y(),
			energies.elasticNormal + energies.dashpotNormal + energies.friction };
	};
	const auto at = [&](FeatureId id, double x, double overlap) {
		return ContactPoint { id, {}, { x, 0, 0 }, Vec3::UnitZ(), overlap };
	};
	std::vector<PointRecord> records;
	for (int k = 1; k <= 20; ++k)
		step({ at(vertex, 0, k * 1e-4), at(edge, 0.1, k * 1e-4) }, records);
	const double dent = records[0].crushed;
	ASSERT_GT(dent, 1e-3);
	const std::vector<ContactPoint> parted { at(vertex, 0, dent / 2), at(edge, 0.1, 2e-3) };
	step(parted, records);
	ASSERT_FALSE(records[1].isIdle());
	std::vector<PointRecord> alone { records[1] };
	for (int k = 0; k < 5; ++k) {
		const auto both = step(parted, records), one = step({ parted[1] }, alone);
		EXPECT_TRUE(records[0].isIdle());
		EXPECT_EQ(both, one);
		EXPECT_EQ(records[0].crushed, dent);
	}
	step({ at(vertex, 0, dent + 1e-5), at(edge, 0.1, 2e-3) }, records);
	EXPECT_FALSE(records[0].isIdle());
}

// SPDX-License-Identifier: GPL-2.0-or-later
/// SIMD against scalar code: bitwise identical results, whatever the other lanes contain.
#include "heap.hpp"
#include <gtest/gtest.h>
#include <kernel/geometry.hpp>
#include <kernel/joint_law.hpp>
#include <kernel/contact_pair.hpp>
#include <kernel/rotation.hpp>

using namespace timber;
using namespace timber::shapes;

namespace {

const PairProperties properties { 3, 0.4, 1 / 2.8, 4e-3 };

/// A moving pair with points of all kinds: growing and shrinking overlaps, short and deep, loaded and free, at rest and
/// sliding.
struct MovingPair {
	std::vector<SolverBody> bodies;
	std::vector<ContactPoint> points;
	std::vector<PointRecord> records;

	MovingPair(unsigned seed, size_t count)
	{
		Random random(seed);
		const double speed = seed % 3 == 0 ? 0 : 0.5;
		for (const double mass : { 2., seed % 4 == 0 ? 0. : 5. }) {
			bodies.push_back(body(mass, mass > 0 ? randomVector(random, speed) : Vec3(Vec3::Zero())));
			bodies.back().spin = bodies.back().newSpin
			        = mass > 0 ? randomVector(random, speed) : Vec3(Vec3::Zero());
			bodies.back().newVelocity += mass > 0 ? randomVector(random, 0.1) : Vec3(Vec3::Zero());
		}
		for (SolverBody& b : bodies)
			b.position = randomVector(random, 1);
		for (size_t k = 0; k < count; ++k) {
			points.push_back({ { FeatureKind::VertexFace, int(k), 0 }, {}, randomVector(random, 1),
			        randomDirection(random), std::pow(10, uniform(random, -9, -2)) });
			PointRecord s;
			s.id = points[k].id;
			s.unloadedOverlap = k % 3 == 0 ? uniform(random, 0, 1) * points[k].overlap : 0;
			s.overlap = std::pow(10, uniform(random, -9, -2.4));
			s.stiffness = k % 5 == 4 ? 0 : law.stiffness(s.overlap);
			s.normalForce = law.force(s.overlap);
			s.shearForce = k % 4 == 3
			        ? Vec3(Vec3::Zero())
			        : Vec3(uniform(random, 0, 1) * s.normalForce * points[k].normal.unitOrthogonal());
			s.dashpotForce = randomVector(random, 0.1 * s.normalForce);
			s.normalStored = uniform(random, 0, 1) * law.energy(s.overlap);
			s.shearStored = uniform(random, 0, 1) * s.shearForce.norm() * s.overlap;
			s.impact = ImpactState::over();
			records.push_back(s);
		}
	}
	BodyKinematics kinematics(size_t k) const { return { bodies[k].position, bodies[k].velocity, bodies[k].spin }; }
	ElasticInput step(NormalForm form = NormalForm::Closed) const
	{
		return { properties, kinematics(0), kinematics(1), h, form };
	}

	static constexpr double h = 2e-4;
	const HertzLaw law { 5.25e9, 0.05 };
};

void expectSame(const PointRecord& a, const PointRecord& b)
{
	EXPECT_EQ(a.unloadedOverlap, b.unloadedOverlap);
	EXPECT_EQ(a.overlap, b.overlap);
	EXPECT_EQ(a.stiffness, b.stiffness);
	EXPECT_EQ(a.normalForce, b.normalForce);
	EXPECT_EQ(a.energy, b.energy);
	EXPECT_EQ(a.shearForce, b.shearForce);
	EXPECT_EQ(a.dashpotForce, b.dashpotForce);
	EXPECT_EQ(a.normalStored, b.normalStored);
	EXPECT_EQ(a.shearStored, b.shearStored);
}

} // namespace

/// Elastic forces: all points of a pair by SIMD, and each by the scalar formula.
TEST(LanesOfAPair, ElasticForcesAreThoseOfEachPoint)
{
	for (const NormalForm form : { NormalForm::Closed, NormalForm::Increment })
		for (unsigned seed = 0; seed < 60; ++seed) {
			MovingPair pair(seed, 1 + seed % 11);
			std::vector<PointRecord> each = pair.records;
			EXPECT_EQ(elasticPair(pair.law, pair.step(form), pair.points, pair.records), 0);
			for (size_t k = 0; k < each.size(); ++k) {
				MovingPair alone(seed, 1 + seed % 11);
				alone.points = { pair.points[k] };
				alone.records = { each[k] };
				elasticPair(pair.law, pair.step(form), alone.points, alone.records);
				expectSame(alone.records[0], pair.records[k]);
				const Vec3 armA = pair.points[k].position - pair.bodies[0].position,
				           armB = pair.points[k].position - pair.bodies[1].position;
				const auto velocity = [&](const SolverBody& b, const Vec3& arm) {
					return Vec3(b.velocity + b.spin.cross(arm - pair.h / 2 * b.spin.cross(arm)));
				};
				const RelativeMotion<double> motion { velocity(pair.bodies[1], armB)
					        - velocity(pair.bodies[0], armA),
					(pair.bodies[0].spin + pair.bodies[1].spin) / 2 };
				elasticStep<HertzLaw, ContactPoint, double>(
				        pair.law, properties, pair.points[k], motion, pair.h, form, each[k]);
				expectSame(each[k], pair.records[k]);
			}
		}
}

/// Points prepared by SIMD and one by one.
TEST(LanesOfAPair, StepsAreThoseOfEachPoint)
{
	for (const int sweeps : { 0, 50 })
		for (unsigned seed = 0; seed < 60; ++seed) {
			MovingPair p(seed, 1 + seed % 11);
			ContactSolver together, alone;
			together.begin(p.bodies, p.h, sweeps);
			together.addPair(0, 1, p.records.size());
			alone.begin(p.bodies, p.h, sweeps);
			alone.addPair(0, 1, p.records.size());
			prepareContacts(together, 0, properties, p.points, p.records);
			for (size_t k = 0; k < p.points.size(); ++k) {
				const PointRecord& s = p.records[k];
				const double damping = 2 * std::sqrt(properties.mass * s.stiffness);
				StepInput<double> one;
				one.armA = p.points[k].position - p.bodies[0].position;
				one.armB = p.points[k].position - p.bodies[1].position;
				one.normal = p.points[k].normal;
				one.elasticNormal = s.normalForce;
				one.elasticShear = s.shearForce;
				one.normalDamping = damping;
				one.shearDamping = damping * std::sqrt(properties.shearRatio);
				one.friction = properties.friction;
				one.impulse = p.h * (s.normalForce * one.normal + s.shearForce + s.dashpotForce);
				one.normalStiffness = s.stiffness;
				one.shearStiffness = properties.shearRatio * s.stiffness;
				one.energy = s.normalStored;
				one.shearEnergy = s.shearStored;
				alone.prepare<double>(0, k, one);
				const PointStep &u = together.stepsOf(together.pair(0))[k],
				                &v = alone.stepsOf(alone.pair(0))[k];
				using S = PointStep;
				for (const auto member : { &S::armA, &S::armB })
					EXPECT_EQ(u.*member, v.*member) << seed;
				for (int c = 0; c < 3; ++c)
					EXPECT_EQ(u.axes[c], v.axes[c]) << seed;
				for (int c = 0; c < 4; ++c) {
					for (int row = 0; row < 3; ++row)
						for (int part = 0; part < 3; ++part)
							EXPECT_EQ(u.rows[row].part[part][c], v.rows[row].part[part][c]);
					for (const auto quad : { &S::before, &S::velocity, &S::impulse, &S::factor,
					             &S::bias, &S::mass, &S::column, &S::shearResponse })
						EXPECT_EQ((u.*quad)[c], (v.*quad)[c]) << seed;
				}
				for (const auto member :
				        { &S::friction, &S::energy, &S::shearEnergy, &S::damping, &S::step })
					EXPECT_EQ(u.*member, v.*member) << seed;
			}
		}
}

/// Total forces and energies against sums over the points, written out.
TEST(LanesOfAPair, ForcesAndEnergiesAreSumsOverThePoints)
{
	for (unsigned seed = 0; seed < 60; ++seed) {
		MovingPair p(seed, 1 + seed % 11);
		elasticPair(p.law, p.step(), p.points, p.records);
		const std::vector<PointRecord> before = p.records;
		ContactSolver solver;
		solver.begin(p.bodies, p.h, 50);
		solver.addPair(0, 1, p.records.size());
		prepareContacts(solver, 0, properties, p.points, p.records);
		solver.solve();
		PairEnergies energies { 1, 2, 3, 4, 5 }, sums = energies; // of other pairs, before
		const PairForce force = storeForces(solver, 0, properties, p.records, energies);
		Vec3 sum = Vec3::Zero(), torqueA = sum, torqueB = sum;
		for (size_t k = 0; k < p.points.size(); ++k) {
			const PointRecord& s = p.records[k];
			const PointStep& c = solver.stepsOf(solver.pair(0))[k];
			const Vec3 impulse = worldImpulse(c), f = impulse / p.h, &normal = c.axes[0],
			           after = relativeVelocity<double>(c.armA, c.armB, p.bodies[0].newVelocity,
			                   p.bodies[0].newSpin, p.bodies[1].newVelocity, p.bodies[1].newSpin);
			sum += impulse;
			torqueA -= c.armA.cross(impulse);
			torqueB += c.armB.cross(impulse);
			EXPECT_LE(s.shearForce.norm(), properties.friction * f.dot(normal) * (1 + rounding) + rounding);
			EXPECT_EQ(s.dashpotForce, Vec3(f - s.normalForce * normal - s.shearForce));
			const Vec3 mean = (after
			                          + relativeVelocity<double>(c.armA, c.armB, p.bodies[0].velocity,
			                                  p.bodies[0].spin, p.bodies[1].velocity, p.bodies[1].spin))
			        / 2;
			const double pn = impulse.dot(normal), way = -p.h / 2 * after.dot(normal),
			             ks = properties.shearRatio * s.stiffness;
			const double law = way > -s.overlap
			        ? s.energy + p.law.energy(s.overlap + way) - p.law.energy(s.overlap)
			        : 0;
			const double available = before[k].normalStored - pn * mean.dot(normal);
			// A contact with an overlap of rounding size does not harden within a step: its spring has at
			// most the law's energy.
			const bool isDefined = s.overlap > roundingOverlap;
			if (!isDefined) {
				EXPECT_LE(
				        s.normalStored, std::min(available, law) + 1e-12 * (std::abs(available) + law))
				        << seed;
			}
			const double stored = isDefined ? std::min(available, law) : s.normalStored;
			const bool slides = (impulse - pn * normal).norm() >= properties.friction * pn * (1 - 1e-9);
			const Vec3 spring = slides
			        ? s.shearForce
			        : Vec3(s.shearForce - ks * p.h / 2 * (after - after.dot(normal) * normal));
			const double shearLaw = s.stiffness > 0 ? spring.squaredNorm() / (2 * ks) : 0,
			             shearAvailable = before[k].shearStored - (impulse - pn * normal).dot(mean),
			             shearStored = std::min(shearAvailable, shearLaw);
			sums.dashpotNormal += available - stored;
			(slides ? sums.friction : sums.dashpotShear) += shearAvailable - shearStored;
			sums.elasticNormal += stored;
			sums.elasticShear += shearStored;
			// Small differences of large terms: relative to the terms.
			const double normalTerms = before[k].normalStored + std::abs(pn * mean.dot(normal)) + s.energy
			        + p.law.energy(s.overlap),
			             shearTerms
			        = before[k].shearStored + std::abs((impulse - pn * normal).dot(mean)) + shearLaw;
			EXPECT_NEAR(s.normalStored, stored, 1e-12 * normalTerms) << seed;
			EXPECT_NEAR(s.shearStored, shearStored, 1e-12 * shearTerms) << seed;
		}
		EXPECT_EQ(force.onB, Vec3(sum / p.h));
		EXPECT_EQ(force.torqueA, Vec3(torqueA / p.h));
		EXPECT_EQ(force.torqueB, Vec3(torqueB / p.h));
		for (const auto member : { &PairEnergies::dashpotNormal, &PairEnergies::dashpotShear,
		             &PairEnergies::friction, &PairEnergies::elasticNormal, &PairEnergies::elasticShear })
			EXPECT_NEAR(energies.*member, sums.*member,
			        // Other orders of some products
			        1e-11 * (1 + std::abs(energies.elasticNormal) + std::abs(energies.*member)));
	}
}

/// Impulses by rows of mass-weighted velocities, and by masses and inertias.
TEST(LanesOfAPair, ImpulsesActAsOneByOne)
{
	for (size_t count = 1; count <= 9; ++count) {
		MovingPair p(unsigned(count), count);
		std::vector<SolverBody> each = p.bodies;
		ContactSolver solver;
		solver.begin(p.bodies, p.h, 0);
		solver.addPair(0, 1, count);
		prepareContacts(solver, 0, properties, p.points, p.records);
		solver.solve();
		for (size_t k = 0; k < p.records.size(); ++k) {
			const PointStep& c = solver.stepsOf(solver.pair(0))[k];
			for (const int body : { 0, 1 }) {
				SolverBody& b = each[size_t(body)];
				if (b.inverseMass == 0) continue;
				const Vec3 impulse = body == 0 ? Vec3(-worldImpulse(c)) : worldImpulse(c),
				           arm = body == 0 ? c.armA : c.armB;
				b.newVelocity += b.inverseMass * impulse;
				b.newSpin += b.inverseInertia * arm.cross(impulse);
			}
		}
		for (const size_t body : { 0, 1 }) {
			EXPECT_LT((p.bodies[body].newVelocity - each[body].newVelocity).norm(),
			        rounding * (1 + each[body].newVelocity.norm()))
			        << count;
			EXPECT_LT((p.bodies[body].newSpin - each[body].newSpin).norm(),
			        rounding * (1 + each[body].newSpin.norm()))
			        << count;
		}
	}
}

/// A point whose forces overflow does not affect its neighbours: no NaN or infinity leaks from lane to lane.
TEST(LanesOfAPair, OverflowStaysInItsLane)
{
	MovingPair good(7, 4), bad(7, 4);
	bad.points[2].position = Vec3::Constant(1e307);
	for (MovingPair* p : { &good, &bad })
		elasticPair(p->law, p->step(), p->points, p->records);
	EXPECT_FALSE(bad.records[2].shearForce.allFinite());
	for (const size_t k : { 0, 1, 3 })
		expectSame(good.records[k], bad.records[k]);
}

TEST(LanesOfAJoint, PullIsTheSumOverTheSprings)
{
	Random random(3);
	for (size_t count = 1; count <= 9; ++count)
		for (const JointStiffness k : { JointStiffness { 58800, 58800 }, JointStiffness { 5e4, 2e4 } }) {
			const Mat3 axesA = randomRotation(random).toRotationMatrix(),
			           axesB = randomRotation(random).toRotationMatrix();
			const Vec3 apart = randomVector(random, 1), normal = randomDirection(random);
			std::vector<Vec3> anchorsA(count), anchorsB(count);
			std::vector<int> broken(count);
			for (size_t i = 0; i < count; ++i) {
				anchorsA[i] = randomVector(random, 1);
				anchorsB[i]
				        = axesB.transpose() * (axesA * anchorsA[i] - apart + randomVector(random, 0.1));
				broken[i] = i % 3 == 1;
			}
			std::vector<SpringLanes> groups(groupsOf(count));
			const JointSprings springs { groups.data(), count };
			springs.assign(anchorsA, anchorsB, broken);
			for (size_t i = 0; i < count; ++i)
				springs.set(i, Vec3::Ones(), Vec3::Ones());
			JointForce total;
			springForces(k, { axesA, axesB, apart }, normal, springs, total);
			JointForce wanted;
			for (size_t i = 0; i < count; ++i) {
				const Vec3 armB = axesB * anchorsB[i], stretch = apart + armB - axesA * anchorsA[i];
				const SpringForce<double> f = springForce<double>(k, stretch, axesA * normal);
				EXPECT_EQ(springs.stretch(i), broken[i] ? Vec3(Vec3::Zero()) : stretch);
				EXPECT_EQ(springs.force(i), broken[i] ? Vec3(Vec3::Zero()) : f.force);
				if (broken[i]) continue;
				wanted.force += f.force;
				wanted.torqueA += (apart + armB).cross(f.force);
				wanted.torqueB -= armB.cross(f.force);
				wanted.energy += f.energy;
				wanted.sum += f.force.norm();
				wanted.largestSquared = std::max(wanted.largestSquared, f.force.squaredNorm());
			}
			EXPECT_EQ(total.force, wanted.force);
			EXPECT_EQ(total.torqueA, wanted.torqueA);
			EXPECT_EQ(total.torqueB, wanted.torqueB);
			EXPECT_EQ(total.energy, wanted.energy);
			EXPECT_EQ(total.sum, wanted.sum);
			EXPECT_EQ(total.largestSquared, wanted.largestSquared);
		}
}

/// Bodies of all shapes: slow ones beside fast ones, for which the series do not apply.
TEST(LanesOfBodies, FreeRotationIsThatOfEachBody)
{
	Random random(6);
	for (int trial = 0; trial < 2000; ++trial) {
		std::vector<Vec3> momenta(laneCount), inertias(laneCount);
		std::vector<Eigen::Vector4d> orientations(laneCount);
		for (int i = 0; i < laneCount; ++i) {
			inertias[i] = 2 * Vec3::Ones() + randomVector(random, 1.9);
			momenta[i] = randomVector(random, std::pow(10, uniform(random, -3, 3)));
			orientations[i] = randomRotation(random).coeffs();
		}
		const double h = 1e-3;
		QuatOf<Lanes> turned(Group<Lanes, const Eigen::Vector4d>(orientations.data(), laneCount).vectors());
		const Vec3s spin
		        = freeRotation<Lanes>(turned, Group<Lanes, const Vec3>(momenta.data(), laneCount).vectors(),
		                Group<Lanes, const Vec3>(inertias.data(), laneCount).vectors(), h);
		for (int i = 0; i < laneCount; ++i) {
			Quat one(orientations[i]);
			EXPECT_EQ(lane(spin, i), freeRotation<double>(one, momenta[i], inertias[i], h)) << trial;
			EXPECT_NE(one.coeffs(), orientations[i]);
			for (int c = 0; c < 4; ++c)
				EXPECT_EQ(lane(turned.coeffs()[c], i), one.coeffs()[c]) << trial;
		}
	}
}

/// Points in and around a face, also beyond a sharp tip.
TEST(LanesOfAFace, OverAndInsideAreThoseOfEachPoint)
{
	Random random(4);
	const Polyhedron wedge = Polyhedron::fromVertices(
	        { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0.1, 0 }, { 0, 0, 0.3 }, { 1, 0, 0.3 }, { 1, 0.1, 0.3 } });
	for (int trial = 0; trial < 2000; ++trial) {
		std::vector<Vec3> points(laneCount);
		for (Vec3& x : points)
			x = Vec3(0.5, 0.05, 0.15) + randomVector(random, 0.7);
		const Group<Lanes, const Vec3> group(points.data(), points.size());
		const double limit = uniform(random, -0.05, 0.05);
		for (int f = 0; f < int(wedge.faces.size()); ++f) {
			const Lanes::Mask over = projectsOntoFace(wedge.faces[f], group.vectors(), Lanes(limit)),
			                  inside = isInsideOtherFaces(wedge, f, group.vectors(), Lanes(limit));
			for (int i = 0; i < laneCount; ++i) {
				EXPECT_EQ(over[i] != 0, projectsOntoFace<double>(wedge.faces[f], points[i], limit));
				EXPECT_EQ(inside[i] != 0, isInsideOtherFaces<double>(wedge, f, points[i], limit));
			}
		}
	}
}

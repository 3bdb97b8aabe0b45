// SPDX-License-Identifier: GPL-2.0-or-later
/// Contact impulses with dashpots: closed forms of single pairs, a dense solution of many coupled points, balances of
/// momentum and energy, limits.
#include "shapes.hpp"
#include <Eigen/Dense>
#include <algorithm>
#include <gtest/gtest.h>
#include <kernel/dashpots.hpp>

using namespace timber;
using namespace timber::shapes;

namespace {

/// One impulse is some ten products: relative rounding.
constexpr double rounding = 1e-13;

DashpotBody body(double mass, const Vec3& velocity)
{
	const double inertia = 0.1 * mass; // of a sphere of about 0.5 m
	return { velocity, Vec3::Zero(), velocity, Vec3::Zero(), mass > 0 ? 1 / mass : 0, mass > 0 ? Mat3(Mat3::Identity() / inertia) : Mat3(Mat3::Zero()) };
}

/// A point between bodies 0 and 1 on the line through their centres; the normal is z.
DashpotPoint central(double damping, double elastic = 0)
{
	DashpotPoint p {};
	p.bodyB = 1;
	p.armA = p.armB = p.elasticShear = p.impulse = Vec3::Zero();
	p.normal = Vec3::UnitZ();
	p.elasticNormal = elastic;
	p.normalDamping = p.shearDamping = damping;
	p.friction = 0.5;
	return p;
}

/// Relative normal velocity after the step of a pair that closes with speed v and feels only its dashpot.
double after(double massA, double massB, double speed, double damping, double h, int sweeps)
{
	std::vector<DashpotBody> bodies { body(massA, Vec3::Zero()), body(massB, { 0, 0, -speed }) };
	std::vector<DashpotPoint> points { central(damping) };
	solveDashpots(bodies, points, h, sweeps);
	return (bodies[1].newVelocity - bodies[0].newVelocity).z();
}

double kineticEnergy(const std::vector<DashpotBody>& bodies)
{
	double energy = 0;
	for (const auto& b : bodies)
		if (b.inverseMass > 0) energy += 0.5 * b.newVelocity.squaredNorm() / b.inverseMass + 0.5 * b.newSpin.dot(b.inverseInertia.inverse() * b.newSpin);
	return energy;
}

/// Some bodies (the first one fixed) and many points between random pairs of them.
struct Heap {
	std::vector<DashpotBody> bodies;
	std::vector<DashpotPoint> points;

	Heap(unsigned seed, int bodyCount, int pointCount, double damping, double friction, double elastic = 0)
	{
		Random random(seed);
		for (int k = 0; k < bodyCount; ++k)
			add(random, k == 0);
		for (int k = 0; k < pointCount; ++k) {
			const int a = int(uniform(random, 0, bodyCount - 1e-9)), b = (a + 1 + int(uniform(random, 0, bodyCount - 1 - 1e-9))) % bodyCount;
			add(random, a, b, damping, friction, elastic);
		}
	}
	void solve(double h, int sweeps) { solveDashpots(bodies, points, h, sweeps); }

private:
	void add(Random& random, bool fixed)
	{
		const double mass = std::pow(10, uniform(random, -1, 2));
		const Mat3 axes = randomRotation(random).toRotationMatrix();
		const Vec3 moments = mass * Vec3(uniform(random, 0.01, 0.1), uniform(random, 0.1, 0.2), uniform(random, 0.1, 0.2));
		DashpotBody b = body(fixed ? 0 : mass, fixed ? Vec3(Vec3::Zero()) : randomVector(random, 1));
		b.spin = b.newSpin = fixed ? Vec3(Vec3::Zero()) : randomVector(random, 3);
		if (!fixed) b.inverseInertia = axes * moments.cwiseInverse().asDiagonal() * axes.transpose();
		bodies.push_back(b);
	}
	void add(Random& random, int a, int b, double damping, double friction, double elastic)
	{
		DashpotPoint p = central(damping * std::pow(10, uniform(random, -1, 1)), elastic * uniform(random, 0.5, 1));
		p.bodyA = a;
		p.bodyB = b;
		p.armA = randomVector(random, 0.5);
		p.armB = randomVector(random, 0.5);
		p.normal = randomDirection(random);
		p.friction = friction;
		p.shearDamping = 0.6 * p.normalDamping;
		if (elastic > 0) p.elasticShear = uniform(random, 0, 0.5 * elastic) * p.normal.unitOrthogonal();
		points.push_back(p);
	}
};

struct Momentum {
	Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

} // namespace

/// One step of a single dashpot multiplies the relative velocity by the (1, 2) Pade approximant of exp(-x),
/// (1 - x/3) / (1 + 2x/3 + x^2/6), x = h C / m.
TEST(SinglePair, DecaysByThePadeApproximant)
{
	for (const double x : { 1e-3, 0.1, 1., 3., 10., 100., 1e4 })
		for (const double otherMass : { 2., 1e6, 0. }) {
			const double m = otherMass > 0 ? 1 / (1 / 3. + 1 / otherMass) : 3, h = 1e-4;
			const double expected = -2 * (1 - x / 3) / (1 + 2 * x / 3 + x * x / 6);
			EXPECT_NEAR(after(otherMass, 3, 2, x * m / h, h, 1), expected, 2 * rounding * std::max(1., x)) << x; // x amplifies rounding once
			EXPECT_NEAR(after(otherMass, 3, 2, x * m / h, h, 5), expected, 2 * rounding * std::max(1., x)) << x; // more sweeps, same answer
		}
}

TEST(SinglePair, SecondOrderInTheStep)
{
	const double damping = 50, time = 0.02;
	double before = 1;
	for (const int steps : { 4, 8, 16 }) {
		double v = 2;
		for (int k = 0; k < steps; ++k)
			v = -after(0, 1, v, damping, time / steps, 2);
		const double error = std::abs(v / (2 * std::exp(-damping * time)) - 1);
		EXPECT_LT(error, before / 4);
		before = error;
	}
	EXPECT_LT(before, 1e-5);
}

TEST(SinglePair, ElasticAndOtherForcesWork)
{
	const double h = 1e-3, c = 800, e = 3000, m = 1.2; // masses 2 and 3 kg
	std::vector<DashpotBody> bodies { body(2, { 0, 0, 0.5 }), body(3, { 0, 0, -1 }) };
	bodies[0].newVelocity.z() = 0.4;
	bodies[1].newVelocity.z() = -1.3;
	std::vector<DashpotPoint> points { central(c, e) };
	solveDashpots(bodies, points, h, 1);
	const double x = h * c / m, theta = 0.5 + x / (12 + 2 * x);
	const double impulse = (h * e - h * c * ((1 - theta) * -1.5 + theta * -1.7)) / (1 + theta * x);
	EXPECT_NEAR(points[0].impulse.z(), impulse, 10 * rounding); // impulses of some N s
	EXPECT_NEAR(bodies[0].newVelocity.z(), 0.4 - impulse / 2, 10 * rounding);
	EXPECT_NEAR(bodies[1].newVelocity.z(), -1.3 + impulse / 3, 10 * rounding);
}

/// Eqs. 17, 18, 23, 24 with the velocity before the step.
TEST(SinglePair, NoSweepsIsTheExplicitDashpot)
{
	const double h = 1e-5, cn = 700, cs = 300;
	std::vector<DashpotBody> bodies { body(2, { 0.1, 0, 0.5 }), body(3, { 0, 0.2, -1 }) };
	DashpotPoint p = central(cn, 900);
	p.shearDamping = cs;
	p.elasticShear = { 40, -10, 0 };
	p.friction = 0.9;
	p.impulse = { 1, 2, 3 }; // a guess plays no part
	std::vector<DashpotPoint> points { p };
	solveDashpots(bodies, points, h, 0);
	const Vec3 force(40 - cs * -0.1, -10 - cs * 0.2, 900 + cn * 1.5);
	EXPECT_LT((points[0].impulse - h * force).norm(), rounding * h * force.norm());
	EXPECT_LT((bodies[0].newVelocity - Vec3(0.1, 0, 0.5) + h * force / 2).norm(), rounding);
	EXPECT_LT((bodies[1].newVelocity - Vec3(0, 0.2, -1) - h * force / 3).norm(), rounding);
}

TEST(SinglePair, LeverArms)
{
	std::vector<DashpotBody> bodies { body(0, Vec3::Zero()), body(3, { 0, 0, -2 }) };
	DashpotPoint p = central(500);
	p.armB = { 0.4, 0, 0 };
	p.friction = 0;
	std::vector<DashpotPoint> points { p };
	const double h = 1e-3, m = 1 / (1 / 3. + 0.16 / 0.3), x = h * 500 / m; // effective mass of the point
	solveDashpots(bodies, points, h, 1);
	const double speed = bodies[1].newVelocity.z() - 0.4 * bodies[1].newSpin.y();
	EXPECT_NEAR(speed, -2 * (1 - x / 3) / (1 + 2 * x / 3 + x * x / 6), 10 * rounding);
	EXPECT_NEAR(bodies[1].newSpin.y(), -0.4 * points[0].impulse.z() / 0.3, 10 * rounding);
}

TEST(Limits, NoTension)
{
	for (const int sweeps : { 0, 1, 4 }) {
		std::vector<DashpotBody> bodies { body(1, Vec3::Zero()), body(1, { 0, 0, 5 }) };
		std::vector<DashpotPoint> points { central(1e4, 10) };
		solveDashpots(bodies, points, 1e-4, sweeps);
		EXPECT_EQ(points[0].impulse, Vec3::Zero());
		EXPECT_EQ(bodies[1].newVelocity, Vec3(0, 0, 5));
	}
}

/// e_s beyond the limit: the tangential impulse is mu times the normal one along e_s, whatever the dashpot says.
TEST(Limits, SlidingHasNoDashpot)
{
	for (const int sweeps : { 0, 1, 4 }) {
		std::vector<DashpotBody> bodies { body(1, Vec3::Zero()), body(1, { 0.3, 0.4, 0 }) };
		DashpotPoint p = central(20, 100);
		p.elasticShear = { 80, 0, 0 };
		std::vector<DashpotPoint> points { p };
		solveDashpots(bodies, points, 1e-4, sweeps);
		const double normal = points[0].impulse.z();
		EXPECT_NEAR(normal, 1e-2, 1e-4); // the normal dashpot answers to the push of the spring: x / 2 = 0.2 %
		EXPECT_LT((points[0].impulse - normal * Vec3(0.5, 0, 1)).norm(), rounding);
	}
}

TEST(Limits, SpringAndDashpotTogetherRespectCoulomb)
{
	for (const int sweeps : { 0, 1, 4 }) {
		std::vector<DashpotBody> bodies { body(1, Vec3::Zero()), body(1, { -3, 4, 0 }) };
		DashpotPoint p = central(200, 100);
		p.elasticShear = { 10, 0, 0 };
		std::vector<DashpotPoint> points { p };
		solveDashpots(bodies, points, 1e-4, sweeps);
		EXPECT_NEAR(points[0].impulse.head<2>().norm(), 0.5 * points[0].impulse.z(), rounding);
		EXPECT_GT(points[0].impulse.x(), 0); // against the slide
		EXPECT_LT(points[0].impulse.y(), 0);
	}
	EXPECT_EQ(limitedShear({ 3, 4, 0 }, 0.5, 20), Vec3(3, 4, 0));
	EXPECT_LT((limitedShear({ 3, 4, 0 }, 0.5, 5) - Vec3(1.5, 2, 0)).norm(), rounding);
	EXPECT_EQ(limitedShear({ 3, 4, 0 }, 0.5, 0), Vec3::Zero());
}

TEST(Limits, HoldInHeaps)
{
	for (unsigned seed = 0; seed < 50; ++seed)
		for (const int sweeps : { 0, 1, 2, 5 }) {
			Heap heap(seed, 6, 15, 1e3, 0.4, 2000);
			heap.solve(1e-4, sweeps);
			for (const auto& p : heap.points) {
				const double normal = p.impulse.dot(p.normal), shear = (p.impulse - normal * p.normal).norm();
				EXPECT_GE(normal, -rounding); // rounding of the projection
				EXPECT_LE(shear, 0.4 * normal + rounding);
			}
		}
}

TEST(ZeroDamping, GivesTheElasticImpulses)
{
	for (const int sweeps : { 0, 1, 3 }) {
		Heap heap(1, 5, 12, 0, 1, 1000);
		for (auto& p : heap.points)
			if (sweeps > 0) p.impulse = Vec3(1, 2, 3) * 1e-2; // any guess
		const Heap start = heap;
		heap.solve(1e-4, sweeps);
		for (size_t k = 0; k < heap.points.size(); ++k) {
			const DashpotPoint& p = start.points[k];
			const Vec3 elastic = 1e-4 * (p.elasticNormal * p.normal + p.elasticShear);
			EXPECT_LT((heap.points[k].impulse - elastic).norm(), rounding); // impulses of 0.1 N s
		}
	}
}

/// Sum of m v and of I w + x cross m v over free bodies: place the bodies so that each point's arms meet.
TEST(Balance, MomentumIsConserved)
{
	Random random(61);
	for (const int sweeps : { 0, 1, 2, 5 }) {
		Heap heap(2, 6, 12, 1e3, 0.5, 500);
		heap.bodies[0] = body(7, { 1, 2, 3 });
		std::vector<Vec3> places;
		for (size_t k = 0; k < heap.bodies.size(); ++k)
			places.push_back(randomVector(random, 2));
		for (auto& p : heap.points)
			p.armB = places[p.bodyA] + p.armA - places[p.bodyB];
		const auto sum = [&] {
			Momentum total;
			for (size_t k = 0; k < places.size(); ++k) {
				const DashpotBody& b = heap.bodies[k];
				total.linear += b.newVelocity / b.inverseMass;
				total.angular += b.inverseInertia.inverse() * b.newSpin + places[k].cross(b.newVelocity / b.inverseMass);
			}
			return total;
		};
		const Momentum start = sum();
		heap.solve(1e-4, sweeps);
		const Momentum end = sum();
		EXPECT_LT((end.linear - start.linear).norm(), 1e-11); // rounding of momenta of some 100 N s
		EXPECT_LT((end.angular - start.angular).norm(), 1e-11);
	}
}

/// Pure dashpots take energy from any motion, from the first sweep on.
TEST(Balance, DashpotsNeverAddEnergy)
{
	for (unsigned seed = 0; seed < 200; ++seed)
		for (int sweeps = 1; sweeps <= 8; ++sweeps)
			for (const double damping : { 10., 1e3, 1e6 }) {
				Heap heap(seed, 3 + seed % 5, 4 + seed % 17, damping, seed % 3 ? 0.5 : 0);
				const double before = kineticEnergy(heap.bodies);
				heap.solve(1e-4, sweeps);
				EXPECT_LE(kineticEnergy(heap.bodies), before * (1 + rounding)) << "seed " << seed << " sweeps " << sweeps << " damping " << damping;
			}
}

namespace {

/// Unknown: all impulses p, stacked. p = h e - h C ((1 - theta) v_before + theta v_after), v_after = v_free + A p, with
/// theta of each point and direction from its own response (normal; largest tangential eigenvalue).
Eigen::VectorXd denseSolution(const Heap& heap, double h)
{
	const int count = int(heap.points.size());
	Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(3 * count, 6 * int(heap.bodies.size())), inverseMass = Eigen::MatrixXd::Zero(jacobian.cols(), jacobian.cols());
	const auto cross = [](const Vec3& r) { return (Mat3() << Vec3::UnitX().cross(r), Vec3::UnitY().cross(r), Vec3::UnitZ().cross(r)).finished(); }; // w -> w x r
	Eigen::VectorXd before(jacobian.cols()), free(jacobian.cols());
	for (size_t k = 0; k < heap.bodies.size(); ++k) {
		const DashpotBody& b = heap.bodies[k];
		inverseMass.block<3, 3>(6 * k, 6 * k) = b.inverseMass * Mat3::Identity();
		inverseMass.block<3, 3>(6 * k + 3, 6 * k + 3) = b.inverseInertia;
		before.segment<6>(6 * k) << b.velocity, b.spin;
		free.segment<6>(6 * k) << b.newVelocity, b.newSpin;
	}
	for (int k = 0; k < count; ++k) {
		const DashpotPoint& p = heap.points[k];
		jacobian.block<3, 3>(3 * k, 6 * p.bodyA) -= Mat3::Identity();
		jacobian.block<3, 3>(3 * k, 6 * p.bodyA + 3) -= cross(p.armA);
		jacobian.block<3, 3>(3 * k, 6 * p.bodyB) += Mat3::Identity();
		jacobian.block<3, 3>(3 * k, 6 * p.bodyB + 3) += cross(p.armB);
	}
	const Eigen::MatrixXd response = jacobian * inverseMass * jacobian.transpose();
	Eigen::MatrixXd damping = Eigen::MatrixXd::Zero(3 * count, 3 * count), theta = damping;
	Eigen::VectorXd elastic(3 * count);
	for (int k = 0; k < count; ++k) {
		const DashpotPoint& p = heap.points[k];
		const Mat3 along = p.normal * p.normal.transpose(), across = Mat3::Identity() - along, own = response.block<3, 3>(3 * k, 3 * k);
		const double largest = Eigen::SelfAdjointEigenSolver<Mat3>(across * own * across).eigenvalues().maxCoeff();
		const auto weight = [](double x) { return 0.5 + x / (12 + 2 * x); };
		damping.block<3, 3>(3 * k, 3 * k) = p.normalDamping * along + p.shearDamping * across;
		theta.block<3, 3>(3 * k, 3 * k) = weight(h * p.normalDamping * p.normal.dot(own * p.normal)) * along + weight(h * p.shearDamping * largest) * across;
		elastic.segment<3>(3 * k) = p.elasticNormal * p.normal + p.elasticShear;
	}
	const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(3 * count, 3 * count);
	const Eigen::VectorXd right = h * elastic - h * damping * ((one - theta) * jacobian * before + theta * jacobian * free);
	return (one + h * damping * theta * response).partialPivLu().solve(right);
}

/// Largest difference of the impulses from the dense solution, relative to the largest impulse.
double errorOf(Heap heap, const Eigen::VectorXd& dense, double h, int sweeps)
{
	heap.solve(h, sweeps);
	double error = 0;
	for (size_t k = 0; k < heap.points.size(); ++k)
		error = std::max(error, (heap.points[k].impulse - dense.segment<3>(3 * k)).norm());
	return error / dense.lpNorm<Eigen::Infinity>();
}

} // namespace

/// Sticking points under pressure: the sweeps converge to the solution of the coupled equations, if it has no tension.
TEST(Coupled, ConvergesToTheDenseSolution)
{
	const double h = 1e-4;
	for (const double damping : { 10., 1e3, 1e5 }) {
		int compared = 0;
		for (unsigned seed = 0; seed < 200 && compared < 10; ++seed) {
			Heap heap(seed, 6, damping > 1e4 ? 3 : 10, damping, 1e9, 0);
			for (auto& p : heap.points)
				p.elasticNormal = 100 * damping;
			const Eigen::VectorXd dense = denseSolution(heap, h);
			bool pressed = true;
			for (size_t k = 0; k < heap.points.size(); ++k)
				pressed = pressed && dense.segment<3>(3 * k).dot(heap.points[k].normal) > 0;
			if (!pressed) continue;
			++compared;
			EXPECT_LT(errorOf(heap, dense, h, 3000), 1e-6) << damping << " " << seed; // linear convergence of the sweeps
			EXPECT_LT(errorOf(heap, dense, h, 3000), 0.01 * errorOf(heap, dense, h, 2) + 1e-12) << damping << " " << seed;
		}
		EXPECT_EQ(compared, 10) << damping;
	}
}

/// A foot with four points, as every column has: a few sweeps are enough.
TEST(Coupled, FaceWithFourPointsNeedsFewSweeps)
{
	Heap heap(3, 2, 0, 0, 0);
	heap.bodies[1] = body(10, { 0.01, 0, -0.1 });
	heap.bodies[1].inverseInertia = Vec3(1 / 6.2, 1 / 6.2, 1 / 0.02).asDiagonal();
	for (const double x : { -0.04, 0.04 })
		for (const double y : { -0.04, 0.04 }) {
			heap.points.push_back(central(2e4, 1e6));
			heap.points.back().armB = { x, y, -1.36 };
			heap.points.back().friction = 1e9;
		}
	const Eigen::VectorXd dense = denseSolution(heap, 1e-4);
	EXPECT_LT(errorOf(heap, dense, 1e-4, 60), 1e-4); // linear convergence of the sweeps
}

/// h C / m = 1e4 on every point, hundreds of steps, without and with the last step's impulses as a guess.
TEST(Stiff, HeapComesToRest)
{
	for (const bool warm : { false, true })
		for (unsigned seed = 0; seed < 5; ++seed) {
			Heap heap(seed, 5, 12, 1e8, 0.5);
			double before = kineticEnergy(heap.bodies);
			const double start = before;
			for (int step = 0; step < 300; ++step) {
				for (auto& p : heap.points)
					if (!warm) p.impulse.setZero();
				heap.solve(1e-4, 4);
				for (auto& b : heap.bodies) {
					b.velocity = b.newVelocity;
					b.spin = b.newSpin;
				}
				const double now = kineticEnergy(heap.bodies);
				ASSERT_TRUE(std::isfinite(now));
				EXPECT_LE(now, (warm ? start : before) * (1 + rounding)) << seed;
				before = now;
			}
			EXPECT_LT(before, 0.9 * start) << seed;
		}
}

TEST(Stiff, MassRatioOfAMillion)
{
	for (const double light : { 1e-3, 1. }) {
		const double heavy = 1e6 * light, v = after(heavy, light, 1, 1e4 * light / 1e-4, 1e-4, 4);
		EXPECT_NEAR(v, 0, 1e-3); // 2 / x of the speed is left, x = 1e4
	}
	std::vector<DashpotBody> bodies { body(0, Vec3::Zero()), body(1e-3, { 0, 0, -1 }), body(1e3, { 0, 0, -1 }) };
	std::vector<DashpotPoint> points { central(1e7), central(1e7) }; // the heavy one falls on the light one on the ground
	points[1].bodyA = 1;
	points[1].bodyB = 2;
	const double before = kineticEnergy(bodies);
	solveDashpots(bodies, points, 1e-4, 8);
	EXPECT_LE(kineticEnergy(bodies), before * (1 + rounding));
	for (const auto& b : bodies)
		EXPECT_LE(std::abs(b.newVelocity.z()), 1.5);
}

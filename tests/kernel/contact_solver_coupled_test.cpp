// SPDX-License-Identifier: GPL-2.0-or-later
/// Coupled contact points on shared bodies: balances of momentum and energy, comparison with a dense solution.
#include "heap.hpp"
#include <Eigen/Dense>
#include <gtest/gtest.h>

using namespace timber;
using namespace timber::shapes;

namespace {

struct Momentum {
	Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

} // namespace

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
				const SolverBody& b = heap.bodies[k];
				total.linear += b.newVelocity / b.inverseMass;
				total.angular += b.inverseInertia.inverse() * b.newSpin
				        + places[k].cross(b.newVelocity / b.inverseMass);
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
				EXPECT_LE(kineticEnergy(heap.bodies), before * (1 + rounding))
				        << "seed " << seed << " sweeps " << sweeps << " damping " << damping;
			}
}

namespace {

/// Unknown: all impulses p, stacked. p = h e - h C ((1 - theta) v_before + theta v_after), v_after = v_free + A p, with
/// theta of each point and direction from its own response (normal; largest tangential eigenvalue).
Eigen::VectorXd denseSolution(const Heap& heap, double h)
{
	const int count = int(heap.points.size());
	Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(3 * count, 6 * int(heap.bodies.size())),
	                inverseMass = Eigen::MatrixXd::Zero(jacobian.cols(), jacobian.cols());
	const auto cross
	        // W -> w x r
	        = [](const Vec3& r) {
		          return (Mat3() << Vec3::UnitX().cross(r), Vec3::UnitY().cross(r), Vec3::UnitZ().cross(r))
		                  .finished();
	          };
	Eigen::VectorXd before(jacobian.cols()), free(jacobian.cols());
	for (size_t k = 0; k < heap.bodies.size(); ++k) {
		const SolverBody& b = heap.bodies[k];
		inverseMass.block<3, 3>(6 * k, 6 * k) = b.inverseMass * Mat3::Identity();
		inverseMass.block<3, 3>(6 * k + 3, 6 * k + 3) = b.inverseInertia;
		before.segment<6>(6 * k) << b.velocity, b.spin;
		free.segment<6>(6 * k) << b.newVelocity, b.newSpin;
	}
	for (int k = 0; k < count; ++k) {
		const HeapPoint& p = heap.points[k];
		jacobian.block<3, 3>(3 * k, 6 * p.bodyA) -= Mat3::Identity();
		jacobian.block<3, 3>(3 * k, 6 * p.bodyA + 3) -= cross(p.armA);
		jacobian.block<3, 3>(3 * k, 6 * p.bodyB) += Mat3::Identity();
		jacobian.block<3, 3>(3 * k, 6 * p.bodyB + 3) += cross(p.armB);
	}
	const Eigen::MatrixXd response = jacobian * inverseMass * jacobian.transpose();
	Eigen::MatrixXd damping = Eigen::MatrixXd::Zero(3 * count, 3 * count), theta = damping;
	Eigen::VectorXd elastic(3 * count);
	for (int k = 0; k < count; ++k) {
		const HeapPoint& p = heap.points[k];
		const Mat3 along = p.normal * p.normal.transpose(), across = Mat3::Identity() - along,
		           diagonalBlock = response.block<3, 3>(3 * k, 3 * k);
		const double largest
		        = Eigen::SelfAdjointEigenSolver<Mat3>(across * diagonalBlock * across).eigenvalues().maxCoeff();
		const auto weight = [](double x) { return 0.5 + x / (12 + 2 * x); };
		damping.block<3, 3>(3 * k, 3 * k) = p.normalDamping * along + p.shearDamping * across;
		theta.block<3, 3>(3 * k, 3 * k)
		        = weight(h * p.normalDamping * p.normal.dot(diagonalBlock * p.normal)) * along
		        + weight(h * p.shearDamping * largest) * across;
		elastic.segment<3>(3 * k) = p.elasticNormal * p.normal + p.elasticShear;
	}
	const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(3 * count, 3 * count);
	const Eigen::VectorXd right
	        = h * elastic - h * damping * ((one - theta) * jacobian * before + theta * jacobian * free);
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
			// A compressive initial guess: unlimited friction has a second solution, in which a point
			// separates
			for (auto& p : heap.points) {
				p.elasticNormal = 100 * damping;
				p.impulse = h * p.elasticNormal * p.normal;
			}
			const Eigen::VectorXd dense = denseSolution(heap, h);
			bool pressed = true;
			for (size_t k = 0; k < heap.points.size(); ++k)
				pressed = pressed && dense.segment<3>(3 * k).dot(heap.points[k].normal) > 0;
			if (!pressed) continue;
			++compared;
			EXPECT_LT(errorOf(heap, dense, h, 3000), 1e-6)
			        << damping << " " << seed; // linear convergence of the sweeps
			EXPECT_LT(errorOf(heap, dense, h, 3000), 0.01 * errorOf(heap, dense, h, 2) + 1e-12)
			        << damping << " " << seed;
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

/// A long beam lands on one of its lower edges: the normal impulse also rotates it, so that the edge slips. The
/// tangential impulse cancels this slip in the same visit (coupling).
TEST(Coupled, TangentialImpulseCancelsTheSlipOfTheNormalOne)
{
	const double mass = 20, side = 0.12, length = 4;
	std::vector<SolverBody> bodies { body(0, Vec3::Zero()), body(mass, { 0, 0, -1 }) };
	bodies[1].inverseInertia
	        = Vec3(12 / (mass * length * length), 6 / (mass * side * side), 12 / (mass * length * length))
	                  .asDiagonal();
	HeapPoint p = central(1e8);
	p.armB = { side / 2, 0, -side / 2 };
	p.friction = 1e9;
	std::vector<HeapPoint> points { p };
	EXPECT_LE(solveContacts(bodies, points, 1e-4, 1000, 1e-9), 30); // observed 22; 42 without coupling
	// Of the response (2.5, 1.5; 1.5, 2.5) / mass; 2 / x of the speed remains
	EXPECT_LT((points[0].impulse - mass * Vec3(-0.375, 0, 0.625)).norm(), 1e-2);
}

/// Pairs are visited in the same order in all sweeps: an impulse at the first body of a row crosses the whole row in
/// one sweep, and the next sweep begins at the first pair again.
TEST(Coupled, PairsAreVisitedInTheSameOrder)
{
	const int last = 5;
	std::vector<SolverBody> row { body(1, { 0, 0, 1 }) };
	std::vector<HeapPoint> points;
	for (int k = 1; k <= last; ++k) {
		row.push_back(body(1, Vec3::Zero()));
		points.push_back(central(1e10));
		points.back().bodyA = k - 1;
		points.back().bodyB = k;
	}
	const auto after = [&](int sweeps) {
		std::vector<SolverBody> bodies = row;
		std::vector<HeapPoint> fresh = points;
		solveContacts(bodies, fresh, 1e-4, sweeps);
		return bodies;
	};
	const std::vector<SolverBody> one = after(1);
	// Two bodies in contact get their mean velocity: half of the impulse is transmitted
	for (int k = 0; k < last; ++k)
		// 2 / x = 4e-6 of a relative velocity remains
		EXPECT_NEAR(one[k].newVelocity.z(), std::pow(0.5, k + 1), 1e-5) << k;
	EXPECT_NEAR(one[last].newVelocity.z(), one[last - 1].newVelocity.z(), 1e-5);
	// 0.334 if the second sweep were in reverse order
	EXPECT_NEAR(after(2)[0].newVelocity.z(), (0.5 + 0.25) / 2, 1e-5);
}

/// The order of a pair's points alternates, so that no side of a face is favoured: after the second sweep the first
/// point's equation is satisfied, not the last one's.
TEST(Coupled, OrderOfPointsAlternates)
{
	std::vector<SolverBody> bodies { body(0, Vec3::Zero()), body(1, { 0, 0, -1 }) };
	std::vector<HeapPoint> points(2, central(1e10));
	points[0].armB.x() = -0.5;
	points[1].armB.x() = 0.5;
	solveContacts(bodies, points, 1e-4, 2);
	const auto speed
	        = [&](const HeapPoint& p) { return bodies[1].newVelocity.z() - bodies[1].newSpin.y() * p.armB.x(); };
	// Of the responses (3.5, -1.5; -1.5, 3.5): effect of one point's impulse on the other
	const double other = -1.5 / 3.5;
	EXPECT_NEAR(speed(points[0]), 0, 1e-5); // 2 / x = 6e-7 of the speed remains
	EXPECT_NEAR(speed(points[1]), other * other * (other - 1), 1e-5);
}

/// Two heaps on the same fixed body, solved together and separately: bitwise identical, although one needs more sweeps.
TEST(Islands, DoNotInfluenceEachOther)
{
	for (unsigned seed = 0; seed < 20; ++seed) {
		Heap one(seed, 5, 8, 1e2, 0.5, 10), other(seed + 100, 4, 12, 1e6, 0.3, 1e3);
		Heap both = one;
		const int shift = int(one.bodies.size()) - 1; // body 0 is the ground of both
		both.bodies.insert(both.bodies.end(), other.bodies.begin() + 1, other.bodies.end());
		for (size_t k = 0; k < other.points.size(); ++k) {
			HeapPoint p = other.points[k];
			for (int* body : { &p.bodyA, &p.bodyB })
				if (*body > 0) *body += shift;
			both.points.insert(both.points.begin() + long(k), p);
		}
		both.bodies[0] = other.bodies[0] = one.bodies[0];
		for (Heap* heap : { &one, &other, &both })
			solveContacts(heap->bodies, heap->points, 1e-4, 100, 1e-6);
		for (size_t k = 1; k < both.bodies.size(); ++k) {
			const SolverBody& alone = int(k) <= shift ? one.bodies[k] : other.bodies[k - size_t(shift)];
			EXPECT_EQ(both.bodies[k].newVelocity, alone.newVelocity) << seed;
			EXPECT_EQ(both.bodies[k].newSpin, alone.newSpin) << seed;
		}
	}
}

/// The warm start of a contact that has just become stiff may be 1e4 times the impulse of the step. The threshold of
/// the sweeps follows the impulses; that of the first sweep alone would end them with errors of this size.
TEST(Coupled, ALargeWarmStartDoesNotEndTheSweeps)
{
	for (unsigned seed = 0; seed < 40; ++seed) {
		Heap heap(seed, 5, 12, 1e3, 0.5, 500), pushed = heap;
		for (HeapPoint& p : pushed.points)
			p.impulse = 1e4 * 1e-4 * p.elasticNormal * p.normal;
		solveContacts(heap.bodies, heap.points, 1e-4, 20000, 1e-9);
		solveContacts(pushed.bodies, pushed.points, 1e-4, 20000, 1e-3);
		double largest = 0, error = 0;
		for (size_t k = 0; k < heap.points.size(); ++k) {
			largest = std::max(largest, heap.points[k].impulse.norm());
			error = std::max(error, (heap.points[k].impulse - pushed.points[k].impulse).norm());
		}
		// Tolerance 1e-3 of the rms, times the number of coupled points
		EXPECT_LT(error, 0.05 * largest) << seed;
	}
}

/// A reused solver against a new one: points begin and end, pairs lose all points, bodies are fixed and freed.
TEST(Islands, DependOnThePresentStepOnly)
{
	size_t most = 0, least = 100;
	for (unsigned seed = 0; seed < 40; ++seed) {
		Random random(seed);
		const Heap heap(seed, 12, 16, 200, 0.5, 50);
		ContactSolver reused;
		Islands reusedIslands;
		for (int step = 0; step < 12; ++step) {
			std::vector<HeapPoint> points;
			for (const HeapPoint& p : heap.points)
				if (step % 3 == 2 || uniform(random, 0, 1) < 0.7) points.push_back(p);
			std::vector<SolverBody> bodies = heap.bodies, fresh;
			for (SolverBody& b : bodies)
				if (uniform(random, 0, 1) < 0.3) b.inverseMass = 0, b.inverseInertia.setZero();
			fresh = bodies;
			std::vector<HeapPoint> same = points;
			ContactSolver once;
			Islands islands;
			const size_t before = reusedIslands.count();
			EXPECT_EQ(solveContacts(reused, reusedIslands, bodies, points, 1e-3, 30, 1e-6),
			        solveContacts(once, islands, fresh, same, 1e-3, 30, 1e-6))
			        << seed;
			ASSERT_EQ(reusedIslands.count(), islands.count()) << seed << " after " << before;
			for (size_t k = 0; k < islands.count(); ++k)
				ASSERT_TRUE(std::equal(reusedIslands[k].begin(), reusedIslands[k].end(),
				        islands[k].begin(), islands[k].end()))
				        << seed;
			for (size_t k = 0; k < bodies.size(); ++k) {
				EXPECT_EQ(bodies[k].newVelocity, fresh[k].newVelocity) << seed;
				EXPECT_EQ(bodies[k].newSpin, fresh[k].newSpin) << seed;
			}
			most = std::max(most, islands.count());
			least = std::min(least, islands.count());
		}
	}
	EXPECT_GT(most, least + 3);
}

/// A pair of fixed bodies is an island, too: its forces are limited and its energies counted. Pairs without contact
/// points are in none.
TEST(Islands, PairsOfFixedBodiesAreIslands)
{
	Islands islands;
	for (const Link& link : { noLink, Link(~0, ~1), noLink, Link(~1, ~0) }) {
		islands.find(2, { link });
		EXPECT_EQ(islands.count(), link == noLink ? 0u : 1u);
	}
	islands.find(4, { { 3, ~0 }, { ~0, ~1 }, noLink, { ~1, 3 }, { 2, ~0 } });
	ASSERT_EQ(islands.count(), 3u);
	EXPECT_EQ(std::vector<int>(islands[0].begin(), islands[0].end()), (std::vector<int> { 0, 3 }));
	EXPECT_EQ(std::vector<int>(islands[1].begin(), islands[1].end()), std::vector<int> { 1 });
	EXPECT_EQ(std::vector<int>(islands[2].begin(), islands[2].end()), std::vector<int> { 4 });
}

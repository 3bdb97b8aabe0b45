// SPDX-License-Identifier: GPL-2.0-or-later
/// Pairs and heaps of bodies with contact points, for the tests of the contact solver. SI units.
#pragma once
#include "shapes.hpp"
#include <algorithm>
#include <kernel/contact_solver.hpp>
#include <kernel/islands.hpp>

namespace timber::shapes {

/// One impulse is some ten products: relative rounding.
constexpr double rounding = 1e-13;

inline SolverBody body(double mass, const Vec3& velocity)
{
	const double inertia = 0.1 * mass; // of a sphere of about 0.5 m
	return { velocity, Vec3::Zero(), velocity, Vec3::Zero(), mass > 0 ? 1 / mass : 0,
		mass > 0 ? Mat3(Mat3::Identity() / inertia) : Mat3(Mat3::Zero()) };
}

struct HeapPoint : StepInput<double> {
	int bodyA = 0, bodyB = 0; ///< indices of the bodies
};

/// A point between bodies 0 and 1 on the line through their centres; the normal is z.
inline HeapPoint central(double damping, double elastic = 0)
{
	HeapPoint p;
	p.bodyB = 1;
	p.armA = p.armB = p.elasticShear = p.impulse = Vec3::Zero();
	p.normal = Vec3::UnitZ();
	p.elasticNormal = elastic;
	p.normalDamping = p.shearDamping = damping;
	p.friction = 0.5;
	return p;
}

/// Impulse of a point on B, world frame. [N s]
inline Vec3 worldImpulse(const PointStep& p)
{
	return p.impulse[0] * p.axes[0] + p.impulse[1] * p.axes[1] + p.impulse[2] * p.axes[2];
}

/// One step of points sorted by pairs, by a solver and islands that may have been used before. Returns the number of
/// sweeps of the island that took most.
inline int solveContacts(ContactSolver& solver, Islands& islands, std::vector<SolverBody>& bodies,
        std::vector<HeapPoint>& points, double h, int sweeps, double tolerance = 0)
{
	using Place = std::vector<HeapPoint>::iterator;
	std::vector<std::pair<Place, Place>> pairs; // points of each
	std::vector<Link> links;
	const auto linked = [&](int body) { return bodies[size_t(body)].inverseMass > 0 ? body : ~body; };
	for (Place p = points.begin(); p != points.end(); p = pairs.back().second) {
		pairs.emplace_back(p, std::find_if_not(p, points.end(), [&](const HeapPoint& q) {
			return p->bodyA == q.bodyA && p->bodyB == q.bodyB;
		}));
		links.emplace_back(linked(p->bodyA), linked(p->bodyB));
	}
	islands.find(bodies.size(), links);
	int maxSweeps = 0;
	for (size_t island = 0; island < islands.count(); ++island) {
		solver.begin(bodies, h, sweeps);
		for (const int pair : islands[island]) {
			const auto [first, last] = pairs[size_t(pair)];
			const size_t k = solver.addPair(first->bodyA, first->bodyB, size_t(last - first));
			for (Place p = first; p != last; ++p)
				solver.prepare<double>(k, size_t(p - first), *p);
		}
		maxSweeps = std::max(maxSweeps, solver.solve(tolerance).sweeps);
		for (size_t k = 0; k < islands[island].size(); ++k) {
			const PointStep* step = solver.stepsOf(solver.pair(k));
			const auto [first, last] = pairs[size_t(*(islands[island].begin() + std::ptrdiff_t(k)))];
			for (Place p = first; p != last; ++p)
				p->impulse = worldImpulse(*step++);
		}
	}
	return maxSweeps;
}
inline int solveContacts(
        std::vector<SolverBody>& bodies, std::vector<HeapPoint>& points, double h, int sweeps, double tolerance = 0)
{
	ContactSolver solver;
	Islands islands;
	return solveContacts(solver, islands, bodies, points, h, sweeps, tolerance);
}

/// Relative normal velocity after the step of a pair that closes with speed v and feels only its dashpot.
inline double after(double massA, double massB, double speed, double damping, double h, int sweeps)
{
	std::vector<SolverBody> bodies { body(massA, Vec3::Zero()), body(massB, { 0, 0, -speed }) };
	std::vector<HeapPoint> points { central(damping) };
	solveContacts(bodies, points, h, sweeps);
	return (bodies[1].newVelocity - bodies[0].newVelocity).z();
}

inline double kineticEnergy(const std::vector<SolverBody>& bodies)
{
	double energy = 0;
	for (const auto& b : bodies)
		if (b.inverseMass > 0)
			energy += 0.5 * b.newVelocity.squaredNorm() / b.inverseMass
			        + 0.5 * b.newSpin.dot(b.inverseInertia.inverse() * b.newSpin);
	return energy;
}

/// Some bodies (the first one fixed) and many points between random pairs of them.
struct Heap {
	std::vector<SolverBody> bodies;
	std::vector<HeapPoint> points;

	Heap(unsigned seed, int bodyCount, int pointCount, double damping, double friction, double elastic = 0)
	{
		Random random(seed);
		for (int k = 0; k < bodyCount; ++k)
			add(random, k == 0);
		for (int k = 0; k < pointCount; ++k) {
			const int a = int(uniform(random, 0, bodyCount - 1e-9)),
			          b = (a + 1 + int(uniform(random, 0, bodyCount - 1 - 1e-9))) % bodyCount;
			add(random, a, b, damping, friction, elastic);
		}
	}
	void solve(double h, int sweeps) { solveContacts(bodies, points, h, sweeps); }

private:
	void add(Random& random, bool fixed)
	{
		const double mass = std::pow(10, uniform(random, -1, 2));
		const Mat3 axes = randomRotation(random).toRotationMatrix();
		const Vec3 moments
		        = mass * Vec3(uniform(random, 0.01, 0.1), uniform(random, 0.1, 0.2), uniform(random, 0.1, 0.2));
		SolverBody b = body(fixed ? 0 : mass, fixed ? Vec3(Vec3::Zero()) : randomVector(random, 1));
		b.spin = b.newSpin = fixed ? Vec3(Vec3::Zero()) : randomVector(random, 3);
		if (!fixed) b.inverseInertia = axes * moments.cwiseInverse().asDiagonal() * axes.transpose();
		bodies.push_back(b);
	}
	void add(Random& random, int a, int b, double damping, double friction, double elastic)
	{
		HeapPoint p
		        = central(damping * std::pow(10, uniform(random, -1, 1)), elastic * uniform(random, 0.5, 1));
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

} // namespace timber::shapes

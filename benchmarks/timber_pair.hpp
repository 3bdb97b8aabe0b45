// SPDX-License-Identifier: GPL-2.0-or-later
/// One pair as a step of the package handles it: manifold, elastic law, dashpots, limits.
#pragma once
#include "configurations.hpp"
#include <kernel/contact_pair.hpp>

namespace timber::bench {

class TimberPair {
	RoundedPolyhedron a, b;
	Pose poseA, poseB;
	Vec3 place;
	const Vec3 still = Vec3::Zero();
	CandidateCache cache;
	std::vector<ContactPoint> points;
	std::vector<PointRecord> records;
	std::vector<SolverBody> bodies;
	ContactSolver solver;
	HertzLaw law { 0, 0.1 }; ///< such that the points carry the body
	PairProperties properties;
	static constexpr double h = 1e-4, gravity = 9.81;
	long passes = 0, steps = 0;

	void damped()
	{
		bodies[0].position = poseA.position;
		bodies[1].position = poseB.position;
		bodies[1].newVelocity = bodies[1].velocity - h * gravity * wanted.normal;
		bodies[1].newSpin = bodies[1].spin;
		solver.begin(50);
		solver.addPair(0, 1, points.size());
		prepareContacts({ solver, bodies, h }, 0, properties, false, points, records);
		passes += solver.solve(bodies, 1e-3);
		++steps;
		storeForces({ solver, bodies, h }, 0, properties, records, nullptr);
	}

public:
	const Configuration& wanted;

	explicit TimberPair(const Configuration& c)
	        : a(shapes::rounded(c.a))
	        , b(shapes::rounded(c.b))
	        , wanted(c)
	{
		poseA.orientation = c.turnA;
		poseB.orientation = c.turnB;
		place = placeOfB(c, a.core.vertices, b.core.vertices, a.radius + b.radius);
		const MassProperties m = massProperties(b.sharp);
		bodies.assign(2, SolverBody { Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 0, Mat3::Zero() });
		bodies[1].inverseMass = 1 / (340 * m.volume);
		bodies[1].inverseInertia = (340 * m.inertia).inverse();
		properties = { 2 * 340 * m.volume, 0.5, 1 / 2.8, a.radius + b.radius };
		if (c.points > 0) law.modulus = gravity * 340 * m.volume / (c.points * HertzLaw { 1, law.radius }.force(c.overlap));
		geometry(0);
	}
	/// Passes of the dashpot solver per step.
	double passesPerStep() const { return steps > 0 ? double(passes) / double(steps) : 0; }
	void forget() { cache = {}; }
	/// Only the contact points of step k.
	void geometry(int k)
	{
		poseB.position = place + trembling(k);
		updateManifold(a, b, poseA, poseB, {}, cache, points);
	}
	void step(int k)
	{
		geometry(k);
		if (points.empty()) return;
		const BodyKinematics a { poseA.position, still, still }, b { poseB.position, still, still };
		elasticPair(law, { properties, a, b, h, NormalForm::Closed, steps == 0 }, points, records);
		damped();
	}
	Found found()
	{
		Found f;
		poseB.position = place;
		updateManifold(a, b, poseA, poseB, {}, cache, points);
		for (const ContactPoint& p : points)
			f.add(wanted, p.normal, p.overlap);
		return f;
	}
};

} // namespace timber::bench

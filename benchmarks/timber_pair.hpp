// SPDX-License-Identifier: GPL-2.0-or-later
/// A pair in this kernel, as in one step of the package: manifold, elastic law, contact solver.
#pragma once
#include "configurations.hpp"
#include <kernel/contact_pair.hpp>

namespace timber::bench {

class TimberPair {
	RoundedPolyhedron a, b;
	Pose poseA, poseB;
	Vec3 position; ///< of B [m]
	CandidateCache cache;
	std::vector<ContactPoint> points;
	std::vector<PointRecord> records;
	std::vector<SolverBody> bodies;
	ContactSolver solver;
	HertzLaw law { 0, 0.1 }; ///< with a modulus for which the elastic forces carry the weight of B
	PairProperties properties;
	static constexpr double h = 1e-4, gravity = 9.81, density = 340;
	long sweeps = 0, steps = 0;

	void solve()
	{
		bodies[0].position = poseA.position;
		bodies[1].position = poseB.position;
		bodies[1].newVelocity = bodies[1].velocity - h * gravity * configuration.normal;
		bodies[1].newSpin = bodies[1].spin;
		solver.begin(bodies, h, 500);
		solver.addPair(0, 1, records.size());
		prepareContacts(solver, 0, properties, points, records);
		sweeps += solver.solve(3e-3).sweeps;
		++steps;
		PairEnergies energies;
		storeForces(solver, 0, properties, records, energies);
	}

public:
	const Configuration& configuration;

	explicit TimberPair(const Configuration& c)
	        : a(shapes::rounded(c.a))
	        , b(shapes::rounded(c.b))
	        , configuration(c)
	{
		poseA.orientation = c.rotationA;
		poseB.orientation = c.rotationB;
		position = positionOfB(c, a.core.vertices, b.core.vertices, a.radius + b.radius);
		const MassProperties m = massProperties(b.sharp);
		bodies.assign(
		        2, SolverBody { Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 0, Mat3::Zero() });
		bodies[1].inverseMass = 1 / (density * m.volume);
		bodies[1].inverseInertia = (density * m.inertia).inverse();
		properties = { 2 * density * m.volume, 0.5, 1 / 2.8, a.radius + b.radius };
		if (c.points > 0)
			law.modulus = gravity * density * m.volume
			        / (c.points * HertzLaw { 1, law.radius }.force(c.overlap));
		updatePoints(0);
	}
	double sweepsPerStep() const { return steps > 0 ? double(sweeps) / double(steps) : 0; }
	/// Empties the cache.
	void reset() { cache = {}; }
	/// Contact points of step k.
	void updatePoints(int k)
	{
		poseB.position = position + vibration(k);
		updateManifold(a, b, poseA, poseB, {}, cache, points);
	}
	void step(int k)
	{
		updatePoints(k);
		if (points.empty()) return;
		const Vec3 zero = Vec3::Zero();
		const bool placedInContact = steps == 0;
		elasticPair(law,
		        { properties, { poseA.position, zero, zero }, { poseB.position, zero, zero }, h,
		                NormalForm::Closed, placedInContact },
		        points, records);
		solve();
	}
	Found found()
	{
		Found f;
		poseB.position = position;
		updateManifold(a, b, poseA, poseB, {}, cache, points);
		for (const ContactPoint& p : points)
			f.add(configuration, p.normal, p.overlap);
		return f;
	}
};

} // namespace timber::bench

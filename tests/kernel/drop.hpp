// SPDX-License-Identifier: GPL-2.0-or-later
/// A body that falls on a plate under a contact law, step by step with the kernel.
#pragma once
#include <algorithm>
#include <kernel/contact_pair.hpp>
#include <vector>

namespace timber::impacts {

constexpr double mass = 3; // [kg]
constexpr double speed = 1; // [m/s]

template <class Law> PowerSpring springOf(const Law& law, double overlap = 1e-5)
{
	return { overlap, law.force(overlap), law.stiffness(overlap) };
}
inline double kinetic(double v) { return mass / 2 * v * v; }

/// A body hits a fixed plate with `speed`, in the phases of a step.
template <class Law> class Drop {
	Law law;
	double h, depth, push;
	PairProperties pair;
	std::vector<SolverBody> bodies { 2 };
	std::vector<PointRecord> records;
	double dissipated = 0, elastic = 0, released = 0, work = 0, least = 0; ///< [J]

public:
	/// steps: of h in the undamped contact; share: of a step, at the end of which the surfaces touch; push: force
	/// on the body [N].
	Drop(const Law& law_, double ratio, double steps, double share, double push_ = 0)
	        : law(law_)
	        , h(springOf(law).duration(mass, speed) / steps)
	        , depth((share - 1) * speed * h)
	        , push(push_)
	        , pair { mass, 0.5, 0.4, 1, ratio }
	{
		for (SolverBody& b : bodies) {
			b.velocity = b.spin = Vec3::Zero();
			b.inverseInertia = Mat3::Zero();
		}
		bodies[0].inverseMass = 0;
		bodies[1].inverseMass = 1 / mass;
		bodies[1].velocity = { 0, 0, -speed };
	}
	void step(int sweeps = 100)
	{
		const Vec3 none = Vec3::Zero();
		std::vector<ContactPoint> points;
		if (depth > 0)
			points.push_back({ FeatureId(FeatureKind::VertexFace, 3, 1), {}, none, Vec3::UnitZ(), depth });
		released += elasticPair(
		        law, { pair, { none, none, none }, { none, bodies[1].velocity, none }, h }, points, records);
		for (SolverBody& b : bodies)
			b.newVelocity = b.velocity, b.newSpin = b.spin;
		if (depth > 0) bodies[1].newVelocity.z() -= h * push / mass;
		ContactSolver solver;
		solver.begin(bodies, h, sweeps);
		solver.addPair(0, 1, records.size());
		prepareContacts(solver, 0, pair, points, records);
		solver.solve(1e-12);
		PairEnergies energies;
		storeForces(solver, 0, pair, records, energies);
		dissipated += energies.dashpotNormal;
		least = std::min(least, energies.dashpotNormal);
		elastic = energies.elasticNormal;
		if (depth > 0) work -= h * push * (bodies[1].velocity.z() + bodies[1].newVelocity.z()) / 2;
		bodies[1].velocity = bodies[1].newVelocity;
		depth -= bodies[1].velocity.z() * h;
	}
	bool isOver() const { return depth <= 0 && bodies[1].velocity.z() > 0; }
	double restitution() const { return bodies[1].velocity.z() / speed; }
	double overlap() const { return depth; }
	double energy() const { return kinetic(bodies[1].velocity.z()) + elastic + dissipated + released - work; }
	double leastDissipation() const { return least; }
	const ImpactState& impact() const { return records[0].impact; }
};

} // namespace timber::impacts

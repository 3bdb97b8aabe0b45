// SPDX-License-Identifier: GPL-2.0-or-later
/// Hashes of what the kernel computes, to compare processors: random hulls, a pile of them that falls on a plate, modes
/// of joints, functions. Usage: bits; prints a line for each. tests/hosts/check_arm64 compares them.
/// Braces evaluate random numbers in order on all processors, arguments of functions do not.
#include "joint_assembly.hpp"
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <kernel/contact_pair.hpp>
#include <kernel/portable_math.hpp>
#include <kernel/rotation.hpp>
#include <kernel/slip_law.hpp>
#include <kernel/wall_law.hpp>
#include <map>

using namespace timber;
using namespace timber::shapes;

namespace {

/// FNV-1a of the bits of numbers.
struct Hash {
	std::uint64_t value = 14695981039346656037u;
	void add(double x)
	{
		unsigned char bytes[sizeof x];
		std::memcpy(bytes, &x, sizeof x);
		for (const unsigned char byte : bytes)
			value = (value ^ byte) * 1099511628211u;
	}
	template <class Vector> void addAll(const Vector& v)
	{
		for (Eigen::Index k = 0; k < v.size(); ++k)
			add(v.data()[k]);
	}
	void print(const char* name) const { std::printf("%s %016" PRIx64 "\n", name, value); }
};

/// Of four normal numbers: functions of the C library would differ.
Quat randomTurn(Random& random)
{
	const double w = uniform(random, -1, 1);
	const Vec3 v = randomVector(random, 1);
	return Quat(w, v[0], v[1], v[2]).normalized();
}

/// A polyhedron about its centroid, in principal axes.
struct Stone {
	RoundedPolyhedron shape;
	Vec3 inertia; ///< [kg m2]
	double mass; ///< [kg]
};

Stone stone(const std::vector<Vec3>& points, double radius)
{
	const MassProperties raw = massProperties(Polyhedron::fromVertices(points));
	const Mat3 axes = principalAxes(raw.inertia);
	std::vector<Vec3> centred;
	for (const Vec3& point : points)
		centred.push_back(axes.transpose() * (point - raw.centroid));
	const double density = 400;
	return { rounded(centred, radius), density * (axes.transpose() * raw.inertia * axes).diagonal(),
		density * raw.volume };
}

/// Bodies that fall on the first one, in the phases of a step.
class Pile {
	static constexpr double h = 5e-4;
	const HertzLaw law { 5e8, 0.01 };
	std::vector<Stone> stones;
	std::vector<Pose> poses;
	std::vector<SolverBody> bodies;
	struct Pair {
		CandidateCache cache;
		std::vector<ContactPoint> points;
		std::vector<PointRecord> records;
	};
	std::map<std::pair<int, int>, Pair> pairs;

public:
	void add(const Stone& one, const Pose& pose, bool fixed)
	{
		stones.push_back(one);
		poses.push_back(pose);
		SolverBody b = body(fixed ? 0 : one.mass, Vec3::Zero());
		b.inverseInertia = worldInverse(stones.size() - 1, fixed);
		bodies.push_back(b);
	}
	void step()
	{
		ContactSolver solver;
		for (SolverBody& b : bodies) {
			b.newVelocity = b.velocity;
			b.newSpin = b.spin;
			if (b.inverseMass > 0) b.newVelocity.z() -= 9.81 * h;
		}
		solver.begin(bodies, h, 500);
		std::vector<std::pair<Pair*, PairProperties>> listed;
		for (int i = 0; i < int(stones.size()); ++i)
			for (int k = i + 1; k < int(stones.size()); ++k)
				touch(i, k, solver, listed);
		for (size_t k = 0; k < listed.size(); ++k)
			prepareContacts(solver, k, listed[k].second, listed[k].first->points, listed[k].first->records);
		solver.solve(1e-3);
		PairEnergies energies;
		for (size_t k = 0; k < listed.size(); ++k)
			storeForces(solver, k, listed[k].second, listed[k].first->records, energies);
		for (size_t k = 0; k < bodies.size(); ++k)
			if (bodies[k].inverseMass > 0) move(k);
	}
	void addTo(Hash& hash) const
	{
		for (size_t k = 0; k < bodies.size(); ++k) {
			hash.addAll(poses[k].position);
			hash.addAll(poses[k].orientation.coeffs());
			hash.addAll(bodies[k].velocity);
			hash.addAll(bodies[k].spin);
		}
	}

private:
	Mat3 worldInverse(size_t k, bool fixed) const
	{
		const Mat3 axes = poses[k].orientation.toRotationMatrix();
		return fixed ? Mat3(Mat3::Zero())
		             : Mat3(axes * stones[k].inertia.cwiseInverse().asDiagonal() * axes.transpose());
	}
	void touch(int i, int k, ContactSolver& solver, std::vector<std::pair<Pair*, PairProperties>>& listed)
	{
		Pair& pair = pairs[{ i, k }];
		const ContactKinds kinds { true, true };
		if (!pair.cache.matches(stones[i].shape, stones[k].shape, kinds))
			pair.cache = { stones[i].shape, stones[k].shape, kinds };
		updateManifold(stones[i].shape, stones[k].shape, poses[i], poses[k], kinds, pair.cache, pair.points);
		if (pair.points.empty()) return pair.records.clear();
		const SolverBody &a = bodies[i], &b = bodies[k];
		PairProperties properties { 1 / pairInverseMass(a, b), 0.5, 0.4, 0.01, 0.2 };
		properties.strength = bearingStrength(6e6, 0.01, pair.points);
		elasticPair(law,
		        { properties, { poses[i].position, a.velocity, a.spin },
		                { poses[k].position, b.velocity, b.spin }, h },
		        pair.points, pair.records);
		solver.addPair(i, k, pair.records.size());
		listed.emplace_back(&pair, properties);
	}
	void move(size_t k)
	{
		SolverBody& b = bodies[k];
		b.velocity = b.newVelocity;
		poses[k].position += h * b.velocity;
		const Mat3 axes = poses[k].orientation.toRotationMatrix();
		const Vec3 momentum = axes * stones[k].inertia.cwiseProduct(axes.transpose() * b.newSpin);
		b.spin = freeRotation<double>(poses[k].orientation, momentum, stones[k].inertia, h);
		b.position = poses[k].position;
		b.inverseInertia = worldInverse(k, false);
	}
};

void pile()
{
	Random random(1);
	Pile scene;
	scene.add(stone(boxVertices({ 3, 3, 0.2 }), 0.01), { { 0, 0, -0.1 }, Quat::Identity() }, true);
	Hash hulls, moved;
	for (int k = 0; k < 10; ++k) {
		const Vec3 size { uniform(random, 0.2, 0.6), uniform(random, 0.1, 0.2), uniform(random, 0.1, 0.15) };
		const Stone one
		        = k % 2 ? stone(boxVertices(size), 0.01) : stone(ellipsoidPoints(random, 14, size), 0.004);
		hulls.addAll(one.inertia);
		for (const Vec3& vertex : one.shape.core.vertices)
			hulls.addAll(vertex);
		const Vec3 place { uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3), 0.3 + 0.4 * k };
		scene.add(one, { place, randomTurn(random) }, false);
	}
	hulls.print("hulls");
	for (int k = 0; k < 3000; ++k)
		scene.step();
	scene.addTo(moved);
	moved.print("pile");
}

void joints()
{
	Hash hash;
	Assembly assembly = chain(0.1);
	Random random(2);
	assembly.setVelocities(randomFree(random, assembly));
	assembly.startSprings(5e-4);
	for (int k = 0; k < 200; ++k) {
		hash.add(assembly.damp(5e-4));
		assembly.setVelocities(assembly.velocities());
	}
	hash.addAll(assembly.velocities());
	hash.print("joints");
}

/// Cycles of a wall with a slope of reloading.
void walls()
{
	Hash hash;
	Random random(4);
	const std::vector<BackbonePoint> points { { 0.008, 6000 }, { 0.04, 9000 }, { 0.1, 0 } };
	const WallLaw law({ 1e6, 500, 5e4, 1.09, 0, 1e6, 0.008, 0.3 }, points);
	WallHistory history;
	for (int k = 0; k < 20000; ++k) {
		const WallForce force = law.advance(history, uniform(random, -1e-6, 1e-6) * k);
		history = force.history;
		hash.add(history.force);
		hash.add(force.tangent);
		hash.add(force.energy);
	}
	hash.print("walls");
}

void functions()
{
	Hash hash;
	Random random(3);
	for (int k = 0; k < 20000; ++k) {
		const double x = uniform(random, 0, 30), y = uniform(random, 0.1, 3);
		hash.add(power(x, y));
		hash.add(exponential(-x));
		const auto [s, c] = sineCosine<double>(x - 15);
		hash.add(s);
		hash.add(c);
	}
	hash.print("functions");
}

} // namespace

int main()
{
	functions();
	joints();
	walls();
	pile();
}

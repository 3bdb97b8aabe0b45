// SPDX-License-Identifier: GPL-2.0-or-later
/// Random pairs, including slivers, plates, needles and size ratios of 1:1000: the manifold is finite, bounded, sorted
/// and independent of the cache.
#include "shapes.hpp"
#include <kernel/separating_axis.hpp>
#include <kernel/constants.hpp>
#include <kernel/rotation.hpp>
#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <utility>

using namespace timber;
using namespace timber::shapes;

namespace {

/// Bodies of 1 mm to 1 m, with aspect ratios up to 1:1000.
std::vector<RoundedPolyhedron> randomBodies(Random& random, int wanted, int& refused)
{
	std::vector<RoundedPolyhedron> bodies;
	while (int(bodies.size()) < wanted) {
		const double size = std::pow(10, uniform(random, -3, 0));
		Vec3 axes(1, std::pow(10, uniform(random, -1, 0)), std::pow(10, uniform(random, -1, 0)));
		const int kind = int(uniform(random, 0, 6));
		if (kind == 0) axes = { 1, 1, 1e-3 };
		if (kind == 1) axes = { 1, 1e-3, 1e-3 };
		try {
			const bool box = kind == 2;
			auto points = box ? boxVertices(axes * size)
			                  : ellipsoidPoints(random, 4 + int(uniform(random, 0, 9)), axes * size);
			const Quat turn = randomRotation(random);
			const Polyhedron sharp = Polyhedron::fromVertices(moved(
			        points, turn, -(turn * massProperties(Polyhedron::fromVertices(points)).centroid)));
			bodies.push_back(RoundedPolyhedron::fromSharp(
			        sharp, uniform(random, 0.02, 0.2) * std::min(sharp.shortestEdge(), sharp.thickness())));
		} catch (const PolyhedronError&) {
			++refused;
		}
	}
	return bodies;
}

double depthOf(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseA, const Pose& poseB)
{
	Vec3 axis;
	const Mat3 rotation = (poseA.orientation.conjugate() * poseB.orientation).toRotationMatrix();
	return std::max(0.,
	        -coreGap(a.core, b.core, rotation, poseA.orientation.conjugate() * (poseB.position - poseA.position),
	                axis));
}

void expectSound(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseA, const Pose& poseB,
        double depth, const std::vector<ContactPoint>& points)
{
	const double touch = a.radius + b.radius;
	// 1e-4: flushTolerance
	const double limit = touch
	        + std::max({ depth, depth > 0 ? std::max(a.coreHalfThickness, b.coreHalfThickness) : 0., 1e-4 });
	for (size_t k = 0; k < points.size(); ++k) {
		const ContactPoint& p = points[k];
		EXPECT_TRUE(p.position.allFinite());
		EXPECT_NEAR(p.normal.norm(), 1, 1e-12); // products of unit vectors and rotations
		EXPECT_GT(p.overlap, 0);
		EXPECT_LE(p.overlap, limit * (1 + 1e-12));
		EXPECT_LE((p.position - poseB.position).norm(), b.boundingRadius + touch + limit);
		EXPECT_LE((p.position - poseA.position).norm(), a.boundingRadius + touch + limit);
		EXPECT_TRUE(k == 0 || points[k - 1].id < p.id);
	}
}

} // namespace

TEST(RandomPairs, TwentyThousand)
{
	Random random(71);
	int refused = 0, touching = 0, deep = 0;
	const auto bodies = randomBodies(random, 300, refused);
	EXPECT_LT(refused, 100) << "random points are corners of their hull; only near-degenerate ones may be refused";
	for (int trial = 0; trial < 20000; ++trial) {
		const auto &a = bodies[random() % bodies.size()], &b = bodies[random() % bodies.size()];
		const Vec3 far = trial % 4 == 0 ? Vec3(1000 * randomDirection(random)) : Vec3(Vec3::Zero());
		const Pose poseA { far, randomRotation(random) };
		// Near A's surface, where contacts are
		const Vec3& vertex = a.core.vertices[random() % a.core.vertices.size()];
		const Pose poseB { far + poseA.orientation * vertex
			        + (b.boundingRadius + a.radius) * uniform(random, 0, 1.1) * randomDirection(random),
			randomRotation(random) };
		const auto points = contacts(a, b, poseA, poseB, { trial % 2 == 0, trial % 3 != 0 });
		const double depth = depthOf(a, b, poseA, poseB);
		expectSound(a, b, poseA, poseB, depth, points);
		touching += !points.empty();
		deep += depth > 0;
		ASSERT_FALSE(HasFailure()) << "trial " << trial;
	}
	EXPECT_GT(touching, 5000);
	EXPECT_GT(deep, 2000);
}

/// Cores that overlap always have a contact point, and each point pushes them apart along the axis of least overlap.
TEST(RandomPairs, DeepPairsAreHeldAndPushedOut)
{
	Random random(72);
	int refused = 0, deep = 0;
	const auto bodies = randomBodies(random, 200, refused);
	for (int trial = 0; trial < 2500; ++trial) {
		const auto &a = bodies[random() % bodies.size()], &b = bodies[random() % bodies.size()];
		const Pose poseB { a.core.vertices[random() % a.core.vertices.size()] * uniform(random, 0, 1),
			randomRotation(random) };
		Vec3 axis;
		if (coreGap(a.core, b.core, poseB.orientation.toRotationMatrix(), poseB.position, axis) >= 0) continue;
		++deep;
		const auto points = contacts(a, b, {}, poseB);
		EXPECT_FALSE(points.empty()) << trial;
		std::set<std::pair<FeatureKind, int>> vertices; // each is in contact with one face
		for (const auto& p : points) {
			EXPECT_GT(p.normal.dot(axis), 0.4999) << trial; // deepNormalCosine, rounded
			const FeatureKind kind = p.id.kind();
			if (kind == FeatureKind::VertexFace || kind == FeatureKind::FaceVertex) {
				EXPECT_TRUE(
				        vertices.insert({ kind, kind == FeatureKind::VertexFace ? p.id.a() : p.id.b() })
				                .second)
				        << trial;
			}
		}
	}
	EXPECT_GT(deep, 1000);
}

/// Random walks with one cache per pair: bitwise the same points as from an empty cache, for bodies of all sizes.
TEST(RandomPairs, CacheHoldsNoResult)
{
	Random random(73);
	int refused = 0, touching = 0, different = 0;
	const auto bodies = randomBodies(random, 100, refused);
	for (int walk = 0; walk < 150; ++walk) {
		const auto &a = bodies[random() % bodies.size()], &b = bodies[random() % bodies.size()];
		const ContactKinds kinds { walk % 2 == 0, walk % 3 != 0 };
		Pose poseB { a.core.vertices[0] + b.boundingRadius * randomDirection(random), randomRotation(random) };
		CandidateCache cache;
		std::vector<ContactPoint> points;
		for (int step = 0; step < 40; ++step) {
			poseB.position += 0.02 * std::min(a.boundingRadius, b.boundingRadius) * randomDirection(random);
			poseB.orientation = (about(randomDirection(random), 0.02) * poseB.orientation).normalized();
			updateManifold(a, b, {}, poseB, kinds, cache, points);
			const auto fresh = contacts(a, b, {}, poseB, kinds);
			bool same = points.size() == fresh.size();
			for (size_t k = 0; same && k < points.size(); ++k)
				same = points[k].id == fresh[k].id && points[k].overlap == fresh[k].overlap;
			different += !same;
			touching += !points.empty();
		}
	}
	EXPECT_EQ(different, 0);
	EXPECT_GT(touching, 1000);
}

/// No contact within the safe displacement, measured as in CollisionTrigger; some pairs are in contact slightly beyond
/// it.
TEST(RandomPairs, SafeDisplacement)
{
	Random random(91);
	int refused = 0, separated = 0, beyond = 0;
	const auto bodies = randomBodies(random, 100, refused);
	for (int trial = 0; trial < 4000; ++trial) {
		const auto &a = bodies[random() % bodies.size()], &b = bodies[random() % bodies.size()];
		const ContactKinds kinds { trial % 2 == 0, trial % 3 != 0 };
		const Vec3 direction = randomDirection(random);
		const Pose poseB { (a.boundingRadius + b.boundingRadius) * uniform(random, 0.3, 1.2) * direction,
			randomRotation(random) };
		CandidateCache cache;
		std::vector<ContactPoint> points;
		updateManifold(a, b, {}, poseB, kinds, cache, points); // finds the axis
		const double gap = updateManifold(a, b, {}, poseB, kinds, cache, points);
		if (gap == 0) continue;
		++separated;
		const Quat turn = about(randomDirection(random), uniform(random, 0, 0.5) * gap / b.boundingRadius);
		const double left = gap - rotationDisplacement(turn, b.halfExtents);
		ASSERT_GE(left, 0);
		EXPECT_TRUE(contacts(
		        a, b, {}, { poseB.position - 0.999 * left * direction, poseB.orientation * turn }, kinds)
		                    .empty())
		        << trial;
		const double further = gap + 4 * flushTolerance + 0.1 * (a.radius + b.radius);
		beyond += !contacts(a, b, {}, { poseB.position - further * cache.axis, poseB.orientation }, kinds)
		                   .empty();
	}
	EXPECT_GT(separated, 1000);
	EXPECT_GT(beyond, separated / 20);
}

/// No core vertex moves farther than the bound. Rotation of a slender member about its axis gives a small bound.
TEST(RandomPairs, RotationDisplacementBoundsAllPoints)
{
	Random random(92);
	int refused = 0;
	for (const auto& body : randomBodies(random, 200, refused)) {
		const Quat turn = about(randomDirection(random), uniform(random, 0, 3));
		const double bound = rotationDisplacement(turn, body.halfExtents);
		EXPECT_LE(bound, 4 * body.boundingRadius);
		for (const Vec3& x : body.core.vertices)
			EXPECT_LE((turn * x - x).norm(), bound + 1e-12 * body.boundingRadius);
	}
	const auto column = roundedBox({ 0.12, 0.12, 2.73 });
	EXPECT_NEAR(rotationDisplacement(about(Vec3::UnitZ(), 0.01), column.halfExtents), 0.01 * M_SQRT2 * 0.048, 1e-5);
	EXPECT_NEAR(rotationDisplacement(about(Vec3::UnitX(), 0.01), column.halfExtents),
	        0.01 * std::hypot(0.048, 1.353), 1e-5);
}

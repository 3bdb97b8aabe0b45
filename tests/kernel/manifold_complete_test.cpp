// SPDX-License-Identifier: GPL-2.0-or-later
/// The kinds of contact are complete: with vertex-edge contacts some point is always as deep as the bodies overlap,
/// r_A + r_B - distance of the cores, and none is deeper. The distance comes from an independent program
/// (least_norm.hpp).
#include "least_norm.hpp"
#include "shapes.hpp"
#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <kernel/constants.hpp>
#include <kernel/core_distance.hpp>
#include <kernel/separating_axis.hpp>

using namespace timber;
using namespace timber::shapes;

namespace {

const ContactKinds all { true, true };
const int trials = std::getenv("TRIALS") ? std::atoi(std::getenv("TRIALS")) : 600; ///< of each kind

double distanceOf(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseB)
{
	return LeastNorm::distance(a.core.vertices, moved(b.core.vertices, poseB.orientation, poseB.position));
}

double deepest(const std::vector<ContactPoint>& points)
{
	double most = 0;
	for (const ContactPoint& p : points)
		most = std::max(most, p.overlap);
	return most;
}

/// Contacts within the flush limit t of a border are those of the face's plane: with the distance d of the cores the
/// error is of the order of t^2 / d, and of t where the cores nearly touch. Two points within it that coincide are one
/// if their overlaps differ by a thousandth of it.
double toleranceAt(const RoundedPolyhedron& a, const RoundedPolyhedron& b, double distance)
{
	const double t = std::min(flushTolerance, flushShare * (a.radius + b.radius));
	return 2e-3 * t + std::min(2 * t, 4 * t * t / std::max(distance, 1e-12)) + 1e-11;
}

struct Tally {
	int touching = 0, deep = 0;
	double worst = 0; ///< difference over the tolerance [-]
};

/// A is at the origin.
void expectComplete(const RoundedPolyhedron& a, const RoundedPolyhedron& b, const Pose& poseB, Tally& tally,
        const ContactKinds& kinds = all)
{
	const double touch = a.radius + b.radius, distance = distanceOf(a, b, poseB);
	const auto points = contacts(a, b, {}, poseB, kinds);
	if (distance <= 1e-9) { // the cores overlap: the depth is that of the axis of least overlap
		Vec3 axis;
		const double gap = coreGap(a.core, b.core, poseB.orientation.toRotationMatrix(), poseB.position, axis);
		tally.deep += gap < 0;
		EXPECT_GE(deepest(points), touch - std::min(gap, 0.) - 2 * flushTolerance);
		return;
	}
	const double overlap = std::max(0., touch - distance), tolerance = toleranceAt(a, b, distance);
	tally.touching += overlap > 0;
	tally.worst = std::max(tally.worst, std::abs(deepest(points) - overlap) / tolerance);
	EXPECT_NEAR(deepest(points), overlap, tolerance)
	        << points.size() << " points, distance " << distance << " position " << poseB.position.transpose()
	        << " orientation " << poseB.orientation.coeffs().transpose();
}

RoundedPolyhedron randomHull(Random& random, int corners, double size)
{
	while (true)
		try {
			return rounded(ellipsoidPoints(random, corners, Vec3::Constant(size / 2)),
			        uniform(random, 0.01, 0.05) * size);
		} catch (const PolyhedronError&) { // no core remains: the next one
		}
}

std::vector<RoundedPolyhedron> bodiesOf(Random& random, double size)
{
	std::vector<RoundedPolyhedron> bodies { roundedBox(Vec3(1, 1, 1) * size), roundedBox(Vec3(1, 0.5, 0.2) * size),
		roundedBox(Vec3(1, 0.1, 0.1) * size), rounded(hexagonalPrismVertices(0.3 * size, size), 0.03 * size),
		rounded(octahedronVertices(0.7 * size), 0.04 * size),
		rounded(tetrahedronVertices(0.8 * size), 0.04 * size),
		rounded(prismVertices({ { -0.4, 0 }, { 0.4, 0 }, { 0, 0.5 } }, 1), 0.02) };
	if (size != 1) bodies.pop_back();
	for (const int corners : { 5, 8, 12, 20, 40 })
		bodies.push_back(randomHull(random, corners, size));
	return bodies;
}

/// Moves B along a direction until the cores have a distance of a share of the contact distance.
Pose approached(const RoundedPolyhedron& a, const RoundedPolyhedron& b, Pose pose, const Vec3& direction, double share)
{
	const double wanted = share * (a.radius + b.radius);
	double low = 0, high = 4 * (a.boundingRadius + b.boundingRadius);
	const Vec3 origin = pose.position;
	for (int k = 0; k < 26; ++k) {
		const double middle = (low + high) / 2;
		pose.position = origin + middle * direction;
		(distanceOf(a, b, pose) < wanted ? low : high) = middle;
	}
	return pose;
}

} // namespace

/// The program itself, and the distance of the kernel that judges contacts in a run.
TEST(LeastNorm, ClosedForms)
{
	const auto box = boxVertices({ 1, 1, 1 });
	EXPECT_NEAR(LeastNorm::distance(box, moved(box, Quat::Identity(), { 0.3, 0.2, 1.5 })), 0.5, 1e-14);
	EXPECT_NEAR(LeastNorm::distance(box, moved(box, Quat::Identity(), { 2, 3, 0 })), std::hypot(1, 2), 1e-14);
	EXPECT_NEAR(LeastNorm::distance(box, moved(box, Quat::Identity(), { 2, 3, 4 })), std::sqrt(14.), 1e-14);
	EXPECT_LT(LeastNorm::distance(box, moved(box, Quat::Identity(), { 0.3, 0.2, 0.9 })), 1e-12);
}

TEST(CoreDistance, IsThatOfTheVertices)
{
	Random random(5);
	const auto bodies = bodiesOf(random, 1);
	for (int trial = 0; trial < trials / 4; ++trial) {
		const auto &a = bodies[random() % bodies.size()], &b = bodies[random() % bodies.size()];
		const Pose pose { uniform(random, 0.5, 2) * randomDirection(random), randomRotation(random) };
		const double distance = distanceOf(a, b, pose);
		if (distance < 1e-6) continue;
		EXPECT_NEAR(coreDistance(a.core, b.core, pose.orientation.toRotationMatrix(), pose.position), distance,
		        1e-9);
		const double overlap = bodyOverlap(a, b, {}, pose), touch = a.radius + b.radius;
		if (distance < touch) EXPECT_NEAR(overlap, touch - distance, 1e-9);
		else EXPECT_LE(overlap, 0);
	}
}

/// All shapes in all orientations, at distances from nothing to the contact distance.
TEST(CompleteManifold, RandomPairs)
{
	Random random(1);
	Tally tally;
	for (const double size : { 0.01, 1., 30. }) {
		const auto bodies = bodiesOf(random, size);
		for (int trial = 0; trial < trials && !HasFailure(); ++trial) {
			const auto &a = bodies[random() % bodies.size()], &b = bodies[random() % bodies.size()];
			const Vec3 direction = randomDirection(random);
			const double share = trial % 3 == 0 ? uniform(random, 0.99, 1) : uniform(random, 0.02, 1.05);
			expectComplete(a, b,
			        approached(a, b, { Vec3::Zero(), randomRotation(random) }, direction, share), tally);
		}
	}
	EXPECT_GT(tally.touching, 2 * trials);
	std::printf("worst difference: %.3g of the tolerance\n", tally.worst);
}

/// Flush, parallel and coincident features, and these turned and moved by amounts about every tolerance.
TEST(CompleteManifold, AlignedPairsAndSmallPerturbations)
{
	Random random(2);
	Tally tally;
	const std::vector<Quat> turns { Quat::Identity(), about(Vec3::UnitX(), M_PI / 4),
		about(Vec3::UnitZ(), M_PI / 2), about(Vec3::UnitZ(), M_PI / 3),
		Quat::FromTwoVectors(Vec3(1, 1, 1), Vec3::UnitZ()),
		about(Vec3::UnitY(), M_PI / 4) * about(Vec3::UnitX(), M_PI / 2) };
	const std::vector<double> small { 0, 1e-12, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 9.9e-5, 1e-4, 1.01e-4, 2e-4, 1e-3,
		4.9e-3, 5e-3, 5.1e-3, 1e-2, 4.9e-2, 5.1e-2 };
	for (const double size : { 0.01, 1., 30. }) {
		const auto bodies = bodiesOf(random, size);
		for (int trial = 0; trial < trials && !HasFailure(); ++trial) {
			const auto &a = bodies[random() % 7 % bodies.size()], &b = bodies[random() % 7 % bodies.size()];
			const auto pick = [&](const auto& list) { return list[random() % list.size()]; };
			// Turn A's frame instead of A: B is turned and placed relative to it
			Pose pose { Vec3::Zero(), pick(turns) * pick(turns).conjugate() };
			const auto lattice = [&] { return (int(random() % 5) - 2) * 0.25 * size; };
			const double x = lattice(), y = lattice(), z = lattice();
			Vec3 direction(x, y, z);
			if (direction.norm() == 0) direction = Vec3::UnitZ();
			direction.normalize();
			const auto side = Vec3(lattice(), lattice(), 0);
			pose.position = random() % 2 ? side : Vec3(Vec3::Zero());
			pose.orientation
			        = about(random() % 2 ? Vec3(Vec3::UnitZ()) : randomDirection(random), pick(small))
			        * pose.orientation;
			const double share = random() % 3 == 0 ? 1 - 1e-4 : uniform(random, 0.02, 1.05);
			pose = approached(a, b, pose, direction, share);
			pose.position += pick(small) * Vec3(random() % 2 ? 1 : 0, random() % 2 ? 1 : 0, 0);
			expectComplete(a, b, pose, tally);
		}
	}
	EXPECT_GT(tally.touching, trials);
	std::printf("worst difference: %.3g of the tolerance\n", tally.worst);
}

/// Without the support of faces for vertices above their borders, edges support them.
TEST(CompleteManifold, WithoutFlushSupports)
{
	Random random(3);
	Tally tally;
	const auto bodies = bodiesOf(random, 1);
	for (int trial = 0; trial < trials && !HasFailure(); ++trial) {
		const auto &a = bodies[random() % bodies.size()], &b = bodies[random() % bodies.size()];
		const Quat turn = trial % 2 ? randomRotation(random) : Quat::Identity();
		expectComplete(a, b,
		        approached(a, b, { Vec3::Zero(), turn },
		                trial % 4 ? randomDirection(random) : Vec3(Vec3::UnitZ()), uniform(random, 0.02, 1)),
		        tally, { true, false });
	}
	EXPECT_GT(tally.touching, 3 * trials / 4);
}

/// Cores that overlap, by little and by much.
TEST(CompleteManifold, OverlappingCores)
{
	Random random(4);
	Tally tally;
	const auto bodies = bodiesOf(random, 1);
	for (int trial = 0; trial < trials && !HasFailure(); ++trial) {
		const auto &a = bodies[random() % bodies.size()], &b = bodies[random() % bodies.size()];
		const Quat turn = trial % 2 ? randomRotation(random) : Quat::Identity();
		const Vec3 direction = trial % 4 ? randomDirection(random) : Vec3(Vec3::UnitZ());
		Pose pose = approached(a, b, { Vec3::Zero(), turn }, direction, 1e-3);
		pose.position -= std::pow(10, uniform(random, -6, -0.3)) * direction;
		expectComplete(a, b, pose, tally);
	}
	EXPECT_GT(tally.deep, trials / 3);
}

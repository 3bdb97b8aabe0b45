// SPDX-License-Identifier: GPL-2.0-or-later
/// Preconditions at the kernel's entries. The assertions end a checked build; a Release build has none.
#include "heap.hpp"
#include <gtest/gtest.h>
#include <kernel/contact_pair.hpp>
#include <kernel/slip_law.hpp>
#include <kernel/stability.hpp>

using namespace timber;
using namespace timber::shapes;

#ifdef NDEBUG
#define EXPECT_REFUSED(call) // not checked in this build
#else
#define EXPECT_REFUSED(call) EXPECT_DEATH(call, "Assertion")
#endif

namespace {

const double notANumber = std::numeric_limits<double>::quiet_NaN();
const HertzLaw law { 5e9, 0.1 };
const Vec3 none = Vec3::Zero();

[[maybe_unused]] void elastic(double h, const std::vector<ContactPoint>& points)
{
	const PairProperties pair { 1, 0.5, 0.4, 1 };
	std::vector<PointRecord> records;
	elasticPair(law, { pair, { none, none, none }, { none, none, none }, h }, points, records);
}
[[maybe_unused]] ContactPoint pointOf(int vertex, const Vec3& normal = Vec3::UnitZ(), double overlap = 1e-3)
{
	return { { FeatureKind::VertexFace, vertex, 0 }, {}, none, normal, overlap };
}

[[maybe_unused]] void solve(HeapPoint point, double h = 1e-4, double tolerance = 0)
{
	std::vector<SolverBody> bodies { body(0, none), body(1, none) };
	std::vector<HeapPoint> points { point };
	solveContacts(bodies, points, h, 1, tolerance);
}

} // namespace

TEST(Preconditions, OfTheLaws)
{
	EXPECT_REFUSED(restitution(-0.1));
	EXPECT_REFUSED(restitution(notANumber));
	EXPECT_REFUSED(approachOverlap(law, 0, 1, 1e-4));
	EXPECT_REFUSED(initialOverlap(law, 0, 1e-4, 0));
	EXPECT_REFUSED(rotatedShear<double>(Vec3::UnitX(), Vec3::Constant(notANumber), Vec3::UnitZ()));
}

TEST(Preconditions, OfTheElasticStep)
{
	elastic(1e-4, { pointOf(0), pointOf(1) });
	EXPECT_REFUSED(elastic(1e-4, { pointOf(1), pointOf(0) })); // not sorted
	EXPECT_REFUSED(elastic(1e-4, { pointOf(0, Vec3(0, 0, 2)) }));
	EXPECT_REFUSED(elastic(1e-4, { pointOf(0, Vec3::UnitZ(), notANumber) }));
	EXPECT_REFUSED(elastic(0, { pointOf(0) }));
}

TEST(Preconditions, OfTheSolver)
{
	solve(central(100, 10));
	HeapPoint bad = central(100, 10);
	bad.normal *= 1.1;
	EXPECT_REFUSED(solve(bad));
	EXPECT_REFUSED(solve(central(-1, 10)));
	EXPECT_REFUSED(solve(central(100, notANumber)));
	EXPECT_REFUSED(solve(central(100, 10), 0));
	EXPECT_REFUSED(solve(central(100, 10), 1e-4, -1));
	[[maybe_unused]] ContactSolver solver;
	std::vector<SolverBody> no;
	EXPECT_REFUSED(solver.begin(no, 1e-4, -1));
	EXPECT_REFUSED(solver.addPair(1, 1, 4));
}

TEST(Preconditions, OfJointsAndStability)
{
	const Mat3 axes = Mat3::Identity();
	std::vector<Vec3> anchors(2, none), short1(1, none);
	std::vector<SpringLanes> groups(groupsOf(2));
	const JointSprings springs { groups.data(), 2 };
	springs.assign(anchors, anchors, { 0, 0 });
	EXPECT_REFUSED(springs.assign(anchors, short1, { 0, 0 }));
	JointForce total;
	springForces({ 1, 1 }, { axes, axes, none }, Vec3::UnitX(), springs, total);
	EXPECT_REFUSED(springForces({ 0, 1 }, { axes, axes, none }, Vec3::UnitX(), springs, total));
	EXPECT_REFUSED(springForces({ 1, -1 }, { axes, axes, none }, Vec3::UnitX(), springs, total));
	const auto softeningFrom = [](double stretch) {
		return SlipLaw(1, 0.5, { { 1, 1 }, { stretch, 1 }, { 3, 0 } });
	};
	EXPECT_GT(slipForce(softeningFrom(2), {}, Vec3::UnitX()).force.norm(), 0);
	EXPECT_REFUSED(slipForce(softeningFrom(1), {}, Vec3::UnitX())); // softens before it yields
	EXPECT_REFUSED(slipForce(softeningFrom(2), { none, -1 }, Vec3::UnitX()));
	EXPECT_REFUSED(slipForce(softeningFrom(2), {}, Vec3::Constant(notANumber)));
	EXPECT_REFUSED(isOverloaded({ notANumber, false }, JointForce()));
	EXPECT_REFUSED(largestEigenvalue({ body(1, none) }, { { 0, 1, none, none, Vec3::UnitX(), 1, 1 } }));
}

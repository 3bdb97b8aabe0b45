// SPDX-License-Identifier: GPL-2.0-or-later
/// Sets of joints: what goes in comes out, whatever the neighbours are, and what breaks or moves to another set.
#include "shapes.hpp"
#include <gtest/gtest.h>
#include <kernel/joint_set.hpp>

using namespace timber;
using namespace timber::shapes;

namespace {

std::vector<Vec3> vectors(Random& random, size_t count)
{
	std::vector<Vec3> v(count);
	for (Vec3& one : v)
		one = randomVector(random, 1);
	return v;
}

/// A joint with random ends and state. The stretch and force of the broken spring count / 2 are zero.
struct Given {
	std::vector<Vec3> anchorsA, anchorsB;
	JointEntry parameters;
	SpringsState state;

	Given(Random& random, size_t count, bool yields)
	        : anchorsA(vectors(random, count))
	        , anchorsB(vectors(random, count))
	{
		parameters.bodyA = int(count);
		parameters.stiffness = { 1e3, 1e3 };
		parameters.strength = { 10, false };
		if (yields) parameters.law = SlipSprings({ 1e3, 0.3, { { 0.01, 10 }, { 0.1, 0 } } }, Vec3::Zero());
		state.broken.assign(count, 0);
		state.broken[count / 2] = 1;
		state.stretches = vectors(random, count);
		state.forces = vectors(random, count);
		state.stretches[count / 2] = state.forces[count / 2] = Vec3::Zero();
		if (yields) state.plastic = vectors(random, count);
		else state.half = vectors(random, count);
		for (const Vec3& plastic : state.plastic)
			state.largest.push_back(plastic.norm());
		state.account = double(count);
	}
	void set(JointSet& to, size_t joint) const { to.change(joint, parameters, anchorsA, anchorsB, state); }
	void expectIn(JointSet& set, size_t index) const
	{
		const JointEntry& joint = set.joints[index];
		const JointSprings springs = set.springs(joint);
		const SpringsState found = set.state(joint);
		EXPECT_EQ(springs.all(&JointSprings::anchorA), anchorsA);
		EXPECT_EQ(springs.all(&JointSprings::anchorB), anchorsB);
		EXPECT_EQ(found.broken, state.broken);
		EXPECT_EQ(found.stretches, state.stretches);
		EXPECT_EQ(found.forces, state.forces);
		EXPECT_EQ(found.half, state.half);
		EXPECT_EQ(found.account, state.account);
		EXPECT_EQ(found.plastic, state.plastic);
		EXPECT_EQ(found.largest, state.largest);
		EXPECT_EQ(joint.bodyA, parameters.bodyA);
		EXPECT_EQ(joint.intact, anchorsA.size() - 1);
		EXPECT_EQ(joint.isStiff(), !joint.yields());
	}
};

/// Joints of one to nine springs: groups of one do not reach into those of the next.
struct Mixed {
	std::vector<Given> given;
	JointSet set;

	Mixed()
	{
		Random random(54);
		for (const size_t count : { 1, 4, 5, 9, 3 })
			given.emplace_back(random, count, count % 2 == 1);
		set.joints.resize(given.size());
		for (size_t k = 0; k < given.size(); ++k)
			given[k].set(set, k);
	}
};

} // namespace

TEST(JointSet, KeepsTheStateOfEachSpring)
{
	Mixed mixed;
	for (size_t k = 0; k < mixed.given.size(); ++k)
		mixed.given[k].expectIn(mixed.set, k);
}

TEST(JointSet, ChangedJointsLeaveTheOthers)
{
	Mixed mixed;
	Random random(7);
	for (const size_t count : { 2, 8, 1 }) {
		mixed.set.isChanged = false;
		mixed.given[2] = Given(random, count, count == 8);
		mixed.given[2].set(mixed.set, 2);
		EXPECT_TRUE(mixed.set.isChanged);
		for (size_t k = 0; k < mixed.given.size(); ++k)
			mixed.given[k].expectIn(mixed.set, k);
	}
}

/// A state without some of its vectors, as of a joint that is new or has got another law: what is missing is zero.
TEST(JointSet, MissingStateIsZero)
{
	Mixed mixed;
	Given& one = mixed.given[4];
	SpringsState part;
	part.largest = { 0.5 };
	mixed.set.change(4, one.parameters, one.anchorsA, one.anchorsB, part);
	const SpringsState state = mixed.set.state(mixed.set.joints[4]);
	EXPECT_EQ(state.broken, std::vector<int>(3, 0));
	EXPECT_EQ(state.forces, std::vector<Vec3>(3, Vec3::Zero()));
	EXPECT_EQ(state.largest, (std::vector<double> { 0.5, 0, 0 }));
	EXPECT_EQ(state.plastic, std::vector<Vec3>(3, Vec3::Zero()));
	EXPECT_EQ(mixed.set.joints[4].intact, 3u);
}

TEST(JointSet, TakesJointsOfOthersAndOfItself)
{
	Mixed mixed;
	JointSet other;
	EXPECT_EQ(other.take(mixed.set, 1), 0u);
	EXPECT_EQ(other.take(mixed.set, 3), 1u);
	EXPECT_EQ(other.take(other, 0), 2u);
	mixed.given[1].expectIn(other, 2);
	mixed.given[3].expectIn(other, 1);
	for (const JointEntry* left : { &mixed.set.joints[1], &mixed.set.joints[3], &other.joints[0] })
		EXPECT_TRUE(left->isBroken() && left->springs == 0 && !left->isStiff());
	for (const size_t k : { 0, 2, 4 })
		mixed.given[k].expectIn(mixed.set, k);
}

TEST(JointSet, BrokenSpringsCountOnce)
{
	Mixed mixed;
	JointEntry& joint = mixed.set.joints[3];
	const double before = mixed.set.load(joint);
	EXPECT_GT(before, 0);
	for (const size_t spring : { 4, 0, 0 })
		mixed.set.breakSpring(joint, spring);
	EXPECT_EQ(joint.intact, 7u);
	EXPECT_EQ(mixed.set.springs(joint).force(0), Vec3(Vec3::Zero()));
	mixed.set.breakAll(joint);
	EXPECT_TRUE(joint.isBroken());
	EXPECT_EQ(mixed.set.load(joint), 0);
	mixed.given[4].expectIn(mixed.set, 4);
}

/// Largest force over the strength, or the sum of the forces.
TEST(JointSet, LoadIsThatOfTheLastForces)
{
	Mixed mixed;
	double largest = 0, sum = 0;
	for (const Vec3& force : mixed.given[2].state.forces) {
		largest = std::max(largest, force.norm());
		sum += force.norm();
	}
	EXPECT_NEAR(mixed.set.load(mixed.set.joints[2]), largest / 10, 1e-15);
	mixed.set.joints[2].strength.perJoint = true;
	EXPECT_NEAR(mixed.set.load(mixed.set.joints[2]), sum / 10, 1e-15);
}

/// Joints of one spring along the same line have the first one's index; others are alone.
TEST(JointSet, FindsJointsAlongTheSameLine)
{
	const Vec3 end(1, 2, 3), x = Vec3::UnitX(), y = Vec3::UnitY(), aside(0, 1e-6, 0);
	struct Row {
		int bodyA, bodyB;
		Vec3 normal, anchorA, anchorB;
		double shear;
		size_t line;
	};
	const std::vector<Row> rows { { 0, 1, x, end, end, 0, 0 }, { 0, 2, x, end, end, 0, 1 },
		{ 0, 1, x, end, end, 0, 0 }, { 0, 1, y, end, end, 0, 3 }, { 0, 1, x, end + aside, end, 0, 4 },
		{ 0, 1, x, end, end + aside, 0, 5 }, { 0, 1, x, end, end, 10, 6 }, { 0, 2, x, end, end, 0, 1 },
		{ 1, 0, x, end, end, 0, 8 }, { 0, 1, x, end, end, 0, 0 } };
	JointSet set;
	set.joints.resize(rows.size() + 1);
	for (size_t k = 0; k < rows.size(); ++k) {
		JointEntry parameters;
		parameters.bodyA = rows[k].bodyA;
		parameters.bodyB = rows[k].bodyB;
		parameters.normal = rows[k].normal;
		parameters.stiffness = { 1e3, rows[k].shear };
		set.change(k, parameters, { rows[k].anchorA }, { rows[k].anchorB }, {});
	}
	JointEntry two;
	two.bodyA = 0;
	two.bodyB = 1;
	two.normal = x;
	two.stiffness = { 1e3, 0 };
	set.change(rows.size(), two, { end, end }, { end, end }, {});
	set.findLines();
	for (size_t k = 0; k < rows.size(); ++k)
		EXPECT_EQ(set.joints[k].line, rows[k].line) << k;
	EXPECT_EQ(set.joints.back().line, rows.size());
}

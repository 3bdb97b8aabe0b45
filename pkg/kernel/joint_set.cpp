// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint_set.hpp"
#include "constants.hpp"
#include <algorithm>
#include <cassert>
#include <map>

namespace timber {

double JointSet::load(const JointEntry& joint)
{
	JointForce total;
	for (const Vec3& f : springs(joint).all(&JointSprings::force)) {
		total.sum += f.norm();
		total.largestSquared = std::max(total.largestSquared, f.squaredNorm());
	}
	return joint.strength.load(total);
}

SpringsState JointSet::state(const JointEntry& joint)
{
	const JointSprings all = springs(joint);
	SpringsState state { all.broken(), all.all(&JointSprings::stretch), all.all(&JointSprings::force), {}, {}, {},
		joint.half, joint.account, modesOf(joint) };
	if (const auto* slip = std::get_if<SlipSprings>(&joint.law)) {
		state.plastic = slip->plastic();
		state.largest = slip->largest();
	}
	if (const auto* wall = std::get_if<WallSprings>(&joint.law)) state.wall = wall->histories();
	return state;
}

void JointSet::change(size_t index, JointEntry parameters, const std::vector<Vec3>& anchorsA,
        const std::vector<Vec3>& anchorsB, SpringsState s)
{
	const size_t count = anchorsA.size();
	assert(count > 0 && anchorsB.size() == count);
	JointEntry& joint = joints[index];
	parameters.firstGroup = joint.firstGroup;
	parameters.total = joint.total;
	if (groupsOf(count) > groupsOf(joint.springs)) {
		parameters.firstGroup = groups.size();
		groups.resize(groups.size() + groupsOf(count));
	}
	joint = std::move(parameters);
	joint.springs = count;
	const Vec3 none = Vec3::Zero();
	s.broken.resize(count, 0);
	s.stretches.resize(count, none);
	s.forces.resize(count, none);
	springs(joint).assign(anchorsA, anchorsB, s.broken);
	for (size_t i = 0; i < count; ++i)
		if (!s.broken[i]) springs(joint).set(i, s.stretches[i], s.forces[i]);
	joint.intact = size_t(std::count(s.broken.begin(), s.broken.end(), 0));
	if (auto* slip = std::get_if<SlipSprings>(&joint.law)) {
		s.plastic.resize(count, none);
		s.largest.resize(count, 0);
		slip->setHistories(std::move(s.plastic), std::move(s.largest));
	}
	s.wall.resize(count);
	if (auto* wall = std::get_if<WallSprings>(&joint.law)) wall->setHistories(s.wall);
	if (!s.half.empty()) s.half.resize(count, none);
	joint.half = std::move(s.half);
	joint.account = s.account;
	modesOf(joint) = s.modes;
	joint.centreA = mean(anchorsA);
	joint.centreB = mean(anchorsB);
	joint.reach = 0;
	for (size_t i = 0; i < count; ++i)
		joint.reach = std::max(
		        { joint.reach, (anchorsA[i] - joint.centreA).norm(), (anchorsB[i] - joint.centreB).norm() });
	isChanged = true;
}

size_t JointSet::take(JointSet& from, size_t index)
{
	const JointSprings old = from.springs(from.joints[index]);
	const std::vector<SpringLanes> lanes(old.groups, old.groups + groupsOf(old.count));
	joints.push_back(std::move(from.joints[index]));
	from.joints[index] = {};
	joints.back().firstGroup = groups.size();
	joints.back().line = joints.size() - 1;
	groups.insert(groups.end(), lanes.begin(), lanes.end());
	const JointModes& modesThere = from.modesOf(from.joints[index]);
	modesOf(joints.back()) = modesThere;
	isChanged = from.isChanged = true;
	return joints.size() - 1;
}

void JointSet::findLines()
{
	const auto areSame
	        = [](const Vec3& a, const Vec3& b) { return (a - b).squaredNorm() < roundingLength * roundingLength; };
	std::map<std::pair<int, int>, std::vector<size_t>> ofBodies;
	for (size_t k = 0; k < joints.size(); ++k) {
		JointEntry& joint = joints[k];
		joint.line = k;
		if (joint.springs != 1 || joint.stiffness.shear != 0) continue;
		std::vector<size_t>& lines = ofBodies[{ joint.bodyA, joint.bodyB }];
		const auto same = std::find_if(lines.begin(), lines.end(), [&](size_t other) {
			return areSame(joints[other].normal, joint.normal)
			        && areSame(joints[other].centreA, joint.centreA)
			        && areSame(joints[other].centreB, joint.centreB);
		});
		same == lines.end() ? lines.push_back(k) : void(joint.line = *same);
	}
}

void JointSet::breakSpring(JointEntry& joint, size_t spring)
{
	joint.intact -= springs(joint).isIntact(spring);
	springs(joint).breakSpring(spring);
}

void JointSet::breakAll(JointEntry& joint)
{
	for (size_t i = 0; i < joint.springs; ++i)
		breakSpring(joint, i);
}

} // namespace timber

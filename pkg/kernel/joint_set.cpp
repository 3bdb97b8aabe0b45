// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint_set.hpp"
#include <algorithm>
#include <cassert>

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
		joint.half, joint.account, joint.modes };
	if (const auto* slip = std::get_if<SlipSprings>(&joint.law)) {
		state.plastic = slip->plastic();
		state.largest = slip->largest();
	}
	if (const auto* wall = std::get_if<WallSprings>(&joint.law)) state.wall = wall->histories;
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
	if (auto* wall = std::get_if<WallSprings>(&joint.law)) wall->histories = std::move(s.wall);
	if (!s.half.empty()) s.half.resize(count, none);
	joint.half = std::move(s.half);
	joint.account = s.account;
	joint.modes = s.modes;
	joint.centreA = mean(anchorsA);
	joint.centreB = mean(anchorsB);
	isChanged = true;
}

size_t JointSet::take(JointSet& from, size_t index)
{
	const JointSprings old = from.springs(from.joints[index]);
	const std::vector<SpringLanes> lanes(old.groups, old.groups + groupsOf(old.count));
	JointEntry joint = std::move(from.joints[index]);
	from.joints[index] = {};
	joint.firstGroup = groups.size();
	groups.insert(groups.end(), lanes.begin(), lanes.end());
	joints.push_back(std::move(joint));
	isChanged = from.isChanged = true;
	return joints.size() - 1;
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

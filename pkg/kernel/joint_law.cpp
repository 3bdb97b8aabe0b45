// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint_law.hpp"
#include "preconditions.hpp"
#include <algorithm>
#include <cassert>
#include <limits>

namespace timber {
namespace {

	[[maybe_unused]] bool isValid(const JointStiffness& k)
	{
		return k.normal > 0 && k.shear >= 0 && std::isfinite(k.normal) && std::isfinite(k.shear);
	}
	[[maybe_unused]] bool isValid(const JointPlacement& p)
	{
		return isFinite(p.axesA) && isFinite(p.axesB) && isFinite(p.distance);
	}
	/// Energy of a spring at the middle of the last step, the time of the velocities: it does not act in this step
	/// any more. [J]
	double energyAtBreak(const SpringForce<double>& f, const Vec3& anchorB, const JointMotion& motion)
	{
		const BodyKinematics &a = motion.a, &b = motion.b;
		const Vec3 end = b.position + anchorB; // the force acts on both bodies here
		const Vec3 velocity = relativeVelocity<double>(
		        end - a.position, end - b.position, a.velocity, a.spin, b.velocity, b.spin);
		return f.energy - motion.h / 2 * f.force.dot(velocity);
	}

} // namespace

std::vector<Vec3> JointSprings::all(Vec3 (JointSprings::*value)(size_t) const) const
{
	std::vector<Vec3> vectors;
	for (size_t i = 0; i < count; ++i)
		vectors.push_back((this->*value)(i));
	return vectors;
}

std::vector<int> JointSprings::broken() const
{
	std::vector<int> flags;
	for (size_t i = 0; i < count; ++i)
		flags.push_back(!isIntact(i));
	return flags;
}

void JointSprings::assign(
        const std::vector<Vec3>& anchorsA, const std::vector<Vec3>& anchorsB, const std::vector<int>& broken) const
{
	assert(anchorsA.size() == count && anchorsB.size() == count && broken.size() == count);
	const Vec3s none = Vec3s::Constant(Lanes(0.));
	std::fill(groups, groups + groupsOf(count), SpringLanes { none, none, {}, none, none });
	for (size_t i = 0; i < count; ++i) {
		setLane(group(i).anchorsA, i % laneCount, anchorsA[i]);
		setLane(group(i).anchorsB, i % laneCount, anchorsB[i]);
		group(i).intact[i % laneCount] = broken[i] ? 0 : ~std::int64_t(0);
	}
}

void springForces(const JointStiffness& stiffness, const JointPlacement& placement, const Vec3& normal,
        const JointSprings& springs, JointForce& total)
{
	assert(isValid(stiffness) && isValid(placement) && isUnit(normal));
	const JointStiffness k = stiffness; // a copy stays in registers
	Sums<11> sums;
	Lanes largestSquared = 0.;
	const SpringLanes* const last = springs.groups + groupsOf(springs.count);
	for (SpringLanes* s = springs.groups; s != last; ++s) {
		const Vec3s armB = broadcast<Lanes>(placement.axesB) * s->anchorsB,
		            end = broadcast<Lanes>(placement.distance) + armB,
		            stretch = select(s->intact, Vec3s(end - broadcast<Lanes>(placement.axesA) * s->anchorsA),
		                    Vec3s(Vec3s::Constant(Lanes(0.))));
		s->stretches = stretch;
		const auto add = [&](const SpringForce<Lanes>& f) __attribute__((always_inline))
		{
			s->forces = f.force;
			const Lanes square = f.force.squaredNorm();
			// with unequal stiffnesses the force is not along the stretch: it acts on both bodies at the
			// anchor of B
			const Vec3s torqueA = end.cross(f.force), torqueB = -armB.cross(f.force);
			// Broken springs add zeros
			sums.add<Lanes>(laneCount, f.force, torqueA, torqueB, f.energy, sqrt(square));
			largestSquared = max(largestSquared, square);
		};
		const Vec3 worldNormal = placement.axesA * normal;
		// Branches of their own: no force goes through memory
		if (k.normal == k.shear) add(isotropicForce<Lanes>(k.shear, stretch, worldNormal));
		else add(springForce<Lanes>(k, stretch, worldNormal));
	}
	double largest = 0;
	for (size_t i = 0; i < laneCount; ++i)
		largest = std::max(largest, lane(largestSquared, i));
	total = { sums.vector(0), sums.vector(3), sums.vector(6), sums[9], 0, 1, largest, sums[10] };
}

namespace {
	/// Forces of a joint's yielding springs and their sums, one after the other.
	class YieldingSprings {
		SpringLaw& law;
		const JointPlacement& placement;
		const Vec3& axis;
		const JointSprings& springs;
		const Vec3 worldAxis = placement.axesA * axis;
		const bool isAxial = !axis.isZero(0);
		Sums<12> sums; ///< force, torques; sum, energy, share
		double intact = 0, dissipated = 0, largestSquared = 0;
		bool isSpent = false;

		/// The force is not along the stretch: it acts on both bodies at the anchor of B.
		template <class Number>
		[[gnu::always_inline]] void sum(const Vec3Of<Number>& force, const Vec3Of<Number>& end,
		        const Vec3Of<Number>& armB, Number energy, Number share)
		{
			const Number square = force.squaredNorm();
			sums.add<Number>(laneCount, force, Vec3Of<Number>(end.cross(force)),
			        Vec3Of<Number>(-armB.cross(force)), sqrt(square), energy, share);
			for (size_t i = 0; i < (std::is_same_v<Number, double> ? 1 : laneCount); ++i)
				largestSquared = std::max(largestSquared, lane(square, i));
		}

	public:
		YieldingSprings(SpringLaw& l, const JointPlacement& p, const Vec3& a, const JointSprings& s)
		        : law(l)
		        , placement(p)
		        , axis(a)
		        , springs(s)
		{
		}

		/// laneCount springs at once, if their histories stay.
		bool addSteady(size_t first)
		{
			if (isAxial) return false;
			SpringLanes& s = springs.group(first);
			const auto axesA = broadcast<Lanes>(placement.axesA);
			const Vec3s none = Vec3s::Constant(Lanes(0.)),
			            armB = broadcast<Lanes>(placement.axesB) * s.anchorsB,
			            end = broadcast<Lanes>(placement.distance) + armB,
			            stretch = select(s.intact, Vec3s(end - axesA * s.anchorsA), none);
			SteadySprings state;
			if (!law.steadyForces(first, axesA.transpose() * stretch, s.intact, state)) return false;
			s.stretches = stretch;
			s.forces = select(s.intact, Vec3s(axesA * state.force), none);
			const Lanes zero = 0.;
			sum<Lanes>(s.forces, end, armB, select(s.intact, state.energy, zero),
			        select(s.intact, state.share, zero));
			for (size_t i = 0; i < laneCount; ++i)
				intact += lane(s.intact, i);
			return true;
		}
		void add(size_t i)
		{
			const Vec3 armB = placement.axesB * springs.anchorB(i), end = placement.distance + armB;
			Vec3 stretch = end - placement.axesA * springs.anchorA(i), force;
			SpringState state;
			if (isAxial) {
				const double along = worldAxis.dot(stretch);
				stretch = along * worldAxis;
				state = law.commit(i, along * axis);
				force = axis.dot(state.force) * worldAxis;
			} else {
				state = law.commit(i, placement.axesA.transpose() * stretch);
				force = placement.axesA * state.force;
			}
			springs.set(i, stretch, force);
			sum<double>(force, end, armB, state.energy, state.share);
			++intact;
			dissipated += state.dissipated;
			isSpent = isSpent || state.breaks;
		}
		JointForce total() const
		{
			return { sums.vector(0), sums.vector(3), sums.vector(6), sums[10], dissipated,
				intact > 0 ? sums[11] / intact : 1, largestSquared, sums[9], true, isSpent };
		}
	};
}

JointForce yieldingForces(
        SpringLaw& law, const JointPlacement& placement, const Vec3& axis, const JointSprings& springs)
{
	assert((axis.isZero() || isUnit(axis)) && isFinite(placement.distance));
	YieldingSprings all(law, placement, axis, springs);
	for (size_t first = 0; first < springs.count; first += laneCount) {
		if (all.addSteady(first)) continue;
		for (size_t i = first; i < std::min(springs.count, first + laneCount); ++i)
			if (springs.isIntact(i)) all.add(i);
	}
	return all.total();
}

bool isOverloaded(const JointStrength& limit, const JointForce& force)
{
	assert(limit.strength > 0);
	return limit.perJoint ? force.sum > limit.strength : force.largestSquared > limit.strength * limit.strength;
}

BreakCause breakCause(const SpringForce<double>& f)
{
	if (f.force.squaredNorm() > 2 * f.normal * f.normal) return BreakCause::Shear;
	return f.normal > 0 ? BreakCause::Tension : BreakCause::Compression;
}

std::vector<SpringBreak> springBreaks(const JointStiffness& k, const JointStrength& limit,
        const JointPlacement& placement, const Vec3& normal, const JointSprings& springs, const JointMotion& motion)
{
	assert(limit.strength > 0 && isValid(k) && isUnit(normal) && motion.h > 0);
	std::vector<SpringBreak> breaks;
	double sum = 0;
	for (const Vec3& force : springs.all(&JointSprings::force))
		sum += force.norm();
	for (size_t i = 0; i < springs.count; ++i) {
		const Vec3 force = springs.force(i);
		// Of the force at the placement: it breaks on the way
		const double share = limit.strength / (limit.perJoint ? sum : force.norm());
		const bool exceeds = limit.perJoint || force.squaredNorm() > limit.strength * limit.strength;
		if (!springs.isIntact(i) || !exceeds) continue;
		SpringForce<double> f = springForce<double>(k, springs.stretch(i), placement.axesA * normal);
		breaks.push_back({ i, breakCause(f), share * force.norm(),
		        energyAtBreak(f, placement.axesB * springs.anchorB(i), motion) });
	}
	return breaks;
}

std::vector<SpringBreak> spentSprings(const SpringLaw& law, const JointStiffness& k, const Mat3& axesA,
        const Vec3& normal, const JointSprings& springs)
{
	assert(isValid(k) && isUnit(normal));
	std::vector<SpringBreak> breaks;
	for (size_t i = 0; i < springs.count; ++i)
		if (springs.isIntact(i) && law.isSpent(i))
			breaks.push_back(
			        { i, breakCause(springForce<double>(k, springs.stretch(i), axesA * normal)), 0, 0 });
	return breaks;
}

BrittleSprings::BrittleSprings(const JointStiffness& k, const JointStrength& limit, const Vec3& normal)
        : stiffness(k.shear * Mat3::Identity() + (k.normal - k.shear) * normal * normal.transpose())
        , strength(limit)
{
	assert(isValid(k) && limit.strength > 0 && isUnit(normal));
}

SpringTrial BrittleSprings::elastic(const Vec3& stretch) const
{
	SpringTrial state;
	state.force = stiffness * stretch;
	state.tangent = stiffness;
	state.energy = state.force.dot(stretch) / 2;
	return state;
}

/// Shortens the force of an elastic state. The stretch beyond it is plastic in this step.
void BrittleSprings::weaken(SpringTrial& state, double share) const
{
	const double work = 2 * state.energy;
	const Vec3 pulled = stiffness * state.force;
	state.tangent.setZero();
	if (work > 0) state.tangent = share * (stiffness - pulled * pulled.transpose() / state.force.dot(pulled));
	state.force *= share;
	state.energy = share * share * work / 2;
	state.dissipated = share * (1 - share) * work;
	state.breaks = true;
}

SpringTrial BrittleSprings::trial(size_t, const Vec3& to, bool) const
{
	SpringTrial state = elastic(to);
	const double size = state.force.norm();
	if (!strength.perJoint && size > strength.strength) weaken(state, strength.strength / size);
	return state;
}

bool BrittleSprings::linearForces(std::vector<Vec3>& springs) const
{
	double sum = 0, largest = 0;
	for (Vec3& spring : springs) {
		spring = stiffness * spring;
		const double square = spring.squaredNorm();
		if (strength.perJoint) sum += std::sqrt(square);
		largest = std::max(largest, square);
	}
	return strength.perJoint ? sum <= strength.strength : largest <= strength.strength * strength.strength;
}

double BrittleSprings::limit(std::vector<SpringTrial>& states, std::vector<Vec3>& shared) const
{
	double sum = 0;
	for (const SpringTrial& s : states)
		sum += s.force.norm();
	if (!strength.perJoint || sum <= strength.strength) return 0;
	// Forces below `less` vanish, which leaves more to the others
	std::vector<double> sizes;
	for (const SpringTrial& s : states)
		sizes.push_back(s.force.norm());
	std::sort(sizes.begin(), sizes.end());
	size_t first = 0;
	double less = 0;
	for (;; sum -= sizes[first++]) {
		less = (sum - strength.strength) / double(sizes.size() - first);
		if (less < sizes[first]) break;
	}
	double softest = std::numeric_limits<double>::infinity();
	for (size_t i = 0; i < states.size(); ++i) {
		const double size = states[i].force.norm();
		shared[i] = size > less ? Vec3(states[i].force / size) : Vec3(Vec3::Zero());
		weaken(states[i], size > less ? 1 - less / size : 0);
		if (size <= less) continue;
		const double k = shared[i].dot(stiffness * shared[i]);
		states[i].tangent += k * shared[i] * shared[i].transpose();
		softest = std::min(softest, k);
	}
	return softest / double(states.size() - first);
}

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint_law.hpp"

namespace timber {

JointPull pullSprings(const JointStiffness& k, const JointPlacement& place, const Vec3& normal, const std::vector<Vec3>& anchorsA, const std::vector<Vec3>& anchorsB,
        const std::vector<int>& broken, std::vector<Vec3>& stretches, std::vector<Vec3>& forces)
{
	JointPull pull;
	Sums<11> sums;
	const Vec3 worldNormal = place.axesA * normal;
	inLanes(broken.size(), [&](auto number, size_t i) {
		using Number = decltype(number);
		using Vec = Vec3Of<Number>;
		const size_t count = broken.size() - i;
		const auto vectors = [&](const std::vector<Vec3>& of) -> Vec { return Group<Number, const Vec3>(&of[i], count).vectors(); };
		const auto whole = Group<Number, const int>(&broken[i], count).numbers() <= Number(0.);
		const Vec armB = wide<Number>(place.axesB) * vectors(anchorsB), armA = wide<Number>(place.axesA) * vectors(anchorsA), end = wide<Number>(place.apart) + armB;
		const Vec stretch = where(whole, Vec(end - armA), Vec(Vec::Constant(Number(0.))));
		const SpringForce<Number> f = springForce<Number>(k, stretch, worldNormal);
		Group<Number, Vec3>(&stretches[i], count).set(stretch);
		Group<Number, Vec3>(&forces[i], count).set(f.force);
		const Number square = f.force.squaredNorm();
		const Vec torqueA = end.cross(f.force), torqueB = -armB.cross(f.force); // unequal stiffnesses: the force leaves the line of the ends, both bodies take it in one point
		sums.add<Number>(count, f.force, torqueA, torqueB, f.energy, root(square));
		for (size_t l = 0; l < laneCount; ++l)
			pull.largest = std::max(pull.largest, lane(square, l));
	});
	pull.force = sums.vector(0);
	pull.torqueA = sums.vector(3);
	pull.torqueB = sums.vector(6);
	pull.energy = sums[9];
	pull.sum = sums[10];
	return pull;
}

} // namespace timber

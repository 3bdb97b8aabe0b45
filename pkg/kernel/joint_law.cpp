// SPDX-License-Identifier: GPL-2.0-or-later
#include "joint_law.hpp"

namespace timber {

JointPull pullSprings(const JointStiffness& k, const JointPlacement& place, const Vec3& normal, const std::vector<Vec3>& anchorsA, const std::vector<Vec3>& anchorsB,
        const std::vector<int>& broken, std::vector<Vec3>& stretches, std::vector<Vec3>& forces)
{
	JointPull pull;
	const Vec3 worldNormal = place.axesA * normal;
	const Vec3s apart = wide<Lanes>(place.apart), none = Vec3s::Constant(Lanes(0.));
	for (size_t i = 0; i < broken.size(); i += laneCount) {
		const size_t count = broken.size() - i;
		const auto vectors = [&](const std::vector<Vec3>& of) { return Group<const Vec3>(&of[i], count).vectors(); };
		const Lanes::Mask whole = Group<const int>(&broken[i], count).numbers() <= Lanes(0.);
		const Vec3s armB = wide<Lanes>(place.axesB) * vectors(anchorsB);
		const Vec3s stretch = where(whole, Vec3s(apart + armB - wide<Lanes>(place.axesA) * vectors(anchorsA)), none);
		const SpringForce<Lanes> f = springForce<Lanes>(k, stretch, worldNormal);
		Group<Vec3>(&stretches[i], count).set(stretch);
		Group<Vec3>(&forces[i], count).set(f.force);
		const Lanes square = f.force.squaredNorm(), size = sqrt(square);
		addUp(pull.energy, f.energy, count);
		addUp(pull.force, f.force, count);
		addUp(pull.torqueA, (apart + armB).cross(f.force), count); // unequal stiffnesses: the force leaves the line of the ends, both bodies take it in one point
		addUp(pull.torqueB, -armB.cross(f.force), count);
		addUp(pull.sum, size, count);
		for (int lane = 0; lane < laneCount; ++lane)
			pull.largest = std::max(pull.largest, square.v[lane]);
	}
	return pull;
}

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
/// Prepare phase of contact points: coefficients of equations (2) to (7) of docs/theory.md, section 5, and (8) of
/// contact_solver.hpp, whose glossary explains the symbols.
#pragma once
#include "contact_point.hpp"
#include "kinematics.hpp"

namespace timber {

/// Physics of a contact point in a step, or of a group of points.
template <class Number> struct StepInput {
	Vec3Of<Number> armA, armB; ///< from the centres of mass to the point [m]
	Vec3Of<Number> normal; ///< unit, from A to B
	Number elasticNormal; ///< e_n >= 0 [N]
	Vec3Of<Number> elasticShear; ///< e_s on B, before Coulomb's limit [N]
	Number normalDamping, shearDamping; ///< C_n, C_s [N s/m]
	Number friction; ///< mu [-]
	Vec3Of<Number> impulse; ///< warm start: estimate of the contact impulse on B [N s]
	Number normalStiffness = 0., shearStiffness = 0.; ///< K_n, K_s [N/m]
	Number energy = unlimitedEnergy, shearEnergy = unlimitedEnergy; ///< A_n, A_s [J]
	Number hardening = 0.; ///< c n_0^q: part of the normal force that hardens; 0: linear spring [N]
	Number overlap = 0., overlapLeft = 0.; ///< n_0, and how much it may grow until the force is constant [m]
	double exponent = 1; ///< q [-]
	Number strength = unlimitedEnergy; ///< F_Y [N]

	/// A_n and A_s of a point without rule (5) [J], strength of an elastic one [N].
	static constexpr double unlimitedEnergy = std::numeric_limits<double>::infinity();
};

/// Prepares a point, or a group of laneCount points of which the first `count` exist, for a step of h [s]. at(i):
/// PointStep of the i-th.
template <class Number, class At>
void prepareSteps(const StepInput<Number>& p, const SolverBodies& bodies, double h, size_t count, At at);

/// Impulse of explicit springs and dashpots (Eqs. 17, 18, 21-24). As in the paper, the elastic force alone decides
/// whether a point slides, and a sliding point has no dashpot. With long steps this rule makes loaded light members
/// chatter between the limits.
template <class Number>
Vec3Of<Number> explicitImpulse(const StepInput<Number>& p, const SolverBodies& bodies, double h);

namespace detail {

	/// Coefficients of (2) in one direction of a point.
	template <class Number> struct ImplicitDirection {
		Number old; ///< Q: weight of the velocity before the step [kg]
		Number mass, factor; ///< M [kg], f [-]
		Number scale; ///< 1 / (1 + a D) [-]

		/// hC: h C [kg]; hhK: h2 K [kg]; a: response [1/kg].
		ImplicitDirection(Number hC, Number hhK, Number a)
		{
			const Number x = hC * a, theta = Number(0.5) + x / (Number(12.) + Number(2.) * x);
			const Number y = hhK * a, newmark = hhK * (y / (Number(4.) * y + Number(2.))); // beta h2 K
			const Number D = hC * theta + newmark;
			old = newmark - hC * (Number(1.) - theta);
			scale = Number(1.) / (Number(1.) + D * a);
			mass = scale * D;
			factor = mass * a;
		}
	};

	/// A tangent without branches, continuous but at n.z = 0 (Duff et al., J. Comput. Graph. Tech. 6 (2017), 1).
	template <class Number> Vec3Of<Number> tangentOf(const Vec3Of<Number>& n)
	{
		const Number sign = select(n.z() < Number(0.), Number(-1.), Number(1.)),
		             a = Number(-1.) / (sign + n.z());
		return { Number(1.) + sign * n.x() * n.x() * a, sign * n.x() * n.y() * a, -sign * n.x() };
	}

	/// Rows of J R (8) for one body. sign: -1 for A, 1 for B; first: index of the body's first number.
	template <class Number>
	[[gnu::always_inline]] inline void setRows(Number (*rows)[12], const Vec3Of<Number>* axes,
	        const Vec3Of<Number>& arm, const InverseRootMass& root, double sign, int first)
	{
		for (int i = 0; i < 3; ++i) {
			const Vec3Of<Number> linear = Number(sign * root.linear) * axes[i],
			                     angular = Number(sign) * root.weightedTorque<Number>(arm.cross(axes[i]));
			for (int c = 0; c < 3; ++c) {
				rows[i][first + c] = linear[c];
				rows[i][first + 3 + c] = angular[c];
			}
		}
	}

	template <class Number> [[gnu::always_inline]] inline Number product(const Number (*rows)[12], int i, int j)
	{
		Number sum = rows[i][0] * rows[j][0];
		for (int c = 1; c < 12; ++c)
			sum += rows[i][c] * rows[j][c];
		return sum;
	}

	/// Four numbers of each point of a group: quad(i) of the i-th of `count` points.
	template <class Number, class QuadOf>
	[[gnu::always_inline]] inline void storeQuads(const Number* x, size_t count, QuadOf quad)
	{
		if constexpr (std::is_same_v<Number, Lanes> && laneCount == 4) {
			Number four[4] = { x[0], x[1], x[2], x[3] };
			transpose(four);
			for (size_t i = 0; i < count; ++i)
				quad(i) = four[i].v;
		} else
			for (size_t i = 0; i < count; ++i)
				quad(i) = PairVector::Quad { lane(x[0], i), lane(x[1], i), lane(x[2], i),
					lane(x[3], i) };
	}

} // namespace detail

template <class Number, class At>
void prepareSteps(const StepInput<Number>& p, const SolverBodies& bodies, double h, size_t count, At at)
{
	using namespace detail;
	using Vec = Vec3Of<Number>;
	const Vec tangent = tangentOf<Number>(p.normal), axes[3] { p.normal, tangent, p.normal.cross(tangent) };
	Number rows[3][12];
	setRows<Number>(rows, axes, p.armA, bodies.rootA, -1, 0);
	setRows<Number>(rows, axes, p.armB, bodies.rootB, 1, 6);
	Number column[4],
	        across[4] { product<Number>(rows, 1, 1), product<Number>(rows, 1, 2), product<Number>(rows, 2, 2),
		        Number(0.) };
	for (int i = 0; i < 3; ++i)
		column[i] = product<Number>(rows, 0, i);
	const Number half = (across[0] - across[2]) / Number(2.),
	             // a_s
	        largest = (across[0] + across[2]) / Number(2.) + sqrt(Number(half * half + across[1] * across[1]));
	const ImplicitDirection<Number> normal(
	        Number(h) * p.normalDamping, Number(h * h) * p.normalStiffness, column[0]);
	const ImplicitDirection<Number> shear(Number(h) * p.shearDamping, Number(h * h) * p.shearStiffness, largest);
	const Vec velocityBefore = bodies.velocityBefore<Number>(p.armA, p.armB),
	          present = bodies.velocity<Number>(p.armA, p.armB);
	Number before[4], velocity[4], impulse[4], factor[4], bias[4], mass[4];
	for (int i = 0; i < 3; ++i) {
		const ImplicitDirection<Number>& direction = i == 0 ? normal : shear;
		const Number elastic = i == 0 ? p.elasticNormal : p.elasticShear.dot(axes[i]);
		before[i] = velocityBefore.dot(axes[i]);
		velocity[i] = present.dot(axes[i]);
		impulse[i] = p.impulse.dot(axes[i]);
		factor[i] = direction.factor;
		mass[i] = direction.mass;
		bias[i] = direction.scale * (Number(h) * elastic + direction.old * before[i]);
	}
	for (Number* quad : { before, velocity, impulse, factor, bias, mass, column })
		quad[3] = Number(0.);
	for (int r = 0; r < 3; ++r)
		for (int part = 0; part < 3; ++part)
			storeQuads(rows[r] + 4 * part, count,
			        [&](size_t i) -> PointStep::Quad& { return at(i).rows[r].part[part]; });
	const auto store = [&](const Number* quad, PointStep::Quad PointStep::*member) {
		storeQuads(quad, count, [&](size_t i) -> PointStep::Quad& { return at(i).*member; });
	};
	store(before, &PointStep::before);
	store(velocity, &PointStep::velocity);
	store(impulse, &PointStep::impulse);
	store(factor, &PointStep::factor);
	store(bias, &PointStep::bias);
	store(mass, &PointStep::mass);
	store(column, &PointStep::column);
	store(across, &PointStep::shearResponse);
	for (size_t i = 0; i < count; ++i) {
		PointStep& s = at(i);
		s.friction = lane(p.friction, i);
		s.rebound = noRebound;
		s.energy = lane(p.energy, i);
		s.shearEnergy = lane(p.shearEnergy, i);
		// Without a displacement left, or a response, (7) is (2)
		s.hardening = lane(p.overlapLeft, i) > 0 && lane(column[0], i) > 0 ? lane(p.hardening, i) : 0;
		s.overlap = lane(p.overlap, i);
		s.overlapLeft = lane(p.overlapLeft, i);
		s.damping = lane(p.normalDamping, i);
		s.exponent = p.exponent;
		s.step = h;
		s.strength = h * lane(p.strength, i);
		s.bounded = s.idle = false;
		for (int c = 0; c < 3; ++c)
			s.axes[c] = lane(axes[c], i);
		s.armA = lane(p.armA, i);
		s.armB = lane(p.armB, i);
	}
}

template <class Number> Vec3Of<Number> explicitImpulse(const StepInput<Number>& p, const SolverBodies& bodies, double h)
{
	const Vec3Of<Number> v = bodies.velocityBefore<Number>(p.armA, p.armB);
	const Number vn = v.dot(p.normal);
	const Number normalForce = min(max(Number(0.), Number(p.elasticNormal - p.normalDamping * vn)), p.strength),
	             limit = p.friction * normalForce;
	const Vec3Of<Number> dashpotForce = p.shearDamping * (v - vn * p.normal);
	const Vec3Of<Number> shearForce = selectLazily(
	        p.elasticShear.squaredNorm() > limit * limit, [&] { return p.elasticShear; },
	        [&] { return Vec3Of<Number>(p.elasticShear - dashpotForce); });
	return Number(h) * (normalForce * p.normal + clipped(shearForce, limit));
}

} // namespace timber

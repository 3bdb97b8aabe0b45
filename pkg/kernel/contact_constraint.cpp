// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_constraint.hpp"

namespace timber {
namespace {

	/// Coefficients of (2) in one direction of a point.
	template <class Number> struct ImplicitDirection {
		Number G; ///< weight of the velocity before the step [kg]
		Number mass, factor; ///< M [kg], f [-]
		Number scale; ///< 1 / (1 + a D) [-]

		/// hC: h C [kg]; hhK: h2 K [kg]; a: response [1/kg].
		ImplicitDirection(Number hC, Number hhK, Number a)
		{
			const Number x = hC * a, theta = Number(0.5) + x / (Number(12.) + Number(2.) * x);
			const Number y = hhK * a, newmark = hhK * (y / (Number(4.) * y + Number(2.))); // beta h2 K
			const Number D = hC * theta + newmark;
			G = newmark - hC * (Number(1.) - theta);
			scale = Number(1.) / (Number(1.) + D * a);
			mass = scale * D;
			factor = mass * a;
		}
	};

	/// A tangent without branches, continuous but at n.z = 0 (Duff et al., J. Comput. Graph. Tech. 6 (2017), 1).
	template <class Number> Vec3Of<Number> tangentOf(const Vec3Of<Number>& n)
	{
		const Number sign = select(n.z() < Number(0.), Number(-1.), Number(1.)), a = Number(-1.) / (sign + n.z());
		return { Number(1.) + sign * n.x() * n.x() * a, sign * n.x() * n.y() * a, -sign * n.x() };
	}

	/// Normal, tangent and second tangent.
	template <class Number> struct PointAxes {
		Vec3Of<Number> axes[3];

		explicit PointAxes(const ContactConstraint<Number>& c)
		        : axes { c.normal, c.tangent, c.normal.cross(c.tangent) }
		{
		}
		void project(const Vec3Of<Number>& v, Number* components) const
		{
			for (int i = 0; i < 3; ++i)
				components[i] = v.dot(axes[i]);
		}
		Vec3Of<Number> combine(const Number* components) const { return components[0] * axes[0] + components[1] * axes[1] + components[2] * axes[2]; }
	};

	/// Rows of G. sign: -1 for A, 1 for B; first: index of the body's first number.
	template <class Number>
	[[gnu::always_inline]] inline void setRows(
	        Number (*rows)[12], const PointAxes<Number>& at, const Vec3Of<Number>& arm, const InverseRootMass& root, double sign, int first)
	{
		for (int i = 0; i < 3; ++i) {
			const Vec3Of<Number> linear = Number(sign * root.linear) * at.axes[i],
			                     angular = Number(sign) * root.weightedTorque<Number>(arm.cross(at.axes[i]));
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

	/// Largest eigenvalue of the response to tangential impulses, a_s. [1/kg]
	template <class Number> Number shearResponse(const Number (*rows)[12])
	{
		const Number tt = product(rows, 1, 1), tu = product(rows, 1, 2), uu = product(rows, 2, 2), half = (tt - uu) / Number(2.);
		return (tt + uu) / Number(2.) + sqrt(Number(half * half + tu * tu));
	}

	/// Four numbers of each point of a group: quad(i) of the i-th of `count` points.
	template <class Number, class QuadOf> [[gnu::always_inline]] inline void storeQuads(const Number* x, size_t count, QuadOf quad)
	{
		if constexpr (std::is_same_v<Number, Lanes> && laneCount == 4) {
			Number four[4] = { x[0], x[1], x[2], x[3] };
			transpose(four);
			for (size_t i = 0; i < count; ++i)
				quad(i) = four[i].v;
		} else
			for (size_t i = 0; i < count; ++i)
				quad(i) = PairVector::Quad { lane(x[0], i), lane(x[1], i), lane(x[2], i), lane(x[3], i) };
	}

} // namespace

template <class Number>
PreparedPoint<Number>::PreparedPoint(
        const ContactInput<Number>& p, const SolverBody& a, const SolverBody& b, const InverseRootMass& rootA, const InverseRootMass& rootB, double h)
{
	ContactConstraint<Number>& c = constraint;
	c.armA = p.armA;
	c.armB = p.armB;
	c.normal = p.normal;
	c.tangent = tangentOf<Number>(p.normal);
	c.impulse = p.impulse;
	c.release = p.release;
	c.energy = p.energy;
	c.rebound = noRebound;
	const PointAxes<Number> at(c);
	setRows<Number>(rows, at, p.armA, rootA, -1, 0);
	setRows<Number>(rows, at, p.armB, rootB, 1, 6);
	c.response = product<Number>(rows, 0, 0);
	const ImplicitDirection<Number> normal(Number(h) * p.normalDamping, Number(h * h) * p.normalStiffness, c.response);
	const ImplicitDirection<Number> shear(Number(h) * p.shearDamping, Number(h * h) * p.shearStiffness, shearResponse<Number>(rows));
	Number before[3], elastic[3];
	at.project(relativeVelocity<Number>(p.armA, p.armB, a.velocity, a.spin, b.velocity, b.spin), before);
	at.project(relativeVelocity<Number>(p.armA, p.armB, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin), velocity);
	at.project(p.impulse, impulse);
	at.project(p.elasticShear, elastic);
	elastic[0] = p.elasticNormal;
	for (int i = 0; i < 3; ++i) {
		const ImplicitDirection<Number>& direction = i == 0 ? normal : shear;
		factor[i] = direction.factor;
		mass[i] = direction.mass;
		bias[i] = direction.scale * (Number(h) * elastic[i] + direction.G * before[i]);
		coupling[i] = i == 0 ? Number(0.) : shear.mass * product<Number>(rows, 0, i);
	}
	for (Quad* quad : { &velocity, &impulse, &factor, &bias, &mass, &coupling })
		(*quad)[3] = Number(0.);
	friction = p.friction;
	hardening = p.hardening;
	overlap = p.overlap;
	damping = p.normalDamping;
	closing = max(Number(0.), Number(-Number(h) * before[0]));
	step = h;
}

template <class Number> void PreparedPoint<Number>::store(SweepPoint* to, size_t count) const
{
	for (int r = 0; r < 3; ++r)
		for (int part = 0; part < 3; ++part)
			storeQuads(rows[r] + 4 * part, count, [&](size_t i) -> SweepPoint::Quad& { return to[i].rows[r].part[part]; });
	const auto store = [&](const Quad& quad, SweepPoint::Quad SweepPoint::*member) {
		storeQuads(quad, count, [&](size_t i) -> SweepPoint::Quad& { return to[i].*member; });
	};
	store(velocity, &SweepPoint::velocity);
	store(impulse, &SweepPoint::impulse);
	store(factor, &SweepPoint::factor);
	store(bias, &SweepPoint::bias);
	store(mass, &SweepPoint::mass);
	store(coupling, &SweepPoint::coupling);
	for (size_t i = 0; i < count; ++i) {
		to[i].friction = lane(friction, i);
		to[i].rebound = noRebound;
		to[i].release = lane(constraint.release, i);
		to[i].response = lane(constraint.response, i);
		to[i].energy = lane(constraint.energy, i);
		to[i].hardening = lane(hardening, i);
		to[i].overlap = lane(overlap, i);
		to[i].damping = lane(damping, i);
		to[i].closing = lane(closing, i);
		to[i].step = step;
	}
}

template struct PreparedPoint<double>;
template struct PreparedPoint<Lanes>;

template <class Number> Vec3Of<Number> explicitImpulse(const ContactInput<Number>& p, const SolverBody& a, const SolverBody& b, double h)
{
	const Vec3Of<Number> v = relativeVelocity<Number>(p.armA, p.armB, a.velocity, a.spin, b.velocity, b.spin);
	const Number vn = v.dot(p.normal);
	const Number normalForce = max(Number(0.), Number(p.elasticNormal - p.normalDamping * vn)), limit = p.friction * normalForce;
	const Vec3Of<Number> dashpotForce = p.shearDamping * (v - vn * p.normal);
	const Vec3Of<Number> shearForce = selectLazily(
	        p.elasticShear.squaredNorm() > limit * limit, [&] { return p.elasticShear; }, [&] { return Vec3Of<Number>(p.elasticShear - dashpotForce); });
	return Number(h) * (normalForce * p.normal + clipped<Number>(shearForce, limit));
}
template Vec3 explicitImpulse(const ContactInput<double>&, const SolverBody&, const SolverBody&, double);
template Vec3s explicitImpulse(const ContactInput<Lanes>&, const SolverBody&, const SolverBody&, double);

Vec3s worldImpulse(const ContactConstraint<Lanes>& c, const Lanes* impulse) { return PointAxes<Lanes>(c).combine(impulse); }

} // namespace timber

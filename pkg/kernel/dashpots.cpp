// SPDX-License-Identifier: GPL-2.0-or-later
#include "dashpots.hpp"
#include <algorithm>
#include <cmath>

namespace timber {
namespace {

	Mat3 skew(const Vec3& r)
	{
		Mat3 m;
		m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
		return m;
	}

	Mat3 pointResponse(const DashpotBody& body, const Vec3& arm)
	{
		const Mat3 s = skew(arm);
		return body.inverseMass * Mat3::Identity() - s * body.inverseInertia * s;
	}

	/// Largest response to a unit impulse in the plane normal to n. [1/kg]
	double largestShearResponse(const Mat3& response, const Vec3& n)
	{
		const Vec3 t = n.unitOrthogonal(), u = n.cross(t);
		const Vec3 rt = response * t;
		const double tt = t.dot(rt), tu = u.dot(rt), uu = u.dot(response * u);
		return (tt + uu) / 2 + std::hypot((tt - uu) / 2, tu);
	}

	/// theta of the step and the divisor of the residual, for a dashpot C that acts on the response a.
	void setDashpot(double h, double damping, double a, double& theta, double& divisor)
	{
		const double x = h * damping * a;
		theta = 0.5 + x / (12 + 2 * x);
		divisor = 1 + theta * x;
	}

	void apply(std::vector<DashpotBody>& bodies, const DashpotPoint& p, const Vec3& impulse)
	{
		DashpotBody &a = bodies[p.bodyA], &b = bodies[p.bodyB];
		a.newVelocity -= a.inverseMass * impulse;
		a.newSpin -= a.inverseInertia * p.armA.cross(impulse);
		b.newVelocity += b.inverseMass * impulse;
		b.newSpin += b.inverseInertia * p.armB.cross(impulse);
	}

	Vec3 clipped(const Vec3& v, double length)
	{
		const double norm = v.norm();
		return norm > length ? Vec3(v * (length / norm)) : v;
	}

	/// Tangential impulse for a normal impulse: the spring slides when it alone exceeds the limit, and then has no
	/// dashpot; spring and dashpot together never exceed it.
	Vec3 limitedTangential(const DashpotPoint& p, const Vec3& tangential, double h, double normalImpulse)
	{
		const double limit = p.friction * normalImpulse;
		return clipped(h * p.elasticShear.norm() > limit ? Vec3(h * p.elasticShear) : tangential, limit);
	}

	void prepare(const std::vector<DashpotBody>& bodies, DashpotPoint& p, double h)
	{
		const DashpotBody &a = bodies[p.bodyA], &b = bodies[p.bodyB];
		p.before = relativeVelocity(p, a.velocity, a.spin, b.velocity, b.spin);
		p.response = pointResponse(a, p.armA) + pointResponse(b, p.armB);
		setDashpot(h, p.normalDamping, p.normal.dot(p.response * p.normal), p.normalTheta, p.normalDivisor);
		setDashpot(h, p.shearDamping, largestShearResponse(p.response, p.normal), p.shearTheta, p.shearDivisor);
	}

	void relax(std::vector<DashpotBody>& bodies, DashpotPoint& p, double h)
	{
		const DashpotBody &a = bodies[p.bodyA], &b = bodies[p.bodyB];
		Vec3 v = relativeVelocity(p, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin);
		const double normal = p.impulse.dot(p.normal);
		const Vec3 tangential = p.impulse - normal * p.normal;

		const double meanNormal = (1 - p.normalTheta) * p.before.dot(p.normal) + p.normalTheta * v.dot(p.normal);
		const double dashpot = normal - h * p.elasticNormal;
		const double newNormal = std::max(0., normal - (h * p.normalDamping * meanNormal + dashpot) / p.normalDivisor);
		v += p.response * p.normal * (newNormal - normal);

		Vec3 mean = (1 - p.shearTheta) * p.before + p.shearTheta * v;
		mean -= mean.dot(p.normal) * p.normal;
		const Vec3 shearDashpot = tangential - h * p.elasticShear;
		const Vec3 free = tangential - (h * p.shearDamping * mean + shearDashpot) / p.shearDivisor;
		const Vec3 impulse = newNormal * p.normal + limitedTangential(p, free, h, newNormal);
		apply(bodies, p, impulse - p.impulse);
		p.impulse = impulse;
	}

	void explicitImpulse(const std::vector<DashpotBody>& bodies, DashpotPoint& p, double h)
	{
		const DashpotBody &a = bodies[p.bodyA], &b = bodies[p.bodyB];
		p.before = relativeVelocity(p, a.velocity, a.spin, b.velocity, b.spin);
		const double vn = p.before.dot(p.normal);
		const double normal = std::max(0., h * (p.elasticNormal - p.normalDamping * vn));
		const Vec3 free = h * (p.elasticShear - p.shearDamping * (p.before - vn * p.normal));
		p.impulse = normal * p.normal + limitedTangential(p, free, h, normal);
	}

} // namespace

Vec3 limitedShear(const Vec3& elasticShear, double friction, double normalForce) { return clipped(elasticShear, friction * normalForce); }

void solveDashpots(std::vector<DashpotBody>& bodies, std::vector<DashpotPoint>& points, double h, int sweeps)
{
	for (DashpotPoint& p : points) {
		if (sweeps == 0) explicitImpulse(bodies, p, h);
		else
			prepare(bodies, p, h);
	}
	for (DashpotPoint& p : points)
		apply(bodies, p, p.impulse);
	for (int sweep = 0; sweep < sweeps; ++sweep) {
		if (sweep % 2 == 0)
			for (DashpotPoint& p : points)
				relax(bodies, p, h);
		else
			for (auto p = points.rbegin(); p != points.rend(); ++p)
				relax(bodies, *p, h);
	}
}

} // namespace timber

// SPDX-License-Identifier: GPL-2.0-or-later
#include "dashpots.hpp"
#include <algorithm>
#include <cmath>

namespace timber {
namespace {

	/// Change of a body's velocity at the arm per unit impulse there: 1/m - [r] I^-1 [r]. [1/kg]
	Mat3 pointResponse(const DashpotBody& body, const Vec3& arm)
	{
		Mat3 s;
		s << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
		Mat3 response = -(s * body.inverseInertia * s);
		response.diagonal().array() += body.inverseMass;
		return response;
	}

	/// Largest response to a unit impulse in the plane normal to n. [1/kg]
	double largestShearResponse(const Mat3& response, const Vec3& n)
	{
		const Vec3 t = n.unitOrthogonal(), u = n.cross(t);
		const Vec3 rt = response * t;
		const double tt = t.dot(rt), tu = u.dot(rt), uu = u.dot(response * u);
		return (tt + uu) / 2 + std::sqrt((tt - uu) * (tt - uu) / 4 + tu * tu);
	}

	/// theta of the step and the gain of a correction, for a dashpot of rate h C against the response a.
	void setDashpot(double rate, double a, double& theta, double& gain)
	{
		const double x = rate * a;
		theta = 0.5 + x / (12 + 2 * x);
		gain = 1 / (1 + theta * x);
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
		const double square = v.squaredNorm();
		return square > length * length ? Vec3(v * (length / std::sqrt(square))) : v;
	}

	/// Tangential impulse under a Coulomb limit [N s]: the spring slides when it alone exceeds the limit, and then has no
	/// dashpot; spring and dashpot together never exceed it.
	Vec3 limitedTangential(const Vec3& elastic, double elasticNorm, const Vec3& withDashpot, double limit)
	{
		return elasticNorm > limit ? Vec3(elastic * (limit / elasticNorm)) : clipped(withDashpot, limit);
	}

	void explicitImpulse(const std::vector<DashpotBody>& bodies, DashpotPoint& p, double h)
	{
		const DashpotBody &a = bodies[p.bodyA], &b = bodies[p.bodyB];
		p.before = relativeVelocity(p, a.velocity, a.spin, b.velocity, b.spin);
		const double vn = p.before.dot(p.normal);
		const double normal = std::max(0., h * (p.elasticNormal - p.normalDamping * vn));
		const Vec3 withDashpot = h * (p.elasticShear - p.shearDamping * (p.before - vn * p.normal));
		p.impulse = normal * p.normal + limitedTangential(h * p.elasticShear, h * p.elasticShear.norm(), withDashpot, p.friction * normal);
	}

} // namespace

Vec3 limitedShear(const Vec3& elasticShear, double friction, double normalForce) { return clipped(elasticShear, friction * normalForce); }

DashpotSolver::Row DashpotSolver::prepare(const std::vector<DashpotBody>& bodies, DashpotPoint& p, double h)
{
	const DashpotBody &a = bodies[p.bodyA], &b = bodies[p.bodyB];
	p.before = relativeVelocity(p, a.velocity, a.spin, b.velocity, b.spin);
	const double vn = p.before.dot(p.normal);
	const Mat3 response = pointResponse(a, p.armA) + pointResponse(b, p.armB);
	Row row;
	row.normalResponse = response * p.normal;
	row.normalRate = h * p.normalDamping;
	row.shearRate = h * p.shearDamping;
	setDashpot(row.normalRate, p.normal.dot(row.normalResponse), row.normalTheta, row.normalGain);
	setDashpot(row.shearRate, largestShearResponse(response, p.normal), row.shearTheta, row.shearGain);
	row.elasticShear = h * p.elasticShear;
	row.elasticShearNorm = row.elasticShear.norm();
	row.normalTarget = h * p.elasticNormal - row.normalRate * (1 - row.normalTheta) * vn;
	row.shearTarget = row.elasticShear - row.shearRate * (1 - row.shearTheta) * (p.before - vn * p.normal);
	return row;
}

/// Returns the squared change of the impulse. [N2 s2]
double DashpotSolver::relax(std::vector<DashpotBody>& bodies, DashpotPoint& p, const Row& row)
{
	const DashpotBody &a = bodies[p.bodyA], &b = bodies[p.bodyB];
	Vec3 v = relativeVelocity(p, a.newVelocity, a.newSpin, b.newVelocity, b.newSpin);
	const double normal = p.impulse.dot(p.normal);
	const double normalError = normal - row.normalTarget + row.normalRate * row.normalTheta * v.dot(p.normal);
	const double newNormal = std::max(0., normal - row.normalGain * normalError);

	v += (newNormal - normal) * row.normalResponse;
	const Vec3 tangential = p.impulse - normal * p.normal;
	const Vec3 shearError = tangential - row.shearTarget + row.shearRate * row.shearTheta * (v - v.dot(p.normal) * p.normal);
	const Vec3 impulse = newNormal * p.normal + limitedTangential(row.elasticShear, row.elasticShearNorm, tangential - row.shearGain * shearError, p.friction * newNormal);
	const Vec3 change = impulse - p.impulse;
	apply(bodies, p, change);
	p.impulse = impulse;
	return change.squaredNorm();
}

/// Returns the squared change of all impulses. [N2 s2]
double DashpotSolver::sweep(std::vector<DashpotBody>& bodies, std::vector<DashpotPoint>& points, bool forwards)
{
	const size_t count = points.size();
	double change = 0;
	for (size_t k = 0; k < count; ++k) {
		const size_t place = forwards ? k : count - 1 - k;
		change += relax(bodies, points[place], rows[place]);
	}
	return change;
}

int DashpotSolver::solve(std::vector<DashpotBody>& bodies, std::vector<DashpotPoint>& points, double h, int sweeps, double tolerance)
{
	const size_t count = points.size();
	rows.resize(count);
	for (size_t k = 0; k < count; ++k) {
		if (sweeps == 0) explicitImpulse(bodies, points[k], h);
		else
			rows[k] = prepare(bodies, points[k], h);
	}
	for (const DashpotPoint& p : points)
		apply(bodies, p, p.impulse);
	for (int done = 0; done < sweeps; ++done) {
		const double change = sweep(bodies, points, done % 2 == 0);
		double size = 0;
		for (const DashpotPoint& p : points)
			size += p.impulse.squaredNorm();
		if (change <= tolerance * tolerance * size) return done + 1;
	}
	return sweeps;
}

} // namespace timber

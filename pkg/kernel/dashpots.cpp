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

	PointResponse responseAt(const DashpotBody& a, const DashpotBody& b, const DashpotPoint& p)
	{
		const Mat3 response = pointResponse(a, p.armA) + pointResponse(b, p.armB);
		return { response * p.normal, largestShearResponse(response, p.normal) };
	}

	/// theta of the step and the gain of a correction, for a dashpot of rate h C against the response a.
	void setDashpot(double rate, double a, double& theta, double& gain)
	{
		const double x = rate * a;
		theta = 0.5 + x / (12 + 2 * x);
		gain = 1 / (1 + theta * x);
	}

	void apply(DashpotBody& a, DashpotBody& b, const Vec3& armA, const Vec3& armB, const Vec3& impulse)
	{
		a.newVelocity -= a.inverseMass * impulse;
		a.newSpin -= a.inverseInertia * armA.cross(impulse);
		b.newVelocity += b.inverseMass * impulse;
		b.newSpin += b.inverseInertia * armB.cross(impulse);
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
	if (p.response.shear < 0) p.response = responseAt(a, b, p);
	Row row;
	row.armA = p.armA;
	row.armB = p.armB;
	row.normal = p.normal;
	row.impulse = p.impulse;
	row.normalResponse = p.response.normal;
	double normalTheta, shearTheta;
	setDashpot(h * p.normalDamping, p.normal.dot(row.normalResponse), normalTheta, row.normalGain);
	setDashpot(h * p.shearDamping, p.response.shear, shearTheta, row.shearGain);
	row.normalRate = h * p.normalDamping * normalTheta;
	row.shearRate = h * p.shearDamping * shearTheta;
	row.elasticShear = h * p.elasticShear;
	row.elasticShearNorm = row.elasticShear.norm();
	row.normalTarget = h * p.elasticNormal - h * p.normalDamping * (1 - normalTheta) * vn;
	row.shearTarget = row.elasticShear - h * p.shearDamping * (1 - shearTheta) * (p.before - vn * p.normal);
	row.friction = p.friction;
	return row;
}

void DashpotSolver::relax(std::vector<DashpotBody>& bodies, Block& block, bool forwards)
{
	DashpotBody &a = bodies[block.bodyA], &b = bodies[block.bodyB];
	block.change = 0;
	for (size_t k = 0; k < block.count; ++k) {
		Row& row = rows[block.first + (forwards ? k : block.count - 1 - k)];
		Vec3 v = b.newVelocity + b.newSpin.cross(row.armB) - a.newVelocity - a.newSpin.cross(row.armA);
		const double normal = row.impulse.dot(row.normal);
		const double normalError = normal - row.normalTarget + row.normalRate * v.dot(row.normal);
		const double newNormal = std::max(0., normal - row.normalGain * normalError);

		v += (newNormal - normal) * row.normalResponse;
		const Vec3 tangential = row.impulse - normal * row.normal;
		const Vec3 shearError = tangential - row.shearTarget + row.shearRate * (v - v.dot(row.normal) * row.normal);
		const Vec3 impulse = newNormal * row.normal + limitedTangential(row.elasticShear, row.elasticShearNorm, tangential - row.shearGain * shearError, row.friction * newNormal);
		const Vec3 change = impulse - row.impulse;
		apply(a, b, row.armA, row.armB, change);
		row.impulse = impulse;
		block.change += change.squaredNorm();
	}
}

void DashpotSolver::collectBlocks(const std::vector<DashpotPoint>& points)
{
	blocks.clear();
	for (size_t k = 0; k < points.size(); ++k) {
		const DashpotPoint& p = points[k];
		if (blocks.empty() || blocks.back().bodyA != p.bodyA || blocks.back().bodyB != p.bodyB) blocks.push_back({ p.bodyA, p.bodyB, k, 0, 0 });
		++blocks.back().count;
	}
}

/// Squared change of a point's impulse that counts as none. [N2 s2]
double DashpotSolver::threshold(double tolerance) const
{
	double size = 0;
	for (const Row& row : rows)
		size += row.impulse.squaredNorm();
	return tolerance * tolerance * size / double(rows.size());
}

/// Has the neighbours of a pair looked at in this sweep (if their turn is still to come) and in the next one, if the pair
/// has changed by more than `allowed` per point.
bool DashpotSolver::wake(const std::vector<DashpotBody>& bodies, const Block& block, double allowed, int sweep)
{
	if (block.change <= allowed * double(block.count)) return false;
	for (const int body : { block.bodyA, block.bodyB })
		if (bodies[body].inverseMass > 0) awake[body] = sweep + 1;
	return true;
}

/// Returns whether another sweep is needed.
bool DashpotSolver::sweepOn(std::vector<DashpotBody>& bodies, double allowed, int sweep)
{
	const bool forwards = sweep % 2 == 0;
	bool changed = false;
	for (size_t k = 0; k < blocks.size(); ++k) {
		Block& block = blocks[forwards ? k : blocks.size() - 1 - k];
		if (awake[block.bodyA] < sweep && awake[block.bodyB] < sweep) continue;
		relax(bodies, block, forwards);
		changed = wake(bodies, block, allowed, sweep) || changed;
	}
	return changed;
}

/// Returns the number of sweeps.
int DashpotSolver::sweepAll(std::vector<DashpotBody>& bodies, int sweeps, double tolerance)
{
	awake.assign(bodies.size(), 0);
	for (Block& block : blocks)
		relax(bodies, block, true);
	const double allowed = threshold(tolerance);
	bool changed = false;
	for (const Block& block : blocks)
		changed = wake(bodies, block, allowed, 0) || changed;
	int done = 1;
	while (changed && done < sweeps)
		changed = sweepOn(bodies, allowed, done++);
	return done;
}

int DashpotSolver::solve(std::vector<DashpotBody>& bodies, std::vector<DashpotPoint>& points, double h, int sweeps, double tolerance)
{
	if (points.empty()) return 0;
	if (sweeps == 0)
		for (DashpotPoint& p : points)
			explicitImpulse(bodies, p, h);
	for (const DashpotPoint& p : points)
		apply(bodies[p.bodyA], bodies[p.bodyB], p.armA, p.armB, p.impulse);
	if (sweeps == 0) return 0;
	rows.resize(points.size());
	for (size_t k = 0; k < points.size(); ++k)
		rows[k] = prepare(bodies, points[k], h);
	collectBlocks(points);
	const int done = sweepAll(bodies, sweeps, tolerance);
	for (size_t k = 0; k < points.size(); ++k)
		points[k].impulse = rows[k].impulse;
	return done;
}

} // namespace timber

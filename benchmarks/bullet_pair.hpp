// SPDX-License-Identifier: GPL-2.0-or-later
/// A pair in Bullet: its default algorithm, with a persistent manifold.
#pragma once
#include "configurations.hpp"
#include <btBulletCollisionCommon.h>
#include <memory>

namespace timber::bench {

class BulletPair {
	btDefaultCollisionConfiguration setup;
	btCollisionDispatcher dispatcher { &setup };
	btDispatcherInfo info;
	std::unique_ptr<btConvexShape> shapeA, shapeB;
	btCollisionObject objectA, objectB;
	btCollisionAlgorithm* algorithm = nullptr;
	Vec3 position; ///< of B [m]

	static btVector3 vector(const Vec3& v) { return btVector3(btScalar(v.x()), btScalar(v.y()), btScalar(v.z())); }
	static btTransform pose(const Quat& q, const Vec3& x)
	{
		return btTransform(
		        btQuaternion(btScalar(q.x()), btScalar(q.y()), btScalar(q.z()), btScalar(q.w())), vector(x));
	}
	static std::unique_ptr<btConvexShape> shape(const std::vector<Vec3>& points, const Vec3& box)
	{
		if (box.x() > 0) return std::make_unique<btBoxShape>(vector(box / 2));
		auto hull = std::make_unique<btConvexHullShape>();
		for (const Vec3& p : points)
			hull->addPoint(vector(p));
		hull->setMargin(btScalar(1e-3)); // [m]; the default of 4 cm is wider than the prism
		return hull;
	}
	double margin(const Vec3& box, const btConvexShape& s) const
	{
		return box.x() > 0 ? 0. : double(s.getMargin());
	}

public:
	const Configuration& configuration;

	/// hulls: boxes as convex hulls, so that the general algorithm (GJK, EPA) is used.
	BulletPair(const Configuration& c, bool hulls)
	        : configuration(c)
	{
		const Vec3 boxA = hulls ? Vec3(0, 0, 0) : c.boxA, boxB = hulls ? Vec3(0, 0, 0) : c.boxB;
		shapeA = shape(c.a, boxA);
		shapeB = shape(c.b, boxB);
		position = positionOfB(c, c.a, c.b, margin(boxA, *shapeA) + margin(boxB, *shapeB));
		objectA.setCollisionShape(shapeA.get());
		objectB.setCollisionShape(shapeB.get());
		objectA.setWorldTransform(pose(c.rotationA, Vec3::Zero()));
		for (int k = 0; k < 20; ++k)
			step(k);
	}
	~BulletPair() { reset(); }
	/// Discards the persistent manifold.
	void reset()
	{
		if (!algorithm) return;
		algorithm->~btCollisionAlgorithm();
		dispatcher.freeCollisionAlgorithm(algorithm);
		algorithm = nullptr;
	}
	void step(int k) { stepAt(position + vibration(k)); }
	void stepAt(const Vec3& x)
	{
		objectB.setWorldTransform(pose(configuration.rotationB, x));
		const btCollisionObjectWrapper a(nullptr, shapeA.get(), &objectA, objectA.getWorldTransform(), -1, -1);
		const btCollisionObjectWrapper b(nullptr, shapeB.get(), &objectB, objectB.getWorldTransform(), -1, -1);
		if (!algorithm) algorithm = dispatcher.findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
		btManifoldResult result(&a, &b);
		algorithm->processCollision(&a, &b, info, &result);
	}
	Found found()
	{
		stepAt(position);
		Found f;
		btManifoldArray manifolds;
		algorithm->getAllContactManifolds(manifolds);
		for (int m = 0; m < manifolds.size(); ++m)
			for (int k = 0; k < manifolds[m]->getNumContacts(); ++k) {
				const btManifoldPoint& p = manifolds[m]->getContactPoint(k);
				if (p.getDistance() > 0) continue;
				const btVector3& n = p.m_normalWorldOnB; // from B to A; A is the manifold's first body
				const double sign = manifolds[m]->getBody0() == &objectA ? -1 : 1;
				f.add(configuration, sign * Vec3(n.x(), n.y(), n.z()), -double(p.getDistance()));
			}
		return f;
	}
};

} // namespace timber::bench

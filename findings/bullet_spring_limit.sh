#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Bullet 3.24 (libbullet-dev 3.24+dfsg-2): btGeneric6DofSpring2Constraint replaces a spring stiffer than m / (4 dt)^2.
# Guess: 10 kg on a damped spring of 1e5 N/m sag by m g / k = 0.98 mm at every step, or the motion becomes unstable.
# Seen: 43.6 mm at 1/60 s (44.4 times as much), 2.78 times at 1/240 s, 1.00 at 1/1000 s; without a message.
# Needs Debian 12's libbullet-dev, g++ and pkg-config. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat >run.cpp <<'CPP'
#include <btBulletDynamicsCommon.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
// Sag of 10 kg on a vertical spring over m g / k, mean of the last 4 of 20 s.
static double sag(double stiffness, double dt)
{
	const double mass = 10;
	btDefaultCollisionConfiguration configuration;
	btCollisionDispatcher dispatcher(&configuration);
	btDbvtBroadphase broadphase;
	btSequentialImpulseConstraintSolver solver;
	btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
	world.setGravity(btVector3(0, 0, -9.81));
	btBoxShape box(btVector3(0.1, 0.1, 0.1));
	btVector3 inertia;
	box.calculateLocalInertia(mass, inertia);
	btRigidBody body(mass, nullptr, &box, inertia);
	body.setActivationState(DISABLE_DEACTIVATION);
	world.addRigidBody(&body);
	btGeneric6DofSpring2Constraint joint(body, btTransform::getIdentity()); // lower above upper limit: free
	joint.setLinearLowerLimit(btVector3(0, 0, 1));
	joint.setLinearUpperLimit(btVector3(0, 0, -1));
	joint.setAngularLowerLimit(btVector3(0, 0, 0));
	joint.setAngularUpperLimit(btVector3(0, 0, 0));
	joint.enableSpring(2, true);
	joint.setStiffness(2, stiffness);
	joint.setDamping(2, 0.6 * std::sqrt(stiffness * mass)); // 30 % of critical
	joint.setEquilibriumPoint(2, 0);
	world.addConstraint(&joint);
	double sum = 0;
	int count = 0;
	for (double time = 0; time < 20; time += dt) {
		world.stepSimulation(dt, 0);
		if (time < 16) continue;
		sum -= body.getWorldTransform().getOrigin().z();
		++count;
	}
	return sum / count / (mass * 9.81 / stiffness);
}
int main(int, char** argument) { std::printf("%.4f\n", sag(std::atof(argument[1]), 1 / std::atof(argument[2]))); }
CPP
g++ -std=c++17 -O1 $(pkg-config --cflags bullet) run.cpp -o run $(pkg-config --libs bullet)
near() { # NAME VALUE SEEN TOLERANCE
	echo "$1: $2, seen $3"
	awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { exit !(a >= b - t && a <= b + t) }' || status=1
}
status=0
near "1e3 N/m, 1/60 s: sag over m g / k" "$(./run 1e3 60)" 1.00 0.01
near "1e5 N/m, 1/60 s: sag over m g / k" "$(./run 1e5 60)" 44.44 0.05
near "1e5 N/m, 1/240 s: sag over m g / k" "$(./run 1e5 240)" 2.778 0.01
near "1e5 N/m, 1/1000 s: sag over m g / k" "$(./run 1e5 1000)" 1.00 0.01
exit $status

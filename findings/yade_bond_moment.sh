#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# YADE 2023.02a (Debian 12): a cohesive bond of CohFrictMat breaks in tension and shear, never in bending or torsion.
# Guess: with a strength s = 1 MPa in tension and shear and spheres of R = 0.1 m the bond, which carries moments, breaks
# at a bending moment near s pi R^3 / 4 = 785 N m, at worst at a few times that; in torsion near s pi R^3 / 2.
# Seen: in tension it breaks at s R^2 = 10 kN; under 100 kN m it holds and bends or twists by 95 degrees.
# Needs Debian's package yade. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat >run.py <<'PY'
import math, os, sys


def load(apply, largest):
    """Load at which the bond breaks, NaN if it holds the largest; angle between the spheres at the end. [deg]"""
    O.reset()
    index = O.materials.append(CohFrictMat(young=1e8, poisson=0.3, density=2600, normalCohesion=1e6, shearCohesion=1e6,
                                           momentRotationLaw=True))
    for x in (0, 0.2):
        O.bodies.append(utils.sphere((x, 0, 0), 0.1, fixed=not x, material=O.materials[index]))
    bond = Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)
    loop = InteractionLoop([Ig2_Sphere_Sphere_ScGeom6D()], [bond], [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()])
    O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]), loop, NewtonIntegrator(damping=0.4)]
    O.dt = 0.2 * utils.PWaveTimeStep()
    O.step()
    for k in range(1, 201):
        apply(largest * k / 200)
        O.run(300, True)
        if not O.interactions.has(0, 1) or not O.interactions[0, 1].isReal or O.interactions[0, 1].phys.cohesionBroken:
            return largest * k / 200, math.nan
    return math.nan, math.degrees(O.bodies[1].state.ori.toAxisAngle()[1])


tension, _ = load(lambda force: O.forces.setPermF(1, (force, 0, 0)), 2e4)
bending, bent = load(lambda moment: O.forces.setPermT(1, (0, moment, 0)), 1e5)
torsion, twisted = load(lambda moment: O.forces.setPermT(1, (moment, 0, 0)), 1e5)
print(f"bond: breaks in tension at {tension:.0f} N, seen 10000 to 10100")
print(f"bond: breaks in bending at {bending:.0f} N m, seen nan; bent by {bent:.1f} degrees, seen 95.5")
print(f"bond: breaks in torsion at {torsion:.0f} N m, seen nan; twisted by {twisted:.1f} degrees, seen 95.5")
sys.stdout.flush()
holds = math.isnan(bending) and math.isnan(torsion) and abs(bent - 95.5) < 1 and abs(twisted - 95.5) < 1
os._exit(not (holds and abs(tension - 1e4) < 150))
PY
yade -j1 -n -x run.py </dev/null | grep "^bond"

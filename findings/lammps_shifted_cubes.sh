#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# LAMMPS 20220106 (Debian 12), body/rounded/polyhedron: two cubes that meet face on face gain energy if they are shifted.
# Guess: without dashpots the energy is conserved, whether the faces are flush or shifted by 1e-4 of the edge.
# Seen: energy after over before 1.01 flush, 4.57 shifted by 1e-4 of the edge across the motion.
# Needs Debian's package lammps. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat >run.py <<'PY'
import itertools, subprocess, sys

SIGNS = list(itertools.product((-1, 1), repeat=3))
EDGES = [(i, j) for i, j in itertools.combinations(range(8), 2) if sum(a != b for a, b in zip(SIGNS[i], SIGNS[j])) == 1]
FACES = [(0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5)]
EDGE, MASS, RADIUS = 0.5, 10.0, 0.001


def cube(number):
    inertia = MASS * EDGE**2 / 6
    rows = [(number, 3, 79), (8, 12, 6), (inertia, inertia, inertia, 0, 0, 0)]
    rows += [[sign * (EDGE / 2 - RADIUS) for sign in corner] for corner in SIGNS] + EDGES + FACES + [(2 * RADIUS,)]
    return "\n".join(" ".join(map(str, row)) for row in rows)


def energy_ratio(shift):
    offset = shift * EDGE
    open("cubes.data", "w").write(f"""cubes

2 atoms
2 bodies
1 atom types
-9 9 xlo xhi
-9 9 ylo yhi
-9 9 zlo zhi

Atoms

1 1 1 {MASS} {-0.55 * EDGE} 0 0
2 1 1 {MASS} {0.55 * EDGE} {offset} {offset}

Bodies

{cube(1)}
{cube(2)}

Velocities

1 1 0 0 0 0 0
2 -1 0 0 0 0 0
""")
    open("in.lmp", "w").write(f"""units si
boundary f f f
atom_style body rounded/polyhedron 8 8
comm_modify vel yes
read_data cubes.data
pair_style body/rounded/polyhedron 0 0 0 1 {RADIUS}
pair_coeff * * 1e7 0
neighbor 0.05 nsq
neigh_modify delay 0 every 1 check yes
fix motion all nve/body
compute momenta all property/atom angmomx angmomy angmomz
dump end all custom 4000 out.dump vx vy vz c_momenta[1] c_momenta[2] c_momenta[3]
timestep 5e-5
run 4000
""")
    subprocess.run(["lmp", "-in", "in.lmp"], check=True, stdout=subprocess.DEVNULL)
    rows = [list(map(float, line.split())) for line in open("out.dump").read().splitlines()[-2:]]
    inertia = MASS * EDGE**2 / 6
    return sum(MASS * sum(v * v for v in row[:3]) + sum(l * l for l in row[3:]) / inertia for row in rows) / (2 * MASS)


for name, shift, seen in (("flush", 0.0, 1.01), ("shifted by 1e-4", 1e-4, 4.57)):
    value = energy_ratio(shift)
    print(f"{name}: {value:.4f}, seen {seen}")
    if not abs(value - seen) <= 0.05:
        sys.exit(1)
PY
/usr/bin/python3 run.py

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# LAMMPS 20220106 (Debian 12): with "damping tsuji" spheres rebound faster than the restitution coefficient states.
# Guess: two spheres that meet at 1 m/s with "hertz/material ... damping tsuji" part at e m/s, e being the coefficient.
# Seen: 0.93 for 0.9, 0.62 for 0.5, 0.44 for 0.3 and 0.23 for 0.1. The damping is 1 / sqrt(2) of what e needs.
# Needs Debian's package lammps. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat >in.spheres <<'LMP'
units si
atom_style sphere
atom_modify map array
boundary f f f
newton off
comm_modify vel yes
region box block -1 1 -1 1 -1 1
create_box 1 box
create_atoms 1 single 0 0 0
create_atoms 1 single 0 0 0.2001
set group all diameter 0.2 density 2600
pair_style granular
pair_coeff * * hertz/material 1e8 ${e} 0.3 tangential mindlin NULL 1.0 0.0 damping tsuji
group upper id 2
velocity all set 0 0 0
velocity upper set 0 0 -1
fix 1 all nve/sphere
timestep 1e-6
neighbor 0.02 bin
variable apart equal vz[2]-vz[1]
thermo_style custom step v_apart
run 30000 # [30 ms], several times the duration of the contact
print "part at $(v_apart:%.4f)"
LMP
near() { # NAME VALUE SEEN TOLERANCE
	echo "$1: $2, seen $3"
	awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { exit !(a >= b - t && a <= b + t) }' || status=1
}
status=0
for pair in 0.9:0.928 0.5:0.616 0.3:0.440 0.1:0.235; do
	speed=$(OMP_NUM_THREADS=1 lmp -var e "${pair%:*}" -in in.spheres -log none | awk '/^part at/ { print $3 }')
	near "coefficient ${pair%:*}: speed over speed before" "$speed" "${pair#*:}" 0.003
done
exit $status

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# YADE 2023.02a (Debian 12): O.run(0) runs without an end.
# Guess: a run of n steps ends after n steps, so that one of 0 steps, for a time that is over, does nothing.
# Seen: the scene is still running after 0.5 s, some 10 000 steps later; a run of 5 steps ends after 5. A script that
# waits for such a run does not go on.
# Needs Debian's package yade. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat >run.py <<'PY'
import os, sys, time

O.engines = [ForceResetter(), NewtonIntegrator()]
O.dt = 1e-3


def run(steps):
    """Whether the scene runs half a second later, and the steps it has done."""
    start = O.iter
    O.run(steps)
    time.sleep(0.5)
    running = O.running
    O.pause()
    O.wait()
    return running, O.iter - start


five, zero = run(5), run(0)
for name, (running, steps) in (("run(5)", five), ("run(0)", zero)):
    print(f"{name}: running after 0.5 s: {running}, steps: {'more than 100' if steps > 100 else steps}")
sys.stdout.flush()
os._exit(five != (False, 5) or not zero[0] or zero[1] <= 100)
PY
yade -j1 -n -x run.py </dev/null | grep "^run"

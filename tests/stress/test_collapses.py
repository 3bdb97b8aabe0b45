# SPDX-License-Identifier: GPL-2.0-or-later
"""Collapses whose numbers hold: tiled houses, plain frames, members of 0.1 to 10 000 kg.

YADE_TIMBER_HOUSES=N runs the first N runs of shipped houses at 1, 1.5 and 2 times the motion with seeds 1 to 4
(default:
none; up to a minute each). Short forms: tests/physics/test_collapses_short.py.
"""
import os

import collapses
import pytest

HOUSES = int(os.environ.get("YADE_TIMBER_HOUSES", 0))


@pytest.mark.parametrize("wanted", ["scenes", "frames", "weights"])
def test_sound(wanted, capsys):
    with capsys.disabled():
        print()
        outcomes = collapses.table(collapses.SETS[wanted]())
    collapses.expect_sound(outcomes)


@pytest.mark.skipif(HOUSES == 0, reason="on request: YADE_TIMBER_HOUSES=N")
def test_shipped_houses(capsys):
    with capsys.disabled():
        print()
        outcomes = collapses.table(collapses.houses()[:HOUSES])
    collapses.expect_sound(outcomes)

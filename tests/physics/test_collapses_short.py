# SPDX-License-Identifier: GPL-2.0-or-later
"""Short forms of tests/stress/test_collapses.py (label `stress`): a frame, a house under snow."""
from dataclasses import replace
from math import nan

import pytest
from collapses import Case, Heap, expect_sound, frames, outcome

CASES = [
    replace(frames()[10], duration=4.0),
    Case("tiled house", "tiled_house", 2.0, 1, start=20.0, duration=3.0, snow=1.0),
]


@pytest.mark.parametrize("case", [CASES[0], pytest.param(CASES[1], marks=pytest.mark.rare)], ids=lambda case: case.name)
def test_sound(case):
    """No error, finite energies, no energy created, no step that ends before its sweeps have converged."""
    expect_sound([outcome(case)])


def test_a_fault_is_seen():
    """Of a sound outcome with one number changed."""
    sound = outcome(Heap("heap", 0, duration=0.1))
    expect_sound([sound])
    for name, value in {"error": "body 3 left", "created": 2e-4, "negative": 1e-8, "change": nan,
                        "residual": nan}.items():
        with pytest.raises(AssertionError, match="heap: "):
            expect_sound([replace(sound, **{name: value})])

# SPDX-License-Identifier: GPL-2.0-or-later
"""10 000 random impacts: slivers, plates, needles, sizes of 1:1000, mass ratios to 1e6, speeds to 50 m/s, initial
overlaps.
"""
from random_pairs import expect_sound, impacts


def test_ten_thousand_impacts():
    found = impacts(10000, seed=1)
    expect_sound(found)
    assert sum(o.touched for o in found) > 5000

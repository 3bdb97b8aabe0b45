# SPDX-License-Identifier: GPL-2.0-or-later
"""10 000 random impacts: slivers, plates, needles, sizes of 1:1000, mass ratios to 1e6, speeds to 50 m/s, starting overlaps."""
import pytest
from random_pairs import expect_sound, impacts


@pytest.mark.xfail(strict=True, reason="1 of the 10 000 gains energy: a snow box with 8e-5 J that starts inside a lump leaves it with 0.2 J; 9 999 are sound")
def test_ten_thousand_impacts():
    found = impacts(10000, seed=1)
    expect_sound(found)
    assert sum(o.met for o in found) > 5000

# SPDX-License-Identifier: GPL-2.0-or-later
"""Section 1 of the accuracy page. Quantities and bounds: impact_cases.py."""
import pytest
from impact_cases import case
from rows import check

LONG = ("restitution_with_the_papers_dashpot", "snow_impact")


@pytest.mark.parametrize("function", [pytest.param(f, marks=pytest.mark.rare if f.__name__ in LONG else ())
                                      for f in case.functions], ids=lambda f: f.__name__)
def test(function):
    check(function())

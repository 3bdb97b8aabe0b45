# SPDX-License-Identifier: GPL-2.0-or-later
"""Section 1 of the accuracy page. Quantities and bounds: impact_cases.py."""
import pytest
from impact_cases import case
from rows import check


@pytest.mark.parametrize("function", case.functions, ids=lambda f: f.__name__)
def test(function):
    check(function())

# SPDX-License-Identifier: GPL-2.0-or-later
"""Section 8 of the accuracy page. Quantities and bounds: invariance_cases.py, slope_cases.py."""
import invariance_cases
import pytest
import slope_cases
from rows import check


@pytest.mark.parametrize("function", invariance_cases.case.functions + slope_cases.case.functions,
                         ids=lambda f: f.__name__)
def test(function):
    check(function())

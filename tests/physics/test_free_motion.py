# SPDX-License-Identifier: GPL-2.0-or-later
"""Section 5 of the accuracy page. Quantities and bounds: motion_cases.py."""
import pytest
from motion_cases import case
from rows import check


@pytest.mark.parametrize("function", case.functions, ids=lambda f: f.__name__)
def test(function):
    check(function())

# SPDX-License-Identifier: GPL-2.0-or-later
"""Section 4 of the accuracy page. Quantities and bounds: slip_joint_cases.py."""
import pytest
from slip_joint_cases import case
from rows import check


@pytest.mark.parametrize("function", case.functions, ids=lambda f: f.__name__)
def test(function):
    check(function())

# SPDX-License-Identifier: GPL-2.0-or-later
"""Section 2 of the accuracy page. Quantities and bounds: friction_cases.py, path_cases.py."""
import friction_cases
import path_cases
import pytest
from rows import check


@pytest.mark.parametrize("function", friction_cases.case.functions + path_cases.case.functions,
                         ids=lambda f: f.__name__)
def test(function):
    check(function())

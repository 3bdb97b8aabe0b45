# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""The comparator passes and fails where it should."""
import math

import pytest
from compare import assert_close


@pytest.mark.parametrize("value, reference, tolerances", [
    (1.0, 1.0, {}),
    (1.01, 1.0, {"rtol": 0.011}),
    (0.01, 0.0, {"atol": 0.01}),
    ([1.0, 2.0], (1.0, 2.0), {}),
    ([], [], {}),
])
def test_passes(value, reference, tolerances):
    assert_close(value, reference, **tolerances)


@pytest.mark.parametrize("value, reference, tolerances", [
    (math.nan, 1.0, {"rtol": 1e9}),
    (math.nan, math.nan, {"rtol": 1e9, "atol": 1e9}),
    (1.0, math.nan, {"rtol": 1e9, "atol": 1e9}),
    (math.inf, 1.0, {"rtol": 1e9}),
    (1.02, 1.0, {"rtol": 0.01}),
    (0.02, 0.0, {"rtol": 1e9, "atol": 0.01}),
    ([1.0, 2.5], [1.0, 2.0], {"rtol": 0.1}),
    ([1.0, math.nan], [1.0, 2.0], {"rtol": 1e9}),
    ([1.0, 1.0], 1.0, {}),
    ([1.0, 2.0], [1.0, 2.0, 3.0], {}),
    ([[1.0, 2.0]], [1.0, 2.0], {}),
])
def test_fails(value, reference, tolerances):
    with pytest.raises(AssertionError):
        assert_close(value, reference, **tolerances)


def test_message_names_the_worst_element():
    with pytest.raises(AssertionError, match=r"1 of 3 differ; worst at \(1,\): 2.5 instead of 2.0"):
        assert_close([1.0, 2.5, 3.0], [1.0, 2.0, 3.0])

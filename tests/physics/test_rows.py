# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""The check of the accuracy table fails on NaN, on a wrong value, on a lost order and on an empty table."""
import math

import pytest
from rows import Row, check, observed_order, series, worst


@pytest.mark.parametrize("row", [
    Row("1", "q", 2.0, 2.002, bound=1.1e-3),
    Row("1", "expected zero: absolute", 0.0, 1e-3, bound=1.1e-3),
    Row("1", "absolute", 100.0, 100.5, bound=0.6, absolute=True),
    Row("1", "no bound", 1.0, 5.0),
    Row("1", "order", 1.0, 1.0, bound=0.1, order=2.0, least_order=1.9),
], ids=lambda r: r.quantity)
def test_passes(row):
    check([row])


@pytest.mark.parametrize("row", [
    Row("1", "wrong value", 2.0, 2.002, bound=0.9e-3),
    Row("1", "not a number", 1.0, math.nan, bound=1e9),
    Row("1", "not a number, no bound", 1.0, math.nan),
    Row("1", "infinite", 1.0, math.inf),
    Row("1", "no reference", math.nan, 1.0, bound=1e9),
    Row("1", "order lost", 1.0, 1.0, bound=0.1, order=1.2, least_order=1.9),
    Row("1", "order unknown", 1.0, 1.0, bound=0.1, order=math.nan, least_order=1.9),
    Row("1", "order missing", 1.0, 1.0, bound=0.1, least_order=1.9),
], ids=lambda r: r.quantity)
def test_fails(row):
    good = Row("1", "good", 1.0, 1.0, bound=0.0)
    with pytest.raises(AssertionError, match=row.quantity):
        check([good, row])


def test_empty_table_fails():
    with pytest.raises(AssertionError, match="nothing was compared"):
        check([])


def test_order_is_that_of_the_errors():
    steps = (4e-4, 2e-4, 1e-4)
    assert abs(observed_order(steps, [7 * h**1.5 for h in steps]) - 1.5) < 1e-12
    assert math.isnan(observed_order(steps, (1e-2, 0.0, 1e-4)))


def test_series_checks_its_finest_row():
    rows = series("1", "q", 1.0, [1 + 100 * h**2 for h in (1e-2, 1e-3)], (1e-2, 1e-3), 2e-4, 1.9)
    assert rows[0].bound == math.inf and rows[1].bound == 2e-4 and abs(rows[1].order - 2) < 1e-6
    check(rows)


def test_worst_takes_nan_before_the_largest_error():
    assert worst("1", "q", [(1.0, 1.1), (1.0, 1.3), (1.0, 1.2)], 1.0).got == 1.3
    assert math.isnan(worst("1", "q", [(1.0, 1.1), (1.0, math.nan)], 1.0).got)

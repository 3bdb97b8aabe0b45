# SPDX-License-Identifier: GPL-2.0-or-later
"""The column of this package in docs/mechanics.md at its smaller steps: three minutes of processor time."""
import pytest
from mechanics.program import measured
from mechanics.programs import timber
from mechanics.rows import table

PROGRAM = timber.program()
RUNS = {dt: {} for dt in PROGRAM.steps[1:]}


@pytest.mark.parametrize("row", table(), ids=lambda row: row.key)
@pytest.mark.parametrize("dt", RUNS)
def test_row_is_within_its_bound(row, dt):
    value, note = measured(PROGRAM, row, dt, RUNS[dt])
    assert note == "" and row.error(value, PROGRAM.radius) <= 1

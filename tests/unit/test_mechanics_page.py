# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""docs/mechanics.md is what scripts/bench/mechanics/write_mechanics.py makes of the CSV files; misses are marked."""
import pathlib

import pytest
from mechanics import write_mechanics
from mechanics.rows import table

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/mechanics.md"
FOUND = write_mechanics.columns(ROOT / "docs/mechanics")


def test_page_is_made_from_its_files():
    text = PAGE.read_text(encoding="utf-8")
    assert write_mechanics.page(text, FOUND) == text


def test_this_package_comes_first_and_has_every_row():
    name, program = next(iter(FOUND.items()))
    assert name == "this package"
    assert {key for key, _ in program["cells"]} == {row.key for row in table()}


@pytest.mark.parametrize("row", table(), ids=lambda row: row.key)
def test_a_value_beside_the_closed_form_is_a_miss(row):
    """One and a half bounds beside it, infinite and not a number; the closed form itself is none."""
    exact = row.expected(0.0)
    beside = exact + 1.5 * row.bound * (abs(exact) if row.relative else 1.0)
    values = {"exact": exact, "beside": beside, "never": float("inf"), "nan": float("nan")}
    marked = []
    for name, value in values.items():
        program = {"radius": 0.0, "steps": ["0.001"], "cells": {(row.key, "0.001"): (value, "")}}
        if write_mechanics.MISS in write_mechanics.cell(program, row):
            marked.append(name)
    assert marked == ["beside", "never", "nan"]

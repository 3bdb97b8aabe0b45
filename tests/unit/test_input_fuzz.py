# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Damaged house files, frames from CAD, towns, records, tables and motion options: each is used or refused in one line,
within limits of time and memory.

Few examples; the long run is in tests/stress.
"""
import pytest
from hypothesis import HealthCheck, given, settings
from btlx_sample import portal
from input_fuzz import (FRAME, KINDS, SHED, TABLES, TOWNS, record_texts, use_btlx, use_house, use_options, use_record,
                        use_table, use_town)

few = settings(max_examples=60, deadline=None, database=None, derandomize=True, suppress_health_check=list(HealthCheck))


def test_the_undamaged_files_are_used(tmp_path):
    """Otherwise the examples would all end at the same refusal."""
    assert [use_house(tmp_path, text.encode()) for text in (SHED, FRAME)] == [None] * 2
    assert use_btlx(tmp_path, portal().encode()) is None
    for text, name in zip(record_texts(), ("a.NS", "a090.AT2", "a.dat", "a.csv", "a.csv")):
        assert use_record(tmp_path, text.encode(), name) is None
    assert use_options(tmp_path, ["--pga=300", "--azimuth=30", "--detrend=1", "--end=0.3"]) is None
    assert [use_town(tmp_path, (name, text.encode())) for name, text in TOWNS.items()] == [None] * 3
    assert [use_table(tmp_path, (name, text.encode())) for name, text in TABLES.items()] == [None] * 2


@pytest.mark.parametrize("examples, use", KINDS.values(), ids=KINDS)
def test_damaged(tmp_path, examples, use):
    @few
    @given(examples)
    def check(example):
        use(tmp_path, example)

    check()

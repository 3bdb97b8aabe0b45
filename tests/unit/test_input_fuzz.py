# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Damaged house files, towns, records, tables and motion options: each is used or refused in one line, within limits
of time and memory.

Few examples; the long run is in tests/stress.
"""

from hypothesis import HealthCheck, given, settings

from input_fuzz import (SHED, TABLES, TOWNS, house_files, motion_options, record_files, record_texts, table_files,
                        town_files, use_house, use_options, use_record, use_table, use_town)

few = settings(max_examples=60, deadline=None, database=None, derandomize=True, suppress_health_check=list(HealthCheck))


def test_the_undamaged_files_are_used(tmp_path):
    """Otherwise the examples would all end at the same refusal."""
    assert use_house(tmp_path, SHED.encode()) is None
    for text, name in zip(record_texts(), ("a.NS", "a090.AT2", "a.dat", "a.csv", "a.csv")):
        assert use_record(tmp_path, text.encode(), name) is None
    assert use_options(tmp_path, ["--pga=300", "--azimuth=30", "--detrend=1", "--end=0.3"]) is None
    assert [use_town(tmp_path, (name, text.encode())) for name, text in TOWNS.items()] == [None] * 3
    assert [use_table(tmp_path, (name, text.encode())) for name, text in TABLES.items()] == [None] * 2


@few
@given(content=house_files)
def test_house_files(tmp_path_factory, content):
    use_house(tmp_path_factory.getbasetemp(), content)


@few
@given(content=record_files)
def test_records(tmp_path_factory, content):
    use_record(tmp_path_factory.getbasetemp(), content)


@few
@given(file=town_files)
def test_towns(tmp_path_factory, file):
    use_town(tmp_path_factory.getbasetemp(), file)


@few
@given(file=table_files)
def test_tables(tmp_path_factory, file):
    use_table(tmp_path_factory.getbasetemp(), file)


@few
@given(words=motion_options)
def test_motion_options(tmp_path_factory, words):
    use_options(tmp_path_factory.getbasetemp(), words)

# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""10 000 damaged house files, frames from CAD, towns, records, tables and motion options each (YADE_TIMBER_FUZZ sets
another number), with new random numbers in each run.

Printed are the numbers of examples used and refused, and the longest processor time of one example.
"""
import os
import time
from collections import Counter

import pytest
from hypothesis import HealthCheck, given, settings
from input_fuzz import KINDS

EXAMPLES = int(os.environ.get("YADE_TIMBER_FUZZ", 10_000))
many = settings(max_examples=EXAMPLES, deadline=None, database=None, suppress_health_check=list(HealthCheck))


@pytest.mark.parametrize("examples, use", KINDS.values(), ids=KINDS)
def test_many(tmp_path, capsys, examples, use):
    counts, longest = Counter(), 0.0

    @many
    @given(example=examples)
    def run(example):
        nonlocal longest
        start = time.process_time()
        counts["used" if use(tmp_path, example) is None else "refused"] += 1
        longest = max(longest, time.process_time() - start)

    run()
    with capsys.disabled():
        print(f"{use.__name__}: {dict(counts)}, longest {longest:.2f} s")
    assert counts.total() >= EXAMPLES

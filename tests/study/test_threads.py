# SPDX-License-Identifier: GPL-2.0-or-later
"""10 s on one and two threads (section 8 of the accuracy page)."""
from invariance_cases import one_thread_or_two
from rows import check


def test_threads():
    check(one_thread_or_two(duration=10.0))

# SPDX-License-Identifier: GPL-2.0-or-later
"""Processors of this process."""
import os


def processors():
    """Number of processors that this process may use (taskset, control groups of containers)."""
    return len(os.sched_getaffinity(0))

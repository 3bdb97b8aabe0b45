# SPDX-License-Identifier: GPL-2.0-or-later
"""Processors of this process."""
import os
from contextlib import suppress
from pathlib import Path

GROUPS = Path("/sys/fs/cgroup")


def processors():
    """Number of processors that this process may use: those of its set (taskset), at most the quota of its control
    group (docker --cpus), at least 1."""
    return max(1, int(min(len(os.sched_getaffinity(0)), quota())))


def quota(groups=GROUPS):
    """Processor time per time that a container grants, by control groups of version 2 or 1; infinite without one."""
    with suppress(OSError, ValueError):
        limit, period = (groups / "cpu.max").read_text().split()
        return float("inf") if limit == "max" else int(limit) / int(period)
    with suppress(OSError, ValueError):
        limit, period = (int((groups / "cpu" / f"cpu.cfs_{name}_us").read_text()) for name in ("quota", "period"))
        return limit / period if limit > 0 else float("inf")
    return float("inf")

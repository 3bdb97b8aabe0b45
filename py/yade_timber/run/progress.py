# SPDX-License-Identifier: GPL-2.0-or-later
"""Progress of a run: its events and numbers as texts; on standard error a bar, and a line for each event."""
import sys

import numpy as np
import yade.wrapper as yw
from tqdm import tqdm

from ..recording.walls import count_apart
from ..scene.engines import find_engine
from ..text import english

BAR = "{desc} {percentage:3.0f}%|{bar}| {n:.2f}/{total:.2f} s [{elapsed}, {remaining} left{postfix}]"
TERMINAL_REFRESH, LOG_REFRESH = 0.5, 30.0
"""Shortest wall time between two states of the bar, on a terminal and in a log file. [s]"""

O = yw.Omega()
tqdm.monitor_interval = (
    0  # no thread that refreshes bars: at the end of a run the process with one thread is copied (pictures/copies.py)
)


class Status:
    """Events and numbers of one run as texts. log: EventLog"""

    def __init__(self, log):
        self.log, self.told = log, list(log.events)

    def events(self):
        """Lines of the events since the last call."""
        new = [event for event in self.log.events if event not in self.told]
        self.told += new
        return [f"{event.time_s:7.2f} s  {english.event(event)}" for event in new]

    def numbers(self):
        """'drift 1/245, 3/382 joints broken'"""
        joints = find_engine(yw.JointEngine).joints
        known = self.log.survey.joints
        broken = np.array([joint.isBroken for joint in joints[:len(known.damaged)]], bool) & ~known.damaged
        peak = max(find_engine(yw.HouseMonitor).peak, default=0.0)
        return f"drift {english.ratio(peak)}, {english.broken_of(*count_apart(known, broken), of='/')}"


class Progress:
    """Bar and events of one run, a context. log: EventLog; quiet: print nothing."""

    def __init__(self, scenario, log, quiet=False):
        self.status = Status(log)
        refresh = TERMINAL_REFRESH if sys.stderr.isatty() else LOG_REFRESH
        self.bar = tqdm(total=scenario.duration, initial=O.time, desc=scenario.name, bar_format=BAR,
                        mininterval=refresh, disable=quiet)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.bar.close()

    def update(self):
        """Print new events and refresh the bar."""
        if self.bar.disable:
            return
        for line in self.status.events():
            self.bar.write(line, file=sys.stderr)
        self.bar.set_postfix_str(self.status.numbers(), refresh=False)
        self.bar.update(min(O.time, self.bar.total) - self.bar.n)

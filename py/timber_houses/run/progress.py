# SPDX-License-Identifier: GPL-2.0-or-later
"""Progress of a run or a town: events and numbers as texts; a bar on standard error."""
import sys
from time import time as time_now

from tqdm import tqdm
from yade_timber.scene import record

from ..text import english

BAR = "{desc} {percentage:3.0f}%|{bar}| {n:.2f}/{total:.2f} s [{elapsed}, {remaining} left{postfix}]"
TERMINAL_REFRESH, LOG_REFRESH = 0.5, 30.0
"""Shortest wall time between two states of the bar, on a terminal and in a log file. [s]"""


class Status:
    """Events and numbers of one run as texts. observer: of the run"""

    def __init__(self, observer):
        self.log, self.judge, self.told = observer.log, observer.judge, list(observer.log.events)

    def events(self):
        """Lines of the events since the last call."""
        new = [event for event in self.log.events if event not in self.told]
        self.told += new
        return [f"{event.time_s:7.2f} s  {english.event(event)}" for event in new]

    def numbers(self):
        """'drift 1/245, 3/382 joints broken'"""
        described = self.log.survey.joints
        broken = described.states(record.joint_loads()[1][:len(described.name)]) == "broken"
        peak = max(self.judge.main.peak, default=0.0)
        joints, sheets = described.count_apart(broken)
        return f"drift {english.ratio(peak)}, {english.broken_of(joints, sheets, of='/')}"


class Bar:
    """A bar on standard error, a context. total: simulated time [s]; quiet: print nothing; status: of a run, or None"""

    def __init__(self, name, total, start, quiet, status=None):
        refresh = TERMINAL_REFRESH if sys.stderr.isatty() else LOG_REFRESH
        self.bar = tqdm(total=total, initial=start, desc=name, bar_format=BAR, mininterval=refresh,
                        maxinterval=LOG_REFRESH, disable=quiet)
        self.status = status

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.status and not self.bar.disable:
            self._show_numbers()
        self.bar.close()

    def _show_numbers(self):
        self.bar.set_postfix_str(self.status.numbers(), refresh=False)

    def advance(self, time):
        """To a simulated time [s]; new events are printed above the bar."""
        if self.status and not self.bar.disable:
            for line in self.status.events():
                self.bar.write(line, file=sys.stderr)
            if time_now() - self.bar.last_print_t >= self.bar.mininterval:
                self._show_numbers()
        self.bar.update(min(time, self.bar.total) - self.bar.n)

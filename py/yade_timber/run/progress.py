# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run says on standard error while it goes: a bar, and one line per event worth knowing."""
import sys

import yade.wrapper as yw
from tqdm import tqdm

from ..scene import engines as scene
from .summary import break_row
from ..recording.sentences import direction_name, ratio

BAR = "{desc} {percentage:3.0f}%|{bar}| {n:.2f}/{total:.2f} s [{elapsed}, {remaining} left{postfix}]"
TERMINAL_REFRESH, LOG_REFRESH = 0.5, 30.0
"""Shortest wall time between two states of the bar, on a terminal and in a log file. [s]"""

O = yw.Omega()


class Progress:
    """Bar and events of one run; silent with quiet. Use as a context, and call `update` now and then."""

    def __init__(self, scenario, model, quiet=False):
        self.model = model
        self.monitor = scene.find_engine(yw.HouseMonitor)
        self.joints = scene.find_engine(yw.JointEngine)
        refresh = TERMINAL_REFRESH if sys.stderr.isatty() else LOG_REFRESH
        self.bar = tqdm(total=scenario.duration, initial=O.time, desc=scenario.name, bar_format=BAR, mininterval=refresh, disable=quiet)
        self.told = {name for name, text in self.events() if text}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.bar.close()

    def events(self):
        """(name, line or None as long as it has not happened)."""
        monitor, first = self.monitor, next(iter(self.joints.breaks), None)
        yield "break", first and self.first_break(first)
        tilted = monitor.tiltTime >= 0
        yield "tilt", f"{monitor.tiltTime:7.2f} s  a storey leans {direction_name(monitor.tiltDirection)} by more than 1/10" if tilted else None
        yield "collapse", f"{monitor.collapseTime:7.2f} s  collapse: a floor has come down by half a storey" if monitor.collapseTime >= 0 else None

    def first_break(self, entry):
        time, name, kind, storey, side, _, cause, force = break_row(entry, self.model)
        place = f"storey {storey}" if storey.isdigit() else storey
        return f"{time:7.2f} s  first spring breaks: {kind.replace('_', '-')} joint {name}, {place}, {side}, {cause} {force / 1000:.1f} kN"

    def update(self):
        """Tell new events and bring the bar up to date."""
        if self.bar.disable:
            return
        for name, text in self.events():
            if text and name not in self.told:
                self.told.add(name)
                self.bar.write(text, file=sys.stderr)
        broken = sum(j.isFinished for j in self.joints.joints) - sum(j.broken for j in self.model.joints)
        self.bar.set_postfix_str(f"drift {ratio(max(self.monitor.peak, default=0.0))}, {broken}/{len(self.model.joints)} joints broken", refresh=False)
        self.bar.update(min(O.time, self.bar.total) - self.bar.n)

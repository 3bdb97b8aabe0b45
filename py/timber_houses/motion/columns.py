# SPDX-License-Identifier: GPL-2.0-or-later
"""Columns of records in CSV: their names and units, time steps, channels."""
import numpy as np

from .record import RecordError
from .text import UP, Channel, finite, positive, require_step

DIRECTIONS = {"ns": 0.0, "ew": 90.0, "ud": UP}
ALIASES = {"n-s": "ns", "e-w": "ew", "u-d": "ud", "north": "ns", "east": "ew", "up": "ud", "t": "time"}
FILLING = ",; \t"  # what a spreadsheet adds to short rows
SPACING_TOLERANCE = 0.1
"""Largest deviation of a time column from equal spacing, in steps: room for printed rounding, none for a gap."""


def uncommented(line):
    """Text of a comment, without the signs around it."""
    return line.strip(FILLING + '"').removeprefix("#").strip()


def column_name(cell):
    """'NS [gal]', 'ns_gal', 'N-S(gal)' -> ('ns', 'gal'); 'time' -> ('time', None)."""
    text = cell.strip().strip('"').strip()
    name = text[: next((i for i, c in enumerate(text) if not (c.isalpha() or c == "-")), len(text))]
    rest = text[len(name) :].strip()
    unit = rest.strip("_[]() \t")
    if rest and not (rest[0] in "[(_" and unit):
        return text.lower(), None
    return ALIASES.get(name.lower(), name.lower()), unit or None


def equal_step(path, stated, times):
    """Time step [s]. stated: {'dt' or 'sampling': (text, place)}; times: column [s] or None. Raises RecordError."""
    steps = {}
    if "sampling" in stated:
        text, where = stated["sampling"]
        steps[where] = 1.0 / positive(text.lower().removesuffix("hz"), where)
    if "dt" in stated:
        text, where = stated["dt"]
        steps[where] = finite(text.removesuffix("s"), where)
    if times is not None and not steps:
        steps[path] = (times[-1] - times[0]) / (len(times) - 1)
    if not steps:
        raise RecordError(f"{path}: no time step; give a time column [s] or a comment '# dt: 0.01' [s]")
    where, step = steps.popitem()
    require_step(step, where)
    if any(abs(other / step - 1) > 1e-6 for other in steps.values()):
        raise RecordError(f"{where}: {step:g} s contradicts the rate of sampling; state one of them")
    if times is not None:
        late = np.abs(times - times[0] - step * np.arange(len(times))) / step
        rounding = 0.0  # half a unit of the last decimal with which they are printed, of at most six
        if stated.keys() & {"dt", "sampling"}:
            digits = next((k for k in range(7) if np.abs(times * 10**k - np.round(times * 10**k)).max() < 1e-6), 7)
            rounding = min(0.5 * 10.0**-digits / step, 1.0)
        if late.max() > max(SPACING_TOLERANCE, rounding + 1e-6):
            raise RecordError(f"{path}: sample {late.argmax()}: times are not {step:g} s apart; equal steps needed, or"
                              " '# dt:' where the times are rounded")
    return step


def channels_of(path, names, rows, step, begins=None):
    """One channel for each column of accelerations; rows (n, columns) in m/s2."""
    return [Channel(path, step, rows[:, index], DIRECTIONS[name], begins) for index, name in enumerate(names)
            if name in DIRECTIONS]

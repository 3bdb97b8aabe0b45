# SPDX-License-Identifier: GPL-2.0-or-later
"""Records of K-NET and KiK-net (NIED), as ASCII and as CSV; the mean of the whole record is removed from each channel.

ASCII: "About K-NET ASCII format" (17 header lines, whole counts, scale factor). Its Record Time includes the logger's
trigger delay: the first sample is 15 s earlier (DELAY). CSV: a header behind '#', each row of labels followed by a row
of values, the names of the columns last."""
import re
import warnings
from datetime import timedelta

import numpy as np

from ..base.input_file import shown
from .columns import FILLING, channels_of, column_name, equal_step, uncommented
from .networks import PLAIN_CSV
from .record import GAL, RecordError, RecordWarning, unit_factor
from .text import UP, Channel, clock, direction_of, finite, numbers, positive, require_count, require_step, table

HEADER_LINES = 17  # of an ASCII file
CSV_HEADER_LINES = 60  # lines in which the names of the columns of a CSV file are searched
KIK_DIRECTIONS = {"1": 0.0, "2": 90.0, "3": UP, "4": 0.0, "5": 90.0, "6": UP}
"""Channel numbers of KiK-net: 1-3 borehole, 4-6 surface, each north, east, up."""
DELAY = timedelta(seconds=15)
"""Record Time of an ASCII file is this much after its first sample (NIED, on the loggers' trigger delay)."""
MAX_TOLERANCE = 0.02
"""Relative difference from the header's Max. Acc., of 3 to 6 digits, above which a warning is given."""

_FIELDS = {"Record Time": "", "Sampling Freq": "(Hz)", "Duration Time": "(s)", "Dir.": "", "Scale Factor": "",
           "Max": "(gal)"}
"""Beginning of a header line -> unit before its value. There are two spellings: 'Max. Acc. (gal)' and 'Max Acc. (gal)'.
"""
_OPTIONAL = ("Record Time", "Max")  # fields without which the record can be used


def read_ascii(path, lines, units):
    """Channel of an ASCII file: counts times scale factor."""
    _refuse_units(path, units)
    fields = _fields(path, lines)
    sampling, where = fields["Sampling Freq"]
    rate = positive(sampling.removesuffix("Hz"), where)
    counts = numbers(path, lines[HEADER_LINES:], HEADER_LINES + 1)
    require_count(path, len(counts), round(finite(*fields["Duration Time"]) * rate), "Duration Time x Sampling Freq",
                  PLAIN_CSV)
    scale, place = fields["Scale Factor"]  # '3920(gal)/6182761'
    gal, form, per = scale.partition("(gal)/")
    if not form:
        raise RecordError(f"{place}: {shown(scale)}; it must be like 3920(gal)/6182761")
    values = (counts - counts.mean()) * (GAL * positive(gal, place) / positive(per, place))
    if "Max" in fields:
        peak, stated = np.abs(values).max() / GAL, finite(*fields["Max"])
        if abs(peak - stated) > MAX_TOLERANCE * stated + 0.01:
            warnings.warn(f"{path}: largest acceleration {peak:.3f} gal, the header says {stated:g} gal", RecordWarning,
                          stacklevel=2)
    direction = fields["Dir."][0]
    recorded = clock(*fields["Record Time"]) if "Record Time" in fields else None
    begins = recorded and recorded - DELAY
    azimuth = KIK_DIRECTIONS.get(direction, direction_of(direction))
    return [Channel(path, require_step(1.0 / rate, where), values, azimuth, begins)]


def _fields(path, lines):
    """{beginning of a header line: (value, file:line: beginning)}."""
    fields = {}
    for number, line in enumerate(lines[:HEADER_LINES], 1):
        text = line.strip()
        for label, unit in _FIELDS.items():
            value = text.removeprefix(label).partition(unit)[2] if unit else text.removeprefix(label)
            if text.startswith(label) and value.strip() and label not in fields:
                fields[label] = (" ".join(value.split()[: 2 if label == "Record Time" else 1]),
                                 f"{path}:{number}: {label}")
    missing = [f"'{label}'" for label in _FIELDS if label not in fields]
    if any(label not in fields for label in _FIELDS if label not in _OPTIONAL):
        problem = f"K-NET header without {', '.join(missing)} in its {HEADER_LINES} lines"
        raise RecordError(f"{path}: {problem}; get the file again, or convert it to {PLAIN_CSV}")
    return fields


def _refuse_units(path, units):
    if units is not None:
        raise RecordError(f"{path}: K-NET files state their unit; give no unit")


_COLUMN = re.compile(r"(n-?s|e-?w|u-?d)(.*)", re.I)
_UNIT = re.compile(r"\(([^()]*/[^()]*|gal|g)\)", re.I)
_SURFACE, _BOREHOLE = re.compile("2|surf|地表", re.I), re.compile("1|bor|down|bh|地中", re.I)
"""Marks of the sensors of a KiK-net station in the names of its columns."""


def is_csv(lines):
    first = lines[0].upper()
    return "K-NET CSV" in first or "KIK-NET CSV" in first or any(
        column_name(cell)[0] == "relativetime" for line in lines[:CSV_HEADER_LINES]
        for cell in uncommented(line).split(","))


def read_csv(path, lines, units):
    """Channels of a CSV file in its own unit; of a KiK-net file those of the surface sensor."""
    _refuse_units(path, units)
    last, columns = _csv_columns(path, lines)
    cells = [column_name(cell)[0] for cell in columns]
    clocks = [k for k, cell in enumerate(cells) if cell == "time"]  # a date and time; relativetime is in s
    rows = table(path, lines[last + 1 :], last + 2, len(columns), ",", texts=clocks)
    stated = _labelled(path, lines[: last + 1])
    times = rows[:, cells.index("relativetime")] if "relativetime" in cells else None
    step = equal_step(path, {"sampling": stated["samplingfrequency(hz)"]} if "samplingfrequency(hz)" in stated else {},
                      times)
    if "durationtime(s)" in stated:
        require_count(path, len(rows), round(positive(*stated["durationtime(s)"]) / step),
                      "DurationTime x SamplingFrequency", PLAIN_CSV)
    chosen = _surface_columns(columns)
    factors = [unit_factor((_UNIT.search(columns[k]) or ["", "gal"])[1], path) for k in chosen.values()]
    values = rows[:, list(chosen.values())] * factors
    begins = None
    if clocks:
        number = next(k for k, line in enumerate(lines[last + 1 :], last + 2) if line.strip(FILLING))
        begins = clock(lines[number - 1].split(",")[clocks[0]], f"{path}:{number}: Time")
    return channels_of(path, list(chosen), values - values.mean(axis=0), step, begins)


def _csv_columns(path, lines):
    """(index of the row of names: the last that names a direction, its cells)."""
    for index in reversed(range(min(CSV_HEADER_LINES, len(lines)))):
        cells = [cell.strip().strip('"') for cell in uncommented(lines[index]).split(",")]
        if any(_COLUMN.match(cell) for cell in cells):
            return index, cells
    problem = "K-NET CSV without a row that names N-S, E-W or U-D"
    raise RecordError(f"{path}: {problem}; get the file again, or convert it to {PLAIN_CSV}")


def _labelled(path, header):
    """{label: (value, file:line: label)} of rows of labels, each followed by a row of values."""
    rows = [uncommented(line).split(",") for line in header]
    return {label.replace(" ", "").lower(): (value.strip(), f"{path}:{number}: {label}")
            for number, (labels, values) in enumerate(zip(rows, rows[1:]), 2) for label, value in zip(labels, values)}


def _surface_columns(columns):
    """{'ns', 'ew', 'ud': number of the column}, of the surface sensor where there are two: marked so, or second."""
    chosen = {}
    for k, column in enumerate(columns):
        match = _COLUMN.match(column)
        if match is None:
            continue
        name, mark = match[1].replace("-", "").lower(), _UNIT.sub("", match[2])
        surface = bool(_SURFACE.search(mark)) - bool(_BOREHOLE.search(mark))
        if name not in chosen or surface >= chosen[name][0]:
            chosen[name] = surface, k
    return {name: k for name, (_, k) in chosen.items()}

# SPDX-License-Identifier: GPL-2.0-or-later
"""Files to ground motion: the files of one record, and the mapping of their components.

The record's components become the axes of the house (x east, y north, z up) through their azimuths, clockwise
from north: K-NET's N-S is 0, PEER's 090 is 90, and 180 is north-south with its sign changed."""
import os
import re
import warnings
from os.path import commonprefix
from pathlib import Path

import numpy as np

from ..base.errors import one_line
from ..base.input_file import exists, is_file, is_folder, shown
from .formats import parse
from .processing import round_off, turned
from .record import (GAL, STANDARD_GRAVITY, GroundMotion, RecordError, RecordWarning, require_possible,
                     warn_of_constant_part)
from .text import DOWN, UP, direction_of, read_lines

RIGHT_ANGLE_TOLERANCE = 1.0
"""Largest deviation of two horizontal components from a right angle. [degrees] (PEER prints whole degrees)"""
SUFFIXES = (("K-NET", r"\.(?:ns|ew|ud)", "PREFIX.NS .EW .UD"),
            ("KiK-net surface", r"\.(?:ns|ew|ud)2", "PREFIX.NS2 .EW2 .UD2"),
            ("KiK-net borehole", r"\.(?:ns|ew|ud)1", "PREFIX.NS1 .EW1 .UD1"),
            ("PEER", r"(?:\d{3}|[-_.]?(?:up|dwn|ud|ver|vert|v|ns|ew)|[-_.][enz]|[hbe][nlhg][nez]|[ns]\d{2}[ew]|[lt])"
                     r"\.at2",
             "PREFIX000.AT2 PREFIX090.AT2 PREFIX-UP.AT2"),
            ("PEER, KiK-net surface", r"(?:ns|ew|ud)2\.at2", "PREFIXNS2.AT2 ..."),
            ("PEER, KiK-net borehole", r"(?:ns|ew|ud)1\.at2", "PREFIXNS1.AT2 ..."))
"""Endings of the names of a record's three files, tried in this order: of a KiK-net pair the surface sensor is taken
(the borehole's three files can be named one by one)."""
MAX_COMPONENTS, MAX_SHOWN_FILES = 3, 6
SURPRISING = 5 * STANDARD_GRAVITY  # acceleration above which a warning is given. [m/s2]
DEFAULT_RECORD = Path(__file__).resolve().parent.parent / "data" / "ojiya_like.csv"
"""The synthetic Ojiya-like motion that the package ships: output of the generator for DEFAULT_SEED."""


def default_motion():
    """The shipped synthetic Ojiya-like motion -> GroundMotion."""
    return read_motion(DEFAULT_RECORD)


def read_motion(record, component=None, units=None, angle=0.0, trim_to_shortest=False):
    """Read a ground motion from K-NET, KiK-net, PEER AT2, JMA CSV or plain CSV files. Warns of a constant part.

    Parameters
    ----------
    record : str or Path
        A file, three files separated by commas, or the common prefix of three files.
    component : str, optional
        Direction of each file ('ns', 'ew', 'ud', or an azimuth in degrees), separated by commas; replaces the
        directions in the files, needed only where a file does not state its own.
    units : str, optional
        Unit of the numbers (gal, m/s2, g) where the file does not state it; a contradiction is refused.
    angle : float
        Azimuth of the record's north in the house's frame: degrees clockwise, seen from above, from the house's +y to
        the record's north.
        With 90 the record's north component shakes the house along +x.
    trim_to_shortest : bool
        Cut components of different length at the shortest one instead of refusing them.

    Returns
    -------
    GroundMotion
        A component that no file gives is zero, and its `source` says so.

    Raises
    ------
    RecordError
        Missing, truncated, unknown format, not a number, no unit, components of different records.
    """
    return warn_of_constant_part(read_unchecked(record, component, units, angle, trim_to_shortest))


def read_unchecked(record, component=None, units=None, angle=0.0, trim_to_shortest=False):
    """The same without a warning of a constant part, which processing may still remove."""
    paths = find_files(record)
    channels = [channel for path in paths for channel in parse(path, read_lines(path), units, component is not None)]
    directions = _directions(channels, component)
    dt, values = _aligned(channels, trim_to_shortest)
    acceleration = _to_house_axes(str(record), values, directions)
    peak = np.abs(acceleration).max()
    require_possible(peak, record)
    if peak > SURPRISING:
        warnings.warn(f"{record}: {peak / GAL:.0f} gal, more than any recorded motion; check the unit", RecordWarning,
                      stacklevel=2)
    stems = [path.stem for path in paths]
    name = stems[0] if len(stems) == 1 else commonprefix(stems).rstrip("-_.") or stems[0]
    times = {channel.begins for channel in channels} - {None}
    if len(times) > 1:
        stated = ", ".join(f"{c.path.name}: {c.begins}" for c in channels)
        raise RecordError(f"components begin at different times ({stated}); they must be of one recording")
    source = one_line(_provenance(channels, directions))
    return turned(GroundMotion(dt, acceleration, one_line(name), source, next(iter(times), None)), angle)


def find_files(record):
    """Files of a record: one file, a comma-separated list, or three files with a common prefix. Raises RecordError."""
    path = Path(os.path.expanduser(str(record)))
    if is_file(path):
        return [path]
    if is_folder(path):
        raise RecordError(f"{record}: is a folder; give a file, three files or the prefix of three files")
    if exists(path):
        raise RecordError(f"{record}: not a regular file; copy its content to a file")
    parts = [Path(os.path.expanduser(part.strip())) for part in str(record).split(",")]
    if len(parts) == 1 or is_folder(path.parent) and "," not in path.name:
        return _find_by_prefix(path)
    if len(parts) > MAX_COMPONENTS:
        raise RecordError(f"{record}: {len(parts)} files; at most {MAX_COMPONENTS}, one for each component")
    for part in parts:
        if not is_file(part):
            raise RecordError(f"{part}: no such file, or not a regular one")
    return parts


def _find_by_prefix(prefix):
    folder = prefix.parent
    try:
        names = sorted(p.name for p in folder.iterdir()) if is_folder(folder) else []
    except OSError as error:
        raise RecordError(f"{folder}: cannot be read ({error.strerror})") from None
    start = prefix.name.rstrip(".")  # a shell completes the prefix up to the point
    rests = {name[len(start) :]: folder / name for name in names if name.startswith(start)}
    partial = []
    for _, pattern, _ in SUFFIXES:
        files = [path for rest, path in rests.items() if re.fullmatch(pattern, rest, re.I)]
        if len(files) == 3:
            return files
        partial += [path.name for path in files]
        if files:  # not another sensor in its place
            break
    forms = " or ".join(form for _, _, form in SUFFIXES)
    others = [path.name for path in rests.values()][:MAX_SHOWN_FILES] if start else []
    seen = (f"; found only {', '.join(sorted(partial))}" if partial else
            f"; files of that beginning: {', '.join(others)}" if others else "")
    raise RecordError(f"{prefix}: no such file, and no three files {forms}{seen}")


def _directions(channels, component):
    """Direction of every channel, from the caller or from the files."""
    if component is None:
        for channel in channels:
            if channel.direction is None:
                raise RecordError(f"{channel.path}: direction not stated; give it: --component ns, ew, ud or an"
                                  " azimuth")
        return [channel.direction for channel in channels]
    names = str(component).split(",")
    if len(names) != len(channels):
        raise RecordError(f"component={component}: {len(names)} directions for {len(channels)} components")
    for name in names:
        if direction_of(name) is None:
            raise RecordError(f"component={shown(name)}: unknown direction; admissible: ns, ew, ud, down, azimuth -360"
                              " to 360")
    return list(map(direction_of, names))


def _aligned(channels, trim_to_shortest):
    """(dt [s], (n, channels) [m/s2]) of channels that must share step and length."""
    dt = channels[0].dt
    for channel in channels:
        if abs(channel.dt - dt) > 1e-9 * dt:
            raise RecordError(f"{channel.path}: time step {channel.dt:g} s; {channels[0].path.name} has {dt:g} s")
    lengths = [len(channel.values) for channel in channels]
    if min(lengths) != max(lengths) and not trim_to_shortest:
        stated = ", ".join(f"{c.path.name}: {n}" for c, n in zip(channels, lengths))
        raise RecordError(f"components of different length ({stated}); cut them at the shortest (--shortest), or make"
                          " them equal")
    return dt, np.column_stack([channel.values[: min(lengths)] for channel in channels])


def _to_house_axes(record, values, directions):
    """(n, 3) in the axes east, north, up from one to three channels with known directions."""
    vertical = [i for i, d in enumerate(directions) if d in (UP, DOWN)]
    level = [i for i, d in enumerate(directions) if d not in (UP, DOWN)]
    if len(vertical) > 1 or len(level) > 2:
        raise RecordError(f"{record}: {len(level)} horizontal and {len(vertical)} vertical components; at most 2 and 1")
    acceleration = np.zeros((len(values), 3))
    if len(level) == 2:
        first, second = (directions[i] for i in level)
        if abs((first - second) % 180.0 - 90.0) > RIGHT_ANGLE_TOLERANCE:
            raise RecordError(f"{record}: horizontal azimuths {first:g} and {second:g} degrees; they must be 90 apart")
    for i in level:
        azimuth = np.radians(directions[i])
        acceleration[:, 0] += values[:, i] * round_off(np.sin(azimuth))
        acceleration[:, 1] += values[:, i] * round_off(np.cos(azimuth))
    for i in vertical:
        acceleration[:, 2] = values[:, i] if directions[i] == UP else -values[:, i]
    return acceleration


def _provenance(channels, directions):
    """One line: the files, the direction of each component, a note on missing components."""
    by_file = {}
    for channel, direction in zip(channels, directions):
        name = f"{direction:g} deg" if isinstance(direction, float) else direction
        by_file.setdefault(channel.path.name, []).append({0.0: "ns", 90.0: "ew"}.get(direction, name))
    files = ", ".join(f"{file} ({', '.join(names)})" for file, names in by_file.items())
    note = "" if len(channels) == 3 else "; the other components are zero"
    return files + note

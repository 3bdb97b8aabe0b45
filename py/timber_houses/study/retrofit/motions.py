# SPDX-License-Identifier: GPL-2.0-or-later
"""Ground motions of a ranking: synthetic ones of several seeds, or the records of a folder, scaled to a target."""
import re
from itertools import groupby
from pathlib import Path

from ...base.errors import RunError
from ...base.input_file import is_folder
from ...base.notes import noted
from ...base.time_step import DEFAULT_DT
from ...motion import MotionRequest, RecordError, onset, significant_duration
from ...motion.formats import sniff
from ...motion.readers import SUFFIXES, find_files
from ...motion.text import read_lines

START, END = 14.0, 34.0
"""Part of a synthetic motion that is run: quiet, strong shaking (18-24 s), and ten seconds for a collapse. [s]"""
LEAD, TAIL = 4.0, 10.0
"""Part of a record that is run: from LEAD before its strong shaking to TAIL after its significant duration. [s]"""
ENDINGS = (*(pattern for _, pattern, _ in SUFFIXES), r"[-_.](?:ns|ew|ud)\.(?:csv|acc)")
"""Endings of the names of one record's files."""
RECORD_FILES = (".ew", ".ns", ".ud", ".ew2", ".ns2", ".ud2", ".at2", ".csv", ".acc")


def seeds(count, target=None, end=END):
    """[(name, {option: value})] of synthetic motions 1 ... count up to `end` [s]. target: {'scale' | 'pga' |
    'intensity': number}"""
    return [(f"seed{seed}", {"seed": seed, "start": START, "end": end, **(target or {})})
            for seed in range(1, count + 1)]


def records(folder, target=None, units=None):
    """[(name, {option: value})] of the records in a folder, cut to their strong shaking. units: if files state none"""
    folder = Path(folder).resolve()
    if not is_folder(folder):
        raise RunError(f"{folder}: no such folder of records")
    files = sorted(path for path in folder.iterdir()
                   if path.suffix.lower() in RECORD_FILES
                   and (path.suffix.lower() != ".csv" or sniff(read_lines(path))))  # not a list of search results
    if not files:
        raise RunError(f"{folder}: no records; files must end in {', '.join(RECORD_FILES)}")
    named = dict(_record(prefix, list(paths)) for prefix, paths in groupby(sorted(files, key=_prefix), _prefix))
    stated = {"units": units} if units else {}
    return [(name, {"record": record, **stated, **window(record, units), **(target or {})})
            for name, record in named.items()]


def _prefix(path):
    """Path without the ending that names a component; files of one record have the same."""
    for pattern in ENDINGS:
        split = re.fullmatch(f"(.+?){pattern}", path.name, re.I)
        if split:
            return path.with_name(split[1])
    return path


def _record(prefix, paths):
    """(name, record as the option --record takes it) of the files with one prefix."""
    if len(paths) == 1:
        return paths[0].stem, str(paths[0])
    try:
        is_prefix = set(find_files(prefix)) == set(paths)
    except RecordError:
        is_prefix = False
    return prefix.name, str(prefix) if is_prefix else ",".join(map(str, paths))


def window(record, units=None):
    """{'start', 'end'} of the part of a record that is run. Raises RecordError."""
    with noted():
        motion = MotionRequest(record=record, units=units).motion(DEFAULT_DT)
    begin = onset(motion)
    if begin is None:
        raise RecordError(f"{record}: no shaking")
    return {"start": round(max(0.0, begin - LEAD), 2),
            "end": round(min(motion.duration, begin + significant_duration(motion) + TAIL), 2)}

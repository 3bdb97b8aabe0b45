# SPDX-License-Identifier: GPL-2.0-or-later
"""Files of an ensemble: runs of one scenario whose vertices differ by at most 1e-9 m.

The folder of the ensemble holds ensemble.json, ensemble.csv, the results of the run that is shown, and a folder for
each run: runs/001, runs/002, ... Run 1 is undisturbed; run k is disturbed with the seed k."""
import json

from ..base.errors import RunError
from ..base.input_file import exists, is_file
from ..base.record_file import read_record
from .history import NAME as HISTORY
from .history import History

NAME, TABLE, RUNS = "ensemble.json", "ensemble.csv", "runs"
NAMES = (NAME, TABLE)  # files beside the results of the run that is shown


def run_folder(folder, number):
    return folder / RUNS / f"{number:03d}"


def has_runs(folder):
    """Whether a folder holds an ensemble with the histories of all its finished runs."""
    return exists(folder / NAME) and all(is_file(run_folder(folder, number) / HISTORY)
                                         for number in read(folder)["finished"])


def read(folder):
    """Content of ensemble.json. Raises RunError."""
    path = folder / NAME
    text = read_record(path)
    try:
        content = json.loads(text)
        return {**content, "finished": list(map(int, content["finished"])), "shown": int(content["shown"])}
    except (ValueError, LookupError, TypeError, RecursionError, OverflowError) as problem:
        raise RunError(f"{path}: cannot be read as the results of an ensemble: {problem}") from None


def histories(folder):
    """{number: History} of the finished runs. Raises RunError."""
    return {number: History.read(run_folder(folder, number) / HISTORY) for number in read(folder)["finished"]}

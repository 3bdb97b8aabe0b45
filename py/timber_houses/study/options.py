# SPDX-License-Identifier: GPL-2.0-or-later
"""Command lines of studies and benchmarks: one line and exit status 1 for bad input."""
import argparse
import math
import sys
import tempfile
from pathlib import Path


from ..base.encoding import print_anything
from ..base.errors import InputError, RunError
from ..base.files import make_folder
from ..base.time_step import DEFAULT_DT
from ..house import load_house
from ..motion import MotionRequest


class Parser(argparse.ArgumentParser):
    """ArgumentParser that describes itself by a docstring and reports bad input in one line."""

    def __init__(self, about, **settings):
        super().__init__(description=about, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False,
                         **settings)

    def error(self, message):
        self.exit(1, f"error: {' '.join(message.split())} (options: -h)\n")


def run_script(main):
    """Call main() and exit with what it returns; expected errors become one line and exit status 1."""
    print_anything()
    try:
        sys.exit(main())
    except (InputError, OSError) as problem:
        sys.exit(f"error: {problem}")
    except KeyboardInterrupt:
        sys.exit("stopped; the same command continues")


def _number(kind, low, noun):
    """Type of a number: int or float, from the smallest admissible value on, finite."""

    def read(text):
        try:
            value = kind(text) if len(text) <= 30 else math.nan
        except ValueError:
            value = math.nan
        if not low <= value < 1e9:
            raise argparse.ArgumentTypeError(f"'{text[:40]}': must be {noun}, smaller than 1e9")
        return value

    return read


count = _number(int, 1, "a whole number >= 1")
seed = _number(int, 0, "a whole number >= 0")
positive = _number(float, sys.float_info.min, "a number > 0")
non_negative = _number(float, 0, "a number >= 0")


def _checked(check):
    """Type of a text that `check` accepts without an InputError."""

    def read(text):
        try:
            check(text)
        except InputError as problem:
            raise argparse.ArgumentTypeError(str(problem)) from None
        return text

    return read


house = _checked(load_house)
record = _checked(lambda text: MotionRequest(record=text).motion(DEFAULT_DT))


def list_of(kind):
    """Type of a comma-separated list: 'list_of(positive)' reads '0.5,1'."""
    return lambda text: [kind(part) for part in text.split(",")]


def results_folder(text):
    """A folder for results, made here; files can be written in it."""
    if not str(text):
        raise argparse.ArgumentTypeError("'': must be the name of a folder")
    try:
        make_folder(text)
        with tempfile.TemporaryFile(dir=text):
            return Path(text)
    except (OSError, ValueError) as problem:
        raise argparse.ArgumentTypeError(f"'{str(text)[:80]}': no results can be written there:"
                                         f" {getattr(problem, 'strerror', None) or problem}") from None


def add_driver_options(parser, folder):
    """Options of every study: folder of the runs and number of processes."""
    parser.add_argument("--out", type=results_folder, default=folder, metavar="DIR",
                        help="folder that holds a folder for each run (default %(default)s)")
    parser.add_argument("-j", "--jobs", type=count, metavar="N", help="runs at a time (default: one per core)")


def selected(text, choices, option):
    """Names of a comma-separated list; all known names without a list. Raises RunError for an unknown name."""
    names = text.split(",") if text else list(choices)
    unknown = [name for name in names if name not in choices]
    if unknown:
        raise RunError(f"{option}: unknown: {', '.join(unknown)}; known: {', '.join(choices)}")
    return names

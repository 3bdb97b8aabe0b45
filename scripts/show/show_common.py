# SPDX-License-Identifier: GPL-2.0-or-later
"""Shared by the show scripts: path of the package, path options, errors in one line."""
import argparse
import re
import sys
from contextlib import contextmanager
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "py"))  # after the installed package, which the runs use

from timber_houses.base.encoding import print_anything
from timber_houses.base.errors import InputError
from timber_houses.base.input_file import is_folder

print_anything()

UNUSABLE = (ValueError, ArithmeticError, MemoryError)
"""Raised by numpy and matplotlib for valid input with extreme numbers, such as a picture of too many pixels."""


class Parser(argparse.ArgumentParser):
    """Reports a wrong option in one line and exits with status 1."""

    def error(self, message):
        sys.exit(f"error: {_line(message)}")


def path(text):
    """Path of a file or folder, for argparse."""
    if not text.strip():
        raise argparse.ArgumentTypeError("the path is empty")
    return Path(text)


def file_name(name):
    """Path in this folder made from a name of any characters."""
    return Path(re.sub(r"[^\w. -]", "_", name)[:80] or "_")


def frames_path(run):
    """The frames of what RECORDED says."""
    from timber_houses.recording import frames

    return run / frames.NAME if is_folder(run) else run


RECORDED = "folder of a run's results, its frames.h5, or a log of yt.record"


@contextmanager
def errors_in_a_line(output):
    """Ends the script with one line and status 1: on an InputError, on extreme numbers, or when the output cannot be
    written.
    """
    try:
        yield
    except InputError as problem:
        sys.exit(f"error: {_line(problem)}")
    except UNUSABLE as problem:
        sys.exit(f"error: {output}: cannot be made from this input ({type(problem).__name__}: {_line(problem)[:200]})")
    except OSError as problem:
        sys.exit(f"error: {output}: cannot be written: {problem.strerror or _line(problem)}")


def _line(problem):
    return " ".join(str(problem).split())

# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run was made from: its options, the files they name, this package. Results made from something else are done again. Needs no YADE."""
import sys
from functools import cache
from hashlib import sha256
from pathlib import Path

from ..house import HouseError
from ..house.loader import house_files
from ..motion import RecordError
from ..motion.readers import find_files

PARTS = ("*.py", "base/*.py", "house/*.py", "motion/*.py", "scene/*.py", "run/*.py", "recording/*.py", "data/*.csv", "data/houses/*")
"""Files of the package that may decide a result, besides its module."""


def made_from(options):
    """Content of `made_from` in summary.json: the words of the command line that decide the result, and fingerprints of the files they name and of the package."""
    words = [str(word) for word in options]
    try:
        files = fingerprint(_named_files(words))
    except (HouseError, RecordError, OSError):
        files = None  # the run will say what is wrong with them
    return {"options": words, "files": files, "package": package()}


@cache
def package():
    """Fingerprint of this package: module, Python files, shipped data."""
    folder = Path(__file__).resolve().parents[1]
    module = Path(sys.modules[__package__.partition(".")[0]].__path__[0]) / "_yade_timber.so"
    return fingerprint([*filter(Path.is_file, [module]), *(path for pattern in PARTS for path in sorted(folder.glob(pattern)))])


def fingerprint(paths):
    """Hexadecimal fingerprint of what is in these files, in this order."""
    total = sha256()
    for path in paths:
        total.update(sha256(Path(path).read_bytes()).digest())
    return total.hexdigest()[:16]


def _named_files(words):
    """House files, with what they extend, and records."""
    files = []
    for before, word in zip(["", *words], words):
        option, _, value = word.partition("=") if word.startswith("--") else (before, "", word)
        if option == "--record" and value:
            files += find_files(value)
        elif value.endswith((".yaml", ".yml")):
            files += house_files(value)
    return files

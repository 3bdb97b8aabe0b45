# SPDX-License-Identifier: GPL-2.0-or-later
"""The identity of a run: the options that decide its results, fingerprints of the files that they name and of the
package. Needs no YADE.

`made_from` stands in summary.json; a study repeats a run whose `made_from` has changed. Checkpoint and frames carry
`identity`, which allows another duration and moved house and record files."""
import json
from functools import cache
from hashlib import sha256
from pathlib import Path

import yade_timber

from ..base.errors import InputError
from ..house.description import house_path
from ..house.loader import house_files
from ..motion.readers import find_files
from ..motion.sequence import following, with_factor

ROOMS = ("*.py", "base/*.py", "house/*.py", "house/*/*.py", "motion/*.py", "scene/*.py", "run/*.py", "recording/*.py",
         "data/*.csv", "data/houses/*")
"""Files of a package that decide results, besides the compiled module."""
DISPLAY = ("base/colors.py", "run/progress.py", "recording/ensemble.py")
"""Files in these rooms that change only the display."""


def made_from(options):
    """Content of `made_from` in summary.json. options: RunOptions"""
    try:
        records = [options.record] if options.record else []
        records += [record for record, _ in following(options.then, "then")] if options.then else []
        files = of_files([*filter(None, [options.town]), *house_files(house_path(options.house)),
                          *(file for record in records for file in find_files(record))])
    except (InputError, OSError):
        files = None  # the run itself reports the fault
    return {"options": options.decisive(), "files": files, "package": package()}


def content(origin):
    """{property: value} of a run wherever its files are. origin: its `made_from`"""
    options = {name: value for name, value in origin["options"].items() if name not in ("record", "town")}
    if "then" in options:
        options["then"] = [with_factor(entry)[1] for entry in options["then"].split(";")]
    return {**options, "house": Path(options["house"]).stem, "content of files": origin["files"]}


def identity(origin):
    """{property: value} that a checkpoint and the run that continues it share. origin: `made_from` of the run"""
    shared = {name: value for name, value in content(origin).items() if name != "duration"}
    return {**shared, "package": origin["package"]}


@cache
def package():
    """Fingerprint of both packages: compiled module, Python files that decide results, shipped data."""
    plugin = Path(yade_timber.__path__[0])
    return of_files([*filter(Path.is_file, [plugin / "_yade_timber.so"]), *decisive_files(plugin),
                     *decisive_files(Path(__file__).resolve().parents[1])])


def decisive_files(folder):
    """Files of the package in `folder` that decide results."""
    paths = (path for pattern in ROOMS for path in sorted(folder.glob(pattern)))
    return [path for path in paths if path.is_file() and path.relative_to(folder).as_posix() not in DISPLAY]


def of_arrays(arrays):
    total = sha256()
    for array in arrays:
        total.update(f"{array.shape}{array.dtype}".encode())
        total.update(array.tobytes())
    return total.hexdigest()[:16]


def of_values(values):
    return sha256(json.dumps(values, sort_keys=True).encode()).hexdigest()[:16]


def of_files(paths):
    """Of the content of files, in this order. Raises OSError."""
    total = sha256()
    for path in paths:
        total.update(sha256(Path(path).read_bytes()).digest())
    return total.hexdigest()[:16]

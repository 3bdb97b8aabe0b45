# SPDX-License-Identifier: GPL-2.0-or-later
"""request.json: the options of a run in its folder, from which a process of a study takes them."""
import json

from ..base.atomic_write import write_text
from ..base.options import is_given, options, read_keywords
from ..base.record_file import read_record
from .options import SCRIPT, OptionSource, RunOptions

NAME = "request.json"


def write(request):
    """Write the options of a run, a RunOptions without a ground motion from Python, into its folder. Raises OSError."""
    given = {name: getattr(request, name) for name in options(RunOptions) if is_given(request, name)}
    write_text(request.folder / NAME, json.dumps({"name": request.name, **given}, default=str, indent=1) + "\n")


def read(folder):
    """RunOptions of the request in a folder. Raises RunError."""
    given = json.loads(read_record(folder / NAME))
    name = given.pop("name")
    return RunOptions(name=name, source=SCRIPT if name else OptionSource(), **read_keywords(RunOptions, NAME, given))

# SPDX-License-Identifier: GPL-2.0-or-later
"""The identity of a run: everything that decides its results, and nothing else. Needs no YADE.

`identity`   of a built run: the values of its scenario, fingerprints of the house as built and of the package. Checkpoint and frames carry it.
`made_from`  the same from the command line, before anything is built: options, fingerprints of the files they name and of the package.
             summary.json carries it; a study repeats a run whose `made_from` has changed.
"""
import json
import sys
from functools import cache
from hashlib import sha256
from pathlib import Path

from ..base.input_file import is_file
from ..house import HouseError
from ..house.loader import house_files
from ..motion import RecordError
from ..motion.readers import find_files
from ..motion.sequence import following

ROOMS = ("*.py", "base/*.py", "house/*.py", "motion/*.py", "scene/*.py", "run/*.py", "recording/*.py", "data/*.csv", "data/houses/*")
"""Files of the package that decide results, besides its compiled module."""
DISPLAY = ("base/colors.py", "scene/viewer.py", "run/progress.py", "recording/ensemble.py")
"""Files in these rooms that change only the display."""


def identity(scenario, model):
    """{property: value as JSON returns it} of a scenario and its HouseModel. The duration is left out: a run can be lengthened."""
    motion = scenario.motion and [scenario.motion.name, scenario.motion.dt, of_arrays([scenario.motion.acceleration])]
    joints = [[j.a, j.b, j.kn, j.ks, j.strength, j.per, j.damping_ratio, j.broken, j.kind, j.name, *_slip(j)] for j in model.joints]
    elements = [[e.name, e.kind, e.group, e.material, e.density, e.fixed, e.storey] for e in model.elements]
    known = {
        "name": scenario.name,
        "house": Path(scenario.house).stem,  # a house file may be moved: its content counts as built
        "motion": motion,
        "snow_depth": scenario.snow_depth,
        "scale": scenario.scale,
        "delay": scenario.delay,
        "dt": scenario.dt,
        "until collapse": scenario.until_collapse,
        "options": {key: str(value) for key, value in scenario.options.items()},
        "elements": of_arrays(e.vertices for e in model.elements),
        "element values": of_values(elements),
        "joints": of_arrays(part for j in model.joints for part in (j.points, j.normal)),
        "joint values": of_values(joints),
        "materials": of_values([model.materials, model.friction]),
        "law": of_values(model.law),
        "package": package(),
    }
    return json.loads(json.dumps(known))


def _slip(joint):
    return joint.law, joint.friction_share, joint.softening_stretch, joint.ultimate_stretch, joint.envelope


def made_from(options, house=None):
    """Content of `made_from` in summary.json.

    options: arguments of the command line that decide the results (cli.decisive); house: name or file that the script gives, unless they name it
    """
    arguments = [str(argument) for argument in options]
    own = [] if house is None or str(house) in arguments else [str(house)]
    try:
        files = of_files(_named_files([*arguments, *own]))
    except (HouseError, RecordError, OSError):
        files = None  # the run itself reports the fault
    return {"options": arguments, "files": files, "package": package()}


@cache
def package():
    """Fingerprint of the package: compiled module, Python files that decide results, shipped data."""
    module = Path(sys.modules[__package__.partition(".")[0]].__path__[0]) / "_yade_timber.so"
    return of_files([*filter(Path.is_file, [module]), *decisive_files(Path(__file__).resolve().parents[1])])


def decisive_files(folder):
    """Files of the package in `folder` that decide results."""
    found = (path for pattern in ROOMS for path in sorted(folder.glob(pattern)))
    return [path for path in found if path.is_file() and path.relative_to(folder).as_posix() not in DISPLAY]


# --- fingerprints: 16 hexadecimal digits ------------------------------------------------------------------------------


def of_arrays(arrays):
    """Of numpy arrays: types, shapes and bits."""
    total = sha256()
    for array in arrays:
        total.update(f"{array.shape}{array.dtype}".encode())
        total.update(array.tobytes())
    return total.hexdigest()[:16]


def of_values(values):
    """Of anything that JSON can write."""
    return sha256(json.dumps(values, sort_keys=True).encode()).hexdigest()[:16]


def of_files(paths):
    """Of the content of files, in this order. Raises OSError."""
    total = sha256()
    for path in paths:
        total.update(sha256(Path(path).read_bytes()).digest())
    return total.hexdigest()[:16]


def _named_files(arguments):
    """House files, with those they extend, and records that a command line names."""
    files = []
    for before, argument in zip(["", *arguments], arguments):
        option, _, value = argument.partition("=") if argument.startswith("--") else (before, "", argument)
        if option == "--record" and value:
            files += find_files(value)
        elif option == "--then" and value:
            files += [file for record, _ in following(value, option) for file in find_files(record)]
        elif value and not value.startswith("-") and is_file(Path(value)):
            files += house_files(value)
    return files

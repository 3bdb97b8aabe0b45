# SPDX-License-Identifier: GPL-2.0-or-later
"""Command line of the run scripts -> Scenario and where its results go. What YADE itself understands (-n, -x, -j2) stands before the script's name."""
import argparse
import math
import sys
import tempfile
import warnings
from dataclasses import dataclass
from pathlib import Path

from ..base.errors import RunError
from ..house import load_house, shipped_houses
from ..motion import add_motion_options, motion_request
from ..scene.scenario import DEFAULT_DT, MAX_DT, MIN_DT, Scenario

SNOW_DEPTH = 1.0
"""Snow on the roof of the snow runs. [m] (paper, section 3.4)"""
QUIET_DURATION = 30.0
"""Simulated time of runs without an earthquake. [s] (paper, section 4.2)"""
CHECKPOINT_INTERVAL = 2.0
"""Simulated time between checkpoints. [s]"""


@dataclass
class Output:
    """Where results go and what is made of them."""

    folder: Path
    resume: bool = False
    or_anew: bool = False  # where the checkpoint does not fit
    views: bool = True
    frames: bool = True  # no views without them
    export: Path = None
    quiet: bool = False
    checkpoint_interval: float = CHECKPOINT_INTERVAL  # simulated time [s]; 0: no checkpoints
    options: tuple = ()  # words of the command line that decide the result


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise RunError(f"{message} (options: {self.prog} -h; YADE's own options stand before the script)")


def parser(script):
    """ArgumentParser of the run script of that name."""
    made = _Parser(prog=f"yade [-n] [-x] {script}.py", allow_abbrev=False, description="Results go to results/<script name>/ unless --out says otherwise.")
    made.add_argument("--duration", type=float, metavar="S", help=f"simulated time [s] (default: the motion's; without an earthquake {QUIET_DURATION:g})")
    made.add_argument("--dt", type=float, default=DEFAULT_DT, metavar="S", help=f"time step [s], at most {MAX_DT:g} (default {DEFAULT_DT:g})")
    made.add_argument("--out", metavar="DIR", help="folder of the results")
    made.add_argument("--resume", action="store_true", help="go on from the last checkpoint in the folder of the results, if there is one")
    made.add_argument("--or-anew", action="store_true", help="with --resume: start anew where the checkpoint is damaged or of another run, instead of refusing it")
    made.add_argument("--checkpoint", type=float, default=CHECKPOINT_INTERVAL, metavar="S", help="simulated time between checkpoints [s], 0: none (default %(default)g)")
    made.add_argument("--no-views", action="store_true", help="make no pictures; scripts/show/show_run.py makes them later from the recorded frames")
    made.add_argument("--no-frames", action="store_true", help="record no frames, and make no pictures")
    made.add_argument("--export", metavar="FILE", help="write the scene at the start of the run as JSON for other solvers (with --duration 0: nothing but that)")
    made.add_argument("--every-step", action="store_true", help="compute rest, too: by default the time in which the house rests and the ground is quiet is skipped")
    made.add_argument("--quiet", action="store_true", help="say nothing but errors")
    add_motion_options(made)
    return made


def house_parser():
    """ArgumentParser of scripts/house.py, which runs any house."""
    made = parser("house")
    made.description = "Results go to results/<name of the house file>/ unless --out says otherwise."
    made.add_argument("file", metavar="HOUSE", help=f"house file, or a shipped house: {', '.join(shipped_houses())}")
    made.add_argument("--quake", action="store_true", help="shake the house with the default motion; --record does so with a recorded one")
    made.add_argument("--snow", type=float, metavar="METRES", help="depth of snow on the roofs [m] (default: the house file's)")
    return made


OUTPUT_OPTIONS = {"--out": 1, "--checkpoint": 1, "--export": 1, "--resume": 0, "--or-anew": 0, "--no-views": 0, "--no-frames": 0, "--quiet": 0}
"""Options that change nothing in a run, and how many values each has."""


def decisive(words):
    """Words of a command line that decide the result: all but OUTPUT_OPTIONS and their values."""
    kept, skip = [], 0
    for word in words:
        option, given, _ = word.partition("=")
        if skip:
            skip -= 1
        elif option in OUTPUT_OPTIONS:
            skip = 0 if given else OUTPUT_OPTIONS[option]
        else:
            kept.append(word)
    return tuple(kept)


def read(house, earthquake, snow, argv):
    """Command line (as sys.argv) of a run script -> (Scenario, Output). Raises RunError, RecordError."""
    script = Path(argv[0]).stem
    given = parser(script).parse_args(_joined(argv[1:]))
    return _run(given, script, house, earthquake, SNOW_DEPTH if snow else 0.0, "take a script of a run that has one", argv[1:])


def read_house(argv):
    """Command line (as sys.argv) of scripts/house.py -> (Scenario, Output). Raises RunError, RecordError, HouseError."""
    given = house_parser().parse_args(_joined(argv[1:]))
    depth = load_house(given.file).data["snow"]["depth"] if given.snow is None else given.snow
    return _run(given, Path(given.file).stem, given.file, given.quake or given.record is not None or given.seed is not None, depth, "add --quake or --record FILE", argv[1:])


def _run(given, name, house, earthquake, depth, remedy, words):
    """(Scenario, Output) of a run called `name`. remedy: what to do when there is no earthquake to scale; words: of the command line."""
    _check_numbers(given)
    request = motion_request(given)
    motion = _motion(request, earthquake, given.dt, remedy)
    duration = given.duration if given.duration is not None else motion.duration if motion else QUIET_DURATION
    scale = 1.0 if request.scale is None else request.scale
    scenario = Scenario(name, house, motion, depth, scale=scale, dt=given.dt, duration=duration, options={"skip_rest": 0} if given.every_step else {})
    folder = Path(given.out) if given.out else Path("results") / name
    export = Path(given.export) if given.export else None
    return scenario, Output(
        folder, given.resume, given.or_anew, not (given.no_views or given.no_frames), not given.no_frames, export, given.quiet, given.checkpoint, decisive(words)
    )


def _joined(words):
    """Words of a command line with numbers joined to their options by '=': argparse takes -1e-4 for an option."""
    joined = []
    for word in words:
        if _is_number(word) and joined and joined[-1].startswith("--") and "=" not in joined[-1]:
            joined[-1] += f"={word}"
        else:
            joined.append(word)
    return joined


def _is_number(word):
    try:
        float(word)
    except ValueError:
        return False
    return True


def _check_numbers(given):
    """Ranges of all numbers; NaN is in none of them."""
    if not MIN_DT <= given.dt <= MAX_DT:
        raise RunError(f"--dt {given.dt:g}: the time step must be between {MIN_DT:g} s and {MAX_DT:g} s, beyond which joints of floors and roofs are unstable")
    for option, value, noun in (("--duration", given.duration, "simulated time [s]"), ("--checkpoint", given.checkpoint, "simulated time between checkpoints [s]")):
        if value is not None and not 0 <= value < math.inf:
            raise RunError(f"{option} {value:g}: the {noun} must be finite and >= 0")


def _motion(request, earthquake, dt, remedy):
    """GroundMotion or None. What a reader has to warn of becomes a line on standard error."""
    if not earthquake:
        for option in request.given():
            raise RunError(f"--{option}: this run has no earthquake; {remedy}")
        return None
    with warnings.catch_warnings(record=True) as notes:
        warnings.simplefilter("always")
        motion = request.motion(dt)
    for note in notes:
        print(f"note: {note.message}", file=sys.stderr)
    return motion


def prepare_folder(folder):
    """Make the folder and see that files can be written in it. Raises RunError."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as problem:
        raise RunError(f"{folder}: cannot write results there: {problem.strerror}; choose another folder with --out") from None

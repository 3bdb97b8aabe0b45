# SPDX-License-Identifier: GPL-2.0-or-later
"""Command line of the run scripts -> (Scenario, Output). YADE's own options (-n, -x, -j2) stand before the script's name."""
import argparse
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

from ..base.errors import RunError, one_line
from ..base.notes import noted
from ..base.time_step import DEFAULT_DT, MAX_DT, MAX_DURATION, MIN_DT
from ..house import LEVELS, Town, load_house, load_town, shipped_houses
from ..house.disturbance import LARGEST
from ..motion import GroundMotion, add_motion_options, motion_request, with_then
from ..scene.scenario import Scenario
from .identity import of_arrays

SNOW_DEPTH = 1.0
"""Snow on the roof of the snow runs. [m] (paper, section 3.4)"""
QUIET_DURATION = 30.0
"""Simulated time of runs without an earthquake. [s] (paper, section 4.2)"""
CHECKPOINT_INTERVAL = 2.0
"""Simulated time between checkpoints. [s]"""
MOST_RUNS = 999
"""Largest number of runs of an ensemble."""
MOST_SEED = 2**32 - 1
"""Largest seed of a disturbance."""


@dataclass
class Output:
    """Folder and kinds of the results of a run."""

    folder: Path
    resume: bool = False
    or_anew: bool = False  # with resume: start anew when the checkpoint cannot be used
    views: bool = True  # pictures and player, made from the frames
    report: bool = False
    frames: bool = True
    export: Path = None
    quiet: bool = False
    checkpoint_interval: float = CHECKPOINT_INTERVAL  # simulated time [s]; 0: no checkpoints
    other_walls: dict = None  # verdict with the walls of the other level: `other` of `walls` in summary.json
    options: tuple = ()  # arguments of the command line that decide the results
    ensemble: int = None  # number of runs of an ensemble, None: a run of its own
    jobs: int = None  # runs of an ensemble at a time, None: one per core


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise RunError(f"{message} (options: {self.prog} -h; YADE's own options stand before the script)")


def parser(script):
    """ArgumentParser of the run script of that name."""
    about = "Results go to results/<script name>/, or to the folder of --out."
    made = _Parser(prog=f"yade [-n] [-x] {script}.py", allow_abbrev=False, description=about)
    made.add_argument("--duration", type=float, metavar="S",
                      help=f"simulated time [s] (default: duration of the motion; without an earthquake {QUIET_DURATION:g})")
    made.add_argument("--until-collapse", action="store_true", help="end the run when the house has collapsed (default: at the end of its duration)")
    made.add_argument("--dt", type=float, default=DEFAULT_DT, metavar="S", help=f"time step [s], {MIN_DT:g} to {MAX_DT:g} (default {DEFAULT_DT:g})")
    made.add_argument("--out", metavar="DIR", help="folder of the results")
    made.add_argument("--resume", action="store_true",
                      help="continue from the last checkpoint in the folder of the results, if there is one")
    made.add_argument("--or-anew", action="store_true",
                      help="with --resume: start anew when the checkpoint is damaged or of another run, instead of ending with an error")
    made.add_argument("--checkpoint", type=float, default=CHECKPOINT_INTERVAL, metavar="S",
                      help="simulated time between checkpoints [s], 0: none (default %(default)g)")
    made.add_argument("--no-views", action="store_true", help="make no pictures (scripts/show/show_run.py makes them later from the recorded frames)")
    made.add_argument("--report", action="store_true", help="write a report of one page, too: report.html, and report.pdf where Chromium is installed")
    made.add_argument("--no-frames", action="store_true", help="record no frames and make no pictures")
    made.add_argument("--export", metavar="FILE",
                      help="write the scene at the start of the run as JSON for other solvers (with --duration 0: nothing else)")
    made.add_argument("--every-step", action="store_true", help="compute every step (default: steps are skipped while house and ground are at rest)")
    made.add_argument("--joint-damping", type=float, metavar="RATIO",
                      help="damping ratio of all joints, 0 to 1 (default: the house's own); makes wrecks come to rest")
    made.add_argument("--disturb", type=_whole(1, MOST_SEED), metavar="SEED",
                      help=f"move each vertex of free members by a random vector of at most {LARGEST:g} m")
    made.add_argument("--ensemble", type=_whole(2, MOST_RUNS), metavar="N",
                      help="run it N times, the second to the last run disturbed by --disturb 2 ... N, and report medians, ranges and shares of outcomes")
    made.add_argument("--jobs", type=_whole(1, MOST_RUNS), metavar="N", help="with --ensemble: runs at a time (default: one per core)")
    made.add_argument("--quiet", action="store_true", help="print errors only")
    add_motion_options(made)
    return made


def _whole(low, high):
    """Type of an option: a whole number from low to high."""

    def read(text):
        if not (text.isdecimal() and len(text) <= 20 and low <= int(text) <= high):
            raise argparse.ArgumentTypeError(f"'{text[:40]}': must be a whole number from {low} to {high}")
        return int(text)

    return read


def house_parser():
    """ArgumentParser of scripts/house.py, which runs any house."""
    made = parser("house")
    made.description = "Results go to results/<name of the house file>/, or to the folder of --out."
    made.add_argument("file", metavar="HOUSE", help=f"house file, or a shipped house: {', '.join(shipped_houses())}")
    made.add_argument("--quake", action="store_true", help="with the default earthquake; --record gives a recorded one")
    made.add_argument("--snow", type=float, metavar="METRES", help="depth of snow on the roofs [m] (default: the house file's)")
    _add_walls(made)
    return made


def town_parser():
    """ArgumentParser of scripts/town.py, which runs a town."""
    made = parser("town")
    made.description = "Results go to results/<name of the town file>/, or to the folder of --out; those of a lot to its folder lots/<lot>/."
    made.add_argument("file", metavar="TOWN", help="town file")
    made.add_argument("--quake", action="store_true", help="with the default earthquake; --record gives a recorded one")
    made.add_argument("--snow", type=float, metavar="METRES", help="depth of snow on the roofs of lots without `snow` [m] (default: the house files')")
    _add_walls(made)
    return made


def _add_walls(made):
    made.add_argument("--walls", choices=tuple(LEVELS), help="walls of a rated multiplier: mean of tested ones, or design, which just pass their test "
                      "(default: the house file's); with --report both are run, and the report has both verdicts where they differ")


OUTPUT_OPTIONS = {
    **dict.fromkeys(("--out", "--checkpoint", "--export", "--ensemble", "--jobs"), 1),
    **dict.fromkeys(("--resume", "--or-anew", "--no-views", "--no-frames", "--report", "--quiet"), 0),
}
"""Options that do not decide the results, with the number of their values."""


def decisive(arguments):
    """Arguments of a command line that decide the results: all but OUTPUT_OPTIONS and their values."""
    found, skip = [], 0
    for argument in arguments:
        option, given, _ = argument.partition("=")
        if skip:
            skip -= 1
        elif option in OUTPUT_OPTIONS:
            skip = 0 if given else OUTPUT_OPTIONS[option]
        else:
            found.append(argument)
    return tuple(found)


def read(house, earthquake, snow, argv):
    """Command line (as sys.argv) of a run script -> (Scenario, Output). Raises RunError, RecordError."""
    script = Path(argv[0]).stem
    given, arguments = _parsed(parser(script), argv)
    return _run(given, arguments, Request(script, house, earthquake, SNOW_DEPTH if snow else 0.0, "use a script of a run with an earthquake"))


def read_house(argv, motion=None):
    """Command line (as sys.argv) of scripts/house.py -> (Scenario, Output). Raises RunError, RecordError, HouseError.

    motion: GroundMotion that takes the place of a record
    """
    given, arguments = _parsed(house_parser(), argv)
    depth = load_house(given.file).data["snow"]["depth"] if given.snow is None else given.snow
    shaken = motion is not None or given.quake or given.record is not None or given.seed is not None
    return _run(given, arguments, Request(_name_of(given.file), given.file, shaken, depth, "add --quake or --record FILE", motion))


def _name_of(path):
    """Name of a house or town file, printable whatever the file's name."""
    return one_line(Path(path).stem)


@dataclass(frozen=True)
class TownPlan:
    """A Town, and (Scenario, Output) of each lot."""

    town: Town
    lots: list


def read_town(argv):
    """Command line (as sys.argv) of scripts/town.py -> (TownPlan, Output). Raises RunError, RecordError, HouseError."""
    given, arguments = _parsed(town_parser(), argv)
    for option in ("export", "ensemble", "disturb", "report"):
        if getattr(given, option):
            raise RunError(f"--{option}: not for towns; run a house with scripts/house.py")
    town = load_town(given.file)
    shaken = given.quake or given.record is not None or given.seed is not None
    scenario, output = _run(given, arguments, Request(_name_of(given.file), given.file, shaken, 0.0, "add --quake or --record FILE"))
    delays = town.delays()
    if given.duration is None and scenario.motion:
        scenario.duration += max(delays)
    plans = [_lot(scenario, output, lot, delay, given.snow) for lot, delay in zip(town.lots, delays)]
    return TownPlan(town, plans), output


def _lot(scenario, output, lot, delay, snow):
    """(Scenario, Output) of a lot. scenario, output: of the town; delay [s]; snow: depth where neither lot nor house file gives one [m]"""
    depth = lot.snow if lot.snow is not None else snow if snow is not None else load_house(lot.house).data["snow"]["depth"]
    motion = scenario.motion and lot.motion(scenario.motion)
    own = replace(scenario, name=f"{scenario.name}.{lot.name}", house=lot.house, motion=motion, snow_depth=depth, delay=delay if motion else 0.0)
    return own, replace(output, folder=output.folder / "lots" / lot.name, views=False, quiet=True, options=(*output.options, f"lot {lot.name}"))


@dataclass(frozen=True)
class Request:
    """Parts of a run that the script decides, or the arguments of scripts/house.py. remedy: for options of an earthquake in a run without one."""

    name: str
    house: str
    earthquake: bool
    snow_depth: float  # [m]
    remedy: str
    motion: GroundMotion = None  # in place of a record


def _run(given, arguments, request):
    """(Scenario, Output). given: parsed options; arguments: of the command line; request: Request."""
    _check_numbers(given)
    _check_ensemble(given)
    if given.report and given.no_frames:
        raise RunError("--report and --no-frames exclude each other: a report shows recorded frames")
    shaking = motion_request(given)
    motion = _motion(shaking, request, given.dt)
    duration = given.duration if given.duration is not None else motion.duration if motion else QUIET_DURATION
    scale = 1.0 if shaking.scale is None else shaking.scale
    options = {"skip_rest": 0} if given.every_step else {}
    times = {"dt": given.dt, "duration": duration, "until_collapse": given.until_collapse, "joint_damping": given.joint_damping,
             "disturb": given.disturb, "wall_level": getattr(given, "walls", None)}
    scenario = Scenario(request.name, request.house, motion, request.snow_depth, scale=scale, **times, options=options)
    return scenario, Output(
        folder=_path("--out", given.out) or Path("results") / request.name,
        resume=given.resume,
        or_anew=given.or_anew,
        views=not (given.no_views or given.no_frames),
        report=given.report,
        frames=not given.no_frames,
        export=_path("--export", given.export),
        quiet=given.quiet,
        checkpoint_interval=given.checkpoint,
        ensemble=given.ensemble,
        jobs=given.jobs,
        options=decisive(arguments) + (() if request.motion is None else (f"motion {of_arrays([request.motion.acceleration])}",)),
    )


def _path(option, value):
    """Path of an option, None without a value. Raises RunError for an empty one."""
    if value is not None and not value.strip():
        raise RunError(f"{option} '': a path must not be empty")
    return None if value is None else Path(value)


def _parsed(made, argv):
    """(parsed options, arguments of the command line) of sys.argv."""
    arguments = with_then(argv[1:])
    return made.parse_args(_joined(arguments)), arguments


def _joined(arguments):
    """Arguments of a command line with numbers joined to their options by '=', since argparse reads -1e-4 as an option."""
    joined = []
    for argument in arguments:
        if _is_number(argument) and joined and joined[-1].startswith("--") and "=" not in joined[-1]:
            joined[-1] += f"={argument}"
        else:
            joined.append(argument)
    return joined


def _is_number(argument):
    try:
        float(argument)
    except ValueError:
        return False
    return True


def _check_numbers(given):
    """Ranges of all numbers; NaN is in none of them."""
    if not MIN_DT <= given.dt <= MAX_DT:
        limits = f"between {MIN_DT:g} s and {MAX_DT:g} s"
        raise RunError(f"--dt {given.dt:g}: the time step must be {limits}; joints of floors and roofs are unstable beyond")
    if given.joint_damping is not None and not 0 <= given.joint_damping <= 1:
        raise RunError(f"--joint-damping {given.joint_damping:g}: the damping ratio of the joints must be between 0 and 1")
    times = (("--duration", given.duration, "simulated time"), ("--checkpoint", given.checkpoint, "simulated time between checkpoints"))
    for option, value, noun in times:
        if value is not None and not 0 <= value <= MAX_DURATION:
            raise RunError(f"{option} {value:g}: the {noun} must be >= 0 and at most {MAX_DURATION:g} s")


ALONE = {
    "resume": "an ensemble always continues",
    "or_anew": "an ensemble repeats runs that cannot be continued",
    "export": "it writes the scene of one run",
    "disturb": "the runs of an ensemble have the seeds 2 to N",
}
"""Options of a run of its own, and why an ensemble excludes them."""


def _check_ensemble(given):
    """Raise RunError for options that do not combine."""
    if given.ensemble is None:
        if given.jobs is not None:
            raise RunError(f"--jobs {given.jobs}: belongs to an ensemble; give --ensemble N")
        return
    for name, reason in ALONE.items():
        if getattr(given, name):
            raise RunError(f"--ensemble and --{name.replace('_', '-')} exclude each other: {reason}")
    if given.checkpoint != CHECKPOINT_INTERVAL:
        raise RunError(f"--ensemble and --checkpoint exclude each other: its runs save checkpoints every {CHECKPOINT_INTERVAL:g} s")


def _motion(shaking, request, dt):
    """GroundMotion or None. shaking: MotionRequest. Warnings of a reader become lines on standard error."""
    if not request.earthquake:
        for option in shaking.given():
            raise RunError(f"--{option}: this run has no earthquake; {request.remedy}")
        return None
    with noted():
        return shaking.motion(dt, request.motion)


def prepare_folder(folder):
    """Create the folder and check that files can be written in it. Raises RunError."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as problem:
        raise RunError(f"--out {folder}: results cannot be written there: {problem.strerror}; choose another folder") from None

# SPDX-License-Identifier: GPL-2.0-or-later
"""All options of a run: command line, `th.run`, batches, towns and the identity of a run follow from them. A process of
a study takes those of its run from request.json in the folder."""
import json
from dataclasses import dataclass, field
from pathlib import Path
from shlex import quote
from typing import Callable

from ..base.atomic_write import write_text
from ..base.errors import RunError, one_line
from ..base.options import command_option, is_given, option, options, read_keywords
from ..base.record_file import read_record
from ..base.time_step import DEFAULT_DT, MAX_DT, MAX_DURATION, MIN_DT
from ..house import LEVELS, shipped_houses
from ..house.disturbance import LARGEST
from ..house.layout import MAX_SNOW
from ..motion import GroundMotion, MotionRequest
from .identity import of_arrays, of_values

REQUEST = "request.json"
SNOW_DEPTH = 1.0  # snow on the roof of the snow runs. [m] (paper, section 3.4)
QUIET_DURATION = 30.0  # simulated time of runs without an earthquake. [s] (paper, section 4.2)
MOST_RUNS = 999  # largest number of runs of an ensemble
MOST_SEED = 2**32 - 1  # largest seed of a disturbance
EXCLUDED_BY_ENSEMBLE = {
    "resume": "an ensemble always continues", "or_anew": "an ensemble repeats runs that cannot be continued",
    "export": "it writes the scene of one run", "disturb": "the runs of an ensemble have the seeds 2 to N",
    "checkpoint": "its runs save checkpoints at the default interval"}
"""Options that an ensemble excludes, and why."""


@dataclass(frozen=True)
class OptionSource:
    """Where options come from. name: function that names an option; earthquake: remedy without an earthquake; pictures:
    function that gives the command for the pictures of a folder"""

    name: Callable = command_option
    earthquake: str = "add --quake or --record FILE"
    pictures: Callable = lambda folder: f"scripts/show/show_run.py {quote(str(folder))}"


SCRIPT = OptionSource(earthquake="use a script of a run with an earthquake")


@dataclass(frozen=True)
class RunOptions(MotionRequest):
    """Options of a run, those of its ground motion included. name: of a run whose script gives BY_SCRIPT, or of a lot;
    town: its file; ground_motion: in place of a record."""

    house: str = option(str, f"house or BTLx file, or a shipped house: {', '.join(shipped_houses())}", "HOUSE",
                        group="main")
    quake: bool = option(bool, "with the default earthquake", group="main")
    snow: float = option(float, "snow on the roofs [m] (default: the house file's)", "DEPTH", 0, MAX_SNOW, group="main")
    walls: str = option(str, f"strength of walls given by a multiplier: {' or '.join(LEVELS)}", "LEVEL",
                        choices=tuple(LEVELS), group="main")
    duration: float = option(
        float, f"simulated time [s] (default: the motion's, or {QUIET_DURATION:g})", "S", 0, MAX_DURATION, group="main")
    until_collapse: bool = option(bool, "end the run when the house has collapsed", group="main")
    out: Path = option(Path, "folder of the results (default: results/NAME)", "DIR", group="main", decides=False)
    resume: bool = option(bool, "continue from the checkpoint there", group="main", decides=False)
    report: bool = option(bool, "write a report of one page, too", group="main", decides=False)
    ensemble: int = option(int, "run it N times, disturbed, and report ranges", "N", 2, MOST_RUNS, group="main",
                           decides=False)
    jobs: int = option(int, "with --ensemble: runs at a time (default: one per core)", "N", 1, MOST_RUNS, group="run",
                       decides=False)
    dt: float = option(
        float, f"time step [s] (default {DEFAULT_DT:g}, which is also the largest admissible)", "S",
        MIN_DT, MAX_DT, DEFAULT_DT, group="run",
    )
    joint_damping: float = option(float,
                                  "damping ratio of the sway at small drift and of all joints (default: the house's"
                                  " own); makes wrecks come to rest", "RATIO", 0, 1, group="run")
    checkpoint: float = option(float, "simulated time between checkpoints [s] (default 5), 0: none", "S", 0,
                               MAX_DURATION, 5.0, group="run", decides=False)
    no_views: bool = option(bool, "make no pictures (scripts/show/show_run.py makes them later)", group="run",
                            decides=False)
    no_frames: bool = option(bool, "record no frames and make no pictures", group="run", decides=False)
    quiet: bool = option(bool, "print errors only", group="run", decides=False)
    every_step: bool = option(
        bool, "compute every step (default: steps are skipped while house and ground are at rest)", group="hidden"
    )
    disturb: int = option(int, f"seed: move each vertex of free members by a random vector of at most {LARGEST:g} m",
                          "SEED", 1, MOST_SEED, group="hidden")
    export: Path = option(Path,
                          "write the scene at the start as JSON for other solvers (with --duration 0: nothing else)",
                          "FILE", group="hidden", decides=False)
    or_anew: bool = option(bool, "with --resume: start anew when the checkpoint cannot be used, instead of an error",
                           group="hidden", decides=False)

    name: str | None = None
    town: str | None = None
    ground_motion: GroundMotion | None = None
    source: OptionSource = field(default=OptionSource(), compare=False, repr=False)

    error = RunError

    @property
    def title(self):
        """Name of the run: of its script, or of the file of its house or town, printable whatever the file's name."""
        return self.name or one_line(Path(self.house or self.town).stem)

    @property
    def folder(self):
        return self.out or Path("results") / self.title

    @property
    def views(self):
        """Whether pictures and player are made."""
        return not (self.no_views or self.no_frames)

    @property
    def shaken(self):
        """Whether the run has an earthquake. A script that gives its loads decides it alone."""
        record = self.record is not None or self.seed is not None or self.ground_motion is not None
        return self.quake or record and self.source != SCRIPT

    def requested_motion(self):
        """GroundMotion before its factor, None without an earthquake. Raises RecordError."""
        return self.motion(self.dt, self.ground_motion) if self.shaken else None

    def simulated(self, motion):
        """Simulated time under a GroundMotion or None. [s]"""
        return self.duration if self.duration is not None else motion.duration if motion else QUIET_DURATION

    def named(self, name):
        """An option as the user knows it: --joint-damping, run: joint_damping, table.txt:3, column joint_damping."""
        return self.source.name(name)

    def say(self, text):
        """Print a line, unless the run is quiet."""
        if not self.quiet:
            print(text, flush=True)

    def check(self):
        """Return these options. Raises RunError for values out of range and contradictions."""
        super().check(self.named)
        if not self.shaken:
            for name in self.given():
                raise RunError(f"{self.named(name)}: this run has no earthquake; {self.source.earthquake}")
        if self.report and self.no_frames:
            raise RunError(f"{self.named('report')} and {self.named('no_frames')} exclude each other: a report shows"
                           " recorded frames")
        if self.jobs is not None and self.ensemble is None:
            raise RunError(f"{self.named('jobs')} {self.jobs}: belongs to an ensemble; give {self.named('ensemble')} N")
        for name, reason in EXCLUDED_BY_ENSEMBLE.items():
            if self.ensemble is not None and is_given(self, name):
                raise RunError(f"{self.named('ensemble')} and {self.named(name)} exclude each other: {reason}")
        return self

    def decisive(self):
        """{option: value} of those that decide the results and differ from their defaults, as JSON returns them."""
        values = {name: getattr(self, name) for name, each in options(RunOptions).items()
                  if each.metadata["decides"] and is_given(self, name)}
        values |= {"quake": True} if self.shaken else {}
        values |= {name: getattr(self, name) for name in ("name", "town") if getattr(self, name)}
        motion = self.ground_motion
        return (values if motion is None
                else {**values, "ground_motion": of_values([motion.name, motion.dt, of_arrays([motion.acceleration])])})


def scripted(name, house, earthquake=False, snow=False, **more):
    """Options of a run script. name: of the script; earthquake, snow: whether there are; more: further options"""
    return RunOptions(name=name, house=str(house), quake=earthquake, snow=SNOW_DEPTH if snow else 0.0, source=SCRIPT,
                      **more)


def write_request(request):
    """Write the options of a run, a RunOptions without a ground motion from Python, into its folder. Raises OSError."""
    given = {name: getattr(request, name) for name in options(RunOptions) if is_given(request, name)}
    write_text(request.folder / REQUEST, json.dumps({"name": request.name, **given}, default=str, indent=1) + "\n")


def read_request(folder):
    """RunOptions of the request in a folder. Raises RunError."""
    given = json.loads(read_record(folder / REQUEST))
    name = given.pop("name")
    return RunOptions(name=name, source=SCRIPT if name else OptionSource(), **read_keywords(RunOptions, REQUEST, given))

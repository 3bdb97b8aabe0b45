# SPDX-License-Identifier: GPL-2.0-or-later
"""A run: scene -> steps -> results. Command line: cli.py; run in a live session: live.py."""
import signal
import time
from contextlib import contextmanager
from shlex import quote

import yade.wrapper as yw
from yade_timber.scene.engines import find_engine
from yade_timber.scene.export import export_scene

from ..base.atomic_write import remove, written_whole
from ..base.errors import RunError, os_errors
from ..pictures import OWNER, REPORT, TOWN, all_pictures
from ..recording import append_log, ensemble, frames
from ..scene.scenario import build
from ..text.english import house_name, loads, sentence
from . import checkpoint, quantities, summary
from .identity import identity, made_from, of_values
from .observer import Observer
from .progress import Bar, Status
from .recorder import Recorder

STOP_SIGNALS = (signal.SIGINT, signal.SIGTERM)
HOUSES = "houses.csv"  # table of a town's houses
RECORDED, STATE = (frames.NAME, append_log.FRAMES_LOG), (checkpoint.NAME, checkpoint.SAMPLES)
"""Files of the frames, and of what a resumed run continues from."""
O = yw.Omega()


class Interrupted(Exception):
    """The user has stopped the run. number: of the signal; time: simulated [s]."""

    def __init__(self, number, time):
        super().__init__(number, time)
        self.number, self.time = number, time


class PhysicsError(RunError):
    """The numbers of the scene are not those of a physical motion any more."""


@contextmanager
def physics_errors():
    """Context in which an error of YADE's engines becomes a PhysicsError."""
    try:
        yield
    except RuntimeError as problem:
        raise PhysicsError(f"{problem}; the run stops at {O.time:.4f} s") from None


class Stoppable:
    """Base of runs that a signal ends after the present chunk."""

    signal = None  # number of the signal that arrived

    @contextmanager
    def _stop_signals(self):
        """Stop signals end the run after the present chunk; further ones have no effect."""
        def note(number, _frame):
            self.signal = number

        before = {number: signal.signal(number, note) for number in STOP_SIGNALS}
        try:
            yield
        finally:
            if not self.signal:
                for number, handler in before.items():
                    signal.signal(number, handler)


class Run(Stoppable):
    """A scenario in YADE with its RunOptions: duration / dt steps, fewer after a collapse."""

    def __init__(self, scenario, options):
        self.scenario, self.options = scenario, options
        self.origin = made_from(options)
        self.steps = round(scenario.duration / scenario.dt)
        self.chunk = frames.steps_between(scenario.dt)  # steps between frames; then signals and numbers are checked
        self.wall_s = 0.0  # [s] of all steps, those before a resume included
        self.last_saved = 0  # step of the last checkpoint
        self.fault = None  # in a town: error of the physics that has ended this run
        self.summary = self.frames = None  # once the results are written
        self.only_export = options.export is not None and self.steps == 0  # results in the folder remain
        self.checkpoint_path, self.frames_path = options.folder / checkpoint.NAME, options.folder / frames.NAME
        if not (options.resume and self.checkpoint_path.exists() and self._resume()):
            self._start()
        skipper = find_engine(yw.RestSkipper)
        if skipper:
            skipper.last = self.steps

    # --- start --------------------------------------------------------------------------------------------------------

    def _start(self):
        self._build()
        if self.only_export:
            return
        clear(self.options, *RECORDED, *STATE)
        self._observe()
        self.take(O.time)
        if self.options.resume:
            self.options.say(f"no checkpoint of this run in {self.options.folder}: starting from the beginning")

    def _build(self):
        """Build the scene; export it where that is asked for. Raises RunError."""
        self.model = build(self.scenario)
        if self.options.export:
            target = f"{self.options.named('export')} {self.options.export}"
            with (os_errors(lambda fault: f"{target}: cannot be written: {fault}"),
                  written_whole(self.options.export) as part):
                export_scene(part)

    def _resume(self):
        """Load checkpoint and frames; returns False when the run may start anew instead. Raises RunError."""
        try:
            self._load()
        except RunError:
            if not self.options.or_anew:
                raise
            self.wall_s, self.last_saved = 0.0, 0
            return False
        clear(self.options, *([] if self.recorder else RECORDED))
        self.options.say(f"resuming from {O.time:.2f} s")
        return True

    def _load(self):
        if self.options.export:
            self._build()
        else:
            self.model = self.scenario.build_model()
        saved, rows = checkpoint.load(self.checkpoint_path, identity(self.origin), checkpoint.Progress)
        if O.iter >= self.steps:
            duration = f"{self.options.named('duration')} {self.scenario.duration:g}"
            raise RunError(f"{duration}: {self.checkpoint_path} is already at {O.time:g} s; give a longer duration")
        self.wall_s, self.last_saved = saved.wall_s, O.iter
        self._observe(saved)
        with os_errors(lambda fault: f"{self.options.folder}: the run cannot be continued ({fault})"):
            self.samples.resume(saved.samples, rows, checkpoint.REMEDY)
            if self.recorder:
                self.recorder.resume()

    def _observe(self, progress=None):
        """Attach observer and recorder to the scene. progress: of a checkpoint."""
        self.identity = identity(self.origin)
        self.observer = Observer(self.model, progress)
        run, folder = of_values(self.identity), self.options.folder
        self.samples = checkpoint.SampleFile(folder / checkpoint.SAMPLES, run)
        titled = title(self.scenario, self.model)
        self.options.say(titled)
        self.recorder = (None if self.options.no_frames
                         else Recorder(self.frames_path, self.scenario, self.model, titled, run))

    # --- steps --------------------------------------------------------------------------------------------------------

    def complete(self):
        """All steps, then the results, also of a run that is cut off. Raises RunError, Interrupted after a signal."""
        try:
            if not self.only_export:
                status = Status(self.observer)
                with (self._stop_signals(),  # first: tqdm cannot be interrupted while it is made
                      Bar(self.scenario.name, self.scenario.duration, O.time, self.options.quiet, status) as bar):
                    while O.iter < self.steps:
                        self.advance(self.next_stop())
                        self.after_chunk()
                        bar.advance(O.time)
        except PhysicsError as problem:
            self.write(cut_off=str(problem))
            raise
        self.write()

    def next_stop(self):
        """Step of the next frame. The last checkpoint is one step before the end: energies and contact points are known
        only after a step, so a resumed run has one to make."""
        left = self.steps - O.iter
        return O.iter + min(max(1, left - 1), self.chunk - O.iter % self.chunk)

    def after_chunk(self):
        """Check the numbers, end a run that is over, record a frame, save a checkpoint when it is due. Raises
        PhysicsError, and Interrupted after a signal."""
        with physics_errors():
            find_engine(yw.HealthCheck).check()
        self.observer.judge_until(O.time)
        if self.is_over():
            self.steps = O.iter
        if O.iter == self.steps:
            return
        if O.iter % self.chunk == 0:
            self.take(O.time)
        every = max(1, round(self.options.checkpoint / self.scenario.dt))
        is_due = self.options.checkpoint > 0 and O.iter // every > self.last_saved // every
        if self.signal or O.iter == self.steps - 1 or is_due:
            self.save()
        if self.signal:
            raise Interrupted(self.signal, O.time)

    def is_over(self):
        """Whether the run ends now because its house has collapsed, or its wreck has come to rest."""
        collapsed = self.scenario.until_collapse and self.observer.judge.main.fall_s is not None
        return collapsed or self.scenario.until_rest and self.observer.is_over

    def take(self, time, last=False):
        """Note events and record a frame of the scene as it is now. time [s]; last: whether it is the final state."""
        with physics_errors():
            state = self.observer.observe(time, last)
        if self.recorder:
            self.recorder.take(time, state, last)

    def advance(self, step):
        """Advance to that step by `O.step`: unlike `O.run` it raises errors here and does not wait in slices."""
        since = time.perf_counter()
        with physics_errors():
            while O.iter < step:
                O.step()
        self.wall_s += time.perf_counter() - since

    def save(self):
        """Save a checkpoint, unless switched off. Frames are saved first: those after a checkpoint can be dropped."""
        if self.options.checkpoint == 0:
            return
        remedy = ("the previous checkpoint is intact, continue with --resume" if self.checkpoint_path.exists()
                  else "there is no earlier one")
        with os_errors(lambda fault: f"{self.options.folder}: the checkpoint cannot be written ({fault}); the run stops"
                                     f" at {O.time:.2f} s, {remedy}"):
            if self.recorder:
                self.recorder.save()
            self.observer.read_samples()
            progress = checkpoint.Progress(self.wall_s, self.samples.save(self.observer), **self.observer.progress())
            checkpoint.save(self.checkpoint_path, self.identity, progress)
        self.last_saved = O.iter

    # --- results ------------------------------------------------------------------------------------------------------

    def write(self, cut_off=None):
        """Write results and pictures; print their names. cut_off: reason for an early end. Raises PhysicsError."""
        if self.only_export:
            self.options.say(f"written: {self.options.export}")
            return
        if cut_off is None:
            self.take(O.time, last=True)
        self.observer.read_samples()
        sampled = self.samples.all(self.observer)
        histories, tables = self.observer.judge.histories(sampled), quantities.tables(self.observer, sampled)
        self.summary = summary.summary(self.scenario, self.observer, histories, tables, self.wall_s, self.origin,
                                       cut_off)
        written = self._results(next(iter(histories.values())), tables)
        if cut_off or O.iter >= self.steps:  # else a live run goes on
            with explain_writing(self.options):
                self.samples.enclose(self.checkpoint_path, self.observer)
        self.options.say(sentence(self.summary))
        with os_errors(lambda fault: f"{self.options.folder}: the results are written, the pictures are not ({fault});"
                                     " scripts/show/show_run.py makes them"):
            written += all_pictures.write(self.options.folder, views=self.options.views, page=self.options.report)
        written += [path for path in (self.options.export, self.checkpoint_path) if path and path.exists()]
        self.options.say("written: " + ", ".join(str(path) for path in written))
        if not self.options.no_frames:
            show = f"xdg-open {quote(str(self.options.folder / all_pictures.PLAYER))}"
            again = self.options.source.pictures(self.options.folder)
            self.options.say(f"next: {show if self.options.views else again}")
        if cut_off is None and self.summary.cut_off:
            raise PhysicsError(self.summary.cut_off)

    def _results(self, history, tables):
        written = []
        with explain_writing(self.options):
            if self.recorder:
                self.frames = self.recorder.finish(self.summary, history, tables)
                written.append(self.frames_path)
            return written + summary.write(self.options.folder, self.summary, history, tables, self.observer.model)


def explain_writing(options):
    folder, remedy = options.folder, "repeat the command with --resume"
    return os_errors(lambda fault: f"{folder}: the results cannot be written ({fault}); {remedy}")


def clear(options, *more):
    """Remove results of an earlier run or town and the files `more`, which are none of this run. Raises RunError."""
    with explain_removal(options):
        pictures = (*all_pictures.NAMES, *REPORT, *TOWN, *OWNER.values())
        for name in (*summary.NAMES, *pictures, *ensemble.NAMES, HOUSES, *more):
            remove(options.folder / name)


@contextmanager
def explain_removal(options):
    try:
        yield
    except OSError as problem:
        raise RunError(f"{problem.filename}: cannot be removed: {problem.strerror}; choose another folder with"
                       f" {options.named('out')}") from None


def title(scenario, model):
    """Title of the pictures: house and loads."""
    damped = "" if scenario.joint_damping is None else f", joint damping {scenario.joint_damping:g}"
    return f"{house_name(model.name, scenario.lot)}: {loads(scenario.motion is not None, model.snow_depth)}{damped}"

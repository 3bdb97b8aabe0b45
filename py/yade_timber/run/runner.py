# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of the scripts: command line -> scene -> steps -> results. `main` is what a script calls.

With YADE's `-x`, or when nobody sits at a terminal, the run goes to its end and writes its results. Otherwise it starts in the
background, the prompt is the user's, and the results are written when the last step is done.
"""
import signal
import sys
import threading
import time
import uuid
from contextlib import ExitStack
from dataclasses import replace

import yade.runtime
import yade.wrapper as yw

from . import checkpoint
from . import cli
from ..recording import frames
from ..pictures import all_pictures as pictures
from . import summary as results
from ..scene import engines as scene
from ..scene import viewer
from ..base.errors import RunError
from ..scene.export import export_scene
from ..house import HouseError, build_house, load_house
from ..base.lock import locked
from ..motion import RecordError
from .progress import Progress
from .identity import made_from
from .recorder import Recorder
from ..scene.scenario import build
from ..recording.sentences import sentence

TAG = "yade-timber run"
"""Of the scene: which run it belongs to."""
STOP_SIGNALS = (signal.SIGINT, signal.SIGTERM)

O = yw.Omega()
live = None
"""The Run of a live session that records frames."""


class Interrupted(Exception):
    """The user asked the run to stop; the argument is the signal's number."""


class Run:
    """A scenario in YADE and what is to become of it. The number of steps is fixed from the start: duration / dt."""

    def __init__(self, scenario, output):
        self.scenario, self.output = scenario, output
        self.steps = round(scenario.duration / scenario.dt)
        self.chunk = frames.steps_between(scenario.dt)  # also between two looks at signals, progress and the checkpoint's clock
        self.wall_s = 0.0  # [s] spent on steps, also by the runs before a resume
        self.last_saved = None  # step of the last checkpoint
        self.signal = None
        self.only_export = bool(output.export) and self.steps == 0  # what is in the folder is left alone
        self.tag = uuid.uuid4().hex
        self.checkpoint_path, self.frames_path = output.folder / checkpoint.NAME, output.folder / frames.NAME
        resumed = output.resume and self.checkpoint_path.exists() and self._load()
        if not resumed:
            self._start()
        skipper = scene.find_engine(yw.RestSkipper)
        if skipper:
            skipper.last = self.steps

    # --- start --------------------------------------------------------------------------------------------------------

    def _start(self):
        """Build the scene."""
        self.model = build(self.scenario)
        if self.output.export:
            self._export()
        if self.only_export:
            return
        O.tags[TAG] = self.tag
        self.identity = self._identity()
        self._clear(frames.NAME, checkpoint.NAME)
        self.recorder = self._recorder()
        if self.recorder:
            self.recorder.take(O.time)
        if self.output.resume:
            self.say(f"no checkpoint of this run in {self.output.folder}: starting from the beginning")

    def _load(self):
        """Go on from the checkpoint; returns whether it could be done. Raises RunError when it could not, unless the run may start anew."""
        self.model = build_house(load_house(self.scenario.house), snow_depth=self.scenario.snow_depth)
        self.identity = self._identity()
        try:
            self.wall_s = checkpoint.load(self.checkpoint_path, self.identity)
            if O.iter >= self.steps:
                raise RunError(f"--duration {self.scenario.duration:g}: {self.checkpoint_path} is already at {O.time:g} s; ask for more")
        except RunError:
            if not self.output.or_anew:
                raise
            self.wall_s = 0.0
            return False
        self.last_saved = O.iter
        self.tag = O.tags[TAG]
        if self.output.frames and not self.frames_path.exists():
            self.output = replace(self.output, frames=False, views=False)
            print(f"note: no frames of the first {O.time:.2f} s were recorded, and so none of the rest are", file=sys.stderr)
        self.recorder = self._recorder()
        if self.recorder:
            self.recorder.restore(self.frames_path)
            self.recorder.save(self.frames_path)  # an earlier end is none any more
        self._clear(*([] if self.recorder else [frames.NAME]))
        self.say(f"going on from {O.time:.2f} s")
        return True

    def _clear(self, *more):
        """Remove results of an earlier run and other files, so that nothing in the folder passes for this run's."""
        for name in (results.SUMMARY, results.HISTORY, results.BREAKS, *pictures.NAMES, *more):
            (self.output.folder / name).unlink(missing_ok=True)

    def _recorder(self):
        return Recorder(self.scenario, self.model, title(self.scenario, self.model)) if self.output.frames else None

    def _identity(self):
        return checkpoint.identity(self.scenario, self.model, results.versions()["package"])

    def _export(self):
        try:
            export_scene(self.output.export)
        except OSError as problem:
            raise RunError(f"--export {self.output.export}: cannot write it: {problem.strerror}") from None

    def say(self, text):
        if not self.output.quiet:
            print(text, flush=True)

    # --- steps --------------------------------------------------------------------------------------------------------

    def complete(self):
        """All steps that are left, then the results. Raises RunError when the physics fails, Interrupted after a signal."""
        before = {number: signal.signal(number, self._on_signal) for number in STOP_SIGNALS}
        try:
            with Progress(self.scenario, self.model, self.output.quiet) as progress:
                while O.iter < self.steps:
                    self._chunk()
                    progress.update()
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)
        self.write()

    def _on_signal(self, number, _frame):
        self.signal = number

    def _chunk(self):
        """The steps to the next frame, and a checkpoint when its time has come.

        The last checkpoint comes one step before the end, and the last step by itself: energies and contact points are at hand
        only after a step, so a resumed run always has one to make.
        """
        left = self.steps - O.iter
        self._advance(O.iter + min(max(1, left - 1), self.chunk - O.iter % self.chunk))
        if O.iter == self.steps:
            return
        if self.recorder and O.iter % self.chunk == 0:
            self.recorder.take(O.time)
        if self.signal or O.iter == self.steps - 1 or self._checkpoint_due():
            self.save()
        if self.signal:
            raise Interrupted(self.signal)

    def _advance(self, step):
        """Go to that step by `O.step` in a loop: unlike `O.run`, it throws errors here, keeps its threads, and does not wait in slices of 40 ms."""
        since = time.perf_counter()
        try:
            while O.iter < step:
                O.step()
        except RuntimeError as problem:
            raise RunError(f"{problem}; the run stops at {O.time:.4f} s without results") from None
        self.wall_s += time.perf_counter() - since

    def _checkpoint_due(self):
        if self.output.checkpoint_interval == 0:
            return False
        every = max(1, round(self.output.checkpoint_interval / self.scenario.dt))
        return O.iter // every > (self.last_saved or 0) // every

    def save(self):
        """Save a checkpoint now, unless checkpoints are switched off. The frames go first: those after a checkpoint can be dropped."""
        if self.output.checkpoint_interval > 0:
            try:
                if self.recorder:
                    self.recorder.save(self.frames_path)
                checkpoint.save(self.checkpoint_path, self.identity, self.wall_s)
            except (OSError, RuntimeError) as problem:  # of YADE's writer
                raise RunError(f"{self.checkpoint_path}: cannot be written ({problem}); the run stops at {O.time:.2f} s, the checkpoint before is whole") from None
            self.last_saved = O.iter

    # --- results ------------------------------------------------------------------------------------------------------

    def write(self):
        """Write results and pictures of the scene as it is now, and say so."""
        if self.only_export:
            self.say(f"written: {self.output.export}")
            return
        folder = self.output.folder
        found = {**results.summary(self.scenario, self.model, self.wall_s), "made_from": made_from(self.output.options)}
        written = []
        if self.recorder:
            self.recorder.take(O.time, last=True)
            self.recorder.finish(self.frames_path, found)
            written.append(self.frames_path)
        written += results.write(folder, found, self.model)
        if self.output.views:
            written += self._pictures()
        written += [path for path in (self.output.export, self.checkpoint_path) if path and path.exists()]
        self.say(sentence(found))
        self.say("written: " + ", ".join(str(path) for path in written))

    def _pictures(self):
        try:
            return pictures.write(self.output.folder)
        except OSError as problem:
            raise RunError(f"{self.output.folder}: the results are written, the pictures are not ({problem.strerror}); scripts/show/show_run.py makes them") from None

    # --- live ---------------------------------------------------------------------------------------------------------

    def start(self, hold):
        """Run in the background, in the viewer where there is a display; the results follow when the last step is done, however often the run is paused.

        hold: of the folder's lock (ExitStack), closed when the results are written.
        """
        self._hold = hold
        if O.iter >= self.steps:
            self._end()
            return
        viewer.show()
        self._since = time.perf_counter()
        if self.recorder:
            self._record_live()
        O.run(self.steps - O.iter)
        threading.Thread(target=self._watch, daemon=True).start()

    def _record_live(self):
        """An engine at the end of the chain that records each frame, in the step that leads to it: behind RestSkipper, whose step may."""
        global live
        live = self
        before = O.iter // self.chunk * self.chunk - 1  # the step that led to the last frame
        command = f"import {__name__}; {__name__}.record_frame()"
        O.engines = O.engines + [yw.PyRunner(command=command, iterPeriod=self.chunk, iterLast=before, nDone=1)]

    def _watch(self):
        while self.is_loaded() and O.iter < self.steps:
            time.sleep(0.5)
        O.wait()
        self.wall_s += time.perf_counter() - self._since
        self._end()

    def is_loaded(self):
        """Whether the scene in YADE is this run's, also after it was saved and loaded again."""
        return self.is_tagged() or time.sleep(1) or self.is_tagged()  # while YADE loads a scene, it has none for a moment

    def is_tagged(self):
        """The same, at once: what a step asks."""
        return TAG in O.tags.keys() and O.tags[TAG] == self.tag

    def _end(self):
        with self._hold:
            if self.only_export or self.is_loaded():
                self.write()
            else:
                print(f"{self.output.folder}: another scene was loaded before the run's end; it has no results", file=sys.stderr)

    def __repr__(self):
        state = "running" if O.running else "paused" if O.iter < self.steps else "finished"
        return f"<{self.scenario.name}: {O.time:.2f} of {self.scenario.duration:g} s, {state}>"


def record_frame():
    """Record the state that the present step of the live run, whose bodies have moved already, leads to."""
    if live and live.is_tagged() and O.iter + 1 < live.steps:
        live.recorder.take(O.time + O.dt)


def title(scenario, model):
    """What was done to which house, in words."""
    shaken = "earthquake" if scenario.motion is not None else ""
    snow = f"{scenario.snow_depth:g} m of snow" if scenario.snow_depth > 0 else ""
    return f"House {model.name}: {' and '.join(filter(None, (shaken, snow))) or 'own weight only'}"


def main(house, earthquake=False, snow=False, argv=None):
    """Run a house (name of a shipped one, or path of a YAML file) as the command line says; returns the Run.

    earthquake, snow: what the script's run is about. See `launch`.
    """
    return launch(lambda words: cli.read(house, earthquake, snow, words), argv)


def main_house(argv=None):
    """Run the house that the command line names; returns the Run. See `launch`."""
    return launch(cli.read_house, argv)


def launch(read, argv=None):
    """Run what `read` makes of the command line (default: sys.argv); returns the Run.

    Bad input, a failed run and a signal end the process with a line on standard error: status 1, 1 and 128 + the signal's number.
    """
    output = None
    try:
        scenario, output = read(sys.argv if argv is None else argv)
        stays = not yade.runtime.opts.exitAfter and sys.stdin.isatty()
        if stays and O.running:
            O.pause()  # a live run: the new one takes its place
            O.wait()
        cli.prepare_folder(output.folder)
        with ExitStack() as hold:
            if not hold.enter_context(locked(output.folder)):
                raise RunError(f"{output.folder}: another process is computing a run there; wait for it, or choose another folder with --out")
            run = Run(scenario, output)
            run.start(hold.pop_all()) if stays else run.complete()
    except (RunError, RecordError, HouseError) as problem:
        leave(f"error: {problem}", 1)
    except Interrupted as stop:
        number = stop.args[0]
        remedy = "go on with --resume" if output.checkpoint_interval > 0 else "nothing was saved (--checkpoint 0)"
        leave(f"stopped at {O.time:.2f} s by {signal.Signals(number).name}; {remedy}", 128 + number)
    except KeyboardInterrupt:  # before the first step, or while results and pictures are written
        leave(f"stopped by SIGINT; what is missing in {output.folder if output else 'the folder'} is made by the same command, pictures by scripts/show/show_run.py", 128 + signal.SIGINT)
    if stays:
        print(f"{run}: O.pause(), O.run(), yt.energy(), yt.contacts(id1, id2), run.write(); results follow in {run.output.folder}")
    return run


def leave(line, status):
    """End the process: one line on standard error and an exit status."""
    print(" ".join(line.split()), file=sys.stderr, flush=True)
    sys.exit(status)

# SPDX-License-Identifier: GPL-2.0-or-later
"""A town in this YADE process: a Run for each lot, in a scene and a folder of its own, on all threads.

The houses do not act on each other. Each scene is computed from frame to frame before the next one, so that its data
stay in the processor's cache: time and memory per element do not depend on the number of houses."""
from contextlib import contextmanager

import yade.runtime
import yade.wrapper as yw
from yade_timber.plugin import compiled

from ..base.atomic_write import write_text
from ..base.files import remove_parts
from ..base.lock import prepare_folder
from ..base.processors import processors
from ..base.table import csv_text
from ..house.town import check_places
from ..pictures import all_pictures
from ..recording import frames
from ..recording import town as recording
from ..recording.summary import LotResult
from ..text import japanese
from ..text.english import sentence
from .progress import Bar
from .runner import (HOUSES, RECORDED, STATE, Interrupted, PhysicsError, Run, Stoppable, clear, explain_removal,
                     explain_writing)

O = yw.Omega()


class TownRun(Stoppable):
    """Runs of a town's lots in step, frame by frame, on all processors or YADE's -j. plan: TownPlan; options: its"""

    def __init__(self, plan, options):
        if yade.runtime.opts.threads is None and yade.runtime.opts.cores is None:
            compiled.set_thread_count(processors())
        self.town, self.options = plan.town, options
        self.record = plan.record
        self.runs, self.scenes = [], []
        for lot, (scenario, lot_options) in zip(self.town.lots, plan.lots):
            prepare_folder(lot_options.folder, options.named("out"))
            with lot.located():
                self.runs.append(Run(scenario, lot_options))
            self.scenes.append(O._sceneObj)
        self.lots = list(zip(self.town.lots, self.runs))
        check_places([(lot, run.model) for lot, run in self.lots])
        O.reset()
        self.idle = O._sceneObj
        clear(options, *RECORDED, *STATE)
        with explain_removal(options):
            for run in self.runs:
                remove_parts(run.options.folder)

    @contextmanager
    def _of(self, number):
        """Context in which the scene of a lot is YADE's current one; gives its Run."""
        before = compiled.swap_scene(self.scenes[number])
        try:
            with self.town.lots[number].located():
                yield self.runs[number]
        finally:
            compiled.swap_scene(before)

    def complete(self):
        """All remaining steps, then the results. Lots whose physics fails end there; the others go on. Raises
        PhysicsError at the end, Interrupted after a signal."""
        mean_end = sum(run.steps * run.scenario.dt for run in self.runs) / len(self.runs)
        with self._stop_signals(), Bar(self.town.name, mean_end, 0, self.options.quiet) as progress:
            active = self._first_steps()
            while active:
                active = self._chunk(active)
                progress.advance(sum(scene.time for scene in self.scenes) / len(self.scenes))
        self.write()

    def _first_steps(self):
        """The first step of each lot, which checks the scene; returns the numbers of the lots that have more."""
        active = []
        for number in range(len(self.runs)):
            with self._of(number) as run, end_alone(run):
                if O.iter + 1 < run.next_stop():
                    run.advance(O.iter + 1)
                if O.iter < run.steps:
                    active.append(number)
        return active

    def _chunk(self, active):
        """The steps of some lots to their next frames; returns the numbers of those that have more."""
        stops = []
        for number in active:
            with self._of(number) as run:
                stops.append(run.next_stop())
        outcomes = compiled.advance_scenes([self.scenes[number] for number in active], stops, self.idle)
        left = []
        for number, (seconds, error) in zip(active, outcomes):
            with self._of(number) as run, end_alone(run):
                run.wall_s += seconds
                if error:
                    raise PhysicsError(f"{error}; the run stops at {O.time:.4f} s")
                run.after_chunk()
                if O.iter < run.steps:
                    left.append(number)
        if self.signal:
            for number in left:
                with self._of(number) as run:
                    run.save()
            raise Interrupted(self.signal, max(scene.time for scene in self.scenes))
        return left

    def write(self):
        """Write the results of all lots, the table of houses, and the pictures of the town. Raises PhysicsError of the
        first lot that was cut off."""
        for number in range(len(self.runs)):
            with self._of(number) as run, end_alone(run):
                run.write(cut_off=run.fault)
        for lot, run in self.lots:
            self.options.say(f"{lot.name}: {sentence(run.summary)}")
        written = self._results()
        self.options.say(sentence(self.summary))
        self.options.say("written: " + ", ".join(map(str, [*written, self.options.folder / "lots"])))
        faults = [f"lot {lot.name}: {run.fault}" for lot, run in self.lots if run.fault]
        if faults:
            raise PhysicsError(faults[0] + (f"; {len(faults) - 1} more lots are cut off" if faults[1:] else ""))

    def _results(self):
        folder = self.options.folder
        with explain_writing(self.options):
            written = [folder / HOUSES]
            write_text(written[0], self.table())
            if self.options.no_frames:
                return written
            recorded = [(lot.name, lot.axes, lot.origin(run.model), run.frames) for lot, run in self.lots]
            written.append(folder / frames.NAME)
            frames.save(written[-1], recording.town_frames(self.summary, recorded))
            if self.options.views:
                from ..pictures import owner  # loads matplotlib: half a second that other runs do without

                written += all_pictures.write(folder)
                for _, run in self.lots:
                    owner.write(run.options.folder, run.frames)
            return written

    @property
    def summary(self):
        """TownSummary."""
        results = {}
        for lot, run in self.lots:
            outlines = [part.round(3).tolist() for part in lot.outlines(run.model)]
            result = {"en": sentence(run.summary), "ja": japanese.result(run.summary)}
            one = LotResult(lot.name, run.summary.model, run.summary.verdict, outlines, result)
            results[lot.name] = run.summary, lot.axes, one
        return recording.summary(self.town.name, results, self.record)

    def table(self):
        rows = []
        for lot, run in self.lots:
            summary, scenario = run.summary, run.scenario
            drift, residual = summary.largest_drift()[0], summary.largest_drift("residual_drift")[0]
            place = lot.name, summary.model, lot.x, lot.y, lot.rotation, summary.snow_depth_m, round(scenario.delay, 6)
            times = ["" if time is None else time for time in (summary.tilt_time_s, summary.collapse_time_s)]
            joints, sheets = summary.joints_and_sheets
            rows.append((*place, summary.verdict, summary.diagnosis.iw, drift, residual, *times, *joints, *sheets,
                         round(run.wall_s, 3), sentence(summary)))
        return csv_text(COLUMNS, rows)


COLUMNS = ("lot", "house", "x [m]", "y [m]", "rotation [degrees]", "snow [m]", "delay [s]", "verdict", "Iw [-]",
           "peak drift [-]", "residual drift [-]", "tilt [s]", "collapse [s]", "broken joints", "joints",
           "broken wall sheets", "wall sheets", "computing time [s]", "sentence")
"""Of houses.csv."""


@contextmanager
def end_alone(run):
    """Context in which a PhysicsError ends this Run alone."""
    try:
        yield
    except PhysicsError as problem:
        run.fault = str(problem)

# SPDX-License-Identifier: GPL-2.0-or-later
"""A run in a live session: it continues in the background; its results are written at its last step."""
import builtins
import sys
import threading
import time
import uuid

import numpy as np
import yade.runtime
import yade.wrapper as yw
from yade.minieigenHP import Vector3
from yade_timber.scene.background import between_steps

from ..base.errors import InputError, RunError
from .progress import Status
from .runner import Run

TAG = "yade-timber run"  # tag of the scene: the run that it belongs to
BACKGROUND = (0.80, 0.87, 0.93)  # of YADE's view. [RGB]
DIRECTION = (0.72, 0.64, 0.30)  # direction from the house to the camera: north-east, above. [-]
DISTANCE = 1.15  # distance of the camera over the diagonal of the house. [-]
O = yw.Omega()
live = None  # the LiveRun of this session that records frames


class LiveRun(Run):
    """A run that can be paused, saved, loaded and changed by the user."""

    def start(self, folder_lock):
        """Run in the background, with a view if possible. folder_lock: ExitStack, closed after the results"""
        global live
        self._folder_lock, self._since = folder_lock, time.perf_counter()
        if O.iter >= self.steps:
            self._end()
            return
        O.tags[TAG] = self.tag = uuid.uuid4().hex
        show_view()
        self._status = Status(self.observer)
        live = self  # whose `record_frame` an engine behind RestSkipper calls in the step to each frame
        before = O.iter // self.chunk * self.chunk - 1  # the step that led to the last frame
        command = f"import {__name__}; {__name__}.record_frame()"
        O.engines = O.engines + [yw.PyRunner(command=command, iterPeriod=self.chunk, iterLast=before, nDone=1)]
        O.run(self.steps - O.iter)
        threading.Thread(target=self._watch, daemon=True).start()

    def _watch(self):
        while self.is_loaded() and O.iter < self.steps:
            time.sleep(0.5)
        if self.is_loaded():  # a run of another scene is the user's
            O.wait()
        self._end()

    def write(self, cut_off=None):
        """Write the results of the run up to now. cut_off: as in Run"""
        now = time.perf_counter()
        self.wall_s, self._since = self.wall_s + now - self._since, now
        with between_steps():
            super().write(cut_off)

    def is_loaded(self):
        """Whether the scene in YADE is this run's, also after it was saved and loaded again."""
        return self.is_tagged() or time.sleep(1) or self.is_tagged()  # while YADE loads a scene, no scene has tags

    def is_tagged(self):
        """The same without waiting."""
        return TAG in O.tags.keys() and O.tags[TAG] == self.tag

    def tell(self, time):
        """Print new events, and show time [s], drift and broken joints below the prompt."""
        for line in self._status.events():
            self.options.say(line)
        if not self.options.quiet:
            show_below(f"{self.scenario.name} {time:.2f}/{self.scenario.duration:.2f} s, {self._status.numbers()}")

    def _end(self):
        show_below(None)
        with self._folder_lock:
            try:
                if self.steps > 0 and not self.is_loaded():
                    raise RunError(f"{self.options.folder}: another scene was loaded before the end of the run; it has"
                                   " no results")
                self.write()
            except InputError as problem:
                print(f"error: {problem}", file=sys.stderr)

    def __repr__(self):
        state = "running" if O.running else "paused" if O.iter < self.steps else "finished"
        return f"<{self.scenario.name}: {O.time:.2f} of {self.scenario.duration:g} s, {state}>"


def show_view():
    """Open YADE's view of the scene, joints by load, when it has a display; returns it, or None without one."""
    if not yade.runtime.hasDisplay:
        return None
    from yade import qt

    renderer = qt.Renderer()
    renderer.bgColor = Vector3(*BACKGROUND)
    renderer.extraDrawers = [yw.GlExtra_TimberJoints(cross=0.1)]
    view = qt.View()
    centres = np.array([body.state.pos for body in O.bodies if body.shape.kind != "ground"])
    low, high = centres.min(0), centres.max(0)
    centre = (low + high) / 2
    eye = centre + DISTANCE * np.linalg.norm(high - low) * np.array(DIRECTION)
    view.eyePosition = Vector3(*eye)  # first: YADE computes the view direction from the position
    view.upVector, view.lookAt = Vector3.UnitZ, Vector3(*centre)
    return view


def show_below(text):
    """Show a text below IPython's prompt, or nothing with None; no effect without a prompt."""
    shell = getattr(builtins, "get_ipython", lambda: None)()  # there while the prompt is in use
    session = getattr(shell, "pt_app", None)
    if session is not None:
        session.bottom_toolbar = text
        session.app.invalidate()


def record_frame():
    """Record the state that the present step of the live run leads to; its bodies have moved already."""
    if live and live.is_tagged() and O.iter + 1 < live.steps:
        live.take(O.time + O.dt)
        live.tell(O.time + O.dt)
        if live.is_over():
            live.steps = O.stopAtIter = O.iter + 1

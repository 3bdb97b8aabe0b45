# SPDX-License-Identifier: GPL-2.0-or-later
"""Records frames of the run that is loaded in YADE (recording/frames.py)."""
import numpy as np
import yade.wrapper as yw

from ..base.errors import RunError
from ..recording import frames
from ..recording.history import History
from ..scene.engines import find_engine
from . import observer
from .versions import versions

REMEDY = "continue with --no-frames, or run without --resume to start anew"
O = yw.Omega()


class Recorder:
    """Frames of a run; the caller decides the times (frames.steps_between). run: fingerprint of its identity."""

    def __init__(self, scenario, model, title, run=""):
        elements, joints = observer.describe_elements(model), observer.describe_joints(model)
        version = versions()["package"]
        self.frames = frames.Frames(title, scenario.name, model.name, version, elements, joints, motion=observer.describe_motion(), run=run)

    def take(self, time, last=False):
        """Record the scene as it is now, unless that is done. time [s]; last: whether it is the final state."""
        made = self.frames
        if made.time and made.time[-1] > time + O.dt / 2:  # an earlier state was loaded
            self._take_over(made, time)
        if made.time and made.time[-1] > time - O.dt / 2:
            return
        made.time.append(time)
        for name, values in zip(("position", "orientation", "load", "broken"), (*observer.placements(), *observer.joint_loads())):
            getattr(made, name).append(values)
        if last or (len(made.time) - 1) % frames.CONTACT_EVERY == 0:
            made.contacts.time.append(time)
            for name, values in zip(("pair", "position", "force"), observer.contact_points()):
                getattr(made.contacts, name).append(values)

    def restore(self, path):
        """Take over the frames of a file up to the present time. Raises RunError when they are missing, of another run, or end earlier."""
        given = frames.load(path, missing=f"the checkpoint is at {O.time:g} s; {REMEDY}")
        if given.run != self.frames.run or given.position.shape[1:] != (len(self.frames.elements.name), 3):
            raise RunError(f"{path}: frames of another run than the checkpoint; {REMEDY}")
        expected = O.iter // frames.steps_between(O.dt) + 1
        self._take_over(given, O.time)
        if len(self.frames.time) < expected:
            raise RunError(f"{path}: {len(self.frames.time)} frames up to the checkpoint at {O.time:g} s, {expected} are needed; {REMEDY}")

    def _take_over(self, given, time):
        """Take over frames up to a time [s]."""
        count = np.searchsorted(given.time, time + O.dt / 2)
        for name in ("time", "position", "orientation", "load", "broken"):
            setattr(self.frames, name, list(getattr(given, name)[:count]))
        count = np.searchsorted(given.contacts.time, time + O.dt / 2)
        for name, values in list(vars(given.contacts).items()):
            setattr(self.frames.contacts, name, values[:count])

    def save(self, path):
        """Write the frames so far. Raises OSError."""
        frames.save(path, self.frames)

    def finish(self, path, found):
        """Write the frames with all that is known at the end. found: the summary. Raises OSError."""
        monitor = find_engine(yw.HouseMonitor)
        self.frames.summary = found
        self.frames.history = History(monitor.columns(), monitor.rows)
        self.frames.breaks = observer.describe_breaks()
        self.save(path)

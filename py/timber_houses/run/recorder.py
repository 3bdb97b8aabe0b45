# SPDX-License-Identifier: GPL-2.0-or-later
"""Records frames of the run that is loaded in YADE (recording/frames.py)."""
from dataclasses import replace

import numpy as np
import yade.wrapper as yw
from yade_timber.log import CONTACTS, FRAME
from yade_timber.scene import record
from yade_timber.scene.engines import find_engine

from ..base.atomic_write import remove
from ..base.errors import RunError
from ..motion import GroundMotion, displacement
from ..recording import frames
from ..recording.append_log import FRAMES_LOG, AppendLog, add_frames, log_frames
from . import observer

REMEDY = "continue with --no-frames, or run without --resume to start anew"
O = yw.Omega()


class Recorder:
    """Frames of a run; the caller decides the times (frames.steps_between). run: fingerprint of its identity."""

    def __init__(self, path, scenario, model, title, run=""):
        elements, joints = observer.describe_elements(model), observer.describe_joints(model)
        version, motion = observer.versions()["package"], observer.describe_motion()
        if motion:
            motion.displacement = displacement(GroundMotion(motion.dt, motion.acceleration))
        self.frames = frames.Frames(title, scenario.name, model.name, version, elements, joints,
                                    motion=motion, run=run, sheets=observer.describe_sheets(model))
        self.model, self.path, self.log, self.times = model, path, AppendLog(path.with_name(FRAMES_LOG), run), []
        self.described = False  # whether the file holds elements and joints of this run

    def take(self, time, state, last=False):
        """Record the State of the scene, unless that is done. time [s]; last: whether it is the final one."""
        if self.times and self.times[-1] > time + O.dt / 2:  # an earlier state was loaded
            self._cut(time)
        if self.times and self.times[-1] > time - O.dt / 2:
            return
        self.times.append(time)
        self.log.add(FRAME, time, state.position, state.orientation, state.load, state.broken)
        if last or (len(self.times) - 1) % frames.CONTACT_EVERY == 0:
            self.log.add(CONTACTS, time, *record.contact_points())

    def _cut(self, time):
        self.log.cut(time + O.dt / 2)
        self.times = self.times[:np.searchsorted(self.times, time + O.dt / 2)]

    def resume(self):
        """Take over the frames up to the present time. Raises RunError when there are none of this run; OSError."""
        earlier = frames.load(self.path, missing=f"the checkpoint is at {O.time:g} s; {REMEDY}")
        if earlier.run != self.frames.run or earlier.position.shape[1:] != (len(self.frames.elements.name), 3):
            raise RunError(f"{self.path}: frames of another run than the checkpoint; {REMEDY}")
        self.times, expected = list(earlier.time), O.iter // frames.steps_between(O.dt) + 1
        self.described = earlier.summary is None
        if not self.described:  # the frames are in the file itself
            remove(self.log.path)
            log_frames(self.log, earlier)
        self._cut(O.time)
        if len(self.times) < expected:
            raise RunError(f"{self.path}: {len(self.times)} frames up to the checkpoint at {O.time:g} s, {expected} are"
                           f" needed; {REMEDY}")
        self.save()

    def save(self):
        """Append the new frames to the log. Raises OSError."""
        self.log.flush()
        if not self.described:  # also of a run that is resumed after its end
            frames.save(self.path, self.frames)
            self.described = True

    def finish(self, summary, history, tables):
        """Write all frames up to now and the results into one file; returns the Frames. The run may go on. summary:
        Summary; tables: quantities.Tables. Raises OSError."""
        entries = list(find_engine(yw.JointEngine).breaks)
        breaks = {name: [getattr(entry, name) for entry in entries] for name in observer.BREAKS}
        breaks["cause"] = [observer.cause_of(entry, self.model) for entry in entries]
        whole = replace(self.frames, summary=summary, history=history, breaks=breaks,
                        contacts=frames.Contacts(), **tables.recorded(observer.element_numbers(self.model)))
        self.log.pending = list(self.log.records())
        add_frames(whole, self.log.pending)
        frames.save(self.path, whole)
        remove(self.log.path)
        self.described = False
        return whole

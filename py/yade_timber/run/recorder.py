# SPDX-License-Identifier: GPL-2.0-or-later
"""Recording: the scene in YADE -> frames (frames.py)."""
import numpy as np
import yade.wrapper as yw

from .. import _plugin
from ..recording import frames
from . import summary as results
from ..scene import engines as scene
from ..motion import GroundMotion, displacement

O = yw.Omega()


class Recorder:
    """Frames of the run that is loaded in YADE; the caller decides when (frames.steps_between)."""

    def __init__(self, scenario, model, title):
        version = results.versions()["package"]
        self.frames = frames.Frames(title, scenario.name, model.name, version, describe_elements(model), describe_joints(model, scene.find_engine(yw.JointEngine)), motion=describe_motion())

    def take(self, time, last=False):
        """Record the scene as it is now, unless that is done. time [s]; last: whether it is the final state."""
        kept = self.frames
        if kept.time and kept.time[-1] > time + O.dt / 2:  # an earlier state was loaded
            self._keep(kept, time)
        if kept.time and kept.time[-1] > time - O.dt / 2:
            return
        kept.time.append(time)
        position, orientation = _plugin.packed_placements()
        load, broken = _plugin.packed_joints(scene.find_engine(yw.JointEngine))
        kept.position.append(np.frombuffer(position, "f4").reshape(-1, 3))
        kept.orientation.append(np.frombuffer(orientation, "f4").reshape(-1, 4))
        kept.load.append(np.frombuffer(load, "f4"))
        kept.broken.append(np.frombuffer(broken, "u1"))
        if last or (len(kept.time) - 1) % frames.CONTACT_EVERY == 0:
            self.take_contacts(time)

    def take_contacts(self, time):
        kept = self.frames.contacts
        pair, position, force = _plugin.packed_contacts()
        kept.time.append(time)
        kept.pair.append(np.frombuffer(pair, "i4").reshape(-1, 2))
        kept.position.append(np.frombuffer(position, "f4").reshape(-1, 3))
        kept.force.append(np.frombuffer(force, "f4").reshape(-1, 3))

    def restore(self, path):
        """Take over the frames of a file up to the present time. Raises RunError when it cannot be read."""
        self._keep(frames.load(path), O.time)

    def _keep(self, given, time):
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
        monitor = scene.find_engine(yw.HouseMonitor)
        self.frames.summary = found
        self.frames.history = list(monitor.columns()), np.reshape(monitor.rows, (-1, len(monitor.columns())))
        self.frames.breaks = describe_breaks(scene.find_engine(yw.JointEngine))
        self.save(path)


def describe_elements(model):
    """frames.Elements of the scene; body k is element k of the model."""
    bodies = list(O.bodies)
    return frames.Elements(
        name=[e.name for e in model.elements],
        kind=[e.kind for e in model.elements],
        group=[e.group for e in model.elements],
        material=[e.material for e in model.elements],
        storey=np.array([e.storey for e in model.elements]),
        fixed=np.array([e.fixed for e in model.elements]),
        position=np.array([b.state.refPos for b in bodies]),
        orientation=np.array([[q[3], q[0], q[1], q[2]] for q in (b.state.refOri for b in bodies)]),
        vertices=[np.array(b.shape.vertices) for b in bodies],
        faces=[b.shape.faces() for b in bodies],
    )


def describe_joints(model, engine):
    """frames.Joints of the scene; joint k of the engine is joint k of the model."""
    number = {e.name: k for k, e in enumerate(model.elements)}
    specs, joints = model.joints, list(engine.joints)
    return frames.Joints(
        name=[s.name for s in specs],
        kind=[s.kind for s in specs],
        storey=[results.storey_of(s, model) for s in specs],
        side=["+".join(results.sides_of(s)) for s in specs],
        a=np.array([number[s.a] for s in specs], "i4"),
        b=np.array([number[s.b] for s in specs], "i4"),
        anchor=np.array([np.mean(j.anchors1, axis=0) for j in joints]).reshape(-1, 3),
        springs=np.array([len(j.anchors1) for j in joints], "i4"),
        damaged=np.array([s.broken for s in specs], bool),
        strength=np.array([s.strength for s in specs], float),
    )


def describe_motion():
    """frames.Motion of the scene's ground motion, or None."""
    engine = scene.find_engine(yw.GroundMotionEngine)
    if engine is None:
        return None
    applied = GroundMotion(engine.step, engine.scale * np.array(engine.acceleration))
    return frames.Motion(applied.dt, engine.start, applied.acceleration, displacement(applied))


def describe_breaks(engine):
    """Columns of /breaks."""
    entries = list(engine.breaks)
    return {name: [getattr(entry, name) for entry in entries] for name in ("time", "joint", "spring", "cause", "force")}

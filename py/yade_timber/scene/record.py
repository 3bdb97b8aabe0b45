# SPDX-License-Identifier: GPL-2.0-or-later
"""Descriptions and states of the scene as arrays, and a log of them for the pictures of `timber_houses`."""
import json
from pathlib import Path

import numpy as np
import yade.wrapper as yw

from .. import log
from ..plugin import compiled
from . import arguments
from .background import between_steps
from .engines import find_engine
from .export import polyhedra
from .joints import joins_bodies

O = yw.Omega()


def describe_bodies(bodies):
    """{column: values} of polyhedra in their present placement; vertices in the body frame."""
    states = [body.state for body in bodies]
    return {"name": [body.shape.name or f"body {body.id}" for body in bodies],
            "kind": [body.shape.kind for body in bodies], "material": [body.material.label for body in bodies],
            "fixed": np.array([not body.dynamic for body in bodies], bool),
            "position": np.array([state.pos for state in states]),
            "orientation": np.array([[state.ori[k] for k in (3, 0, 1, 2)] for state in states]),
            "vertices": [np.array(body.shape.vertices) for body in bodies],
            "faces": [body.shape.faces() for body in bodies]}


def describe_joints(joints, ids):
    """{column: values} of TimberJoints. ids: of the described bodies, ascending"""
    return {"name": [joint.name for joint in joints], "kind": [joint.kind for joint in joints],
            "a": np.searchsorted(ids, [joint.id1 for joint in joints]).astype("i4"),
            "b": np.searchsorted(ids, [joint.id2 for joint in joints]).astype("i4"),
            "anchor": np.array([np.mean(joint.anchors1, axis=0) for joint in joints]).reshape(-1, 3),
            "springs": np.array([len(joint.anchors1) for joint in joints], "i4"),
            "damaged": np.array([all(joint.broken) for joint in joints], bool),
            "strength": np.array([joint.strength for joint in joints], float)}


def placements():
    """((N, 3) positions [m], (N, 4) orientations w, x, y, z) of the bodies, float32; NaN for a removed one."""
    position, orientation = compiled.packed_placements()
    return np.frombuffer(position, "f4").reshape(-1, 3), np.frombuffer(orientation, "f4").reshape(-1, 4)


def joint_loads():
    """((J,) load over strength, float32; (J,) number of broken springs, uint8)."""
    engine = find_engine(yw.JointEngine)
    load, broken = compiled.packed_joints(engine) if engine else (b"", b"")
    return np.frombuffer(load, "f4"), np.frombuffer(broken, "u1")


def contact_points():
    """((P, 2) ids of bodies, (P, 3) positions [m], (P, 3) forces on the second body [N])."""
    pair, position, force = compiled.packed_contacts()
    return (np.frombuffer(pair, "i4").reshape(-1, 2), np.frombuffer(position, "f4").reshape(-1, 3),
            np.frombuffer(force, "f4").reshape(-1, 3))


class Record:
    """Log of the bodies and joints that the scene had at the first frame. path: the file; time: of the last frame"""

    def __init__(self, path, title):
        self.path, self.time = Path(path).absolute(), O.time
        self._bodies = {body.id: body for body in polyhedra("record")}
        self._joints = {k: joint for k, joint in enumerate(_joints()) if joins_bodies(joint)}
        if not self._bodies:
            raise ValueError("record: a scene without bodies")
        elements = describe_bodies(self._bodies.values())
        elements |= log.flat_shapes(elements["vertices"], elements["faces"])
        joints = describe_joints(self._joints.values(), list(self._bodies))
        scene = json.dumps({"title": title, "elements": elements, "joints": joints}, default=np.ndarray.tolist)
        start = log.packed(log.RUN, 0.0, log.OWN_SCENE.encode()) + log.packed(log.SCENE, 0.0, scene.encode())
        self._size = self.path.write_bytes(start + self._frame())

    @between_steps()
    def take(self):
        """Append a frame of the scene as it is; none if its time has one. Raises ValueError for another scene,
        OSError."""
        if O.time < self.time:
            raise ValueError(f"record: {O.time:g} s is before the last frame at {self.time:g} s; begin another record")
        if O.time > self.time:
            frame = self._frame()
            with open(self.path, "r+b") as file:
                file.truncate(self._size)  # an entry that found no space
                file.seek(self._size)
                file.write(frame)
            self._size, self.time = self._size + len(frame), O.time

    def _frame(self):
        """Bytes of the entries of the present state; a body that is gone is NaN."""
        kept = np.array(_kept(self._bodies, O.bodies))
        if not kept.any() or not all(_kept(self._joints, _joints())):
            raise ValueError("record: the bodies or joints of the first frame are gone; begin another record")
        ids, joints = np.array(list(self._bodies)), list(self._joints)
        tables = [np.full((len(ids), values.shape[1]), np.nan, "f4") for values in placements()]
        for table, values in zip(tables, placements()):
            table[kept] = values[ids[kept]]
        pair, *vectors = contact_points()
        known = np.isin(pair, ids[kept]).all(1)
        pair = np.searchsorted(ids, pair[known]).astype("i4")
        return (log.packed(log.FRAME, O.time, *tables, *(values[joints] for values in joint_loads()))
                + log.packed(log.CONTACTS, O.time, pair, *(values[known] for values in vectors)))


def _joints():
    engine = find_engine(yw.JointEngine)
    return engine.joints if engine else []


def _kept(parts, container):
    """Whether each of the parts {place: object} is in its place of a container."""
    return [place < len(container) and container[place] == part for place, part in parts.items()]


@between_steps()
def record(path, title=""):
    """Begin a log of the scene with a frame of its present state; player, films and exports of `timber_houses` read it.

    Parameters
    ----------
    path : str or Path
        File to write.
    title : str
        Heading of the pictures; by default the file's name.

    Returns
    -------
    Record
        Its ``take()`` appends a frame. Bodies and joints that are added later are left out.

    Raises
    ------
    ValueError
        For a scene without bodies, or a body that is no RoundedPolyhedron.
    OSError
        When the file cannot be written.
    """
    return Record(path, arguments.text("record: title", title) or Path(path).stem)

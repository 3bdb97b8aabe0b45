# SPDX-License-Identifier: GPL-2.0-or-later
"""The recorded frames of a run, frames.h5: the source of pictures, player and exports.

Frame of all vectors: x east, y north, z up, fixed to the ground. N elements, J joints, F frames. The file (HDF5):

attributes   format, title (house and loads), scenario, model, version (of the package), ended (bool), run (fingerprint
             of the run's identity); of an ended run also summary: the text of summary.json
/elements    name, kind, group (structure: 'main', 'entrance', ...), material (N,) strings; storey (N,) int, 0 below the
             first; fixed (N,) bool; position (N, 3) [m], orientation (N, 4) w, x, y, z: before the first step;
             vertices (V, 3) [m], body frame (origin in the centroid), those of element k in rows vertex_start[k] :
             vertex_start[k + 1]; faces (C,): vertex numbers within the element, counter-clockwise from outside, those
             of face m in face_start[m] : face_start[m + 1]; the faces of element k are element_start[k] :
             element_start[k + 1]
/joints      name, kind, storey ('1', '2', ... or the structure), side ('north', 'north+east', ..., 'inside') (J,)
             strings; a, b (J,) element numbers; anchor (J, 3) [m]: mean of the spring points in the body frame of a;
             springs (J,): their number; damaged (J,) bool: broken before the start; strength (J,) [N], may be infinite;
             sheet (J,): number of the wall sheet of which it is a half, -1: of none
/sheets      wall sheets: type (of the house file), opening ('none', 'window', 'door') (S,) strings; low, high (S,): the
             columns (elements) of its bay
/frames      time (F,) [s]; position (F, N, 3) [m] and orientation (F, N, 4) w, x, y, z, float32; load (F, J) float32:
             largest spring force by strength (of a joint that breaks as one: the sum); broken (F, J) uint8: number of
             broken springs
/contacts    time (K,) [s], every CONTACT_EVERY-th frame and the last; start (K + 1,): the points of time k are
             start[k] : start[k + 1]; pair (P, 2) element numbers; position (P, 3) [m]; force (P, 3) [N] on the second
             element, float32
/motion      only with an earthquake: attributes dt [s], start [s]; acceleration (M, 3) [m/s2] as applied, displacement
             (M, 3) [m] of the ground
/history     of an ended run: columns (names with units), rows; the table of history.csv
/storeys     of an ended run of a house: likewise, the table of storeys.csv
/joint_peaks of an ended run of a house: load [-], pull, shear [N], opening [m] (J,): largest, before its fall if any
/columns     of an ended run of a house: element; uplift of its foot [m]; state ('standing', 'fallen', 'loose'); the
             largest uplift first
/breaks      of an ended run: time [s], joint, spring, cause, force [N]; one entry for each spring that broke

Frames are recorded FRAMES_PER_SECOND times per simulated second from t = 0, and at the last step. Until the run has
ended, the frames and contacts up to its last checkpoint are in frames.log beside the file (frame_log.py), which `load`
reads, too. It also reads the log of a user's scene (`yt.record`).
"""
import io
import json
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import h5py
import numpy as np
from yade_timber.log import flat_shapes, starts

from ..base.atomic_write import write_bytes
from ..base.errors import RunError
from ..base.json_types import encode
from ..base.time_step import rest_stride
from . import append_log, frame_log, scene_log
from .history import History
from .quantities import Storeys
from .summary import ANEW, Summary, parse
from .table_file import FAULTS, Group, opened

NAME = "frames.h5"
FORMAT = "yade-timber frames 1"
FRAMES_PER_SECOND = 20
CONTACT_EVERY = 10
ATTRIBUTES = ("title", "scenario", "model", "version", "run")
LAYOUT = {
    "": Group(attributes={"format": "text", **dict.fromkeys(ATTRIBUTES, "text"), "ended": "flag", "summary": "text"}),
    "elements": Group({
        **dict.fromkeys(("name", "kind", "group", "material"), ("text", "N")), "storey": ("whole", "N"),
        "fixed": ("flag", "N"), "position": ("number", "N", 3), "orientation": ("number", "N", 4),
        "vertices": ("number", "V", 3), "vertex_start": ("whole", "N + 1"), "faces": ("whole", "C"),
        "face_start": ("whole", "faces + 1"), "element_start": ("whole", "N + 1")
    }),
    "joints": Group({
        **dict.fromkeys(("name", "kind", "storey", "side"), ("text", "J")), "a": ("whole", "J"), "b": ("whole", "J"),
        "anchor": ("number", "J", 3), "springs": ("whole", "J"), "damaged": ("flag", "J"), "strength": ("number", "J"),
        "sheet": ("whole", "J")
    }),
    "sheets": Group({"type": ("text", "S"), "opening": ("text", "S"), "low": ("whole", "S"), "high": ("whole", "S")}),
    "frames": Group({
        "time": ("number", "F"), "position": ("number", "F", "N", 3), "orientation": ("number", "F", "N", 4),
        "load": ("number", "F", "J"), "broken": ("whole", "F", "J")
    }),
    "contacts": Group({
        "time": ("number", "K"), "start": ("whole", "K + 1"), "pair": ("whole", "P", 2), "position": ("number", "P", 3),
        "force": ("number", "P", 3)
    }),
    "motion": Group({"acceleration": ("number", "M", 3), "displacement": ("number", "M", 3)},
                    {"dt": "number", "start": "number"}),
    "history": Group({"columns": ("text", "columns"), "rows": ("number", "samples", "columns")}),
    "storeys": Group({"columns": ("text", "quantities"), "rows": ("number", "intervals", "quantities")}),
    "joint_peaks": Group(dict.fromkeys(("load", "pull", "shear", "opening"), ("number", "J"))),
    "columns": Group({"element": ("whole", "O"), "uplift": ("number", "O"), "state": ("text", "O")}),
    "breaks": Group({"time": ("number", "B"), "joint": ("whole", "B"), "spring": ("whole", "B"), "cause": ("text", "B"),
                     "force": ("number", "B")}),
}
"""What the file can hold, as of `table_file`."""


def steps_between(dt):
    """Steps of dt [s] between two frames: whole strides, so that a step with a frame is computed at rest, too."""
    stride = rest_stride(dt)
    return stride * max(1, round(1 / (FRAMES_PER_SECOND * stride * dt)))


class _ShortRepr:
    """Prints sizes instead of contents."""

    def __repr__(self):
        sizes = (f"{name}={f'<{len(value)}>' if hasattr(value, '__len__') else value}"
                 for name, value in vars(self).items())
        return f"{type(self).__name__}({', '.join(sizes)})"


@dataclass(repr=False)
class Elements(_ShortRepr):
    """Names and shapes, as in /elements; vertices and faces: a list per element."""

    name: list
    kind: list
    group: list
    material: list
    storey: np.ndarray
    fixed: np.ndarray
    position: np.ndarray
    orientation: np.ndarray
    vertices: list
    faces: list


@dataclass(repr=False)
class Joints(_ShortRepr):
    """As in /joints."""

    name: list
    kind: list
    storey: list
    side: list
    a: np.ndarray
    b: np.ndarray
    anchor: np.ndarray
    springs: np.ndarray
    damaged: np.ndarray
    strength: np.ndarray
    sheet: np.ndarray = None  # type: ignore[assignment]  # of no wall

    def __post_init__(self):
        self.sheet = np.full(len(self.name), -1) if self.sheet is None else self.sheet


def _no_elements():
    return np.empty(0, int)


@dataclass(repr=False)
class Sheets(_ShortRepr):
    """As in /sheets."""

    type: list = field(default_factory=list)
    opening: list = field(default_factory=list)
    low: np.ndarray = field(default_factory=_no_elements)
    high: np.ndarray = field(default_factory=_no_elements)


@dataclass(repr=False)
class Contacts(_ShortRepr):
    """As in /contacts; pair, position, force: a list with an array per time."""

    time: list = field(default_factory=list)
    pair: list = field(default_factory=list)
    position: list = field(default_factory=list)
    force: list = field(default_factory=list)


@dataclass(repr=False)
class Motion(_ShortRepr):
    """As in /motion."""

    dt: float
    start: float
    acceleration: np.ndarray
    displacement: np.ndarray

    @property
    def time(self):
        return self.start + self.dt * np.arange(len(self.acceleration))

    def first(self, acceleration):
        """Time at which the ground first has an acceleration [m/s2] in any direction, or None. [s]"""
        reached = np.flatnonzero(np.abs(self.acceleration).max(1) >= acceleration)
        return float(self.time[reached[0]]) if len(reached) else None

    def last(self, acceleration):
        """Time from which on the ground has less than an acceleration [m/s2] in all directions. [s]"""
        reached = np.flatnonzero(np.abs(self.acceleration).max(1) >= acceleration)
        return float(self.time[reached[-1]] + self.dt) if len(reached) else self.start


@dataclass(repr=False)
class Frames:
    """The file's content. time, position, orientation, load, broken: arrays, or lists during a run.

    scenario: '' of a user's scene; summary: Summary, of a town TownSummary; breaks, peaks, columns: dictionaries of
    /breaks, /joint_peaks and /columns; None before the run's end, the last three and storeys also of a town.
    """

    title: str
    scenario: str
    model: str
    version: str
    elements: Elements
    joints: Joints
    time: list = field(default_factory=list)
    position: list = field(default_factory=list)
    orientation: list = field(default_factory=list)
    load: list = field(default_factory=list)
    broken: list = field(default_factory=list)
    contacts: Contacts = field(default_factory=Contacts)
    motion: Motion | None = None
    summary: Summary | None = None
    history: History | None = None
    breaks: dict | None = None
    run: str = ""
    storeys: Storeys | None = None
    peaks: dict | None = None
    columns: dict | None = None
    sheets: Sheets = field(default_factory=Sheets)

    def __repr__(self):
        until = f"up to {self.time[-1]:g} s" if len(self.time) else "empty"
        sizes = f"{len(self.elements.name)} elements, {len(self.joints.name)} joints, {len(self.time)} frames"
        return f"<Frames: {self.title}, {sizes}, {until}, {'ended' if self.summary else 'not ended'}>"

    def corners(self, frame, element):
        """(n, 3) corners of an element in a frame, world frame [m]."""
        return placed(self.elements.vertices[element], self.position[frame][element], self.orientation[frame][element])

    def corners_at_start(self, element):
        """(n, 3) corners of an element before the first step, world frame [m]."""
        e = self.elements
        return placed(e.vertices[element], e.position[element], e.orientation[element])

    def all_corners(self, frame=None):
        """List of the (n, 3) corners of every element in a frame, or (None) before the first step, world frame [m]."""
        e = self.elements
        position, orientation = ((e.position, e.orientation) if frame is None
                                 else (self.position[frame], self.orientation[frame]))
        counts = [len(vertices) for vertices in e.vertices]
        body = np.repeat(np.arange(len(counts)), counts)
        corners = np.asarray(position, float)[body] + rotated(np.asarray(orientation)[body], np.concatenate(e.vertices))
        return np.split(corners, np.cumsum(counts)[:-1])

    def joint_places(self, frame):
        """(J, 3) positions of the joints on their first elements, world frame [m]."""
        a = self.joints.a
        return np.asarray(self.position[frame])[a] + rotated(np.asarray(self.orientation[frame])[a], self.joints.anchor)

    def joint_states(self, frame):
        """'whole', 'partly', 'broken' or 'before' (the start), for each joint. frame: a number, or a slice"""
        j = self.joints
        state = np.where(np.asarray(self.broken[frame]) == 0, "whole",
                         np.where(self.broken[frame] >= j.springs, "broken", "partly"))
        return np.where(j.damaged, "before", state)

    def at(self, time):
        """Number of the frame nearest to a time [s]."""
        return int(np.argmin(np.abs(np.asarray(self.time) - time)))

    @cached_property
    def shown(self):
        """Numbers of the elements that pictures show: all but the ground."""
        return [k for k, kind in enumerate(self.elements.kind) if kind != "ground"]


def rotated(q, v):
    """Vectors (..., 3) rotated by unit quaternions (..., 4) w, x, y, z."""
    q, v = np.asarray(q, float), np.asarray(v, float)
    u = q[..., 1:]
    t = 2 * np.cross(u, v)
    return v + q[..., :1] * t + np.cross(u, t)


def placed(vertices, position, orientation):
    """(n, 3) vertices of a body frame in the world frame."""
    return np.asarray(position, float) + rotated(np.asarray(orientation)[None], vertices)


# --- writing ----------------------------------------------------------------------------------------------------------


def save(path, frames):
    """Write the file. A kill at any moment leaves a complete file, the earlier or the new one. Raises OSError."""
    memory = io.BytesIO()  # HDF5 crashes where it cannot write
    with h5py.File(memory, "w") as file:
        file.attrs.update({"format": FORMAT, **{name: getattr(frames, name) for name in ATTRIBUTES},
                           "ended": frames.summary is not None})
        if frames.summary is not None:
            file.attrs["summary"] = json.dumps(encode(frames.summary))
        plain = {name: values for name, values in vars(frames.elements).items() if name not in ("vertices", "faces")}
        shapes = flat_shapes(frames.elements.vertices, frames.elements.faces)
        _save_group(file.create_group("elements"), plain | shapes)
        _save_group(file.create_group("joints"), vars(frames.joints))
        _save_group(file.create_group("sheets"), vars(frames.sheets))
        _save_group(file.create_group("frames"), frame_log.series(frames))
        _save_contacts(file.create_group("contacts"), frames.contacts)
        if frames.motion:
            group = file.create_group("motion")
            group.attrs.update(dt=frames.motion.dt, start=frames.motion.start)
            _save_group(group, {"acceleration": frames.motion.acceleration, "displacement": frames.motion.displacement})
        results = {"history": frames.history and frames.history._asdict(), "breaks": frames.breaks,
                   "storeys": frames.storeys and frames.storeys._asdict(), "joint_peaks": frames.peaks,
                   "columns": frames.columns}
        for name, table in results.items():
            if table is not None:
                _save_group(file.create_group(name), table)
    write_bytes(path, memory.getbuffer())


def _save_group(group, values):
    for name, value in values.items():
        text = len(value) and isinstance(value[0], str)
        group.create_dataset(name, data=value, dtype=h5py.string_dtype() if text else None)


def _save_contacts(group, contacts):
    shapes = {"pair": ("i4", 2), "position": ("f4", 3), "force": ("f4", 3)}
    flat = {name: np.concatenate([np.empty((0, width), kind), *getattr(contacts, name)])
            for name, (kind, width) in shapes.items()}
    _save_group(group, {"time": np.asarray(contacts.time, float), "start": starts(contacts.pair), **flat})


# --- reading ----------------------------------------------------------------------------------------------------------


def load(path, missing="frames are recorded unless a run has --no-frames, and not in batches"):
    """Frames of a file. Raises RunError when it cannot be read. missing: remedy when there is no file"""
    try:
        loaded = _load_scene(path) if append_log.is_log(path, missing) else _load_run(path, missing)
        _check_numbers(loaded)
    except RunError:
        raise
    except (*FAULTS, OverflowError) as problem:
        raise RunError(f"{path}: cannot read the frames: {' '.join(str(problem).split())}; {ANEW}") from None
    return loaded


def _load_run(path, missing):
    with opened(path, LAYOUT, missing) as file:
        if file.attrs.get("format") != FORMAT:
            raise RunError(f"{path}: no recorded frames ({FORMAT})")
        loaded = _load(file)
    if loaded.summary is None:
        frame_log.add_frames(loaded, append_log.read(Path(path).with_name(frame_log.NAME), loaded.run))
    return loaded


def _load_scene(path):
    """Frames of a log of `yt.record`; its elements are one structure without storeys, its joints on no side."""
    title, elements, joints, records = scene_log.read(path, LAYOUT)
    elements |= {"group": ["main"] * len(elements["name"]), "storey": np.zeros(len(elements["name"]), "i4")}
    joints |= {name: [""] * len(joints["name"]) for name in ("storey", "side")}
    loaded = Frames(title, "", "", "", _elements(elements), Joints(**joints))
    frame_log.add_frames(loaded, records)
    return loaded


def _check_numbers(frames):
    """Raise ValueError when shapes are missing or numbers name elements that do not exist."""
    e, j, n = frames.elements, frames.joints, len(frames.elements.name)
    for name in ("vertices", "faces"):
        if len(getattr(e, name)) != n:
            raise ValueError(f"elements/{name}: of {len(getattr(e, name))} elements instead of {n}")
    numbers = [("joints/a", j.a, n), ("joints/b", j.b, n), ("joints/sheet", j.sheet + 1, len(frames.sheets.type) + 1),
               ("sheets/low", frames.sheets.low, n), ("sheets/high", frames.sheets.high, n),
               ("columns/element", (frames.columns or {}).get("element", ()), n),
               *(("contacts/pair", pair, n) for pair in frames.contacts.pair)]
    numbers += [("elements/faces", face, len(vertices)) for faces, vertices in zip(e.faces, e.vertices)
                for face in faces]
    for name, values, limit in numbers:
        if len(values) and not (0 <= np.min(values) and np.max(values) < limit):
            raise ValueError(f"{name}: a number outside 0 ... {limit - 1}")
    _check_finite(frames)


def _check_finite(frames):
    """Raise ValueError for numbers that are not finite. A removed element is NaN in all its numbers of a frame."""
    parts = np.asarray(frames.position), np.asarray(frames.orientation)
    finite = np.all([np.isfinite(part).all(2) for part in parts], axis=0)
    removed = np.all([np.isnan(part).all(2) for part in parts], axis=0)
    tables = {"frames/position, orientation": finite | removed, "frames/time": np.isfinite(frames.time)}
    tables |= {f"elements/{name}": np.isfinite(getattr(frames.elements, name)) for name in ("position", "orientation")}
    tables |= {f"joint_peaks/{name}": np.isfinite(values) for name, values in (frames.peaks or {}).items()}
    tables["columns/uplift"] = np.isfinite((frames.columns or {}).get("uplift", ()))
    for name, valid in tables.items():
        if not valid.all():
            raise ValueError(f"{name}: a number that is not finite")


def _load(file):
    attributes = {name: str(file.attrs.get(name, "")) for name in ATTRIBUTES}
    series = {name: file["frames"][name][()] for name in ("time", "position", "orientation", "load", "broken")}
    loaded = Frames(**attributes, elements=_elements(_values(file["elements"])),
                    joints=Joints(**_values(file["joints"])),
                    sheets=Sheets(**_values(file["sheets"])), **series, contacts=_load_contacts(file["contacts"]))
    if "motion" in file:
        numbers = {name: float(file["motion"].attrs[name]) for name in ("dt", "start")}
        loaded.motion = Motion(**numbers, **_values(file["motion"]))
    if file.attrs["ended"]:
        loaded.summary = parse(file.attrs["summary"])
        loaded.history = History(**_values(file["history"]))
        loaded.breaks = _values(file["breaks"])
    if "joint_peaks" in file:
        loaded.storeys = Storeys(**_values(file["storeys"]))
        loaded.peaks, loaded.columns = _values(file["joint_peaks"]), _values(file["columns"])
    return loaded


def _values(group):
    """{name: array, or list of strings}."""
    return {name: list(data.asstr()[()]) if h5py.check_string_dtype(data.dtype) else data[()]
            for name, data in group.items()}


def _split(flat, start):
    """Parts of an array, each entry in one."""
    if not len(start) or start[0] != 0 or start[-1] != len(flat) or np.any(np.diff(start.astype("i8")) < 0):
        raise ValueError(f"starts of parts that are not 0 ... {len(flat)} in order")
    return [flat[a:b] for a, b in zip(start[:-1], start[1:])]


def _elements(values):
    """Elements of the tables of /elements."""
    begins = {name: values.pop(name) for name in ("vertex_start", "face_start", "element_start")}
    faces = [list(map(int, face)) for face in _split(values["faces"], begins["face_start"])]
    values |= {"vertices": _split(values["vertices"], begins["vertex_start"]),
               "faces": _split(faces, begins["element_start"])}
    return Elements(**values)


def _load_contacts(group):
    values = _values(group)
    return Contacts(list(values["time"]),
                    *(_split(values[name], values["start"]) for name in ("pair", "position", "force")))

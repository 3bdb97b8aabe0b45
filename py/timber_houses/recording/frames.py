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
ended, the frames and contacts up to its last checkpoint are in frames.log beside the file (append_log.py), which `load`
reads, too. It also reads the log of a user's scene (`yt.record`)."""
import io
import json
from pathlib import Path

import h5py
import numpy as np
from yade_timber.log import flat_shapes, starts

from ..base.atomic_write import write_bytes
from ..base.errors import RunError
from ..base.json_types import encode
from ..base.time_step import rest_stride
from . import append_log
from .history import History
from .quantities import Storeys
from .record import Contacts, Elements, Frames, Joints, Motion, Sheets
from .summary import ANEW, parse
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
        _save_group(file.create_group("frames"), append_log.series(frames))
        contacts, widths = frames.contacts, {"pair": ("i4", 2), "position": ("f4", 3), "force": ("f4", 3)}
        flat = {name: np.concatenate([np.empty((0, width), kind), *getattr(contacts, name)])
                for name, (kind, width) in widths.items()}
        _save_group(file.create_group("contacts"), {"time": np.asarray(contacts.time, float),
                                                    "start": starts(contacts.pair), **flat})
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


# --- reading ----------------------------------------------------------------------------------------------------------


def load(path, missing="frames are recorded unless a run has --no-frames, and not in batches"):
    """Frames of a file. Raises RunError when it cannot be read. missing: remedy when there is no file"""
    try:
        loaded = _load_scene(path) if append_log.is_log(path, missing) else _load_run(path, missing)
        _check_numbers(loaded)
        _check_finite(loaded)
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
        append_log.add_frames(loaded, append_log.read(Path(path).with_name(append_log.FRAMES_LOG), loaded.run))
    return loaded


def _load_scene(path):
    """Frames of a log of `yt.record`; its elements are one structure without storeys, its joints on no side."""
    title, elements, joints, records = append_log.read_scene(path, LAYOUT)
    elements |= {"group": ["main"] * len(elements["name"]), "storey": np.zeros(len(elements["name"]), "i4")}
    joints |= {name: [""] * len(joints["name"]) for name in ("storey", "side")}
    loaded = Frames(title, "", "", "", _elements(elements), Joints(**joints))
    append_log.add_frames(loaded, records)
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
                    sheets=Sheets(**_values(file["sheets"])), **series)
    contacts = _values(file["contacts"])
    loaded.contacts = Contacts(list(contacts["time"]), *(_split(contacts[name], contacts["start"])
                                                         for name in ("pair", "position", "force")))
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
    return {name: list(data.asstr()[()]) if h5py.check_string_dtype(data.dtype) else data[()]
            for name, data in group.items()}


def _split(flat, start):
    """Parts of an array, each entry in one."""
    if not len(start) or start[0] != 0 or start[-1] != len(flat) or np.any(np.diff(start.astype("i8")) < 0):
        raise ValueError(f"starts of parts that are not 0 ... {len(flat)} in order")
    return [flat[a:b] for a, b in zip(start[:-1], start[1:])]


def _elements(values):
    begins = {name: values.pop(name) for name in ("vertex_start", "face_start", "element_start")}
    faces = [list(map(int, face)) for face in _split(values["faces"], begins["face_start"])]
    values |= {"vertices": _split(values["vertices"], begins["vertex_start"]),
               "faces": _split(faces, begins["element_start"])}
    return Elements(**values)

# SPDX-License-Identifier: GPL-2.0-or-later
"""The player: one HTML file in which a recorded run is looked at, or two runs side by side in step. Needs no YADE, the page no network.

The page holds positions in steps of POSITION_STEP and orientations in steps of ORIENTATION_STEP: a centroid is off by at most
0.44 mm, an element turned by at most 0.004 degrees; between two frames the page interpolates (linear, slerp).
"""
import html
from pathlib import Path

import numpy as np

from ..recording import frames
from . import key_times as moments
from ..base import colors as palette
from ..base.errors import RunError
from ..base.atomic_write import write_text
from .packing import pack
from ..recording.sentences import DRIFT_LINES, direction_name, sentence

NAME = "player.html"
ASSETS = Path(__file__).resolve().parents[1] / "data" / "player"

POSITION_STEP = 0.5e-3
"""Of positions of elements. [m]"""
ORIENTATION_STEP = 1 / 32767
"""Of the components of quaternions. [-]"""
ONSET = 0.1
"""Ground acceleration with which the shaking has begun. [m/s2]"""


def make(recorded, path):
    """Write the page and return its path.

    recorded  a file of frames, or a list of one or two
    Raises RunError when frames cannot be read, OSError when the page cannot be written.
    """
    sources = recorded if isinstance(recorded, (list, tuple)) else [recorded]
    if not 1 <= len(sources) <= 2:
        raise RunError(f"{len(sources)} runs: the player shows one, or compares two")
    runs = [(source, frames.load(source)) for source in sources]
    title = " / ".join(run.title for _, run in runs)
    data = "\n".join(f'<script type="text/plain" class="run-data">{packed(source, run)}</script>' for source, run in runs)
    page = (ASSETS / "page.html").read_text(encoding="utf-8")
    parts = {"title": html.escape(title), "style": asset("page.css"), "data": data, "script": asset("player.js")}
    for name, text in parts.items():
        page = page.replace(f"<!--{name}-->", text, 1)
    write_text(path, page)
    return path


def asset(name):
    return (ASSETS / name).read_text(encoding="utf-8")


def packed(source, run):
    """Text of a run for the page."""
    if not len(run.time):
        raise RunError(f"{source}: there are no frames in it")
    try:
        return pack(info(run), arrays(run))
    except ValueError as problem:
        raise RunError(f"{source}: {problem}") from None


# --- words ------------------------------------------------------------------------------------------------------------


def info(run):
    """What the page says and how it is to read the arrays."""
    return {
        "title": run.title,
        "result": sentence(run.summary) if run.summary else f"Not ended yet: the first {run.time[-1]:.1f} s",
        "elements": [{"name": name, "kind": kind} for name, kind in zip(run.elements.name, run.elements.kind)],
        "joints": len(run.joints.name),
        "kinds": kinds(run.elements.kind),
        "motion": run.motion and {"dt": run.motion.dt, "start": run.motion.start, "onset": onset(run.motion)},
        "drifts": [{"key": key, "storey": storey} for _, key, storey in drift_columns(run)],
        "levels": [{"value": value, "text": text.split()[0]} for value, text in DRIFT_LINES],
        "events": events(run),
        "collapse": (run.summary or {}).get("collapse_time_s"),
    }


def kinds(present):
    """{kind: {color, label}} of the kinds of elements that occur, from the roof down."""
    known = [kind for kind in reversed(palette.KINDS) if kind in present] + sorted(set(present) - set(palette.KINDS))
    return {kind: {"color": css(palette.KINDS.get(kind, palette.OTHER)), "label": kind} for kind in known}


def css(color):
    """RGB in 0..1 -> '#rrggbb'."""
    return "#" + "".join(f"{round(255 * part):02x}" for part in color)


def onset(motion):
    """When the shaking begins [s]; the motion's start when it is weaker than ONSET throughout."""
    return float(motion.time[np.argmax(np.abs(motion.acceleration).max(1) >= ONSET)])


def drift_columns(run):
    """[(column of the history, 'ns' | 'ew', storey)]; none before a run's end."""
    columns = run.history[0] if run.history else []
    found = [(k, name.removeprefix("drift_").split(" ")[0]) for k, name in enumerate(columns) if name.startswith("drift_")]
    return [(k, name[:2], int(name[2:])) for k, name in found]


def events(run):
    """[{time [s], text}] in the order of time: what is worth looking at."""
    found = [event for event in happenings(run) if 0 <= event[0] <= run.time[-1]]
    return [{"time": float(time), "text": text} for time, text in sorted(found)]


def happenings(run):
    """(time, text) of all that can happen, in no order."""
    if run.motion:
        yield onset(run.motion), "the shaking begins"
        if run.summary:
            yield moments.strongest_shaking(run), "strongest shaking"
    yield from passed_levels(run)
    summary = run.summary or {}
    if run.breaks is not None and len(run.breaks["time"]):
        yield run.breaks["time"][0], f"first spring breaks: {place_of(run.joints, run.breaks['joint'][0])}"
    if summary.get("tilt_time_s") is not None:
        yield summary["tilt_time_s"], f"the house leans {direction_name(summary['tilt_direction'])}: drift passes 1/10"
    if summary.get("collapse_time_s") is not None:
        yield summary["collapse_time_s"], "collapse: a floor is down by half a storey"


def passed_levels(run):
    """(time, text) when a drift first passes a line, but the last, the tilt."""
    columns = [k for k, _, _ in drift_columns(run)]
    if not columns:
        return
    rows = np.asarray(run.history[1], float)
    most = np.abs(rows[:, columns]).max(1)
    for value, text in DRIFT_LINES[:-1]:
        if (most > value).any():
            yield rows[np.argmax(most > value), 0], f"drift passes {text.replace(' ', ': ', 1)}"


def place_of(joints, number):
    """Where a joint is, in words."""
    storey = joints.storey[number]
    return f"{joints.kind[number].replace('_', '-')}, {'storey ' + storey if storey.isdigit() else storey}, {joints.side[number]}"


# --- numbers ----------------------------------------------------------------------------------------------------------


def arrays(run):
    """{name: (values, step)} for the page; rows are times, vertices, faces, joints or samples."""
    return {**shapes(run.elements), **joints(run.joints), **series(run), **curves(run)}


def shapes(elements):
    faces = [face for body in elements.faces for face in body]
    return {
        "vertices": (np.concatenate(elements.vertices), 1e-4),
        "vertex_start": (frames.starts(elements.vertices), 1),
        "faces": (np.concatenate(faces), 1),
        "face_start": (frames.starts(faces), 1),
        "element_start": (frames.starts(elements.faces), 1),
    }


def joints(found):
    return {
        "a": (found.a, 1),
        "anchor": (found.anchor, 1e-4),
        "springs": (found.springs, 1),
        "damaged": (found.damaged, 1),
    }


def series(run):
    turns = continuous(np.asarray(run.orientation, float))
    return {
        "time": (run.time, 1e-6),
        "positions": (run.position, POSITION_STEP),
        "orientations": (turns[..., [1, 2, 3, 0]], ORIENTATION_STEP),
        "loads": (np.minimum(run.load, 1.5), 0.01),
        "broken": (run.broken, 1),
    }


def continuous(turns):
    """(F, N, 4) unit quaternions with signs that do not jump from frame to frame."""
    jumps = np.sum(turns[1:] * turns[:-1], axis=2) < 0
    signs = np.concatenate([np.ones((1, turns.shape[1])), np.cumprod(np.where(jumps, -1, 1), axis=0)])
    return turns * signs[..., None]


def curves(run):
    columns = [k for k, _, _ in drift_columns(run)]
    rows = np.asarray(run.history[1], float) if columns else np.empty((0, 1))
    motion = {"acceleration": (run.motion.acceleration, 1e-3), "displacement": (run.motion.displacement, 1e-4)} if run.motion else {}
    return {"history_time": (rows[:, 0], 1e-6), "drifts": (np.clip(rows[:, columns], -10, 10), 1e-5), **motion}

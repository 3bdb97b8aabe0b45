# SPDX-License-Identifier: GPL-2.0-or-later
"""The player: one HTML file that plays a recorded run, or two runs side by side in step. Needs no YADE, the page no
network.

Numbers are stored in STEPS: a centroid is off by at most 0.44 mm, an orientation by at most 0.004 degrees. Between two
frames the page interpolates (linear, slerp).

Security: a run's data are base64 text; the page shows its texts as text nodes only. The content-security policy of the
page permits its own script and style, by their hashes, and nothing else.
"""
import base64
import hashlib

import numpy as np
from matplotlib.colors import to_hex
from yade_timber.log import flat_shapes

from ..base import colors
from ..base.atomic_write import write_text
from ..base.errors import RunError
from ..base.html import DATA, html
from ..recording.events import Event, LevelPassed, ShakingBegins, StrongestShaking
from ..recording.record import rotated
from ..recording.summary import Summary, collapse_time
from ..text import english, japanese
from ..text.english import cut_line
from .key_times import FIRST_DAMAGE, STRONGEST, first_shown, named, onset, strongest_shaking
from .packing import pack, time_step
from .panels import mark_anchors, plates
from .provenance import provenance

POLICY = "default-src 'none'; script-src '{script}'; style-src '{style}'; base-uri 'none'; form-action 'none'"
STEPS = {"vertices": 1e-4, "plate_vertices": 1e-4, "anchor": 1e-4, "positions": 0.5e-3, "orientations": 1 / 32767,
         "loads": 0.01, "drifts": 1e-5, "acceleration": 1e-3, "displacement": 1e-4}
"""Of arrays [m], of orientations, loads and drifts [-], of accelerations [m/s2]; others have whole numbers."""


def make(runs, path):
    """Write the page; returns its path. runs: one or two (file, Frames).

    Raises RunError when a run cannot be shown, OSError when the page cannot be written.
    """
    if not 1 <= len(runs) <= 2:
        raise RunError(f"{len(runs)} runs: the player shows one, or compares two")
    style, script = asset("page.css"), asset("player.js")
    page = html(
        "player/page.html",
        policy=POLICY.format(script=digest(script), style=digest(style)),
        title=" / ".join(plain(run.title) for _, run in runs),
        style=style,
        data=[packed(source, run) for source, run in runs],
        script=script,
    )
    write_text(path, page)
    return path


def asset(name):
    return (DATA / "player" / name).read_text(encoding="utf-8")


def digest(text):
    """Hash of an inline script or style for the content-security policy."""
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def plain(text):
    """A text from data on one line that UTF-8 can hold."""
    return cut_line(text).encode("utf-8", "replace").decode()


def packed(source, run):
    if not len(run.time):
        raise RunError(f"{source}: it has no frames")
    try:
        return pack(info(run), arrays(run))
    except ValueError as problem:
        raise RunError(f"{source}: {problem}") from None


# --- texts ------------------------------------------------------------------------------------------------------------


def info(run):
    """Texts of the page, and the description of its arrays."""
    e, j, lifted = run.elements, run.joints, uplifts(run)
    return {
        "title": plain(run.title),
        "result": (plain(english.sentence(run.summary)) if run.summary
                   else f"{'Not ended yet: the' if run.scenario else 'The'} first {run.time[-1]:.1f} s"),
        "japanese": ({"title": plain(japanese.title(run.summary)), "result": plain(japanese.result(run.summary)),
                      "origin": plain(provenance(run, japanese))} if run.summary else None),
        "origin": plain(provenance(run)),
        "elements": [{"name": plain(name), "kind": plain(kind), "group": plain(group), "storey": int(storey),
                      **({"uplift": lifted[k]} if k in lifted else {})}
                     for k, (name, kind, group, storey) in enumerate(zip(e.name, e.kind, e.group, e.storey))],
        "joints": len(j.name),
        "sheets": j.wall_sheets(),
        "sheet_colors": {state: to_hex(color) for state, color in colors.SHEETS.items() if len(run.sheets.type)},
        "plates": [{"body": plate.body, "sheet": plate.sheet, "torn": plate.torn} for plate in plates(run)],
        "joint_list": [
            {"kind": plain(kind), "place": plain(english.joint_place(kind, storey, side)), **largest}
            for kind, storey, side, largest in zip(j.kind, j.storey, j.side, forces(run))
        ],
        "feet": feet(run),
        "breaks": breaks(run),
        "kinds": kinds({plain(kind) for kind in e.kind}),
        "motion": run.motion and {"dt": run.motion.dt, "start": run.motion.start, "onset": onset(run.motion)},
        "first": first_shown(run),
        "drifts": [{"key": direction, "storey": storey} for storey, direction, _ in drifts(run)],
        "levels": [{"value": value, "text": text.split()[0]} for value, text in english.DRIFT_LINES],
        "events": events(run),
        "main": main_event(run),
        "collapse": collapse_time(run.summary),
        "until": run.summary.quantities.until_s if isinstance(run.summary, Summary) else None,
    }


def forces(run):
    """[{'pull', 'shear'}]: largest forces of each joint [N]; empty when broken at the start or not known."""
    if run.peaks is None:
        return [{}] * len(run.joints.name)
    return [{} if damaged else {"pull": round(float(pull), 1), "shear": round(float(shear), 1)}
            for damaged, pull, shear in zip(run.joints.damaged, run.peaks["pull"], run.peaks["shear"])]


def uplifts(run):
    """{element: largest uplift of its foot [m]} of the columns that stand; empty when it is not known."""
    table = run.columns or {"element": (), "uplift": (), "state": ()}
    return {int(element): round(float(uplift), 6)
            for element, uplift, state in zip(table["element"], table["uplift"], table["state"]) if state == "standing"}


def feet(run):
    """Numbers of the joints at the feet of columns: the first element is a column, with its centroid above."""
    e, j = run.elements, run.joints
    below = rotated(np.asarray(e.orientation)[j.a], j.anchor)[:, 2] < 0
    return [k for k, kind in enumerate(j.kind)
            if below[k] and kind.startswith("column_") and e.kind[j.a[k]] == "column"]


def breaks(run):
    """[{joint, time [s], cause, force [N], springs}] of each broken joint: the first break, and the number of all."""
    if run.breaks is None:
        return breaks_in_frames(run)
    firsts, table = {}, run.breaks
    for number, joint in enumerate(map(int, table["joint"])):
        if 0 <= joint < len(run.joints.name):
            first = {"joint": joint, "time": float(table["time"][number]), "cause": plain(table["cause"][number]),
                     "force": float(table["force"][number]), "springs": 0}
            firsts.setdefault(joint, first)["springs"] += 1
    return list(firsts.values())


def breaks_in_frames(run):
    """The same of a run without a table of breaks, to the frame and without cause and force."""
    broken = np.where(run.joints.damaged, 0, run.broken)
    return [{"joint": joint, "time": float(run.time[np.argmax(broken[:, joint] > 0)]), "cause": "broken", "force": 0.0,
             "springs": int(broken[-1, joint])} for joint in map(int, np.flatnonzero(broken.any(0)))]


def main_event(run):
    """Time around which the page plays slowly [s]: collapse, tilt, first fall, largest drift; else None."""
    return next((float(time) for time, reason in named(run) if reason not in (STRONGEST, FIRST_DAMAGE)), None)


def kinds(present):
    """[{kind, color}] of the kinds of elements that occur, from the roof downwards."""
    ordered = [kind for kind in reversed(colors.KINDS) if kind in present] + sorted(present - set(colors.KINDS))
    return [{"kind": kind, "color": to_hex(colors.of(kind))} for kind in ordered]


def events(run):
    """[{time [s], text, japanese}] of the events within the run, in the order of time."""
    recorded = run.summary.events if run.summary else []
    shown = [event for event in (*shaking(run), *passed_levels(run), *recorded) if 0 <= event.time_s <= run.time[-1]]
    shown.sort(key=lambda event: (event.time_s, event.kind, english.event(event)))
    return [{"time": float(event.time_s), "text": plain(english.event(event)), "japanese": plain(japanese.event(event))}
            for event in shown]


def shaking(run):
    if run.motion and run.motion.acceleration.any():
        yield Event(onset(run.motion), ShakingBegins())
        if run.summary and getattr(run.summary, "missed_shaking", None) is None:
            yield Event(strongest_shaking(run), StrongestShaking())


def passed_levels(run):
    """Events when a storey drift first passes a level; the last level, the tilt, is a recorded event."""
    if not drifts(run):
        return
    largest = run.history.largest_drift()
    for value, _ in english.DRIFT_LINES[:-1]:
        if (largest > value).any():
            yield Event(run.history.time[np.argmax(largest > value)], LevelPassed(value))


# --- numbers ----------------------------------------------------------------------------------------------------------


def arrays(run):
    """{name: (values, step)} for the page; a row is a time, vertex, face, joint or sample."""
    e, j, motion, shown, (body, anchor) = run.elements, run.joints, run.motion, plates(run), mark_anchors(run)
    sheathing = flat_shapes([plate.vertices for plate in shown], [plate.faces for plate in shown]) if shown else {}
    storey_drifts = [values for _, _, values in drifts(run)]
    values = {
        **flat_shapes(e.vertices, e.faces), **{f"plate_{name}": part for name, part in sheathing.items()},
        "a": j.a, "b": j.b, "body": body,
        "strength": np.where(np.isfinite(j.strength), np.minimum(j.strength, 1e9), 0), "anchor": anchor,
        "springs": j.springs, "damaged": j.damaged,
        "time": run.time, "positions": run.position,
        "orientations": continuous(np.asarray(run.orientation, float))[..., [1, 2, 3, 0]],
        "loads": np.minimum(run.load, 1.5), "broken": run.broken,
        "history_time": run.history.time if storey_drifts else np.empty(0),
        "drifts": np.clip(np.transpose(storey_drifts), -10, 10) if storey_drifts else np.empty((0, 0)),
        **({"acceleration": motion.acceleration, "displacement": motion.displacement} if motion else {}),
    }
    steps = STEPS | {name: time_step(values[name]) for name in ("time", "history_time")}
    return {name: (part, steps.get(name, 1)) for name, part in values.items()}


def continuous(orientation):
    """(F, N, 4) unit quaternions with signs that do not jump from frame to frame."""
    jumps = np.sum(orientation[1:] * orientation[:-1], axis=2) < 0
    signs = np.concatenate([np.ones((1, orientation.shape[1])), np.cumprod(np.where(jumps, -1, 1), axis=0)])
    return orientation * signs[..., None]


def drifts(run):
    """[(storey, direction, (F,) drift)] of a run with a history, else empty."""
    return run.history.drifts() if run.history and run.history.samples else []

# SPDX-License-Identifier: GPL-2.0-or-later
"""What a run leaves behind: summary.json, history.csv, breaks.csv. Made from the scene in YADE and the HouseModel.

The joint k of the scene's JointEngine is `model.joints[k]`, the body k is `model.elements[k]`. A joint is broken when all its springs are; with some broken it
is partly broken. Joints that are broken from the start (damage) are counted apart, never as broken.
"""
import csv
import io
import json
import math
from collections import Counter

import yade.wrapper as yw
from yade.minieigenHP import Vector3

from .. import _plugin
from .. import host
from ..scene import engines as scene
from ..scene import queries
from ..base.atomic_write import write_text
from ..motion import interpolation_error, onset
from ..scene.scenario import level_marks

SIDES = ("north", "south", "east", "west", "inside")
RESIDUAL_WINDOW = 1.0
"""The residual drift is the mean over this last part of the run, about a period of the standing houses. [s]"""
FALLEN = math.radians(45)
"""A column that is tilted by more has fallen. [rad]"""
LEANING = 1 / 10
"""A structure with a larger storey drift leans. [-]"""
DISSIPATED = ("dashpot_normal", "dashpot_shear", "friction", "broken_springs", "lost_contacts")
SUMMARY, HISTORY, BREAKS = "summary.json", "history.csv", "breaks.csv"

O = yw.Omega()


# --- joints -----------------------------------------------------------------------------------------------------------


def storey_of(joint, model):
    """Where a joint is: '1', '2', ... in the main structure, else the name of its structure ('entrance')."""
    return str(joint.storey) if joint.group == next(iter(model.storey_levels)) else joint.group


def sides_of(joint):
    """Walls a joint belongs to, in the order of SIDES (a corner column's joints belong to two), or ['inside']."""
    return [side for side in SIDES if side in joint.side] or ["inside"]


def by_kind(joints):
    """{'total', 'column_beam', 'brace_beam', other kinds that occur}: numbers of joints."""
    return {"total": len(joints), "column_beam": 0, "brace_beam": 0, **Counter(j.kind for j in joints)}


def count_joints(model):
    return by_kind(model.joints)


def broken_joints(model):
    """(broken during the run, partly broken, damaged at the start): lists of JointSpec."""
    pairs = list(zip(model.joints, scene.find_engine(yw.JointEngine).joints))
    damaged = [spec for spec, _ in pairs if spec.broken]
    whole = [spec for spec, joint in pairs if not spec.broken and joint.isFinished]
    partly = [spec for spec, joint in pairs if not spec.broken and any(joint.broken) and not joint.isFinished]
    return whole, partly, damaged


def count_broken(model):
    """The part `broken` of the summary. A joint of two walls counts for both in by_side."""
    whole, partly, damaged = broken_joints(model)
    storeys = dict.fromkeys((storey_of(j, model) for j in model.joints), 0)
    return {
        **by_kind(whole),
        "by_side": {side: sum(side in sides_of(j) for j in whole) for side in SIDES},
        "by_storey": {**storeys, **Counter(storey_of(j, model) for j in whole)},
        "by_place": {storey: {side: by_kind(at(whole, model, storey, side)) for side in SIDES} for storey in storeys},
        "partly_broken": len(partly),
        "springs": len(scene.find_engine(yw.JointEngine).breaks),
        "damaged_at_start": by_kind(damaged),
    }


def at(joints, model, storey, side):
    """Those of the joints that are in this storey on this side."""
    return [j for j in joints if storey_of(j, model) == storey and side in sides_of(j)]


# --- columns ----------------------------------------------------------------------------------------------------------


def count_columns(model):
    """The part `columns`: total; fallen: tilted by more than FALLEN; loose: not fallen, but no joint of theirs has a spring left."""
    held = {name for spec, joint in zip(model.joints, scene.find_engine(yw.JointEngine).joints) if not joint.isFinished for name in (spec.a, spec.b)}
    columns = [(element.name, tilt(O.bodies[k])) for k, element in enumerate(model.elements) if element.kind == "column" and O.bodies[k] is not None]
    return {
        "total": len(columns),
        "fallen": sum(angle > FALLEN for _, angle in columns),
        "loose": sum(angle <= FALLEN and name not in held for name, angle in columns),
    }


def tilt(body):
    """Angle between what was upright in a body at the start and the vertical. [rad]"""
    up = body.state.ori * (body.state.refOri.conjugate() * Vector3.UnitZ)
    return math.acos(min(1.0, max(-1.0, up[2])))


# --- drift and energy -------------------------------------------------------------------------------------------------


def finite(value):
    """A number for JSON: None instead of NaN and infinities."""
    return value if math.isfinite(value) else None


def rows(monitor):
    """Samples of a HouseMonitor: list of rows in the order of its columns()."""
    width = len(monitor.columns())
    values = monitor.rows
    return [values[k : k + width] for k in range(0, len(values), width)]


def by_storey(values):
    """{'storey1': {'ns', 'ew'}, ...} from [ns1, ew1, ns2, ew2, ...]; at least two storeys, None where there is no value."""
    pairs = [{"ns": finite(ns), "ew": finite(ew)} for ns, ew in zip(values[::2], values[1::2])]
    pairs += [{"ns": None, "ew": None}] * (2 - len(pairs))
    return {f"storey{k}": pair for k, pair in enumerate(pairs, 1)}


def residual_drift(monitor):
    """Absolute mean drift over the last RESIDUAL_WINDOW: [ns1, ew1, ns2, ew2, ...] [-]; empty without samples."""
    samples = rows(monitor)
    last = [row for row in samples if row[0] > samples[-1][0] - RESIDUAL_WINDOW]
    places = [k for k, name in enumerate(monitor.columns()) if name.startswith("drift")]
    return [abs(sum(row[k] for row in last) / len(last)) for k in places] if last else []


def leans_from(monitor):
    """When the lean began that became the tilt: the last sample before it at which that drift had another sign; None without a tilt. [s]"""
    if not math.isfinite(monitor.tiltTime):
        return None
    before = [row for row in rows(monitor) if row[0] <= monitor.tiltTime]
    names = monitor.columns()
    place = max((k for k, name in enumerate(names) if name.startswith(f"drift_{monitor.tiltDirection}")), key=lambda k: abs(before[-1][k]))
    return next((row[0] for row in reversed(before) if row[place] * before[-1][place] <= 0), 0.0)


def storey_moves(model, structure):
    """How far the levels of a structure have moved since the start, from below, with the heights of their storeys: [((3,) mean [m], [m])]."""
    bodies, moves = {body.shape.name: body for body in O.bodies}, {}
    for element, level in level_marks(model, structure):
        if element.name in bodies:
            moves.setdefault(level, []).append(bodies[element.name].state.displ())
    heights = {level: head - foot for level, (foot, head) in model.storey_levels[structure].items()}
    return [(sum(found, Vector3.Zero) / len(found), heights[level]) for level, found in sorted(moves.items())]


def fallen_structures(model):
    """Names of the structures of which a level lies lower than at the start by half its storey, as the scene is now."""
    return [name for name in model.storey_levels if any(-move[2] > height / 2 for move, height in storey_moves(model, name))]


def drift_now(model, structure):
    """Largest storey drift of a structure as the scene is now, resultant of N-S and E-W. [-]"""
    moves = [(Vector3.Zero, 1.0), *storey_moves(model, structure)]
    return max((math.hypot(above[0] - below[0], above[1] - below[1]) / height for (below, _), (above, height) in zip(moves, moves[1:])), default=0.0)


def leaning_structures(model):
    """Names of the structures that have not fallen and lean by more than LEANING, as the scene is now. Not of the first: its drifts are given."""
    fallen = fallen_structures(model)
    return [name for name in list(model.storey_levels)[1:] if name not in fallen and drift_now(model, name) > LEANING]


def energy_balance(terms):
    """The part `energy` of the summary [J] from the terms of `queries.energy`.

    input: work of the ground motion and potential energy released by gravity since the start. residual: what is stored,
    moving and dissipated minus the input; residual_fraction: its size by the input, None when there is no input.
    """
    into = terms.get("ground_motion", 0.0) - terms["gravity"]
    residual = queries.energy_residual(terms)
    return {
        "input": finite(into),
        "kinetic": finite(terms["kinetic"]),
        "elastic": finite(sum(value for name, value in terms.items() if name.startswith("elastic_"))),
        "dissipated": {name: finite(terms.get(name, 0.0)) for name in DISSIPATED},
        "residual": finite(residual),
        "residual_fraction": finite(abs(residual) / into) if into > 0 else None,
        "ground_motion": finite(terms.get("ground_motion", 0.0)),
        "gravity_released": finite(-terms["gravity"]),
    }


# --- summary ----------------------------------------------------------------------------------------------------------


def record_of(scenario):
    """The part `record`: the ground motion as applied, or None.

    interpolation_error: of straight lines between the samples, in parts of the PGA; 0 for samples at every step.
    """
    motion = scenario.motion
    if motion is None:
        return None
    pga = {axis: round(scenario.scale * value, 6) for axis, value in motion.pga_gal.items()}
    error = interpolation_error(motion) if motion.dt > scenario.dt else 0.0
    source = motion.source or motion.name
    return {"source": source, "pga_gal": pga, "scale": scenario.scale, "dt": motion.dt, "interpolation_error": round(error, 6), "onset_s": onset(motion)}


def versions():
    """Of YADE, and of the package as its module was built (CMakeLists.txt)."""
    build = json.loads(_plugin.build_record()[len(host.RECORD_MARK) :])
    return {"yade": host.host_facts()["yade"], "package": build["package"]}


def skipped():
    """Simulated time at rest that was not computed. [s]"""
    skipper = scene.find_engine(yw.RestSkipper)
    return skipper.skipped if skipper else 0.0


def summary(scenario, model, wall_s):
    """Content of summary.json for the scene as it is now. wall_s: time spent on the run so far [s]."""
    monitor = scene.find_engine(yw.HouseMonitor)
    simulated = round(O.iter * scenario.dt, 9)
    collapse = finite(monitor.collapseTime)
    return {
        "scenario": scenario.name,
        "model": model.name,
        "earthquake": scenario.motion is not None,
        "snow": scenario.snow_depth > 0,
        "snow_depth_m": scenario.snow_depth,
        "snow_mass_kg": model.counts()["mass_snow"],
        "record": record_of(scenario),
        "dt": scenario.dt,
        "duration_s": simulated,
        "steps": O.iter,
        "wall_s": round(wall_s, 3),
        "skipped_s": round(skipped(), 3),
        "real_time_factor": round(simulated / wall_s, 6) if wall_s > 0 else None,
        "threads": O.numThreads,
        "elements": len(O.bodies),
        "joints": count_joints(model),
        "broken": count_broken(model),
        "columns": count_columns(model),
        "leans_from_s": leans_from(monitor),
        "tilt_time_s": finite(monitor.tiltTime),
        "tilt_direction": monitor.tiltDirection or None,
        "collapsed": collapse is not None,
        "collapse_time_s": collapse,
        "fallen_structures": fallen_structures(model),
        "leaning_structures": leaning_structures(model),
        "peak_drift": by_storey(monitor.peak),
        "residual_drift": by_storey(residual_drift(monitor)),
        "energy": energy_balance(queries.energy()),
        "versions": versions(),
    }


# --- files ------------------------------------------------------------------------------------------------------------


def table(header, lines):
    """Text of a CSV file; numbers with 12 digits, zero without a sign."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    for line in lines:
        writer.writerow(f"{value + 0.0:.12g}" if isinstance(value, float) else value for value in line)
    return text.getvalue()


def history():
    """Text of history.csv: the monitor's samples."""
    monitor = scene.find_engine(yw.HouseMonitor)
    return table(monitor.columns(), rows(monitor))


def breaks(model):
    """Text of breaks.csv: every spring that broke, in order."""
    header = ("time [s]", "joint", "kind", "storey", "side", "spring", "cause", "force [N]")
    return table(header, (break_row(b, model) for b in scene.find_engine(yw.JointEngine).breaks))


def break_row(entry, model):
    """Values of a JointBreak in the order of breaks.csv."""
    joint = model.joints[entry.joint]
    return entry.time, joint.name, joint.kind, storey_of(joint, model), "+".join(sides_of(joint)), entry.spring, entry.cause, entry.force


def write(folder, found, model):
    """Write the three files, the summary last: where it is, the others are whole. Returns their paths. Raises OSError."""
    contents = {HISTORY: history(), BREAKS: breaks(model), SUMMARY: json.dumps(found, indent=1, allow_nan=False) + "\n"}
    for name, text in contents.items():
        write_text(folder / name, text)
    return [folder / name for name in contents]

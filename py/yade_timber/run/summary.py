# SPDX-License-Identifier: GPL-2.0-or-later
"""Results of the run that is loaded in YADE: summary.json, history.csv, breaks.csv, and the tables of quantities.py."""
import json
import math

import yade.wrapper as yw

from .. import _plugin
from ..base.atomic_write import write_text
from ..base.table import csv_text
from ..house import comparison, diagnose, weigh
from ..motion import constant_note, interpolation_error, onset
from ..recording import drift
from ..recording.history import NAME as HISTORY
from ..recording.history import History
from ..recording.sentences import largest_drift, sentence
from ..recording.verdict import judge, leans
from ..scene import queries
from ..scene.engines import find_engine
from . import observer, quantities
from .versions import versions

DISSIPATED = ("dashpot_normal", "dashpot_shear", "friction", "broken_springs", "lost_contacts", "joint_dashpot", "joint_yield")
"""Terms of the energy balance that are dissipated."""
SUMMARY, BREAKS = "summary.json", "breaks.csv"
NAMES = (SUMMARY, HISTORY, BREAKS, *quantities.NAMES)
"""Files that `write` makes."""

O = yw.Omega()


def summary(scenario, observed, tables, wall_s, other_walls=None):
    """Content of summary.json for the scene as it is now. observed: Observer of the run; tables: quantities.Tables of the run;
    wall_s: wall time of its steps so far [s]; other_walls: verdict with the walls of the other level.

    residual_drift, final_amplitude, still_moving: see recording/drift.py; events: recording/events.py; broken, columns: recording/damage.py.
    """
    model, survey, state = observed.model, observed.survey, observed.state()
    monitor, skipper = find_engine(yw.HouseMonitor), find_engine(yw.RestSkipper)
    history = History(monitor.columns(), monitor.rows)
    tilt, collapse = _finite(monitor.tiltTime), _finite(monitor.collapseTime)
    residual, amplitude = drift.residual(history)
    simulated = round(O.iter * scenario.dt, 9)
    found = {
        "scenario": scenario.name,
        "model": model.name,
        "earthquake": scenario.motion is not None,
        "snow": scenario.snow_depth > 0,
        "snow_depth_m": scenario.snow_depth,
        "snow_mass_kg": model.counts()["mass_snow"],
        "weight": weigh(model),
        "diagnosis": diagnose(model),
        "joint_damping": scenario.joint_damping,
        "walls": {"level": model.law["wall_level"], "other": other_walls} if model.law["wall_level"] else None,
        "record": record(scenario),
        "dt": scenario.dt,
        "duration_s": simulated,
        "until_collapse": scenario.until_collapse,
        "steps": O.iter,
        "wall_s": round(wall_s, 3),
        "skipped_s": round(skipper.skipped if skipper else 0.0, 3),
        "real_time_factor": round(simulated / wall_s, 6) if wall_s > 0 else None,
        "threads": _plugin.thread_count(),
        "elements": len(O.bodies),
        "joints": survey.count_all(),
        "broken": survey.count_broken(state, len(find_engine(yw.JointEngine).breaks)),
        "columns": survey.count_columns(state),
        "leans_from_s": drift.lean_start(history, tilt, monitor.tiltDirection),
        "tilt_time_s": tilt,
        "tilt_direction": monitor.tiltDirection or None,
        "collapsed": collapse is not None,
        "collapse_time_s": collapse,
        "fallen_structures": survey.fallen_structures(state),
        "leaning_structures": survey.leaning_structures(state),
        "peak_drift": drift.by_storey(monitor.peak),
        "residual_drift": drift.by_storey(residual),
        "final_amplitude": drift.by_storey(amplitude),
        "still_moving": drift.still_moving(amplitude),
        "events": observed.log.records(),
        "energy": energy_balance(queries.energy()),
        "versions": versions(),
    }
    found["diagnosis"]["disagreement"] = comparison(found["diagnosis"], found["collapsed"])
    found["structures"] = structures(found, observed, state)
    found["quantities"] = quantities.summarised(tables, observed)
    return {**found, "verdict": found["structures"][survey.structures[0]]["verdict"], "sentence": sentence(found)}


def structures(found, observed, state):
    """The part `structures`: facts and verdict of each structure. Drifts of the main one are those of `peak_drift` and `residual_drift`."""
    damage, main = observed.survey.by_structure(state), observed.survey.structures[0]
    facts = {name: {"peak_drift": observed.peaks[name], "residual_drift": observed.survey.drift(state, name), **known} for name, known in damage.items()}
    facts[main] |= {
        "peak_drift": largest_drift(found)[0],
        "residual_drift": largest_drift(found, "residual_drift")[0],
        "collapsed": found["collapsed"],
    }
    return {name: {"verdict": judge(known), "leans": leans(known), **known} for name, known in facts.items()}


def record(scenario):
    """The part `record`: the ground motion as applied, or None.

    interpolation_error: of straight lines between the samples, as a share of the PGA; 0 with samples at every step.
    """
    motion = scenario.motion
    if motion is None:
        return None
    pga = {axis: round(scenario.scale * value, 6) for axis, value in motion.pga_gal.items()}
    error = interpolation_error(motion) if motion.dt > scenario.dt else 0.0
    begin = onset(motion)  # None: no shaking
    return {
        "source": motion.source or motion.name,
        "pga_gal": pga,
        "scale": scenario.scale,
        "dt": motion.dt,
        "interpolation_error": round(error, 6),
        "onset_s": None if begin is None else begin + scenario.delay,
        "note": constant_note(motion, scenario.scale) or None,
        "sequence": [part_of_record(part, scenario.scale) for part in motion.parts] or None,
    }


def part_of_record(part, scale):
    """An entry of `record.sequence`. part: motion.sequence.Part; scale: of the whole sequence [-]."""
    pga = {axis: round(scale * value, 6) for axis, value in part.pga_gal.items()}
    return {"source": part.source, "start_s": round(part.start, 6), "duration_s": round(part.duration, 6), "scale": scale * part.scale, "pga_gal": pga}


def energy_balance(terms):
    """The part `energy` [J] from the terms of `queries.energy`.

    input: work of the ground motion and potential energy released by gravity since the start. residual: stored, kinetic and dissipated energy minus
    the input; residual_fraction: its absolute value over the input, None without input.
    """
    ground = terms.get("ground_motion", 0.0)
    supplied, residual = ground - terms["gravity"], queries.energy_residual(terms)
    return {
        "input": _finite(supplied),
        "kinetic": _finite(terms["kinetic"]),
        "elastic": _finite(sum(value for name, value in terms.items() if name.startswith("elastic_"))),
        "dissipated": {name: _finite(terms.get(name, 0.0)) for name in DISSIPATED},
        "residual": _finite(residual),
        "residual_fraction": _finite(abs(residual) / supplied) if supplied > 0 else None,
        "ground_motion": _finite(ground),
        "gravity_released": _finite(-terms["gravity"]),
    }


def _finite(value):
    """A number for JSON: None instead of NaN and infinities."""
    return value if math.isfinite(value) else None


# --- files ------------------------------------------------------------------------------------------------------------


def breaks_text(model):
    """Text of breaks.csv: every spring that broke, in order."""
    header = ("time [s]", "joint", "kind", "storey", "side", "spring", "cause", "force [N]")
    return csv_text(header, (observer.break_row(entry, model) for entry in find_engine(yw.JointEngine).breaks))


def write(folder, found, tables, model):
    """Write all files, the summary last: where it is, the others are complete. Returns their paths. Raises OSError.

    found, tables: `summary` and quantities.Tables of the run
    """
    monitor, paths = find_engine(yw.HouseMonitor), tables.write(folder)
    contents = {
        HISTORY: History(monitor.columns(), monitor.rows).text(),
        BREAKS: breaks_text(model),
        SUMMARY: json.dumps(found, indent=1, allow_nan=False) + "\n",
    }
    for name, text in contents.items():
        write_text(folder / name, text)
    return [*paths, *(folder / name for name in contents)]

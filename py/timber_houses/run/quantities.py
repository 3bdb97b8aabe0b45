# SPDX-License-Identifier: GPL-2.0-or-later
"""Quantities of the run that is loaded in YADE: storey shears, accelerations, peaks of joints and column feet.

Element k of the HouseModel is body k of the scene, joint k is joint k of the JointEngine and of the Sampler."""
from collections import namedtuple
from dataclasses import dataclass
from operator import attrgetter

import numpy as np
import yade.wrapper as yw
from yade_timber.scene.engines import find_engine, gravity_now

from ..base.atomic_write import write_text
from ..base.table import csv_text
from ..recording import quantities
from ..recording.history import DIRECTIONS
from ..recording.summary_parts import (LargestForce, LargestUplift, LargestUtilisation, Modes, Quantities, Shear,
                                       StoreyQuantities)
from . import observer

JOINTS, COLUMNS = "joints.csv", "columns.csv"
NAMES = (quantities.NAME, JOINTS, COLUMNS)  # files that `Tables.write` makes
AXES = quantities.AXES
O = yw.Omega()


def part_masses(observed):
    """(P,) masses of the main structure's parts, the Sampler's groups after the levels. [kg]"""
    sampler, first = find_engine(yw.Sampler), len(observed.survey.levels)
    masses = np.zeros(max(sampler.groups) + 1)
    for body, group in zip(sampler.bodies, sampler.groups):
        masses[group] += O.bodies[body].state.mass if O.bodies[body] is not None else 0.0
    return masses[first:]


def storeys(observed, samples):
    momenta = samples.momenta(slice(len(observed.survey.levels), None))
    return quantities.storeys(momenta, part_masses(observed), observed.motion)


def storey_peaks(table, masses):
    """Arguments of Quantities: masses, base shear, accelerations, storeys. table: Storeys of the run, up to a fall;
    masses: of the parts [kg]"""
    gravity = gravity_now().norm()
    peaks = {}
    for k in range(1, table.count + 1):
        above = float(masses[2 * k:].sum())
        shear = _shears(table, f"shear_{{}}{k}")
        peaks[f"storey{k}"] = StoreyQuantities(
            mass_above_kg=round(above, 3),
            shear=shear,
            shear_coefficient={axis: round(value / (above * gravity), 4) if above * gravity else None
                               for axis, value in shear.sustained.items()},
            acceleration={axis: round(table.peak(f"acceleration_{axis}{k}"), 4) for axis in AXES},
        )
    return {"mass_kg": round(float(masses.sum()), 3), "base_shear": _shears(table, "base_shear_{}"),
            "acceleration_band_hz": list(quantities.BAND),
            "ground_acceleration": {axis: round(table.peak(f"ground_acceleration_{axis}"), 4) for axis in AXES},
            "storeys": peaks}


def _shears(table, name):
    """Shear: the largest in both directions [N], as means over 0.1 s and over a sample interval of 0.01 s."""
    sustained, peak = ({axis: round(largest(name.format(axis)), 3) for axis in DIRECTIONS}
                       for largest in (table.sustained, table.peak))
    return Shear(sustained=sustained, peak=peak)


JointRow = namedtuple("JointRow", ("name", "kind", "storey", "side", "load", "pull", "shear", "opening",
                                   "strength", "per", "broken", "state"))
JOINT_HEADER = (*("joint", "kind", "storey", "side", "utilisation [-]", "pull [N]", "shear [N]", "opening [m]"),
                *("strength [N]", "strength of", "broken springs [-]", "state"))
ColumnRow = namedtuple("ColumnRow", ("name", "structure", "storey", "east", "north", "uplift", "pull", "load", "state"))
COLUMN_HEADER = ("column", "structure", "storey", "east [m]", "north [m]", "uplift [m]", "pull [N]", "utilisation [-]",
                 "state")
"""Columns of joints.csv and columns.csv, as the entries of their rows."""


def joint_rows(observed, peaks):
    """Rows of joints.csv, the largest utilisation first. observed: Observer of the run; peaks: of Tables"""
    model, broken = observed.model, observed.state().broken
    rows = []
    for joint, (load, pull, shear, opening), springs, state in zip(model.joints, peaks, broken,
                                                                   observed.survey.joints.states(broken)):
        place = observer.storey_of(joint, model), "+".join(observer.sides_of(joint))
        rows.append(JointRow(joint.name, joint.kind, *place, load, pull, shear, opening, float(joint.strength),
                             joint.per, int(springs), state))
    return sorted(rows, key=lambda row: -row.load)


def column_feet(observed):
    """Rows of columns.csv, the largest uplift first. observed: Observer of the run"""
    model, state = observed.model, observed.state()
    feet = {}
    for joint, (load, pull, _, opening) in zip(model.joints, observed.joint_peaks()):
        if joint.end == "bottom" and model.element(joint.a).kind == "column":
            feet[joint.a] = np.maximum(feet.get(joint.a, 0.0), (opening, pull, load))
    survey = observed.survey
    rows = []
    for element, fallen, loose in zip(model.of_kind("column"), survey.fallen_columns(state),
                                      survey.loose_columns(state)):
        uplift, pull, load = map(float, feet.get(element.name, (0.0, 0.0, 0.0)))
        x, y, _ = map(float, element.solid.centroid)
        rows.append(ColumnRow(element.name, element.group, element.storey, x, y, uplift, pull, load,
                              "fallen" if fallen else "loose" if loose else "standing"))
    return sorted(rows, key=lambda row: -row.uplift)


@dataclass(frozen=True)
class Tables:
    """Content of the files. peaks: (load [-], pull [N], shear [N], opening [m]) of the joints in their order; joints:
    JointRows; columns: ColumnRows"""

    storeys: quantities.Storeys
    peaks: list
    joints: list
    columns: list

    def recorded(self, number):
        """Arguments of frames.Frames. number: {name of an element: its number}"""
        peaks = np.array(self.peaks, float).reshape(-1, 4).T
        columns = {"element": np.array([number[row.name] for row in self.columns], "i4"),
                   "uplift": np.array([row.uplift for row in self.columns], float),
                   "state": [row.state for row in self.columns]}
        return {"storeys": self.storeys, "peaks": dict(zip(("load", "pull", "shear", "opening"), peaks)),
                "columns": columns}

    def write(self, folder):
        """Write storeys.csv, joints.csv, columns.csv; returns their paths. Raises OSError."""
        self.storeys.write(folder / quantities.NAME)
        write_text(folder / JOINTS, csv_text(JOINT_HEADER, self.joints))
        write_text(folder / COLUMNS, csv_text(COLUMN_HEADER, self.columns))
        return [folder / name for name in NAMES]


def tables(observed, samples):
    """Tables of the run as it is now. observed: Observer of the run; samples: of the whole run"""
    peaks = observed.joint_peaks() or [(0.0,) * 4] * len(observed.model.joints)
    return Tables(storeys(observed, samples), peaks, joint_rows(observed, peaks), column_feet(observed))


def summarised(tables, observed):
    """Quantities of the summary. tables: Tables of the run; observed: Observer of the run"""
    standing = [row for row in tables.columns if row.state == "standing"]
    breakable = [row for row in tables.joints if np.isfinite(row.strength)]
    fall = observed.fall()
    collapsed = fall is not None
    return Quantities(
        until_s=fall,
        modes=Modes(before=observed.modes,
                    after=None if collapsed or observed.modes is None else observer.modes_now(observed.main_levels)),
        **storey_peaks(tables.storeys.until(fall) if collapsed else tables.storeys, part_masses(observed)),
        largest_utilisation=_largest(LargestUtilisation, tables.joints, "load", "joint", "value", 4),
        largest_pull=_largest(LargestForce, breakable, "pull", "joint", "force"),
        largest_shear=_largest(LargestForce, breakable, "shear", "joint", "force"),
        largest_uplift=None if collapsed else _largest(LargestUplift, standing, "uplift", "column", "uplift_m"),
    )


def _largest(kind, rows, quantity, noun, value, digits=6):
    """kind(noun: name, value: number) of the row with the largest quantity, None without rows."""
    row = max(rows, key=attrgetter(quantity), default=None)
    return row and kind(**{noun: row.name, value: round(float(getattr(row, quantity)), digits)})

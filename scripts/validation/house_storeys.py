# SPDX-License-Identifier: GPL-2.0-or-later
"""Storeys of the lumped-mass model (shear_model.py) from a house of the package. Needs no YADE."""
import numpy as np
from shear_model import SlipSpring, Storey, slip_spring
from wall_spring import WallSpring

from timber_houses.base.gravity import mass_of
from timber_houses.base.joint_kinds import WALL_BEAM
from timber_houses.house.model import WallCycles
from timber_houses.house.walls import SHARE
from timber_houses.house.weight import weigh

AXES = {"ew": 0, "ns": 1}
ROUNDING = 0.1
"""Radius of a column's edges over its width: it turns about an edge that lies inside by this. [-]"""


def shear_storeys(model, data, structure, direction):
    """Storeys of a structure in a direction, from below. data: content of the house file."""
    weights = weigh(model)["storeys"][structure]
    storeys = []
    for storey, (low, high) in model.storey_levels[structure].items():
        height, weight = high - low, weights[str(storey)]
        columns = [e for e in model.of_kind("column", group=structure) if e.storey == storey]
        width = columns[0].section[0]
        springs = [*wall_springs(model, storey, direction, height), column_ends(data, len(columns), width, height)]
        edges = (1 - 2 * ROUNDING) * width
        storeys.append(Storey(mass_of(weight["level_kn"]), height, 1000 * weight["carried_kn"], edges, springs))
    return storeys


def wall_joints(model, storey, direction):
    """wall_beam JointSpecs of a storey and direction, "ew" or "ns"."""
    axis = AXES[direction]
    return [j for j in model.joints if j.kind == WALL_BEAM and j.storey == storey and abs(j.normal[axis]) > 0.5]


def wall_springs(model, storey, direction, height):
    """A WallSpring, or a SlipSpring, for each form of envelope in a storey: both halves of walls, whose stretch is the
    drift times the height.
    """
    sums = {}
    for j in wall_joints(model, storey, direction):
        stretches, forces = np.transpose(j.envelope)
        cycles = j.cycles if j.law == "wall" else WallCycles(0.0)
        lines = ((cycles.reload_share, cycles.reload_target, cycles.reload_stretch / height, cycles.reload_power)
                 if j.law == "wall" else j.friction_share)
        values = np.array([j.kn * height, cycles.friction_force, cycles.pinched_stiffness * height,
                           cycles.reload_stiffness * height, *forces]) / SHARE
        form = j.law, lines, tuple(np.round(values[1:4] / max(values[4:]), 9)), tuple(np.round(stretches / height, 9))
        sums[form] = sums.get(form, 0.0) + values
    return [_spring(law, lines, drifts, *values) for (law, lines, _, drifts), values in sums.items()]


def _spring(law, lines, drifts, stiffness, friction, pinched, reload_stiffness, *forces):
    points = list(zip(drifts, forces))
    if law != "wall":
        return SlipSpring(stiffness, lines, points)
    share, target, *reload = lines
    return WallSpring(stiffness, points, friction, share, target, pinched,
                      (reload_stiffness, *reload) if reload_stiffness else None)


def column_ends(data, columns, width, height):
    """SlipSpring of all column ends of a storey; columns of this width [m]."""
    rule = data["joints"]["column_ends"]
    fitting = data["joint_types"][rule["type"]]
    at_axis = fitting.get("at") == "centre"  # all of it stretches at either end, not half
    lever = ((0.5 if at_axis else 1) - ROUNDING) * width
    many = columns * rule["number"] * (2 if at_axis else 1) * lever / height
    return slip_spring(stiffness=many * fitting["kn"] * lever, strength=many * fitting["strength"],
                       friction_share=fitting["friction_share"], softening=fitting["softening_stretch"] / lever,
                       ultimate=fitting["ultimate_stretch"] / lever)

# SPDX-License-Identifier: GPL-2.0-or-later
"""Recorded frames of an invented run of three seconds: two boxes and the ground, three joints; the upper box slides to
the east and tips.
"""
import numpy as np
from summaries import sample_summary
from timber_houses.recording.record import Contacts, Elements, Frames, Joints, Motion
from timber_houses.recording.history import History

FACES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
CUBE = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
COUNT = 61
SUMMARY = sample_summary(
    model="T", tilt_time_s=1.5, tilt_direction="ew", collapsed=True, collapse_time_s=2.0, joints={"total": 3},
    broken={"total": 1, "damaged_at_start": {"total": 1}}, peak_drift={"storey1": {"ns": 0.0, "ew": 0.5}})


def rotation_about_y(angle):
    """Quaternion w, x, y, z."""
    return np.array([np.cos(angle / 2), 0, np.sin(angle / 2), 0])


def elements():
    names = ["ground", "lower", "upper"]
    position = np.array([[0, 0, -0.5], [0, 0, 0.5], [0, 0, 1.5]])
    return Elements(names, ["ground", "column", "snow"], ["", "main", "main"], ["timber", "timber", "snow"],
                    np.array([0, 1, 2]), np.array([True, False, False]), position, np.tile([1.0, 0, 0, 0], (3, 1)),
                    [CUBE * (9, 9, 1), CUBE, CUBE[:, [0, 1, 2]]], [FACES] * 3)


def joints():
    return Joints(["a", "b", "c"], ["column_beam", "column_beam", "brace_beam"], ["1", "1", "entrance"],
                  ["east", "inside", "west+north"], np.array([0, 1, 1]), np.array([1, 2, 2]),
                  np.array([[0, 0, 0.5], [0.5, 0, 0.5], [-0.5, 0, 0.5]]), np.array([4, 4, 4]),
                  np.array([True, False, False]), np.array([5880.0, 5880.0, np.inf]))


def frames(ended=True, shaken=True):
    """Frames of the run; ended: with summary, history and breaks."""
    e, time = elements(), np.arange(COUNT) * 0.05
    slide = np.clip(time - 1, 0, 1)
    position = np.tile(e.position, (COUNT, 1, 1)).astype("f4")
    orientation = np.tile(e.orientation, (COUNT, 1, 1)).astype("f4")
    position[:, 2, 0] = slide
    orientation[:, 2] = [rotation_about_y(0.3 * s) for s in slide]
    broken = np.zeros((COUNT, 3), "u1")
    broken[:, 0], broken[time >= 1.2, 1], broken[time >= 1.6, 1], broken[time >= 1.6, 2] = 4, 2, 4, 1
    load = np.where(broken < 4, 0.1 * np.arange(3), 0).astype("f4")
    contacts = Contacts([0.0, 3.0], [np.empty((0, 2), "i4"), np.array([[0, 1], [1, 2]], "i4")],
                        [np.empty((0, 3), "f4"), np.array([[0, 0, 0], [0, 0, 1]], "f4")],
                        [np.empty((0, 3), "f4"), np.array([[0, 0, 20], [0, 0, 10]], "f4")])
    made = Frames("House T: earthquake", "modelT_quake", "T", "0", e, joints(), time, position, orientation, load,
                  broken, contacts)
    if shaken:
        acceleration = np.zeros((300, 3))
        acceleration[120, 1] = 5.0
        made.motion = Motion(0.01, 0.0, acceleration, np.zeros((300, 3)))
    if ended:
        made.summary, made.history = SUMMARY, history(time, slide)
        made.breaks = {"time": [1.2, 1.2, 1.6, 1.6, 1.6], "joint": [1, 1, 1, 1, 2], "spring": [0, 1, 2, 3, 0],
                       "cause": ["tension"] * 5, "force": [5881.0] * 5}
    return made


def history(time, slide):
    """History with every column of the page of curves."""
    energies = ("kinetic", "gravity", "elastic_contacts", "elastic_joints", "ground_motion", "dashpot_normal",
                "dashpot_shear", "friction", "broken_springs", "lost_contacts", "joint_yield")
    columns = ["time [s]", "drift_ns1 [-]", "drift_ew1 [-]", "drop1 [m]", "broken_joints [-]", "broken_springs [-]",
               *(f"{name} [J]" for name in energies)]
    rows = np.zeros((len(time), len(columns)))
    rows[:, 0], rows[:, 2] = time, slide / 2
    rows[:, columns.index("ground_motion [J]")] = rows[:, columns.index("friction [J]")] = 100 * slide
    return History(columns, rows)

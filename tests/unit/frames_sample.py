# SPDX-License-Identifier: GPL-2.0-or-later
"""A small run as recorded, made of formulas: four columns with a roof that sway, then fall to the north."""
import numpy as np
from summaries import sample_summary
from timber_houses.recording import frames
from timber_houses.recording.events import Collapse, Event, FirstBreak, Tilt
from timber_houses.recording.history import History
from timber_houses.recording.quantities import Storeys

FACES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
FALL = 2.0
"""When the fall begins; it takes a second. [s]"""
DURATION = 4.0
ORIGIN = (5.0, -3.0, 0.0)
"""Where the middle of the house is. [m]"""
PARTS = {  # name: (kind, extents, centre from ORIGIN) [m]
    "ground": ("ground", (40, 40, 1), (0, 0, -0.5)),
    "base": ("foundation", (4.2, 6.2, 0.3), (0, 0, 0.15)),
    "column.SW": ("column", (0.12, 0.12, 2.7), (-1.9, -2.9, 1.65)),
    "column.SE": ("column", (0.12, 0.12, 2.7), (1.9, -2.9, 1.65)),
    "column.NW": ("column", (0.12, 0.12, 2.7), (-1.9, 2.9, 1.65)),
    "column.NE": ("column", (0.12, 0.12, 2.7), (1.9, 2.9, 1.65)),
    "roof": ("roof", (4.2, 6.2, 0.2), (0, 0, 3.1)),
}


def box(extents):
    return np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * extents


def elements():
    kinds, extents, centres = zip(*PARTS.values())
    count = len(PARTS)
    fixed = np.array([kind in ("ground", "foundation") for kind in kinds])
    return frames.Elements(list(PARTS), list(kinds), ["main"] * count, ["timber"] * count, np.ones(count, int), fixed,
                           np.array(centres) + ORIGIN, np.tile([1.0, 0, 0, 0], (count, 1)), [box(e) for e in extents],
                           [FACES] * count)


def joints():
    """One at each end of each column; that of the south-west column's foot is damaged from the start."""
    columns = [2, 3, 4, 5] * 2
    ends = [-1.35] * 4 + [1.35] * 4
    count = len(columns)
    damaged = np.arange(count) == 0
    return frames.Joints([f"joint{k}" for k in range(count)], ["column_beam"] * count, ["1"] * count, ["south"] * count,
                         np.array(columns), np.array([1] * 4 + [6] * 4), np.array([[0, 0, z] for z in ends]),
                         np.full(count, 4), damaged, np.full(count, 5880.0))


def placements(time, start):
    """(N, 3) positions and (N, 4) orientations of the elements at a time."""
    lean = 0.02 * np.sin(2 * np.pi * time) + 1.3 * np.clip(time - FALL, 0, 1) ** 2  # of the columns to the north [rad]
    position, orientation = start.position.copy(), start.orientation.copy()
    top = 2.7 * np.array([0, np.sin(lean), np.cos(lean) - 1])
    for k, kind in enumerate(start.kind):
        if kind == "column":
            position[k] += top / 2
            orientation[k] = np.cos(lean / 2), -np.sin(lean / 2), 0, 0
        elif kind == "roof":
            position[k] += top
    return position, orientation


def history():
    """History of one storey."""
    time = np.arange(0, DURATION + 0.005, 0.01)
    drift = 0.02 * np.sin(2 * np.pi * time) + 1.3 * np.clip(time - FALL, 0, 1) ** 2
    return History(["time [s]", "drift_ns1 [-]", "drift_ew1 [-]", "broken_joints [-]"],
                   np.column_stack([time, drift, 0.3 * drift, 0 * time]))


def motion():
    """One second at rest, then a sine E-W of 1 Hz and 20 cm."""
    time = np.arange(0, DURATION + 0.005, 0.01)
    east = 0.2 * np.sin(2 * np.pi * time) * (time > 1)
    return frames.Motion(0.01, 0.0, np.column_stack([-4 * np.pi**2 * east, 0 * east, 0 * east]),
                         np.column_stack([east, 0 * east, 0 * east]))


def summary(name):
    events = [
        Event(2.1, FirstBreak("column_beam", "1", "south", "tension", 5900.0)),
        Event(2.3, Tilt("ns")),
        Event(2.9, Collapse())
    ]
    return sample_summary(model=name, earthquake=True, events=events, broken={
        "total": 7, "damaged_at_start": {"total": 1}
    }, joints={"total": 8}, tilt_time_s=2.3, tilt_direction="ns", collapsed=True, collapse_time_s=2.9,
                          peak_drift={"storey1": {"ns": 1.3, "ew": 0.39}})


def run(name="A", until=DURATION):
    """Frames of a run whose joints break at the top one after the other."""
    start, times = elements(), np.arange(0, until + 0.025, 0.05)
    position, orientation = zip(*(placements(t, start) for t in times))
    broken = np.array([[4 if k == 0 else int(np.clip(20 * (t - FALL) - k, 0, 4)) for k in range(8)] for t in times])
    breaks = {"time": [FALL + 0.1], "joint": [1], "spring": [0], "cause": ["tension"], "force": [5900.0]}
    return frames.Frames(f"House {name}: earthquake", f"model{name}_quake", name, "0", start, joints(), times,
                         np.array(position), np.array(orientation), np.clip(times / 3, 0, 1)[:, None] * np.ones(8),
                         broken, motion=motion(), summary=summary(name), history=history(), breaks=breaks)


def write(path, **options):
    """Save a run as frames.h5 file; returns the run."""
    made = run(**options)
    frames.save(path, made)
    return made


def with_tables(made):
    """Give a run peaks and columns: joint k is pulled by 1.25 k kN; the south-west column falls."""
    made.peaks = {"load": np.arange(8) / 8, "pull": 1250.0 * np.arange(8), "shear": 800 - 100.0 * np.arange(8),
                  "opening": np.zeros(8)}
    names = [f"column.{side}" for side in ("SW", "NE", "SE", "NW")]
    made.columns = {"element": np.array([made.elements.name.index(name) for name in names]),
                    "uplift": np.array([2.5, 0.0314, 0.0029, 0.0]), "state": ["fallen", *["standing"] * 3]}
    made.storeys = Storeys(["time [s]"], np.empty((0, 1)))
    return made


def walled_run():
    """The same with three wall sheets instead of the first six joints: two in the south, with a window and on it, one
    with a door in the east. Joint k loses all its springs at FALL + 0.1 k [s].
    """
    made = run()
    joints, order = made.joints, np.arange(8)
    joints.kind[:6] = ["wall_beam", "wall_column"] * 3
    joints.sheet[:6] = [0, 0, 1, 1, 2, 2]
    made.sheets = frames.Sheets(["plywood", "gypsum", "plywood"], ["window", "none", "door"], np.array([2, 2, 3]),
                                np.array([3, 3, 5]))
    joints.springs, joints.damaged = np.where(order < 6, 1, 4), np.zeros(8, bool)
    made.broken = np.where(made.time[:, None] > FALL + 0.1 * order, joints.springs, 0)
    counts = {"total": 2, "wall_sheets": 3, "wall_sheets_partly": 0, "damaged_at_start": {"total": 0}}
    made.summary = made.summary.changed(joints={"total": 2, "wall_sheets": 3}, broken=counts)
    return made

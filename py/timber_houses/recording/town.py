# SPDX-License-Identifier: GPL-2.0-or-later
"""Recorded frames of the lots of a town -> frames of the town, for its pictures and its player."""
from dataclasses import replace

import numpy as np

from . import frames, verdict
from .events import SnowFallen, Tilt
from .history import History
from .summary import TownSummary

MOST_PLACEMENTS = 4_000_000
"""Elements times frames of a town, above which frames are left out. [-] A player of that size has 30 MB."""
SHOWN = ("tilt", "collapse", "structure_fallen", "snow_fallen")  # kinds of events of a lot that are events of the town


SIDES = {"east": (1, 0), "north": (0, 1), "west": (-1, 0), "south": (0, -1)}


def summary(name, results, record):
    """TownSummary. results: {name of a lot: (its Summary, (3, 3) axes of the house, LotResult)}; record: Record of the
    motion that reaches the town"""
    events = [replace(event, facts=_in_town(event.facts, axes), lot=lot) for lot, (one, axes, _) in results.items()
              for event in one.events if event.kind in SHOWN]
    lots = [one for one, *_ in results.values()]
    return TownSummary(model=name, verdict=max((lot.verdict for lot in lots), key=verdict.STATES.index),
                       lots=[result for *_, result in results.values()],
                       collapsed=any(lot.collapsed for lot in lots),
                       collapse_time_s=min((lot.collapse_time_s for lot in lots if lot.collapsed), default=None),
                       tilt_time_s=min((lot.tilt_time_s for lot in lots if lot.tilt_time_s is not None), default=None),
                       dt=lots[0].dt, record=record, versions=lots[0].versions,
                       events=sorted(events, key=lambda event: event.time_s))


def _in_town(facts, axes):
    """Facts of an event in the axes of the town."""
    if isinstance(facts, Tilt):
        side = town_side("east" if facts.direction == "ew" else "north", axes)
        return replace(facts, direction="ew" if side in ("east", "west") else "ns")
    return replace(facts, side=town_side(facts.side, axes)) if isinstance(facts, SnowFallen) else facts


def town_side(side, axes):
    """The compass side of the town nearest to a side of a house, or to each of several, 'south+west'; other words as
    they are."""
    def nearest(word):
        return max(SIDES, key=lambda other: np.dot(SIDES[other], axes[:2, :2] @ SIDES[word]))
    return "+".join(nearest(word) if word in SIDES else word for word in side.split("+"))


def town_frames(summary, lots):
    """Frames of a town without grounds and contacts. summary: TownSummary; lots: (name, (3, 3) axes of the house, (3,)
    place [m], Frames)"""
    placed = [_Lot(*lot) for lot in lots]
    longest = max((lot.run for lot in placed), key=lambda run: len(run.time))
    count = sum(len(lot.kept) for lot in placed)
    stride = -(-count * len(longest.time) // MOST_PLACEMENTS)
    numbers = sorted({*range(0, len(longest.time), stride), len(longest.time) - 1})
    for name, parts in (("element", [lot.kept for lot in placed]), ("joint", [lot.run.joints.name for lot in placed]),
                        ("sheet", [lot.run.sheets.type for lot in placed])):
        for lot, first in zip(placed, frames.starts(parts)):
            lot.first[name] = first
    town = frames.Frames(f"Town {summary.model}", summary.model, summary.model, longest.version,
                         _table(frames.Elements, placed, "elements"), _table(frames.Joints, placed, "joints"),
                         sheets=_table(frames.Sheets, placed, "sheets"))
    town.time = [longest.time[k] for k in numbers]
    for k in numbers:
        states = [lot.state(k) for lot in placed]
        for key, values in zip(("position", "orientation", "load", "broken"), map(np.concatenate, zip(*states))):
            getattr(town, key).append(values)
    first = min((lot for lot in placed if lot.run.motion), key=lambda lot: lot.run.motion.start, default=None)
    if first is not None:  # which the wave reaches first
        motion, axes = first.run.motion, first.axes.T
        town.motion = frames.Motion(motion.dt, motion.start, motion.acceleration @ axes, motion.displacement @ axes)
    town.summary = summary
    town.history = History(("time [s]",), np.empty((0, 1)))
    town.breaks = _breaks(placed)
    return town


class _Lot:
    """A lot with the elements that the town keeps: all but the ground."""

    def __init__(self, name, axes, place, run):
        self.name, self.axes, self.place, self.run = name, np.asarray(axes), np.asarray(place, float), run
        held = {*map(int, run.joints.a), *map(int, run.joints.b)}
        self.kept = [k for k, kind in enumerate(run.elements.kind) if kind != "ground" or k in held]
        half = np.arctan2(self.axes[1, 0], self.axes[0, 0]) / 2
        self.turn = np.cos(half), np.sin(half)  # w, z of the quaternion
        self.first = {}  # {'element', 'joint', 'sheet': number of the lot's first one in the town}

    def column(self, table, key, values):
        """Values of a column in the town. table: 'elements', 'joints' or 'sheets'"""
        if (table, key) in (("elements", "position"), ("elements", "orientation")):
            return self.placed(values) if key == "position" else self.turned(values)
        if table == "elements":
            values = values[self.kept] if isinstance(values, np.ndarray) else [values[k] for k in self.kept]
        if (table, key) in (("elements", "name"), ("elements", "group"), ("joints", "name")):
            return [f"{self.name}.{value}" for value in values]
        if key in ("a", "b", "low", "high"):
            return (np.searchsorted(self.kept, values) + self.first["element"]).astype("i4")
        if key == "sheet":
            return np.where(values < 0, -1, values + self.first["sheet"])
        return [town_side(side, self.axes) for side in values] if key == "side" else values

    def placed(self, position):
        return np.asarray(position, float)[self.kept] @ self.axes.T + self.place

    def turned(self, orientation):
        """Quaternions w, x, y, z, turned about the vertical."""
        w, x, y, z = np.asarray(orientation, float)[self.kept].T
        c, s = self.turn
        return np.column_stack([c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w])

    def state(self, k):
        """Positions, orientations, loads and broken springs in a frame; the last frame of a run that ended earlier."""
        run, k = self.run, min(k, len(self.run.time) - 1)
        return (self.placed(run.position[k]).astype("f4"), self.turned(run.orientation[k]).astype("f4"), run.load[k],
                run.broken[k])


def _table(kind, lots, table):
    """Elements, Joints or Sheets of the town from those of the lots. table: their name in Frames"""
    columns = {}
    for key in vars(getattr(lots[0].run, table)):
        parts = [lot.column(table, key, getattr(getattr(lot.run, table), key)) for lot in lots]
        columns[key] = (np.concatenate(parts) if isinstance(parts[0], np.ndarray)
                        else [value for part in parts for value in part])
    return kind(**columns)


def _breaks(lots):
    """Breaks of all lots in the order of time."""
    columns = list(lots[0].run.breaks)
    rows = [[value + lot.first["joint"] if key == "joint" else value for key, value in zip(columns, row)]
            for lot in lots for row in zip(*(lot.run.breaks[key] for key in columns))]
    rows.sort(key=lambda row: row[columns.index("time")])
    return {key: [row[k] for row in rows] for k, key in enumerate(columns)}

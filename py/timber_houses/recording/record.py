# SPDX-License-Identifier: GPL-2.0-or-later
"""A recorded run in memory: elements, joints, wall sheets, frames, results. Names and units as in its file (frames.py).
"""
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from .history import History
from .quantities import Storeys
from .summary import Summary


class _ShortRepr:
    """Prints sizes instead of contents."""

    def __repr__(self):
        sizes = (f"{name}={f'<{len(value)}>' if hasattr(value, '__len__') else value}"
                 for name, value in vars(self).items())
        return f"{type(self).__name__}({', '.join(sizes)})"


@dataclass(repr=False)
class Elements(_ShortRepr):
    """Names and shapes, as in /elements; vertices and faces: a list per element."""

    name: list
    kind: list
    group: list
    material: list
    storey: np.ndarray
    fixed: np.ndarray
    position: np.ndarray
    orientation: np.ndarray
    vertices: list
    faces: list


@dataclass(repr=False)
class Joints(_ShortRepr):
    """As in /joints. A wall sheet has two joints of one spring each; it is broken when both are, partly when one is."""

    name: list
    kind: list
    storey: list
    side: list
    a: np.ndarray
    b: np.ndarray
    anchor: np.ndarray
    springs: np.ndarray
    damaged: np.ndarray
    strength: np.ndarray
    sheet: np.ndarray = None  # type: ignore[assignment]  # of no wall

    def __post_init__(self):
        self.sheet = np.full(len(self.name), -1) if self.sheet is None else self.sheet

    def states(self, broken):
        """'whole', 'partly', 'broken' or 'before' (the start), for each joint. broken: (..., J) broken springs"""
        broken = np.asarray(broken)
        state = np.where(broken == 0, "whole", np.where(broken >= self.springs, "broken", "partly"))
        return np.where(self.damaged, "before", state)

    @property
    def of_walls(self):
        """(J,) bool: joints that are halves of wall sheets."""
        return np.asarray(self.sheet) >= 0

    def wall_sheets(self):
        """[[numbers of the joints]] of each wall sheet."""
        sheets = [[] for _ in range(int(np.max(self.sheet, initial=-1)) + 1)]
        for k in np.flatnonzero(self.of_walls):
            sheets[self.sheet[k]].append(int(k))
        return sheets

    def sheet_states(self, broken):
        """(..., S) 'broken', 'partly' or 'whole' for each wall sheet. broken: (..., J) bool"""
        halves = np.flatnonzero(self.of_walls)
        sheet = np.asarray(self.sheet)[halves]
        number = np.bincount(sheet)
        gone = np.zeros((*broken.shape[:-1], len(number)), int)
        np.add.at(gone, (..., sheet), broken[..., halves])
        return np.select([gone == number, gone > 0], ["broken", "partly"], "whole")

    def count_apart(self, broken):
        """((broken, all) of the joints without walls, (broken, all) of the wall sheets). broken: (J,) bool"""
        sheets, other = self.sheet_states(broken), ~self.of_walls
        return (int((broken & other).sum()), int(other.sum())), (int((sheets == "broken").sum()), len(sheets))


@dataclass(repr=False)
class Sheets(_ShortRepr):
    """As in /sheets."""

    type: list = field(default_factory=list)
    opening: list = field(default_factory=list)
    low: np.ndarray = field(default_factory=lambda: np.empty(0, int))
    high: np.ndarray = field(default_factory=lambda: np.empty(0, int))


@dataclass(repr=False)
class Contacts(_ShortRepr):
    """As in /contacts; pair, position, force: a list with an array per time."""

    time: list = field(default_factory=list)
    pair: list = field(default_factory=list)
    position: list = field(default_factory=list)
    force: list = field(default_factory=list)


@dataclass(repr=False)
class Motion(_ShortRepr):
    """As in /motion."""

    dt: float
    start: float
    acceleration: np.ndarray
    displacement: np.ndarray = None  # type: ignore[assignment]  # not computed

    @property
    def time(self):
        return self.start + self.dt * np.arange(len(self.acceleration))

    def first(self, acceleration):
        """Time at which the ground first has an acceleration [m/s2] in any direction, or None. [s]"""
        reached = np.flatnonzero(np.abs(self.acceleration).max(1) >= acceleration)
        return float(self.time[reached[0]]) if len(reached) else None

    def last(self, acceleration):
        """Time from which on the ground has less than an acceleration [m/s2] in all directions. [s]"""
        reached = np.flatnonzero(np.abs(self.acceleration).max(1) >= acceleration)
        return float(self.time[reached[-1]] + self.dt) if len(reached) else self.start


@dataclass(repr=False, eq=False)
class Frames:
    """The file's content. time, position, orientation, load, broken: arrays, or lists during a run.

    scenario: '' of a user's scene; summary: Summary, of a town TownSummary; breaks, peaks, columns: dictionaries of
    /breaks, /joint_peaks and /columns; None before the run's end, the last three and storeys also of a town."""

    title: str
    scenario: str
    model: str
    version: str
    elements: Elements
    joints: Joints
    time: list = field(default_factory=list)
    position: list = field(default_factory=list)
    orientation: list = field(default_factory=list)
    load: list = field(default_factory=list)
    broken: list = field(default_factory=list)
    contacts: Contacts = field(default_factory=Contacts)
    motion: Motion | None = None
    summary: Summary | None = None
    history: History | None = None
    breaks: dict | None = None
    run: str = ""
    storeys: Storeys | None = None
    peaks: dict | None = None
    columns: dict | None = None
    sheets: Sheets = field(default_factory=Sheets)

    def __repr__(self):
        until = f"up to {self.time[-1]:g} s" if len(self.time) else "empty"
        sizes = f"{len(self.elements.name)} elements, {len(self.joints.name)} joints, {len(self.time)} frames"
        return f"<Frames: {self.title}, {sizes}, {until}, {'ended' if self.summary else 'not ended'}>"

    def corners(self, frame, element):
        """(n, 3) corners of an element in a frame, world frame [m]."""
        return placed(self.elements.vertices[element], self.position[frame][element], self.orientation[frame][element])

    def corners_at_start(self, element):
        """(n, 3) corners of an element before the first step, world frame [m]."""
        e = self.elements
        return placed(e.vertices[element], e.position[element], e.orientation[element])

    def all_corners(self, frame=None):
        """List of the (n, 3) corners of every element in a frame, or (None) before the first step, world frame [m]."""
        e = self.elements
        position, orientation = ((e.position, e.orientation) if frame is None
                                 else (self.position[frame], self.orientation[frame]))
        counts = [len(vertices) for vertices in e.vertices]
        body = np.repeat(np.arange(len(counts)), counts)
        corners = np.asarray(position, float)[body] + rotated(np.asarray(orientation)[body], np.concatenate(e.vertices))
        return np.split(corners, np.cumsum(counts)[:-1])

    def joint_places(self, frame):
        """(J, 3) positions of the joints on their first elements, world frame [m]."""
        a = self.joints.a
        return np.asarray(self.position[frame])[a] + rotated(np.asarray(self.orientation[frame])[a], self.joints.anchor)

    def joint_states(self, frame):
        """Joints.states in a frame: a number, or a slice."""
        return self.joints.states(self.broken[frame])

    def at(self, time):
        """Number of the frame nearest to a time [s]."""
        return int(np.argmin(np.abs(np.asarray(self.time) - time)))

    @cached_property
    def shown(self):
        """Numbers of the elements that pictures show: all but the ground."""
        return [k for k, kind in enumerate(self.elements.kind) if kind != "ground"]


def rotated(q, v):
    """Vectors (..., 3) rotated by unit quaternions (..., 4) w, x, y, z."""
    q, v = np.asarray(q, float), np.asarray(v, float)
    u = q[..., 1:]
    t = 2 * np.cross(u, v)
    return v + q[..., :1] * t + np.cross(u, t)


def placed(vertices, position, orientation):
    """(n, 3) vertices of a body frame in the world frame."""
    return np.asarray(position, float) + rotated(np.asarray(orientation)[None], vertices)

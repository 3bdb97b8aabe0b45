# SPDX-License-Identifier: GPL-2.0-or-later
"""Damage of a house in one state: broken joints, lost columns, fallen and leaning structures, fallen snow.

A joint is broken when all its springs are, partly broken when some are. Joints that are broken before the start are
counted apart, never as broken. Totals leave out the joints of walls, of which the sheets are counted. A column is lost
when it has fallen (inclined by more than FALLEN_ANGLE) or is loose (no joint of it has a spring left)."""
import math
from collections import Counter
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .record import Elements, Joints, placed, rotated
from .summary_parts import Broken, Columns, JointCounts
from .verdict import FALLEN_ANGLE, Structure

SIDES = ("north", "south", "east", "west", "inside")
SNOW_DROP = 1.0
"""Snow has fallen when its centre is lower by this, and it is beyond the roof or touches the ground. [m]"""
TOUCH = 0.05  # height of the lowest corner of snow that touches the ground. [m]


@dataclass(frozen=True)
class Level:
    """Top of a storey. structure: name; marks: numbers of the elements at this level; their masses [kg]; height of the
    storey [m]."""

    structure: str
    marks: list
    masses: list
    height: float

    def displacement(self, moved):
        """(3,) displacement of the centre of mass, as of Sampler. moved: (n, 3) of all elements, NaN: removed."""
        moved, masses = moved[self.marks], np.array(self.masses)
        present = ~np.isnan(moved[:, 0])
        return masses[present] @ moved[present] / masses[present].sum()


@dataclass(frozen=True)
class State:
    """position (N, 3) [m], orientation (N, 4) w, x, y, z, NaN for a removed element; broken (J,): broken springs;
    load (J,) over strength [-], which only a record needs."""

    position: np.ndarray
    orientation: np.ndarray
    broken: np.ndarray
    load: np.ndarray | None = None


@dataclass
class DamageSurvey:
    """Damage of a house in any state. levels: of each structure from below, the main structure first."""

    elements: Elements
    joints: Joints
    levels: list

    def __post_init__(self):
        e, j = self.elements, self.joints
        self.structures = list(dict.fromkeys(level.structure for level in self.levels))
        """Names of the structures, the main one first."""
        self._columns = np.array([k for k, kind in enumerate(e.kind) if kind == "column"], int)
        self._upright = _vertical(e.orientation[self._columns])
        self._loose_at_start = self.loose_columns(State(e.position, e.orientation, np.where(j.damaged, j.springs, 0)))

    def count_joints(self, chosen=None):
        """JointCounts without wall sheets. chosen: (J,) bool, default all"""
        chosen = np.ones(len(self.joints.kind), bool) if chosen is None else chosen
        kinds = Counter(kind for kind, counts in zip(self.joints.kind, chosen) if counts)
        main = {kind: kinds.pop(kind, 0) for kind in ("column_beam", "brace_beam")}
        return JointCounts(total=int((chosen & ~self.joints.of_walls).sum()), **main, others=dict(kinds))

    def count_all(self):
        """JointCounts of all joints and wall sheets: the part `joints` of the summary."""
        return replace(self.count_joints(), wall_sheets=len(self.joints.sheet_states(self.joints.of_walls)) or None)

    def _broken_joints(self, state):
        """((J,) bool: broken, (J,) bool: partly broken), without those broken before the start."""
        states = self.joints.states(state.broken)
        return states == "broken", states == "partly"

    def count_broken(self, state, springs):
        """The part `broken`. springs: number that broke. A joint of two sides counts for both."""
        (broken, partly), storey = self._broken_joints(state), np.array(self.joints.storey)
        on_side = {side: np.array([side in sides.split("+") for sides in self.joints.side], bool) for side in SIDES}
        counted = broken & ~self.joints.of_walls
        in_storey = {name: storey == name for name in dict.fromkeys(self.joints.storey)}
        sheets = self.joints.sheet_states(broken)
        gone, partly_gone = (int((sheets == state).sum()) for state in ("broken", "partly"))
        return Broken(
            **vars(self.count_joints(broken)) | {"wall_sheets": gone if len(sheets) else None},
            by_side={side: int((counted & there).sum()) for side, there in on_side.items()},
            by_storey={name: int((counted & there).sum()) for name, there in in_storey.items()},
            by_place={name: {side: self.count_joints(broken & there & beside) for side, beside in on_side.items()}
                      for name, there in in_storey.items()},
            partly_broken=int(partly.sum()),
            wall_sheets_partly=partly_gone if len(sheets) else None,
            springs=springs,
            damaged_at_start=self.count_joints(np.asarray(self.joints.damaged, bool)),
        )

    def fallen_columns(self, state):
        """(C,) bool for each column: inclined by more than FALLEN_ANGLE from its direction at the start."""
        return (_vertical(state.orientation[self._columns]) * self._upright).sum(1) < math.cos(FALLEN_ANGLE)

    def loose_columns(self, state):
        """(C,) bool for each column: no joint of it has a spring left."""
        intact, joined = state.broken < self.joints.springs, np.zeros(len(self.elements.name), bool)
        joined[self.joints.a[intact]] = joined[self.joints.b[intact]] = True
        return ~joined[self._columns]

    def count_columns(self, state):
        """The part `columns` of the summary; loose ones that have not fallen, without those from the start."""
        present, fallen = ~np.isnan(state.position[self._columns, 0]), self.fallen_columns(state)
        loose = present & ~fallen & self.loose_columns(state) & ~self._loose_at_start
        return Columns(total=int(present.sum()), fallen=int(fallen.sum()), loose=int(loose.sum()))

    def lost_columns(self, state):
        """(C,) bool for each column: it has fallen, or become loose, since the start."""
        present = ~np.isnan(state.position[self._columns, 0])
        return present & (self.fallen_columns(state) | self.loose_columns(state) & ~self._loose_at_start)

    def by_structure(self, state, judged):
        """{name: verdict.Structure}, the main one first; the residual drift is that of the last sample.
        judged: {name: judge.Judged}"""
        broken, partly = self._broken_joints(state)
        owners = np.array([self.structures[0] if storey.isdigit() else storey for storey in self.joints.storey])
        lost, groups = self.lost_columns(state), np.array(self.elements.group)[self._columns]
        return {name: Structure(peak_drift=max(facts.peak, default=0.0),
                                column_drift=max(facts.column_peak, default=0.0),
                                residual_drift=max(map(abs, facts.drift), default=0.0),
                                broken=int(broken[owners == name].sum()),
                                partly_broken=int(partly[owners == name].sum()),
                                columns_lost=int(lost[groups == name].sum()), collapsed=facts.fall_s is not None)
                for name, facts in judged.items()}

    @cached_property
    def _snow(self):
        """[(snow element, roof element below it, (3,) centre of the snow in the roof's body frame at the start [m])]"""
        e = self.elements
        layers = []
        for k in (k for k, kind in enumerate(e.kind) if kind == "snow"):
            roofs = [j for j, kind in enumerate(e.kind) if kind == "roof" and e.group[j] == e.group[k]]
            if roofs:
                roof = min(roofs, key=lambda j: np.linalg.norm(e.position[j] - e.position[k]))
                place = rotated(e.orientation[roof] * [1, -1, -1, -1], e.position[k] - e.position[roof])
                layers.append((k, roof, place))
        return layers

    def fallen_snow(self, state):
        """Numbers of the roof elements that have lost their snow (SNOW_DROP, `_has_left`)."""
        if not self._snow:
            return []
        z, vertical = state.position[:, 2], _vertical(state.orientation)
        lower = [(snow, roof) for snow, roof, place in self._snow
                 if z[roof] + vertical[roof] @ place - z[snow] > SNOW_DROP]
        return [roof for snow, roof in lower if self._has_left(state, snow)]

    def _has_left(self, state, snow):
        """Whether snow touches the ground, or has no corner above the rectangle around its structure's roofs."""
        e = self.elements
        of_roofs = [k for k, kind in enumerate(e.kind) if kind == "roof" and e.group[k] == e.group[snow]]
        slab, *others = (placed(e.vertices[k], state.position[k], state.orientation[k]) for k in (snow, *of_roofs))
        roofs = np.concatenate(others)[:, :2]
        outside = (slab[:, :2].max(0) < roofs.min(0)) | (slab[:, :2].min(0) > roofs.max(0))
        return bool(outside.any() or slab[:, 2].min() < TOUCH)


def _vertical(q):
    """(n, 3) the world's vertical in the body frames of unit quaternions (n, 4) w, x, y, z."""
    w, x, y, z = q.T
    return np.array([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]).T

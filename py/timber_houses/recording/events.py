# SPDX-License-Identifier: GPL-2.0-or-later
"""Events of a run: time, kind, facts. Their phrases: text/.

FirstBreak, Tilt (a storey drift passes verdict.TILT), Collapse (an upper floor comes down by verdict.FALL),
StructureFallen (another structure than the main one): at the time they happen; OwnWeight (damaged before the shaking):
in the last frame before it; ColumnsLost, SnowFallen: at the end of the frame interval in which they happen.
ShakingBegins, StrongestShaking, LevelPassed: of the player, not recorded."""
from dataclasses import dataclass, field, make_dataclass

from ..base.json_types import decode, require
from .verdict import Structure


@dataclass(frozen=True)
class FirstBreak:
    """Of a spring. joint: kind of its joint; storey, side, cause: as in breaks.csv; force_n: 0 after yielding [N]"""

    joint: str
    storey: str
    side: str
    cause: str
    force_n: float


@dataclass(frozen=True)
class Tilt:
    """direction: 'ns' or 'ew'"""

    direction: str


@dataclass(frozen=True)
class OwnWeight:
    """structures: all of the house, the main one first"""

    snow: bool
    structures: dict[str, Structure]


@dataclass(frozen=True)
class StructureFallen:
    structure: str


@dataclass(frozen=True)
class ColumnsLost:
    """number: of `total` columns, fallen or without a joint"""

    number: int
    total: int


@dataclass(frozen=True)
class SnowFallen:
    """structure: '' for the main one; side: '' for a roof of one part; layer: 'roof' or 'roof2'"""

    structure: str
    side: str
    layer: str


@dataclass(frozen=True)
class LevelPassed:
    """drift: one of verdict.LIMITS [-]"""

    drift: float


Collapse, ShakingBegins, StrongestShaking = (  # without facts
    make_dataclass(name, (), frozen=True) for name in ("Collapse", "ShakingBegins", "StrongestShaking"))
RECORDED = {"first_break": FirstBreak, "tilt": Tilt, "collapse": Collapse, "own_weight": OwnWeight,
            "structure_fallen": StructureFallen, "columns_lost": ColumnsLost, "snow_fallen": SnowFallen}
KINDS = {**RECORDED, "shaking_begins": ShakingBegins, "strongest_shaking": StrongestShaking, "level": LevelPassed}


@dataclass(frozen=True)
class Event:
    """time_s [s]; kind: a key of KINDS; facts: of its class; lot: of a town, else None."""

    time_s: float
    kind: str = field(init=False)
    facts: object
    lot: str | None = field(default=None, metadata={"omitted": True})

    def __post_init__(self):
        object.__setattr__(self, "kind", next(kind for kind, facts in KINDS.items() if isinstance(self.facts, facts)))

    @classmethod
    def decoded(cls, value, path):
        """From a table of JSON. Raises ValueError."""
        entries = {"lot": None, **require(value, dict, path)}
        if entries.keys() != {"time_s", "kind", "facts", "lot"} or entries["kind"] not in list(RECORDED):
            raise ValueError(f"{path}: not an event of this version")
        facts = decode(RECORDED[entries["kind"]], entries["facts"], f"{path}.facts")
        return cls(require(entries["time_s"], float, f"{path}.time_s"), facts,
                   decode(str | None, entries["lot"], f"{path}.lot"))


class EventLog:
    """Events of a run so far. survey: DamageSurvey of its house; events: those known already."""

    def __init__(self, survey, events=()):
        self.survey, self.events = survey, list(events)

    def sorted(self):
        return sorted(self.events, key=lambda event: event.time_s)

    def add(self, time, facts):
        """Note an event at a time [s], unless it is known."""
        if all(event.facts != facts for event in self.events):
            self.events.append(Event(round(time, 6), facts))

    def drop_after(self, time):
        """Forget events later than a time [s]: an earlier state was loaded."""
        self.events = [event for event in self.events if event.time_s <= time + 1e-6]

    def observe(self, time, state):
        """Note the events of a State that were not there before."""
        e, main = self.survey.elements, self.survey.structures[0]
        for roof in self.survey.fallen_snow(state):  # 'main.roof.west' or 'entrance.roof'
            layer, _, side = e.name[roof].removeprefix(f"{e.group[roof]}.").partition(".")
            self.add(time, SnowFallen("" if e.group[roof] == main else e.group[roof], side, layer))
        lost = int(self.survey.lost_columns(state).sum())
        reported = max((event.facts.number for event in self.events if event.kind == "columns_lost"), default=0)
        if lost >= max(1, 2 * reported):  # the first, and each time the number has doubled: a collapse gives few events
            self.add(time, ColumnsLost(lost, self.survey.count_columns(state).total))

# SPDX-License-Identifier: GPL-2.0-or-later
"""Events of a run with their times: to joints, columns, structures and snow. Needs no YADE.

Kinds: first_break, tilt (a storey drift passes 1/10), collapse (an upper floor comes down by half a storey): at the time they happen;
own_weight (damaged before the shaking): in the last frame before it; structure_fallen (another structure than the main one), columns_lost,
snow_fallen: at the end of the frame interval in which they happen.
"""
from dataclasses import asdict, dataclass

from .damage import DamageSurvey


@dataclass(frozen=True)
class Event:
    """time_s [s]; kind: see the head of the module; what: a clause for people; number: of the columns that are lost, else 1."""

    time_s: float
    kind: str
    what: str
    number: int = 1


class EventLog:
    """Events of a run so far. survey: DamageSurvey of its house; events: those known already, as `records` gives them."""

    def __init__(self, survey: DamageSurvey, events=()):
        self.survey = survey
        self.events = [Event(**event) for event in events]

    def records(self):
        """Events in the order of time as dictionaries: the key `events` of the summary."""
        return [asdict(event) for event in sorted(self.events, key=lambda event: event.time_s)]

    def add(self, time, kind, what, number=1):
        """Note an event at a time [s], unless it is known."""
        if all((event.kind, event.what) != (kind, what) for event in self.events):
            self.events.append(Event(round(time, 6), kind, what, number))

    def drop_after(self, time):
        """Forget events later than a time [s]: an earlier state was loaded."""
        self.events = [event for event in self.events if event.time_s <= time + 1e-6]

    def observe(self, time, state):
        """Note the events of a State that were not there before."""
        for name in self.survey.fallen_structures(state):
            if name != self.survey.structures[0]:
                self.add(time, "structure_fallen", f"{name} has fallen: a level is down by half a storey")
        for roof in self.survey.fallen_snow(state):
            self.add(time, "snow_fallen", f"snow has fallen from the {self._roof_name(roof)}")
        self._observe_columns(time, state)

    def _observe_columns(self, time, state):
        """An event for the first lost column, and each time the number has doubled: a collapse gives a few events, not ninety."""
        total, lost = self.survey.count_columns(state)["total"], int(self.survey.lost_columns(state).sum())
        known = max((event.number for event in self.events if event.kind == "columns_lost"), default=0)
        if lost >= max(1, 2 * known):
            self.add(time, "columns_lost", f"{lost} of {total} columns inclined by more than 45 degrees or without a joint", lost)

    def _roof_name(self, roof):
        """'west roof' of an element 'main.roof.west', 'entrance's roof' of 'entrance.roof'."""
        e = self.survey.elements
        structure, name = e.group[roof], e.name[roof]
        layer, _, side = name.removeprefix(f"{structure}.").partition(".")
        owner = "" if structure == self.survey.structures[0] else f"{structure}'s"
        return " ".join(filter(None, (owner, side, layer)))

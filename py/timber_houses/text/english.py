# SPDX-License-Identifier: GPL-2.0-or-later
"""Summaries and events in English."""
import math

from ..recording import verdict
from ..recording.summary import TownSummary

DRIFT_LINES = tuple((limit.drift, limit.text) for limit in verdict.LIMITS)
"""Limits of storey drifts and their meaning. [-]"""
CONVERGED = 1e-6  # share of the energy put in that unconverged steps may lack without a remark. [-]
SMALL = 1e-3  # drifts below this are not distinguished. [-]
TORSION = 1.1  # drift at a column over that of the centre from which a sentence states it. [-]
LONGEST_TEXT = 400  # letters of a text from data that are shown; Agg cannot draw a line of 32768 pixels
ORIGIN = {"none": "No ground motion", "motion": "Ground motion", "record": "Record", "intensity": "JMA intensity",
          "step": "time step"}
"""Words of pictures/provenance.py."""


# --- the loads of a run -----------------------------------------------------------------------------------------------


def loads(earthquake, snow_depth):
    """'earthquake and 1 m of snow'. earthquake: whether there is one; snow_depth [m]"""
    snow = f"{snow_depth:g} m of snow{'' if earthquake else ' only'}" if snow_depth > 0 else ""
    return " and ".join(filter(None, ("earthquake" * earthquake, snow))) or "own weight only"


# --- the result of a run ----------------------------------------------------------------------------------------------


def sentence(summary):
    """The verdict on a house and its reasons, of an ensemble first its outcomes; of a town its houses by verdict."""
    if isinstance(summary, TownSummary):
        return town(summary)
    parts = (outcome, other_walls, weight, residual, structures, joints, columns, snow, record, early, unconverged)
    text = "; ".join(filter(None, (part(summary) for part in parts)))
    return f"{cut_off(summary)}{ensemble(summary)}{house_name(summary.model, summary.lot)} {text}"


def house_name(model, lot):
    """'House A', of a town 'Lot corner (house A)'. lot: its name, or None"""
    return f"House {model}" if lot is None else f"Lot {lot} (house {model})"


def cut_off(summary):
    """'Cut off at 5.93 s, not to be relied on: ' of a run whose numbers failed, else empty."""
    return f"Cut off at {summary.duration_s:.2f} s, not to be relied on: " if summary.cut_off else ""


def early(summary):
    """Remark on a run that ends before or in the strong shaking, or with the rest of its wreck; empty for others."""
    if summary.rest_s is not None:
        return f"the run ends at {summary.duration_s:.0f} s, since the wreck is at rest from {summary.rest_s:.0f} s on"
    onset, end = summary.missed_shaking or (None, None)
    if onset is None:
        return ""
    if summary.duration_s < onset:
        return f"the run ends before strong shaking sets in ({onset:.1f} s)"
    return f"the run ends during the strong shaking ({onset:.1f} to {end:.1f} s)"


def unconverged(summary):
    """Steps that did not converge, if what they lack could be more than CONVERGED of the energy put in; else empty."""
    steps, change = summary.solver.unconverged_steps, summary.solver.worst_change_j
    lacks = steps * change > CONVERGED * summary.energy.input
    return f"{steps} steps did not converge (largest change {change:.2g} J)" if lacks else ""


def weight(summary):
    """Damage before the shaking, which an event describes; without an earthquake the cause. Empty without damage."""
    if summary.earthquake:
        return next((own_weight(event.facts) for event in summary.events if event.kind == "own_weight"), "")
    snow = " and snow" * summary.snow
    return f"damaged by its own weight{snow}" if summary.main.verdict != verdict.UNDAMAGED else ""


def ensemble(summary):
    """'Run 7 of 16 (12 unsafe, 4 collapsed; peak drift 1/14 to 1/8 in those that stand). ', else empty."""
    if not summary.ensemble:
        return ""
    outcomes, drifts = summary.ensemble.outcomes, summary.ensemble.peak_drift_standing
    numbers = ", ".join(f"{number} {state}" for state, number in outcomes.items())
    standing = " in those that stand" * (verdict.COLLAPSED in outcomes)
    return (f"{place_in_ensemble(summary.ensemble)}"
            f" ({numbers}{f'; peak drift {span(*map(ratio, drifts))}{standing}' if drifts else ''}). ")


def place_in_ensemble(place):
    """'Run 7 of 16'. place: summary.Ensemble"""
    return f"Run {place.run} of {place.runs}"


def town(summary):
    """'Town harbour: 6 houses, 3 undamaged, 2 unsafe, 1 collapsed'."""
    counts = [f"{summary.verdicts.count(state)} {state}" for state in verdict.STATES if state in summary.verdicts]
    houses = f"Town {summary.model}: {len(summary.verdicts)} houses, {', '.join(counts)}"
    return "; ".join(filter(None, (houses, record(summary))))


def outcome(summary):
    """Verdict on the main structure, with its peak storey drift."""
    if summary.collapsed:
        tilt, end = summary.tilt_time_s, f"collapsed at {summary.collapse_time_s:.1f} s"
        return (end if tilt is None
                else f"{end}, after a storey drift of {verdict.TILT.ratio} {direction_name(summary.tilt_direction)} at"
                f" {tilt:.1f} s")
    drift, storey, direction = summary.largest_drift()
    peak = f"{directed(drift, direction)} in {storey_name(storey)}" if drift >= SMALL else ratio(drift)
    limit = verdict.passed(drift)
    meaning = (f"beyond the {limit.name} of {ratio(limit.drift)}" if limit
               else f"below the {verdict.DAMAGE.name} of {ratio(verdict.DAMAGE.drift)}")
    torsion = at_columns(summary)
    lean = " and leans at the end" if summary.main.leans else ""
    article = "a " * (summary.main.verdict == verdict.TOTAL_LOSS)
    return f"is {article}{summary.main.verdict}{lean}: peak storey drift {peak}, {meaning}{torsion}"


def at_columns(summary):
    """', 1/12 N-S at a column (median 1/85), beyond the ...' where that is larger than the drift of the centre; else
    empty."""
    drift, _, direction, median = summary.largest_at_columns or (0.0, "", "", 0.0)
    centre = summary.largest_drift()[0]
    if drift < max(SMALL, TORSION * centre):
        return ""
    limit, before = verdict.passed(drift), verdict.passed(centre)
    beyond = f", beyond the {limit.name}" if limit and limit != before else ""
    return f", {directed(drift, direction)} at a column (median {ratio(median)}){beyond}"


def other_walls(summary):
    """'verdict with design walls: collapsed' where the verdict depends on the level of the walls."""
    other = summary.walls and summary.walls.other
    return (f"verdict with {other.level} walls: {other.verdict}" if other and other.verdict != summary.main.verdict
            else "")


def residual(summary):
    """Residual drift after a peak beyond the damage limit, its own limit, amplitude of the motion that remains."""
    parts = []
    drift, _, direction = summary.largest_drift("residual_drift")
    if not summary.collapsed and summary.largest_drift()[0] >= verdict.DAMAGE.drift:
        loss = f" beyond the {verdict.LOSS.name} of {verdict.LOSS.ratio}" * (summary.main.verdict == verdict.TOTAL_LOSS)
        parts.append(f"{residual_name(summary)} {directed(drift, direction)}{loss}")
    if summary.still_moving and not summary.collapsed:
        amplitude, _, direction = summary.largest_drift("final_amplitude")
        parts.append(f"still moving by ±{directed(amplitude, direction)}")
    return ", ".join(parts)


def residual_name(summary):
    return "residual drift" if summary.main.settled else "drift at the end"


def structures(summary):
    """Verdicts on the structures other than the main one, unless undamaged: 'entrance collapsed at 21.3 s'."""
    parts = []
    for name, facts in summary.others:
        if facts.collapsed:
            parts.append(f"{name} {facts.verdict}{at(summary.fall_time(name))}")
        elif facts.verdict != verdict.UNDAMAGED:
            lean = " and leans" if facts.leans else ""
            parts.append(f"{name} {facts.verdict}{lean} (peak drift {ratio(facts.peak_drift)})")
    return ", ".join(parts)


def joints(summary):
    partly = f", {summary.partly_broken} partly" if summary.partly_broken else ""
    before = summary.broken.damaged_at_start.total
    return broken_of(*summary.joints_and_sheets) + partly + (f" ({before} more from the start)" if before else "")


def broken_of(joints, sheets, of=" of "):
    """'3 of 412 joints and 2 of 16 wall sheets broken' from pairs (broken, all); sheets if there are some"""
    walls = f" and {sheets[0]}{of}{counted(sheets[1], 'wall sheet')}" if sheets[1] else ""
    return f"{joints[0]}{of}{joints[1]} joints{walls} broken"


def columns(summary):
    """Fallen and loose columns, if any, and the time of the first loss."""
    counts, first = summary.columns, summary.first_time("columns_lost")
    texts = [f"{number} {state}" for number, state in ((counts.fallen, "fallen"), (counts.loose, "loose")) if number]
    since = "" if first is None else f", the first at {first:.1f} s"
    return f"{' and '.join(texts)} of {counts.total} columns{since}" if texts else ""


def snow(summary):
    first = summary.first_time("snow_fallen")
    falling = "" if first is None else f", falling from {first:.1f} s"
    return f"snow {summary.snow_mass_kg / 1000:.1f} t{falling}" if summary.snow else ""


def record(summary):
    return f"the record's {summary.record.note}" if summary.record and summary.record.note else ""


# --- events -----------------------------------------------------------------------------------------------------------


def event(one):
    """Clause on an Event; of a town with its lot."""
    return f"{one.lot}: " * (one.lot is not None) + PHRASES[one.kind](one.facts)


def short(one):
    """The same in two or three words, for a fall of a structure or of snow."""
    fallen = one.facts.structure if one.kind == "structure_fallen" else "snow"
    return f"{one.lot}: " * (one.lot is not None) + f"{fallen} has fallen"


def first_break(facts):
    force = f" {facts.force_n / 1000:.1f} kN" if facts.force_n else ""  # none after yielding
    return f"first spring breaks: {joint_place(facts.joint, facts.storey, facts.side)}, {facts.cause}{force}"


def own_weight(facts):
    """'damaged before the shaking, by its own weight: 12 joints broken, peak drift 1/45'."""
    main = next(iter(facts.structures), None)
    parts = [("" if name == main else f"{name}: ") + _damage(one) for name, one in facts.structures.items()
             if one.verdict != verdict.UNDAMAGED]
    return f"damaged before the shaking, by its own weight{' and snow' * facts.snow}: {'; '.join(parts)}"


def _damage(facts):
    if facts.collapsed:
        return "collapsed"
    counts = ((facts.broken, "joint", "broken"), (facts.partly_broken, "joint", "partly broken"),
              (facts.columns_lost, "column", "lost"))
    return ", ".join([*(f"{counted(number, noun)} {state}" for number, noun, state in counts if number),
                      f"peak drift {ratio(facts.peak_drift)}"])


def snow_fallen(facts):
    """'snow has fallen from the west roof', 'from the entrance's roof'."""
    owner = f"{facts.structure}'s" if facts.structure else ""
    return f"snow has fallen from the {' '.join(filter(None, (owner, facts.side, facts.layer)))}"


def level(facts):
    limit = verdict.passed(facts.drift)
    return f"drift passes {limit.text.replace(' ', ': ', 1)}"


PHRASES = {
    "first_break": first_break,
    "tilt": lambda facts: f"a storey drift {direction_name(facts.direction)} passes {verdict.TILT.ratio}",
    "collapse": lambda facts: "collapse: a floor has come down by half a storey",
    "own_weight": own_weight,
    "structure_fallen": lambda facts: f"{facts.structure} has fallen: a level is down by half a storey",
    "columns_lost": lambda facts: (f"{facts.number} of {facts.total} columns inclined by more than"
                                   f" {math.degrees(verdict.FALLEN_ANGLE):.0f} degrees or without a joint"),
    "snow_fallen": snow_fallen,
    "shaking_begins": lambda facts: "the shaking begins",
    "strongest_shaking": lambda facts: "strongest shaking",
    "level": level,
}


# --- words ------------------------------------------------------------------------------------------------------------


def direction_name(key):
    """'ns' -> 'N-S'."""
    return {"ns": "N-S", "ew": "E-W"}.get(key, key)


def storey_name(key):
    """'storey1' -> 'storey 1'."""
    return f"storey {key.removeprefix('storey')}"


def counted(number, noun):
    return f"{number} {noun}{'s' * (number != 1)}"


def at(time):
    """' at 21.3 s', empty without a time."""
    return "" if time is None else f" at {time:.1f} s"


def span(low, high):
    """'1/14 to 1/8' from two texts, one of them where they are the same."""
    return low if low == high else f"{low} to {high}"


def directed(drift, direction):
    """'1/85 N-S', without a direction below SMALL."""
    return f"{ratio(drift)} {direction_name(direction)}" if drift >= SMALL else ratio(drift)


def ratio(drift, below="below "):
    """A drift in the notation of engineers: 1/85. One below a limit of the verdict is not rounded up to it."""
    if drift < SMALL:
        return f"{below}1/1000"
    number = round(1 / drift)
    number += any(drift < limit.drift and number == round(1 / limit.drift) for limit in (*verdict.LIMITS, verdict.LOSS))
    return f"1/{number}" if drift <= 0.5 else f"{drift:.2f}"


def joint_place(kind, storey, side):
    """'column-beam joint, storey 1, west side' from the values of breaks.csv; '' for storey and side: unknown."""
    walls = side if side in ("inside", "") else f"{side.replace('+', ' and ')} side{'s' * ('+' in side)}"
    named = f"{kind.replace('_', '-')} joint".lstrip()
    return ", ".join(filter(None, (named, f"storey {storey}" if storey.isdigit() else storey, walls)))


COUPLED = 0.5  # smaller over larger share of the mass of the two horizontal directions from which a mode has both. [-]


def mode_name(mode):
    """'N-S', or of a coupled mode 'coupled N-S and E-W', the direction of more mass first."""
    other = min(("ns", "ew"), key=mode.mass_share.get)
    if mode.mass_share[other] < COUPLED * mode.mass_share[mode.direction] or other == mode.direction:
        return direction_name(mode.direction)
    return f"coupled {direction_name(mode.direction)} and {direction_name(other)}"


def period_text(mode):
    """'0.31 s', or 'unstable'."""
    return "unstable" if mode.period_s is None else f"{mode.period_s:.2f} s"


def cut_line(text, most=LONGEST_TEXT):
    """A text from data on one line, cut to a number of letters."""
    line = " ".join(str(text)[: 4 * most].split())
    return line if len(line) <= most else line[: most - 1] + "…"


# --- page for the owner of a house ------------------------------------------------------------------------------------

MEANING = {"undamaged": "No damage that needs repair is expected.",
           "repairable": "Damage that can be repaired: finishes crack, joints loosen. Have the house examined.",
           "unsafe": "Nobody may enter the house before an engineer has examined it.",
           "total loss": "The house leans so far that it cannot be repaired. Nobody may enter it.",
           "collapsed": "A storey comes down: people inside are in danger of their lives."}
"""Of the verdicts."""
OUTCOMES = {state: state for state in verdict.STATES}
OWNER = {"start": "At the start", "end": "At the end", "events": "What happens", "seconds": "s",
         "note": "A computed example of one earthquake. It certifies no house: ask an engineer."}
"""Labels of the page."""

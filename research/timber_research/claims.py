# SPDX-License-Identifier: GPL-2.0-or-later
"""The paper's statements about its fourteen runs (sections 4.1-4.4), each as a check on the summaries of the runs.
Needs no YADE.

The criteria were fixed before the runs. They replace the paper's words by numbers:

damage                springs broken during the run (four make a joint); damage at the start does not count
leaning               residual drift of a storey, resultant of N-S and E-W; of a house: its largest storey value
sway                  largest peak drift of the storeys in a direction
sways in a direction  the sway in that direction is the larger one and exceeds SWAY
lost columns          fallen (tilted by more than 45 degrees) or without an intact joint
starts to tilt        last time before the tilt (drift 1/10) at which the drift was zero; from then on the house leans
to one side
"""
import math
from dataclasses import dataclass

from timber_houses.recording.verdict import DAMAGE, SAFETY
from timber_houses.text.english import direction_name, ratio

SWAY = DAMAGE.drift
"""Smallest sway that counts: Japanese practice assumes damage of a timber house beyond this drift. [-]"""
GREAT_SWAY = SAFETY.drift
"""Great sway: the safety limit of Japanese practice for timber houses. Below it in both directions a house is 'very
stable'. [-]
"""
STILL = DAMAGE.drift
"""A house stands still if no drift reaches this and no spring breaks. [-]"""
TILT_AFTER_ONSET = (-1.0, 3.0)
"""E1: time from the onset of strong shaking to the start of the tilt. The paper gives whole seconds and figures some
seconds apart. [s]
"""
COLLAPSE_AFTER_ONSET = (3.0, 9.0)
"""E1: the paper's 6 s +- 50 %: another record of the same strength has its pulses at other times. [s]"""
SNOW_TILT_BY = 1.0
"""S1: 'as soon as the analysis began' means within the first second. [s]"""
SNOW_COLLAPSE = (6.0, 18.0)
"""S1: the paper's 12 s +- 50 %: the time to collapse grows with the logarithm of the initial disturbance, which is
unknown. [s]
"""


@dataclass(frozen=True)
class Result:
    """A claim, whether it holds, and the numbers behind the verdict. holds: None if a run that it needs is missing."""

    name: str
    claim: str
    holds: object
    numbers: str


# --- numbers of one summary -------------------------------------------------------------------------------------------


def sway(run, direction):
    """Largest peak drift of the storeys in direction 'ns' or 'ew'. [-]"""
    return max(storey[direction] or 0.0 for storey in run.peak_drift.values())


def leaning(run, storey=None):
    """Residual drift of a storey ('storey2'), or the largest of all storeys; resultant of both directions. [-]"""
    storeys = [run.residual_drift[storey]] if storey else run.residual_drift.values()
    return max(math.hypot(s["ns"] or 0.0, s["ew"] or 0.0) for s in storeys)


def damage(run):
    """Springs broken during the run."""
    return run.broken.springs


def lost_columns(run):
    """Columns that have fallen or have no intact joint."""
    return run.columns.fallen + run.columns.loose


def sways_in(run, direction, at_least=SWAY):
    """Whether the sway in a direction exceeds that in the other direction and reaches `at_least` [-]."""
    other = {"ns": "ew", "ew": "ns"}[direction]
    return sway(run, direction) >= at_least and sway(run, direction) > sway(run, other)


def more_damaged(run, other):
    """Whether `run` is damaged more than `other`; a collapse exceeds any number of broken springs."""
    return (run.collapsed, damage(run)) > (other.collapsed, damage(other))


# --- the same numbers as text -----------------------------------------------------------------------------------------


def drift_text(value):
    return ratio(value, "<")


def sway_text(run):
    return f"sway N-S {drift_text(sway(run, 'ns'))} E-W {drift_text(sway(run, 'ew'))}"


def lean_text(run):
    return " ".join(f"{name[len('storey'):]}: {drift_text(leaning(run, name))}" for name in run.residual_drift)


def outcome_text(run):
    return f"collapsed {time_text(run.collapse_time_s)}" if run.collapsed else "stands"


def time_text(seconds):
    return "never" if seconds is None else f"{seconds:.1f} s"


def damage_text(run):
    broken = run.broken
    return (
        f"{damage(run)} springs, {broken.total} joints ({broken.column_beam} column-beam,"
        f" {broken.brace_beam} brace-beam)"
    )


def run_text(run):
    """All quantities of a run that claims compare."""
    house = f"{run.model}{' + snow' if run.snow else ''}"
    return (
        f"{house}: {outcome_text(run)}, {sway_text(run)}, leans {lean_text(run)}, {damage_text(run)},"
        f" {lost_columns(run)} columns lost"
    )


def runs_text(*runs):
    return "; ".join(run_text(run) for run in runs)


# --- checks: each takes the summaries of the runs it names and returns (holds, numbers) -------------------------------


def tilts_and_collapses_when_shaken(a):
    if not a.collapsed or a.leans_from_s is None:
        return False, f"{outcome_text(a)}, {sway_text(a)}, {damage_text(a)}"
    # The direction depends on the record, which differs from the paper's: it is reported, not judged.
    onset = a.record.onset_s
    tilt, fall = a.leans_from_s - onset, a.collapse_time_s - onset
    return (
        within(tilt, TILT_AFTER_ONSET) and within(fall, COLLAPSE_AFTER_ONSET),
        (
            f"strong shaking from {onset:.1f} s; leans {direction_name(a.tilt_direction)} from {a.leans_from_s:.1f} s"
            f" ({tilt:+.1f} s), exceeds 1/10 at {a.tilt_time_s:.1f} s, collapsed {a.collapse_time_s:.1f} s"
            f" ({fall:+.1f} s)"
        ),
    )


def does_not_collapse(run):
    return not run.collapsed, run_text(run)


def tilts_and_collapses_under_snow(a):
    if not a.collapsed or a.leans_from_s is None:
        return False, f"{outcome_text(a)}, {sway_text(a)}, {damage_text(a)}"
    holds = within(a.leans_from_s, (0.0, SNOW_TILT_BY)) and within(a.collapse_time_s, SNOW_COLLAPSE)
    lean = f"leans {direction_name(a.tilt_direction)} from {a.leans_from_s:.1f} s"
    return holds, f"{lean}, exceeds 1/10 at {a.tilt_time_s:.1f} s, collapsed {a.collapse_time_s:.1f} s"


def stands_still(run):
    still = max(sway(run, "ns"), sway(run, "ew")) < STILL and damage(run) == 0 and not run.collapsed
    return still, run_text(run)


def east_side_broken(b1):
    west = b1.broken.by_place["1"]["west"]
    holds = sways_in(b1, "ew", GREAT_SWAY) and west.column_beam > 0 and west.brace_beam == 0 and not b1.collapsed
    return (
        holds,
        f"{run_text(b1)}; storey 1 west: {west.column_beam} column-beam, {west.brace_beam} brace-beam joints broken",
    )


def south_side_broken(b2, b1):
    holds = sways_in(b2, "ns") and sway(b2, "ns") > sway(b1, "ns") and sway(b2, "ew") < sway(b1, "ew")
    return holds, f"B2 {sway_text(b2)}; B1 {sway_text(b1)}"


def sways_less(c1, b1):
    largest_c1, largest_b1 = (max(sway(run, "ns"), sway(run, "ew")) for run in (c1, b1))
    return sways_in(c1, "ew") and largest_c1 < largest_b1, f"C1 {sway_text(c1)}; B1 {sway_text(b1)}"


def very_stable(c2):
    return max(sway(c2, "ns"), sway(c2, "ew")) < GREAT_SWAY and not c2.collapsed, run_text(c2)


def snow_increases_damage(b1_snow, b1):
    holds = (not b1_snow.collapsed and lost_columns(b1_snow) > lost_columns(b1) and leaning(b1_snow) > leaning(b1)
             and more_damaged(b1_snow, b1))
    return holds, runs_text(b1_snow, b1)


def more_damage(snow, bare):
    return more_damaged(snow, bare), runs_text(snow, bare)


def more_damage_but_less_than(c1_snow, c1, b1_snow):
    return more_damaged(c1_snow, c1) and more_damaged(b1_snow, c1_snow), runs_text(c1_snow, c1, b1_snow)


def second_storey_leans(c2_snow, c2, b2_snow):
    holds = leaning(c2_snow, "storey2") > leaning(c2, "storey2") and more_damaged(b2_snow, c2_snow)
    return holds, runs_text(c2_snow, c2, b2_snow)


def within(seconds, limits):
    """Whether a time is within the limits, to the microsecond: YADE's clock, a sum of time steps, errs by some 1e-11 s.
    """
    return limits[0] <= round(seconds, 6) <= limits[1]


CLAIMS = {  # name -> (claim, check, runs that the check takes)
    "E1": ("A, earthquake: tilts when strong shaking sets in (N-S in the paper), has collapsed about 6 s later",
           tilts_and_collapses_when_shaken, ("modelA_quake",)),
    "E2": ("B, earthquake: does not collapse", does_not_collapse, ("modelB_quake",)),
    "E3": ("C, earthquake: does not collapse", does_not_collapse, ("modelC_quake",)),
    "S1": ("A, snow: tilts as soon as the run begins, has collapsed at about 12 s", tilts_and_collapses_under_snow,
           ("modelA_snow",)),
    "S2": ("B, snow: stands still", stands_still, ("modelB_snow",)),
    "S3": ("C, snow: stands still", stands_still, ("modelC_snow",)),
    "D1": (
        (
            "B1, earthquake: sways greatly E-W; on the first storey's west side column-beam joints break, brace-beam"
            " joints do not; no collapse"
        ),
        east_side_broken,
        ("modelB1_quake",),
    ),
    "D2": ("B2, earthquake: sways N-S; more damage N-S and less E-W than B1", south_side_broken,
           ("modelB2_quake", "modelB1_quake")),
    "D3": ("C1, earthquake: sways E-W, deforms less than B1", sways_less, ("modelC1_quake", "modelB1_quake")),
    "D4": ("C2, earthquake: very stable in both directions", very_stable, ("modelC2_quake",)),
    "Q1": ("B1, earthquake and snow: no collapse, but more columns fall, leans more, more damage than without snow",
           snow_increases_damage, ("modelB1_snow", "modelB1_quake")),
    "Q2": ("B2, earthquake and snow: more damage than without snow", more_damage, ("modelB2_snow", "modelB2_quake")),
    "Q3": ("C1, earthquake and snow: more damage than without snow, less than B1 with snow",
           more_damage_but_less_than, ("modelC1_snow", "modelC1_quake", "modelB1_snow")),
    "Q4": ("C2, earthquake and snow: second storey leans more than without snow; less damage than B2 with snow",
           second_storey_leans, ("modelC2_snow", "modelC2_quake", "modelB2_snow")),
}
RUNS = tuple(dict.fromkeys(run for _, _, runs in CLAIMS.values() for run in runs))
"""The paper's fourteen runs, in the order in which the claims first need them."""


def parse_run(run):
    """(house, earthquake, snow) of a published run: 'modelB1_snow' -> ('B1', True, True), 'modelB_snow' -> ('B', False,
    True).
    """
    house, kind = run[len("model"):].split("_")
    return house, kind == "quake" or house not in "ABC", kind == "snow"


def judge(summaries):
    """List of Result for every claim. summaries: {run name: content of its summary.json}; runs may be missing."""
    return [_judge_one(name, summaries) for name in CLAIMS]


def _judge_one(name, summaries):
    claim, check, needed = CLAIMS[name]
    missing = [run for run in needed if run not in summaries]
    if missing:
        return Result(name, claim, None, f"missing: {', '.join(missing)}")
    return Result(name, claim, *check(*(summaries[run] for run in needed)))

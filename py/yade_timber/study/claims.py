# SPDX-License-Identifier: GPL-2.0-or-later
"""What the paper says of its fourteen runs (sections 4.1-4.4), each claim as a check on the runs' summaries. Needs no YADE.

The criteria were fixed before the runs. Words are turned into numbers once, here:

damage            broken springs (four make a joint); damage that a house starts with does not count
leaning           horizontal residual drift of a storey, resultant of N-S and E-W; of a house: its worst storey
sway              largest peak drift of the storeys in a direction
sways in a way    the sway that way is the larger one and passes SWAY
lost columns      fallen (tilted by more than 45 degrees) or without a joint left
starts to tilt    last time before the tilt (drift 1/10) at which the drift was zero: from then on the house only leans one way
"""
import math
from dataclasses import dataclass

from ..recording.sentences import ratio

SWAY = 1 / 120
"""A sway that is seen and felt: drift at which Japanese practice takes a timber house for undamaged no longer. [-]"""
GREAT_SWAY = 1 / 30
"""A great sway: the safety limit of Japanese practice for timber houses. What stays below in both directions is 'very stable'. [-]"""
STILL = 1 / 120
"""A house stands still when no drift passes this and no spring breaks. [-]"""
TILT_AFTER_ONSET = (-1.0, 3.0)
"""E1: seconds from the onset of strong shaking to the start of the tilt. The paper gives whole seconds, and figures some seconds apart. [s]"""
COLLAPSE_AFTER_ONSET = (3.0, 9.0)
"""E1: the paper's 6 s, half as many and half as many again: another record of the same strength has its pulses elsewhere. [s]"""
SNOW_TILT_BY = 1.0
"""S1: 'as soon as the analysis began' is within the first second. [s]"""
SNOW_COLLAPSE = (6.0, 18.0)
"""S1: the paper's 12 s +- half: an instability that grows from a disturbance nobody knows takes longer with its logarithm. [s]"""


@dataclass(frozen=True)
class Result:
    """A claim, whether it holds, and the numbers that say so. holds: None when a run that it needs is missing."""

    name: str
    claim: str
    holds: object
    numbers: str


# --- numbers of one summary ---------------------------------------------------------------------------------------------


def sway(run, way):
    """Largest peak drift of the storeys in direction 'ns' or 'ew'. [-]"""
    return max(storey[way] or 0.0 for storey in run["peak_drift"].values())


def leaning(run, storey=None):
    """Residual drift of a storey ('storey2'), or of the worst one, resultant of both directions. [-]"""
    storeys = [run["residual_drift"][storey]] if storey else run["residual_drift"].values()
    return max(math.hypot(s["ns"] or 0.0, s["ew"] or 0.0) for s in storeys)


def damage(run):
    """Springs broken during the run."""
    return run["broken"]["springs"]


def lost_columns(run):
    return run["columns"]["fallen"] + run["columns"]["loose"]


def sways_towards(run, way, at_least=SWAY):
    """Whether a house sways in that direction more than in the other, and by `at_least` [-]."""
    other = {"ns": "ew", "ew": "ns"}[way]
    return sway(run, way) >= at_least and sway(run, way) > sway(run, other)


def worse(run, other):
    """Whether `run` is damaged more than `other`; a collapse is worse than none."""
    return (run["collapsed"], damage(run)) > (other["collapsed"], damage(other))


# --- the same in words ----------------------------------------------------------------------------------------------------


def drift_text(value):
    return ratio(value, "<")


def sway_text(run):
    return f"sway N-S {drift_text(sway(run, 'ns'))} E-W {drift_text(sway(run, 'ew'))}"


def lean_text(run):
    return " ".join(f"{name[len('storey'):]}: {drift_text(leaning(run, name))}" for name in run["residual_drift"])


def fate_text(run):
    return f"collapsed {time_text(run['collapse_time_s'])}" if run["collapsed"] else "stands"


def time_text(seconds):
    return "never" if seconds is None else f"{seconds:.1f} s"


def damage_text(run):
    broken = run["broken"]
    return f"{damage(run)} springs, {broken['total']} joints ({broken['column_beam']} column-beam, {broken['brace_beam']} brace-beam)"


def whole_text(run):
    """Everything that claims compare, of one run."""
    return f"{run['model']}{' + snow' if run['snow'] else ''}: {fate_text(run)}, {sway_text(run)}, leans {lean_text(run)}, {damage_text(run)}, {lost_columns(run)} columns lost"


def texts(*runs):
    return "; ".join(whole_text(run) for run in runs)


# --- claims: each takes the runs it names and returns (holds, numbers) ------------------------------------------------------


def tilts_and_falls_when_shaken(a):
    if not a["collapsed"] or a["leans_from_s"] is None:
        return False, f"{fate_text(a)}, {sway_text(a)}, {damage_text(a)}"
    onset = a["record"]["onset_s"]
    tilt, fall = a["leans_from_s"] - onset, a["collapse_time_s"] - onset
    holds = a["tilt_direction"] == "ns" and within(tilt, TILT_AFTER_ONSET) and within(fall, COLLAPSE_AFTER_ONSET)
    return holds, (
        f"strong shaking from {onset:.1f} s; leans {a['tilt_direction']} from {a['leans_from_s']:.1f} s ({tilt:+.1f} s), passes 1/10 at "
        f"{a['tilt_time_s']:.1f} s, collapsed {a['collapse_time_s']:.1f} s ({fall:+.1f} s)"
    )


def does_not_collapse(run):
    return not run["collapsed"], whole_text(run)


def tilts_and_falls_under_snow(a):
    if not a["collapsed"] or a["leans_from_s"] is None:
        return False, f"{fate_text(a)}, {sway_text(a)}, {damage_text(a)}"
    holds = within(a["leans_from_s"], (0.0, SNOW_TILT_BY)) and within(a["collapse_time_s"], SNOW_COLLAPSE)
    return holds, f"leans {a['tilt_direction']} from {a['leans_from_s']:.1f} s, passes 1/10 at {a['tilt_time_s']:.1f} s, collapsed {a['collapse_time_s']:.1f} s"


def stands_still(run):
    still = max(sway(run, "ns"), sway(run, "ew")) < STILL and damage(run) == 0 and not run["collapsed"]
    return still, whole_text(run)


def east_side_broken(b1):
    west = b1["broken"]["by_place"]["1"]["west"]
    holds = sways_towards(b1, "ew", GREAT_SWAY) and west["column_beam"] > 0 and west["brace_beam"] == 0 and not b1["collapsed"]
    return holds, f"{whole_text(b1)}; storey 1 west: {west['column_beam']} column-beam, {west['brace_beam']} brace-beam joints broken"


def south_side_broken(b2, b1):
    holds = sways_towards(b2, "ns") and sway(b2, "ns") > sway(b1, "ns") and sway(b2, "ew") < sway(b1, "ew")
    return holds, f"B2 {sway_text(b2)}; B1 {sway_text(b1)}"


def sways_less(c1, b1):
    largest_c1, largest_b1 = (max(sway(run, "ns"), sway(run, "ew")) for run in (c1, b1))
    return sways_towards(c1, "ew") and largest_c1 < largest_b1, f"C1 {sway_text(c1)}; B1 {sway_text(b1)}"


def very_stable(c2):
    return max(sway(c2, "ns"), sway(c2, "ew")) < GREAT_SWAY and not c2["collapsed"], whole_text(c2)


def snow_does_more(b1_snow, b1):
    holds = not b1_snow["collapsed"] and lost_columns(b1_snow) > lost_columns(b1) and leaning(b1_snow) > leaning(b1) and worse(b1_snow, b1)
    return holds, texts(b1_snow, b1)


def more_damage(snow, bare):
    return worse(snow, bare), texts(snow, bare)


def more_damage_but_less_than(c1_snow, c1, b1_snow):
    return worse(c1_snow, c1) and worse(b1_snow, c1_snow), texts(c1_snow, c1, b1_snow)


def second_storey_leans(c2_snow, c2, b2_snow):
    holds = leaning(c2_snow, "storey2") > leaning(c2, "storey2") and worse(b2_snow, c2_snow)
    return holds, texts(c2_snow, c2, b2_snow)


def within(seconds, limits):
    """To the microsecond: YADE's clock, a sum of steps, is some 1e-11 s off."""
    return limits[0] <= round(seconds, 6) <= limits[1]


CLAIMS = {  # name -> (words, check, runs that the check takes)
    "E1": ("A, earthquake: tilts N-S when strong shaking sets in, has collapsed about 6 s later", tilts_and_falls_when_shaken, ("modelA_quake",)),
    "E2": ("B, earthquake: does not collapse", does_not_collapse, ("modelB_quake",)),
    "E3": ("C, earthquake: does not collapse", does_not_collapse, ("modelC_quake",)),
    "S1": ("A, snow: tilts as soon as the run begins, has collapsed at about 12 s", tilts_and_falls_under_snow, ("modelA_snow",)),
    "S2": ("B, snow: stands still", stands_still, ("modelB_snow",)),
    "S3": ("C, snow: stands still", stands_still, ("modelC_snow",)),
    "D1": ("B1, earthquake: sways greatly E-W; on the first floor's west side column-beam joints break, brace-beam joints do not; no collapse", east_side_broken, ("modelB1_quake",)),
    "D2": ("B2, earthquake: sways N-S; more damage N-S and less E-W than B1", south_side_broken, ("modelB2_quake", "modelB1_quake")),
    "D3": ("C1, earthquake: sways E-W, deforms less than B1", sways_less, ("modelC1_quake", "modelB1_quake")),
    "D4": ("C2, earthquake: very stable in both directions", very_stable, ("modelC2_quake",)),
    "Q1": ("B1, earthquake and snow: no collapse, but more columns fall, leans more, more damage than without snow", snow_does_more, ("modelB1_snow", "modelB1_quake")),
    "Q2": ("B2, earthquake and snow: more damage than without snow", more_damage, ("modelB2_snow", "modelB2_quake")),
    "Q3": ("C1, earthquake and snow: more damage than without snow, less than B1 with snow", more_damage_but_less_than, ("modelC1_snow", "modelC1_quake", "modelB1_snow")),
    "Q4": ("C2, earthquake and snow: second storey leans more than without snow; less damage than B2 with snow", second_storey_leans, ("modelC2_snow", "modelC2_quake", "modelB2_snow")),
}
RUNS = tuple(dict.fromkeys(run for _, _, runs in CLAIMS.values() for run in runs))
"""The paper's fourteen runs, in its order but for what a claim compares with."""


def loads(run):
    """(house, earthquake, snow) of a published run: 'modelB1_snow' -> ('B1', True, True), 'modelB_snow' -> ('B', False, True)."""
    house, kind = run[len("model"):].split("_")
    return house, kind == "quake" or house not in "ABC", kind == "snow"


def judge(summaries):
    """List of Result for every claim. summaries: {run name: content of its summary.json}; runs may be missing."""
    return [_judge_one(name, summaries) for name in CLAIMS]


def _judge_one(name, summaries):
    words, check, needed = CLAIMS[name]
    missing = [run for run in needed if run not in summaries]
    if missing:
        return Result(name, words, None, f"missing: {', '.join(missing)}")
    return Result(name, words, *check(*(summaries[run] for run in needed)))

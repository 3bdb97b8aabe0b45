# SPDX-License-Identifier: GPL-2.0-or-later
"""Results as sentences for people. A summary is the content of summary.json. Needs no YADE."""
from . import verdict

DRIFT_LINES = tuple((limit.drift, limit.text) for limit in verdict.LIMITS)
"""Limits of storey drifts and their meaning. [-]"""
CONVERGED = 1e-6
"""Share of the energy put in that unconverged steps may lack without a remark. [-]"""
SMALL = 1e-3
"""Drifts below this are not distinguished. [-]"""


def largest_drift(found, key="peak_drift"):
    """(drift, storey, 'ns' | 'ew') of the largest drift under a key of a summary; zero where none is known.

    key: 'peak_drift', 'residual_drift' or 'final_amplitude'
    """
    drifts = found.get(key, {}).items()
    known = [(value, storey, direction) for storey, pair in drifts for direction, value in pair.items() if value is not None]
    return max(known, default=(0.0, "storey1", "ns"))


def sentence(found):
    """The verdict on a house and its reasons: drifts, other structures, joints, columns, snow. Of an ensemble's run first its outcomes.

    Of a town: the numbers of its houses by verdict.
    """
    if "verdicts" in found:
        return town(found)
    onset = missed_onset(found)
    early = "" if onset is None else f"the run ends before strong shaking sets in ({onset:.1f} s)"
    parts = (outcome(found), other_walls(found), weight(found), residual(found), structures(found), joints(found), columns(found), snow(found), record(found),
             early, unconverged(found))
    return f"{cut_off(found)}{ensemble(found)}House {found['model']} {'; '.join(filter(None, parts))}"


def cut_off(found):
    """'Cut off at 5.93 s, results until then: ' of a run whose numbers failed, else empty."""
    return f"Cut off at {found['duration_s']:.2f} s, not to be relied on: " if found.get("cut_off") else ""


def unconverged(found):
    """Steps that did not converge, if what they lack could be more than CONVERGED of the energy put in; else empty."""
    known, supplied = found.get("solver"), found.get("energy", {}).get("input", 0.0)
    if not known or known["unconverged_steps"] * known["worst_change_j"] <= CONVERGED * supplied:
        return ""
    return f"{known['unconverged_steps']} steps did not converge (largest change {known['worst_change_j']:.2g} J)"


def missed_onset(found):
    """Onset of the strong shaking of a run that ends before it [s], else None."""
    onset = (found.get("record") or {}).get("onset_s")
    return onset if onset and found.get("duration_s", onset) < onset else None


def collapse_time(found):
    """Time at which a house collapsed [s]; None without, and for a town, which has none of its own."""
    return None if "verdicts" in found else found.get("collapse_time_s")


def first_time(found, kind):
    """Time of the first event of a kind [s], or None."""
    return next((event["time_s"] for event in found.get("events", []) if event["kind"] == kind), None)


def weight(found):
    """Damage before the shaking, which an event describes; without an earthquake the cause of the damage. Empty for a house without damage."""
    if found.get("earthquake", True):
        return next((event["what"] for event in found.get("events", []) if event["kind"] == "own_weight"), "")
    return f"damaged by {own_weight(found['snow'])}" if verdict.judge(main_structure(found)) != verdict.UNDAMAGED else ""


def own_weight(has_snow):
    """'its own weight and snow'."""
    return "its own weight" + " and snow" * has_snow


def ensemble(found):
    """'Run 7 of 16 (12 unsafe, 4 collapsed; peak drift 1/14 to 1/8 in those that stand). ' of a run that is shown for an ensemble, else empty."""
    known = found.get("ensemble")
    if not known:
        return ""
    outcomes = ", ".join(f"{number} {state}" for state, number in known["outcomes"].items())
    drifts = known["peak_drift_standing"]
    standing = " in those that stand" * (verdict.COLLAPSED in known["outcomes"])
    return f"{place_in_ensemble(found)} ({outcomes}{f'; peak drift {span(*map(ratio, drifts))}{standing}' if drifts else ''}). "


def place_in_ensemble(found):
    """'Run 7 of 16' of a run that is shown for an ensemble, else empty."""
    known = found.get("ensemble")
    return f"Run {known['run']} of {known['runs']}" if known else ""


def town(found):
    """'Town harbour: 6 houses, 3 undamaged, 2 unsafe, 1 collapsed'. found: summary of a town"""
    counts = [f"{found['verdicts'].count(state)} {state}" for state in verdict.STATES if state in found["verdicts"]]
    return "; ".join(filter(None, (f"Town {found['model']}: {len(found['verdicts'])} houses, {', '.join(counts)}", record(found))))


def main_structure(found):
    """Facts of the main structure, on which its verdict rests: the first entry of `structures`."""
    known = found.get("structures")
    if known:
        return next(iter(known.values()))
    broken, lost = found["broken"], found.get("columns", {"fallen": 0, "loose": 0})
    facts = {"peak_drift": largest_drift(found)[0], "residual_drift": largest_drift(found, "residual_drift")[0], "collapsed": found["collapsed"]}
    return {**facts, "broken": broken["total"], "partly_broken": broken.get("partly_broken", 0), "columns_lost": lost["fallen"] + lost["loose"]}


def outcome(found):
    """Verdict on the main structure, with its peak storey drift."""
    facts = main_structure(found)
    if found["collapsed"]:
        tilt, end = found["tilt_time_s"], f"collapsed at {found['collapse_time_s']:.1f} s"
        return end if tilt is None else f"{end}, after a storey drift of 1/10 {direction_name(found['tilt_direction'])} at {tilt:.1f} s"
    drift, storey, direction = largest_drift(found)
    peak = f"{directed(drift, direction)} in storey {storey[len('storey'):]}" if drift >= SMALL else ratio(drift)
    limit = verdict.passed(drift)
    meaning = f"beyond the {limit.name} of {ratio(limit.drift)}" if limit else f"below the {verdict.DAMAGE.name} of {ratio(verdict.DAMAGE.drift)}"
    lean = " and leans at the end" if verdict.leans(facts) else ""
    return f"is {verdict.judge(facts)}{lean}: peak storey drift {peak}, {meaning}"


def other_walls(found):
    """'with walls of the level design collapsed' where the verdict depends on the level of the walls."""
    other = (found.get("walls") or {}).get("other")
    if not other or other["verdict"] == verdict.judge(main_structure(found)):
        return ""
    return f"with walls of the level {other['level']} {other['verdict']}"


def residual(found):
    """Residual drift after a peak beyond the damage limit, amplitude of the motion that remains."""
    parts = []
    drift, _, direction = largest_drift(found, "residual_drift")
    if not found["collapsed"] and largest_drift(found)[0] >= verdict.DAMAGE.drift:
        parts.append(f"residual drift {directed(drift, direction)}")
    if found.get("still_moving") and not found["collapsed"]:
        amplitude, _, direction = largest_drift(found, "final_amplitude")
        parts.append(f"still moving by ±{directed(amplitude, direction)}")
    return ", ".join(parts)


def structures(found):
    """Verdicts on the structures other than the main one, unless they are undamaged."""
    known = list(found.get("structures", {}).items())[1:]
    return ", ".join(filter(None, (structure(name, facts, found) for name, facts in known)))


def structure(name, facts, found):
    """Verdict on a structure other than the main one: 'entrance collapsed at 21.3 s'; empty if it is undamaged."""
    state = verdict.judge(facts)
    if state == verdict.COLLAPSED:
        time = fall_time(name, found)
        return f"{name} {state}" + ("" if time is None else f" at {time:.1f} s")
    lean = " and leans" if verdict.leans(facts) else ""
    return "" if state == verdict.UNDAMAGED else f"{name} {state}{lean} (peak drift {ratio(facts['peak_drift'])})"


def fall_time(name, found):
    """Time at which a structure other than the main one fell; None if it is not recorded. [s]"""
    falls = (event for event in found.get("events", []) if event["kind"] == "structure_fallen")
    return next((event["time_s"] for event in falls if event["what"].startswith(f"{name} has fallen")), None)


def joints(found):
    """Broken and partly broken joints and wall sheets."""
    broken = found["broken"]
    text = broken_of(*joints_and_sheets(found))
    partly = broken.get("partly_broken", 0) + broken.get("wall_sheets_partly", 0)
    if partly:
        text += f", {partly} partly"
    if broken["damaged_at_start"]["total"]:
        text += f" ({broken['damaged_at_start']['total']} more from the start)"
    return text


def joints_and_sheets(found):
    """((broken, all) of the joints, (broken, all) of the wall sheets) of a summary; (0, 0) in a house without walls."""
    counts = found["broken"], found["joints"]
    return tuple(tuple(part.get(key, 0) for part in counts) for key in ("total", "wall_sheets"))


def broken_of(joints, sheets, of=" of "):
    """'3 of 412 joints and 2 of 16 wall sheets broken' from pairs (broken, all); sheets only where there are some. of: between two numbers"""
    walls = f" and {sheets[0]}{of}{counted(sheets[1], 'wall sheet')}" if sheets[1] else ""
    return f"{joints[0]}{of}{joints[1]} joints{walls} broken"


def columns(found):
    """Fallen and loose columns, if any, and the time of the first loss."""
    counts = found.get("columns", {"total": 0, "fallen": 0, "loose": 0})
    texts = [f"{counts[kind]} {kind}" for kind in ("fallen", "loose") if counts[kind]]
    first = first_time(found, "columns_lost")
    since = "" if first is None else f", the first at {first:.1f} s"
    return f"{' and '.join(texts)} of {counts['total']} columns{since}" if texts else ""


def snow(found):
    """Mass of the snow, and whether some has fallen."""
    if not found["snow"]:
        return ""
    first = first_time(found, "snow_fallen")
    return f"snow {found['snow_mass_kg'] / 1000:.1f} t" + ("" if first is None else f", falling from {first:.1f} s")


def record(found):
    """Constant part of the record, if it has one."""
    note = (found.get("record") or {}).get("note")
    return f"the record's {note}" if note else ""


def direction_name(key):
    """'ns' -> 'N-S'."""
    return {"ns": "N-S", "ew": "E-W"}.get(key, key)


def counted(number, noun):
    """'1 run', '3 runs'."""
    return f"{number} {noun}{'s' * (number != 1)}"


def span(low, high):
    """'1/14 to 1/8' from two texts, one of them where they are the same."""
    return low if low == high else f"{low} to {high}"


def directed(drift, direction):
    """'1/85 N-S', without a direction below SMALL."""
    return f"{ratio(drift)} {direction_name(direction)}" if drift >= SMALL else ratio(drift)


def ratio(drift, below="below "):
    """A drift in the notation of engineers: 1/85."""
    if drift < SMALL:
        return f"{below}1/1000"
    return f"1/{round(1 / drift)}" if drift <= 0.5 else f"{drift:.2f}"


def joint_place(kind, storey, side):
    """'column-beam joint, storey 1, west side' from the values of breaks.csv."""
    walls = side if side == "inside" else f"{side.replace('+', ' and ')} side{'s' * ('+' in side)}"
    return f"{kind.replace('_', '-')} joint, {f'storey {storey}' if storey.isdigit() else storey}, {walls}"

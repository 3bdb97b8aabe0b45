# SPDX-License-Identifier: GPL-2.0-or-later
"""Results as sentences for people. A summary is the content of summary.json. Needs no YADE."""

DRIFT_LINES = ((1 / 120, "1/120 damage begins"), (1 / 30, "1/30 heavy damage"), (1 / 10, "1/10 leaning"))
"""Storey drifts of engineering practice and their meaning. [-]"""
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
    """One sentence about a summary: outcome, peak and residual drift, other structures, joints, columns, snow."""
    onset = (found.get("record") or {}).get("onset_s")
    early = f"the run ends before strong shaking sets in ({onset:.1f} s)" if onset and found.get("duration_s", onset) < onset else ""
    parts = (outcome(found), residual(found), structures(found), joints(found), columns(found), snow(found), early)
    return f"House {found['model']} {'; '.join(filter(None, parts))}"


def outcome(found):
    """Whether the house stands at the end, with its peak storey drift."""
    drift, storey, direction = largest_drift(found)
    if found["collapsed"]:
        tilt, end = found["tilt_time_s"], f"collapses at {found['collapse_time_s']:.1f} s"
        return end if tilt is None else f"{end}, after a storey drift of 1/10 {direction_name(found['tilt_direction'])} at {tilt:.1f} s"
    peak = f"{directed(drift, direction)} in storey {storey[len('storey'):]}" if drift >= SMALL else ratio(drift)
    if largest_drift(found, "residual_drift")[0] >= DRIFT_LINES[-1][0]:
        return f"leans at the end: peak storey drift {peak}"
    passed = [line for line, _ in DRIFT_LINES if drift >= line]
    if not passed:
        return f"stands: peak storey drift {peak}"
    level = "1/120: damage begins" if len(passed) == 1 else "1/30: heavy damage"
    return f"stands after a peak storey drift of {peak} ({level})"


def residual(found):
    """Residual drift after a peak beyond 1/120, amplitude of the motion that remains."""
    parts = []
    drift, _, direction = largest_drift(found, "residual_drift")
    if not found["collapsed"] and largest_drift(found)[0] >= DRIFT_LINES[0][0]:
        parts.append(f"residual drift {directed(drift, direction)}")
    if found.get("still_moving"):
        amplitude, _, direction = largest_drift(found, "final_amplitude")
        parts.append(f"still moving by ±{directed(amplitude, direction)}")
    return ", ".join(parts)


def structures(found):
    """Other structures that have fallen or lean; the main one has fallen when the house has collapsed."""
    fallen = [name for name in found.get("fallen_structures", []) if not (found["collapsed"] and name == "main")]
    groups = ((fallen, "fallen"), (found.get("leaning_structures", []), "leaning"))
    return ", ".join(f"{' and '.join(names)} {state}" for names, state in groups if names)


def joints(found):
    """Broken and partly broken joints."""
    broken = found["broken"]
    text = f"{broken['total']} of {found['joints']['total']} joints broken"
    if broken.get("partly_broken"):
        text += f", {broken['partly_broken']} partly"
    if broken["damaged_at_start"]["total"]:
        text += f" ({broken['damaged_at_start']['total']} more from the start)"
    return text


def columns(found):
    """Fallen and loose columns, if any."""
    counts = found.get("columns", {"total": 0, "fallen": 0, "loose": 0})
    texts = [f"{counts[kind]} {kind}" for kind in ("fallen", "loose") if counts[kind]]
    return f"{' and '.join(texts)} of {counts['total']} columns" if texts else ""


def snow(found):
    """Mass of the snow, and whether some has fallen."""
    if not found["snow"]:
        return ""
    first = next((event["time_s"] for event in found.get("events", []) if event["kind"] == "snow_fallen"), None)
    return f"snow {found['snow_mass_kg'] / 1000:.1f} t" + ("" if first is None else f", falling from {first:.1f} s")


def direction_name(key):
    """'ns' -> 'N-S'."""
    return {"ns": "N-S", "ew": "E-W"}.get(key, key)


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

# SPDX-License-Identifier: GPL-2.0-or-later
"""Results in plain words. A summary is the content of summary.json. Needs no YADE."""

DRIFT_LINES = ((1 / 120, "1/120 damage begins"), (1 / 30, "1/30 heavy damage"), (1 / 10, "1/10 leaning"))
"""Storey drifts that engineers know. [-]"""


def largest_drift(found):
    """(drift, storey, 'ns' | 'ew') of the largest peak drift in a summary; zero before the first sample."""
    known = [(value, storey, way) for storey, ways in found["peak_drift"].items() for way, value in ways.items() if value is not None]
    return max(known, default=(0.0, "storey1", "ns"))


def sentence(found):
    """One plain sentence about a summary, for people."""
    broken = f"{found['broken']['total']} of {found['joints']['total']} joints broken"
    if found["broken"]["damaged_at_start"]["total"]:
        broken += f" ({found['broken']['damaged_at_start']['total']} more from the start)"
    if found["snow"]:
        broken += f", snow {found['snow_mass_kg'] / 1000:.1f} t"
    fallen = [] if found["collapsed"] else found.get("fallen_structures", [])
    others = [f", {' and '.join(names)} {what}" for names, what in ((fallen, "down"), (found.get("leaning_structures", []), "leaning")) if names]
    onset = (found.get("record") or {}).get("onset_s")
    early = f"; the run ends before strong shaking sets in ({onset:.1f} s)" if onset and found.get("duration_s", onset) < onset else ""
    return f"House {found['model']} {fate(found)}{''.join(others)}, {broken}{early}"


def fate(found):
    """What became of the house, in words."""
    tilt = found["tilt_time_s"]
    leaning = "" if tilt is None else f"leans {direction_name(found['tilt_direction'])} by 1/10 at {tilt:.1f} s"
    if found["collapsed"]:
        return f"{leaning or 'stands'} and collapses at {found['collapse_time_s']:.1f} s"
    drift, storey, way = largest_drift(found)
    place = f"largest storey drift {ratio(drift)} {direction_name(way)} in storey {storey[len('storey'):]}"
    return f"{leaning} but does not collapse: {place}" if leaning else f"stands: {place}"


def direction_name(key):
    """'ns' -> 'N-S'."""
    return {"ns": "N-S", "ew": "E-W"}.get(key, key)


def ratio(drift, below="below "):
    """A drift as people of the trade write it: 1/85."""
    if drift < 1e-3:
        return f"{below}1/1000"
    return f"1/{round(1 / drift)}" if drift <= 0.5 else f"{drift:.2f}"

# SPDX-License-Identifier: GPL-2.0-or-later
"""The result of a run in up to ten lines, for the report. A summary is the content of summary.json. Needs no YADE."""
from ..base.gravity import weight_of
from . import verdict
from .history import DIRECTIONS
from .quantities import BAND_TEXT
from .sentences import directed, direction_name, fall_time, joints, largest_drift, ratio

MOST = 10
"""Number of lines."""
EVENTS = 3
"""Number of lines that events may take from others; those of an earlier kind in the next list come first."""
IMPORTANT = ("own_weight", "collapse", "tilt", "structure_fallen", "snow_fallen", "columns_lost", "first_break")


def lines(found):
    """Up to MOST lines about a summary with `structures` and `quantities`: verdicts, drifts, joints, forces, periods, uplift; then events."""
    fixed = [*verdicts(found), drifts(found), f"{joints(found)}.", forces(found), periods(found), *pulls(found), accelerations(found)]
    fixed = [line for line in fixed if line][:MOST - min(EVENTS, len(found["events"]))]
    return fixed + events(found, MOST - len(fixed))


def verdicts(found):
    """'main: unsafe: peak drift 1/13 reaches the safety limit of 1/30.' for each structure."""
    for name, facts in found["structures"].items():
        if facts["collapsed"]:
            yield f"{name.capitalize()}: {fall(name, found)}."
            continue
        limit = verdict.passed(facts["peak_drift"])
        reason = f"peak drift {ratio(facts['peak_drift'])}" + (f" reaches the {limit.name} of {ratio(limit.drift)}" if limit else "")
        lost = facts["columns_lost"]
        columns = f"; {lost} column{'s' * (lost != 1)} lost" if lost else ""
        lean = ", leans" if facts["leans"] else ""
        yield f"{name.capitalize()}: {facts['verdict']}{lean}; {reason}{columns}."


def fall(name, found):
    """'collapsed at 5.8 s, 1.5 s after a storey drift of 1/10 E-W'."""
    main = name == next(iter(found["structures"]))
    time, tilt = (found["collapse_time_s"], found["tilt_time_s"]) if main else (fall_time(name, found), None)
    at = "" if time is None else f" at {time:.1f} s"
    after = "" if tilt is None or time is None else f", {time - tilt:.1f} s after a storey drift of 1/10 {direction_name(found['tilt_direction'])}"
    return f"collapsed{at}{after}"


def drifts(found):
    """Peak and residual drift of the main structure; empty for a collapsed one."""
    if found["collapsed"]:
        return ""
    peak, storey, direction = largest_drift(found)
    left, _, side = largest_drift(found, "residual_drift")
    moving = "; still moving at the end" if found["still_moving"] else ""
    return f"Largest storey drift {directed(peak, direction)} in storey {storey[len('storey'):]}, residual drift {directed(left, side)}{moving}."


def forces(found):
    """Base shear, also as a share of the weight; of a house that has collapsed, before its fall began."""
    known = found["quantities"]
    weight = 1e3 * weight_of(known["mass_kg"])  # [N]
    sustained, peak = known["base_shear"]["sustained"], known["base_shear"]["peak"]
    shears = ", ".join(f"{direction_name(axis)} {force / 1e3:.0f} kN ({force / weight:.2f} of the weight)" for axis, force in sustained.items())
    until = known.get("until_s")
    before = "" if until is None else f" before {until:.2f} s"
    return f"Largest base shear{before}, mean over 0.1 s: {shears}; peak {max(peak.values()) / 1e3:.0f} kN."


def accelerations(found):
    """Largest horizontal acceleration of any level."""
    storeys = found["quantities"]["storeys"]
    values = [(value, name, axis) for name, storey in storeys.items() for axis, value in storey["acceleration"].items() if axis != "ud"]
    if not values:
        return ""
    value, name, axis = max(values)
    return f"Largest floor acceleration ({BAND_TEXT}) {value:.1f} m/s² {direction_name(axis)}, above storey {name[len('storey'):]}."


def pulls(found):
    """Largest pull of a joint, and the largest uplift of a column that stands."""
    known = found["quantities"]
    if known["largest_pull"]:
        yield f"Largest pull of a joint {known['largest_pull']['force'] / 1e3:.1f} kN ({known['largest_pull']['joint'].replace('|', ' and ')})."
    if known["largest_uplift"] and known["largest_uplift"]["uplift_m"] >= 1e-4:
        yield f"Largest uplift of a standing column {1e3 * known['largest_uplift']['uplift_m']:.0f} mm ({known['largest_uplift']['column']})."


def periods(found):
    """Main natural periods before and after the run."""
    texts = []
    for when in ("before", "after"):
        known = [f"{direction_name(axis)} {period_text(mode)}" for axis in DIRECTIONS if (mode := main_mode(found, when, axis))]
        texts += [f"{when} the run {', '.join(known)}"] if known else []
    return f"Natural periods {'; '.join(texts)}." if texts else ""


def main_mode(found, when, direction):
    """The mode 'before' or 'after' the run that moves most of the mass in a direction, None without one."""
    modes = ((found.get("quantities") or {}).get("modes", {}).get(when) or {"modes": []})["modes"]
    return max((mode for mode in modes if mode["direction"] == direction), key=lambda mode: mode["mass_share"][direction], default=None)


def period_text(mode):
    """'0.31 s', or 'unstable'."""
    return "unstable" if mode["period_s"] is None else f"{mode['period_s']:.2f} s"


def events(found, most):
    """The most important events in the order of time."""
    known = sorted(found["events"], key=lambda event: (IMPORTANT.index(event["kind"]) if event["kind"] in IMPORTANT else len(IMPORTANT), event["time_s"]))
    return [f"{event['time_s']:.2f} s: {event['what']}." for event in sorted(known[:most], key=lambda event: event["time_s"])]

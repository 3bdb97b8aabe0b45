# SPDX-License-Identifier: GPL-2.0-or-later
"""The result of a run in up to ten lines, for the report."""
from ..base.gravity import weight_of
from ..recording import verdict
from ..recording.history import DIRECTIONS
from ..recording.quantities import BAND_TEXT
from .english import (at, counted, directed, direction_name, event, joints, mode_name, period_text, ratio,
                      residual_name, storey_name)

MOST = 10  # number of lines
EVENTS = 3  # number of lines that events may take from others; those of an earlier kind in the next list come first
IMPORTANT = ("own_weight", "collapse", "tilt", "structure_fallen", "snow_fallen", "columns_lost", "first_break")


def lines(summary):
    """Up to MOST lines: verdicts, drifts, joints, forces, periods, uplift; then events."""
    fixed = [*verdicts(summary), drifts(summary), f"{joints(summary)}.", forces(summary.quantities), periods(summary),
             *pulls(summary.quantities), accelerations(summary.quantities)]
    fixed = [line for line in fixed if line][:MOST - min(EVENTS, len(summary.events))]
    return fixed + events(summary, MOST - len(fixed))


def verdicts(summary):
    """'Main: unsafe; peak drift 1/13 reaches the safety limit of 1/30.' for each structure."""
    for name, facts in summary.structures.items():
        if facts.collapsed:
            yield f"{name.capitalize()}: {fall(name, summary)}."
            continue
        peak = max(facts.peak_drift, facts.column_drift)
        limit = verdict.passed(peak)
        reason = f"peak drift {ratio(peak)}{' at a column' * (peak > facts.peak_drift)}"
        reason += f" reaches the {limit.name} of {ratio(limit.drift)}" if limit else ""
        if facts.verdict == verdict.TOTAL_LOSS:
            reason = f"residual drift {ratio(facts.residual_drift)} reaches the {verdict.LOSS.text}"
        columns = f"; {counted(facts.columns_lost, 'column')} lost" if facts.columns_lost else ""
        yield f"{name.capitalize()}: {facts.verdict}{', leans' if facts.leans else ''}; {reason}{columns}."


def fall(name, summary):
    """'collapsed at 5.8 s, 1.5 s after a storey drift of 1/10 E-W'."""
    main = name == next(iter(summary.structures))
    time, tilt = (summary.collapse_time_s, summary.tilt_time_s) if main else (summary.fall_time(name), None)
    since = ("" if tilt is None or time is None
             else f", {time - tilt:.1f} s after a storey drift of {verdict.TILT.ratio}"
             f" {direction_name(summary.tilt_direction)}")
    return f"collapsed{at(time)}{since}"


def drifts(summary):
    """Peak and residual drift of the main structure; empty for a collapsed one."""
    if summary.collapsed:
        return ""
    peak, storey, direction = summary.largest_drift()
    drift, _, side = summary.largest_drift("residual_drift")
    moving = "; still moving at the end" if summary.still_moving else ""
    columns = ""
    if summary.largest_at_columns:
        at_column, _, axis, median = summary.largest_at_columns
        columns = f" of the centre, {directed(at_column, axis)} at a column (median {ratio(median)})"
    return (f"Largest storey drift {directed(peak, direction)} in {storey_name(storey)}{columns},"
            f" {residual_name(summary)} {directed(drift, side)}{moving}.")


def forces(quantities):
    """Base shear, also as a share of the weight; of a house that has collapsed, before its fall began."""
    weight = 1e3 * weight_of(quantities.mass_kg)  # [N]
    sustained, peak = quantities.base_shear.sustained, quantities.base_shear.peak
    shears = ", ".join(f"{direction_name(axis)} {force / 1e3:.0f} kN ({force / weight:.2f} of the weight)"
                       for axis, force in sustained.items())
    return f"Largest base shear{before(quantities)}, mean over 0.1 s: {shears}; peak {max(peak.values()) / 1e3:.0f} kN."


def before(quantities):
    """' before 4.28 s' of a house that has collapsed, else empty."""
    return "" if quantities.until_s is None else f" before {quantities.until_s:.2f} s"


def accelerations(quantities):
    values = [(storey.acceleration[axis], name, axis) for name, storey in quantities.storeys.items()
              for axis in storey.acceleration if axis != "ud"]
    if not values:
        return ""
    value, name, axis = max(values)
    return (f"Largest floor acceleration ({BAND_TEXT}) {value:.1f} m/s² {direction_name(axis)}, above"
            f" {storey_name(name)}.")


def pulls(quantities):
    """Largest pull of a joint, and the largest uplift of a column that stands."""
    pull, uplift = quantities.largest_pull, quantities.largest_uplift
    if pull:
        yield f"Largest pull of a joint {pull.force / 1e3:.1f} kN ({pull.joint.replace('|', ' and ')})."
    if uplift and uplift.uplift_m >= 1e-4:
        yield f"Largest uplift of a standing column {1e3 * uplift.uplift_m:.0f} mm ({uplift.column})."


def periods(summary):
    """Main natural periods of small vibrations before and after the run."""
    texts = []
    for when in ("before", "after"):
        parts = [f"{mode_name(mode)} {period_text(mode)}" for axis in DIRECTIONS
                 if (mode := summary.main_mode(when, axis))]
        texts += [f"{when} the run {', '.join(parts)}"] if parts else []
    return f"Natural periods of small vibrations {'; '.join(texts)}." if texts else ""


def events(summary, most):
    chosen = sorted(summary.events, key=lambda one: (IMPORTANT.index(one.kind), one.time_s))[:most]
    return [f"{one.time_s:.2f} s: {event(one)}." for one in sorted(chosen, key=lambda one: one.time_s)]

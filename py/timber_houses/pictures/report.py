# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of a run on one A4 page: report.html, self-contained, and report.pdf where Chromium is installed."""
import os
import shlex
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from ..base.atomic_write import write_text, written_whole
from ..base.errors import RunError
from ..base.gravity import weight_of
from ..base.html import embedded, html
from ..base.joint_kinds import WALL_COLUMN
from ..base.options import words
from ..motion import GroundMotion, pga, pgv
from ..motion.measures import stated_intensity
from ..recording import frames as recording
from ..recording import verdict
from ..recording.failures import first_failures, place
from ..text.english import counted, directed, mode_name, period_text, sentence, storey_name
from ..text.lines import before, lines
from . import REPORT, VERDICTS, quantities, report_pictures
from .figures import image_of, png
from .sheets import Stills

PAGE, PDF = REPORT
JOINTS_SHOWN = 6
"""Rows of the table of joints."""
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
PATIENCE = 120.0
"""Longest wait for the browser. [s]"""


def write(folder, stills=None):
    """Write report.html, and report.pdf if there is a browser, into a run's folder; returns the paths. RunError.

    stills: of the run, else made from its frames
    """
    folder = Path(folder)
    write_text(folder / PAGE, page(stills or Stills(recorded(folder))))
    return [folder / PAGE, *print_pdf(folder / PAGE, folder / PDF)]


def recorded(folder):
    """Frames of the ended run in a folder. Raises RunError."""
    path = folder / recording.NAME
    frames = recording.load(path, missing="the report needs the frames of a finished run without --no-frames")
    if frames.summary is None:
        raise RunError(f"{path}: of a run that has not ended; continue it with --resume")
    if frames.peaks is None:
        raise RunError(f"{path}: of a town, which has reports of its lots, or of another version")
    return frames


def page(stills):
    """Text of the page of an ended run."""
    frames, summary = stills.frames, stills.frames.summary
    failures = first_failures(frames) if summary.collapsed else []
    return html(
        "report.html",
        title=frames.title,
        color=VERDICTS[summary.verdict],
        sentence=sentence(summary),
        house=house(frames, summary, failures),
        plans=picture(report_pictures.plans(frames, failures)),
        motion=motion(frames, summary),
        spectra=picture(report_pictures.motion(frames)) if frames.motion else None,
        periods=summary.quantities.modes.before is not None,
        until=before(summary.quantities),
        pushover=pushover_picture(summary),
        storeys=storeys(summary),
        shots=picture(*report_pictures.shots(stills)),
        lines=lines(summary),
        failures=failed_joints(frames, failures),
        others=others(frames) if failures else None,
        joints=joints(frames),
        at_strength=at_strength(frames),
        limits=(*verdict.LIMITS, verdict.LOSS),
        summary=summary,
        command=command(summary.made_from["options"]),
    )


def picture(figure, cut=0.0):
    """A figure without its upper part of a height [inch], as the address of an image."""
    page = image_of(figure)
    shown = page.crop((0, round(cut * figure.dpi), *page.size))
    return embedded(png(shown, figure.dpi), "png")


def pushover_picture(summary):
    """Pushover curves of the main structure; None without walls and braces, or in an earlier run's summary."""
    name = next(iter(summary.structures))
    structure = summary.diagnosis.structures.get(name)
    drawn = structure and report_pictures.pushover(name, structure)
    return picture(drawn) if drawn else None


# --- parts of the page ------------------------------------------------------------------------------------------------


def house(frames, summary, failures):
    """Meaning of the marks in the plans, numbers of members, weight, natural periods, seismic index."""
    kinds = frames.elements.kind
    counts = {"column": kinds.count("column"), "brace": kinds.count("brace"),
              "walled bay": len({*zip(frames.sheets.low, frames.sheets.high)})}
    (_, counts["joint"]), (_, counts["wall sheet"]) = summary.joints_and_sheets
    numbers = ", ".join(counted(count, kind) for kind, count in counts.items() if count)
    marks = {"blue: braces (thin end: foot)": counts["brace"],
             "green: walls (dotted: with an opening)": counts["walled bay"],
             "orange: joints broken from the start": any(frames.joints.damaged),
             "numbers: first failures": failures}
    legend = "; ".join(["Plans, north up", *(mark for mark, occurs in marks.items() if occurs)])
    periods = ", ".join(f"{mode_name(mode)} {period_text(mode)}" for axis in ("ns", "ew")
                        if (mode := summary.main_mode("before", axis)))
    index = f"By the diagnosis of engineers: {summary.diagnosis.sentence}. {summary.diagnosis.disagreement}"
    walls = f" {sentence_of_walls(summary)}." if summary.walls else ""
    natural = f" Natural periods of small vibrations {periods}." if periods else ""
    return f"{legend}. {numbers}. {weight(summary.weight)}{walls}{natural} {index}"


def sentence_of_walls(summary):
    """'Walls of the level mean; the verdict with design walls is the same'."""
    level, other = summary.walls.level, summary.walls.other
    same = "the same" if other and other.verdict == summary.main.verdict else other and other.verdict
    return f"Walls of the level {level}" + (f"; the verdict with {other.level} walls is {same}" if other else "")


def storeys(summary):
    """Rows of the table of the storeys: weight above and shear."""
    return [
        {"name": storey_name(name), "weight": f"{weight_of(storey.mass_above_kg):.0f} kN",
         "shear": ", ".join("-" if value is None else f"{value:.2f}" for value in storey.shear_coefficient.values())}
        for name, storey in summary.quantities.storeys.items()
    ]


def weight(weights):
    """'Weight 83 kN, 0.70 kN per m² of 119 m² of floor; snow 59 kN.' of a Weight."""
    per_area = ("" if weights.per_floor_area_kn_m2 is None
                else f", {weights.per_floor_area_kn_m2:.2f} kN per m² of {weights.floor_area_m2:.0f} m² of floor")
    snow = f"; snow {weights.snow_kn:.0f} kN" if weights.snow_kn else ""
    return f"Weight {weights.total_kn:.0f} kN{per_area}{snow}."


def motion(frames, summary):
    """Record, peaks and intensity of the ground motion; None without an earthquake."""
    if frames.motion is None:
        return None
    applied = GroundMotion(frames.motion.dt, frames.motion.acceleration)
    peaks = ", ".join(f"{name} {pga(applied, key):.0f}"
                      for name, key in (("N-S", "ns"), ("E-W", "ew"), ("up-down", "ud")))
    intensity = stated_intensity(applied)
    stated = "" if intensity is None else f", JMA intensity {intensity:.1f}"
    scale = f", times {summary.record.scale:g}" if summary.record.scale != 1 else ""
    return f"{summary.record.source}{scale}: PGA {peaks} gal, PGV {pgv(applied):.0f} cm/s{stated}."


def joints(frames):
    """Rows of the table of the joints nearest to failure."""
    units = {"load": (1, 2), "pull": (1e-3, 1), "shear": (1e-3, 1), "opening": (1e3, 0)}
    states = [state.replace("whole", "") for state in frames.joint_states(-1)]
    return [{"joint": joint_name(frames.joints.name[k]), "state": states[k],
             "numbers": [f"{factor * frames.peaks[name][k]:.{digits}f}" for name, (factor, digits) in units.items()]}
            for k in quantities.nearest_to_failure(frames, JOINTS_SHOWN)]


def at_strength(frames):
    """'27 of 412 joints, those of walls included, have reached their strength: 3 broken, 20 partly.'"""
    states, load = frames.joint_states(-1), frames.peaks["load"]
    reached = [str(states[k]) for k in quantities.by_load(frames) if load[k] >= quantities.FULL]
    counts = ", ".join(f"{reached.count(state)} {state}" for state in dict.fromkeys(reached) if state != "whole")
    walls = ", those of walls included," if len(frames.sheets.low) else ""
    return f"{len(reached)} of {len(load)} joints{walls} have reached their strength{f': {counts}' if counts else ''}."


def failed_joints(frames, failures):
    """Rows of the table of the first failures of a house that has collapsed; forces are the largest of their joints."""
    joint, rows = frames.joints, []
    for failure in failures:
        number, more, mine = failure.joints[0], len(failure.joints) - 1, list(failure.joints)
        bay, material = place(frames, number)
        bay = bay.partition(".")[2] if joint.storey[number].isdigit() else bay  # of the main structure
        kind = "" if joint.kind[number] == WALL_COLUMN else f"{joint.kind[number].replace('_', '-')}, "
        rows.append({
            "time": f"{failure.time:.2f}",
            "joint": ", ".join(joint_name(joint.name[each]) for each in mine),
            "place": f"{kind}{bay}, {material}{f' and {more} more' * (more > 0)}",
            "cause": failure.cause,
            "drift": "" if failure.drift is None else directed(failure.drift, failure.direction),
            "forces": [f"{values[mine].max() / 1e3:.1f}"
                       for values in (frames.peaks["pull"], frames.peaks["shear"], joint.strength)],
        })
    return rows


def others(frames):
    """How far the joints were when the fall of a house that has collapsed began."""
    fall = frames.summary.quantities.until_s
    broken = frames.broken[max(0, int(np.searchsorted(frames.time, fall)) - 1)] > 0
    able = np.isfinite(frames.joints.strength) & ~np.asarray(frames.joints.damaged, bool)
    loads = frames.peaks["load"][able & ~broken]
    losses = f"{able.sum() - len(loads)} of {able.sum()} joints that can break had failed, those of walls included"
    about = f"Pull and shear: largest before {fall:.2f} s, when the fall began. Then {losses}"
    if not len(loads):
        return f"{about}; of the others none is left."
    return (f"{about}; of the others {(loads > 0.9).sum()} had used more than 0.9 of their strength, half of them more"
            f" than {np.median(loads):.2f}.")


def joint_name(name):
    """'main.column1.x0y0 | beam1.EW.y0': without the second structure if it is the first. Walls have one name."""
    first, _, second = name.partition("|")
    second = second.removeprefix(f"{first.partition('.')[0]}.")
    return f"{first} | {second}" if second else first


def command(options):
    """Command that repeats a run of some options; None for the house of a town and for a motion from Python."""
    if not options.keys().isdisjoint(("town", "ground_motion")):
        return None
    name = options.get("name")
    changed = {key: value for key, value in options.items() if key != "name"}
    return shlex.join(["yade", "-n", "-x", f"scripts/{name or 'house'}.py", *words(changed, name is not None)])


# --- PDF --------------------------------------------------------------------------------------------------------------


def print_pdf(source, path):
    """Print a page as PDF with Chromium; returns [path], or [] without a browser or when it fails."""
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        return []
    sandbox = [] if os.geteuid() else ["--no-sandbox"]  # Chromium has none for root; the page is our own
    try:
        with written_whole(path) as part, tempfile.TemporaryDirectory() as profile:
            options = ["--headless=new", *sandbox, "--disable-gpu", f"--user-data-dir={profile}",
                       "--no-pdf-header-footer", f"--print-to-pdf={part}"]
            subprocess.run([browser, *options, Path(source).resolve().as_uri()], check=True, capture_output=True,
                           timeout=PATIENCE)
    except subprocess.SubprocessError:
        return []
    return [path]

# SPDX-License-Identifier: GPL-2.0-or-later
"""Report of a run on one A4 page: report.html, self-contained, and report.pdf where Chromium is installed."""
import base64
import html
import io
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
from ..base.options import words
from ..motion import jma_intensity, pga, pgv
from ..recording import frames as recording
from ..recording import verdict
from ..recording.failures import first_failures
from ..text.english import counted, directed, direction_name, period_text, sentence, storey_name
from ..text.lines import lines
from . import REPORT, fonts, quantities, report_pictures
from .panels import panels
from .style import default_style

PAGE, PDF = REPORT
JOINTS_SHOWN = 8
"""Rows of the table of joints."""
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
PATIENCE = 120.0
"""Longest wait for the browser. [s]"""
COLORS = {"undamaged": "#009E73", "repairable": "#E69F00", "unsafe": "#D55E00", "collapsed": "#222222"}
CAVEATS = (
    "Members are rigid: they neither bend nor split; only joints and contacts deform.",
    (
        "Snow steadies a braced house in this model, since its weight holds the floors down on the braces. In practice"
        " snow adds to the earthquake load and houses under snow fare worse. Do not conclude that snow is good for a"
        " house."
    ),
    (
        "Once a house rocks, single numbers scatter by a factor of up to 2.5 between equal runs. Compare houses under"
        " several motions."
    ),
    (
        "Strengths, friction and stiffnesses are those of the house file, some of them assumptions. The report"
        " certifies no house; ask an engineer."
    ),
)
"""Limits of the model that a reader of one result must know (docs/limits.md)."""
LIGHT = 1.5
"""Weight per floor area below which a house is lighter than real ones. [kN/m2]"""
STYLE = """
@page { size: A4; margin: 9mm 10mm; }
body { font: 7.5pt/1.18 "Liberation Sans", Arial, Helvetica, sans-serif; color: #111; width: 190mm; height: 277mm;
  margin: 0 auto;
  display: flex; flex-direction: column; }
h1 { font-size: 14pt; margin: 0 0 1mm; } h2 { font-size: 9pt; margin: 1.6mm 0 0.6mm; border-bottom: 0.3mm solid #999; }
.verdict { color: white; padding: 1.2mm 2.5mm; border-radius: 1mm; font-weight: bold;
  -webkit-print-color-adjust: exact; print-color-adjust: exact; }
.row { display: flex; gap: 4mm; } .row > * { flex: 1 1 0; min-width: 0; } .row > .wide { flex: 1.25 1 0; }
img { max-width: 100%; display: block; } img.shots { flex: 1 1 0; min-height: 45mm; object-fit: contain; }
table { border-collapse: collapse; width: 100%; } td, th { text-align: left; padding: 0.15mm 1mm;
  border-bottom: 0.15mm solid #ddd; font-size: 6.8pt; }
td.number, th.number { text-align: right; } td { white-space: nowrap; } td.name { white-space: normal; }
ol, ul { margin: 0; padding-left: 4.5mm; } p { margin: 0.6mm 0; } code { font-size: 6.8pt; word-break: break-all; }
small { font-size: 6.4pt; }
"""


def write(folder):
    """Write report.html, and report.pdf if there is a browser, into a run's folder; returns the paths. RunError."""
    folder = Path(folder)
    results = quantities.read(folder)
    frames = recording.load(folder / recording.NAME,
                            missing="the report needs recorded frames: run without --no-frames")
    if frames.summary is None:
        raise RunError(f"{folder / recording.NAME}: of a run that has not ended; continue it with --resume")
    write_text(folder / PAGE, page(frames, results))
    return [folder / PAGE, *print_pdf(folder / PAGE, folder / PDF)]


def page(frames, results):
    """Text of the page. results: quantities.Results"""
    summary = results.summary
    failures = first_failures(frames) if summary.collapsed else []
    table = failed_joints(frames, results, failures) if failures else joints(results)
    parts = [
        f"<h1>{text(frames.title)}</h1>",
        f'<div class="verdict" style="background:{COLORS[summary.verdict]}">{text(sentence(summary))}</div>',
        (
            f'<div class="row"><section>{house(frames, summary, failures)}</section><section'
            f' class="wide">{motion(frames, summary)}{storeys(summary)}</section></div>'
        ),
        f"<h2>What happened</h2>{picture(*report_pictures.shots(frames), name='shots', about='six key times')}",
        f'<div class="row"><section>{events(summary)}</section><section class="wide">{table}</section></div>{limits()}',
        f"<h2>Limits of this model</h2><ul>{''.join(f'<li>{text(line)}</li>' for line in caveats(summary))}</ul>",
        repeat(summary),
    ]
    title = text(f"Report: {frames.title}")
    head = (
        '<!DOCTYPE html>\n<html lang="en"><head><meta'
        f' charset="utf-8"><title>{title}</title><style>{STYLE}</style></head>'
    )
    return f"{head}\n<body>\n{chr(10).join(parts)}\n</body></html>\n"


def text(value):
    """A text from data for the page."""
    return html.escape(str(value))


@default_style()
def picture(figure, part=None, name="", about=""):
    """An <img> with a figure, or with a part of it (Bbox [inch])."""
    data = io.BytesIO()
    fonts.apply(figure)
    figure.savefig(data, format="png", dpi=report_pictures.DPI, bbox_inches=part, metadata={"Software": None})
    return (
        f'<img class="{name}" alt="{text(about)}"'
        f' src="data:image/png;base64,{base64.b64encode(data.getvalue()).decode()}">'
    )


# --- parts of the page ------------------------------------------------------------------------------------------------


def house(frames, summary, failures):
    """Plans with the first failures, numbers of members, weight, natural periods."""
    kinds = frames.elements.kind
    counts = {kind: sum(k == kind for k in kinds) for kind in ("column", "brace")} | {
        "walled bay": len(panels(frames, 0))
    }
    periods = ", ".join(f"{direction_name(axis)} {period_text(mode)}" for axis in ("ns", "ew")
                        if (mode := summary.main_mode("before", axis)))
    (_, counts["joint"]), (_, counts["wall sheet"]) = summary.joints_and_sheets
    numbers = ", ".join(counted(count, kind) for kind, count in counts.items() if count)
    marks = "; blue: braces (thin end: foot)" * bool(
        counts["brace"]
    ) + "; green: walls (dotted: with an opening)" * bool(counts["walled bay"])
    marks += "; orange: joints broken from the start" * any(frames.joints.damaged) + "; numbers: first failures" * bool(
        failures
    )
    return (
        f"<h2>The house</h2>{picture(report_pictures.plans(frames, failures), about='plans, north up')}<p>Plans, north"
        f" up{marks}. {numbers}."
        f" {weight(summary.weight)}{periods and f' Natural periods {periods}.'}{diagnosis(summary)}</p>"
    )


def storeys(summary):
    """Table of the storeys: weight above and shear."""
    quantities = summary.quantities
    until = "" if quantities.until_s is None else f", before {quantities.until_s:.2f} s"
    rows = "".join(
        f"<tr><td>{text(storey_name(name))}</td><td class=number>{weight_of(storey.mass_above_kg):.0f} kN</td>"
        f"<td class=number>{coefficients(storey)}</td></tr>"
        for name, storey in quantities.storeys.items()
    )
    return (
        "<table><tr><th></th><th class=number>weight above</th><th class=number>largest shear / weight above, N-S,"
        f" E-W{until}</th></tr>{rows}</table>"
    )


def coefficients(storey):
    """'0.45, 0.39': storey shear coefficients N-S and E-W."""
    return ", ".join("-" if value is None else f"{value:.2f}" for value in storey.shear_coefficient.values())


def weight(weights):
    """'Weight 83 kN, 0.70 kN per m² of 119 m² of floor; snow 59 kN.' of a Weight."""
    per_area = ("" if weights.per_floor_area_kn_m2 is None
                else f", {weights.per_floor_area_kn_m2:.2f} kN per m² of {weights.floor_area_m2:.0f} m² of floor")
    snow = f"; snow {weights.snow_kn:.0f} kN" if weights.snow_kn else ""
    return f"Weight {weights.total_kn:.0f} kN{per_area}{snow}."


def diagnosis(summary):
    """The seismic index beside the run, and why they disagree."""
    return text(f" By the diagnosis of engineers: {summary.diagnosis.sentence}. {summary.diagnosis.disagreement}")


def motion(frames, summary):
    """The ground motion: record, PGA, intensity, spectrum."""
    if frames.motion is None:
        return "<h2>The motion</h2><p>No earthquake.</p>"
    applied = report_pictures.ground_motion(frames)
    intensity = jma_intensity(applied).official if applied.duration >= 0.3 and applied.acceleration.any() else None
    peaks = ", ".join(f"{name} {pga(applied, key):.0f}"
                      for name, key in (("N-S", "ns"), ("E-W", "ew"), ("up-down", "ud")))
    values = f"PGA {peaks} gal, PGV {pgv(applied):.0f} cm/s" + ("" if intensity is None
                                                                else f", JMA intensity {intensity:.1f}")
    scale = f", times {summary.record.scale:g}" if summary.record.scale != 1 else ""
    source = text(summary.record.source)
    about = f"<p>{source}{scale}: {values}. Dotted: natural periods of the house before the run.</p>"
    return f"<h2>The motion</h2>{picture(report_pictures.motion(frames), about='ground motion and spectra')}{about}"


def events(summary):
    """The result in ten lines."""
    return f"<h2>Result</h2><ol>{''.join(f'<li>{text(line)}</li>' for line in lines(summary))}</ol>"


def limits():
    """Limits of drift with their sources."""
    texts = "; ".join(f"1/{round(1 / limit.drift)} {limit.name} ({limit.source})" for limit in verdict.LIMITS)
    return f"<p><small>Limits of drift: {text(texts)}.</small></p>"


def joints(results):
    """Table of the joints most loaded."""
    rows = "".join(
        f"<tr><td class=name>{joint_name(row['joint'])}</td><td"
        f" class=number>{float(row['utilisation [-]']):.2f}</td><td"
        f" class=number>{float(row['pull [N]']) / 1e3:.1f}</td><td"
        f" class=number>{float(row['shear [N]']) / 1e3:.1f}</td><td"
        f" class=number>{1e3 * float(row['opening [m]']):.0f}</td><td>{text(row['state'])}</td></tr>"
        for row in results.joints[:JOINTS_SHOWN]
    )
    heads = ("utilisation", "pull kN", "shear kN", "opening mm")
    head = f"<tr><th>joint</th>{''.join(f'<th class=number>{name}</th>' for name in heads)}<th>end</th></tr>"
    return f"<h2>Joints most loaded</h2><table>{head}{rows}</table>"


def failed_joints(frames, results, failures):
    """Table of the first failures of a house that has collapsed, and how far its other joints were when its fall began.
    """
    by_name = {row["joint"]: row for row in results.joints}
    rows = "".join(failed_joint(number, failure, frames, by_name) for number, failure in enumerate(failures, 1))
    heads = ("drift of its storey", "pull kN", "shear kN", "strength kN")
    head = (
        "<tr><th></th><th class=number>time"
        f" s</th><th>joint</th><th>cause</th>{''.join(f'<th class=number>{name}</th>' for name in heads)}</tr>"
    )
    return f"<h2>First failures</h2><table>{head}{rows}</table><p>{text(others(frames, results))}</p>"


def failed_joint(number, failure, frames, by_name):
    """Row of a Failure. by_name: {joint: row of joints.csv}"""
    joint, row = frames.joints, by_name[frames.joints.name[failure.joint]]
    storey = joint.storey[failure.joint]
    place = (
        f"{joint.kind[failure.joint].replace('_', '-')}, {'storey ' * storey.isdigit()}{storey},"
        f" {joint.side[failure.joint].replace('+', ', ')}"
    )
    drift = "" if failure.drift is None else directed(failure.drift, failure.direction)
    forces = "".join(f"<td class=number>{float(row[column]) / 1e3:.1f}</td>"
                     for column in ("pull [N]", "shear [N]", "strength [N]"))
    title = f' title="{joint_name(row["joint"])}"'
    return (f"<tr><td class=number>{number}</td><td "
            f"class=number>{failure.time:.2f}</td><td{title}>{text(place)}</td><td>{text(failure.cause)}</td>"
            f"<td class=number>{drift}</td>{forces}</tr>")


def others(frames, results):
    """How far the joints were when the fall of a house that has collapsed began."""
    fall = results.summary.quantities.until_s
    broken = frames.broken[max(0, int(np.searchsorted(frames.time, fall)) - 1)] > 0
    names = {name for name, fails in zip(frames.joints.name, broken) if fails}
    rows = [row for row in results.joints if np.isfinite(float(row["strength [N]"])) and row["state"] != "before"]
    loads = np.array([float(row["utilisation [-]"]) for row in rows if row["joint"] not in names])
    failed = len(rows) - len(loads)
    losses = f"{failed} of {len(rows)} joints that can break had failed, those of walls included"
    about = f"Pull and shear: largest before {fall:.2f} s, when the fall began. Then {losses}"
    used = (
        f"{(loads > 0.9).sum()} had used more than 0.9 of their strength, half of them more than {np.median(loads):.2f}"
        if len(loads) else "none is left"
    )
    return f"{about}; of the others {used}."


def joint_name(name):
    """'main.column1.x0y0 | beam1.EW.y0': without the second structure if it is the first. Walls have one name."""
    first, _, second = name.partition("|")
    if not second:
        return text(first)
    second = second.removeprefix(f"{first.partition('.')[0]}.")
    return f"{text(first)} | {text(second)}"


def caveats(summary):
    """Limits of the model that matter for this run."""
    per_area = summary.weight.per_floor_area_kn_m2
    light = (
        f"The house without snow weighs {per_area:.1f} kN per m² of floor. Real houses with tiles, walls and live load"
        " weigh 2.5 to 3 kN per m²."
    )
    return [*([light] if per_area is not None and per_area < LIGHT else []), *CAVEATS]


def repeat(summary):
    """Versions, and the command that repeats the run; none for the house of a town and for a motion from Python."""
    versions, origin = summary.versions, summary.made_from
    about = (
        f"yade-timber {versions.package}, YADE {versions.yade}, package {origin['package']}, files {origin['files']};"
        f" time step {summary.dt:g} s."
    )
    options = {name: value for name, value in origin["options"].items() if name != "name"}
    name = origin["options"].get("name")
    command = shlex.join(["yade", "-n", "-x", f"scripts/{name or 'house'}.py", *words(options, name is not None)])
    code = f" <code>{text(command)}</code>" if options.keys().isdisjoint(("town", "ground_motion")) else ""
    return f"<h2>How to repeat it</h2><p>{text(about)}{code}</p>"


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

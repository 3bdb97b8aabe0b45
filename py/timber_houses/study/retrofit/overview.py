# SPDX-License-Identifier: GPL-2.0-or-later
"""Overview of a ranking: index.html with a row for each candidate and a dot for each motion; retrofit.csv."""
import math

from ...base.html import html
from ...base.table import csv_text
from ...text.english import ratio
from .race import CAP, FINALISTS, NO_DIFFERENCE, SIGNIFICANCE, response

WIDTH, HEIGHT, RADIUS, REACH = 220, 18, 4, 3.0
"""Size of a strip of dots and of a dot [pixel], and the largest ratio that it shows [-]."""
COLORS = {"better": "#009E73", "worse": "#D55E00"}
HEADER = ("rank", "candidate", "description", "motions", "ratio", "collapses", "house_collapses", "p_holm", "test",
          "result")


def table_text(results):
    """Text of retrofit.csv. results: of race.ranking"""
    rows = [(rank, r.entry.candidate.name, r.entry.candidate.text, r.motions, r.ratio, *r.comparison.collapses,
             "" if r.p is None else r.p,
             "" if r.p is None else "collapses" if r.comparison.by_collapses else "drifts", r.words)
            for rank, r in enumerate(results, 1)]
    return csv_text(HEADER, rows)


def summary(results):
    better = [result for result in results if result.words == "better"]
    if better:
        return ("Shown to be better than the house as it is:"
                f" {'; '.join(f'{result.entry.candidate.text} ({result.why})' for result in better)}.")
    tested = "; ".join(f"{result.entry.candidate.text} ({result.why})" for result in results if result.p is not None)
    return f"No measure is shown to be better than the house as it is: {NO_DIFFERENCE}. Tested: {tested}."


def page(title, about, results, house, pictures=()):
    """Text of index.html. about: sentences about the ranking; pictures: [(text, folder)] of runs with pictures."""
    runs = [(motion, run["run"], "collapses" if run["collapsed"] else ratio(run["peak_drift"]))
            for motion, run in house.runs.items()]
    return html(
        "retrofit.html", title=title, about=about, rows=[_row(result, house) for result in results], house=runs,
        pictures=pictures, finalists=FINALISTS, cap=f"{CAP:g}", significance=f"{SIGNIFICANCE:g}", width=WIDTH,
        height=HEIGHT, radius=RADIUS
    )


def _row(result, house):
    """Cells of a candidate, by their names in the template."""
    return {
        "text": result.entry.candidate.text,
        "motions": result.motions,
        "ratio": f"{result.ratio:.2f}" if math.isfinite(result.ratio) else "-",
        "collapses": "{} ({})".format(*result.comparison.collapses),
        "p": "-" if result.p is None else "< 0.001" if result.p < 1e-3 else f"{result.p:.3f}",
        "color": COLORS.get(result.words, "#444"),
        "result": result.words,
        "dots": [_dot(motion, run, house.runs[motion]) for motion, run in result.entry.runs.items()],
    }


def _dot(motion, run, house_run):
    """A motion's dot at its ratio, logarithmic within REACH; it links to the run's folder."""
    factor = math.exp(response(run) - response(house_run))
    shift = max(-1.0, min(1.0, math.log(factor) / math.log(REACH)))
    return {"x": f"{WIDTH / 2 + (WIDTH / 2 - RADIUS) * shift:.1f}", "about": f"{motion}: {factor:.2f}",
            "color": "#222" if run["collapsed"] else "#0072B2", "folder": run["run"]}

# SPDX-License-Identifier: GPL-2.0-or-later
"""Overview of a ranking: index.html with a row for each candidate and a dot for each motion; retrofit.csv."""
import html
import math

from ...base.table import csv_text
from ...text.english import ratio
from .race import CAP, FINALISTS, NO_DIFFERENCE, SIGNIFICANCE, response

WIDTH, HEIGHT, RADIUS, REACH = 220, 18, 4, 3.0
"""Size of a strip of dots and of a dot [pixel], and the largest ratio that it shows [-]."""
COLORS = {"better": "#009E73", "worse": "#D55E00"}
STYLE = """
body { font: 14px/1.4 Arial, Helvetica, sans-serif; max-width: 1300px; margin: 1em auto; padding: 0 1em; color: #111; }
table { border-collapse: collapse; } td, th { padding: 2px 8px; border-bottom: 1px solid #ddd; text-align: left;
  vertical-align: middle; }
td.number { text-align: right; white-space: nowrap; } td.measure { min-width: 24em; } .note { color: #444; }
circle:hover { stroke: black; stroke-width: 2; }
"""
HEADER = ("rank", "candidate", "description", "motions", "ratio", "collapses", "house_collapses", "p_holm", "test",
          "result")


def table_text(results):
    """Text of retrofit.csv. results: of race.ranking"""
    rows = [
        (rank, r.entry.candidate.name, r.entry.candidate.text, r.motions, r.ratio, r.collapses, r.house_collapses,
         "" if r.p is None else r.p,
         "" if r.p is None else "collapses" if r.comparison.by_collapses else "drifts", r.words)
        for rank, r in enumerate(results, 1)
    ]
    return csv_text(HEADER, rows)


def summary(results):
    """What the ranking shows, in a sentence."""
    better = [result for result in results if result.words == "better"]
    if better:
        return (
            "Shown to be better than the house as it is:"
            f" {'; '.join(f'{result.entry.candidate.text} ({result.why})' for result in better)}."
        )
    tested = "; ".join(f"{result.entry.candidate.text} ({result.why})" for result in results if result.p is not None)
    return f"No measure is shown to be better than the house as it is: {NO_DIFFERENCE}. Tested: {tested}."


def page(title, about, results, house, pictures=()):
    """Text of index.html. about: sentences about the ranking; pictures: [(text, folder)] of runs with pictures."""
    rows = "\n".join(_row(rank, result, house) for rank, result in enumerate(results, 1))
    shown = [(text, _link(f"{folder}/report.html", "report"), _link(f"{folder}/player.html", "player"))
             for text, folder in pictures]
    links = "".join(f"<li>{_text(text)}: {report}, {player}</li>" for text, report, player in shown)
    heads = ("", "measure", "motions", "drift / drift of the house", "collapses (house)", "p", "result",
             "each motion: 1/3 to 3, log")
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{_text(title)}</title><style>{STYLE}</style></head><body>
<h1>{_text(title)}</h1>
{''.join(f'<p>{_text(line)}</p>' for line in about)}
<table><tr>{''.join(f'<th>{_text(head)}</th>' for head in heads)}</tr>
{rows}
</table>
<p class="note">The first motions select the {FINALISTS} best measures, the others test them;
  a finalist's numbers are those of its test.
Drift / drift of the house: median over the motions of the largest storey drift divided by that of the house as it is
under the same motion;
a collapse counts as a drift of {CAP:g}. p: two-sided, corrected by Holm for the finalists. Where in half of the pairs
  or more a house collapses, it is
McNemar's exact test of the collapses, else Wilcoxon's signed-rank test of the drifts; below {SIGNIFICANCE:g}
a difference is shown.
Nothing is shown about a measure that was dropped. A dot links to its run; black: collapsed.</p>
<h2>The house as it is</h2><p>{_house(house)}</p>
{f'<h2>Pictures</h2><ul>{links}</ul>' if links else ''}
</body></html>
"""


def _text(value):
    return html.escape(str(value))


def _row(rank, result, house):
    entry = result.entry
    cells = (f"{result.ratio:.2f}" if math.isfinite(result.ratio) else "-",
             f"{result.collapses} ({result.house_collapses})", "-" if result.p is None else f"{result.p:.3f}")
    colour = COLORS.get(result.words, "#444")
    numbers = "".join(f"<td class=number>{cell}</td>" for cell in cells)
    return (f"<tr><td class=number>{rank}</td><td class=measure>{_text(entry.candidate.text)}</td><td "
            f"class=number>{result.motions}</td>{numbers}"
            f'<td style="color:{colour}">{_text(result.words)}</td><td>{strip(entry, house)}</td></tr>')


def strip(entry, house):
    """SVG with a dot for each motion at its ratio, logarithmic within REACH; each links to its run's folder."""
    dots = []
    for motion, run in entry.runs.items():
        factor = math.exp(response(run) - response(house.runs[motion]))
        x = WIDTH / 2 + (WIDTH / 2 - RADIUS) * (max(-1.0, min(1.0, math.log(factor) / math.log(REACH))))
        fill = "#222" if run["collapsed"] else "#0072B2"
        about = f"{motion}: {factor:.2f}"
        dot = (
            f'<circle cx="{x:.1f}" cy="{HEIGHT / 2}" r="{RADIUS}" fill="{fill}"'
            f' fill-opacity="0.6"><title>{_text(about)}</title></circle>'
        )
        dots.append(f'<a href="{_text(run["run"])}/">{dot}</a>')
    return (
        f'<svg width="{WIDTH}" height="{HEIGHT}"><line x1="{WIDTH / 2}" x2="{WIDTH / 2}" y1="0" y2="{HEIGHT}"'
        f' stroke="#999"/>{"".join(dots)}</svg>'
    )


def _house(house):
    """Drifts of the house as it is, with links to its runs."""
    texts = ((motion, run["run"], "collapses" if run["collapsed"] else ratio(run["peak_drift"]))
             for motion, run in house.runs.items())
    return ", ".join(f"{_link(f'{folder}/', motion)}: {result}" for motion, folder, result in texts)


def _link(target, text):
    return f'<a href="{_text(target)}">{_text(text)}</a>'

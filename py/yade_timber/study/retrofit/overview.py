# SPDX-License-Identifier: GPL-2.0-or-later
"""Overview of a ranking: index.html with a row for each candidate, a dot for each motion, links to the runs; retrofit.csv. Needs no YADE."""
import html
import math

from ...base.table import csv_text
from ...recording.sentences import ratio
from .race import CAP, NO_DIFFERENCE, SIGNIFICANCE

WIDTH, HEIGHT, RADIUS, REACH = 360, 18, 4, 3.0
"""Size of a strip of dots and of a dot [pixel], and the largest ratio that it shows [-]."""
COLORS = {"better": "#009E73", "worse": "#D55E00"}
STYLE = """
body { font: 14px/1.4 Arial, Helvetica, sans-serif; max-width: 1150px; margin: 1em auto; padding: 0 1em; color: #111; }
table { border-collapse: collapse; } td, th { padding: 2px 8px; border-bottom: 1px solid #ddd; text-align: left; vertical-align: middle; }
td.number { text-align: right; white-space: nowrap; } .note { color: #444; } circle:hover { stroke: black; stroke-width: 2; }
"""
MANY = 0.75
"""Share of the motions with a collapse of the house as it is, above which few measures can differ. [-]"""
HEADER = ("rank", "candidate", "description", "motions", "ratio", "lowest", "highest", "collapses", "house_collapses", "p_holm", "result")


def table_text(results, house):
    """Text of retrofit.csv. results: of race.ranking; house: Entry of the house as it is."""
    rows = [
        (rank, r.entry.candidate.name, r.entry.candidate.text, len(r.entry.responses), r.ratio, r.low, r.high, r.collapses, house_collapses(r.entry, house),
         "" if r.p is None else r.p, r.words)
        for rank, r in enumerate(results, 1)
    ]  # fmt: skip
    return csv_text(HEADER, rows)


def summary(results, house):
    """What the ranking shows, in one or two sentences. house: Entry of the house as it is."""
    better = [result for result in results if result.words == "better"]
    named = "; ".join(f"{result.entry.candidate.text} (drift times {result.ratio:.2f})" for result in better)
    shown = f"Shown to be better than the house as it is: {named}." if better else f"No measure is shown to be better than the house as it is: {NO_DIFFERENCE}."
    fallen, known = house_collapses(house, house), len(house.responses)
    if fallen <= MANY * known:
        return shown
    return f"{shown} The house as it is collapses under {fallen} of {known} motions: weaker motions (--scale) distinguish measures better."


def house_collapses(entry, house):
    """Collapses of the house as it is under the motions of an Entry."""
    return sum(bool(house.runs[motion]["collapsed"]) for motion in entry.responses)


def page(title, about, results, house, pictures=()):
    """Text of index.html. about: sentences about the ranking; pictures: [(text, folder)] of runs with pictures."""
    rows = "\n".join(_row(rank, result, house) for rank, result in enumerate(results, 1))
    shown = [(text, _link(f"{folder}/report.html", "report"), _link(f"{folder}/player.html", "player")) for text, folder in pictures]
    links = "".join(f"<li>{_text(text)}: {report}, {player}</li>" for text, report, player in shown)
    heads = ("", "measure", "motions", "drift / drift of the house", "lowest to highest", "collapses (house)", "p", "result", "each motion: 1/3 to 3, log")
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{_text(title)}</title><style>{STYLE}</style></head><body>
<h1>{_text(title)}</h1>
{''.join(f'<p>{_text(line)}</p>' for line in about)}
<table><tr>{''.join(f'<th>{_text(head)}</th>' for head in heads)}</tr>
{rows}
</table>
<p class="note">Drift / drift of the house: median over the motions of the largest storey drift divided by that of the house as it is under the same motion;
a collapse counts as a drift of {CAP:g}. p: Wilcoxon's signed-rank test, two-sided, corrected by Holm for all {len(results)} measures; below
{SIGNIFICANCE:g} a difference is shown.
A candidate that was dropped was behind after few motions; nothing is shown about it. A dot links to its run.</p>
<h2>The house as it is</h2><p>{_house(house)}</p>
{f'<h2>Pictures</h2><ul>{links}</ul>' if links else ''}
</body></html>
"""


def _text(value):
    return html.escape(str(value))


def _row(rank, result, house):
    entry = result.entry
    cells = (
        f"{result.ratio:.2f}" if math.isfinite(result.ratio) else "-",
        f"{result.low:.2f} to {result.high:.2f}" if math.isfinite(result.low) else "-",
        f"{result.collapses} ({house_collapses(entry, house)})",
        "-" if result.p is None else f"{result.p:.3f}",
    )
    colour = COLORS.get(result.words, "#444")
    numbers = "".join(f"<td class=number>{cell}</td>" for cell in cells)
    return (f"<tr><td class=number>{rank}</td><td>{_text(entry.candidate.text)}</td><td class=number>{len(entry.responses)}</td>{numbers}"
            f'<td style="color:{colour}">{_text(result.words)}</td><td>{strip(entry, house)}</td></tr>')  # fmt: skip


def strip(entry, house):
    """SVG with a dot for each motion at its ratio, logarithmic from 1 / REACH to REACH; each links to the folder of its run."""
    dots = []
    for motion, value in entry.responses.items():
        factor = math.exp(value - house.responses[motion])
        x = WIDTH / 2 + (WIDTH / 2 - RADIUS) * (max(-1.0, min(1.0, math.log(factor) / math.log(REACH))))
        fill = "#222" if entry.runs[motion]["collapsed"] else "#0072B2"
        about = f"{motion}: {factor:.2f}"
        dot = f'<circle cx="{x:.1f}" cy="{HEIGHT / 2}" r="{RADIUS}" fill="{fill}" fill-opacity="0.6"><title>{_text(about)}</title></circle>'
        dots.append(f'<a href="{_text(entry.runs[motion]["run"])}/">{dot}</a>')
    return f'<svg width="{WIDTH}" height="{HEIGHT}"><line x1="{WIDTH / 2}" x2="{WIDTH / 2}" y1="0" y2="{HEIGHT}" stroke="#999"/>{"".join(dots)}</svg>'


def _house(house):
    """Drifts of the house as it is, with links to its runs."""
    texts = ((motion, run["run"], "collapses" if run["collapsed"] else ratio(run["peak_drift"])) for motion, run in house.runs.items())
    return ", ".join(f"{_link(f'{folder}/', motion)}: {result}" for motion, folder, result in texts)


def _link(target, text):
    return f'<a href="{_text(target)}">{_text(text)}</a>'

#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Fill the tables of the pages on performance and accuracy from the CSV files beside them, and draw their figures:
write_pages.py [docs]. Needs no YADE.
"""
import csv
import math
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[2] / "py"), str(Path(__file__).resolve().parent)]

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from tables import markdown_table
from timber_houses.base.atomic_write import write_text, written_whole
from timber_houses.base.time_step import DEFAULT_DT

TOLERATED = 0.01
"""Error up to which a time step is called exact [-]"""
SHAKING, REST = "strong shaking", "at rest"
SECTIONS = {"1": ("Contact", "Hertz's impact, Runge-Kutta solutions of the damped one"),
            "2": ("Friction", "incline, sliding block, closed paths of the tangential spring"),
            "3": ("Rocking", "rigid rocking block, Housner's periods"),
            "4": ("Joint", "modes, strength, cycles of yielding springs"),
            "5": ("Free motion", "Jacobi's elliptic functions for a body that flips"),
            "6": ("Assemblies", "stack, arch, wedge, frames, weight of a house"),
            "7": ("Energy balance", "input against stored and dissipated energy"),
            "8": ("Invariance", "rotated, mirrored, moved, reordered, saved and loaded scenes; 1 and 2 threads"),
            "9": ("Independent reference", "a portal computed by a second program")}
ERRORS = {
    "restitution of a damped corner, one step per impact": ("restitution, damping ratio 1, contact of 1 steps [-]",
                                                            None),
    "distance of a sliding block": ("sliding distance from 1 m/s [m]", "0.0004"),
    "period of a rocking block": ("quarter period from 0.6 alpha, rolling rigid block [s]", None),
    "energy dissipated by a yielding joint in a cycle": (
        "yielding joint, per joint, steady cycle of 6 mm: energy dissipated [J]", None
    ),
    "portal beside a second program": ("portal: implicit dashpots, largest distance / peak [-]", "0.0001"),
    "energy balance of house B in strong shaking": ("house B, strong shaking: residual / input [-]", "0.00025"),
    "flips of a free body, this package": ("SymplecticIntegrator: time of the third flip [s]", "0.001"),
    "flips of a free body, YADE's NewtonIntegrator": ("NewtonIntegrator: time of the third flip [s]", "0.001"),
}
"""{row of the page: (quantity, time step) of accuracy.csv}"""
CURVES = {"impact, closed form": "Hertz impact, closed form (Eq. 37): duration [s]",
          "impact, increments (Eq. 38)": "Hertz impact, increment form (Eq. 38): duration [s]",
          "restitution, critical dashpot": "restitution, critical dashpot, implicit [-]",
          "sliding distance": "sliding distance from 1 m/s [m]",
          "highest mode of a joint": "joint, highest mode [rad/s]",
          "yielding oscillator": "oscillator that yields: largest stretch [m]",
          "flips, this package": "SymplecticIntegrator: time of the third flip [s]",
          "flips, NewtonIntegrator": "NewtonIntegrator: time of the third flip [s]",
          "house B, energy": "house B, strong shaking: residual / input [-]"}
"""{label: quantity of accuracy.csv}"""


def table(folder, name):
    """Rows of a CSV file as dicts."""
    with open(folder / f"{name}.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(rows, column, **at):
    """The number in a column of the only row with these entries; `_` stands for a space in a column's name."""
    wanted = {key.replace("_", " "): str(value) for key, value in at.items()}
    (row,) = [row for row in rows if all(row[key] == value for key, value in wanted.items())]
    return float(row[column])


def fill(page, name, text):
    """Replace what stands between the marks of a block of a page."""
    before, rest = page.read_text(encoding="utf-8").split(f"<!-- {name} -->\n")
    _, after = rest.split(f"<!-- /{name} -->")
    write_text(page, f"{before}<!-- {name} -->\n{text}\n<!-- /{name} -->{after}")


def save(figure, path):
    with written_whole(path) as part:
        figure.savefig(part, dpi=110, format="png")
    plt.close(figure)


# --- performance ------------------------------------------------------------------------------------------------------
def largest_exact_step(rows, case, variant):
    """Largest time step up to which all errors of a case are below TOLERATED [s], and the run time with it [s]; None
    without one.
    """
    errors = {}
    for row in rows:
        if (row["case"], row["variant"]) == (case, variant):
            errors.setdefault(float(row["dt [s]"]), []).append((float(row["error [-]"]), float(row["run time [s]"])))
    exact = None
    for dt, runs in sorted(errors.items()):
        if max(error for error, _ in runs) >= TOLERATED:
            break
        exact = dt, runs[0][1]
    return exact


def step_text(folder):
    rows = table(folder, "step")
    micro = {state: number(rows, "whole step [us]", state=state) for state in (SHAKING, REST)}
    fast = DEFAULT_DT / micro[SHAKING] * 1e6
    return (
        f"House C2 with 1 m of snow: {micro[SHAKING]:.0f} us in strong shaking, {fast:.1f} times as fast as real time;"
        f" {micro[REST]:.0f} us at rest"
    )


def skips_text(folder):
    gain = next(float(row["speed-up"]) for row in table(folder, "skips") if "RestSkipper" in row["skipped work"])
    return f"10 s of rest are computed {gain:.1f} times as fast by skipping steps"


def precision_text(folder):
    """Largest exact steps of two houses."""
    rows, texts = table(folder, "precision"), []
    for case in ("standing house C", "collapsing house A"):
        steps = []
        for variant, label in (("default", "implicit contacts"), ("explicit dashpots", "explicit dashpots")):
            exact = largest_exact_step(rows, case, variant)
            steps.append((f"{exact[0]:g} s ({exact[1]:.1f})" if exact else "none") + f" with {label}")
        texts.append(f"{case} {', '.join(steps)}")
    return (
        f"Largest step with errors below {100 * TOLERATED:g} %, in brackets seconds of computing: {'; '.join(texts)}"
    )


def stability_text(folder):
    """Limits of the step over their prediction."""
    limits = {}
    for row in table(folder, "stable_dt"):
        limits.setdefault(row["contacts"].replace("default", "implicit contacts"), []).append(
            float(row["measured [s]"]) / float(row["predicted [s]"])
        )
    return "Stable over predicted step: " + "; ".join(f"{contacts} {min(ratios):.2g} to {max(ratios):.2g}"
                                                      for contacts, ratios in limits.items())


def balance_text(folder):
    worst = max(abs(float(row["energy gained [-]"])) for row in table(folder, "balance")
                if float(row["dt [s]"]) == DEFAULT_DT)
    return (
        "The energy of three houses in strong shaking at the default step closes within"
        f" {100 * worst:.1g} % of the input"
    )


TEXTS = {"step": step_text, "skips": skips_text, "precision": precision_text, "stable_dt": stability_text,
         "balance": balance_text}
"""{CSV file: function that words its numbers}"""


def run_table(folder):
    """Table of whole runs."""
    rows = table(folder, "runs")
    heads = list(rows[0])
    shown = [
        (row["run"], row["elements"],
         *(f"{float(row[head]):.{0 if float(row[head]) > 20 else 1}f}" for head in heads[2:]))
        for row in rows
    ]
    return markdown_table(heads, shown)


def draw_errors(axis, rows, case):
    """Error over run time of one case, for several forms of the contact law."""
    labels = {"default": "implicit contacts (default)", "increment form": "the same, Eq 38",
              "explicit dashpots": "explicit dashpots"}
    for (variant, label), mark in zip(labels.items(), "oD^"):
        points = {}
        for row in rows:
            if (row["case"], row["variant"]) == (case, variant) and math.isfinite(float(row["error [-]"])):
                dt = float(row["dt [s]"])
                points[dt] = (float(row["run time [s]"]), max(float(row["error [-]"]), points.get(dt, (0, 0))[1]))
        del points[min(points)]  # the reference's own step
        axis.loglog(*zip(*points.values()), marker=mark, ms=4, lw=1, label=label)
        for dt, at in points.items():
            axis.annotate(f"{dt:g}", at, textcoords="offset points", xytext=(3, 4), fontsize=6)
    axis.axhline(TOLERATED, color="0.5", lw=0.8, ls="--")
    axis.set(title=case, xlabel="run time [s]", ylabel="largest error [-]")
    axis.legend(fontsize=7)


def write_performance(folder):
    figure, axes = plt.subplots(1, 2, figsize=(11, 3.6), layout="constrained")
    for axis, case in zip(axes, ("standing house C", "collapsing house A")):
        draw_errors(axis, table(folder, "precision"), case)
    save(figure, folder / "precision.png")
    page = folder / "performance.md"
    fill(page, "numbers", "\n".join(f"* {text(folder)} ([{name}.csv]({name}.csv))." for name, text in TEXTS.items()))
    fill(page, "runs", run_table(folder))


# --- accuracy ---------------------------------------------------------------------------------------------------------
def bounded(rows, section):
    """[(error, bound)] of the rows of a section that have a bound."""
    checks = [(float(row["error"]), float(row["bound"])) for row in rows if row["section"] == section]
    return [(error, bound) for error, bound in checks if math.isfinite(bound)]


def share(error, bound):
    """Error over bound; 0 where the result must be exact and is."""
    return error / bound if bound else math.inf if error else 0.0


def section_rows(rows):
    entries = []
    for section, (title, subject) in SECTIONS.items():
        checks = bounded(rows, section)
        entries.append((title, subject, len(checks), f"{max(share(*check) for check in checks):.2g}"))
    return entries


def error_rows(rows):
    """Rows of ERRORS: name, error, time step, expected value's source."""
    entries = []
    for label, (quantity, dt) in ERRORS.items():
        (row,) = [row for row in rows if row["quantity"] == quantity and dt in (None, row["dt [s]"])]
        entries.append((label, f"{float(row['error']):.1g}", row["dt [s]"] and f"{float(row['dt [s]']):.2g}"))
    return entries


def draw_margins(axis, rows):
    """Error over bound of every check, one line for each section."""
    for y, section in enumerate(SECTIONS):
        shares = [max(share(*check), 1e-12) for check in bounded(rows, section)]
        axis.plot(shares, [y] * len(shares), "o", ms=4, alpha=0.5, color="tab:blue")
    axis.axvline(1, color="tab:red", lw=1)
    axis.set(xscale="log", xlabel="error over its bound (left edge: exact)", yticks=range(len(SECTIONS)),
             yticklabels=[title for title, _ in SECTIONS.values()], title="All checks")
    axis.invert_yaxis()


def draw_convergence(axis, rows):
    """Error against time step, with slopes of order 1 and 2."""
    for label, quantity in CURVES.items():
        points = sorted((float(row["dt [s]"]), float(row["error"])) for row in rows if row["quantity"] == quantity)
        axis.loglog(*zip(*points), "o-", ms=3, lw=1, label=label)
    steps = (2e-6, 2e-3)
    for order, style in ((1, ":"), (2, "--")):
        axis.loglog(steps, [3e-8 * (dt / steps[0]) ** order for dt in steps], style, color="0.6",
                    label=f"order {order}")
    axis.set(xlabel="time step [s]", ylabel="error [-]", title="Convergence")
    axis.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False)


def write_accuracy(folder):
    rows = table(folder, "accuracy")
    figure, axes = plt.subplots(1, 2, figsize=(12, 4), layout="constrained")
    draw_margins(axes[0], rows)
    draw_convergence(axes[1], rows)
    save(figure, folder / "accuracy.png")
    fill(
        folder / "accuracy.md",
        "checks",
        markdown_table(("part", "compared with", "checks", "largest error / bound"), section_rows(rows)),
    )
    fill(folder / "accuracy.md", "errors", markdown_table(("quantity", "error [-]", "time step [s]"), error_rows(rows)))


def main():
    docs = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parents[2] / "docs")
    write_performance(docs / "performance")
    write_accuracy(docs / "accuracy")


if __name__ == "__main__":
    main()

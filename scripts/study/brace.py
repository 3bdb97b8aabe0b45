#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Effect of one more brace: each free bay of a house gets one in runs of its own, ranked by largest storey drift (mean of the motions).

    scripts/study/brace.py [-j 2] [--house B] [--scale 1] [--snow 0] [--seeds 1,2] [--only EW.y0,NS.x8] [--start 14 --end 34]

The unchanged house is run as well, also out of plumb by 1/10 000 to each side: differences below the scatter of these runs are not
significant. Writes brace.csv (one row per bay) and brace.png (ranking, and a plan of each storey).
"""

from statistics import mean

import matplotlib.pyplot as plt
from study_common import house_name, parser, run_all, save, write_table

from yade_timber.base.colors import BLUE, GREY, ORANGE
from yade_timber.base.errors import RunError
from yade_timber.house import brace_parts, build_house, free_bays, load_house
from yade_timber.study.options import list_of, non_negative, positive, run_script, seed

UNCHANGED = "unchanged"
SIDES = ("north", "south", "east", "west")
SHOWN, NUMBERED = 24, 5
"""Number of bays in the ranking of the picture, and of those numbered in its plans."""


def arguments():
    made = parser(__doc__, "results/study_brace")
    made.add_argument("--house", default="B", type=house_name, help="shipped house or house file (default %(default)s)")
    made.add_argument("--scale", type=positive, default=1.0, help="factor on the motion (default %(default)g)")
    made.add_argument("--snow", type=non_negative, default=0.0, help="snow depth [m] (default %(default)g)")
    made.add_argument("--seeds", type=list_of(seed), default="1,2", metavar="N,N", help="synthetic motions (default %(default)s)")
    made.add_argument("--only", default="", metavar="TEXT,TEXT", help="only bays whose names contain one of these texts, comma-separated")
    return made.parse_args()


def rows(options, bays):
    """Rows of the batch, for each motion: the unchanged house, out of plumb to four sides, and with each brace."""
    out_of_plumb = [(f"plumb_{side}", "*", f"plumb.drift=1e-4;plumb.towards={side}") for side in SIDES]
    variants = [(UNCHANGED, "*", "*"), *out_of_plumb, *((bay, bay, "*") for bay in bays)]
    same = {"house": options.house, "scale": f"{options.scale:g}", "snow": f"{options.snow:g}"}
    return [
        {**same, "seed": seed, "description": f"{name}_{seed}", "braces": brace, "set": changes}
        for seed in options.seeds
        for name, brace, changes in variants
    ]


def ranking(found):
    """(rows of brace.csv, best first; mean drifts of the unchanged house and of those out of plumb). Variants with a failed run are left
    out. Those that collapse come last, in the order of the number of collapses, then of the mean time of collapse (later is better)."""
    variants = {}
    for entry in found:
        variants.setdefault((entry["braces"], entry["set"]), []).append(entry)
    complete = {key: entries for key, entries in variants.items() if all(entry["status"] == "done" for entry in entries)}
    without = [mean(entry["peak_drift"] for entry in entries) for (brace, _), entries in complete.items() if not brace]
    table = [_ranked(brace, entries, without[0]) for (brace, _), entries in complete.items() if brace]
    table.sort(key=lambda row: (row["collapses"], -(row["collapse_time_s"] or 0), row["peak_drift"]))
    return table, without


def _ranked(brace, entries, base):
    fallen = [entry["collapse_time_s"] for entry in entries if entry["collapsed"]]
    drift = mean(entry["peak_drift"] for entry in entries)
    broken = mean(entry["broken"] for entry in entries)
    return {"brace": brace, "peak_drift": drift, "change": drift / base - 1, "broken_joints": broken, "motions": len(entries),
            "collapses": len(fallen), "collapse_time_s": mean(fallen) if fallen else ""}  # fmt: skip


def plot(table, without, options, path):
    """The first bays of the ranking, and a plan of each storey with every bay coloured by the effect of a brace there."""
    model = build_house(load_house(options.house), check=False)
    main_house = next(iter(model.storey_levels))
    storeys = sorted(model.storey_levels[main_house])
    figure = plt.figure(figsize=(5.5 + 4.6 * len(storeys), 7.2), constrained_layout=True)
    axes = figure.subplots(1, 1 + len(storeys), width_ratios=[1.15, *[1] * len(storeys)])
    draw_ranking(axes[0], table[:SHOWN], without, model)
    limit = max(0.05, max(abs(row["change"]) for row in table if not row["collapses"]) if any(not row["collapses"] for row in table) else 0.05)
    colours = plt.cm.ScalarMappable(plt.Normalize(-100 * limit, 100 * limit), "PuOr_r")
    for axis, storey in zip(axes[1:], storeys):
        draw_plan(axis, model, main_house, storey, table, colours)
    fallen = "\nblack: the house collapses" if any(row["collapses"] for row in table) else ""
    figure.colorbar(colours, ax=axes[1:], orientation="horizontal", shrink=0.6, label=f"change of the largest storey drift by one more brace there [%]{fallen}")
    snow = f", {options.snow:g} m of snow" if options.snow else ""
    figure.suptitle(f"House {model.name}: one more brace; synthetic motions of seeds {', '.join(map(str, options.seeds))}, times {options.scale:g}{snow}")
    save(figure, path)
    plt.close(figure)


def draw_ranking(axis, table, without, model):
    names = [f"{bay_text(model, row['brace'])}   {rank}" for rank, row in enumerate(table, 1)]
    axis.barh(names, [100 * row["peak_drift"] for row in table], color=[ORANGE if row["collapses"] else BLUE for row in table], height=0.7)
    axis.axvline(100 * without[0], color=GREY, lw=1.5, label="unchanged")
    axis.axvspan(100 * min(without), 100 * max(without), color=GREY, alpha=0.25, label="unchanged, out of plumb by 1/10 000")
    axis.invert_yaxis()
    axis.tick_params(axis="y", labelsize=8)
    axis.set(xlabel="largest storey drift, mean of the motions [%]", title=f"the best {len(table)} bays")
    axis.margins(y=0.01)
    axis.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.08), ncols=2, frameon=False)


def bay_text(model, name):
    """Bay of a brace as text: 'storey 1, south wall, 3.2 m east', the position of its centre along the wall."""
    structure, storey, along, *_ = brace_parts(name)
    ends = bay_ends(model, name)
    at, centre = (ends[1][0], sum(ends[0]) / 2) if along == "x" else (ends[0][0], sum(ends[1]) / 2)
    lines = [column.solid.centroid[1 - "xy".index(along)] for column in model.of_kind("column", group=structure)]
    low, high = ("south", "north") if along == "x" else ("west", "east")
    side = low if at < min(lines) + 0.01 else high if at > max(lines) - 0.01 else f"inner {'E-W' if along == 'x' else 'N-S'}"
    return f"storey {storey}, {side} wall, {centre:.1f} m {'east' if along == 'x' else 'north'}"


def draw_plan(axis, model, main_house, storey, table, colours):
    """Columns and braces of a storey from above, north up; free bays as thick lines, coloured by the effect of a brace there."""
    for column in model.of_kind("column", group=main_house):
        if column.storey == storey:
            (x0, y0, _), (x1, y1, _) = column.solid.bounds
            axis.add_patch(plt.Rectangle((x0, y0), x1 - x0, y1 - y0, color="black", zorder=3))
    for brace in model.of_kind("brace", group=main_house):
        if brace.storey == storey:
            (x0, y0, _), (x1, y1, _) = brace.solid.bounds
            lies = x1 - x0 > y1 - y0
            axis.plot([x0, x1] if lies else [(x0 + x1) / 2] * 2, [(y0 + y1) / 2] * 2 if lies else [y0, y1], color=GREY, lw=3, ls=(0, (1, 0.6)))
    for rank, row in enumerate(table, 1):
        if row["brace"].startswith(f"{main_house}.brace{storey}."):
            (xs, ys) = bay_ends(model, row["brace"])
            colour = "black" if row["collapses"] else colours.to_rgba(100 * row["change"])
            axis.plot(xs, ys, color=GREY, lw=11, solid_capstyle="butt", zorder=1.8)
            axis.plot(xs, ys, color=colour, lw=9.5, solid_capstyle="butt", zorder=2)
            if rank <= NUMBERED:
                axis.annotate(str(rank), (sum(xs) / 2, sum(ys) / 2), ha="center", va="center", fontsize=9, weight="bold", zorder=4,
                              bbox={"boxstyle": "circle,pad=0.15", "fc": "white", "ec": "black", "lw": 0.6})
    axis.set(aspect="equal", title=f"storey {storey} (dotted: existing braces)", xlabel="east [m]", ylabel="north [m]")
    axis.margins(0.06)


def bay_ends(model, name):
    """((x, x), (y, y)) [m] between the centres of the columns of a bay 'main.brace1.EW.y0.3-4'."""
    structure, storey, along, at, *ends = brace_parts(name)
    nodes = [(node, at) if along == "x" else (at, node) for node in ends]
    centres = [model.element(f"{structure}.column{storey}.x{x:g}y{y:g}").solid.centroid for x, y in nodes]
    return [centre[0] for centre in centres], [centre[1] for centre in centres]


def main():
    options = arguments()
    description = load_house(options.house)
    main_house = next(iter(description.data["structures"]))
    texts = [text for text in options.only.split(",") if text] or [""]
    bays = [bay for bay in free_bays(description) if bay.startswith(f"{main_house}.") and any(text in bay for text in texts)]
    if not bays:
        raise RunError(f"--only {options.only}: no free bay's name contains this" if options.only else f"{options.house}: no free bay")
    found = run_all(rows(options, bays), options)
    if any(run["status"] != "done" for run in found if (run["braces"], run["set"]) == (None, None)):
        raise RunError("a run of the unchanged house failed: nothing to compare with")
    table, without = ranking(found)
    folder = options.to or options.out
    write_table(folder / "brace.csv", [{"rank": rank, **row} for rank, row in enumerate(table, 1)])
    plot(table, without, options, folder / "brace.png")
    print(f"unchanged: {without[0]:.4f} ({min(without):.4f} to {max(without):.4f} out of plumb); best: {table[0]['brace']} {table[0]['peak_drift']:.4f}")
    return int(any(run["status"] != "done" for run in found))


if __name__ == "__main__":
    run_script(main)

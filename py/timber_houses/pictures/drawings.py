# SPDX-License-Identifier: GPL-2.0-or-later
"""Drawings of a house as built (paper, Figs. 5-8 and 10): in space, front, side, plan of the first storey."""
from functools import partial

import numpy as np
from matplotlib.lines import TICKLEFT, Line2D
from matplotlib.patches import Ellipse, Patch, Polygon, Rectangle

from ..base import colors
from ..house import weigh
from ..house.weight import sentence
from .figures import A4, TITLE_PAD, Panel, default_style, heading, new_figure, save, stem_and_endings
from .panels import plates_as_built
from .raster import Window, even_density, front_of, shade
from .report_pictures import THICK, wedge
from .views import (FRONT, INK, SIDE, WALL_NAMES, Snapshot, Solid, View, box_of, draw_ends, draw_view, kind_entries,
                    wall_entries, wall_solids)

WIDTH, HEIGHT, DPI = A4[1], A4[0], 300
"""Of the page [inch], and of its shaded parts [1/inch]."""
OBLIQUE = View("space", "In space, from the north-east (roof and walls half transparent)", (-0.64, 0.768, 0.0),
               (0.704, 0.587, 0.4), "", "", (-0.307, -0.256, 0.917))
TRANSPARENT = ("roof", "snow", *WALL_NAMES)
OPACITY = 0.6
"""Of these kinds of elements. [-]"""
CELLS = ((0.06, 0.49, 0.42, 0.36), (0.55, 0.49, 0.42, 0.36), (0.06, 0.105, 0.42, 0.335), (0.55, 0.105, 0.42, 0.335))
"""Left, bottom, width, height of the four drawings in parts of the figure."""
DAMAGE_MARGIN = 0.35
"""Between damaged joints and the ellipse around them. [m]"""
NODE_GAP = 0.33
"""Between a structure's outer grid line and the numbers of its nodes in the plan. [m]"""
WALL, WALL_WIDTH = "#8c6d46", 0.16
"""Of sheathed bays in the plan: colour, width [m]."""
LABEL_GAP = 0.12
"""Between the baselines of two labels of heights. [inch]"""


def write(path, model):
    """Write the drawings of a HouseModel, as PDF if the path ends so. Returns the paths. Raises OSError."""
    return save(page(model, DPI), *stem_and_endings(path))


@default_style()
def page(model, dpi):
    """Figure with the drawings of a HouseModel. dpi: of the shaded parts [1/inch]"""
    figure = new_figure(WIDTH, HEIGHT, dpi)
    solids = [solid(e) for e in model.elements]
    space, front, side, plan = CELLS
    walls = sheathing(model)
    draw_space(figure.add_axes(space), [*solids, *walls], dpi)
    for cell, view in ((front, FRONT), (side, SIDE)):
        draw_elevation(figure, cell, Snapshot(solids, walls), view, model)
    draw_plan(figure.add_axes(plan), model)
    heading(figure, f"House {model.name}", describe(model))
    legend(figure, solids, walls, model)
    return figure


def solid(element):
    """Solid of an element in its position as built."""
    faces = [face.points for face in element.solid.faces]
    starts = np.cumsum([0, *map(len, faces)])
    return Solid(element.kind, np.vstack(faces), [list(range(a, b)) for a, b in zip(starts, starts[1:])],
                 colors.of(element.kind))


def sheathing(model):
    """Solids of the plates of wall sheets as built."""
    plates, states = plates_as_built(model)
    return wall_solids([plate for plate in plates if plate.shows(states)], states)


def describe(model):
    """Description, counts and weight of a house, in three lines."""
    counts = model.counts()
    snow = f", snow {counts['mass_snow'] / 1000:.1f} t" if counts["mass_snow"] else ""
    columns = " and ".join(f"{count} columns of {100 * size:g} cm"
                           for size, count in sorted(counts["columns_by_section"].items(), reverse=True))
    walls = f", {counts['walls']} bays with walls" if counts["walls"] else ""
    description = " ".join(model.description.split())
    return (f"{description}\n{columns}, {counts['braces']} braces{walls},"
            f" {model.joints_text}{snow}\n{sentence(weigh(model))}")


def density(cell, box, dpi):
    """Pixels per metre at which a box fills a cell of CELLS, a multiple of 2."""
    return even_density(dpi * min(cell[2] * WIDTH / (box[1] - box[0]), cell[3] * HEIGHT / (box[3] - box[2])))


def draw_space(ax, solids, dpi):
    """All elements and wall sheets in an oblique parallel view, the latter, roof and snow half transparent."""
    shown = np.vstack([s.vertices for s in solids if s.kind != "ground"])
    across, up = shown @ OBLIQUE.right, shown @ OBLIQUE.up
    box = across.min() - 0.3, across.max() + 0.3, up.min() - 0.3, up.max() + 0.3
    window, front = Window(OBLIQUE, box, density(CELLS[0], box, dpi)), front_of(solids, OBLIQUE)
    whole, frame = (shade([s for s in solids if s.kind not in hidden], window, front, sky=1.0)[0]
                    for hidden in (("ground",), ("ground", *TRANSPARENT)))
    ax.imshow(np.rint(OPACITY * whole + (1 - OPACITY) * frame).astype(np.uint8)[..., :3], extent=box,
              interpolation="antialiased", aspect="equal")
    ax.set_title(OBLIQUE.title, fontsize=9, loc="left", y=1)
    ax.axis("off")


def draw_elevation(figure, cell, snapshot, view, model):
    """Front or side view in the middle of a cell of CELLS, with the heights of floors and ridge."""
    box = box_of(view, snapshot.solids, [])
    window = Window(view, box, density(cell, box, figure.dpi))
    place, room = np.multiply(cell, (WIDTH, HEIGHT, WIDTH, HEIGHT)).reshape(2, 2)
    panel = Panel(figure, place + (room - np.divide(window.size, figure.dpi)) / 2, window)
    draw_view(panel, snapshot, front_of(snapshot.solids, view))
    panel.note(view.title, (0, 1), (0, TITLE_PAD), fontsize=9)
    draw_ends(panel, 8)
    levels = (z for storeys in model.storey_levels.values() for pair in storeys.values() for z in pair)
    draw_heights(panel, sorted({0.0, *levels, max(e.vertices[:, 2].max() for e in model.elements)}))
    frame_damage(panel, [(np.dot(j.centre, view.right), j.centre[2]) for j in model.joints if j.broken])


def draw_heights(panel, heights):
    """Ticks at heights [m] with labels to the left, moved upwards where they would overlap."""
    left, lowest, gap = panel.window.box[0], -np.inf, LABEL_GAP * panel.figure.dpi / panel.window.density
    panel.plot([left] * len(heights), heights, linestyle="none", color="black", marker=TICKLEFT, markersize=3.5,
               markeredgewidth=0.8, clip_on=False)
    for z in heights:
        lowest = max(lowest + gap, z)
        panel.note(f"{z:.2f} m" if z else "0", (left, lowest), (-6, 0), panel.plane, fontsize=7, va="center",
                   ha="right")


def draw_plan(ax, model):
    """First floor from above: grid lines, columns by section, braces, damaged joints. North is up."""
    columns = [e for e in model.of_kind("column") if e.storey == 1]
    others = [] if columns else [e for e in model.elements if e.kind != "ground"]  # of a frame without columns
    for axis, line in enumerate((ax.axvline, ax.axhline)):
        for position in sorted({round(float(e.solid.centroid[axis]), 3) for e in columns}):
            line(position, color="#bbbbbb", lw=0.5, zorder=0)
    for element in others or model.of_kind("sill") or model.of_kind("foundation"):
        draw_outline(ax, element, facecolor="none", edgecolor="#999999", lw=0.5)
    for element in columns:
        draw_outline(ax, element, facecolor="black" if max(element.section) >= THICK else "white", edgecolor="black",
                     lw=0.8, zorder=3)
    for element in model.of_kind("brace"):
        if element.storey == 1:
            ax.add_patch(wedge(element.vertices))
    for sheet in dict.fromkeys(joint.sheet for joint in model.joints if joint.sheet and joint.storey == 1):
        start, end = (model.element(name).solid.centroid[:2] for name in (sheet.low, sheet.high))
        draw_wall(ax, start, end, sheet.opening != "none")
    broken = [j.centre[:2] for j in model.joints if j.broken and j.storey == 1]
    frame_damage(ax, broken)
    for grid in model.grids.values():
        number_nodes(ax, grid, next(iter(model.grids.values())))
    ax.set_title("Plan of the first storey, north up: columns, braces and walls", fontsize=9, loc="left", y=1)
    finish_plan(ax, columns or others)


def number_nodes(ax, grid, main):
    """Numbers of grid nodes along the sides away from the main structure. grid, main: {'x', 'y'}: positions [m]"""
    before = {axis: grid[axis].mean() <= main[axis].mean() + 1e-9 for axis in "xy"}
    gap = NODE_GAP if grid is main else 1.6 * NODE_GAP  # numbers of neighbouring structures in two rows
    edge = {axis: grid[axis][0] - gap if before[axis] else grid[axis][-1] + gap for axis in "xy"}
    style = dict(fontsize=5.5, color="#666666", ha="center", va="center")
    for number, x in enumerate(grid["x"]):
        ax.text(x, edge["y"], f"{number}", **style)
    for number, y in enumerate(grid["y"]):
        ax.text(edge["x"], y, f"{number}", **style)


def draw_outline(ax, element, **style):
    """The bounding rectangle of an element in plan."""
    low, high = element.solid.bounds[:, :2]
    ax.add_patch(Rectangle(low, *(high - low), **style))


def draw_wall(ax, start, end, opened):
    """The sheathing of a bay seen from above: a filled band, or two lines where it has a window or a door (opened)."""
    aside = WALL_WIDTH / 2 * np.array([start[1] - end[1], end[0] - start[0]]) / np.linalg.norm(end - start)
    ax.add_patch(Polygon([start + aside, end + aside, end - aside, start - aside], closed=True, edgecolor=WALL, lw=0.8,
                         facecolor="white" if opened else WALL, zorder=1 if opened else 1.5))


def finish_plan(ax, columns):
    """Dimensions between the centres of the outermost columns, limits, no frame. columns: elements, at least one"""
    centres = np.array([e.solid.centroid[:2] for e in columns if e.group == columns[0].group])
    low, high = centres.min(0), centres.max(0)
    positions = np.array([e.solid.centroid[:2] for e in columns])
    for end in ((high[0], low[1]), (low[0], high[1])):
        aside = np.where(low == end, 0.65, 0)
        ax.annotate("", low - aside, end - aside,
                    arrowprops=dict(arrowstyle="<->", lw=0.7, color=INK, shrinkA=0, shrinkB=0))
    ax.annotate(f"{high[0] - low[0]:.2f} m", ((low[0] + high[0]) / 2, low[1] - 0.7), fontsize=7, ha="center", va="top")
    ax.annotate(f"{high[1] - low[1]:.2f} m", (low[0] - 0.75, (low[1] + high[1]) / 2), fontsize=7, ha="right",
                va="center", rotation=90)
    ax.set(xlim=(positions[:, 0].min() - 1.3, positions[:, 0].max() + 0.6),
           ylim=(positions[:, 1].min() - 1.3, positions[:, 1].max() + 0.6), aspect="equal")
    ax.axis("off")


def frame_damage(ax, positions):
    """An ellipse around damaged joints (paper, Fig. 10), and a mark at each. positions: list of (2,) [m]."""
    if not len(positions):
        return
    positions = np.array(positions)
    low, high = positions.min(0), positions.max(0)
    size = np.maximum(1.1 * (high - low) + DAMAGE_MARGIN, 2 * DAMAGE_MARGIN)
    ax.add_artist(Ellipse((low + high) / 2, *size, fill=False, edgecolor=colors.ORANGE, lw=1.6, zorder=8,
                          clip_on=False))
    ax.plot(*positions.T, linestyle="none", marker="o", markersize=3.5, markerfacecolor="white",
            markeredgecolor="black", markeredgewidth=0.8, zorder=9)


def legend(figure, solids, walls, model):
    symbol = partial(Line2D, [], [], linestyle="none", color="black")
    entries = kind_entries(solids) + wall_entries({wall.kind for wall in walls})
    for size in sorted({max(e.section) for e in model.of_kind("column")}, reverse=True):
        entries.append(symbol(marker="s", markersize=6, markerfacecolor="black" if size >= THICK else "white",
                              label=f"column {100 * size:g} cm (plan)"))
    if any(e.storey == 1 for e in model.of_kind("brace")):
        entries.append(symbol(marker=">", markersize=7, color=colors.BLUE, label="brace (plan; thin end: foot)"))
    if any(j.sheet and j.storey == 1 for j in model.joints):
        entries.append(Patch(facecolor=WALL, edgecolor=WALL, label="wall (plan; open: window, door)"))
    if any(j.broken for j in model.joints):
        entries.append(symbol(marker="o", markersize=4, markerfacecolor="white", label="joint broken before the start"))
    columns = -(-len(entries) // 2) if len(entries) > 8 else len(entries)
    figure.legend(handles=entries, loc="lower center", ncols=columns, frameon=False, fontsize=8, handletextpad=0.5,
                  columnspacing=1.4)

# SPDX-License-Identifier: GPL-2.0-or-later
"""Drawings of a house as it is built (paper, Figs. 5-8 and 10): in space, front, side, plan of the first floor. Needs no YADE."""
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse, Patch, Polygon, Rectangle

from ..base import colors as palette
from .raster import shade
from .sheets import PRINT, save
from .views import FRONT, INK, LEGEND_KINDS, SIDE, Solid, View, draw_ends, draw_view, window

OBLIQUE = View("space", "In space, from the north-east (roof half see-through)", (-0.64, 0.768, 0.0), (0.704, 0.587, 0.4), "", "", (-0.307, -0.256, 0.917))
SEE_THROUGH = ("roof", "snow")
ROOF_SHARE = 0.6
"""How much the see-through parts hide. [-]"""
CELLS = ((0.06, 0.49, 0.42, 0.375), (0.55, 0.49, 0.42, 0.375), (0.06, 0.105, 0.42, 0.335), (0.55, 0.105, 0.42, 0.335))
"""Places of the four drawings: left, bottom, width, height in parts of the figure."""
DAMAGE_MARGIN = 0.35
"""Between damaged joints and the ellipse that frames them. [m]"""
THICK = 0.11
"""Columns at least so thick are drawn black in the plan. [m]"""


def write(stem, model):
    """Write `stem`.png and `stem`.pdf: the drawings of a HouseModel. Returns the paths. Raises OSError."""
    return save(page(model, PRINT.dpi), stem, ("png", "pdf"), PRINT.dpi)


def page(model, dpi):
    """Figure with the drawings of a HouseModel. dpi: of the shaded parts [1/inch]"""
    figure = Figure(figsize=(PRINT.width, PRINT.height), facecolor="white")
    FigureCanvasAgg(figure)
    solids = [solid(e) for e in model.elements]
    space, front, side, plan = (figure.add_axes(place) for place in CELLS)
    draw_space(space, solids, dpi)
    for ax, view in ((front, FRONT), (side, SIDE)):
        draw_elevation(ax, view, solids, model, dpi)
    draw_plan(plan, model)
    figure.text(0.03, 0.963, f"House {model.name}", parse_math=False, fontsize=14, fontweight="bold", va="center")
    figure.text(0.03, 0.944, describe(model), parse_math=False, fontsize=9, va="top", linespacing=1.4)
    legend(figure, solids, model)
    return figure


def solid(element):
    """Solid of an element where it is built."""
    faces = [face.points for face in element.solid.faces]
    starts = np.cumsum([0, *map(len, faces)])
    return Solid(element.kind, np.vstack(faces), [list(range(a, b)) for a, b in zip(starts, starts[1:])], palette.KINDS.get(element.kind, palette.OTHER))


def describe(model):
    """What the house is made of, in words."""
    found = model.counts()
    snow = f", snow {found['mass_snow'] / 1000:.1f} t" if found["mass_snow"] else ""
    columns = " and ".join(f"{count} columns of {100 * size:g} cm" for size, count in sorted(found["columns_by_section"].items(), reverse=True))
    return f"{model.description}\n{columns}, {found['braces']} braces, {found['joints']} joints{snow}"


def cell(ax):
    """(width, height) of axes. [inch]"""
    place = ax.get_position()
    return place.width * PRINT.width, place.height * PRINT.height


def density(ax, box, dpi):
    """Pixels per metre, a multiple of 2, with which a box fills axes."""
    width, height = cell(ax)
    return int(dpi * min(width / (box[1] - box[0]), height / (box[3] - box[2]))) // 2 * 2


def draw_space(ax, solids, dpi):
    """All elements in an oblique parallel view, the roof see-through."""
    shown = np.vstack([s.vertices for s in solids if s.kind != "ground"])
    across, up = shown @ OBLIQUE.right, shown @ OBLIQUE.up
    box = across.min() - 0.3, across.max() + 0.3, up.min() - 0.3, up.max() + 0.3
    pixels = density(ax, box, dpi)
    whole, frame = (shade([s for s in solids if s.kind not in hidden], OBLIQUE, box, pixels, sky=1.0)[0] for hidden in (("ground",), ("ground", *SEE_THROUGH)))
    ax.imshow(ROOF_SHARE * whole + (1 - ROOF_SHARE) * frame, extent=box, interpolation="antialiased", aspect="equal")
    ax.set_title(OBLIQUE.title, fontsize=9, loc="left")
    ax.axis("off")


def draw_elevation(ax, view, solids, model, dpi):
    """Front or side view with the heights of floors and ridge."""
    box = window(view, solids, [])
    draw_view(ax, view, box, density(ax, box, dpi), solids, None, [])
    ax.set_title(view.title, fontsize=9, loc="left")
    draw_ends(ax, view, 8)
    heights = sorted({0.0, *(z for levels in model.storey_levels.values() for pair in levels.values() for z in pair), max(e.vertices[:, 2].max() for e in model.elements)})
    ax.set_yticks(heights, [f"{z:.2f} m" if z else "0" for z in heights], fontsize=7)
    frame_damage(ax, [(np.dot(j.centre, view.right), j.centre[2]) for j in model.joints if j.broken])


def draw_plan(ax, model):
    """First floor from above: grid lines, columns by section, braces, damaged joints. North is up."""
    columns = [e for e in model.of_kind("column") if e.storey == 1]
    for name, axis in (("v", 0), ("h", 1)):
        for place in sorted({round(float(e.solid.centroid[axis]), 3) for e in columns}):
            (ax.axvline if name == "v" else ax.axhline)(place, color="#bbbbbb", lw=0.5, zorder=0)
    for element in model.of_kind("sill"):
        draw_outline(ax, element, facecolor="none", edgecolor="#999999", lw=0.5)
    for element in columns:
        low, high = element.solid.bounds[:, :2]
        thick = max(element.section) >= THICK
        ax.add_patch(Rectangle(low, *(high - low), facecolor="black" if thick else "white", edgecolor="black", lw=0.8, zorder=3))
    for element in model.of_kind("brace"):
        if element.storey == 1:
            draw_brace(ax, element)
    broken = [j.centre[:2] for j in model.joints if j.broken and j.storey == 1]
    frame_damage(ax, broken)
    ax.set_title("Plan of the first floor, north up: columns and braces", fontsize=9, loc="left")
    finish_plan(ax, columns)


def draw_outline(ax, element, **style):
    low, high = element.solid.bounds[:, :2]
    ax.add_patch(Rectangle(low, *(high - low), **style))


def draw_brace(ax, element):
    """A brace seen from above: a wedge that is thick at its head."""
    z = element.vertices[:, 2]
    middle = (z.min() + z.max()) / 2
    foot, head = element.vertices[z < middle, :2].mean(0), element.vertices[z > middle, :2].mean(0)
    along = (head - foot) / np.linalg.norm(head - foot)
    aside = 0.11 * np.array([-along[1], along[0]])
    ax.add_patch(Polygon([foot, head + aside, head - aside], closed=True, facecolor=palette.BLUE, edgecolor="none", zorder=2))


def finish_plan(ax, columns):
    """Lengths between the outermost columns' centres, limits, no frame."""
    centres = np.array([e.solid.centroid[:2] for e in columns if e.group == columns[0].group])
    low, high = centres.min(0), centres.max(0)
    spots = np.array([e.solid.centroid[:2] for e in columns])
    ax.annotate("", (low[0], low[1] - 0.65), (high[0], low[1] - 0.65), arrowprops=dict(arrowstyle="<->", lw=0.7, color=INK, shrinkA=0, shrinkB=0))
    ax.annotate(f"{high[0] - low[0]:.2f} m", ((low[0] + high[0]) / 2, low[1] - 0.7), fontsize=7, ha="center", va="top")
    ax.annotate("", (low[0] - 0.65, low[1]), (low[0] - 0.65, high[1]), arrowprops=dict(arrowstyle="<->", lw=0.7, color=INK, shrinkA=0, shrinkB=0))
    ax.annotate(f"{high[1] - low[1]:.2f} m", (low[0] - 0.75, (low[1] + high[1]) / 2), fontsize=7, ha="right", va="center", rotation=90)
    ax.set(xlim=(spots[:, 0].min() - 1.3, spots[:, 0].max() + 0.6), ylim=(spots[:, 1].min() - 1.3, spots[:, 1].max() + 0.6), aspect="equal")
    ax.axis("off")


def frame_damage(ax, places):
    """An ellipse around damaged joints (paper, Fig. 10), and a mark at each. places: list of (2,) [m]."""
    if not len(places):
        return
    places = np.array(places)
    low, high = places.min(0), places.max(0)
    size = np.maximum(1.1 * (high - low) + DAMAGE_MARGIN, 2 * DAMAGE_MARGIN)
    ax.add_patch(Ellipse((low + high) / 2, *size, fill=False, edgecolor=palette.ORANGE, lw=1.6, zorder=8, clip_on=False))
    ax.plot(*places.T, linestyle="none", marker="o", markersize=3.5, markerfacecolor="white", markeredgecolor="black", markeredgewidth=0.8, zorder=9)


def legend(figure, solids, model):
    """What colours and signs mean: only what occurs."""
    kinds = {s.kind: s.color for s in solids}
    sections = sorted({max(e.section) for e in model.of_kind("column")}, reverse=True)
    entries = [Patch(facecolor=kinds[kind], edgecolor=INK, linewidth=0.6, label=name) for kind, name in LEGEND_KINDS.items() if kind in kinds]
    for size in sections:
        entries.append(Line2D([], [], linestyle="none", marker="s", markersize=6, markerfacecolor="black" if size >= THICK else "white", markeredgecolor="black",
                              label=f"column {100 * size:g} cm (plan)"))
    if any(e.storey == 1 for e in model.of_kind("brace")):
        entries.append(Line2D([], [], linestyle="none", marker=">", markersize=7, color=palette.BLUE, label="brace (plan; thin end: foot)"))
    if any(j.broken for j in model.joints):
        entries.append(Line2D([], [], linestyle="none", marker="o", markersize=4, markerfacecolor="white", markeredgecolor="black", label="joint broken before the start"))
    figure.legend(handles=entries, loc="lower center", ncols=-(-len(entries) // 2) if len(entries) > 8 else len(entries), frameon=False, fontsize=8, handletextpad=0.5, columnspacing=1.4)

# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of a built house: no two elements overlap, every column stands on something and carries something."""

import numpy as np

from .errors import HouseError
from .geometry import separation
from .joints import near_pairs

TOUCH = 1e-7  # [m] overlaps up to this count as flush; rounding in the builder stays below 1e-9


def check_house(model):
    """Raises HouseError for the deepest overlap or the first loose column end; returns what was checked:
    {'pairs': near pairs tested exactly, 'touching': pairs in contact, 'deepest': largest overlap [m] (rounding)}."""
    gaps = overlaps(model)
    deepest = min(gaps, key=lambda row: row[2], default=None)
    if deepest and deepest[2] < -TOUCH:
        _report_overlap(*deepest, count=sum(gap < -TOUCH for _, _, gap in gaps))
    _check_columns(model)
    return {"pairs": len(gaps), "touching": sum(gap < TOUCH for _, _, gap in gaps), "deepest": max(0.0, -min((g for *_, g in gaps), default=0.0))}


def overlaps(model):
    """[(element, element, gap [m])] of all pairs whose bounding boxes touch; a negative gap is an overlap (exact, convex bodies)."""
    return [(a, b, separation(a.solid, b.solid)) for a, b in near_pairs(model.elements, TOUCH)]


def _report_overlap(a, b, gap, count):
    low = np.maximum(a.solid.bounds[0], b.solid.bounds[0])
    high = np.minimum(a.solid.bounds[1], b.solid.bounds[1])
    x, y, z = (low + high) / 2
    more = f" (and {count - 1} more such pairs)" if count > 1 else ""
    raise HouseError(f"{b.source}: {b.kind} {b.name} overlaps {a.kind} {a.name} ({a.source}) by {-gap * 1000:.3g} mm "
                     f"near x {x:.3f}, y {y:.3f}, z {z:.3f} m; move or shorten one of them{more}")


def _check_columns(model):
    """Each column needs a joint at its foot and one at its head."""
    jointed = {(joint.a, joint.end) for joint in model.joints}
    for column in model.of_kind("column"):
        for end, verb in (("bottom", "stands on nothing"), ("top", "carries nothing")):
            if (column.name, end) not in jointed:
                x, y, _ = column.solid.centroid
                z = column.solid.bounds[0 if end == "bottom" else 1][2]
                raise HouseError(f"{column.source}: column {column.name} {verb} at x {x:.3f}, y {y:.3f}, z {z:.3f} m; "
                                 f"lay a beam, sill or floor there or remove the column")

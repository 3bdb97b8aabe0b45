# SPDX-License-Identifier: GPL-2.0-or-later
"""Wall sheets in pictures: plates in the plane of a bay, each half fixed to a column. Those of a broken sheet are torn.

Still views, films, the player and VTK draw these plates; sheets of one bay lie beside each other.
"""
from collections import Counter
from dataclasses import dataclass, replace
from functools import cache, lru_cache

import numpy as np

from ..recording.record import rotated

THICKNESS, LAYER = 0.02, 0.03
"""Of a plate; distance between the middles of plates of one bay. [m]"""
OPENINGS = {"window": (0.2, 0.33, 0.78), "door": (0.2, 0.0, 0.75)}
"""Distance of an opening from both columns, its lower and upper edge, as parts of the bay."""
TEETH, TOOTH = (0.47, 0.36), 0.17
"""Ends of the torn edge, distance between them, as parts of the bay."""
MARKS = {"none": (0.25, 0.5), "window": (0.28, 0.165), "door": (0.28, 0.875)}
"""Place of a sheet's mark, on its first half, as parts of the bay."""
STATES = {"whole": 0, "partly": 1, "broken": 2, "before": 3}
"""Numbers of the states of joints and sheets for the graphics card and VTK."""
BOX = ((0, 1, 2, 3), (7, 6, 5, 4), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0))
"""Faces of a prism of four sides: front, back, edges."""


@dataclass
class Plate:
    """Half of a sheet. body: the column that carries it; vertices (n, 3): in the world before the first step, or in the
    body frame [m]; torn: its form when the sheet is broken, else when it is not
    """

    sheet: int
    body: int
    torn: bool
    vertices: np.ndarray
    faces: list

    def shows(self, states):
        """Whether it is drawn. states: of all sheets"""
        return self.torn == (states[self.sheet] == "broken")


@lru_cache(2)
def plates(frames):
    """Plates of a run, vertices in the body frames of their columns."""
    e = frames.elements
    return _moved(_plates(_bays(frames)), lambda body, places: _local(e.position[body], e.orientation[body], places))


def placed_plates(plates, states, position, orientation):
    """The Plates that show states of the sheets, in the world. position, orientation: of the elements"""
    return _moved([plate for plate in plates if plate.shows(states)],
                  lambda body, vertices: position[body] + rotated(orientation[body], vertices))


def _moved(plates, move):
    """Plates in another frame. move: (bodies (n,), vertices (n, 3)) -> (n, 3)"""
    if not plates:
        return []
    counts = [len(plate.vertices) for plate in plates]
    body = np.repeat([plate.body for plate in plates], counts)
    moved = np.split(move(body, np.concatenate([plate.vertices for plate in plates])), np.cumsum(counts)[:-1])
    return [replace(plate, vertices=vertices) for plate, vertices in zip(plates, moved)]


def plates_as_built(model):
    """([Plate] in the world, states) of the sheets of a HouseModel."""
    halves = {}
    for joint in model.joints:
        if joint.sheet:
            halves.setdefault(joint.sheet, []).append(joint.broken)
    number = {element.name: k for k, element in enumerate(model.elements)}
    bays = [(number[sheet.low], number[sheet.high], bay_corners(*(model.element(name).vertices
                                                                  for name in (sheet.low, sheet.high))), sheet.opening)
            for sheet in halves]
    return _plates(bays), ["broken" if all(broken) else "whole" for broken in halves.values()]


def states(frames, frame):
    """State of each sheet in a frame."""
    return frames.joints.sheet_states(frames.joint_states(frame) != "whole")


def mark_anchors(frames):
    """((J,) bodies, (J, 3) places in their frames [m]) of the marks of joints: those of a sheet are on its plate."""
    e, j = frames.elements, frames.joints
    body, anchor, halves = np.array(j.a), np.array(j.anchor, float), j.of_walls
    places = np.array([_place(corners, *MARKS[opening]) for _, _, corners, opening in _bays(frames)]).reshape(-1, 3)
    sheet = np.asarray(j.sheet)[halves]
    body[halves] = low = np.asarray(frames.sheets.low)[sheet]
    anchor[halves] = _local(e.position[low], e.orientation[low], places[sheet])
    return body, anchor


def marks(frames, anchors, frame, position, orientation):
    """((M, 3) places [m], (M,) states) of the marks of damaged joints, one of each wall sheet, in a frame.

    anchors: from `mark_anchors`; position, orientation: of the elements
    """
    state, j = frames.joint_states(frame), frames.joints
    walls = np.flatnonzero(j.of_walls)
    first = walls[np.unique(np.asarray(j.sheet)[walls], return_index=True)[1]]
    of_sheets = np.where(state[first] == "before", "before", states(frames, frame))
    state[walls] = "whole"
    state[first] = of_sheets
    body, anchor = (values[state != "whole"] for values in anchors)
    return np.asarray(position)[body] + rotated(np.asarray(orientation)[body], anchor), state[state != "whole"]


def bay_corners(low, high):
    """(4, 3) ends of the axes of a bay's columns: foot and foot, head and head. low, high: their corners (n, 3) [m]"""
    (foot, head), (other_foot, other_head) = ((c[c[:, 2] < c[:, 2].mean()].mean(0), c[c[:, 2] > c[:, 2].mean()].mean(0))
                                              for c in (low, high))
    return np.array([foot, other_foot, other_head, head])


def _bays(frames):
    """[(low, high, corners, opening)] of the sheets of a run."""
    s = frames.sheets
    corners = {int(column): frames.corners_at_start(column) for column in {*s.low, *s.high}}
    return [(int(low), int(high), bay_corners(corners[low], corners[high]), opening)
            for low, high, opening in zip(s.low, s.high, s.opening)]


def _local(position, orientation, places):
    """Places in the world (n, 3) in the frames of bodies. [m]"""
    return rotated(orientation * (1, -1, -1, -1), places - position)


def _plates(bays):
    """Plates of sheets, vertices in the world. bays: as from `_bays`"""
    of_bay, before, made = Counter(bay[:2] for bay in bays), Counter(), []
    for sheet, (low, high, corners, opening) in enumerate(bays):
        aside = LAYER * (before[low, high] - (of_bay[low, high] - 1) / 2)
        before[low, high] += 1
        normal = np.cross(corners[1] - corners[0], corners[3] - corners[0])
        normal /= np.linalg.norm(normal)
        for body, mirrored in ((low, False), (high, True)):
            for torn in (False, True):
                made.append(Plate(sheet, body, torn, *_solid(corners, opening, torn, mirrored, aside, normal)))
    return made


def _cells(opening, torn):
    """Quadrilaterals (4, 2) of a sheet's first half, as parts of the bay, counter-clockwise."""
    if opening == "none":
        strips = [(0.0, 0.5, 0.0, 1.0)]
    else:
        beside, low, high = OPENINGS[opening]
        strips = [(0.0, beside, 0.0, 1.0), (beside, 0.5, 0.0, low), (beside, 0.5, high, 1.0)]
    cells = []
    for left, right, low, high in strips:
        if low < high:
            count = max(1, round((high - low) / TOOTH)) if torn and right == 0.5 else 1
            levels = np.linspace(low, high, count + 1)
            ends = [TEETH[k % 2] if torn and right == 0.5 else right for k in range(count + 1)]
            cells += [[(left, v), (end, v), (next_end, next_v), (left, next_v)]
                      for v, next_v, end, next_end in zip(levels, levels[1:], ends, ends[1:])]
    return cells


@cache
def _outlines(opening, torn, mirrored):
    """(C, 4, 2) cells of a half of a sheet, counter-clockwise, and the faces of the prisms over them."""
    cells = np.array(_cells(opening, torn))
    cells = cells[:, ::-1] * (-1, 1) + (1, 0) if mirrored else cells
    return cells, [[8 * number + k for k in face] for number in range(len(cells)) for face in BOX]


def _solid(corners, opening, torn, mirrored, aside, normal):
    """(vertices, faces) of a half. corners, normal: of its bay; aside: of its middle plane [m]"""
    cells, faces = _outlines(opening, torn, mirrored)
    points = _place(corners, *np.moveaxis(cells[..., None], 2, 0))
    sides = [points + (aside + side * THICKNESS / 2) * normal for side in (1, -1)]
    return np.concatenate(sides, axis=1).reshape(-1, 3), faces


def _place(corners, u, v):
    """Place in a bay: parts of its length and height."""
    foot, other_foot, other_head, head = corners
    return (1 - u) * (1 - v) * foot + u * (1 - v) * other_foot + u * v * other_head + (1 - u) * v * head

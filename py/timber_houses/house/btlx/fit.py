# SPDX-License-Identifier: GPL-2.0-or-later
"""Fitting of imported parts: files round directions to 0.5 mrad, and the model keeps parts convex. Lengths in m.

1. Ends are lengthened by ROUNDING.
2. Parts that overlap, now also where an end only meets a face, are cut apart along a face of one of them: a rounding
   where that costs the least volume; laps, notches and housings also by the share of a part that it costs, and
   rather at an end that lies on another part than at one under it. A part that would lose more than MOST_LOST is
   divided at the other one instead.
3. Ends that met nothing get their length back."""
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations

import numpy as np

from ..errors import HouseError
from ..geometry import SAME, halfspace_vertices, near_boxes, polyhedron, separation
from .reader import Part

ROUNDING = 1.5e-3  # gap that rounding leaves between parts of 2 m that meet. [m]
OVERLAP = 1e-7  # overlap that is no more than rounding. [m]
MOST_LOST = 0.25  # largest share of its volume that a part loses where it overlaps another, as half a lap. [-]
TRIED = 10.0  # cuts of a pair that are compared: those of up to so many times the least rough share. [-]


@dataclass(frozen=True, eq=False)
class Piece:
    """A convex part at its place. axes: rows x, y, z (3, 3); origin: of the part's frame (3,) [m]; planes: [(outward
    normal (3,), offset [m])] in the project's frame; source: name of the piece that was divided, or its own;
    longer: those of its planes that were moved out by ROUNDING"""

    name: str
    part: Part
    origin: np.ndarray
    axes: np.ndarray
    planes: list
    source: str
    longer: tuple = ()

    @cached_property
    def solid(self):
        """Raises HouseError."""
        try:
            solid = polyhedron(halfspace_vertices(self.planes))
            solid.hull
        except ValueError:
            raise HouseError(f"{self.part.where}: part {self.name}: its cuts leave nothing of it; correct"
                             " them") from None
        return solid

    def is_end(self, normal):
        return abs(normal @ self.axes[0]) > 0.1

    def bounded(self, plane):
        """(the piece without what lies beyond a plane, volume that it lost [m3]), None if nothing is left."""
        piece = replace(self, planes=[*self.planes, plane])
        try:
            return piece, self.solid.volume - piece.solid.volume
        except HouseError:
            return None


def fitted(pieces):
    """Pieces whose ends lie flush on the faces that they meet, without overlaps."""
    lengthened = []
    for piece in pieces:
        planes = [(normal, offset + ROUNDING * piece.is_end(normal)) for normal, offset in piece.planes]
        longer = tuple(plane for plane in planes if piece.is_end(plane[0]))
        lengthened.append(replace(piece, planes=planes, longer=longer))
    return [replace(piece, planes=[*piece.planes, *((face.normal, face.offset - ROUNDING) for face in piece.solid.faces
                                                    if _excess(piece, face))]) for piece in _separate(lengthened)]


def _excess(piece, face):
    """Length by which a face was moved out. [m]"""
    return ROUNDING * any(normal @ face.normal > 1 - SAME and abs(offset - face.offset) < SAME
                          for normal, offset in piece.longer)


def near(pieces, margin):
    """[(i, j)] of pieces with bounding boxes within `margin` [m]."""
    return [(i, j) for i, others in near_boxes([piece.solid for piece in pieces], margin) for j in others]


def _separate(pieces):
    """Pieces without overlaps, the deepest of which is removed first."""
    def overlap(pair):
        return -separation(*(pieces[k].solid for k in pair))

    todo = sorted(near(pieces, 0.0), key=overlap, reverse=True)
    while todo:
        i, j = todo.pop(0)
        depth = overlap((i, j))
        if depth <= OVERLAP:
            continue
        kept = _cut_apart(pieces[i], pieces[j], depth)
        if kept is None:
            divided, whole = sorted((i, j), key=lambda k: pieces[k].solid.volume)
            pieces[divided], rest = _divided(pieces[divided], pieces[whole])
            todo += [(sum(pair) - divided, len(pieces)) for pair in todo if divided in pair]
            pieces.append(rest)
        else:
            pieces[i], pieces[j] = kept
    return pieces


def _cut_apart(a, b, depth):
    """Both pieces, one of them cut at a face of the other; None if it would lose more than MOST_LOST. depth: of their
    overlap [m]"""
    pair = ((a, b), (b, a))
    cuts = [cut for which in (0, 1) for cut in _cuts(*pair[which], which)]
    least = min((rough for rough, *_ in cuts), default=0.0)
    found = []
    for rough, which, plane, excess in cuts:
        result = pair[which][0].bounded(plane) if rough <= TRIED * least else None
        if result:
            cost = result[1] if depth < 3 * ROUNDING else _cost(*pair[which], plane, result[1])
            found.append((cost, which, pair[which][0].bounded((plane[0], plane[1] + excess))))
    _, which, (piece, lost) = min(found, key=lambda cut: cut[0], default=(0.0, 0, (a, np.inf)))
    if lost > MOST_LOST * pair[which][0].solid.volume:
        return None
    return (piece, b) if which == 0 else (a, piece)


def _cost(piece, other, plane, lost):
    """Volume that a piece loses [m3] times its share; twice that of an end under the other piece, as it may be that of
    a plate on a post."""
    is_below = piece.solid.centroid[2] < other.solid.centroid[2] - ROUNDING
    return lost**2 / piece.solid.volume * (2 if is_below and piece.is_end(plane[0]) else 1)


def _cuts(piece, other, which):
    """[(rough share of the piece behind a face of the other one, which, plane that removes it, length by which this
    face was moved out)]"""
    heights = other.solid.face_normals @ piece.solid.vertices.T
    offsets = np.array([face.offset for face in other.solid.faces])
    shares = (offsets - heights.min(1)) / np.ptp(heights, axis=1)
    return [(share, which, (-face.normal, -face.offset), _excess(other, face))
            for share, face in zip(shares, other.solid.faces) if share < 1]


def _divided(piece, other):
    """The two pieces NAME-1 and NAME-2 of one that is divided where the other one passes."""
    found = []
    for one, two in combinations(other.solid.faces, 2):
        if one.normal @ two.normal < -0.9:
            parts = [piece.bounded((-face.normal, -face.offset)) for face in (one, two)]
            if all(parts):
                found.append((sum(lost for _, lost in parts), [part for part, _ in parts]))
    if not found:
        raise HouseError(f"{piece.part.where}: part {piece.name} lies largely within part {other.name}"
                         f" ({other.part.where}); remove one")
    _, parts = min(found, key=lambda pair: pair[0])
    return [replace(part, name=f"{part.name}-{number}") for number, part in enumerate(parts, 1)]

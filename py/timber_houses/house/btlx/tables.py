# SPDX-License-Identifier: GPL-2.0-or-later
"""Parts of a BTLx project -> tables of a house file: its `frame` with a joint for each pair of parts that meet."""
import re
import warnings
from collections import Counter, defaultdict
from dataclasses import replace
from itertools import chain, product

import numpy as np

from ..bars import section_axes
from ..geometry import SAME, SNAP_DIGITS, contact_polygon, halfspace_vertices, polygon_area, polyhedron, products
from ..parser import Items, Table
from .cuts import PAIRED, box_planes, half_spaces, reference_point
from .fit import ROUNDING, Piece, fitted, near

TOLERANCE, LEAST_AREA = 1e-3, 1e-3
"""Of parts that meet: largest gap [m], least common area [m2]: `joint_search` of `cad.yaml`."""
UPRIGHT, LEVEL = 0.985, 0.17  # vertical part of the axis of a column, at least, and of a beam, at most: 10 degrees. [-]
RAFTER = re.compile("rafter|sparren|chevron", re.I)  # designations of inclined parts that are no braces
SHEET = 0.06, 4.0  # a part up to this thick [m] is a sheet if it is so many times as wide
FACE = 1e-3  # height above the lowest point up to which faces are level with it. [m]
PAD = 0.1  # height of the pads under columns, and distance of their edges from these. [m]
REACH = 3e-3  # largest distance of a processing's middle from the part that it joins. [m]
MARGIN = 5e-3  # of the box about a member where cuts bound it. [m]
NEGLIGIBLE = 1e-4  # share of a part's volume that a left-out plane may have cut off. [-]
SLIVER = 2e-5  # area of a face without which a part is as good. [m2]


def house_table(project, file):
    """Table of a house file. Warns of what is left out. Raises HouseError."""
    rough, ignored = _pieces(project)
    pieces = fitted(rough)
    found = {(i, j): contact_polygon(pieces[i].solid, pieces[j].solid, TOLERANCE) for i, j in near(pieces, ROUNDING)}
    contacts = {pair: contact[0].mean(0) for pair, contact in found.items() if contact and contact[2] > LEAST_AREA}
    joints, used = _joints(pieces, rough, contacts)
    members, where = _members(pieces, contacts), f"{file}:1"
    named = [(pieces[i].name, pieces[j].name, how) for (i, j), how in joints.items()]
    named += [(name.removeprefix("pad-"), name, "butt") for name in list(members)[len(pieces):]]
    hows = ", ".join(f"{count} {how}" for how, count in sorted(Counter(how for *_, how in named).items()))
    lines = [*_lines(project, rough, pieces, ignored, used), f"{len(named)} joints ({hows})", _supports(members)]
    for line in lines:
        warnings.warn(f"{file}: {line}", stacklevel=2)
    frame = {"members": Table(members, where),
             "joints": Items([Table({"between": Items(pair, where), "type": how}, where) for *pair, how in named])}
    return Table({"name": _word(file.rpartition(".")[0]), "description": "; ".join(lines)[:1000], "extends": "cad",
                  "frame": Table(frame, where)}, where)


def _pieces(project):
    """(a Piece for each place of each part, Counter of the processings without volume); coordinates from the origin of
    the first one on."""
    base, copies, pieces, ignored = project.parts[0].places[0][0], Counter(), [], Counter()
    for part in project.parts:
        label = f"{_word(part.designation.rpartition(' ')[2])}-{_word(part.number)}"
        found = [half_spaces(step, part.size) for step in part.processings]
        ignored.update(step.kind for step, planes in zip(part.processings, found) if not planes for _ in part.places)
        for place in part.places:
            copies[label] += 1
            name = label if copies[label] == 1 else f"{label}-copy{copies[label]}"
            origin, (_, x, y) = place[0] - base, place  # x and y at nearly a right angle
            x = x - (x @ y) * y  # y as stated, which all parts of a wall or roof share
            x = x / np.linalg.norm(x)
            axes = np.array([x, y, np.cross(x, y)])
            planes = [(normal @ axes, float(offset + normal @ axes @ origin))
                      for normal, offset in chain(box_planes(part.size), *found)]
            pieces.append(_without_slivers(Piece(name, part, origin, axes, planes, name)))
    return pieces, ignored


def _word(text):
    """A name of a house file without '-', which sets off numbers of parts, copies and pieces."""
    return re.sub(r"\W+", "_", text)[-20:].strip("_") or "part"


def _without_slivers(piece):
    """The piece without planes that cut next to nothing off."""
    areas = [polygon_area(products(face.points, face.axes.T)) for face in piece.solid.faces]
    for k in np.argsort(areas)[:sum(area < SLIVER for area in areas)]:
        normals = np.array([normal for normal, _ in piece.planes])
        nearest = int(np.argmax(normals @ piece.solid.faces[k].normal))
        planes = piece.planes[:nearest] + piece.planes[nearest + 1:]
        try:
            volume = polyhedron(halfspace_vertices(planes)).volume
        except ValueError:
            continue
        if abs(volume - piece.solid.volume) < NEGLIGIBLE * piece.solid.volume:
            return _without_slivers(replace(piece, planes=planes))
    return piece


def _joints(pieces, rough, contacts):
    """({(index, index): how the pieces meet}, Counter of the processings that say so). rough: pieces before they were
    cut apart, of the same indices; contacts: {(index, index): middle of the common area (3,) [m]}"""
    joints, used, mates = dict.fromkeys(contacts, "butt"), Counter(), defaultdict(list)
    for i, j in contacts:
        mates[i].append(j)
        mates[j].append(i)
    before = rough + pieces[len(rough):]
    for k, piece in enumerate(rough):
        steps = [step for step in piece.part.processings if step.kind in PAIRED and mates[k]]
        points = [piece.origin + reference_point(step, piece.part.size) @ piece.axes for step in steps]
        distances = []  # from the points to the mates, 0 inside; too small beyond their edges [m]
        for mate in mates[k] if points else ():
            normals, offsets = (np.array(each) for each in zip(*before[mate].planes))
            distances.append(np.maximum((np.array(points) @ normals.T - offsets).max(1), 0.0))
        for step, nearest, distance in zip(steps, np.argmin(distances, 0), np.min(distances, 0)) if points else ():
            if distance < REACH:
                joints[tuple(sorted((k, mates[k][nearest])))] = PAIRED[step.kind]
                used[step.kind] += 1
    return joints, used


def _members(pieces, contacts):
    """{name: table of a member}. The lowest point comes to z = 0, or to the top of the pads under columns there."""
    low = np.min([piece.solid.bounds[0] for piece in pieces], axis=0)
    joined = defaultdict(set)
    for pair, middle in contacts.items():
        for k in pair:
            joined[k].add((middle - pieces[k].solid.centroid) @ pieces[k].axes[0] > 0)
    resting = [any(face.normal[2] < -0.999 and face.points[:, 2].max() < low[2] + FACE for face in piece.solid.faces)
               for piece in pieces]
    kinds = [_kind(piece, rests, len(joined[k]) == 2) for k, (piece, rests) in enumerate(zip(pieces, resting))]
    feet = [piece for piece, kind, rests in zip(pieces, kinds, resting) if kind == "column" and rests]
    shift = [0, 0, PAD if feet else 0.0] - low
    fixed = [kind == "sill" or not any(resting) and bool(piece.solid.bounds[0][2] < low[2] + FACE)
             for piece, kind in zip(pieces, kinds)]
    members = {piece.name: _member(piece, kind, is_fixed, shift) for piece, kind, is_fixed in zip(pieces, kinds, fixed)}
    return members | {f"pad-{piece.name}": _pad(piece, shift) for piece in feet}


def _kind(piece, rests, is_joined):
    """rests: whether a face looks down at the lowest height; is_joined: whether both halves of the piece meet others"""
    rise, (thin, wide) = abs(piece.axes[0][2]), sorted(piece.part.size[1:])
    if thin <= SHEET[0] and wide > SHEET[1] * thin:
        across = piece.axes[1 if piece.part.size[1] == thin else 2]
        return "floor" if abs(across[2]) > UPRIGHT else "roof" if abs(across[2]) > 0.5 else "beam"
    if rise > UPRIGHT:
        return "column"
    if rise < LEVEL:
        return "sill" if rests else "beam"
    return "brace" if is_joined and not RAFTER.search(piece.part.designation) else "rafter"


def _member(piece, kind, is_fixed, shift):
    """Table of a member: the box about the piece, and the planes that cut it."""
    low, high = _box(piece)
    middle = (low + high) / 2
    ends = np.array([piece.origin + shift + np.array([x, *middle[1:]]) @ piece.axes for x in (low[0], high[0])])
    corners = piece.origin + np.array(list(product(*zip(low, high)))) @ piece.axes
    centre, where = piece.solid.centroid, piece.part.where
    cuts = [Table({"point": _items(centre + (offset - normal @ centre) * normal + shift, where),
                   "normal": _items(normal, where)}, where)
            for normal, offset in piece.planes if (corners @ normal).max() > offset + SAME
            and sum(piece.solid.vertices @ normal > offset - SAME) > 2]
    along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
    width, _ = section_axes(along, 0.0)
    roll = np.degrees(np.arctan2(piece.axes[2] @ np.cross(along, width), piece.axes[2] @ width))
    return Table({"from": _items(ends[0], where), "to": _items(ends[1], where),
                  "section": _items(np.round(high - low, 10)[[2, 1]], where),
                  "roll": _items([(roll + 90) % 180 - 90], where)[0], "kind": kind,
                  **{key: value for key, value in (("fixed", is_fixed), ("cuts", Items(cuts, where))) if value}},
                 where)


def _box(piece):
    """(low, high) (3,) of a piece in its part's frame; further out where it has no face there, lest an edge of its cuts
    touches the box."""
    local = (piece.solid.vertices - piece.origin) @ piece.axes.T
    found = []
    for sign, bounds in ((-1, local.min(0)), (1, local.max(0))):
        there = [np.abs(piece.solid.face_normals - sign * axis).max(1).min() < SAME for axis in piece.axes]
        found.append(bounds + sign * np.where(there, 0.0, MARGIN))
    return found


def _items(numbers, where):
    return Items((np.round(numbers, SNAP_DIGITS) + 0.0).tolist(), where)


def _pad(piece, shift):
    (low, high), where = piece.solid.bounds + shift, piece.part.where
    middle = (low[:2] + high[:2]) / 2
    return Table({"from": _items([*middle, 0.0], where), "to": _items([*middle, low[2]], where), "kind": "foundation",
                  "section": _items(high[:2] - low[:2] + 2 * PAD, where), "fixed": True}, where)


def _lines(project, rough, pieces, ignored, used):
    """What was read and what was left out, a line each. ignored: Counter of processings without volume; used: of those
    that mark joints"""
    lines = [f"project '{project.name}': {len(rough)} parts"]
    lines += [f"{count} {kind} without volume" + f", {used[kind]} of them mark joints" * (kind in PAIRED)
              for kind, count in sorted(ignored.items())]
    lines += [f"left out: {what}, {count}" for what, count in sorted(project.notes.items()) if count]
    whole = {piece.name: piece.solid.volume for piece in rough}
    lost = {name: 1 - sum(piece.solid.volume for piece in pieces if piece.source == name) / volume
            for name, volume in whole.items()}
    name = max(lost, key=lost.get)
    if lost[name] > 1e-6:
        cut = sum(lost[key] * volume for key, volume in whole.items()) / sum(whole.values())
        lines.append(f"parts that overlap were cut apart: {100 * cut:.2g} % of the volume, at most"
                     f" {100 * lost[name]:.2g} % of a part, {name}")
    divided = [piece.name for piece in pieces if piece.name not in whole]
    return lines + [f"divided where others pass: {', '.join(divided)}"] * bool(divided)


def _supports(members):
    names = [name for name, member in members.items() if member.get("fixed")]
    is_level = any(member["kind"] in ("sill", "foundation") for member in members.values())
    which = ("whose lowest face is level with the frame's lowest, columns by pads" if is_level
             else "at the frame's lowest point, as no face is level there")
    return (f"supported, and fixed: {len(names)} member{'s' * (len(names) > 1)} {which}: {', '.join(names[:8])}"
            f"{', ...' * (len(names) > 8)}")

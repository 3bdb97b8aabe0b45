# SPDX-License-Identifier: GPL-2.0-or-later
"""BTLx files (design2machine, versions 1 and 2) -> parts with their places and processings. Lengths in m.

BTLx states millimetres and degrees. A part fills a box in its own frame: x along its length, y along its height, z
along its width; its place gives origin, x and y in the frame of the project, z = x cross y. Raw parts, which hold parts
nested for production, are not read."""
from collections import Counter
from dataclasses import dataclass, field
from io import BytesIO

import numpy as np
from lxml import etree

from ...base.input_file import shown
from ..errors import HouseError
from ..limits import MAX_ELEMENTS

MAX_FILE_SIZE = 50_000_000  # of a BTLx file. [bytes]
MM = 1e-3
SIZES, FOIL = (1e-3, 100.0), 5e-3
"""Range of a part's length, height and width; thickness from which on a part is read. [m]"""
FARTHEST = 1e7  # largest coordinate of a place, in a national grid. [m]
MAX_CORNERS = 50  # of a contour that is read; one with more is a curve


@dataclass(frozen=True)
class Processing:
    """One processing of a part. side: 1 to 6, or the number of a plane of the user's; values: {element or attribute:
    text}; contour: [((2,) corner [m], inclination [deg] of the line that leads to it)], first the start; open, with
    arcs or of no simple form: empty"""

    kind: str
    side: int
    values: dict
    contour: list
    where: str

    def length(self, name, default=0.0):
        """[m]; default [mm]"""
        return MM * _number(self.values.get(name, default), f"{self.where}: {self.kind}.{name}", 1e5)

    def angle(self, name, default=90.0):
        """[rad]; default [deg]"""
        return np.radians(_number(self.values.get(name, default), f"{self.where}: {self.kind}.{name}", 360.0))

    def is_set(self, name):
        """Whether a flag, 'no' by default, is 'yes'."""
        return self.values.get(name) == "yes"


@dataclass(frozen=True)
class Part:
    """A part; size: length, height, width [m]; places: [(origin (3,) [m], x (3,), y (3,)) as stated]."""

    number: str
    designation: str
    group: str
    size: tuple
    places: list
    processings: list
    where: str


@dataclass
class Project:
    """Parts of the first project of a file that has parts with places; notes: Counter of what was not read."""

    name: str
    parts: list = field(default_factory=list)
    notes: Counter = field(default_factory=Counter)


def read_project(content, file):
    """Project of the bytes of a BTLx file. file: its name, for messages. Raises HouseError."""
    project = None
    try:
        for event, element in _events(content, file):
            if event == "start" and (project is None or not project.parts):  # the first one with parts is read
                project = Project(" ".join(element.get("Name", "").split()) or "frame")
                continue
            if event == "start":
                project.notes["project after the first one"] += 1
                continue
            if etree.QName(element).localname == "Part" and project:
                _add_part(project, element, file)
            element.clear()
    except etree.XMLSyntaxError as problem:
        line, reason = max(problem.lineno or 1, 1), problem.msg.partition(", line ")[0]
        raise HouseError(f"{file}:{line}: not valid XML: {reason}; export the file again") from None
    if project is None or not project.parts:
        raise HouseError(f"{file}:1: no BTLx project with a part that has a place (Transformation, Position); export"
                         " the model with the places of its parts")
    return project


def _events(content, file):
    """('start', project) and ('end', part or raw part) of the file; no entity, no document type, no network."""
    events = etree.iterparse(BytesIO(content), events=("start", "end"), tag=("{*}BTLx", "{*}Project", "{*}Part",
                             "{*}Rawpart"), resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False)
    for event, element in events:
        name = etree.QName(element).localname
        if element.getroottree().docinfo.internalDTD is not None:
            raise HouseError(f"{file}:1: a document type (DOCTYPE) is not read; remove it")
        if (name == "Project") == (event == "start") and name != "BTLx":
            yield event, element


def _add_part(project, element, file):
    if project.notes["project after the first one"]:
        return
    where = f"{file}:{element.sourceline}"
    number, sizes = element.get("SingleMemberNumber") or "0", []
    for name in ("Length", "Height", "Width"):
        size = MM * _number(element.get(name), f"{where}: part {shown(number)}.{name}", 1e6)
        if not SIZES[0] <= size <= SIZES[1]:
            raise HouseError(f"{where}: part {shown(number)}: {name} {size / MM:g} mm, not between 1 mm and 100 m; BTLx"
                             " states millimetres")
        sizes.append(size)
    places = [_place(position, where) for position in element.iterfind("{*}Transformations/{*}Transformation/"
                                                                       "{*}Position")]
    if min(sizes) < FOIL:
        project.notes[f"part thinner than {1e3 * FOIL:g} mm"] += 1
        return
    missing = int(_number(element.get("Count", "1"), f"{where}: Count", 1e6)) - len(places)
    project.notes["part without a place"] += max(missing, 0)
    if places:
        project.parts.append(Part(number, " ".join(filter(None, map(element.get, ("Designation", "Annotation")))),
                                  element.get("Group", ""), tuple(sizes), places, _processings(element, file), where))
    if sum(len(part.places) for part in project.parts) > MAX_ELEMENTS:
        raise HouseError(f"{where}: more than {MAX_ELEMENTS} parts; export a part of the model")


def _place(position, where):
    vectors = []
    for name, most in (("ReferencePoint", FARTHEST / MM), ("XVector", 2.0), ("YVector", 2.0)):
        element = position.find(f"{{*}}{name}")
        if element is None:
            raise HouseError(f"{where}: a place (Position) without {name}; export the file again")
        vectors.append(np.array([_number(element.get(axis), f"{where}: {name}.{axis}", most) for axis in "XYZ"]))
    point, x, y = vectors
    lengths = np.linalg.norm([x, y], axis=1)
    if not (np.abs(lengths - 1) < 0.01).all() or abs(x @ y) > 0.01:
        raise HouseError(f"{where}: XVector and YVector of a place are not unit vectors at a right angle; export the"
                         " file again")
    return MM * point, x / lengths[0], y / lengths[1]


def _processings(part, file):
    """Processings of a part that are done, those in groups included."""
    found = []
    for element in part.iterfind("{*}Processings//*[@ReferencePlaneID]"):
        if element.get("Process", "yes") == "yes":
            where, contour = f"{file}:{element.sourceline}", element.find("{*}Contour")
            values = {etree.QName(child).localname: (child.text or "").strip()
                      for child in element.iterchildren(tag=etree.Element)}
            values |= {**element.attrib, **(contour.attrib if contour is not None else {})}
            side = int(_number(element.get("ReferencePlaneID"), f"{where}: ReferencePlaneID", 1e6))
            found.append(Processing(etree.QName(element).localname, side, values, _contour(contour, where), where))
    return found


def _contour(contour, where):
    steps = list(contour.iterchildren(tag=etree.Element))[:MAX_CORNERS + 1] if contour is not None else []
    if not 4 <= len(steps) <= MAX_CORNERS or {etree.QName(step).localname for step in steps[1:]} != {"Line"}:
        return []
    common = contour.get("Inclination", "0")
    corners = []
    for step in steps:
        point = step if step is steps[0] else step.find("{*}EndPoint")
        if point is None:
            return []
        corner = np.array([MM * _number(point.get(axis), f"{where}: contour.{axis}", 1e6) for axis in "XY"])
        corners.append((corner, _number(step.get("Inclination", common), f"{where}: Inclination", 90.0)))
    return corners if np.abs(corners[0][0] - corners[-1][0]).max() < 1e-5 else []


def _number(text, where, most):
    """A finite number up to `most`."""
    try:
        value = float("nan" if "_" in str(text) else text)
    except (TypeError, ValueError):
        value = np.nan
    if not abs(value) <= most:
        raise HouseError(f"{where}: {shown(text)} is not a number up to {most:g}; export the file again")
    return value

# SPDX-License-Identifier: GPL-2.0-or-later
"""Recorded frames as VTK time series for ParaView: elements, joints and contact forces. Needs VTK (python3-vtk9), not
YADE.

elements.pvd  polygons; cell data: element (number), kind (code, names in the field data kind_names), storey, fixed;
              point data: displacement since the start [m]
joints.pvd    for each joint a point on either element and the line between them; point data: joint (number), kind,
              load [-] (largest spring force over strength), state (0 intact, 1 partly broken, 2 broken, 3 broken before
              the start)
contacts.pvd  contact points; point data: force [N] on the second element, elements (first, second)
"""
from xml.etree import ElementTree

import numpy as np

from ..base.errors import RunError
from ..base.atomic_write import make_folder, write_text, written_from_memory
from ..recording.frames import rotated

try:
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
except ImportError:
    raise RunError("the export needs VTK's Python library; install the package python3-vtk9") from None

STATES = {"whole": 0, "partly": 1, "broken": 2, "before": 3}


def export(folder, frames, every=1):
    """Write the time series: every `every`-th frame and the last one, all contacts. Returns the .pvd files. OSError."""
    make_folder(folder)
    last = len(frames.time) - 1
    chosen = sorted({*range(0, last + 1, every), last})
    series = {"elements": (Elements(frames), [(frames.time[k], k) for k in chosen]),
              "joints": (Joints(frames), [(frames.time[k], k) for k in chosen]),
              "contacts": (Contacts(frames), [(time, k) for k, time in enumerate(frames.contacts.time)])}
    return [write_series(folder, name, make, numbers) for name, (make, numbers) in series.items()]


def write_series(folder, name, make, numbers):
    """Write NAME/NAME_0000.vtp ... and NAME.pvd with their times. numbers: [(time [s], argument of make)]."""
    make_folder(folder / name)
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
    collection = ElementTree.SubElement(root, "Collection")
    for index, (time, number) in enumerate(numbers):
        file = f"{name}/{name}_{index:04d}.vtp"
        write_polydata(folder / file, make(number))
        ElementTree.SubElement(collection, "DataSet", timestep=f"{time:.9g}", part="0", file=file)
    ElementTree.indent(root)
    write_text(folder / f"{name}.pvd", ElementTree.tostring(root, encoding="unicode", xml_declaration=True) + "\n")
    return folder / f"{name}.pvd"


def write_polydata(path, data):
    with written_from_memory(path) as memory:
        writer = vtkXMLPolyDataWriter()
        writer.SetFileName(str(memory))
        writer.SetInputData(data)
        if not writer.Write():
            raise OSError(f"{path}: VTK could not write it")


# --- contents of a file -----------------------------------------------------------------------------------------------


class Elements:
    """Polygons of all elements in a frame; called with its number."""

    def __init__(self, frames):
        e = self.elements = frames.elements
        self.frames = frames
        self.start = np.concatenate(frames.all_corners())
        first = np.cumsum([0, *map(len, e.vertices)])
        self.cells = cells([np.array(face) + first[k] for k, faces in enumerate(e.faces) for face in faces])
        owner = np.repeat(np.arange(len(e.name)), [len(faces) for faces in e.faces])
        kinds = list(dict.fromkeys(e.kind))
        code = np.array([kinds.index(kind) for kind in e.kind])
        self.of_cells = {"element": owner, "kind": code[owner], "storey": e.storey[owner],
                         "fixed": e.fixed[owner].astype("u1")}
        self.names = strings("kind_names", kinds)

    def __call__(self, frame):
        points = np.concatenate(self.frames.all_corners(frame))
        data = polydata(points, {"displacement": points - self.start})
        data.SetPolys(self.cells)
        for name, values in self.of_cells.items():
            data.GetCellData().AddArray(array(name, values))
        data.GetFieldData().AddArray(self.names)
        return data


class Joints:
    """Both ends of all joints in a frame, and lines between them; called with its number."""

    def __init__(self, frames):
        self.frames, j, e = frames, frames.joints, frames.elements
        positions = e.position[j.a] + rotated(e.orientation[j.a], j.anchor)
        inverse = e.orientation[j.b] * (1, -1, -1, -1)
        self.anchor_b = rotated(inverse, positions - e.position[j.b])
        count = len(j.name)
        self.points = cells(np.arange(2 * count).reshape(-1, 1))
        self.lines = cells(np.arange(2 * count).reshape(2, -1).T)
        kinds = list(dict.fromkeys(j.kind))
        self.kind = np.array([kinds.index(kind) for kind in j.kind], int)
        self.names = strings("kind_names", kinds)

    def __call__(self, frame):
        frames, b = self.frames, self.frames.joints.b
        ends_b = frames.position[frame][b] + rotated(frames.orientation[frame][b], self.anchor_b)
        state = np.array([STATES[name] for name in frames.joint_states(frame)], int)
        values = {"joint": np.arange(len(state)), "kind": self.kind, "load": frames.load[frame], "state": state}
        data = polydata(np.concatenate([frames.joint_places(frame), ends_b]),
                        {name: np.tile(value, 2) for name, value in values.items()})
        data.SetVerts(self.points)
        data.SetLines(self.lines)
        data.GetFieldData().AddArray(self.names)
        return data


class Contacts:
    """Contact points with their forces; called with the number of the time."""

    def __init__(self, frames):
        self.contacts = frames.contacts

    def __call__(self, number):
        c = self.contacts
        data = polydata(c.position[number], {"force": c.force[number], "elements": c.pair[number]})
        data.SetVerts(cells(np.arange(len(c.position[number])).reshape(-1, 1)))
        return data


# --- numpy to VTK -----------------------------------------------------------------------------------------------------


def polydata(points, of_points):
    """vtkPolyData with points (n, 3) and arrays of their values, no cells yet."""
    data, coordinates = vtkPolyData(), vtkPoints()
    coordinates.SetData(numpy_to_vtk(np.ascontiguousarray(points, np.float32), deep=True))
    data.SetPoints(coordinates)
    for name, values in of_points.items():
        data.GetPointData().AddArray(array(name, values))
    return data


def array(name, values):
    values = np.asarray(values)
    kind = np.float32 if values.dtype.kind == "f" else np.int32
    data = numpy_to_vtk(np.ascontiguousarray(values, kind), deep=True)
    data.SetName(name)
    return data


def cells(lists):
    """vtkCellArray of lists of point numbers."""
    data = vtkCellArray()
    starts, flat = np.cumsum([0, *map(len, lists)]), np.concatenate([np.empty(0, int), *lists])
    data.SetData(numpy_to_vtkIdTypeArray(starts.astype(np.int64), deep=True),
                 numpy_to_vtkIdTypeArray(flat.astype(np.int64), deep=True))
    return data


def strings(name, values):
    data = vtkStringArray()
    data.SetName(name)
    for value in values:
        data.InsertNextValue(value)
    return data

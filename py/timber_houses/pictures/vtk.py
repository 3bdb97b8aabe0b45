# SPDX-License-Identifier: GPL-2.0-or-later
"""Recorded frames as VTK time series for ParaView: elements, wall sheets, joints, contact forces. Needs VTK
(python3-vtk9), not YADE.

elements.pvd  polygons; cell data: element (number), kind (code, names in the field data kind_names), storey, fixed;
              point data: displacement since the start [m]
sheets.pvd    of a scene with wall sheets: their polygons; cell data: sheet (number), state (0 intact, 1 partly broken,
              2 broken)
joints.pvd    for each joint a point on either element and the line between them; point data: joint (number), kind,
              load [-] (largest spring force over strength), state (0 intact, 1 partly broken, 2 broken, 3 broken before
              the start)
contacts.pvd  contact points; point data: force [N] on the second element, elements (first, second)
"""
from xml.etree import ElementTree

import numpy as np
from yade_timber.log import starts

from ..base.atomic_write import write_bytes, write_text
from ..base.errors import RunError
from ..base.files import make_folder
from ..recording.record import rotated
from .panels import STATES, placed_plates, plates, states

try:
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
except ImportError:
    raise RunError("the export needs VTK's Python library; install the package python3-vtk9") from None


def export(folder, frames, every=1):
    """Write the time series: every `every`-th frame and the last one, all contacts. Returns the .pvd files. OSError."""
    make_folder(folder)
    last = len(frames.time) - 1
    chosen = [(frames.time[k], k) for k in sorted({*range(0, last + 1, every), last})]
    walls = {"sheets": (sheets(frames), chosen)} if len(frames.sheets.type) else {}
    series = {"elements": (elements(frames), chosen), **walls, "joints": (joints(frames), chosen),
              "contacts": (contacts(frames), [(time, k) for k, time in enumerate(frames.contacts.time)])}
    return [write_series(folder, name, make, numbers) for name, (make, numbers) in series.items()]


def write_series(folder, name, make, numbers):
    """Write NAME/NAME_0000.vtp ... and NAME.pvd with their times. numbers: [(time [s], argument of make)]."""
    make_folder(folder / name)
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
    collection = ElementTree.SubElement(root, "Collection")
    for index, (time, number) in enumerate(numbers):
        file = f"{name}/{name}_{index:04d}.vtp"
        writer = vtkXMLPolyDataWriter()
        writer.WriteToOutputStringOn()  # VTK misses a full disk
        writer.SetInputData(make(number))
        writer.Write()
        write_bytes(folder / file, writer.GetOutputString().encode())
        ElementTree.SubElement(collection, "DataSet", timestep=f"{time:.9g}", part="0", file=file)
    ElementTree.indent(root)
    write_text(folder / f"{name}.pvd", ElementTree.tostring(root, encoding="unicode", xml_declaration=True) + "\n")
    return folder / f"{name}.pvd"


# --- contents of a file: functions that return a function of its number -----------------------------------------------


def elements(frames):
    """Polygons of all elements in a frame."""
    e, start = frames.elements, np.concatenate(frames.all_corners())
    first = starts(e.vertices)
    owner = np.repeat(np.arange(len(e.name)), [len(faces) for faces in e.faces])
    names, code = coded(e.kind)
    data = vtkPolyData()
    data.SetPolys(cells([np.array(face) + first[k] for k, faces in enumerate(e.faces) for face in faces]))
    data.GetFieldData().AddArray(names)

    def of_frame(frame):
        add(data.GetCellData(), element=owner, kind=code[owner], storey=e.storey[owner], fixed=e.fixed[owner])
        points = np.concatenate(frames.all_corners(frame))
        return put_points(data, points, displacement=points - start)

    return of_frame


def sheets(frames):
    """Polygons of the plates of all wall sheets in a frame."""
    made = plates(frames)

    def of_frame(frame):
        state = states(frames, frame)
        shown = placed_plates(made, state, frames.position[frame], frames.orientation[frame])
        first = starts([plate.vertices for plate in shown])
        data = vtkPolyData()
        data.SetPolys(cells([np.array(face) + start for plate, start in zip(shown, first) for face in plate.faces]))
        owner = np.array([plate.sheet for plate in shown for _ in plate.faces], int)
        add(data.GetCellData(), sheet=owner, state=np.array([STATES[name] for name in state], int)[owner])
        return put_points(data, np.concatenate([np.empty((0, 3)), *(plate.vertices for plate in shown)]))

    return of_frame


def joints(frames):
    """Both ends of all joints in a frame, and lines between them."""
    j, e = frames.joints, frames.elements
    positions = e.position[j.a] + rotated(e.orientation[j.a], j.anchor)
    anchor_b = rotated(e.orientation[j.b] * (1, -1, -1, -1), positions - e.position[j.b])
    numbers = np.arange(len(j.name))
    names, code = coded(j.kind)
    data = vtkPolyData()
    data.SetVerts(cells(np.arange(2 * len(numbers)).reshape(-1, 1)))
    data.SetLines(cells(np.arange(2 * len(numbers)).reshape(2, -1).T))
    data.GetFieldData().AddArray(names)

    def of_frame(frame):
        ends_b = frames.position[frame][j.b] + rotated(frames.orientation[frame][j.b], anchor_b)
        state = np.array([STATES[name] for name in frames.joint_states(frame)], int)
        values = {"joint": numbers, "kind": code, "load": frames.load[frame], "state": state}
        return put_points(data, np.concatenate([frames.joint_places(frame), ends_b]),
                          **{name: np.tile(value, 2) for name, value in values.items()})

    return of_frame


def contacts(frames):
    """Contact points with their forces at a time."""
    c = frames.contacts

    def of_time(number):
        data = put_points(vtkPolyData(), c.position[number], force=c.force[number], elements=c.pair[number])
        data.SetVerts(cells(np.arange(len(c.position[number])).reshape(-1, 1)))
        return data

    return of_time


# --- numpy to VTK -----------------------------------------------------------------------------------------------------


def put_points(data, points, **values):
    """The vtkPolyData with other points (n, 3) and arrays of their values."""
    coordinates = vtkPoints()
    coordinates.SetData(numpy_to_vtk(np.ascontiguousarray(points, np.float32), deep=True))
    data.SetPoints(coordinates)
    add(data.GetPointData(), **values)
    return data


def add(attributes, **arrays):
    """Add arrays to the data of points or cells, in place of those of the same name."""
    for name, values in arrays.items():
        kind = np.float32 if values.dtype.kind == "f" else np.int32
        data = numpy_to_vtk(np.ascontiguousarray(values, kind), deep=True)
        data.SetName(name)
        attributes.AddArray(data)


def cells(lists):
    """vtkCellArray of lists of point numbers."""
    data = vtkCellArray()
    arrays = starts(lists), np.concatenate([np.empty(0, int), *lists])
    data.SetData(*(numpy_to_vtkIdTypeArray(array.astype(np.int64), deep=True) for array in arrays))
    return data


def coded(kinds):
    """(vtkStringArray of the kinds that occur, (n,) number of each one there)."""
    names, data = list(dict.fromkeys(kinds)), vtkStringArray()
    data.SetName("kind_names")
    for name in names:
        data.InsertNextValue(name)
    return data, np.array([names.index(kind) for kind in kinds], int)

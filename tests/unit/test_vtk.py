# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""The VTK export, read back with VTK: elements, joints and contact forces of an invented run are at their recorded
positions. Needs no YADE.
"""
import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import frames_sample
import numpy as np
import pytest
from file_limit import file_limit
from small_frames import FACES, frames
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from timber_houses.pictures import panels, vtk
from timber_houses.recording import frames as recorded
from timber_houses.recording.record import placed

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "show" / "export_vtk.py"


def export(folder, *options):
    return subprocess.run([sys.executable, SCRIPT, folder, *options], capture_output=True, text=True)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Folder with the export of every 20th frame."""
    place = tmp_path_factory.mktemp("run")
    recorded.save(place / recorded.NAME, frames())
    done = export(place, "--every", "20")
    assert done.returncode == 0 and "contacts.pvd" in done.stdout, done.stderr
    return place / "vtk"


def series(folder, name):
    """[(time [s], vtkPolyData)] of a .pvd file."""
    found = []
    for entry in ElementTree.parse(folder / f"{name}.pvd").iter("DataSet"):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(folder / entry.get("file")))
        reader.Update()
        found.append((float(entry.get("timestep")), reader.GetOutput()))
    return found


def points(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def values(attributes, name):
    return vtk_to_numpy(attributes.GetArray(name))


def test_times(folder):
    assert [t for t, _ in series(folder, "elements")] == [0, 1, 2, 3] == [t for t, _ in series(folder, "joints")]
    assert [t for t, _ in series(folder, "contacts")] == [0, 3]


def test_elements(folder):
    made, (_, data) = frames(), series(folder, "elements")[-1]
    assert np.allclose(points(data)[16:], made.corners(-1, 2), atol=1e-5) and data.GetNumberOfPolys() == 18
    assert np.allclose(values(data.GetPointData(), "displacement")[16:], made.corners(-1, 2) - made.corners_at_start(2),
                       atol=1e-5)
    assert np.allclose(values(data.GetPointData(), "displacement")[:16], 0)
    cell = [data.GetCell(13).GetPointId(k) - 16 for k in range(4)]
    assert cell == FACES[1] and list(values(data.GetCellData(), "element")) == [0] * 6 + [1] * 6 + [2] * 6
    names = data.GetFieldData().GetAbstractArray("kind_names")
    assert [names.GetValue(k) for k in values(data.GetCellData(), "kind")[::6]] == made.elements.kind
    assert list(values(data.GetCellData(), "storey")[::6]) == [0, 1, 2]
    assert list(values(data.GetCellData(), "fixed")[::6]) == [1, 0, 0]


def test_sheets(tmp_path):
    """Whole, partly broken, broken at the last frame: plates of their columns, torn or not."""
    run = frames_sample.walled_run()
    run.broken[:] = 0
    run.broken[-1] = [0, 0, 1, 0, 1, 1, 0, 0]
    vtk.export(tmp_path, run, every=80)
    (_, first), (_, last) = series(tmp_path, "sheets")
    assert not values(first.GetCellData(), "state").any()
    sheet, state = (values(last.GetCellData(), name) for name in ("sheet", "state"))
    assert {*zip(sheet, state)} == {(0, 0), (1, 1), (2, 2)}
    shown = [plate for plate in panels.plates(run) if plate.torn == (plate.sheet == 2)]
    expected = [placed(plate.vertices, run.position[-1][plate.body], run.orientation[-1][plate.body])
                for plate in shown]
    assert np.allclose(points(last), np.concatenate(expected), atol=1e-5)
    assert last.GetNumberOfPolys() == sum(len(plate.faces) for plate in shown)


def test_joints(folder):
    """The two ends coincide at the start; at the end the one on the upper box has moved with it."""
    made, found = frames(), series(folder, "joints")
    first, last = points(found[0][1]), points(found[-1][1])
    assert np.allclose(first[:3], first[3:], atol=1e-6) and np.allclose(last[:3], made.joint_places(-1), atol=1e-6)
    assert np.allclose(last[4], np.array([np.cos(0.3) * 0.5 - np.sin(0.3) * 0.5 + 1, 0,
                                          1.5 - np.sin(0.3) * 0.5 - np.cos(0.3) * 0.5]), atol=1e-5)
    data = found[-1][1]
    assert list(values(data.GetPointData(), "state")) == [3, 2, 1] * 2
    assert np.allclose(values(data.GetPointData(), "load")[:3], made.load[-1])
    assert data.GetNumberOfVerts() == 6 and data.GetNumberOfLines() == 3


def test_contacts(folder):
    empty, data = (data for _, data in series(folder, "contacts"))
    assert empty.GetNumberOfPoints() == 0 and np.allclose(points(data), [[0, 0, 0], [0, 0, 1]])
    assert np.allclose(values(data.GetPointData(), "force"), [[0, 0, 20], [0, 0, 10]])
    assert values(data.GetPointData(), "elements").tolist() == [[0, 1], [1, 2]]


@pytest.mark.parametrize("options, message", [(["--every", "0"], "1 or more"), ([], "no such file")])
def test_bad_input(tmp_path, options, message):
    done = export(tmp_path, *options)
    assert done.returncode != 0 and message in done.stderr


def test_a_full_disk_is_an_error_of_the_system_and_leaves_no_file(tmp_path, monkeypatch, capfd):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.write_bytes", full)
    with pytest.raises(OSError, match="No space"):
        vtk.export(tmp_path, frames())
    assert not [path for path in tmp_path.rglob("*") if path.is_file()] and capfd.readouterr() == ("", "")


def test_a_limit_of_the_file_size(tmp_path):
    with file_limit(500), pytest.raises(OSError, match="too large"):
        vtk.export(tmp_path, frames())


def test_an_export_to_what_is_no_folder(folder):
    done = export(folder.parent, "--out", os.devnull)
    assert done.returncode == 1 and done.stderr == f"error: {os.devnull}: cannot be written: is no folder\n"

# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""YADE's viewer on a virtual display (Xvfb): elements coloured by kind, joints by load, broken joints as crosses."""
import os
import shutil
import subprocess
import textwrap

import numpy as np
import pytest
from PIL import Image
from timber_houses.base import colors

SESSION = textwrap.dedent(
    """
    import os, time
    from yade import O
    from timber_houses.run import cli
    from timber_houses.run.live import show_view
    from timber_houses.run.plan import planned
    from timber_houses.scene import scenario
    from PyQt5 import QtWidgets

    def draw(times):
        for _ in range(times):
            QtWidgets.QApplication.processEvents()
            time.sleep(0.05)

    scenario.build(planned(cli.read("C2", False, True, ["modelC2_snow.py"])))
    view = show_view()
    O.run(20, True)
    draw(20)
    view.saveSnapshot({picture!r})  # saved at the next drawing
    draw(20)
    print("drawn", flush=True)
    os._exit(0)
    """
)
ORANGE = (0.84, 0.37, 0.0)
"""Crosses of broken joints. [RGB]"""


def share(picture, color):
    """Share of the pixels whose colour has nearly this hue and saturation."""
    pixels = picture / np.linalg.norm(picture, axis=2, keepdims=True)
    return (np.linalg.norm(pixels - np.array(color) / np.linalg.norm(color), axis=2) < 0.06).mean()


def test_viewer_draws_elements_and_joints(tmp_path):
    if not shutil.which("xvfb-run"):
        pytest.skip("xvfb-run is missing (package xvfb)")
    script, picture = tmp_path / "view.py", tmp_path / "view.jpg"
    script.write_text(SESSION.format(picture=str(picture)))
    tmp_path.chmod(0o700)
    done = subprocess.run(
        ["xvfb-run", "-a", "-s", "-screen 0 1024x768x24", "yade", str(script)],
        env={**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1", "XDG_RUNTIME_DIR": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=150,
    )
    assert done.returncode == 0 and "drawn" in done.stdout, done.stdout + done.stderr
    pixels = np.asarray(Image.open(picture), float)
    assert share(pixels, colors.KINDS["brace"]) > 0.01
    assert share(pixels, colors.KINDS["column"]) > 0.01
    assert share(pixels, (1, 1, 1)) > 0.03
    assert share(pixels, ORANGE) > 1e-4

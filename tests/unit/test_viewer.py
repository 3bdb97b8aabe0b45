# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""YADE's own viewer draws the elements: a session with a display (Xvfb) opens a view and survives it."""
import os
import shutil
import subprocess
import textwrap

import pytest

SESSION = textwrap.dedent(
    """
    import os, time
    import yade_timber as yt
    from yade import O, qt
    from PyQt5 import QtWidgets
    O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    O.bodies.append(yt.box((0.1, 0.1, 1), (0, 0, 0.5)))
    O.dt, O.engines = 1e-4, yt.engines()
    view = qt.View()
    O.run(100, True)
    for _ in range(20):
        QtWidgets.QApplication.processEvents()
        time.sleep(0.05)
    print("drawn", flush=True)
    os._exit(0)
    """
)


def test_viewer_draws_the_elements(tmp_path):
    if not shutil.which("xvfb-run"):
        pytest.skip("xvfb-run is missing (package xvfb)")
    script = tmp_path / "view.py"
    script.write_text(SESSION)
    done = subprocess.run(
        ["xvfb-run", "-a", "-s", "-screen 0 1024x768x24", "yade", str(script)],
        env={**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1", "XDG_RUNTIME_DIR": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=100,
    )
    assert done.returncode == 0 and "drawn" in done.stdout, done.stdout + done.stderr

# SPDX-License-Identifier: GPL-2.0-or-later
"""Engines of npm: Node.js runs npm/ENGINE.mjs, which answers each scene with its trajectory. Needs no YADE."""
import json
import math
import subprocess
from dataclasses import asdict
from pathlib import Path

import numpy as np

from mechanics.program import NotPossible, Program
from mechanics.scene import Trajectory

FOLDER = Path(__file__).parent / "npm"
STEPS = (1 / 60, 1 / 240, 1 / 1000)
"""[s]"""


class Engine:
    """A process that is started with the first scene, and again after one that it did not survive; or one a scene."""

    def __init__(self, name, one_a_scene, options):
        self.name, self.process, self.one_a_scene, self.options = name, None, one_a_scene, options

    def ask(self, scene, dt):
        if self.process is None or self.process.poll() is not None:
            self.process = subprocess.Popen(["node", f"{self.name}.mjs"], cwd=FOLDER, stdin=subprocess.PIPE,
                                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.process.stdin.write(json.dumps({"scene": asdict(scene), "dt": dt, "options": self.options}) + "\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        while line and not line.startswith("{"):  # messages of the engine
            line = self.process.stdout.readline()
        if self.one_a_scene:
            self.process.stdin.close()
            self.process.wait()
        if not line:
            raise RuntimeError("the engine ends")
        return json.loads(line)

    def run(self, scene, dt):
        answer = self.ask(scene, dt)
        if "notPossible" in answer:
            raise NotPossible(answer["notPossible"])
        if "failed" in answer:
            raise RuntimeError(answer["failed"])
        columns = [{name: rows[k] for name, rows in answer["rows"].items()} for k in range(4)]
        numbers = [math.nan if force is None else force for force in answer["support"]]
        broken = math.nan if answer["broken"] is None else answer["broken"]
        return Trajectory(scene, answer["times"], *columns, np.array(numbers), broken)


def version(package):
    """Installed version of a package."""
    return json.loads((FOLDER / "node_modules" / package / "package.json").read_text(encoding="utf-8"))["version"]


def engine_program(engine, name, package, settings, one_a_scene=False, options=None, **rest):
    """one_a_scene: whether each scene gets a process of its own, where an engine does not give its memory back."""
    run = Engine(engine, one_a_scene, options or {}).run
    return Program(name, f"{package} {version(package)}", settings, run, STEPS, **rest)

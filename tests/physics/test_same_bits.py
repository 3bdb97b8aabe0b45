# SPDX-License-Identifier: GPL-2.0-or-later
"""The same bits on every processor: no function of the C library decides a result, and neither does BLAS."""
import importlib.util
import os
import re
import shutil
import subprocess
from pathlib import Path

EXACT = set("ceil copysign fabs floor fma fmax fmin fmod frexp ldexp llround lround modf nearbyint remainder rint "
            "round scalbn sqrt trunc".split())
"""Functions of the C library with one correct result."""
VARIANTS = [
    {},
    {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable,-FMA4", "OPENBLAS_CORETYPE": "Nehalem"},
    {"OPENBLAS_CORETYPE": "Haswell", "NPY_DISABLE_CPU_FEATURES": "AVX2 FMA3"},
]
RUN = """
import hashlib, struct
import yade.wrapper as yw
from timber_houses.motion import default_motion
from timber_houses.scene import scenario
from yade_timber.scene import engines
O = yw.Omega()
scenario.build(scenario.Scenario("bits", "C2", default_motion(), 1.0, options={"skip_rest": 0}))
engines.find_engine(yw.GroundMotionEngine).start = -18.5
O.run(round(0.6 / O.dt), True)
numbers = [x for b in O.bodies for v in (b.state.pos, b.state.vel, b.state.angVel) for x in v]
print("hash", hashlib.sha256(struct.pack(f"{len(numbers)}d", *numbers)).hexdigest())
"""


def symbols(library, *options):
    """Names of a shared library without the version behind @."""
    text = subprocess.run(["nm", "-D", *options, library], check=True, capture_output=True, text=True).stdout
    return set(re.findall(r" [TWUi] (\w+)(?:@|$)", text, re.M))


def test_the_module_imports_exact_functions_only():
    libm = re.search(r"/\S*/libm[.-]\S+", Path("/proc/self/maps").read_text())[0]
    inexact = symbols(libm, "--defined-only") - EXACT
    assert {"exp", "pow", "sin"} <= inexact
    folder = Path(importlib.util.find_spec("yade_timber").origin).parent
    for module in folder.glob("_yade_timber*.so"):
        assert sorted(symbols(module, "--undefined-only") & inexact) == []


def test_a_run_has_one_hash_on_all_processors(tmp_path):
    script = tmp_path / "run.py"
    script.write_text(RUN)

    def hash_of(settings):
        done = subprocess.run([shutil.which("yade"), "-j1", "-n", "-x", str(script)], check=True,
                              capture_output=True, text=True, env={**os.environ, **settings})
        return re.search(r"hash (\w+)", done.stdout)[1]

    assert len({hash_of(settings) for settings in VARIANTS}) == 1

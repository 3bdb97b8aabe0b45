# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""The example of a contact law of your own: its patch applies to the sources, its law compiles, is consistent and acts
in impacts.

The YADE class of the patch takes minutes to compile; it is built by hand when the patch changes.
"""
import json
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

ROOT = Path(__file__).resolve().parents[2]
PATCH = ROOT / "scripts" / "examples" / "own_law" / "pad_law.patch"
CHECK = """
#include <cstdio>
#include <kernel/pad_law.hpp>
int main()
{
    const timber::PadLaw law { 1e6, 0.01 };
    for (double n = 1e-6; n < 0.1; n *= 10)
        std::printf("%.17g %.17g %.17g %.17g\\n", n, law.force(n), law.energy(n), law.overlapOf(law.energy(n)));
}
"""
DROP = """
#include <kernel/elastic_pair.cpp>
#include <drop.hpp>
#include <cstdio>
int main()
{
    for (const double ratio : { 0., 0.3, 1. }) {
        timber::impacts::Drop<timber::PadLaw> drop({ 1e6, 0.001 }, ratio, 4000, 0.5);
        double deepest = 0, drift = 0;
        while (!drop.isOver()) {
            drop.step();
            deepest = std::max(deepest, drop.overlap());
            drift = std::max(drift, std::abs(drop.energy() - 1.5));
        }
        std::printf("%.17g %.17g %.17g %.17g\\n", ratio, drop.restitution(), deepest, drift);
    }
}
"""
"""Impacts of 3 kg with 1 m/s (tests/kernel/drop.hpp) in 4000 steps."""


@pytest.fixture(scope="module")
def patched(tmp_path_factory):
    """Copy of the changed sources with the patch applied."""
    if not shutil.which("git"):
        pytest.skip("git is not installed")
    folder = tmp_path_factory.mktemp("patched")
    for name in re.findall(r"^--- a/(.*)$", PATCH.read_text(), re.M):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, folder / name)
    done = subprocess.run(["git", "apply", PATCH], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return folder


def test_all_steps_are_there(patched):
    assert "elasticPair(const PadLaw&" in (patched / "pkg/kernel/elastic_pair.cpp").read_text()
    assert "(Law2_ManifoldGeom_TimberPhys_Pad)" in (patched / "pkg/ContactPhysics.cpp").read_text()


def test_law(patched):
    """Force and energy at closed forms, F = k n (1 + n/d) and U = k n^2 (1/2 + n/(3 d)), and the inverse; a few
    roundings.
    """
    (patched / "check.cpp").write_text(CHECK)
    subprocess.run(["c++", "-std=c++17", "-Ipkg", "check.cpp", "-o", "check"], cwd=patched, check=True)
    rows = [
        list(map(float, line.split()))
        for line in subprocess.run([patched / "check"], capture_output=True, text=True).stdout.splitlines()
    ]
    assert len(rows) == 5
    for n, force, energy, inverse in rows:
        assert force == pytest.approx(1e6 * n * (1 + n / 0.01), rel=1e-14)
        assert energy == pytest.approx(1e6 * n**2 * (1 / 2 + n / 0.03), rel=1e-14)
        assert inverse == pytest.approx(n, rel=1e-13)


def impact(ratio):
    """(restitution [-], largest overlap [m]) of 3 n'' = -max(0, F + C n'), C = 2 ratio sqrt(3 dF/dn), F as in DROP."""
    def rates(_, state):
        n, v = max(state[0], 0.0), state[1]
        damping = 2 * ratio * np.sqrt(3 * 1e6 * (1 + 2 * n / 0.001))
        return [v, -max(0.0, 1e6 * n * (1 + n / 0.001) + damping * v) / 3]

    def apart(_, state):
        return state[0]

    apart.terminal, apart.direction = True, -1
    found = solve_ivp(rates, (0, 1), [1e-12, 1.0], "DOP853", rtol=1e-10, atol=1e-13, events=apart, max_step=1e-5)
    return -found.y[1, -1], found.y[0].max()


def test_impacts(patched):
    """Restitution, hardening (largest overlap) and energy of the law in the solver, against scipy's DOP853. Steps of
    1/4000 of the impact: observed 2e-7 of the restitution, 4e-6 of the overlap; energy is tracked to rounding.
    """
    build = next((Path(folder).parent for folder in sys.path if (Path(folder).parent / "libtimber_kernel.a").exists()),
                 None)
    if build is None:
        pytest.skip("no kernel beside the package")
    words = next(shlex.split(entry["command"]) for entry in json.loads((build / "compile_commands.json").read_text())
                 if entry["file"].endswith("elastic_pair.cpp"))
    folders = ["pkg", *(ROOT / name for name in ("pkg", "pkg/kernel", "tests/kernel"))]
    (patched / "drop.cpp").write_text(DROP)
    subprocess.run([words[0], *(f"-I{folder}" for folder in folders), *words[1:words.index("-o")], "-O1", "drop.cpp",
                    build / "libtimber_kernel.a", "-ltbb", "-o", "drop"], cwd=patched, check=True)
    lines = subprocess.run([patched / "drop"], capture_output=True, text=True).stdout.splitlines()
    assert len(lines) == 3
    for ratio, restitution, deepest, drift in (map(float, line.split()) for line in lines):
        exact = impact(ratio)
        assert (restitution, deepest) == pytest.approx(exact, rel=1e-5), ratio
        assert drift < 1e-13

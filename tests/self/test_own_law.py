# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""The example of a contact law of your own: its patch applies to the sources, and its law compiles and is consistent.

The YADE class of the patch takes minutes to compile; it is built by hand when the patch changes.
"""
import re
import shutil
import subprocess
from pathlib import Path

import pytest

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

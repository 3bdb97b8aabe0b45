# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""The player's bundle was built from its sources: checked by the hash in its header and, with node, by building it
again.
"""
import re
import shutil
import subprocess
from hashlib import sha256
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCES, ASSETS = ROOT / "player", ROOT / "py" / "timber_houses" / "data" / "player"


def source_hash():
    """The hash of build.mjs."""
    names = sorted([
        "build.mjs", "package-lock.json", "package.json", *(f"src/{path.name}" for path in (SOURCES / "src").iterdir())
    ])
    return sha256(b"".join(name.encode() + b"\n" + (SOURCES / name).read_bytes() for name in names)).hexdigest()


def test_bundle_is_up_to_date():
    found = re.search(r"sources sha256 ([0-9a-f]{64})", (ASSETS / "player.js").read_text(encoding="utf-8")[:500])
    assert found and found[1] == source_hash(
    ), "player.js is not built from player/src: cd player && npm ci && npm run build"


def test_bundle_contains_the_licences():
    head = (ASSETS / "player.js").read_text(encoding="utf-8")[:3000]
    licence = (ASSETS / "LICENSE.three.js.txt").read_text(encoding="utf-8").strip()
    assert "GPL-2.0-or-later" in head and licence in head


def test_nothing_names_a_registry_or_a_machine():
    assert not re.search(r'"resolved"|https?://', (SOURCES / "package-lock.json").read_text(encoding="utf-8"))
    assert not re.search(r"node_modules/|/(?:home|root|work|tmp)/", (ASSETS / "player.js").read_text(encoding="utf-8"))


def test_the_same_sources_give_the_same_bundle(tmp_path):
    if not shutil.which("node"):
        pytest.skip("node is missing")
    if not (SOURCES / "node_modules" / "esbuild").exists():
        pytest.skip("player/node_modules is missing (cd player && npm ci)")
    subprocess.run(["node", SOURCES / "build.mjs", tmp_path], check=True)
    for name in ("player.js", "LICENSE.three.js.txt"):
        assert (tmp_path / name).read_bytes() == (ASSETS / name).read_bytes()

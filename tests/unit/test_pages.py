# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""scripts/build_docs: the guides and the API pages are built without a warning, and every public name has an entry."""
import re
import subprocess
import sys
from pathlib import Path

import pytest
import timber_houses
import yade_timber

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """Folder of the built pages."""
    folder = tmp_path_factory.mktemp("pages")
    done = subprocess.run([ROOT / "scripts" / "build_docs", folder], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return folder / "html"


def entries(pages):
    """Names with an entry in the API pages."""
    return set(
        re.findall(r'<dt class="sig[^>]* id="(?:yade_timber|timber_houses)\.([\w.]+)"', "".join(
            page.read_text() for page in (pages / "api").glob("*.html"))))


def test_every_public_name_has_an_entry(pages):
    found = entries(pages)
    names = {*dir(timber_houses), *yade_timber.IN_YADE} - {"house"}  # the call of House
    assert names - found == set()
    assert {"motion.read_motion", "TimberJoint.kn", "ContactForces.largestEigenvalue"} <= found


def test_guides_are_built(pages):
    missing = [page.stem
               for page in (ROOT / "docs").glob("*.md") if not (pages / "docs" / f"{page.stem}.html").is_file()]
    assert missing == []


def test_a_warning_is_an_error(tmp_path):
    """A page with a broken reference, built with the same options."""
    (tmp_path / "conf.py").write_text("")
    (tmp_path / "index.rst").write_text("Title\n=====\n\n:doc:`nowhere`\n")
    words = re.search(r"main\(\[(.*?), source", (ROOT / "docs" / "sphinx" / "build_in_yade.py").read_text())[1]
    options = [word for word in re.findall(r'"([^"]+)"', words) if "{" not in word and word != "-d"]
    done = subprocess.run([sys.executable, "-m", "sphinx", *options, tmp_path, tmp_path / "out"], capture_output=True,
                          text=True)
    assert done.returncode != 0 and "nowhere" in done.stderr

# SPDX-License-Identifier: GPL-2.0-or-later
"""Levels of walls of a rated multiplier: option, results, report with both verdicts."""
import json
import subprocess
from pathlib import Path

import pytest
from summaries import sample_summary
from timber_houses.base.errors import RunError
from timber_houses.house.layout import WALL_LEVELS
from timber_houses.recording.summary_parts import OtherWalls, Walls
from timber_houses.run import cli
from timber_houses.run.plan import planned
from timber_houses.text import japanese
from timber_houses.text.english import other_walls

ROOT = Path(__file__).resolve().parents[2]


def strongest(scenario):
    return max(joint.strength for joint in scenario.build_model().joints if joint.kind == "wall_beam")


def test_option():
    """The option has precedence over the house file; the two levels' strengths are 2.8 and 1.5 times the allowable
    shear.
    """
    found = {level: planned(cli.read_house(["house.py", "tiled_house", *(() if level is None else ("--walls", level))]))
             for level in (None, "mean", "design")}
    assert strongest(found[None]) == strongest(found["mean"]) == pytest.approx(2.8 / 1.5 * strongest(found["design"]))
    with pytest.raises(RunError, match="design"):
        cli.read_house(["house.py", "tiled_house", "--walls", "weak"])


def test_sentence_names_the_other_verdict_where_they_differ():
    texts = []
    for verdict in ("collapsed", "repairable"):
        walls = Walls("mean", OtherWalls("design", verdict, {}))
        texts.append(other_walls(sample_summary(peak_drift={"storey1": {"ns": 0.02, "ew": 0.0}}, walls=walls)))
    assert japanese.WALL_LEVELS.keys() == {*WALL_LEVELS} and "耐力壁の強さを設計値とすると倒壊" in japanese.result(
        sample_summary(walls=Walls("mean", OtherWalls("design", "collapsed", {}))))
    assert [*texts, other_walls(sample_summary())] == ["verdict with design walls: collapsed", "", ""]


@pytest.mark.rare
def test_report_runs_both_levels(tmp_path):
    """A pulse for which the levels differ is not needed: the other run's verdict is in the summary. A house without
    rated walls has one run.
    """
    for house, walls in (("tiled_house", "design"), ("l_house", None)):
        out = tmp_path / house
        words = ["yade", "-n", "-x", ROOT / "scripts" / "house.py", house, "--duration", "0.01", "--report",
                 "--no-views", "--quiet", "--out", out]
        done = subprocess.run(list(map(str, words)), capture_output=True, text=True)
        assert done.returncode == 0 and (out / "report.html").exists(), done.stdout + done.stderr
        found = json.loads((out / "summary.json").read_text())["walls"]
        assert found == (walls and {"level": "mean", "other": {"level": walls, **found["other"]}})
        assert (out / "walls_design").exists() == bool(walls)
        if walls:
            other = json.loads((out / "walls_design" / "summary.json").read_text())
            assert (other["walls"]["level"], found["other"]["verdict"]) == ("design", other["verdict"])

# SPDX-License-Identifier: GPL-2.0-or-later
"""scripts/house.py: scenario from options and house file; refusal of bad input in one line."""
import pytest
from timber_houses.run import cli
from timber_houses.run.options import QUIET_DURATION
from timber_houses.run.plan import planned
from timber_houses.api.script import main_house

SNOWY = "extends: storehouse\nname: mine\nsnow: {depth: 0.7}\n"


@pytest.fixture
def own(tmp_path):
    """A house file that sets a depth of snow."""
    path = tmp_path / "my.house.yaml"
    path.write_text(SNOWY)
    return path


def read(*words):
    options = cli.read_house(["scripts/house.py", *map(str, words)])
    return planned(options), options


def test_a_file_by_itself(own):
    """Snow of the file, no earthquake; results under the file's name."""
    scenario, options = read(own)
    assert (scenario.name, scenario.house, scenario.motion, scenario.build_model().snow_depth,
            scenario.duration) == ("my.house", str(own), None, 0.7, QUIET_DURATION)
    assert str(options.folder) == "results/my.house"


def test_snow_and_quake(own):
    scenario, _ = read("--quake", "--snow", 0, own, "--scale", 0.5)
    assert scenario.snow_depth == 0 and scenario.scale == 0.5 and scenario.duration == scenario.motion.duration == 40


def test_a_record_implies_an_earthquake(own, tmp_path):
    record = tmp_path / "r.csv"
    record.write_text("# units: gal\n# dt: 0.01\nns,ew,ud\n" + "1,2,3\n" * 50)
    scenario, _ = read(own, "--record", record)
    assert scenario.motion.pga_gal["ew"] == pytest.approx(2)


def test_a_shipped_house_by_name():
    scenario, options = read("l_house", "--snow", "1.5")
    assert (scenario.name, scenario.snow_depth, str(options.folder)) == ("l_house", 1.5, "results/l_house")


@pytest.mark.parametrize("words, said", [
    ([], "required: HOUSE"),
    (["nowhere.yaml"], "house 'nowhere.yaml'"),
    (["."], "house '.'"),
    (["C2", "D"], "unrecognized arguments: D"),
    (["C2", "--snow"], "--snow: expected one argument"),
    (["C2", "--snow", "deep"], "--snow 'deep': must be a number"),
    (["C2", "--snow", "-1"], "--snow -1: must be between 0 and 6"),
    (["C2", "--snow", "nan"], "--snow nan: must be between 0 and 6"),
    (["C2", "--snow", "0.0005"], "snow depth: must be 0 or in [0.001, 6] m, got 0.0005"),
    (["c2"], "did you mean 'C2'?"),
    (["C2", "--scale", "2"], "add --quake or --record FILE"),
])
def test_bad_command_lines(words, said, capsys, tmp_path):
    with pytest.raises(SystemExit) as stop:
        main_house(["scripts/house.py", *words, "--out", str(tmp_path)])
    error = capsys.readouterr().err
    assert stop.value.code == 1 and error.startswith("error: ") and error.count("\n") == 1
    assert said in error


def test_a_mistake_in_the_file(own, capsys, tmp_path):
    own.write_text(SNOWY + "structurs: {}\n")
    with pytest.raises(SystemExit) as stop:
        main_house(["scripts/house.py", str(own), "--out", str(tmp_path / "out")])
    assert stop.value.code == 1
    assert capsys.readouterr(
    ).err == "error: my.house.yaml:4: house: unknown key 'structurs', did you mean 'structures'?\n"
    assert not (tmp_path / "out").exists()

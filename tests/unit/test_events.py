# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Events, damage, verdicts and sentences of invented runs. Needs no YADE."""
import json
from dataclasses import replace

import frames_sample
import numpy as np
import pytest
from summaries import sample_summary
from timber_houses.base.json_types import decode, encode
from timber_houses.recording.damage import DamageSurvey, Level, State
from timber_houses.recording.events import ColumnsLost, Event, EventLog, OwnWeight, SnowFallen, StructureFallen
from timber_houses.recording.judge import Judged
from timber_houses.recording.summary import Summary
from timber_houses.recording.summary_parts import Columns, JointCounts
from timber_houses.recording.verdict import Structure, passed
from timber_houses.text.english import event, joint_place, own_weight, sentence

ROOF = list(frames_sample.PARTS).index("roof")


def survey(run):
    """The sample's house: one storey of 2.7 m; its roof is the level of a structure beside the main one."""
    levels = [Level("main", [1], [1.0], 2.7), Level("carport", [ROOF], [1.0], 2.7)]
    return DamageSurvey(run.elements, run.joints, levels)


def states(run):
    return [(time, State(position, orientation, broken))
            for time, position, orientation, broken in zip(run.time, run.position, run.orientation, run.broken)]


def events(run, log=None):
    log = log or EventLog(survey(run))
    for time, state in states(run):
        log.observe(float(time), state)
    return log.sorted()


def test_a_fall():
    """With all joints intact: the columns pass 45 degrees at 2.79 s."""
    run = frames_sample.run()
    run.broken[:] = 0
    assert events(run) == [Event(2.8, ColumnsLost(4, 4))]


def test_columns_are_counted_in_doublings():
    """Of columns lost one after the other, the first, second and fourth are events."""
    run = frames_sample.run(until=1.0)
    log, calm = EventLog(survey(run)), states(run)[0][1]
    for k in range(5):
        broken = calm.broken.copy()
        broken[[joint for joint in range(8) if joint % 4 < k]] = 4
        log.observe(float(k), State(calm.position, calm.orientation, broken))
    assert log.sorted() == [Event(k, ColumnsLost(k, 4)) for k in (1, 2, 4)]


def test_columns_loose_from_the_start_are_no_damage():
    run = frames_sample.run(until=1.0)
    run.joints.damaged[[0, 4]] = True
    run.broken[:, [0, 4]] = 4
    assert events(run) == [] and survey(run).count_columns(states(run)[0][1]) == Columns(4, 0, 0)


def test_a_column_loose_from_the_start_may_fall():
    """All columns of the sample fall; two of them were loose before: four events, not two."""
    run = frames_sample.run()
    run.broken[:] = 0
    run.joints.damaged[[0, 4]] = True
    run.broken[:, [0, 4]] = 4
    assert survey(run).count_columns(states(run)[0][1]).loose == 0
    assert max(one.facts.number for one in events(run) if one.kind == "columns_lost") == 4


def test_a_level_moves_with_its_centre_of_mass():
    """Of three members of a level, one of 10 kg has fallen by 3 m and lies 3 m to the east; one is removed."""
    level = Level("main", [0, 1, 2], [10.0, 990.0, 500.0], 2.7)
    moved = np.array([(3.0, 0.0, -3.0), (0.027, 0.0, 0.0), (np.nan, np.nan, np.nan)])
    assert level.displacement(moved) == pytest.approx([0.03 + 0.99 * 0.027, 0.0, -0.03])


def test_a_resumed_log_repeats_nothing():
    """Events known from a checkpoint are not noted again; a log that goes back forgets later ones."""
    run = frames_sample.run()
    once = events(run)
    log = EventLog(survey(run), decode(list[Event], json.loads(json.dumps(encode(once)))))
    assert events(run, log) == once
    log.drop_after(2.42)
    assert log.sorted() == once[:1] and once[0].time_s < 2.42 < once[1].time_s


def snowy_house(drop, slide, tilt=0.0):
    """(survey, state) of a roof that leans by `tilt` [rad] about the east axis, with snow 0.6 m above its centre that
    has moved north and down in the roof's frame. [m]
    """
    run = frames_sample.run(until=0.0)
    e = run.elements
    for values, value in ((e.name, "snow"), (e.kind, "snow"), (e.group, "main"), (e.material, "snow")):
        values.append(value)
    e.vertices.append(frames_sample.box((3.0, 1.0, 0.4)))
    e.position, e.orientation = np.vstack([e.position, e.position[ROOF] + (0, 0, 0.6)]), np.vstack(
        [e.orientation, [1, 0, 0, 0]])
    position, orientation = e.position.copy(), e.orientation.copy()
    orientation[ROOF] = [np.cos(tilt / 2), np.sin(tilt / 2), 0, 0]
    north, up = np.array([0, np.cos(tilt), np.sin(tilt)]), np.array([0, -np.sin(tilt), np.cos(tilt)])
    position[-1] = position[ROOF] + slide * north + (0.6 - drop) * up
    return survey(run), State(position, orientation, run.broken[0])


@pytest.mark.parametrize("drop, slide, tilt, fallen", [(0, 0, 0, []), (0.9, 4.0, 0, []), (1.1, 3.0, 0, []),
                                                       (1.1, 4.0, 0, [ROOF]), (3.4, 3.0, 0, []), (3.5, 3.0, 0, [ROOF]),
                                                       (0, 0, 1.5, []), (0, 5.0, -1.5, [ROOF])])
def test_fallen_snow(drop, slide, tilt, fallen):
    """Snow that a leaning roof carries along, or that hovers above the eaves (3.1 m north of the middle), has not
    fallen; it touches the ground from a drop of 3.1 + 0.6 - 0.2 - 0.05 = 3.45 m on."""
    found, state = snowy_house(drop, slide, tilt)
    assert found.fallen_snow(state) == fallen


@pytest.mark.parametrize("structure, name, expected", [
    ("main", "main.roof.west", "west roof"),
    ("main", "main.roof", "roof"),
    ("entrance", "entrance.roof.north", "entrance's north roof"),
    ("main", "main.roof2.east", "east roof2"),
])
def test_event_of_fallen_snow(structure, name, expected):
    found, state = snowy_house(1.1, 4.0)
    found.elements.group[ROOF] = found.elements.group[-1] = structure
    found.elements.name[ROOF] = name
    log = EventLog(found)
    log.observe(1.0, state)
    assert f"snow has fallen from the {expected}" in map(event, log.sorted())


@pytest.mark.parametrize("place, expected", [
    (("column_beam", "1", "west"), "column-beam joint, storey 1, west side"),
    (("roof_beam", "entrance", "inside"), "roof-beam joint, entrance, inside"),
    (("column_beam", "2", "north+east"), "column-beam joint, storey 2, north and east sides"),
])
def test_joint_place(place, expected):
    assert joint_place(*place) == expected


def test_removed_elements_are_no_damage():
    run = frames_sample.run(until=0.0)
    position = run.position[0].copy()
    position[[2, ROOF]] = np.nan
    state = State(position, np.where(np.isnan(position[:, :1]), np.nan, run.orientation[0]), run.broken[0])
    found = survey(run)
    assert found.count_columns(state) == Columns(3, 0, 0)


# --- sentences --------------------------------------------------------------------------------------------------------

STANDING = {
    "model": "B",
    "earthquake": True,
    "joints": {"total": 206},
    "columns": {"total": 90},
    "peak_drift": {"storey1": {"ns": 0.001, "ew": 0.002}, "storey2": {"ns": 0.001, "ew": 0.0}},
    "residual_drift": {"storey1": {"ns": 0.0, "ew": 1e-5}},
}
SOUND = {"peak_drift": 0.002}


def drifts(peak, residual):
    return {
        "peak_drift": {"storey1": {"ns": 0.0, "ew": peak}}, "residual_drift": {"storey1": {"ns": 0.0, "ew": residual}}
    }


@pytest.mark.parametrize("changes, expected, absent", [
    ({}, [
        "House B is undamaged: ", "peak storey drift 1/500 E-W in storey 1, below the damage limit of 1/120",
        "0 of 206"
    ], ["residual", "leans"]),
    ({**drifts(0.12, 0.0004), "tilt_time_s": 19.4, "tilt_direction": "ew"},
     ["is unsafe: ", "1/8 E-W", "beyond the tilt of 1/10", "residual drift below 1/1000;"], ["leans", "undamaged"]),
    (drifts(1 / 13, 0.01), ["is unsafe: ", "1/13", "beyond the safety limit of 1/30", "residual drift 1/100"
                            ], ["leans"]),
    (drifts(1 / 80, 0.0), ["is repairable: ", "beyond the damage limit of 1/120"], ["unsafe"]),
    (drifts(0.3, 0.25), ["is a total loss and leans at the end", "1/3 E-W",
                        "residual drift 1/4 E-W beyond the limit of a total loss of 1/20"], []),
    ({"broken": {"partly_broken": 2}}, ["is repairable: ", "below the damage limit", "2 partly"], []),
    ({"columns": {"total": 90, "fallen": 1}, "events": [Event(20.5, ColumnsLost(1, 90))]
      }, ["is unsafe: ", "1 fallen of 90 columns, the first at 20.5 s"], []),
    ({
        "collapsed": True, "collapse_time_s": 25.0, "tilt_time_s": 22.7, "tilt_direction": "ns",
        "broken": {"total": 5, "partly_broken": 79}, "columns": {"total": 90, "fallen": 42, "loose": 3}
    }, [
        "House B collapsed at 25.0 s", "1/10 N-S at 22.7 s", "5 of 206 joints broken, 79 partly",
        "42 fallen and 3 loose of 90 columns"
    ], ["unsafe"]),
    ({"still_moving": True, "final_amplitude": {"storey1": {"ns": 0.004, "ew": 0.01}}
      }, ["still moving by ±1/100 E-W"], []),
    ({
        "structures": {
            "main": SOUND, "carport": {**SOUND, "collapsed": True}, "shed": SOUND,
            "entrance": {**SOUND, "peak_drift": 0.3, "residual_drift": 0.2}
        }, "events": [Event(21.35, StructureFallen("carport"))]
    }, ["is undamaged", "carport collapsed at 21.4 s, entrance total loss and leans (peak drift 1/3)"], ["shed"]),
    ({
        "structures": {
            "main": SOUND, "porch": {**SOUND, "collapsed": True}, "porch2": {**SOUND, "collapsed": True}
        }, "events": [Event(3.0, StructureFallen("porch2")),
                      Event(9.0, StructureFallen("porch"))]
    }, ["porch collapsed at 9.0 s, porch2 collapsed at 3.0 s"], []),
    ({"snow": True, "snow_mass_kg": 5600.0, "events": [Event(20.2, SnowFallen("", "west", "roof"))]
      }, ["snow 5.6 t, falling from 20.2 s"], []),
    ({"record": {"onset_s": 18.8, "strong_end_s": 27.0}, "duration_s": 2.0},
     ["before strong shaking sets in (18.8 s)"], ["during"]),
    ({"record": {"onset_s": 18.8, "strong_end_s": 27.0}, "duration_s": 20.0},
     ["the run ends during the strong shaking (18.8 to 27.0 s)"], ["before strong"]),
    ({**drifts(0.3, 0.25), "record": {"onset_s": 18.8, "strong_end_s": 27.0}, "duration_s": 20.0},
     ["is unsafe: ", "drift at the end 1/4 E-W;"], ["total loss", "leans", "residual"]),
    ({**drifts(0.3, 0.06), "still_moving": True, "final_amplitude": {"storey1": {"ns": 0.07, "ew": 0.0}}},
     ["is unsafe: ", "drift at the end 1/17 E-W, still moving by ±1/14 N-S"], ["total loss", "residual"]),
    ({**drifts(0.3, 0.06), "still_moving": True, "final_amplitude": {"storey1": {"ns": 0.02, "ew": 0.0}}},
     ["is a total loss: ", "residual drift 1/17 E-W beyond the limit of a total loss of 1/20, still"],
     ["at the end"]),
    ({"record": {"onset_s": 18.8, "strong_end_s": 27.0}, "duration_s": 27.0}, [], ["strong shaking"]),
    ({"record": {"onset_s": 18.8, "strong_end_s": 27.0}, "duration_s": 20.0, "collapsed": True,
      "collapse_time_s": 19.5}, ["collapsed"], ["strong shaking"]),
    (drifts(0.00831, 0.0), ["1/121", "below the damage limit of 1/120"], []),
    (drifts(0.0329, 0.0), ["1/31", "beyond the damage limit of 1/120"], []),
    (drifts(0.0953, 0.0), ["1/11", "beyond the safety limit of 1/30"], []),
    (drifts(1 / 120, 0.0), ["1/120 ", "beyond the damage limit"], []),
])
def test_sentence(changes, expected, absent):
    """Peak and residual drift are told apart, partly broken joints are counted."""
    text = sentence(sample_summary(**{**STANDING, **changes}))
    assert all(part in text
               for part in expected) and not any(part in text for part in absent) and "\n" not in text, text


def test_wall_sheets_are_counted_apart():
    """Three sheets: one has lost both springs, one half of them, one none; and a joint with four springs is broken."""
    run = frames_sample.walled_run()
    broken = np.array([1, 1, 1, 0, 0, 0, 4, 0])
    state = State(run.position[0], run.orientation[0], broken)
    joints, counts = survey(run).count_all(), survey(run).count_broken(state, springs=7)
    assert (joints.total, joints.wall_sheets) == (2, 3)
    assert (counts.total, counts.wall_sheets, counts.wall_sheets_partly, counts.partly_broken) == (1, 1, 1, 0)
    assert "; 1 of 2 joints and 1 of 3 wall sheets broken, 1 partly" in sentence(
        sample_summary(joints=joints, broken=counts))
    assert run.joints.count_apart(broken >= run.joints.springs) == ((1, 2), (1, 3))


def test_a_house_without_walls_has_no_wall_sheets():
    run = frames_sample.run(until=1.0)
    state = State(run.position[0], run.orientation[0], np.array([0, 4, 4, 0, 0, 0, 0, 0]))
    found = {"joints": survey(run).count_all(), "broken": survey(run).count_broken(state, springs=8)}
    assert found["joints"] == JointCounts(total=8, column_beam=8, brace_beam=0) and "wall" not in str(encode(found))
    assert "; 2 of 8 joints broken (1 more from the start)" in sentence(sample_summary(**found))


@pytest.mark.parametrize("changes, state", [
    ({}, "undamaged"),
    ({"peak_drift": 1 / 121}, "undamaged"),
    ({"peak_drift": 1 / 120}, "repairable"),
    ({"partly_broken": 1}, "repairable"),
    ({"broken": 1}, "repairable"),
    ({"peak_drift": 1 / 31}, "repairable"),
    ({"peak_drift": 1 / 30}, "unsafe"),
    ({"columns_lost": 1}, "unsafe"),
    ({"peak_drift": 1 / 19, "residual_drift": 1 / 21}, "unsafe"),
    ({"peak_drift": 1 / 19, "residual_drift": 1 / 20}, "total loss"),
    ({"residual_drift": 1 / 9, "columns_lost": 1}, "total loss"),
    ({"peak_drift": 1.0, "collapsed": True}, "collapsed"),
])
def test_verdict(changes, state):
    """Each limit and each kind of damage decides alone; a limit counts as reached at its value."""
    assert Structure(**{**SOUND, **changes}).verdict == state


def test_only_a_standing_house_leans():
    """A peak beyond the tilt is no lean; nor is the rest of a collapsed house."""
    assert [
        Structure(**{**SOUND, **changes}).leans
        for changes in ({"peak_drift": 0.3}, {"residual_drift": 0.11}, {"residual_drift": 0.11, "collapsed": True})
    ] == [False, True, False]
    assert [limit and limit.name
            for limit in map(passed, (0.001, 0.01, 0.05, 0.2))] == [None, "damage limit", "safety limit", "tilt"]


def test_damage_by_structure():
    """A joint of the carport counts for the carport alone; columns without joints from the start are not lost."""
    run = frames_sample.run(until=1.0)
    run.joints.storey = ["1"] * 7 + ["carport"]
    broken = np.zeros(8, int)
    broken[[3, 7]], broken[5] = 4, 1
    time, state = states(run)[0]
    found = survey(run).by_structure(State(state.position, state.orientation, broken),
                                     {"main": replace(Judged.of(1), peak=[0.0, 0.1]), "carport": Judged.of(1)})
    assert found == {"main": Structure(peak_drift=0.1, broken=1, partly_broken=1, columns_lost=1),
                     "carport": Structure(peak_drift=0.0, broken=1)}


def test_a_summary_is_the_same_after_a_file(tmp_path):
    """All kinds of values: events, structures, counts of other kinds, sheets, which a house without walls does not
    have.
    """
    event = Event(0.9, OwnWeight(True, {"main": Structure(peak_drift=0.01, broken=3)}))
    found = frames_sample.summary("A").changed(events=[event], joints={"roof_beam": 5, "wall_sheets": 2}, record=None)
    found.write(tmp_path)
    assert Summary.read(tmp_path) == found
    assert found.joints.others == {"roof_beam": 5}
    assert found.broken.wall_sheets is None
    assert "wall_sheets" not in json.loads((tmp_path / "summary.json").read_text())["broken"]


# --- own weight -------------------------------------------------------------------------------------------------------


def test_first_acceleration():
    """The sample's ground has 4 pi^2 0.2 sin(2 pi t) m/s2 after 1 s: 0.5 m/s2 at the second sample after it. Weak
    shaking does not count.
    """
    motion = frames_sample.motion()
    assert motion.first(0.5) == pytest.approx(1.02, abs=1e-6)
    motion.acceleration[:] *= 0.05
    assert motion.first(0.5) is None


@pytest.mark.parametrize("main, text", [
    ({"peak_drift": 1 / 45, "broken": 12}, "12 joints broken, peak drift 1/45"), ({"collapsed": True}, "collapsed"),
    ({"partly_broken": 1, "columns_lost": 2}, "1 joint partly broken, 2 columns lost, peak drift below 1/1000"),
])
def test_damage_before_the_shaking(main, text):
    structures = {"main": Structure(**{"peak_drift": 1e-4, **main}), "shed": Structure(peak_drift=1e-4)}
    assert own_weight(OwnWeight(False, structures)) == f"damaged before the shaking, by its own weight: {text}"


def test_damage_by_the_own_weight_in_the_verdict():
    """Of a run with an earthquake the event; of a run without one the cause, unless the house is undamaged."""
    fallen = frames_sample.summary("A")
    early = Event(0.9, OwnWeight(False, {"main": Structure(peak_drift=0.01, broken=3)}))
    assert "before the shaking" not in sentence(fallen)
    assert f"; {event(early)}; " in sentence(fallen.changed(events=[*fallen.events, early]))
    assert "; damaged by its own weight and snow; " in sentence(
        fallen.changed(earthquake=False, snow=True, snow_mass_kg=1000))
    assert "own weight" not in sentence(sample_summary(peak_drift={"storey1": {"ns": 1e-4, "ew": 0.0}}))

# SPDX-License-Identifier: GPL-2.0-or-later
"""The scene in YADE -> descriptions and states of the recording's types.

Element k of the HouseModel is body k of the scene, joint k is joint k of the JointEngine."""
import json
import math
import pickle

import numpy as np
import yade.wrapper as yw
from yade_timber import host
from yade_timber.plugin import compiled
from yade_timber.scene import record
from yade_timber.scene.engines import find_engine

from ..recording import frames
from ..recording.damage import SIDES, DamageSurvey, Level, State
from ..recording.events import Collapse, EventLog, FirstBreak, OwnWeight, StructureFallen, Tilt
from ..recording.history import DIRECTIONS, Samples
from ..recording.judge import Judge
from ..recording.quantities import AXES
from ..recording.summary_parts import Mode, ModesAt
from ..recording.verdict import UNDAMAGED
from ..scene.modes import natural_modes
from ..scene.scenario import level_marks, sampled_columns

SETTLED = 1.0  # time at which the house has settled under its weight, and its first natural modes are taken. [s]
HARMFUL = 0.5  # ground acceleration that damages no sound house: half of the design earthquake. [m/s2]
SPENT = 0.2  # ground acceleration that moves no wreck: friction holds 2 m/s2 and more. [m/s2]
REST_SPEED = 0.02  # largest speed of a body at rest in a wreck: its sway in such a ground motion stays below. [m/s]
ROLLING = 0.01  # share of the free mass that may still move in a wreck at rest: single members that roll away. [-]
REST_TIME = 3.0  # a run ends when its wreck has been at rest for so long, and the motion is spent. [s]
ROUNDING = 1e-6
"""Displacement of the levels over the largest one of a mode in which they do not move [-]: rounding gives 1e-15,
modes of a house 0.6 and more."""
BREAKS = ("time", "joint", "spring", "cause", "force")  # attributes of a JointBreak, columns of frames.h5's /breaks
O = yw.Omega()


# --- descriptions, fixed during a run ---------------------------------------------------------------------------------


def describe_elements(model):
    """frames.Elements of the scene, in their placement before the first step."""
    bodies, elements = list(O.bodies), model.elements
    start = {"position": np.array([b.state.refPos for b in bodies]),
             "orientation": np.array([[q[3], q[0], q[1], q[2]] for q in (b.state.refOri for b in bodies)])}
    return frames.Elements(**record.describe_bodies(bodies) | start, group=[e.group for e in elements],
                           storey=np.array([e.storey for e in elements]))


def describe_joints(model):
    sheets = model.sheets
    specs, joints = model.joints, list(find_engine(yw.JointEngine).joints)
    described = record.describe_joints(joints, range(len(model.elements)))
    described["damaged"] = np.array([s.broken for s in specs], bool)  # of a resumed run, too
    described["sheet"] = np.array([sheets.get(s.sheet, -1) for s in specs], "i4")
    return frames.Joints(**described, storey=[storey_of(s, model) for s in specs],
                         side=["+".join(sides_of(s)) for s in specs])


def describe_sheets(model):
    number, sheets = element_numbers(model), list(model.sheets)
    ends = (np.array([number[getattr(sheet, end)] for sheet in sheets], "i4") for end in ("low", "high"))
    return frames.Sheets([sheet.type for sheet in sheets], [sheet.opening for sheet in sheets], *ends)


def describe_levels(model):
    """List of damage.Level, the main structure first."""
    number, levels = element_numbers(model), []
    for structure, storeys in model.storey_levels.items():
        marks = level_marks(model, structure)
        for storey, (foot, head) in sorted(storeys.items()):
            members = [e for e, level in marks if level == storey]
            levels.append(Level(structure, [number[e.name] for e in members], [e.mass for e in members], head - foot))
    return levels


def describe_motion():
    """frames.Motion of the scene's ground motion without its displacement, or None."""
    engine = find_engine(yw.GroundMotionEngine)
    if engine is None:
        return None
    return frames.Motion(engine.step, engine.start, engine.scale * np.array([*map(tuple, engine.acceleration)]))


def versions():
    """{'yade': version of the running YADE, 'package': version with which the module was built}."""
    build = json.loads(compiled.build_record()[len(host.RECORD_MARK):])
    return {"yade": host.host_facts()["yade"], "package": build["package"]}


def element_numbers(model):
    return {element.name: k for k, element in enumerate(model.elements)}


def storey_of(joint, model):
    """Place of a joint: '1', '2', ... in the main structure, else the name of its structure ('entrance')."""
    return str(joint.storey) if joint.group == next(iter(model.storey_levels)) else joint.group


def sides_of(joint):
    """Walls of a joint, in the order of SIDES (two for a corner column), or ['inside']."""
    return [side for side in SIDES if side in joint.side] or ["inside"]


def cause_of(entry, model):
    """'tension', 'compression' or 'shear' of a JointBreak; of a wall 'shear': its signs are directions of its drift."""
    return "shear" if model.joints[entry.joint].sheet else entry.cause


def break_row(entry, model):
    """Values of a JointBreak in the order of breaks.csv."""
    joint = model.joints[entry.joint]
    return (entry.time, joint.name, joint.kind, storey_of(joint, model), "+".join(sides_of(joint)), entry.spring,
            cause_of(entry, model), entry.force)


# --- states -----------------------------------------------------------------------------------------------------------


def largest_so_far():
    """(J, 4) load [-], pull [N], shear [N], opening [m] of the joints: largest so far, none before a sample."""
    return np.frombuffer(find_engine(yw.Sampler).peaks()).reshape(4, -1).T


def moving_share():
    """Share of the free mass in bodies faster than REST_SPEED. [-]"""
    free = [(b.state.mass, b.state.vel.norm()) for b in O.bodies if b is not None and not b.state.blockedDOFs]
    return sum(mass for mass, speed in free if speed > REST_SPEED) / sum(mass for mass, _ in free)


def modes_now(levels):
    """ModesAt of the scene as it is now; an unstable mode has no period. levels: of the main structure."""
    mass = sum(b.state.mass for b in O.bodies if b is not None and not b.state.blockedDOFs)
    modes = []
    for mode in natural_modes():
        share = {axis: round(float(mode.mass[AXES[axis]] / mass), 4) for axis in DIRECTIONS}
        moved = np.array([level.displacement(mode.shape[:, :3]) for level in levels])
        largest = max(moved[:, :2].flat, key=abs, default=1.0)
        if abs(largest) < ROUNDING * abs(mode.shape[:, :3]).max():  # of another structure
            continue
        shape = {f"storey{k}": {axis: round(float(row[AXES[axis]] / largest), 4) for axis in DIRECTIONS}
                 for k, row in enumerate(moved, 1)}
        period = round(mode.period, 4) if mode.omega2 > 0 else None
        modes.append(Mode(period_s=period, direction=max(share, key=share.get), mass_share=share, shape=shape))
    return ModesAt(time_s=round(O.time, 6), modes=modes)


class Observer:
    """Notes events, drifts of structures and first natural modes of the run. progress: checkpoint.Progress"""

    def __init__(self, model, progress=None):
        self.model = model
        self.survey = DamageSurvey(describe_elements(model), describe_joints(model), describe_levels(model))
        self.log = EventLog(self.survey, progress.events if progress else ())
        self.sampled = [(e.group, e.storey) for e in sampled_columns(model)]
        self.judge = Judge(self.survey.levels, self.sampled, progress and progress.judged)
        self.columns = tuple(find_engine(yw.Sampler).columns())
        self.fresh = []  # [(n, W) arrays]: rows of the Sampler that are in no file yet
        self._past = [(O.time, pickle.dumps(self.judge.structures))]
        self.modes = progress and progress.modes
        self.upright = progress.upright if progress else (0.0, [])  # time [s], as of largest_so_far
        self.motion = describe_motion()
        self.shaking = self.motion and self.motion.first(HARMFUL)
        self.spent = self.motion.last(SPENT) if self.motion else 0.0
        self.at_rest = progress and progress.at_rest  # since when the wreck is [s]

    def progress(self):
        """What a checkpoint must hold of it: entries of checkpoint.Progress."""
        return {"events": self.log.sorted(), "judged": self.judge.structures, "modes": self.modes,
                "upright": [self.upright[0], np.asarray(self.upright[1]).tolist()], "at_rest": self.at_rest}

    def read_samples(self):
        """Take the samples since the last call out of the scene, and judge them."""
        rows, axes = map(np.frombuffer, find_engine(yw.Sampler).take())
        if not rows.size:
            return
        samples = Samples(self.columns, rows)
        self.judge.judge(samples, axes.reshape(samples.samples, len(self.sampled), 3))
        self.fresh.append(samples.rows)
        self._past.append((samples.time[-1], pickle.dumps(self.judge.structures)))

    def judge_until(self, time):
        """Judge all samples up to now. time [s]"""
        self._rewind(time)
        self.read_samples()

    def _rewind(self, time):
        """Judge as at a time [s] if a later state has been judged: an earlier one was loaded."""
        while len(self._past) > 1 and self._past[-1][0] > time + O.dt / 2:
            self._past.pop()
            self.judge.structures.update(pickle.loads(self._past[-1][1]))

    @property
    def main_levels(self):
        return [level for level in self.survey.levels if level.structure == self.survey.structures[0]]

    @property
    def is_over(self):
        """Whether the wreck has been at rest for REST_TIME, and the motion is spent."""
        return self.at_rest is not None and O.time - self.at_rest >= REST_TIME - O.dt / 2

    def _watch_wreck(self, time):
        """Note since when the bodies of a collapsed house are at rest after the motion. time [s]"""
        is_wreck = self.judge.main.fall_s is not None and time >= self.spent
        if not is_wreck or moving_share() > ROLLING:
            self.at_rest = None
        elif self.at_rest is None:
            self.at_rest = time

    def fall(self):
        """Start of a collapsed house's fall: a storey tilts, or a floor is down [s]; None if it stands."""
        main = self.judge.main
        if main.fall_s is None:
            return None
        return main.fall_s if main.tilt_s is None else min(main.tilt_s, main.fall_s)

    def joint_peaks(self):
        """[[load, pull, shear, opening]] of the joints: largest values so far, or before the fall if there is one."""
        return np.asarray(largest_so_far() if self.fall() is None else self.upright[1]).tolist()

    def state(self):
        """damage.State of the scene; bodies and joints that the user has added are left out."""
        elements, joints = len(self.model.elements), len(self.model.joints)
        (position, orientation), (load, broken) = record.placements(), record.joint_loads()
        return State(position[:elements], orientation[:elements], broken[:joints], load[:joints])

    def observe(self, time, last=False):
        """Note the events up to a time [s], that of the scene's state, which is returned. last: whether it is the final
        state. Raises RuntimeError."""
        self.log.drop_after(time)
        self._require_levels()
        self.judge_until(time)
        self._note_first_break()
        if self.judge.main.tilt_s is None and self.judge.main.fall_s is None:
            self.upright = time, largest_so_far()
        self._note_falls()
        self._watch_wreck(time)
        state = self.state()
        self.log.observe(time, state)
        if self.modes is None and time > SETTLED - O.dt / 2:
            self.modes = modes_now(self.main_levels)
        next_frame = math.inf if last else time + frames.steps_between(O.dt) * O.dt
        if self.shaking is not None and time <= self.shaking < next_frame:  # or before the end of the run
            structures = self.survey.by_structure(state, self.judge.structures)
            if any(facts.verdict != UNDAMAGED for facts in structures.values()):
                self.log.add(time, OwnWeight("snow" in self.survey.elements.kind, structures))
        return state

    def _require_levels(self):
        """Raise RuntimeError if a level has no body any more."""
        levels = self.survey.levels
        for level in levels:
            if all(O.bodies[mark] is None for mark in level.marks):
                storey = [each for each in levels if each.structure == level.structure].index(level) + 1
                raise RuntimeError(f"{level.structure}: all bodies at the top of storey {storey} are erased: it has no"
                                   " drift")

    def _note_first_break(self):
        if any(event.kind == "first_break" for event in self.log.events):
            return
        for first in find_engine(yw.JointEngine).breaks[:1]:
            _, _, kind, storey, side, _, cause, force = break_row(first, self.model)
            self.log.add(first.time, FirstBreak(kind, storey, side, cause, force))

    def _note_falls(self):
        main = self.judge.main
        if main.tilt_s is not None:
            self.log.add(main.tilt_s, Tilt(main.tilt_direction))
        for name, judged in self.judge.structures.items():
            if judged.fall_s is not None:
                self.log.add(judged.fall_s, Collapse() if judged is main else StructureFallen(name))

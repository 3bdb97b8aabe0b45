# SPDX-License-Identifier: GPL-2.0-or-later
"""Wrong attributes and arguments are refused in one line that names them; the old value stays."""
import math

import pytest
import yade.wrapper as yw
import yade_timber as yt
from column_sample import column_on_plate, is_one_line
from yade import O
from yade.minieigenHP import Quaternion, Vector3
from yade_timber.plugin import compiled

yt.guard()

NAN, INF = math.nan, math.inf


# --- attributes -------------------------------------------------------------------------------------------------------


def complete(name):
    """An instance of a class of the package with valid attributes."""
    if name == "RoundedPolyhedron":
        return yt.box((1, 2, 3), (0, 0, 0)).shape
    if name == "TimberJoint":
        return yw.TimberJoint(id1=0, id2=1, anchors1=[(0, 0, 0)] * 2, anchors2=[(0, 0, 0)] * 2, kn=1, ks=1, strength=1)
    if name == "GroundMotionEngine":
        return yw.GroundMotionEngine(step=0.01, acceleration=[(0, 0, 0), (1, 0, 0)])
    if name == "Sampler":
        return yw.Sampler(bodies=[1, 2], groups=[0, 1])
    pair = {"mass": 1.0, "friction": 0.5, "shearRatio": 0.4, "overlapLimit": 0.1}
    laws = {
        "ManifoldPhys": pair, "TimberPhys": {**pair, "modulus": 1e9, "radius": 0.1},
        "SnowPhys": {**pair, "stiffness": 1e5}
    }
    return getattr(yw, name)(**laws.get(name, {}))


REFUSED = [
    *[(name, attribute, value) for name in ("TimberMat", "SnowMat") for attribute in ("density", "friction")
      for value in (-1.0, NAN, INF, "heavy", None)],
    ("TimberMat", "density", 0.0),
    ("TimberMat", "young", -5.0),
    ("TimberMat", "poisson", 9.0),
    ("TimberMat", "bearing", 0.0),
    ("TimberMat", "bearing", NAN),
    ("SnowMat", "stiffnessPerMass", 0.0),
    ("UniformGravity", "gravity", Vector3(0, 0, NAN)),
    ("UniformGravity", "gravity", 9.81),
    ("GroundMotionEngine", "step", -0.01),
    ("GroundMotionEngine", "step", NAN),
    ("GroundMotionEngine", "start", INF),
    ("GroundMotionEngine", "scale", NAN),
    ("GroundMotionEngine", "acceleration", [Vector3(0, NAN, 0)]),
    ("Sampler", "interval", -0.01),
    ("Sampler", "jointInterval", NAN),
    ("Sampler", "groups", [0, -1]),
    ("Sampler", "groups", [0, 0, 0]),
    ("Sampler", "bodies", [1]),
    ("HealthCheck", "every", 0),
    ("HealthCheck", "every", 1.5),
    ("HealthCheck", "speedLimit", NAN),
    ("RestSkipper", "stride", 0),
    ("RestSkipper", "stride", 10**30),
    ("RestSkipper", "restTime", 0.0),
    ("RestSkipper", "speed", -1.0),
    ("RestSkipper", "displacement", NAN),
    ("RestSkipper", "growth", -1.0),
    ("RestSkipper", "groundThreshold", -1.0),
    ("RoundedPolyhedron", "radius", 0.6),
    ("RoundedPolyhedron", "radius", -0.1),
    ("RoundedPolyhedron", "vertices", [Vector3(0, 0, 0)]),
    ("TimberJoint", "anchors1", [Vector3(0, 0, 0)]),
    ("TimberJoint", "kn", -1.0),
    ("TimberJoint", "ks", -1.0),
    ("TimberJoint", "strength", NAN),
    ("TimberJoint", "normal", Vector3(0, 0, 0)),
    ("ContactForces", "sweeps", -3),
    ("ContactForces", "tolerance", -1.0),
    ("Bo1_RoundedPolyhedron_Aabb", "margin", -1.0),
    ("Bo1_RoundedPolyhedron_Aabb", "margin", 0.0),
    *[(ip2, "dampingRatio", value) for ip2, _, _ in compiled.contact_laws() for value in (-1.0, INF)],
]


@pytest.mark.parametrize("name, attribute, value", REFUSED)
def test_refused_value_leaves_the_old_one(name, attribute, value, tmp_path):
    target = complete(name)
    before = repr(target.dict())  # equal for NaN, too
    with pytest.raises((ValueError, TypeError, RuntimeError)) as error:
        setattr(target, attribute, value)
    is_one_line(error, *([] if name in ("RoundedPolyhedron", "TimberJoint") else [f"{name}.{attribute}"]))
    assert repr(target.dict()) == before
    with pytest.raises((ValueError, TypeError, RuntimeError)):
        target.updateAttrs({attribute: value})
    assert repr(target.dict()) == before


@pytest.mark.parametrize("name", sorted(yt._class_names))
def test_each_class(name):
    """Misspelt names are refused, also by the constructor; the attributes of YADE's base classes work as before."""
    cls, target = getattr(yw, name), complete(name)
    with pytest.raises(AttributeError) as error:
        target.notThere = 1
    is_one_line(error, name, "notThere")
    with pytest.raises(AttributeError) as error:
        cls(notThere=1)
    is_one_line(error, "notThere")
    for attribute, value in {"label": "mine", "dead": True, "ompThreads": 2, "color": Vector3(0, 1, 0), "wire": True,
                             "execCount": 3}.items():
        if hasattr(cls, attribute):
            setattr(target, attribute, value)
            assert getattr(target, attribute) == value
    for attribute, value in target.dict().items():
        if getattr(cls, attribute).fset is None:
            with pytest.raises(AttributeError):
                setattr(target, attribute, value)
        elif type(value) in (int, float, bool, str):
            setattr(target, attribute, value)  # each value of a valid object is admissible
            with pytest.raises(TypeError) as error:
                setattr(target, attribute, object())
            is_one_line(error, f"{name}.{attribute}")
            with pytest.raises(TypeError) as error:
                cls(**{attribute: object()})
            is_one_line(error, f"{name}.{attribute}")


@pytest.mark.parametrize("name, wrong, right",
                         [("RoundedPolyhedron", "radus", "radius"), ("TimberMat", "yung", "young"),
                          ("ContactForces", "maxsweeps", "sweeps"), ("TimberMat", "dampingRatio", "")])
def test_misspelt_attribute(name, wrong, right):
    with pytest.raises(AttributeError) as error:
        setattr(complete(name), wrong, 1)
    is_one_line(error, name, wrong, right)


def test_subclass_in_python():
    class Mine(yw.TimberMat):
        pass

    mine = Mine()
    mine.note = "mine"
    assert mine.note == "mine"
    with pytest.raises(ValueError):
        mine.young = -1
    assert mine.young > 0


def test_scene_saved_after_refused_values_loads(tmp_path):
    _, column = column_on_plate()
    body = O.bodies[column]
    for target, attribute, value in ((body.shape, "radius", 0.3), (body.material, "young", -5),
                                     (body.material, "poisson", 9), (body.material, "density", -1)):
        with pytest.raises((ValueError, RuntimeError)):
            setattr(target, attribute, value)
    O.save(str(tmp_path / "scene.xml"))
    O.load(str(tmp_path / "scene.xml"))
    O.run(20, True)
    assert O.bodies[column].state.vel.norm() < 1e-2


# --- arguments --------------------------------------------------------------------------------------------------------

CALLS = [
    (lambda: yt.snow(density="heavy"), "snow: density", "heavy"),
    (lambda: yt.snow(stiffness_per_kg=None), "snow: stiffness_per_kg"),
    (lambda: yt.timber(young="stiff"), "timber: young"),
    (lambda: yt.timber(friction=[1]), "timber: friction"),
    (lambda: yt.timber(label=3), "timber: label"),
    (lambda: yt.timber(density=-1), "TimberMat.density = -1"),
    (lambda: yt.engines(gravity=9.81), "engines: gravity = 9.81"),
    (lambda: yt.engines(sweeps=2.5), "engines: sweeps = 2.5"),
    (lambda: yt.engines(sweeps=-3), "engines: sweeps = -3"),
    (lambda: yt.engines(tolerance=-1), "engines: tolerance = -1"),
    (lambda: yt.engines(damping_ratio="much"), "engines: damping_ratio"),
    (lambda: yt.engines(increment="closed"), "engines: increment"),
    (lambda: yt.engines(health_check=-1), "engines: health_check"),
    (lambda: yt.engines(skip_rest=10**12), "engines: skip_rest"),
    (lambda: yt.engines(monitor=3), "engines: monitor"),
    (lambda: yt.engines(joints=[7]), "engines: joints"),
    (lambda: yt.engines(ground_motion="kobe"), "ground_motion = 'kobe'"),
    (lambda: yt.connect(0, 1, []), "connect: points"),
    (lambda: yt.connect(0, 1, [(0, 0, NAN)]), "connect: points"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], normal=(0, 0, 0)), "connect: normal"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], stiffness=(1, -1)), "connect: stiffness"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], strength=0), "connect: strength"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], per="nail"), "connect: per", "nail"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], kind=1), "connect: kind"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], damping_ratio=1.5), "connect: damping_ratio", "1.5"),
    (lambda: yt.connect("a", 1, [(0, 0, 0)]), "connect", "no body"),
    (lambda: yt.contacts(0, 99), "contacts", "99"),
    (lambda: yt.stable_dt(-1), "stable_dt: safety"),
    (lambda: yt.energy_residual(3), "energy_residual: terms"),
    (lambda: yt.box((1, 1, 1), (0, 0)), "centre = (0, 0)"),
    (lambda: yt.box((1, 1, -1), (0, 0, 0)), "extents"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), orientation=(1, 0, 0)), "orientation"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), material="oak"), "material = 'oak'"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), fixed="no"), "fixed"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), radius=-0.1), "radius"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), radius=1e-6), "radius"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), name=5), "name"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), color="red"), "color"),
    (lambda: yt.polyhedron([("a", 0, 0)]), "vertices"),
    (lambda: yt.set_velocity(O.bodies[1], 3), "velocity"),
    (lambda: yt.set_velocity("x", (0, 0, 1)), "body"),
]


@pytest.mark.parametrize("call, words", [(call, words) for call, *words in CALLS])
def test_wrong_argument_is_named(call, words):
    column_on_plate()
    with pytest.raises((ValueError, TypeError)) as error:
        call()
    is_one_line(error, *words)


@pytest.mark.parametrize("norm", [0.0, 1e200])
def test_a_quaternion_that_cannot_be_normalised(norm):
    state = O.bodies[column_on_plate()[1]].state
    before = state.ori
    with pytest.raises(ValueError) as error:
        state.ori = Quaternion(norm, 0, 0, 0)
    is_one_line(error, "State.ori", "norm of a quaternion > 0")
    assert state.ori == before


HULL = [(12.0, 7.0, 1.5), (12.2, 7.0, 1.5), (12.2, 7.2, 1.5), (12.0, 7.2, 1.5), (12.1, 7.1, 1.9)]
"""A pyramid far from the origin. [m]"""


@pytest.mark.parametrize("more, words", [
    ([(12.06, 7.12, 1.5)], ["vertex 5 (12.06, 7.12, 1.5) is no corner"]),
    ([(12.1, 7.1, 1.6)], ["vertex 5 (12.1, 7.1, 1.6) is no corner"]),
    ([(12.2, 7.2, 1.5)], ["vertices 2 and 5", "same point (12.2, 7.2, 1.5)"]),
])
def test_vertices_are_named_as_given(more, words):
    with pytest.raises((ValueError, RuntimeError)) as error:
        yt.polyhedron(HULL + more)
    is_one_line(error, *words)

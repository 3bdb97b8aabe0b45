# SPDX-License-Identifier: GPL-2.0-or-later
"""Misuse of a session: each case is refused and leaves the old state, is done right, or stops the run with a line that names the fault."""
import math
import time

import numpy as np
import pytest
import yade.wrapper as yw
import yade_timber as yt
from yade import O
from yade.minieigenHP import Vector3
from yade_timber.scene.engines import find_engine

NAN, INF = math.nan, math.inf


def column_on_plate(**options):
    """A column at rest on a fixed plate, joined to it: ids of plate and column."""
    O.reset()
    plate = O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    column = O.bodies.append(yt.box((0.105, 0.105, 1.0), (0, 0, 0.5)))
    O.dt, O.engines = 1e-4, yt.engines(**options)
    yt.connect(plate, column, [(x, y, 0) for x in (-0.05, 0.05) for y in (-0.05, 0.05)])
    O.run(20, True)
    return plate, column


def is_one_line(error, *words):
    text = str(error.value)
    assert "\n" not in text and "C++" not in text and "Boost" not in text, text
    assert all(word in text for word in words), text


# --- attributes -------------------------------------------------------------------------------------------------------


def complete(name):
    """An instance of a class of the package with valid attributes."""
    if name == "RoundedPolyhedron":
        return yt.box((1, 2, 3), (0, 0, 0)).shape
    if name == "TimberJoint":
        return yw.TimberJoint(id1=0, id2=1, anchors1=[(0, 0, 0)] * 2, anchors2=[(0, 0, 0)] * 2, kn=1, ks=1, strength=1)
    if name == "GroundMotionEngine":
        return yw.GroundMotionEngine(step=0.01, acceleration=[(0, 0, 0), (1, 0, 0)])
    if name == "HouseMonitor":
        return yw.HouseMonitor(heights=[2.73], bodies=[1, 2], levels=[1, 1])
    if name == "StructureMonitor":
        return yw.StructureMonitor(bodies=[1, 2], parts=[0, 1])
    pair = {"mass": 1.0, "friction": 0.5, "shearRatio": 0.4, "overlapLimit": 0.1}
    laws = {"ManifoldPhys": pair, "TimberPhys": {**pair, "modulus": 1e9, "radius": 0.1}, "SnowPhys": {**pair, "stiffness": 1e5}}
    return getattr(yw, name)(**laws.get(name, {}))


REFUSED = [
    *[(name, attribute, value) for name in ("TimberMat", "SnowMat") for attribute in ("density", "friction") for value in (-1.0, NAN, INF, "heavy", None)],
    ("TimberMat", "density", 0.0),
    ("TimberMat", "young", -5.0),
    ("TimberMat", "poisson", 9.0),
    ("SnowMat", "stiffnessPerMass", 0.0),
    ("UniformGravity", "gravity", Vector3(0, 0, NAN)),
    ("UniformGravity", "gravity", 9.81),
    ("GroundMotionEngine", "step", -0.01),
    ("GroundMotionEngine", "step", NAN),
    ("GroundMotionEngine", "start", INF),
    ("GroundMotionEngine", "scale", NAN),
    ("GroundMotionEngine", "acceleration", [Vector3(0, NAN, 0)]),
    ("HouseMonitor", "heights", [2.73, -1.0]),
    ("HouseMonitor", "interval", -0.01),
    ("HouseMonitor", "tiltDrift", NAN),
    ("HouseMonitor", "levels", [1, -1]),
    ("HouseMonitor", "levels", [1, 1, 1]),
    ("HouseMonitor", "bodies", [1]),
    ("StructureMonitor", "interval", -0.01),
    ("StructureMonitor", "jointInterval", NAN),
    ("StructureMonitor", "parts", [0, -1]),
    ("StructureMonitor", "parts", [0, 0, 0]),
    ("StructureMonitor", "bodies", [1]),
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
    ("Ip2_TimberMat_TimberMat_TimberPhys", "dampingRatio", -1.0),
    ("Ip2_ElementMat_ElementMat_SnowPhys", "dampingRatio", INF),
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
    for attribute, value in {"label": "mine", "dead": True, "ompThreads": 2, "color": Vector3(0, 1, 0), "wire": True, "execCount": 3}.items():
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


RESULTS = {
    "ContactForces": {"dashpotNormal", "dashpotShear", "friction", "jointDashpot", "released", "elasticNormal", "elasticShear", "elasticPower"},
    "GroundMotionEngine": {"work"},
    "HouseMonitor": {"tiltTime", "collapseTime"},
    "JointBreak": {"time", "force"},
    "JointEngine": {"released", "elastic", "yielded"},
}
"""Attributes that the engines compute."""
PAIRS = {"ManifoldPhys", "TimberPhys", "SnowPhys"}
"""Classes whose attributes Ip2 functors compute."""


@pytest.mark.parametrize("name", sorted(set(yt._class_names) - PAIRS))
def test_nan_is_no_parameter(name):
    target = complete(name)
    for attribute, value in target.dict().items():
        if type(value) is float and getattr(type(target), attribute).fset and attribute not in RESULTS.get(name, ()):
            with pytest.raises(ValueError) as error:
                setattr(target, attribute, NAN)
            is_one_line(error, f"{name}.{attribute}")


@pytest.mark.parametrize("name, wrong, right", [("RoundedPolyhedron", "radus", "radius"), ("TimberMat", "yung", "young"), ("ContactForces", "maxsweeps", "sweeps"), ("TimberMat", "dampingRatio", "")])
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
    for target, attribute, value in ((body.shape, "radius", 0.3), (body.material, "young", -5), (body.material, "poisson", 9), (body.material, "density", -1)):
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
    (lambda: yt.engines(gravity=(0, 0, NAN)), "engines: gravity"),
    (lambda: yt.engines(sweeps=2.5), "engines: sweeps = 2.5"),
    (lambda: yt.engines(sweeps=-3), "engines: sweeps = -3"),
    (lambda: yt.engines(tolerance=-1), "engines: tolerance = -1"),
    (lambda: yt.engines(damping_ratio="much"), "engines: damping_ratio"),
    (lambda: yt.engines(increment="closed"), "engines: increment"),
    (lambda: yt.engines(health_check=-1), "engines: health_check"),
    (lambda: yt.engines(skip_rest=10**12), "engines: skip_rest"),
    (lambda: yt.engines(monitor=3), "engines: monitor"),
    (lambda: yt.engines(joints=7), "engines: joints"),
    (lambda: yt.engines(joints=[7]), "engines: joints"),
    (lambda: yt.engines(ground_motion="kobe"), "ground_motion = 'kobe'"),
    (lambda: yt.connect(0, 1, []), "connect: points"),
    (lambda: yt.connect(0, 1, [(0, 0)]), "connect: points"),
    (lambda: yt.connect(0, 1, [(0, 0, NAN)]), "connect: points"),
    (lambda: yt.connect(0, 1, "abc"), "connect: points"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], normal=(0, 0, 0)), "connect: normal"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], stiffness=5), "connect: stiffness"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], stiffness=(1, -1)), "connect: stiffness"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], strength="strong"), "connect: strength"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], strength=0), "connect: strength"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], per="nail"), "connect: per", "nail"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], per=[]), "connect: per"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], kind=1), "connect: kind"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], damping_ratio=1.5), "connect: damping_ratio", "1.5"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], damping_ratio=NAN), "connect: damping_ratio"),
    (lambda: yt.connect(0, 1, [(0, 0, 0)], damping_ratio="critical"), "connect: damping_ratio"),
    (lambda: yt.connect("a", 1, [(0, 0, 0)]), "connect", "no body"),
    (lambda: yt.contacts(0, 99), "contacts", "99"),
    (lambda: yt.stable_dt("small"), "stable_dt: safety"),
    (lambda: yt.stable_dt(-1), "stable_dt: safety"),
    (lambda: yt.energy_residual(3), "energy_residual: terms"),
    (lambda: yt.box((1, 1, 1), "abc"), "centre = 'abc'"),
    (lambda: yt.box((1, 1, 1), (0, 0)), "centre = (0, 0)"),
    (lambda: yt.box((1, 1), (0, 0, 0)), "extents"),
    (lambda: yt.box((1, 1, -1), (0, 0, 0)), "extents"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), orientation=(1, 0, 0)), "orientation"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), material="oak"), "material = 'oak'"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), fixed="no"), "fixed"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), radius="thin"), "radius"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), radius=-0.1), "radius"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), name=5), "name"),
    (lambda: yt.box((1, 1, 1), (0, 0, 0), color="red"), "color"),
    (lambda: yt.polyhedron([]), "vertices"),
    (lambda: yt.polyhedron([("a", 0, 0)]), "vertices"),
    (lambda: yt.set_velocity(O.bodies[1], 3), "velocity"),
    (lambda: yt.set_velocity(1, (0, 0, 1)), "body"),
]


@pytest.mark.parametrize("call, words", [(call, words) for call, *words in CALLS])
def test_wrong_argument_is_named(call, words):
    column_on_plate()
    with pytest.raises((ValueError, TypeError)) as error:
        call()
    is_one_line(error, *words)


# --- bodies and the list of engines -----------------------------------------------------------------------------------


def sphere():
    """A ball of YADE's beside the column."""
    ball = yw.Body(shape=yw.Sphere(radius=0.1), material=yw.FrictMat())
    ball.state.mass, ball.state.inertia, ball.state.pos = 1.0, Vector3(1, 1, 1), Vector3(3, 0, 3)
    return ball


@pytest.mark.parametrize(
    "part, value, words",
    [
        ("material", None, ["material None", "TimberMat"]),
        ("material", yw.FrictMat(), ["material FrictMat"]),
        ("material", yw.ElementMat(), ["material ElementMat"]),
        ("state", None, ["no state"]),
        ("state", yw.State(), ["state.mass = 0"]),
        ("shape", None, ["shape None"]),
        ("shape", yw.RoundedPolyhedron(), ["no vertices"]),
    ],
)
def test_part_of_a_body(part, value, words):
    """Refused after contact; before the first contact the health check stops the run."""
    _, column = column_on_plate()
    body = O.bodies[column]
    before = getattr(body, part)
    with pytest.raises(ValueError) as error:
        setattr(body, part, value)
    is_one_line(error, f"body {column}", *words)
    assert getattr(body, part) == before
    O.run(20, True)
    loose = yt.box((0.1, 0.1, 0.1), (0, 0, 1.05))
    setattr(loose, part, value)
    new = O.bodies.append(loose)
    if part == "shape" and value is None:
        return O.run(20, True)  # a body without a shape has no contacts
    with pytest.raises(RuntimeError) as error:
        O.step()
    is_one_line(error, f"body {new}", *words)


@pytest.mark.parametrize("mass", [0.0, -1.0, NAN])
def test_mass_changed_by_hand(mass):
    """The message does not blame the time step."""
    _, column = column_on_plate(health_check=10)
    O.bodies[column].state.mass = mass
    with pytest.raises(RuntimeError) as error:
        for _ in range(50):  # O.run may lose an exception of its thread
            O.step()
    is_one_line(error, f"body {column}", "state.mass")


def test_other_shape_and_material_in_contact():
    _, column = column_on_plate()
    O.bodies[column].shape = yt.box((0.2, 0.2, 1.0), (0, 0, 0)).shape
    O.bodies[column].material = yt.snow()
    O.run(2000, True)
    assert len(yt.contacts(0, column)) == 4 and abs(O.bodies[column].state.pos[2] - 0.5) < 1e-3
    O.bodies[column].shape = yw.Sphere(radius=0.2)
    with pytest.raises(RuntimeError) as error:
        O.step()
    is_one_line(error, "Ig2", "Sphere")


@pytest.mark.parametrize("shape", [yw.Sphere(radius=0.1), yw.Facet(vertices=[(0, 0, 0), (1, 0, 0), (0, 1, 0)]), yw.Wall(), yw.Box(extents=(1, 1, 1))])
def test_shape_without_functor(shape):
    column_on_plate()
    other = sphere()
    other.shape = shape
    new = O.bodies.append(other)
    with pytest.raises(RuntimeError) as error:
        O.step()
    is_one_line(error, str(new), "Ig2", type(shape).__name__)
    O.bodies[new].mask = 2
    O.run(20, True)  # another group: no contact is possible


def without(kind):
    return [e for e in O.engines if not isinstance(e, kind)]


@pytest.mark.parametrize("kind", [yw.ForceResetter, yw.CollisionTrigger, yw.ContactLoop, yw.ContactForces, yw.SymplecticIntegrator])
def test_missing_engine(kind):
    column_on_plate()
    O.engines = without(kind)
    with pytest.raises(RuntimeError) as error:
        O.step()
    is_one_line(error, "O.engines", kind.__name__, "missing")


@pytest.mark.parametrize("kind", [yw.ForceResetter, yw.CollisionTrigger, yw.ContactLoop, yw.JointEngine, yw.UniformGravity, yw.ContactForces, yw.SymplecticIntegrator, yw.HealthCheck])
def test_doubled_engine(kind):
    column_on_plate()
    O.engines = [e for e in O.engines for _ in range(1 + isinstance(e, kind))]
    with pytest.raises(RuntimeError) as error:
        O.step()
    is_one_line(error, "O.engines", "twice")


def test_two_kinds_of_gravity():
    column_on_plate()
    O.engines = [*O.engines[:5], yw.GravityEngine(gravity=(0, 0, -9.81)), *O.engines[5:]]
    with pytest.raises(RuntimeError, match="gravity is there twice"):
        O.step()


@pytest.mark.parametrize("first, last", [(i, k) for i in range(2, 8) for k in range(i + 1, 8)])
def test_swapped_engines(first, last):
    """Of HealthCheck, ForceResetter, collider, loop, joints, gravity, contact forces, integrator; joints and gravity may be swapped."""
    column_on_plate()
    chain = list(O.engines)
    assert len(chain) == 8
    chain[first], chain[last] = chain[last], chain[first]
    O.engines = chain
    if (first, last) == (4, 5):
        return O.step()
    with pytest.raises(RuntimeError) as error:
        O.step()
    is_one_line(error, "O.engines", "must come before")


def test_reversed_engines():
    column_on_plate()
    O.engines = list(reversed(O.engines))
    with pytest.raises(RuntimeError, match="must come before"):
        O.step()


def test_engines_of_an_earlier_scene():
    column_on_plate()
    earlier = O.engines
    O.reset()
    O.bodies.append(yt.box((1, 1, 1), (0, 0, 0)))
    O.engines = earlier
    with pytest.raises(RuntimeError, match="earlier scene"):
        O.step()
    O.engines = yt.engines()
    O.step()


@pytest.mark.parametrize("dispatcher, words", [("geomDispatcher", "Ig2"), ("physDispatcher", "Ip2"), ("lawDispatcher", "Law2")])
def test_loop_without_functors(dispatcher, words):
    O.reset()
    O.bodies.append([yt.box((1, 1, 1), (0, 0, z)) for z in (0, 1)])
    O.engines = yt.engines()
    getattr(find_engine(yw.ContactLoop).loop, dispatcher).functors = []
    with pytest.raises(RuntimeError) as error:
        O.step()
    is_one_line(error, words)


def test_loop_with_the_functors_of_snow_only():
    """The Ip2 functor of snow takes any two materials of the package, but timber on timber has another law."""
    O.reset()
    O.bodies.append([yt.box((1, 1, 1), (0, 0, z)) for z in (0, 1)])
    O.engines = yt.engines()
    dispatcher = find_engine(yw.ContactLoop).loop.physDispatcher
    dispatcher.functors = [f for f in dispatcher.functors if isinstance(f, yw.Ip2_ElementMat_ElementMat_SnowPhys)]
    assert len(dispatcher.functors) == 1
    with pytest.raises(RuntimeError) as error:
        O.step()
    is_one_line(error, "Ip2", "TimberMat")
    for k in (0, 1):
        O.bodies[k].material = yt.snow()
    O.step()


def test_periodic_cell():
    column_on_plate()
    O.periodic = True
    O.engines = yt.engines()
    with pytest.raises(RuntimeError, match="periodic"):
        O.step()


# --- a run in the background ------------------------------------------------------------------------------------------


def pile():
    """Blocks on a plate that run in the background."""
    O.reset()
    O.bodies.append(yt.box((4, 4, 0.2), (0, 0, -0.1), fixed=True))
    for k in range(40):
        O.bodies.append(yt.box((0.2, 0.2, 0.2), (0.3 * (k % 8) - 1, 0.3 * (k // 8) - 1, 0.1001)))
    O.dt, O.engines = 1e-4, yt.engines()
    O.run()


def test_bodies_erased_and_added_in_the_background():
    pile()
    for k in range(1, 41):
        O.bodies.erase(k)
        assert O.running
        O.bodies.append(yt.box((0.2, 0.2, 0.2), (0.3 * (k % 8) - 1, 0.3 * (k // 8) - 1, 0.5)))
        time.sleep(0.002)
    step = O.iter
    while O.iter < step + 200:
        time.sleep(0.01)
    O.pause()
    O.wait()
    assert O.running is False and sum(b is not None for b in [O.bodies[k] for k in range(len(O.bodies))]) == 41


def test_parts_and_attributes_changed_in_the_background():
    pile()
    for k in range(1, 41):
        O.bodies[k].material = yt.timber(friction=0.3)
        O.bodies[k].shape = yt.box((0.2, 0.2, 0.2), (0, 0, 0)).shape
        with pytest.raises(ValueError):
            O.bodies[k].material = None
        find_engine(yw.ContactForces).sweeps = 40 + k % 3
    assert O.running
    O.pause()
    O.wait()


def test_a_run_of_some_steps_keeps_its_end():
    pile()
    O.pause()
    O.wait()
    time.sleep(0.1)
    end = O.iter + 500
    O.run(500)
    for k in range(1, 20):
        O.bodies.erase(k)
    O.wait()
    while O.running:
        time.sleep(0.01)
    assert O.iter == end


def test_erased_by_an_engine():
    """In the thread that computes the steps nothing waits."""
    pile()
    O.pause()
    O.wait()
    time.sleep(0.1)
    O.engines = [*O.engines, yw.PyRunner(command="O.bodies.erase(5)", iterPeriod=10, nDo=1, initRun=True)]
    O.run(50, True)
    assert O.bodies[5] is None


def test_energy_leaves_the_engines_alone(tmp_path):
    """Also those of a scene that was loaded and has made no step."""
    column_on_plate()
    before = yt.energy()
    O.save(str(tmp_path / "scene.xml"))
    O.load(str(tmp_path / "scene.xml"))
    assert yt.energy() == pytest.approx(before, rel=1e-12, abs=1e-15) and np.isfinite(list(before.values())).all()

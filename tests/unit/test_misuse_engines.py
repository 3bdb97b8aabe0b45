# SPDX-License-Identifier: GPL-2.0-or-later
"""Wrong bodies and lists of engines: each is refused, is done right, or stops the run with a line that names the fault.
"""
import math
from functools import partial

import pytest
import yade.wrapper as yw
import yade_timber as yt
from column_sample import column_on_plate, is_one_line, refused
from yade import O
from yade.minieigenHP import Vector3
from yade_timber.scene.engines import find_engine

yt.guard()


def sphere():
    """A ball of YADE's beside the column."""
    ball = yw.Body(shape=yw.Sphere(radius=0.1), material=yw.FrictMat())
    ball.state.mass, ball.state.inertia, ball.state.pos = 1.0, Vector3(1, 1, 1), Vector3(3, 0, 3)
    return ball


@pytest.mark.parametrize("part, value, words", [
    ("material", None, ["material None", "TimberMat"]),
    ("material", yw.FrictMat(), ["material FrictMat"]),
    ("material", yw.ElementMat(), ["material ElementMat"]),
    ("state", None, ["no state"]),
    ("state", yw.State(), ["state.mass = 0"]),
    ("shape", None, ["shape None"]),
    ("shape", yw.RoundedPolyhedron(), ["no vertices"]),
])
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
    refused(f"body {new}", *words)


@pytest.mark.parametrize("recorders", [["all"], ["spheres", "intr"], ["stress"], ["cpm"], ["bstresses"], ["unknown"]])
def test_recorder_that_reads_contacts(tmp_path, recorders):
    """It would take them for those of spheres and end the session."""
    column_on_plate()
    O.engines = [*O.engines, yw.VTKRecorder(fileName=str(tmp_path / "a-"), recorders=recorders, iterPeriod=1)]
    with pytest.raises(RuntimeError) as error:
        O.run(20, True)
    is_one_line(error, "VTKRecorder", recorders[-1], "export_vtk.py")


def test_recorder_of_bodies(tmp_path):
    column_on_plate()
    before = O.iter
    recorders = ["spheres", "facets", "boxes", "velocity", "force", "mass", "id", "mask", "clumpId", "materialId",
                 "colors", "coordNumber"]
    O.engines = [*O.engines, yw.VTKRecorder(fileName=str(tmp_path / "a-"), recorders=recorders, iterPeriod=1)]
    O.run(20, True)
    assert O.iter == before + 20 and list(tmp_path.iterdir())


@pytest.mark.parametrize("mass", [0.0, -1.0, math.nan])
def test_mass_changed_by_hand(mass):
    """The message does not blame the time step."""
    _, column = column_on_plate(health_check=10)
    yt.scene.attributes._update_attributes(O.bodies[column].state,
                                           {"mass": mass})  # a door that no rule in Python watches
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
    refused("Ig2", "Sphere")


@pytest.mark.parametrize("shape", [yw.Sphere(radius=0.1), yw.Facet(vertices=[(0, 0, 0), (1, 0, 0), (0, 1, 0)]),
                                   yw.Wall(), yw.Box(extents=(1, 1, 1))])
def test_shape_without_functor(shape):
    column_on_plate()
    other = sphere()
    other.shape = shape
    new = O.bodies.append(other)
    refused(str(new), "Ig2", f"In place of {type(shape).__name__} take yade_timber.box(", "fixed=True")
    O.bodies[new].mask = 2
    O.run(20, True)  # another group: no contact is possible


def without(chain, kind):
    return [e for e in chain if not isinstance(e, kind)]


def swapped(chain, first, last):
    """Of HealthCheck, ForceResetter, collider, loop, joints, check of overlaps, gravity, contact forces, integrator."""
    assert len(chain) == 9
    chain[first], chain[last] = chain[last], chain[first]
    return chain


NEEDED = (yw.ForceResetter, yw.CollisionTrigger, yw.ContactLoop, yw.ContactForces, yw.SymplecticIntegrator)
PAIRS = [(i, k) for i in range(2, 9) for k in range(i + 1, 9)]
FREE = [(4, 5), (4, 6), (5, 6)]
"""Places of joints, check and gravity, which may be swapped."""
WRONG_LISTS = [
    *((partial(without, kind=kind), [kind.__name__, "missing"]) for kind in NEEDED),
    *((lambda chain, kind=kind: [e for e in chain for _ in range(1 + isinstance(e, kind))], ["twice"])
      for kind in (*NEEDED, yw.JointEngine, yw.UniformGravity, yw.HealthCheck)),
    *((partial(swapped, first=i, last=k), ["must come before"]) for i, k in PAIRS if (i, k) not in FREE),
    (lambda chain: [*without(chain, yw.SymplecticIntegrator), yw.NewtonIntegrator(damping=0)],
     ["integrator (SymplecticIntegrator) is missing"]),
    (lambda chain: [*chain[:5], yw.GravityEngine(gravity=(0, 0, -9.81)), *chain[5:]], ["gravity is there twice"]),
]
"""(change of the list of engines, words of the message)"""


@pytest.mark.parametrize("change, words", WRONG_LISTS)
def test_wrong_list_of_engines(change, words):
    column_on_plate()
    O.engines = change(list(O.engines))
    refused("O.engines", *words)


@pytest.mark.parametrize("places", FREE)
def test_engines_that_may_be_swapped(places):
    column_on_plate()
    O.engines = swapped(list(O.engines), *places)
    O.step()


@pytest.mark.parametrize("kind", [yw.CollisionTrigger, yw.ContactForces, yw.SymplecticIntegrator])
def test_dead_engine(kind):
    """Noticed in the next step."""
    column_on_plate()
    find_engine(kind).dead = True
    refused("O.engines", kind.__name__, "missing")


def test_forces_behind_the_contacts():
    """Refused between ContactForces and the integrator; anywhere else YADE's engines may stand."""
    _, column = column_on_plate()
    push, chain = yw.ForceEngine(ids=[column], force=(0, 0, -1)), list(O.engines)
    for place in (1, 2, len(chain) - 2, len(chain)):
        O.engines = [*chain[:place], push, *chain[place:]]
        O.step()
    O.engines = [*chain[:-1], push, chain[-1]]
    refused("ForceEngine", "between ContactForces and the integrator", "before ContactForces")


@pytest.mark.parametrize("dt", [0.0, math.inf])
def test_time_step_in_a_running_scene(dt):
    """Refused before it destroys the state."""
    _, column = column_on_plate()
    O.dt = dt
    with pytest.raises(RuntimeError, match="O.dt = .*: it must be finite and > 0"):
        O.step()
    assert all(math.isfinite(x) for x in O.bodies[column].state.pos)


def test_joints_of_a_list():
    """A joint that is there twice, joins a body with itself or with none."""
    plate, column = column_on_plate()
    engine = find_engine(yw.JointEngine)
    joint = engine.joints[0]
    for other, words in ((joint, "same joint"), (yw.TimberJoint(id1=plate, id2=plate), "two bodies"), (yw.TimberJoint(
            id1=plate, id2=99), "two bodies")):
        if other is not joint:
            other.updateAttrs(
                {name: getattr(joint, name)
                 for name in ("anchors1", "anchors2", "normal", "kn", "ks", "strength")})
        O.engines = [yw.JointEngine() if isinstance(e, yw.JointEngine) else e for e in O.engines]
        for one in (joint, other):
            find_engine(yw.JointEngine).append(one)
        refused("JointEngine.joints[1]", words)


def test_material_in_contact():
    """Stiffness and friction of the contacts follow; the geometry of a shape in the scene cannot be changed in place.
    """
    plate, column = column_on_plate()
    assert O.interactions[plate, column].phys.friction == pytest.approx(0.5)
    O.bodies[column].material = yt.timber(friction=0.1)
    O.run(3, True)
    assert O.interactions[plate, column].phys.friction == pytest.approx(0.1)
    with pytest.raises(ValueError, match=f"the shape of body {column} in the scene"):
        O.bodies[column].shape.radius = 0.01


def test_material_of_a_loaded_contact(tmp_path):
    """Changed right after `O.load`, also the damping ratio of the functor. Attributes set by hand stay, and are saved.
    """
    plate, column = column_on_plate()
    O.interactions[plate, column].phys.friction = 0.33
    O.run(3, True)
    O.save(str(tmp_path / "scene.xml"))
    O.load(str(tmp_path / "scene.xml"))
    O.run(3, True)
    assert O.interactions[plate, column].phys.friction == 0.33
    O.load(str(tmp_path / "scene.xml"))
    O.bodies[column].material.friction = 0.2
    O.run(3, True)
    phys = O.interactions[plate, column].phys
    assert phys.friction == pytest.approx(0.2)
    functors = find_engine(yw.ContactLoop).loop.physDispatcher.functors
    next(f for f in functors if isinstance(f, yw.Ip2_TimberMat_TimberMat_TimberPhys)).dampingRatio = 0.5
    O.run(3, True)
    assert phys.dampingRatio == 0.5


def test_material_of_another_law_in_a_loaded_contact(tmp_path):
    plate, column = column_on_plate()
    O.save(str(tmp_path / "scene.xml"))
    O.load(str(tmp_path / "scene.xml"))
    O.bodies[column].material = yt.snow()
    O.run(3, True)
    assert isinstance(O.interactions[plate, column].phys, yw.SnowPhys)


def test_material_replaced_in_a_deep_contact():
    """Bodies that have sunk into each other were not placed there: the contact goes on."""
    O.reset()
    soft = dict(young=1e8, density=2000)
    plate = O.bodies.append(yt.box((2, 2, 1), (0, 0, -0.5), fixed=True, material=yt.timber(**soft)))
    block = O.bodies.append(yt.box((1, 1, 1), (0, 0, 0.5), material=yt.timber(**soft)))
    O.dt, O.engines = 1e-4, yt.engines()
    O.run(5000, True)
    assert yt.contacts(plate, block)[0]["overlap"] > 1e-3
    height = O.bodies[block].state.pos[2]
    O.bodies[block].material = yt.timber(**soft, friction=0.1)
    O.run(1000, True)
    assert O.bodies[block].state.pos[2] == pytest.approx(height, abs=1e-5)
    assert O.interactions[plate, block].phys.friction == pytest.approx(0.1)


@pytest.mark.parametrize("velocity, spin, placed", [(0, 0, True), (0, 20, True), (0.4, 0, True), (-0.4, 0, True),
                                                    (-0.6, 0, False)])
def test_moving_body_that_is_placed(velocity, spin, placed):
    """Its overlap has energy, unless the approach in a step explains it."""
    O.reset()
    O.bodies.append(yt.box((3, 3, 0.2), (0, 0, -0.1), fixed=True))
    beam = O.bodies[O.bodies.append(yt.box((2, 0.1, 0.1), (0, 0, 0.05 - 5e-5)))]
    O.dt, O.engines = 1e-4, yt.engines()
    yt.set_velocity(beam, (0, 0, velocity), (0, 0, spin))
    O.step()
    assert (find_engine(yw.ContactForces).placed > 0) == placed


def test_peaks_of_a_wall_are_shears():
    """A spring along its normal alone (ks = 0), pressed together: its force is a shear in the wall's plane, no pull."""
    O.reset()
    plate = O.bodies.append(yt.box((1, 1, 0.2), (0, 0, -0.1), fixed=True))
    block = O.bodies.append(yt.box((0.2, 0.2, 0.2), (0, 0, 0.5)))  # above the plate, carried by the joint alone
    monitor = yw.Sampler(bodies=[block], groups=[0], jointInterval=0)
    O.dt, O.engines = 1e-4, [*yt.engines(), monitor]
    yt.connect(plate, block, [(0, 0, 0.5)], normal=(0, 0, 1), stiffness=(1e5, 0), strength=1e4, damping_ratio=1.0)
    O.run(5000, True)
    weight = 9.81 * O.bodies[block].state.mass
    assert monitor.pull[0] == 0 and monitor.shear[0] == pytest.approx(
        weight, rel=1e-6)  # critically damped: no overshoot; observed 4e-12


def test_reset_time_keeps_the_monitors():
    _, column = column_on_plate()
    monitor = yw.Sampler(bodies=[column], groups=[0], interval=1e-3)
    O.engines = [*O.engines, monitor]
    O.run(200, True)
    before = len(monitor.rows)
    O.resetTime()
    O.run(200, True)
    assert len(monitor.rows) >= 2 * before - 8 > before


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


def test_loop_with_the_functors_of_snow_only():
    """The Ip2 functor of snow takes any two materials of the package, but timber on timber has another law."""
    O.reset()
    O.bodies.append([yt.box((1, 1, 1), (0, 0, z)) for z in (0, 1)])
    O.engines = yt.engines()
    dispatcher = find_engine(yw.ContactLoop).loop.physDispatcher
    dispatcher.functors = [f for f in dispatcher.functors if isinstance(f, yw.Ip2_ElementMat_ElementMat_SnowPhys)]
    assert len(dispatcher.functors) == 1
    refused("Ip2", "TimberMat")
    for k in (0, 1):
        O.bodies[k].material = yt.snow()
    O.step()


def test_periodic_cell():
    column_on_plate()
    O.periodic = True
    with pytest.raises(RuntimeError, match="periodic"):
        O.step()

# SPDX-License-Identifier: GPL-2.0-or-later
"""Frames of single members at rest beside statics: bar forces by the method of joints, deflection from the stiffness of
joints, thrust of a three-hinged frame.

Bars are rigid, so that joints alone deform. Gaps keep contacts out of the joints.
"""
import numpy as np
import pytest
import yade.wrapper as yw
from yade_timber.scene.engines import find_engine
from timber_houses.scene.scenario import Scenario, build

O = yw.Omega()
G = 9.81
GAP, SECTION, RADIUS = 0.005, 0.04, 0.15
"""Between bars and nodes; side of a bar; distance of a node's faces from its centre. [m]"""
STIFFNESS = 2e7
"""Of a joint. [N/m]"""
HEAD = f"""\
extends: frame
name: statics
materials: {{heavy: {{law: timber, density: 20000, young: 8.82e9, poisson: 0.4}}}}
law: {{joint_damping: 0.8}}
joint_types: {{pin: {{kn: {STIFFNESS}, ks: {STIFFNESS}, strength: .inf, at: PLACE}}}}
joints: {{beams: null, rafters: null, bars: {{between: [beam, [beam, foundation]], type: pin, kind: bar}}}}
joint_search: {{gap: {GAP * 1.01}}}
frame:
"""


def at_rest(folder, text, place, seconds=8.0):
    """(HouseModel, {(a, b): force (3,) on a [N]}, displacements (3,) {name: [m]}) of a settled frame."""
    path = folder / "frame.yaml"
    path.write_text(HEAD.replace("PLACE", place) + text)
    model = build(Scenario("statics", str(path)))
    for _ in range(round(seconds / O.dt)):
        O.step()
    assert max(body.state.vel.norm() for body in O.bodies) < 1e-4  # of 0.1 m/s after 1 cm of free fall
    forces = {(spec.a, spec.b): np.sum([list(force) for force in joint.forces], axis=0)
              for spec, joint in zip(model.joints, find_engine(yw.JointEngine).joints)}
    moved = {e.name: np.array(b.state.pos - b.state.refPos) for e, b in zip(model.elements, O.bodies)}
    return model, forces, moved


NODES = {"A": (0, 3), "B": (4, 3), "C": (2, 4.5), "D": (2, 3), "E": (4, 5)}
"""x, z [m] of a king-post truss A B C with its tie through D. A is fixed, B hangs from the fixed E: a roller."""
BARS = ("AC", "BC", "AD", "BD", "CD", "BE")
FREE = "BCD"


def direction(bar):
    """Unit vector (2,) from the first to the second node of a bar."""
    step = np.subtract(NODES[bar[1]], NODES[bar[0]])
    return step / np.linalg.norm(step)


def profile(node):
    """(n, 2) corners of a node: a face across each of its bars, others about 45 degrees apart. u points to -x."""
    normals = [direction(bar) if bar[0] == node else -direction(bar) for bar in BARS if node in bar]
    angles = [np.arctan2(n[1], n[0]) for n in normals]
    angles += [a for a in np.radians(range(0, 360, 45)) if max(np.cos(a - b) for b in angles) < np.cos(np.radians(25))]
    n = np.array([(np.cos(a), np.sin(a)) for a in sorted(np.mod(angles, 2 * np.pi))])
    corners = [np.linalg.solve([a, b], [RADIUS, RADIUS]) for a, b in zip(n, np.roll(n, -1, 0))]
    return [[float(-u), float(v)] for u, v in corners]


def truss():
    """Text of the members."""
    lines = ["  members:"]
    for name, (x, z) in NODES.items():
        kind = "beam" if name in FREE else "foundation, fixed: true"
        lines.append(f"    {name}: {{from: [{x}, -0.1, {z}], to: [{x}, 0.1, {z}], profile: {profile(name)},"
                     f" material: heavy, kind: {kind}}}")
    for bar in BARS:
        ends = [np.array(NODES[node]) + sign * (RADIUS + GAP) * direction(bar) for node, sign in zip(bar, (1, -1))]
        lines.append(f"    {bar}: {{from: [{ends[0][0]}, 0, {ends[0][1]}], to: [{ends[1][0]}, 0, {ends[1][1]}],"
                     f" section: [{SECTION}, {SECTION}]}}")
    return "\n".join([*lines, "  storeys: [[0, 3]]", ""])


def method_of_joints(loads):
    """{bar: pull [N]} for {node: (2,) load [N]}: equilibrium of the free nodes."""
    matrix, right = np.zeros((2 * len(FREE), len(BARS))), np.zeros(2 * len(FREE))
    for k, node in enumerate(FREE):
        right[2 * k:2 * k + 2] = -np.array(loads.get(node, (0, 0)))
        for j, bar in enumerate(BARS):
            if node in bar:
                matrix[2 * k:2 * k + 2, j] = direction(bar) * (1 if bar[0] == node else -1)
    return dict(zip(BARS, np.linalg.solve(matrix, right)))


@pytest.fixture(scope="module")
def king_post(tmp_path_factory):
    """(pulls by hand [N], pulls of the frame [N], displacements [m])"""
    model, forces, moved = at_rest(tmp_path_factory.mktemp("truss"), truss(), "corners")
    mass = {e.name.removeprefix("frame."): e.mass for e in model.elements}
    loads = {node: (0.0, -G * (mass[node] + sum(mass[bar] / 2 for bar in BARS if node in bar))) for node in FREE}
    pulls = {}
    for bar in BARS:
        ends = [forces[pair] * (1 if pair[0] == f"frame.{bar}" else -1) @ np.insert(direction(bar), 1, 0) * sign
                for node, sign in zip(bar, (-1, 1))
                for pair in forces if set(pair) == {f"frame.{bar}", f"frame.{node}"}]
        assert len(ends) == 2
        pulls[bar] = float(np.mean(ends))  # its own weight changes the pull along it
    return method_of_joints(loads), pulls, moved


def test_bar_forces_by_the_method_of_joints(king_post):
    """1 % of the largest force: a bar of width b and length L with four springs at its ends has the lateral stiffness
    k b^2 / (2 L^2), 0.1 % of the axial one k / 2, and the truss sags by five times the stretch of its bars."""
    expected, found, _ = king_post
    for bar in BARS:
        assert found[bar] == pytest.approx(expected[bar], abs=0.01 * max(map(abs, expected.values()))), bar


def test_deflection_of_a_king_post_truss(king_post):
    """Virtual work: sum of F f 2 / k over the bars, with a joint at either end: 1 % likewise."""
    expected, _, moved = king_post
    unit = method_of_joints({"D": (0, -1)})
    sag = sum(expected[bar] * unit[bar] * 2 / STIFFNESS for bar in BARS)
    assert -moved["frame.D"][2] == pytest.approx(sag, rel=0.01)


SPAN, RISE = 6.0, 2.0
HINGED = f"""\
  members:
    foot: {{from: [0, 0, 0], to: [0, 0, 0.5], section: [0.4, 0.4], kind: foundation, fixed: true,
           repeat: &both {{mirror: x, at: {SPAN / 2}}}}}
    rafter: {{from: [0, 0, {0.5 + GAP}], to: [{SPAN / 2 - GAP / 2}, 0, {0.5 + RISE}], section: [0.2, 0.2],
             cuts: [{{z: {0.5 + GAP}}}, {{x: {SPAN / 2 - GAP / 2}}}], repeat: *both}}
  storeys: [[0.5, 2]]
"""


def test_thrust_of_a_three_hinged_frame(tmp_path):
    """Moments of one half about its foot: H f = W a, as the force at the ridge is level by symmetry; f: height of the
    ridge's joint above the foot's, a: distance of the weight W from the foot. 0.1 %, from the change of geometry."""
    model, forces, _ = at_rest(tmp_path, HINGED, "centre")
    rafter = model.element("frame.rafter.1")
    (foot,) = (joint for joint in model.joints if {joint.a, joint.b} == {"frame.rafter.1", "frame.foot.1"})
    (ridge,) = (joint for joint in model.joints if {joint.a, joint.b} == {"frame.rafter.1", "frame.rafter.2"})
    (length, _, rise), arm = ridge.centre - foot.centre, (rafter.solid.centroid - foot.centre)[0]
    weight = G * rafter.mass
    force = np.abs(forces[foot.a, foot.b])
    assert force[2] == pytest.approx(weight, rel=1e-3)
    assert force[0] == pytest.approx(weight * arm / rise, rel=1e-3)
    assert rise == pytest.approx(RISE, abs=0.15) and length == pytest.approx(SPAN / 2, abs=0.15)

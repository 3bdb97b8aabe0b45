# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies at the tolerances of the contact patterns do not sink: flush and shifted faces, parallel edges, corners."""
import math

import pytest
import yade_timber as yt
from yade import O
from yade.minieigenHP import Quaternion, Vector3

SHIFTS = (0.0, 1e-9, 0.99e-4, 1e-4, 1.01e-4, 2e-4)
"""About the flush tolerance [m]"""
WEIGHT = 9.81 * 340  # of 1 m3 [N]


def settled(lower, upper, size, seconds=0.5, **options):
    """Largest velocity of centre or surface in the last tenth of the time [m/s], upper body, vertical force of all
    contacts [N]."""
    O.reset()
    O.dt = 5e-4
    O.bodies.append(lower)
    top = O.bodies[O.bodies.append(upper)]
    O.engines = yt.engines(**options)
    O.run(round(0.9 * seconds / O.dt), True)
    fastest = 0.0
    for _ in range(10):
        O.run(round(0.01 * seconds / O.dt), True)
        fastest = max(fastest, top.state.vel.norm(), size * top.state.angVel.norm())
    force = sum(p["normal_force"] * p["normal"][2] for p in yt.contacts(0, 1))
    return fastest, top, abs(force)


@pytest.mark.parametrize("vertex_edge", (True, False))
@pytest.mark.parametrize("size", (1.0, *(pytest.param(size, marks=pytest.mark.rare) for size in (0.1, 3.0))))
def test_flush_cubes(size, vertex_edge):
    """A cube on its equal, shifted both ways. Hertz's overlap of a quarter of the weight is below 0.1 mm."""
    for shift in SHIFTS:
        for other in (shift, 0.0):
            lower = yt.box((size,) * 3, (0, 0, -size / 2), fixed=True)
            upper = yt.box((size,) * 3, (shift, other, size / 2))
            fastest, top, force = settled(lower, upper, size, vertex_edge=vertex_edge)
            assert abs(top.state.pos[2] - size / 2) < 1e-4 * size, (shift, other)
            assert force == pytest.approx(WEIGHT * size**3, rel=1e-3)
            assert fastest < 1e-5


@pytest.mark.parametrize("turn", (0.0, 1e-6, 1e-4, 4.9e-3, 5.1e-3))
def test_turned_cubes(turn):
    """Turned by angles about the tolerance of parallel edges: the faces bear all the same."""
    yaw = Quaternion(Vector3(0, 0, 1), turn)
    fastest, top, force = settled(yt.box((1, 1, 1), (0, 0, -0.5), fixed=True),
                                  yt.box((1, 1, 1), (1e-4, 1e-4, 0.5), orientation=yaw), 1)
    assert abs(top.state.pos[2] - 0.5) < 1e-4
    assert force == pytest.approx(WEIGHT, rel=1e-3)
    assert fastest < 1e-5


@pytest.mark.parametrize("yaw", (0.0, 1e-6, 1e-4, 1e-3, 4e-3, 6e-3))
def test_edge_on_edge(yaw):
    """A beam falls on its edge upon that of another one. It may roll off but does not sink by the radius (20 mm)."""
    size, edge = 0.2, Quaternion(Vector3(0, 1, 0), math.pi / 4)
    lower = yt.box((size, 1, size), (0, 0, 0), orientation=edge, fixed=True)
    radius = lower.shape.radius
    upper = yt.box((size, 1, size), (0, 0, size * math.sqrt(2)), orientation=Quaternion(Vector3(0, 0, 1), yaw) * edge)
    O.reset()
    O.dt = 1e-4
    O.bodies.append(lower)
    body = O.bodies[O.bodies.append(upper)]
    O.engines = yt.engines()
    for _ in range(10):
        O.run(100, True)
        x, _, z = body.state.pos
        assert 2 * ((size / 2 - radius) * math.sqrt(2) + radius) - math.hypot(x, z) < 1e-3


@pytest.mark.parametrize("thickness, width", ((0.3, 0.105), (1.0, 0.24)))
def test_post_on_a_seam(thickness, width):
    """The radius of thick slabs leaves a groove at their seam, narrower than the post."""
    O.reset()
    O.dt = 5e-4
    for x in (-1, 1):
        O.bodies.append(yt.box((2, 2, thickness), (x, 0, -thickness / 2), fixed=True))
    post = O.bodies[O.bodies.append(yt.box((width, width, 1), (0, 0, 0.5)))]
    O.engines = yt.engines()
    O.run(1000, True)
    start = post.state.pos[2]
    O.run(1000, True)
    assert post.state.pos[2] == pytest.approx(start, abs=1e-4)


def test_uncarried_overlap_is_named(capfd):
    """Without vertex-edge contacts edges that meet in parallel sink into each other, and a check says so."""
    edge = Quaternion(Vector3(0, 1, 0), math.pi / 4)
    gap = 2 * (0.08 * math.sqrt(2) + 0.02)
    O.reset()
    O.dt = 1e-4
    O.bodies.append(yt.box((0.2, 1, 0.2), (0, 0, 0), orientation=edge, fixed=True))
    O.bodies.append(yt.box((0.2, 1, 0.2), (0, 0, gap), orientation=edge))
    O.engines = yt.engines(vertex_edge=False)
    check = next(e for e in O.engines if isinstance(e, yt.OverlapCheck))
    check.interval = 0.01
    O.run(600, True)
    assert {check.id1, check.id2} == {0, 1} and check.largest > 2e-3
    assert "bodies 0 and 1 overlap by" in capfd.readouterr().err

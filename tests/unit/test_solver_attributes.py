# SPDX-License-Identifier: GPL-2.0-or-later
"""Ranges of the attributes of joints, contact laws and the contact solver, and getters that change nothing."""
import math

import pytest
import yade.wrapper as yw
import yade_timber as yt
from yade import O
from yade_timber.plugin import compiled
from yade_timber.scene.engines import find_engine

NAN, INF = math.nan, math.inf
PAIR = {"mass": 1, "friction": 0.5, "shearRatio": 0.4, "dampingRatio": 1, "overlapLimit": 0.01}
PARAMETERS = {phys: set(getattr(yw, phys)().dict()) - set(yw.ManifoldPhys().dict()) for _, phys,
              _ in compiled.contact_laws()}
"""Parameters of each contact law."""
JOINT = {"anchors1": [(0, 0, 0)], "anchors2": [(0, 0, 0)], "kn": 1, "ks": 1, "strength": 1}
SLIP = JOINT | {"law": "slip", "frictionShare": 0.5, "softeningStretch": 2, "ultimateStretch": 3}
POSITIVE, POSITIVE_OR_INFINITE, NOT_NEGATIVE = (0, -1, NAN, INF), (0, -1, NAN), (-1, NAN, INF)

RANGES = [  # class, attributes that make it complete, owner of the attribute in the message, attribute, refused values
    *[(yw.ContactForces, {}, "ContactForces", *one) for one in (("sweeps", (-1, )), ("tolerance", POSITIVE))],
    *[(getattr(yw, ip2), {}, ip2, "dampingRatio", NOT_NEGATIVE) for ip2, _, _ in compiled.contact_laws()],
    *[(yw.SnowPhys, PAIR | {"stiffness": 1}, "ManifoldPhys", *one)
      for one in (("mass", POSITIVE_OR_INFINITE), ("friction", NOT_NEGATIVE), ("shearRatio", POSITIVE),
                  ("dampingRatio", NOT_NEGATIVE), ("overlapLimit", POSITIVE))],
    *[(getattr(yw, phys), PAIR | dict.fromkeys(own - {name}, 1), phys, name, POSITIVE)
      for phys, own in PARAMETERS.items()
      for name in sorted(own)],
    *[(yw.TimberJoint, JOINT, "TimberJoint", *one)
      for one in (("kn", POSITIVE), ("ks", NOT_NEGATIVE), ("strength", POSITIVE_OR_INFINITE))],
    *[(yw.TimberJoint, JOINT, "TimberJoint", name, refused)
      for name, refused in (("frictionShare", (-0.1, 1.1, NAN)), ("softeningStretch", POSITIVE_OR_INFINITE))],
    *[(yw.TimberJoint, SLIP, "TimberJoint", *one)
      for one in (("ks", (2, NAN)), ("softeningStretch", (0.5, NAN, INF)), ("ultimateStretch", (1.5, NAN, INF)),
                  ("law", ("ductile", )))],
    (yw.TimberJoint, SLIP, "TimberJoint", "envelope", ([(1, 1)], [(1, 1), (1, 0)], [(1, 1), (2, 1)], [(0.5, 1), (2, 0)],
                                                       [(NAN, 1), (2, 0)], [(1, -1), (2, 0)])),
    (yw.TimberJoint, SLIP | {"envelope": [(1, 0.5), (2, 1), (3, 0)]}, "TimberJoint", "strength", (0.5, 2, NAN)),
    (yw.TimberJoint, JOINT, "TimberJoint", "normal", ((0, 0, 0), (0, 0, 2), (NAN, 0, 1))),
    *[(yw.TimberJoint, JOINT, "TimberJoint", name, ([(0, 0, NAN)], [(0, 0, 0)] * 2))
      for name in ("anchors1", "anchors2")],
    (yw.TimberJoint, JOINT, "TimberJoint", "broken", ([0, 0], )),
    (yw.TimberJoint, JOINT, "TimberJoint", "dampingRatio", (-0.1, 1.1, NAN)),
]


@pytest.mark.parametrize("kind, complete, owner, name, refused", RANGES,
                         ids=lambda x: getattr(x, "__name__", x if isinstance(x, str) else ""))
def test_values_out_of_range_are_refused(kind, complete, owner, name, refused):
    for value in refused:
        with pytest.raises(ValueError) as refusal:
            kind(**{**complete, name: value})
        assert owner in str(refusal.value) and (name in str(refusal.value) or name == "anchors1"
                                                )  # two lengths that differ: the second one is named
        if isinstance(value, (int, float)):
            assert f"{value:g}" in str(refusal.value)
        given = kind(**{**complete, name: 1} if name in PARAMETERS.get(kind.__name__, ()) else complete)
        with pytest.raises(ValueError):
            setattr(given, name, value)


def test_limits_of_the_ranges_are_accepted():
    assert yw.ContactForces(sweeps=0).sweeps == 0
    assert yw.TimberJoint(**{**JOINT, "strength": INF}).strength == INF
    assert yw.TimberJoint(**{**JOINT, "ks": 0}).ks == 0
    assert yw.SnowPhys(**PAIR | {"stiffness": 1, "mass": INF, "friction": 0, "dampingRatio": 0}).mass == INF


def test_joint_built_attribute_by_attribute():
    joint = yw.TimberJoint()
    for name in ("kn", "ks", "strength", "anchors1", "anchors2"):
        setattr(joint, name, JOINT[name])
    assert joint.broken == [0] and not joint.isBroken
    with pytest.raises(ValueError, match="JointEngine.append"):
        yw.JointEngine().append(None)


def test_history_of_yielding_springs():
    assert list(yw.TimberJoint(**SLIP).largestStretches) == [0] and len(yw.TimberJoint(**SLIP).plasticStretches) == 1
    assert len(yw.TimberJoint(**JOINT).largestStretches) == 0


def test_refused_length_leaves_the_springs():
    joint = yw.TimberJoint(
        **{**JOINT, "anchors1": [(0, 0, 0)] * 4, "anchors2": [(0, 0, 0)] * 4, "broken": [0, 1, 0, 0]})
    for anchors in ([(0, 0, 0)], []):
        with pytest.raises(ValueError):
            joint.anchors1 = anchors
    assert len(joint.anchors2) == 4 and joint.broken == [0, 1, 0, 0]


def rocking_column():
    O.reset()
    plate = O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    column = O.bodies.append(yt.box((0.105, 0.105, 1.0), (0, 0, 0.5)))
    O.dt, O.engines = 1e-4, yt.engines()
    yt.connect(plate, column, [(x, y, 0) for x in (-0.05, 0.05) for y in (-0.05, 0.05)])
    yt.set_velocity(O.bodies[column], (0.3, 0, 0))


def as_hex():
    """All that moves, to the last bit."""
    return [
        x.hex() for b in O.bodies
        for v in (b.state.pos, b.state.vel, b.state.angMom, [b.state.ori[k] for k in range(4)]) for x in v
    ]


def test_stable_dt_changes_nothing():
    """Neither the run nor the engine's state, in any step."""
    rocking_column()
    O.run(300, True)
    expected = as_hex()
    rocking_column()
    solver = find_engine(yw.ContactForces)
    for _ in range(30):
        O.run(10, True)
        before = solver.dict()
        limits = {yt.stable_dt() for _ in range(2)}
        assert len(limits) == 1 and solver.dict() == before
    assert as_hex() == expected


def test_stable_dt_counts_unbroken_springs_of_the_joint_engine():
    rocking_column()
    free = yt.stable_dt(1)  # no contact yet: the joint's four springs
    joint = find_engine(yw.JointEngine).joints[0]
    joint.kn = joint.ks = 4 * joint.kn
    assert yt.stable_dt(1) == pytest.approx(free / 2, rel=1e-3)  # stop of the power iteration
    limit = yt.stable_dt(1)
    joint.dampingRatio = 1
    assert yt.stable_dt(1) == limit  # dashpots are implicit
    joint.broken = [1] * 4
    assert yt.stable_dt(1) == math.inf

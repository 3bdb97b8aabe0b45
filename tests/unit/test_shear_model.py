# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""The lumped-mass model and the graded houses of scripts/validation, against closed forms and sums by hand."""
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.signal import lsim
import graded_changes as changes
import graded_houses as graded
import kobe_like
import shear_model as shear
import wall_grades as grades
from house_storeys import AXES, column_ends, wall_joints, wall_springs
from wall_spring import WallSpring
from timber_houses.base.errors import RunError

HEIGHT = 2.73
"""[m]"""
ELASTIC = (1e9, 0.2, 1e6, 2e6)
"""Strength [N], friction share, softening and ultimate drift of a spring that never yields."""


def elastic_storey(mass, stiffness, weight=0.0):
    """stiffness [N/m]"""
    return shear.Storey(mass, HEIGHT, weight, 1e-9, [shear.slip_spring(stiffness * HEIGHT, *ELASTIC)])


def wall():
    """Backbone 10 kN at 0.01 rad, flat to 0.05, zero at 0.1; a fifth of it in friction."""
    return shear.slip_spring(1e6, 1e4, 0.2, 0.05, 0.1)


# --- model ------------------------------------------------------------------------------------------------------------


def test_first_loading_follows_the_backbone():
    for drift, force in ((0.005, 5e3), (0.02, 1e4), (0.05, 1e4), (0.075, 5e3), (0.1, 0.0), (0.2, 0.0)):
        spring = wall()
        shears = [spring.shear(g) for g in np.linspace(0, drift, 200)]
        assert shears[-1] == pytest.approx(force, abs=1e-6)


def test_only_the_friction_part_acts_within_the_slip():
    spring = wall()
    for drift in (*np.linspace(0, 0.04, 100), *np.linspace(0.04, -0.01, 100)):
        force = spring.shear(drift)
    assert force == pytest.approx(-0.2 * 1e4)
    for drift in np.linspace(-0.01, -0.04, 100):
        force = spring.shear(drift)
    assert force == pytest.approx(-1e4)


def test_a_loop_dissipates_four_yield_forces_of_the_friction_part():
    """After the first cycle to g: 4 phi F (g - y), a parallelogram; the slip part returns its energy."""
    there, back = np.linspace(0.04, -0.04, 800), np.linspace(-0.04, 0.04, 800)
    spring, path = wall(), np.concatenate([np.linspace(0, 0.04, 400), there, back, there, back])
    forces = np.array([spring.shear(g) for g in path])
    work = np.trapz(forces[2000 - 1:], path[2000 - 1:])
    assert work == pytest.approx(4 * 0.2 * 1e4 * (0.04 - 0.01), rel=2e-3)


def test_periods_of_two_equal_storeys():
    """omega2 = k/m (3 - sqrt 5) / 2."""
    storeys = [elastic_storey(1e4, 1e6), elastic_storey(1e4, 1e6)]
    assert shear.first_period(storeys) == pytest.approx(2 * np.pi / np.sqrt(100 * (3 - np.sqrt(5)) / 2))


@pytest.mark.parametrize("weight", [0.0, 3e5])
def test_response_is_that_of_an_oscillator(weight):
    """With P-delta the stiffness is k - W / h, also of the damping ratio. Tolerance: second order in the step, observed
    3e-4."""
    mass, stiffness, dt = 1e4, 1e6, 0.01
    time = np.arange(0, 8, dt)
    ground = np.sin(2 * np.pi * time / 0.9)
    times, drifts = shear.response([elastic_storey(mass, stiffness, weight)], ground, dt, 0.05)
    damping = 2 * 0.05 * np.sqrt((stiffness - weight / HEIGHT) / mass)
    system = ([[0, 1], [-(stiffness - weight / HEIGHT) / mass, -damping]], [[0], [-1]], [[1, 0]], [[0]])
    expected = lsim(system, np.interp(times, time, ground), times)[1]
    assert np.abs(drifts[:, 0] * HEIGHT - expected).max() < 2e-3 * np.abs(expected).max()


def test_the_first_mode_has_the_damping_ratio():
    """Three storeys that rock and have P-delta: eigenvalues -zeta omega +- i omega_d of the damped system."""
    storeys = [shear.Storey(1e4, HEIGHT, weight, 0.09, [wall(), wall()]) for weight in (3e5, 2e5, 1e5)]
    mass, stiffness = 1e4, shear.stiffness_matrix(storeys, shear.Storey.at_rest)
    damping = shear.damping_time(storeys, 0.02) * shear.stiffness_matrix(storeys)
    system = np.block([[np.zeros((3, 3)), np.eye(3)], [-stiffness / mass, -damping / mass]])
    slowest = min(np.linalg.eigvals(system), key=abs)
    # damping that is not proportional to the stiffness: error of second order
    assert -slowest.real / abs(slowest) == pytest.approx(0.02, rel=2e-3)


@pytest.mark.parametrize("drift, back, tangent", [
    (0.005, 0.0, 1.0),      # elastic
    (0.04, 0.0, 0.0),       # on the plateau
    (0.075, 0.0, 0.0),      # loses strength
    (0.04, -1e-4, 1.0),     # unloads
    (0.04, -0.015, 0.2),    # in the slack, friction part elastic
    (0.04, -0.03, 0.0),     # in the slack, friction part slides
])
def test_tangent_stiffness_is_never_negative(drift, back, tangent):
    spring = wall()
    for g in (*np.linspace(0, drift, 200), *([drift + back / 2, drift + back] if back else [])):
        spring.shear(g)
    assert spring.tangent == pytest.approx(tangent * 1e6, abs=1e-6)


def test_a_storey_fails_where_its_weight_overcomes_its_walls():
    storey = shear.Storey(1e4, HEIGHT, 3e5, 0.1, [wall()])
    times, drifts = shear.response([storey], np.full(400, 4.0), 0.01, 0.03)
    assert times[-1] < 3.9 and abs(drifts[-1, 0]) > shear.LIMIT


def test_loop_of_a_wall():
    """Third cycle: area between the lines of the law (theory, walls)."""
    k, strength, friction, a = 1e6, 5000.0, 500.0, 0.02
    spring = WallSpring(k, [(0.005, strength), (0.03, strength), (0.1, 0.0)], friction, 0.65, 1.0)
    there, back = np.linspace(a, -a, 4001)[1:], np.linspace(-a, a, 4001)[1:]
    path = np.concatenate([np.linspace(0, a, 2001), there, back, there, back])
    forces = np.array([spring.shear(g) for g in path])
    width, start = (strength + friction) / k, 0.65 * (a - (strength - friction) / k)
    half = width * (friction - strength) / 2 + friction * (start + a - width) + (a - start) * (friction + strength) / 2
    assert np.trapz(forces[-8001:], path[-8001:]) == pytest.approx(2 * half, rel=1e-5)


def test_published_cycles():
    """SAWS set of OpenSees' example, kN and mm; second cycles by OpenSees: energy and force at the amplitude."""
    f0, fi, du, s0, r1, r2, r4, alpha, beta = 8, 1.2, 15, 5, 0.058, -0.05, 0.02, 0.6, 1.1
    rise = du * np.linspace(0, 1, 1001)[1:]**2
    points = [(d, (f0 + r1 * s0 * d) * (1 - np.exp(-s0 * d / f0))) for d in rise]
    points.append((du - points[-1][1] / (r2 * s0), 0.0))
    spring = WallSpring(s0, points, fi, 0.0, beta, r4 * s0, (s0, f0 / s0, alpha))
    for amplitude, energy, force in ((10, 65.6, 9.606), (20, 114.1, 8.524), (40, 190.8, 5.200)):
        turns = np.linspace(0, 1, 1001), np.linspace(1, -1, 2001), np.linspace(-1, 0, 1001)
        path = amplitude * np.concatenate(turns)
        for drift in path:
            spring.shear(drift)
        forces = np.array([spring.shear(drift) for drift in path])
        assert forces[1000] == pytest.approx(force, abs=0.002)
        assert np.trapz(forces, path) == pytest.approx(energy, rel=5e-3)


# --- graded houses ----------------------------------------------------------------------------------------------------


def test_existing_wall_quantity_by_hand():
    """Storey 1, E-W: plywood in eight outer bays of 0.91 m and five inner ones. N-S: eight, four."""
    model, data = grades.build_house(grades.load_house(grades.HOUSE)), grades.changed_house(grades.HOUSE)
    found = {d: grades.existing_quantity(model, data["wall_types"], 1, d) for d in AXES}
    assert found == pytest.approx({"ew": 0.91 * 2.5 * 13, "ns": 0.91 * 2.5 * 12})


def test_factors_meet_the_required_quantity():
    """33 and 21 cm per m2 of 7.28 m x 6.37 m."""
    model, data = grades.build_house(grades.load_house(grades.HOUSE)), grades.changed_house(grades.HOUSE)
    factors = grades.factors(model, data["wall_types"], 1.25)
    assert factors[1, "ew"] == pytest.approx(1.25 * 0.33 * 7.28 * 6.37 / (0.91 * 2.5 * 13))
    assert factors[2, "ns"] == pytest.approx(1.25 * 0.21 * 7.28 * 6.37 / (0.91 * 2.5 * 12))


def test_wall_quantities_of_the_performance_labelling():
    """Published example: grade 3 with a light roof has 54 K1 and 22 K2; Rf = 0.9 gives 50.8 and 30.3 cm/m2."""
    assert grades.required_share(1.5, "label", 1.0) == pytest.approx([0.69, 0.411])
    assert np.array(grades.required_share(1.5, "label", 0.9)) == pytest.approx(
        [0.508 * 69 / 54, 0.303 * 30 / 22], rel=2e-3)
    assert grades.required_share(1.25, "law", 0.9) == pytest.approx([0.4125, 0.2625])


@pytest.mark.parametrize("level", graded.LEVELS)
def test_a_graded_house_has_its_walls(level, tmp_path):
    """All bays of tiled_house, each counted sheet with the factor, at every drift; finishes as they are."""
    plain = grades.build_house(grades.load_house(grades.HOUSE), wall_level=level)
    factors = grades.factors(plain, grades.changed_house(grades.HOUSE)["wall_types"], 1.5)
    model = grades.build_house(grades.load_house(grades.house_file(tmp_path, 1.5, level)))
    for (storey, direction), factor in factors.items():
        before, after = (wall_joints(m, storey, direction) for m in (plain, model))
        assert len(after) == len(before)
        for is_counted, ratio in ((True, factor), (False, 1.0)):
            old, new = ([j for j in joints if j.sheet.type.startswith("plywood") == is_counted]
                        for joints in (before, after))
            assert sum(j.kn for j in new) == pytest.approx(ratio * sum(j.kn for j in old))
            assert sum(j.strength for j in new) == pytest.approx(ratio * sum(j.strength for j in old))


@pytest.mark.parametrize("level", graded.LEVELS)
def test_springs_have_the_envelopes_of_their_walls(level):
    """Both halves of a wall at the same drift: twice the sum of the springs between the beams."""
    model = grades.build_house(grades.load_house(grades.HOUSE), wall_level=level)
    low, high = model.storey_levels["main"][1]
    springs = wall_springs(model, 1, "ew", high - low)
    for drift in (0.005, 0.02, 0.06):
        joints = wall_joints(model, 1, "ew")
        shears = [np.interp(drift * (high - low), *np.transpose([(0, 0), *j.envelope])) for j in joints]
        assert sum(spring.shear(drift) for spring in springs) == pytest.approx(2 * sum(shears), rel=1e-6)


def test_column_ends_by_hand():
    """One column of 0.1 m, two fittings of 1 MN/m and 5 kN, levers b of 0.09 m: 2 k b2 / h per rad, 2 F b / h."""
    fitting = {"kn": 1e6, "strength": 5e3, "friction_share": 0.15, "softening_stretch": 0.01, "ultimate_stretch": 0.04}
    data = {"joints": {"column_ends": {"number": 2, "type": "f"}}, "joint_types": {"f": fitting}}
    spring = column_ends(data, 1, 0.1, 2.5)
    assert spring.stiffness == pytest.approx(2 * 1e6 * 0.09**2 / 2.5)
    assert spring.forces.max() == pytest.approx(2 * 5e3 * 0.09 / 2.5)
    assert spring.drifts[2:] == pytest.approx([0.01 / 0.09, 0.04 / 0.09])
    data["joint_types"]["f"]["at"] = "centre"  # levers of 0.04 m, the whole fitting at either end
    spring = column_ends(data, 1, 0.1, 2.5)
    assert spring.stiffness == pytest.approx(2 * 2 * 1e6 * 0.04**2 / 2.5)
    assert spring.forces.max() == pytest.approx(2 * 2 * 5e3 * 0.04 / 2.5)


def test_peaks_count_until_a_storey_fails():
    drifts = np.array([[0.01, 0.0], [-0.05, 0.02], [0.2, 0.03], [0.5, 0.9]])
    peak, failed = graded.before_failure(drifts)
    assert peak.tolist() == [0.05, 0.02] and failed
    assert graded.before_failure(drifts[:2])[1] is False


def test_rows_of_single_changes(tmp_path):
    """Changes joined by +; a row without runs has empty drifts; finishes are scaled to the stated share of the rule."""
    given = SimpleNamespace(changes="finishes 2.1 + damping 2 %, no P-delta", grades="1.25", levels="mean")
    scaled, model_alone = changes.cases_of(given)
    assert scaled.has_runs and not model_alone.has_runs
    path = scaled.house_file(tmp_path, "law")
    assert changes.finish_ratio(path) == pytest.approx(2.1)
    assert changes.load_house(path).data["law"]["joint_damping"] == 0.02
    assert changes.median_drift([], "centre", "ew") == ""
    assert [storey.p_delta for storey in model_alone.storeys(path, "ew")] == [0.0, 0.0]


@pytest.mark.parametrize("name", ["column ends closed", "gypsum alone", "law slip", "symmetric walls"])
def test_each_change_is_a_house_and_storeys(name, tmp_path):
    """Readable by the house files, with two storeys of the lumped-mass model that have walls and column ends."""
    case = changes.Case((name,), 1.25, "mean")
    storeys = case.storeys(case.house_file(tmp_path, "law"), "ns")
    assert len(storeys) == 2 and all(storey.at_rest() > 0 and len(storey.springs) > 1 for storey in storeys)


@pytest.mark.parametrize("wrong", [{"changes": "siding + no such"}, {"grades": "2"}, {"levels": "low"}])
def test_unknown_rows_are_refused(wrong):
    with pytest.raises(RunError, match="known"):
        changes.cases_of(SimpleNamespace(**{"changes": "siding", "grades": "1", "levels": "mean"} | wrong))


# --- motion -----------------------------------------------------------------------------------------------------------


def test_the_synthetic_motion_has_the_spectra_of_the_record():
    """Mean within 10 %, every ordinate within 25 %: iterations scale neighbouring frequencies together."""
    motion = kobe_like.kobe_like(0)
    for name, target in kobe_like.TARGETS.items():
        ratio = kobe_like.spectrum(getattr(motion, name)) / np.array(target)
        assert abs(ratio.mean() - 1) < 0.1 and np.abs(ratio - 1).max() < 0.25
    np.testing.assert_array_equal(motion.acceleration, kobe_like.kobe_like(0).acceleration)

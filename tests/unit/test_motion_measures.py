# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures against closed forms, an independent integration, and published values of real records where available."""
import os
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from timber_houses import motion as gm
from timber_houses.motion.measures import jma_filter, lasting_level, oscillator


def one_component(values, dt, column=1):
    """Motion with `values` [m/s2] in one column (default NS)."""
    acceleration = np.zeros((len(values), 3))
    acceleration[:, column] = values
    return gm.GroundMotion(dt, acceleration)


def sine(amplitude, frequency, dt=0.01, duration=20.0):
    return one_component(amplitude * np.sin(2 * np.pi * frequency * np.arange(round(duration / dt)) * dt), dt)


# --- peaks --------------------------------------------------------------------------------------


def test_peaks_of_components_and_vectors():
    motion = gm.GroundMotion(0.01, np.array([[0.0, 0.0, 0.0], [-0.03, 0.04, 0.12], [0.0, 0.041, 0.0]]))
    assert motion.pga_gal == pytest.approx({"ns": 4.1, "ew": 3.0, "ud": 12.0})
    assert [gm.pga(motion, c) for c in ("h", "v3", "any")] == pytest.approx([5.0, 13.0, 12.0])
    with pytest.raises(gm.RecordError, match="component 'x'; admissible"):
        gm.pga(motion, "x")


def test_velocity_and_displacement_of_a_smooth_pulse():
    """d = D sin^4 over 4 s, at rest before and after. Trapezoids of 0.01 s err by (w dt)^2 / 12, about 2e-5."""
    dt, period, size = 0.01, 4.0, 0.3
    t = np.arange(round(20.0 / dt)) * dt - 8.0
    w = np.pi / period
    inside = (t > 0) & (t < period)
    s, c = np.sin(w * t), np.cos(w * t)
    acceleration = np.where(inside, size * 4 * w**2 * (3 * s**2 * c**2 - s**4), 0.0)
    motion = one_component(acceleration, dt)
    assert gm.pgd(motion, corner=None) == pytest.approx(100 * size, rel=1e-3)
    assert gm.pgv(motion, corner=None) == pytest.approx(100 * np.max(size * 4 * w * np.abs(s**3 * c)), rel=1e-3)


def test_fine_motions_have_displacements():
    """20 s at 1e-5 s, too many samples for the high-pass: as at 1e-3 s, with the same straight lines, to the error of
    the trapezoids there.
    """
    t = np.arange(20001) * 1e-3
    values = np.sin(2 * np.pi * t) * np.sin(np.pi * t / 20) ** 2
    fine = one_component(np.interp(np.arange(2000001) * 1e-5, t, values), 1e-5)
    found, expected = (gm.measures.displacement(motion).sum(axis=1) for motion in (fine, one_component(values, 1e-3)))
    assert len(found) == 2000001 and found[::100] == pytest.approx(expected, abs=1e-4 * np.abs(expected).max())


def test_motion_cut_within_its_shaking_does_not_drift():
    """A burst cut while it moves has a velocity at its first sample. The high-pass removes it, before that sample too.

    The last 20 s are at rest to 2.2 mm, as observed; integrated from the first sample instead, the displacement runs
    away by 1.8 m.
    """
    t = np.arange(6000) * 0.01 - 10.0
    burst = one_component(np.exp(-((t / 2.0) ** 2)) * np.cos(2 * np.pi * 1.0 * t + 0.5), 0.01)
    cut = gm.trim(burst, 10.0)
    assert np.abs(gm.displacement(cut, 0.1)[-2000:]).max() < 5e-3


def test_highpass_of_velocity_removes_an_offset():
    motion = sine(1.0, 1.0)
    shifted = gm.GroundMotion(motion.dt, motion.acceleration + [0.0, 0.02, 0.0])
    assert gm.pgv(shifted, corner=None) > 45.0
    assert gm.pgv(shifted, corner=0.2) == pytest.approx(gm.pgv(motion, corner=0.2), rel=0.1)


# --- JMA intensity ------------------------------------------------------------------------------


@pytest.mark.parametrize("frequency, period_effect, high_cut, low_cut", [
    # x = 0.05: 1 + 0.694 0.0025 + 0.241 6.25e-6 = 1.0017365;  1 - exp(-1) = 0.632121
    (0.5, 1.414214, 0.999133, 0.795060),
    # x = 0.1: 1 + 0.00694 + 0.0000241 + 5.6e-8 = 1.0069642;  1 - exp(-8) = 0.999665
    (1.0, 1.0, 0.996536, 0.999832),
    # x = 1: 1 + 0.694 + 0.241 + 0.0557 + 0.009664 + 0.00134 + 0.000155 = 2.001859
    (10.0, 0.316228, 0.706778, 1.0),
])
def test_jma_filter_by_hand(frequency, period_effect, high_cut, low_cut):
    """The three factors computed on paper to six digits, hence the tolerance."""
    assert float(jma_filter(frequency)) == pytest.approx(period_effect * high_cut * low_cut, rel=3e-6)


def test_jma_filter_stops_a_constant():
    assert float(jma_filter(0.0)) == 0.0


def test_jma_intensity_of_a_sine():
    """100 gal at 2 Hz in whole cycles for 30 s: above a0 for 0.3 s in all, so a0 = 100 gain cos(pi/2 0.3/30)."""
    motion = sine(1.0, 2.0, dt=0.001, duration=30.0)
    a0 = 100.0 * float(jma_filter(2.0)) * np.cos(0.5 * np.pi * 0.3 / 30.0)
    got = gm.jma_intensity(motion)
    assert got.a0 == pytest.approx(a0, rel=2e-5)  # straight lines 0.001 s long cut the crest by (w dt)^2 / 8
    assert got.raw == pytest.approx(2.0 * np.log10(a0) + 0.94, abs=1e-4)


@pytest.mark.parametrize("rate", [50, 100, 200])
@pytest.mark.parametrize("frequency, share", [(1.0, 0.7), (3.7, 0.3), (8.0, 0.4)])
def test_jma_intensity_at_any_sampling_rate(rate, frequency, share):
    """A whole number of beats of two frequencies that stay alone: the level by a scan at 20 kHz. By whole samples a
    level at 50 Hz is up to 5 % too high.
    """
    duration, second = 40.0, share * frequency
    time = np.arange(round(duration * rate)) / rate
    waves = [(1.0, round(frequency * duration) / duration), (0.6, round(second * duration) / duration)]
    motion = one_component(sum(a * np.sin(2 * np.pi * f * time + a) for a, f in waves), 1 / rate)
    fine = np.arange(round(duration * 20_000)) / 20_000
    filtered = sum(a * float(jma_filter(f)) * np.sin(2 * np.pi * f * fine + a) for a, f in waves)
    level = np.sort(np.abs(filtered))[-round(0.3 * 20_000)]
    assert gm.jma_intensity(motion).a0 * gm.GAL == pytest.approx(level, rel=5e-4)  # lines of 1/800 s: (w dt)^2/8


def test_jma_intensity_of_a_recorded_shape_at_half_and_twice_its_rate():
    """The default motion below 20 Hz, sampled with 50, 100 and 200 Hz: the same to 1e-3 of the scale's decimals."""
    motion = gm.default_motion()
    n = len(motion)
    spectrum = np.fft.rfft(motion.acceleration, axis=0)
    spectrum[np.fft.rfftfreq(n, motion.dt) > 20.0] = 0.0
    sampled = [gm.GroundMotion(n * motion.dt / m, m / n * np.fft.irfft(spectrum[:m // 2 + 1], m, axis=0))
               for m in (n // 2, n, 2 * n)]
    got = [gm.jma_intensity(each).raw for each in sampled]
    assert np.ptp(got) < 1e-4 and got[0] == pytest.approx(gm.jma_intensity(motion).raw, abs=2e-3)


def level_by_bisection(values, duration):
    """As `lasting_level`, by halving, with the time above a level summed line by line."""
    low, high = 0.0, max(values)
    for _ in range(60):
        level, total = (low + high) / 2, 0.0
        for one, other in zip(values, [*values[1:], values[0]]):
            least, most = min(one, other), max(one, other)
            total += 1.0 if least >= level else 0.0 if most < level else (most - level) / (most - least)
        low, high = (level, high) if total >= duration else (low, level)
    return low


@pytest.mark.parametrize("values", [[0, 1, 0, 3], [2, 2, 2, 1], [1, 1, 1], [5, 0, 5, 5, 1, 0, 2], [0, 0, 4, 4, 0]])
@pytest.mark.parametrize("duration", [0.3, 1.0, 1.5, 2.0, 3.0])
def test_level_that_lasts(values, duration):
    """Also along level stretches, and for the whole time."""
    assert lasting_level(np.array(values, float), duration) == pytest.approx(level_by_bisection(values, duration),
                                                                             abs=1e-12)


def test_jma_intensity_adds_components_as_a_vector_and_scales():
    base = sine(1.0, 2.0)
    three = gm.GroundMotion(base.dt, np.repeat(base.ns[:, None], 3, axis=1))
    assert gm.jma_intensity(three).a0 == pytest.approx(np.sqrt(3.0) * gm.jma_intensity(base).a0, rel=1e-12)
    assert gm.jma_intensity(gm.scaled(base, 10.0)).raw == pytest.approx(gm.jma_intensity(base).raw + 2.0, abs=1e-12)


def test_official_intensity_is_rounded_then_cut():
    base = sine(1.0, 2.0)
    for raw, official in ((5.044, 5.0), (5.096, 5.1), (5.094, 5.0), (6.73, 6.7)):
        assert gm.jma_intensity(gm.scaled_to_intensity(base, raw)).official == pytest.approx(official)


def test_intensity_of_nothing():
    assert gm.jma_intensity(one_component(np.zeros(100), 0.01)).raw == -np.inf
    with pytest.raises(gm.RecordError, match="needs 0.3 s"):
        gm.jma_intensity(one_component(np.ones(10), 0.01))


# --- response spectra ---------------------------------------------------------------------------


def rough_motion(n=600, seed=5):
    return np.random.Generator(np.random.PCG64(seed)).standard_normal(n)


@pytest.mark.parametrize("period, damping", [(0.07, 0.05), (0.4, 0.02), (2.5, 0.05), (8.0, 0.2)])
def test_oscillator_against_an_independent_integration(period, damping):
    """Runge-Kutta 8(5,3) to 1e-10, stopped at every sample (kinks of the forcing). The recursion is exact."""
    ground, dt, w = rough_motion(150), 0.01, 2 * np.pi / period
    state, displacements = np.zeros(2), [0.0]
    for left, right in zip(ground[:-1], ground[1:]):
        def rate(t, y, left=left, right=right):
            return [y[1], -2 * damping * w * y[1] - w * w * y[0] - (left + (right - left) * t / dt)]

        state = solve_ivp(rate, (0.0, dt), state, method="DOP853", rtol=1e-10, atol=1e-14).y[:, -1]
        displacements.append(state[0])
    got = oscillator(ground[:, None], dt, period, damping)[0][:, 0]
    np.testing.assert_allclose(got, displacements, atol=1e-9 * np.abs(displacements).max())


def test_spectrum_at_resonance_in_closed_form():
    """Ground A cos(w t) from rest, no damping: u = -A t sin(w t) / (2 w); after 10 cycles |u| peaks near 10 T.

    The straight lines between samples change the forcing by (w dt)^2 / 12 = 8e-4, which is the tolerance.
    """
    period, dt, size = 1.0, 1.0 / 64, 2.0
    t = np.arange(64 * 10 + 1) * dt
    got = oscillator((size * np.cos(2 * np.pi * t))[:, None], dt, period, 0.0)[0][:, 0]
    exact = -size * t * np.sin(2 * np.pi * t) / (4 * np.pi)
    np.testing.assert_allclose(got, exact, atol=1e-3 * np.abs(exact).max())


def test_spectrum_of_steady_vibration_in_closed_form():
    """100 cycles at T = 1 s: amplitude A / (w0^2 |1 - r^2 + 2 i z r|). Peaks are read 20 to a period: 1.3 % at most."""
    motion = sine(1.0, 1.0, duration=100.0)
    for period in (0.5, 1.0, 2.0):
        w0, r = 2 * np.pi / period, period
        amplitude = 100.0 / w0**2 / abs(1 - r**2 + 2j * 0.05 * r)
        late = oscillator(motion.ns[:, None], motion.dt, period)[0][7000:, 0]
        assert np.abs(late).max() * 100.0 == pytest.approx(amplitude, rel=3e-3)


def test_spectrum_limits_and_relations():
    """A stiff oscillator follows the ground; a soft one stays where it is; psv and sa are tied to sd."""
    motion = one_component(rough_motion(), 0.01)
    stiff = gm.response_spectrum(motion.ns, motion.dt, [0.001])
    assert stiff.sa[0] == pytest.approx(gm.pga(motion, "ns"), rel=0.03)
    at_rest_again = gm.default_motion()
    soft = gm.response_spectrum(at_rest_again.ns, at_rest_again.dt, [500.0])
    assert soft.sd[0] == pytest.approx(gm.pgd(at_rest_again, "ns", corner=None), rel=0.02)
    plain = gm.response_spectrum(motion.ns, motion.dt, [0.1, 0.5, 2.0], damping=0.0)
    w = 2 * np.pi / plain.periods
    np.testing.assert_allclose(plain.psv, w * plain.sd, rtol=1e-12)
    np.testing.assert_allclose(plain.sa, w * w * plain.sd, rtol=1e-9)


def test_resultant_does_not_depend_on_the_axes():
    a = np.column_stack([rough_motion(seed=1), rough_motion(seed=2)])
    turn = np.array([[0.6, 0.8], [-0.8, 0.6]])
    first, second = (gm.response_spectrum(x, 0.01, [0.3, 1.0]).sd for x in (a, a @ turn))
    np.testing.assert_allclose(first, second, rtol=1e-10)


def test_spectrum_refuses_nonsense():
    for periods, damping in (([0.0], 0.05), ([np.nan], 0.05), ([1.0], 1.0)):
        with pytest.raises(gm.RecordError):
            gm.response_spectrum(np.zeros(10), 0.01, periods, damping)


# --- energy and duration ------------------------------------------------------------------------


def test_arias_and_duration_of_a_sine():
    """Integral of A^2 sin^2 over whole cycles is A^2 D / 2; the energy of a steady motion grows evenly: 90 % of D."""
    motion = sine(2.0, 1.0, duration=10.0)
    assert gm.arias(motion)["ns"] == pytest.approx(np.pi / (2 * 9.80665) * 4.0 * 10.0 / 2, rel=1e-3)
    assert gm.arias(motion)["total"] == gm.arias(motion)["ns"]
    assert gm.significant_duration(motion) == pytest.approx(9.0, abs=0.3)  # within a fraction of a half cycle
    assert gm.significant_duration(one_component(np.zeros(10), 0.01)) == 0.0


# --- real records, where they are there ---------------------------------------------------------

RECORDS = os.environ.get("YADE_TIMBER_RECORDS")


@pytest.mark.skipif(not RECORDS, reason="YADE_TIMBER_RECORDS names no folder with real records")
def test_published_measures_of_kobe():
    """JMA Kobe 1995: intensity 6.4, NS Arias intensity 8.4 m/s, NS PGV about 91 cm/s."""
    kobe = gm.read_motion(Path(RECORDS) / "RSN1106_KOBE_KJM")
    assert gm.jma_intensity(kobe).raw == pytest.approx(6.415, abs=1e-3)  # of a reference program; sampled with 50 Hz
    assert gm.arias(kobe)["ns"] == pytest.approx(8.39, rel=0.01)
    assert gm.pgv(kobe, "ns") == pytest.approx(91.0, rel=0.02)

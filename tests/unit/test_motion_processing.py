# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Processing of a motion: closed forms, the original unchanged, a note in `source`."""
import numpy as np
import pytest
from timber_houses import motion as gm


def tone(dt=0.01, duration=20.0, frequency=2.0):
    """Three components of one smooth burst (Gaussian, centred) of `frequency` [Hz]: nothing at either end."""
    t = np.arange(round(duration / dt)) * dt - 0.5 * duration
    burst = np.exp(-((t / 2.0) ** 2)) * np.sin(2 * np.pi * frequency * t)
    return gm.GroundMotion(dt, np.outer(burst, [2.0, 1.0, 0.5]), "tone", "made here")


def test_polynomial_is_removed_exactly():
    motion = tone()
    t = motion.time
    bent = gm.GroundMotion(motion.dt, motion.acceleration + np.column_stack([0.1 + 0 * t, 0.01 * t, 1e-3 * t**2]))
    clean, expected = gm.remove_polynomial(bent, 2), gm.remove_polynomial(motion, 2)
    np.testing.assert_allclose(clean.acceleration, expected.acceleration, atol=1e-12)
    assert np.abs(gm.remove_polynomial(bent, 0).acceleration.mean(axis=0)).max() < 1e-14
    with pytest.raises(gm.RecordError, match="order -1"):
        gm.remove_polynomial(motion, -1)


def test_highpass_keeps_the_tone_and_drops_the_offset():
    motion = tone()
    shifted = gm.GroundMotion(motion.dt, motion.acceleration + 0.5)
    middle = slice(500, 1500)  # the step at either end of a constant rings for about a corner period
    np.testing.assert_allclose(gm.highpass(shifted, 0.5).acceleration[middle], motion.acceleration[middle], atol=0.02)
    with pytest.raises(gm.RecordError, match="between 0 and 50 Hz"):
        gm.highpass(motion, 60.0)


def test_trim_and_quiet_ends():
    motion = tone()
    first, last = gm.shaking_window(motion, 0.5)
    assert 4.0 < first < 10.0 < last < 16.0
    cut = gm.trim(motion, first, last)
    assert cut.duration == pytest.approx(last - first + motion.dt)
    assert np.array_equal(cut.acceleration[0], motion.acceleration[round(first / motion.dt)])
    assert np.abs(motion.acceleration[: round(first / motion.dt)]).max() <= 0.5 * gm.GAL
    with pytest.raises(gm.RecordError, match="nothing between"):
        gm.trim(motion, 50.0, 60.0)
    with pytest.raises(gm.RecordError, match="nothing above 1000"):
        gm.shaking_window(motion, 1000.0)


def test_turned():
    """North shakes along +x after 90 degrees; 360 degrees change nothing; lengths are preserved."""
    motion = tone()
    quarter = gm.turned(motion, 90.0)
    assert np.array_equal(quarter.ew, motion.ns)
    assert np.array_equal(quarter.ns, -motion.ew)
    assert np.array_equal(quarter.ud, motion.ud)
    assert np.array_equal(gm.turned(motion, 360.0).acceleration, motion.acceleration)
    assert gm.turned(motion, 0.0) is motion
    assert gm.pga(gm.turned(motion, 33.0), "h") == pytest.approx(gm.pga(motion, "h"))


def test_scaling():
    motion = tone()
    assert gm.pga(gm.scaled_to_pga(motion, 400.0, "level"), "ew") == pytest.approx(400.0)
    assert gm.pga(gm.scaled_to_pga(motion, 500.0), "h") == pytest.approx(500.0)
    assert gm.pga(gm.scaled_to_pga(motion, 300.0, "ud"), "ud") == pytest.approx(300.0)
    assert gm.jma_intensity(gm.scaled_to_intensity(motion, 6.1)).raw == pytest.approx(6.1, abs=1e-12)
    assert gm.scaled(motion, 1.0).source == motion.source
    for wrong in (lambda: gm.scaled(motion, np.inf), lambda: gm.scaled_to_pga(motion, 0.0)):
        with pytest.raises(gm.RecordError):
            wrong()


@pytest.mark.parametrize("dt", [0.005, 0.003, 0.001])
def test_bandlimited_upsampling_is_the_same_motion(dt):
    """A burst far below the Nyquist frequency: the finer samples are those of the burst itself."""
    fine, error = gm.resample(tone(), dt)
    t = fine.time - 10.0
    exact = 2.0 * np.exp(-((t / 2.0) ** 2)) * np.sin(4 * np.pi * t)
    np.testing.assert_allclose(fine.ew, exact, atol=1e-9)
    assert error == 0.0 and fine.dt == dt and "resampled" in fine.source


def test_linear_resampling_reports_its_error():
    """Straight lines miss a sine of angular frequency w by (w dt)^2 / 8 of its size."""
    fine, error = gm.resample(tone(), 0.001, "linear")
    assert error == pytest.approx((4 * np.pi * 0.01) ** 2 / 8, rel=0.05)
    t = fine.time - 10.0
    exact = 2.0 * np.exp(-((t / 2.0) ** 2)) * np.sin(4 * np.pi * t)
    assert np.abs(fine.ew - exact).max() / 2.0 == pytest.approx(error, rel=0.05)


def test_interpolation_error_is_that_of_any_finer_step():
    for frequency in (2.0, 8.0):
        motion = tone(frequency=frequency)
        assert gm.interpolation_error(motion) == pytest.approx(gm.resample(motion, 0.001, "linear")[1], rel=1e-9)


def test_downsampling_reports_what_it_loses():
    kept, small = gm.resample(tone(frequency=2.0), 0.02)
    lost, large = gm.resample(tone(frequency=40.0), 0.02)
    assert small < 1e-9 and len(kept) == 1000
    assert large > 0.9 and np.abs(lost.acceleration).max() < 1e-6


def test_resample_refuses_nonsense():
    for dt, method in ((0.0, "linear"), (np.nan, "linear"), (0.005, "cubic"), (0.01 / np.pi, "bandlimited")):
        with pytest.raises(gm.RecordError):
            gm.resample(tone(), dt, method)


def test_changes_leave_the_original_alone():
    motion = tone()
    before = motion.acceleration.copy()
    gm.scaled(motion, 3.0), gm.trim(motion, 1.0, 2.0), gm.highpass(motion, 0.1), gm.remove_polynomial(motion, 1)
    assert np.array_equal(motion.acceleration, before)
    with pytest.raises(ValueError):
        motion.acceleration[0, 0] = 1.0

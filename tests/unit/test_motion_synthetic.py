# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""The synthetic Ojiya-like motion: targets for every seed used, timing, rest at the end, the shipped file."""
import subprocess
import sys
from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
from timber_houses import motion as gm
from timber_houses.motion.synthetic import DEFAULT_SEED

ROOT = Path(__file__).resolve().parents[2]
SEEDS = [0, 1, *(pytest.param(seed, marks=pytest.mark.rare) for seed in range(2, 7))]
PEAKS = {
    "PGA NS": (1147.0, lambda m: gm.pga(m, "ns")),
    "PGA EW": (1308.0, lambda m: gm.pga(m, "ew")),
    "PGA UD": (820.0, lambda m: gm.pga(m, "ud")),
    "vector PGA": (1501.0, lambda m: gm.pga(m, "h")),
    "vector PGV": (133.0, lambda m: gm.pgv(m, "h")),
    "vector PGV without high-pass": (133.0, lambda m: gm.pgv(m, "h", corner=None)),
}

made = lru_cache(gm.synthetic_motion)


@pytest.mark.parametrize("seed", SEEDS)
def test_targets_are_met_for_every_seed(seed):
    """The published values within 5 % (intensity within 0.05), the spectrum above 500 cm/s all over 0.6-0.7 s."""
    motion = made(seed)
    for name, (target, measure) in PEAKS.items():
        assert measure(motion) == pytest.approx(target, rel=0.05), name
    assert gm.jma_intensity(motion).raw == pytest.approx(6.73, abs=0.05)
    periods = np.linspace(0.6, 0.7, 21)
    for ground in (motion.ew, motion.acceleration[:, :2]):
        assert gm.response_spectrum(ground, motion.dt, periods).psv.min() > 500.0


@pytest.mark.parametrize("seed", SEEDS)
def test_timing(seed):
    """15 s of quiet, then first shaking, strong shaking from about 18 s, its end by 35-40 s."""
    motion = made(seed)
    assert (motion.dt, motion.duration) == (0.01, 40.0)
    assert not motion.acceleration[: round(15.0 / motion.dt)].any()
    assert 15.0 < gm.shaking_window(motion, 0.5)[0] < 15.5
    strong = motion.time[np.linalg.norm(motion.acceleration[:, :2], axis=1) > 200.0 * gm.GAL]
    assert 17.5 < strong[0] < 18.7 and 24.0 < strong[-1] < 30.0
    assert gm.shaking_window(motion, 20.0)[1] < 37.0


@pytest.mark.parametrize("seed", SEEDS)
def test_ends_at_rest_without_drift(seed):
    """Final velocity below 0.01 cm/s and displacement below 0.1 cm; the largest displacement is some decimetres."""
    motion = made(seed)
    assert np.abs(gm.velocity(motion, corner=None)[-1]).max() < 1e-4
    assert np.abs(gm.displacement(motion, corner=None)[-1]).max() < 1e-3
    assert 15.0 < gm.pgd(motion, "h", corner=None) < 60.0


@pytest.mark.parametrize("seed", SEEDS)
def test_spectrum_is_broad(seed):
    """Not a sine: energy at short and at long periods, in both directions, and components that differ."""
    motion = made(seed)
    for ground in (motion.ew, motion.ns):
        assert gm.response_spectrum(ground, motion.dt, [0.1, 0.2, 0.3]).sa.min() > 1147.0
        assert gm.response_spectrum(ground, motion.dt, [1.0, 1.5, 2.0]).psv.min() > 40.0
    strong = motion.acceleration[1800:2600]
    assert np.abs(np.corrcoef(strong.T)[np.triu_indices(3, 1)]).max() < 0.7


def test_same_seed_same_motion_other_seed_other_motion():
    again = gm.synthetic_motion(3)
    assert np.array_equal(again.acceleration, made(3).acceleration)
    assert not np.array_equal(again.acceleration, made(4).acceleration)


@pytest.mark.parametrize("seed", [-1, 1.5, "a"])
def test_seed_must_be_a_whole_number(seed):
    with pytest.raises(gm.RecordError, match="whole number >= 0"):
        gm.synthetic_motion(seed)


def test_shipped_file_is_the_generator_s_output():
    """Equal to the 0.005 gal of the file's rounding; the margin is for the last bits of another numpy."""
    shipped = gm.default_motion()
    np.testing.assert_allclose(shipped.acceleration / gm.GAL, made(DEFAULT_SEED).acceleration / gm.GAL, atol=0.0051)
    head = gm.DEFAULT_RECORD.read_text(encoding="utf-8")[:800]
    assert f"# seed: {DEFAULT_SEED}\n" in head and "not a record" in head


def test_script_makes_the_shipped_file_again(tmp_path):
    out = tmp_path / "again.csv"
    script = ROOT / "scripts" / "paper" / "make_ground_motion.py"
    done = subprocess.run([sys.executable, script, "--out", out], capture_output=True, text=True, check=True)
    assert "JMA intensity" in done.stdout
    assert out.read_text(encoding="utf-8") == gm.DEFAULT_RECORD.read_text(encoding="utf-8")


def test_show_record_prints_and_plots(tmp_path):
    script = ROOT / "scripts" / "show" / "show_record.py"
    done = subprocess.run([sys.executable, script, "--out", tmp_path / "a.png"], capture_output=True, text=True,
                          check=True)
    for word in ("PGA", "PGV", "PGD", "Arias", "JMA intensity         6.7", "D5-95"):
        assert word in done.stdout
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("arguments", [["nothing"], ["--out", "/nowhere/a.png"], ["--scale", "nan"]])
def test_show_record_fails_in_one_line(tmp_path, arguments):
    script = ROOT / "scripts" / "show" / "show_record.py"
    done = subprocess.run([sys.executable, script, *arguments], capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 1 and done.stderr.startswith("error: ") and done.stderr.count("\n") == 1

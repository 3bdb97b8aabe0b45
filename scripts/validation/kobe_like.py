#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Synthetic motion with the response spectra of the record JMA Kobe 1995. It may be passed on; the record may not.

    scripts/validation/kobe_like.py [--seed N] [--out FILE.csv]

White noise under an envelope whose length is that of the record's strong part. Its Fourier amplitudes are scaled until
the 5 % response spectra of the three components meet TARGETS. The phases are random: the record's velocity pulses,
which drive a yielding house farther than the spectrum shows, are not in it.
Prints the spectra, peaks and the intensity of the motion.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "py"))

from timber_houses.motion import GroundMotion, measures, write_csv
from timber_houses.study.options import Parser, run_script, seed

DT, DURATION = 0.01, 20.0
"""[s]"""
RISE, STRONG, DECAY = 1.0, 4.0, 4.0
"""Envelope: quadratic rise, constant part, exponential decay; 5 to 95 % of the energy take 9.5 s (record: 9.3). [s]"""
PERIODS = np.array([0.05, 0.1, 0.117, 0.138, 0.162, 0.19, 0.223, 0.262, 0.307, 0.361, 0.424, 0.497, 0.584, 0.685, 0.804,
                    0.944, 1.109, 1.302, 1.528, 1.794, 2.106, 2.472, 2.902, 3.407, 4.0])
"""[s]"""
TARGETS = {
    "ew": (623, 736, 879, 813, 774, 838, 1120, 859, 1180, 2050, 1780, 1060, 1400, 1980, 1990, 1440, 850, 483, 280, 310,
           207, 172, 164, 132, 88.8),
    "ns": (832, 913, 834, 1070, 1040, 997, 1070, 1780, 1940, 2560, 2240, 2130, 1470, 2070, 1860, 1670, 1170, 915, 759,
           519, 318, 234, 180, 113, 81.3),
    "ud": (353, 584, 828, 831, 791, 940, 1190, 1120, 842, 614, 722, 642, 580, 599, 712, 583, 516, 492, 437, 290, 193,
           134, 89.9, 61.5, 39.5),
}
"""Largest absolute acceleration with 5 % damping at PERIODS [gal], of the record (PEER NGA RSN1106)."""
ITERATIONS = 12


def envelope(times):
    """0 to 1."""
    return np.where(times < RISE, (times / RISE) ** 2, np.exp(-np.maximum(0.0, times - RISE - STRONG) / DECAY))


def spectrum(acceleration):
    """Largest absolute acceleration with 5 % damping at PERIODS. [gal]"""
    return measures.response_spectrum(acceleration, DT, PERIODS).sa


def matched(noise, target):
    """Acceleration [m/s2] whose spectrum is near the target [gal]."""
    acceleration = noise
    frequency = np.fft.rfftfreq(len(noise), DT)
    for _ in range(ITERATIONS):
        ratios = target / spectrum(acceleration)
        factors = np.interp(np.log(np.maximum(frequency, 1e-3)), -np.log(PERIODS[::-1]), ratios[::-1])
        factors[frequency < 1 / PERIODS[-1] / 2] = 0.0  # below the spectrum: no drift of the ground
        acceleration = np.fft.irfft(np.fft.rfft(acceleration) * factors, len(noise))
    return acceleration


def kobe_like(number=0):
    """GroundMotion of a seed."""
    random = np.random.Generator(np.random.PCG64(number))
    times = np.arange(0.0, DURATION, DT)
    noise = envelope(times)[:, None] * random.standard_normal((len(times), 3))
    columns = [matched(noise[:, k], np.array(TARGETS[name], float)) for k, name in enumerate(("ew", "ns", "ud"))]
    source = f"synthetic, spectra of JMA Kobe 1995, seed {number}"
    return GroundMotion(acceleration=np.column_stack(columns), dt=DT, source=source)


def description(motion):
    """Lines about the motion: peaks, intensity, largest misfit of the spectra."""
    yield "Synthetic ground motion, not a record. Made by yade-timber, scripts/validation/kobe_like.py"
    yield motion.source
    for name in TARGETS:
        misfit = spectrum(getattr(motion, name)) / np.array(TARGETS[name]) - 1
        range_ = f"{1 + misfit.min():.2f} to {1 + misfit.max():.2f}"
        yield f"{name}: PGA {measures.pga(motion, name):.0f} gal; spectrum over target {range_}"
    yield f"horizontal PGV {measures.pgv(motion):.0f} cm/s; JMA intensity {measures.jma_intensity(motion).raw:.2f}"
    yield f"5 to 95 % of the energy in {measures.significant_duration(motion):.1f} s (record: 105 cm/s, 6.44, 9.3 s)"


def main():
    options = Parser(__doc__)
    options.add_argument("--seed", type=seed, default=0, help="whole number >= 0 (default %(default)s)")
    options.add_argument("--out", type=Path, default=Path("kobe_like.csv"), help="CSV file (default %(default)s)")
    given = options.parse_args()
    motion = kobe_like(given.seed)
    lines = list(description(motion))
    write_csv(motion, given.out, lines)
    print(*lines, f"written: {given.out}", sep="\n")


if __name__ == "__main__":
    run_script(main)

#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Measure a strong-motion record and plot its motion and its 5 % response spectra.

    scripts/show_record.py [--record FILE_OR_PREFIX] [--azimuth 30] [--start 10] [--pga 400] [--out FILE.png]

The options are those of the run scripts: what is shown is what would shake the house. Without a record: the synthetic
motion that the package ships. Needs no YADE.
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "py"))

import numpy as np  # noqa: E402

from yade_timber import motion as gm  # noqa: E402

PERIODS = np.geomspace(0.05, 10.0, 120)
COLUMNS = ("ew", "ns", "ud")
QUIET = 0.01
"""Before and after the first and last acceleration of this part of the PGA, motion is not plotted."""


def print_measures(motion, corner):
    """One line per measure; peaks for each component and for the horizontal vector."""
    print(f"{motion.name}: {motion.source}")
    begins = f", from {motion.begins:%Y-%m-%d %H:%M:%S}" if motion.begins else ""
    print(f"{len(motion)} samples every {motion.dt:g} s, {motion.duration:g} s{begins}")
    print(f"{'':22}{'NS':>10}{'EW':>10}{'UD':>10}{'horizontal vector':>20}")
    for label, measure in (("PGA [gal]", gm.pga), ("PGV [cm/s]", gm.pgv), ("PGD [cm]", gm.pgd)):
        extra = {} if measure is gm.pga else {"corner": corner}
        row = [measure(motion, component, **extra) for component in ("ns", "ew", "ud", "h")]
        print(f"{label:22}{row[0]:10.2f}{row[1]:10.2f}{row[2]:10.2f}{row[3]:20.2f}")
    arias = gm.arias(motion)
    each = "".join(f"{arias[component]:10.3f}" for component in ("ns", "ew", "ud"))
    print(f"{'Arias intensity [m/s]':22}{each}{arias['total']:14.3f} (sum)")
    intensity = gm.jma_intensity(motion)
    print(f"JMA intensity         {intensity.official:.1f} ({intensity.raw:.3f}; a0 = {intensity.a0:.1f} gal)")
    print(f"Duration D5-95 [s]    {gm.significant_duration(motion):.2f}")
    print(f"Straight lines between the samples miss at most {100 * gm.interpolation_error(motion):.2g} % of the PGA (--resample: nothing)")
    print(f"PGV and PGD after a zero-phase high-pass at {corner:g} Hz" if corner else "PGV and PGD without high-pass")


def plot(motion, corner, path):
    """Accelerations, velocities and spectra -> PNG."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(3, 2, figsize=(13, 8), constrained_layout=True)
    velocity = gm.velocity(motion, corner) * 100.0
    for row, k in enumerate((1, 0, 2)):
        axes[row, 0].plot(motion.time, motion.acceleration[:, k] / gm.GAL, lw=0.5)
        axes[row, 0].set_ylabel(f"{COLUMNS[k].upper()} [gal]")
        axes[0, 1].plot(motion.time, velocity[:, k], lw=0.7, label=COLUMNS[k].upper())
        spectrum = gm.response_spectrum(motion.acceleration[:, k], motion.dt, PERIODS)
        axes[1, 1].loglog(PERIODS, np.maximum(spectrum.sa, 1e-6), label=COLUMNS[k].upper())
        axes[2, 1].loglog(PERIODS, np.maximum(spectrum.psv, 1e-6), label=COLUMNS[k].upper())
    first, last = gm.shaking_window(motion, QUIET * gm.pga(motion))
    finish(axes, motion.name, (max(0.0, first - 2.0), min(motion.duration, last + 2.0)))
    figure.savefig(path, dpi=110)


def finish(axes, name, span):
    """Titles, labels and grids."""
    axes[0, 0].set_title(name)
    axes[0, 1].set_ylabel("velocity [cm/s]")
    for axis in (*axes[:, 0], axes[0, 1]):
        axis.set(xlabel="time [s]", xlim=span)
        axis.grid(alpha=0.3)
    for axis, label in ((axes[1, 1], "5 % Sa [gal]"), (axes[2, 1], "5 % pSv [cm/s]")):
        axis.set(xlabel="period [s]", ylabel=label)
        axis.grid(which="both", alpha=0.3)
    axes[0, 1].legend()


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("positional", nargs="?", metavar="RECORD", help="the same as --record")
    gm.add_motion_options(parser)
    parser.add_argument("--dt", type=float, default=1e-4, help="time step of a run [s], for --resample (default %(default)g)")
    parser.add_argument("--corner", type=float, default=0.05, help="high-pass before PGV and PGD are taken [Hz] (default %(default)g); 0: none")
    parser.add_argument("--out", type=Path, help="PNG file (default: NAME.png in this folder)")
    options = parser.parse_args()
    options.record = options.record or options.positional
    return options


def main():
    options = arguments()
    corner = options.corner or None
    try:
        request = gm.motion_request(options)
        motion = gm.scaled(request.motion(options.dt), 1.0 if request.scale is None else request.scale)
        print_measures(motion, corner)
        out = options.out or Path(f"{motion.name}.png")
        plot(motion, corner, out)
    except gm.RecordError as error:
        sys.exit(f"error: {error}")
    except OSError as error:
        sys.exit(f"error: {error.filename}: cannot be written ({error.strerror})")
    print(f"written: {out}")


if __name__ == "__main__":
    main()

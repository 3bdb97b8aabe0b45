#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Measure a strong-motion record and plot its motion and its 5 % response spectra, as PNG and PDF.

    scripts/show/show_record.py [--record FILE_OR_PREFIX] [--azimuth 30] [--start 10] [--pga 400] [--out FILE.png]

The options are those of the run scripts: what is shown is what would shake the house. Without a record: the synthetic
motion that the package ships. Needs no YADE.
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "py"))

from yade_timber import motion as gm  # noqa: E402
from yade_timber.pictures import motion_sheet as record_plot  # noqa: E402
from yade_timber.pictures import sheets  # noqa: E402


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


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("positional", nargs="?", metavar="RECORD", help="the same as --record")
    gm.add_motion_options(parser)
    parser.add_argument("--dt", type=float, default=2.5e-4, help="time step of a run [s], for --resample (default %(default)g)")
    parser.add_argument("--corner", type=float, default=0.05, help="high-pass before PGV and PGD are taken [Hz] (default %(default)g); 0: none")
    parser.add_argument("--out", type=Path, help="picture to write, as .png and .pdf (default: NAME.png in this folder)")
    options = parser.parse_args()
    if options.record and options.positional:
        parser.error("RECORD and --record are the same: give one")
    options.record = options.record or options.positional
    return options


def main():
    options = arguments()
    corner = options.corner or None
    try:
        request = gm.motion_request(options)
        motion = gm.scaled(request.motion(options.dt), 1.0 if request.scale is None else request.scale)
        print_measures(motion, corner)
        out = sheets.stem_of(options.out) if options.out else Path(motion.name)
        written = record_plot.write(out, motion, corner)
    except gm.RecordError as error:
        sys.exit(f"error: {error}")
    except OSError as error:
        sys.exit(f"error: {error.filename}: cannot be written ({error.strerror})")
    print("written: " + ", ".join(map(str, written)))


if __name__ == "__main__":
    main()

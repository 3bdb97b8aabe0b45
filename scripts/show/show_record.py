#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Print the measures of a strong-motion record and plot it with its 5 % response spectra, as PNG and PDF.

    scripts/show/show_record.py [--record FILE_OR_PREFIX] [--azimuth 30] [--start 10] [--pga 400] [--out FILE.png]

Takes the options of the run scripts and shows the motion that they would apply; without a record the synthetic motion
of the package. Needs no YADE.
"""

import sys

from show_common import Parser, errors_in_a_line, file_name, path

from timber_houses.base.notes import noted
from timber_houses.base.time_step import DEFAULT_DT
from timber_houses.motion import (RecordError, add_motion_options, arias, interpolation_error, jma_intensity,
                                motion_request, pga, pgd, pgv, scaled, significant_duration, with_then)
from timber_houses.motion.measures import stated_intensity
from timber_houses.pictures import motion_sheet


def print_measures(motion, corner, dt):
    """Print one line per measure, with the peaks of each component and of the horizontal vector. dt: of a run [s]"""
    print(f"{motion.name}: {motion.source}")
    begins = f", from {motion.begins:%Y-%m-%d %H:%M:%S}" if motion.begins else ""
    print(f"{len(motion)} samples every {motion.dt:g} s, {motion.duration:g} s{begins}")
    print(f"{'':22}{'NS':>10}{'EW':>10}{'UD':>10}{'horizontal vector':>20}")
    for label, measure in (("PGA [gal]", pga), ("PGV [cm/s]", pgv), ("PGD [cm]", pgd)):
        extra = {} if measure is pga else {"corner": corner}
        row = [measure(motion, component, **extra) for component in ("ns", "ew", "ud", "h")]
        print(f"{label:22}{row[0]:10.2f}{row[1]:10.2f}{row[2]:10.2f}{row[3]:20.2f}")
    intensities = arias(motion)
    each = "".join(f"{intensities[component]:10.3f}" for component in ("ns", "ew", "ud"))
    print(f"{'Arias intensity [m/s]':22}{each}{intensities['total']:14.3f} (sum)")
    if stated_intensity(motion) is None:
        print("JMA intensity         none (needs 0.3 s of shaking)")
    else:
        intensity = jma_intensity(motion)
        print(f"JMA intensity         {intensity.official:.1f} ({intensity.raw:.3f}; a0 = {intensity.a0:.1f} gal)")
    print(f"Duration D5-95 [s]    {significant_duration(motion):.2f}")
    error = interpolation_error(motion, dt)
    hint = " (--resample: none)" if error else ""
    print(f"Linear interpolation between samples errs by at most {100 * error:.2g} % of the PGA{hint}")
    print(f"PGV and PGD after a zero-phase high-pass at {corner:g} Hz" if corner else "PGV and PGD without high-pass")


def arguments():
    parser = Parser(description=__doc__.splitlines()[0])
    parser.add_argument("positional", nargs="?", metavar="RECORD", help="same as --record")
    add_motion_options(parser)
    parser.add_argument("--dt", type=float, default=DEFAULT_DT,
                        help="time step of a run, for --resample [s] (default %(default)g)")
    parser.add_argument("--corner", type=float, default=0.05,
                        help="high-pass before PGV and PGD [Hz] (default %(default)g); 0: none")
    parser.add_argument("--out", type=path, help="picture to write, .png or .pdf (default: NAME.png in this folder)")
    options = parser.parse_args(with_then(sys.argv[1:]))
    if options.record and options.positional:
        parser.error("RECORD and --record name the same option: give one")
    options.record = options.record or options.positional
    return options


def main():
    options = arguments()
    corner = options.corner or None
    with errors_in_a_line(options.out or "the picture"):
        request = motion_request(options)
        with noted():
            motion = scaled(request.motion(options.dt), request.factor)
        if not motion.acceleration.any():
            raise RecordError(f"{motion.name}: no acceleration; nothing to show")
        print_measures(motion, corner, options.dt)
        written = motion_sheet.write(options.out or file_name(motion.name), motion, corner)
    print("written: " + ", ".join(map(str, written)))


if __name__ == "__main__":
    main()

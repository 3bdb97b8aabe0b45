#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Generate the shipped synthetic ground motion from its seed, or one of another seed.

    scripts/paper/make_ground_motion.py [--seed N] [--out FILE.csv]

Prints the published targets and the values of the motion. Needs no YADE.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "py"))

from timber_houses.motion import DEFAULT_RECORD, synthetic_motion, write_csv
from timber_houses.motion.synthetic import DEFAULT_SEED, GENERATOR_VERSION, TARGETS, achieved
from timber_houses.study.options import Parser, run_script, seed

LABELS = {"pga_ns": "PGA NS [gal]", "pga_ew": "PGA EW [gal]", "pga_ud": "PGA UD [gal]",
          "pga_h": "PGA horizontal vector [gal]", "pgv_h": "PGV horizontal vector [cm/s]", "jma": "JMA intensity",
          "psv_ew": "5 % pSv of EW at 0.6-0.7 s, smallest [cm/s]"}


def provenance(seed, got):
    """Header lines of the data file."""
    yield "Synthetic ground motion, not a record. Made by yade-timber, scripts/paper/make_ground_motion.py"
    yield f"seed: {seed}"
    yield f"generator version: {GENERATOR_VERSION}"
    yield "Modelled on what is published of K-NET NIG019 Ojiya, 2004-10-23 17:56 (target, got):"
    for key, label in LABELS.items():
        yield f"  {label}  {target_text(key)}  {got[key]:.2f}"


def target_text(key):
    return f"{'> ' if key == 'psv_ew' else ''}{TARGETS[key]:g}"


def main():
    parser = Parser(__doc__)
    parser.add_argument("--seed", type=seed, default=DEFAULT_SEED,
                        help="whole number >= 0 (default %(default)s, the shipped motion)")
    parser.add_argument("--out", type=Path,
                        help="CSV file (default: the shipped file for the default seed, else ojiya_like_N.csv)")
    options = parser.parse_args()
    out = options.out or (DEFAULT_RECORD if options.seed == DEFAULT_SEED else Path(f"ojiya_like_{options.seed}.csv"))
    motion = synthetic_motion(options.seed)
    got = achieved(motion)
    write_csv(motion, out, provenance(options.seed, got))
    print(f"{'':46}{'target':>10}{'got':>10}")
    for key, label in LABELS.items():
        print(f"{label:46}{target_text(key):>10}{got[key]:10.2f}")
    print(f"written: {out}")


if __name__ == "__main__":
    run_script(main)

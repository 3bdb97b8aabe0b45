#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Screening of the choices that the paper leaves open: 32 sets of houses, each under several motions.

    research/screening.py [-j 2] [--out results/screening] [--seeds 3,0,1,2] [--record PREFIX] [--cells 0-15]
    [--collect]

A two-level fractional factorial of resolution IV varies twelve choices (timber_research/factors.py) at once. Each cell
has eleven runs under each motion, and three with snow alone; runs end at a collapse. Cells are run one after the other;
the first 16 are a design of resolution III. Writes screening.csv (cells), effects.csv, screening.md and screening.png.
It can be stopped; the same command continues.
"""
import argparse

from timber_research import design
from timber_research.screening import cells, picture, report
from timber_research.screening.collect import collect
from timber_houses.study.batch import run_rows, write_runs
from timber_houses.study.options import (Parser, add_driver_options, list_of, non_negative, positive, record,
                                         run_script, seed)


def arguments():
    parser = Parser(__doc__)
    add_driver_options(parser, "results/screening")
    parser.add_argument("--seeds", type=list_of(seed), default=[3, 0, 1, 2], metavar="N,N",
                        help="synthetic motions (default 3,0,1,2)")
    parser.add_argument(
        "--record",
        type=record,
        action="append",
        default=[],
        metavar="FILE_OR_PREFIX",
        help=(
            f"a recorded motion besides, {cells.LENGTH:g} s from {cells.LEAD:g} s before its strong shaking; may be"
            " repeated"
        ),
    )
    parser.add_argument("--start", type=non_negative, default=15.0, metavar="S",
                        help="start of the part of synthetic motions [s] (default %(default)g)")
    parser.add_argument("--end", type=positive, default=29.0, metavar="S",
                        help="end of that part [s] (default %(default)g)")
    parser.add_argument("--dt", type=positive, default=4e-4, metavar="S", help="time step [s] (default %(default)g)")
    parser.add_argument("--cells", type=numbers, default=range(design.RUNS), metavar="0-7,9",
                        help=f"cells to run (default 0-{design.RUNS - 1}); all that are done are analysed")
    parser.add_argument("--collect", action="store_true", help="run nothing; analyse the results there are")
    return parser.parse_args()


def numbers(text):
    """Numbers of cells from '0-7,9'."""
    try:
        ends = [[int(end) for end in part.split("-")] for part in text.split(",")]
        found = sorted({k for part in ends for k in range(part[0], part[-1] + 1)})
    except ValueError:
        found = []
    if not found or not 0 <= found[0] <= found[-1] < design.RUNS:
        raise argparse.ArgumentTypeError(f"'{text[:40]}': cells are numbers from 0 to {design.RUNS - 1}, like 0-7,9")
    return found


def main():
    options = arguments()
    motions = [cells.synthetic(n, options.start, options.end) for n in options.seeds] + [
        cells.recorded(one) for one in options.record
    ]
    planned = cells.plan(motions, options.dt)
    cells.write_houses(planned, options.out)
    rows = [entry.row(options.out) for entry in planned]
    chosen = [entry.cell in options.cells for entry in planned]
    try:
        if not options.collect:
            run_rows([row for row, is_chosen in zip(rows, chosen) if is_chosen], options.out, options.jobs)
    finally:
        write_runs(rows, options.out)
        summaries = [row.task(options.out).summary for row in rows]
        results = collect(planned, summaries)
        for path in [*report.write(results, options.out), picture.draw(results, options.out / "screening.png")]:
            print(f"written: {path}")
    return int(any(is_chosen and summary is None for is_chosen, summary in zip(chosen, summaries)))


if __name__ == "__main__":
    run_script(main)

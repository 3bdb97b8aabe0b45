# SPDX-License-Identifier: GPL-2.0-or-later
"""What the studies share: their options, their table of runs, one CSV. A study can be stopped; the same command goes on."""

import argparse
import csv
import io
import os
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parents[1] / "py"))  # after the installed package, which the runs are made of

import matplotlib  # noqa: E402

matplotlib.use("Agg")

from yade_timber.study.batch import BatchError, run_table  # noqa: E402
from yade_timber.base.atomic_write import write_text, written_whole  # noqa: E402
from yade_timber.base.colors import BLUE, GREEN, GREY, ORANGE  # noqa: E402, F401  (the studies' pictures take them from here)

START, END = 14.0, 34.0
"""Part of the synthetic motion that a study runs: a second of quiet, then all of the strong shaking (18-24 s) and ten seconds to fall. [s]"""


def parser(about, name):
    """ArgumentParser with the options of every study."""
    made = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    made.add_argument("-j", "--jobs", type=int, default=os.cpu_count(), metavar="N", help="runs at a time (default %(default)s)")
    made.add_argument("--start", type=float, default=START, metavar="S", help="the motion from here [s] (default %(default)g)")
    made.add_argument("--end", type=float, default=END, metavar="S", help="the motion up to here [s] (default %(default)g)")
    made.add_argument("--dt", metavar="S", default="*", help="time step [s] (default: that of the runs)")
    made.add_argument("--out", type=Path, default=Path("results") / name, metavar="DIR", help="folder of the runs (default %(default)s)")
    made.add_argument("--to", type=Path, metavar="DIR", help="folder of the study's CSV and PNG (default: that of the runs)")
    return made


def house_name(text):
    """A shipped house, or the whole path of a house file: tables lie elsewhere. For argparse."""
    return str(Path(text).resolve()) if Path(text).is_file() else text


def numbers(text):
    """'0.5,1' -> [0.5, 1.0], for argparse."""
    return [float(word) for word in text.split(",")]


def run_all(rows, options):
    """Run the rows (dicts of columns, all alike) through yade-batch; their results, see `yade_timber.batch.collect`. Ends the process on errors."""
    if not rows:
        sys.exit("error: no run is asked for")
    options.out.mkdir(parents=True, exist_ok=True)
    table = options.out / "table.txt"
    rows = [{**row, "start": options.start, "end": options.end, "dt": options.dt} for row in rows]
    write_text(table, "\n".join(" ".join(map(str, line)) for line in [list(rows[0]), *(row.values() for row in rows)]) + "\n")
    try:
        found = run_table(table, options.out, max(1, options.jobs), HERE / "batch_run.py")
    except (BatchError, OSError) as problem:
        sys.exit(f"error: {problem}")
    except KeyboardInterrupt:
        sys.exit("stopped; the same command goes on")
    for entry in found:
        if entry["status"] != "done":
            print(f"{entry['status']}: {entry['run']}: {entry['error']}", file=sys.stderr)
    return found


def write_table(path, rows):
    """CSV of dicts; numbers with 5 digits."""
    text = io.StringIO()
    writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows({key: f"{value:.5g}" if isinstance(value, float) else value for key, value in row.items()} for row in rows)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_text(path, text.getvalue())
    print(f"written: {path}")


def save(figure, path):
    with written_whole(path) as part:
        figure.savefig(part, dpi=130)
    print(f"written: {path}")

# SPDX-License-Identifier: GPL-2.0-or-later
"""All rows of a table on this machine, through yade-batch: only what is missing, logs in one place, stopped as one."""

import os
import signal
import subprocess
from pathlib import Path

from .collect import END, write_runs
from .table import BatchError, check_shell_safe, read_table


def run_table(table, folder, jobs, script, retry=False, program="yade-batch"):
    """Run what is missing by `script`, `jobs` at a time; returns what `collect` does. Raises BatchError, KeyboardInterrupt.

    retry: runs that failed before run again. Whatever happens, runs.csv tells what is there at the end.
    """
    rows, folder = read_table(table), Path(folder)
    (folder / "logs").mkdir(parents=True, exist_ok=True)
    if retry:
        _forget_failed(rows, folder)
    missing = [row for row in rows if not (folder / row.name / END).exists()]
    try:
        if missing:
            _yade_batch(missing, folder, jobs, Path(script).absolute(), program)
    finally:
        found = write_runs(rows, folder)
    return found


def _forget_failed(rows, folder):
    for entry, row in zip(write_runs(rows, folder), rows):
        if entry["status"] == "failed":
            (folder / row.name / END).unlink()


def _yade_batch(rows, folder, jobs, script, program):
    """Run yade-batch in `folder`. It is stopped with all its jobs: alone, it would leave them running."""
    for path in (rows[0].table, script):
        check_shell_safe(path)
    command = [program, f"--jobs={jobs}", "--job-threads=1", "--force-threads", "--nice=10", "--disable-pynotify", "--plot-update=0",
               "--log=logs/%.log", f"--lines={','.join(str(row.line) for row in rows)}", str(rows[0].table), str(script)]
    try:
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, start_new_session=True,
                                   env={**os.environ, "YADE_TIMBER_BATCH": str(folder.absolute())})
    except OSError as problem:
        raise BatchError(f"{program}: cannot be started: {problem.strerror}") from None
    before = signal.signal(signal.SIGTERM, _interrupt)
    try:
        process.wait()
    except KeyboardInterrupt:
        os.killpg(process.pid, signal.SIGTERM)
        process.wait()
        raise
    finally:
        signal.signal(signal.SIGTERM, before)


def _interrupt(*_):
    raise KeyboardInterrupt

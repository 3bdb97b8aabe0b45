# SPDX-License-Identifier: GPL-2.0-or-later
"""All rows of a table on this machine, through yade-batch: only what is missing, logs in one place, stopped as one."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from tqdm import tqdm

from ...base.lock import held
from .collect import END, write_runs
from .table import BatchError, check_shell_safe, read_table

LOG = "logs/yade-batch.log"
POLL = 0.2
"""Wall time between two looks at the runs. [s]"""
PATIENCE = 60.0
"""Longest wait for stopped runs to save their checkpoints. [s]"""


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
    """Run yade-batch in `folder`. It is stopped with all its jobs: alone, it would leave them running. Its own words go to LOG."""
    for path in (rows[0].table, script):
        check_shell_safe(path)
    command = [program, f"--jobs={jobs}", "--job-threads=1", "--force-threads", "--nice=10", "--disable-pynotify", "--plot-update=0",
               "--log=logs/%.log", f"--lines={','.join(str(row.line) for row in rows)}", str(rows[0].table), str(script)]
    before = signal.signal(signal.SIGTERM, _interrupt)
    try:
        with open(folder / LOG, "w") as log:
            process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=log, stderr=log, start_new_session=True,
                                       env={**os.environ, "YADE_TIMBER_BATCH": str(folder.absolute())})
        _watch(process, rows, folder)
    except OSError as problem:
        raise BatchError(f"{program}: cannot be started: {problem.strerror}") from None
    except KeyboardInterrupt:
        _stop(process, [folder / row.name for row in rows])
        raise
    finally:
        signal.signal(signal.SIGTERM, before)


def _watch(process, rows, folder):
    """A bar of ended runs, a line for each when nobody sits at a terminal, until the process ends."""
    with tqdm(total=len(rows), desc=str(folder), unit="run") as bar:
        while process.poll() is None:
            time.sleep(POLL)
            new = sum((folder / row.name / END).exists() for row in rows) - bar.n
            if new:
                bar.update(new)
    if process.returncode:
        print(f"yade-batch ended with status {process.returncode}; its words are in {folder / LOG}", file=sys.stderr)


def _stop(process, folders):
    """Stop yade-batch and its jobs, and wait until these have saved their checkpoints."""
    os.killpg(process.pid, signal.SIGTERM)
    process.wait()
    end = time.monotonic() + PATIENCE
    while any(map(held, folders)) and time.monotonic() < end:
        time.sleep(POLL)


def _interrupt(*_):
    raise KeyboardInterrupt

# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs in YADE processes of their own, several at a time.

A task is done when its folder holds a summary.json made from the same options, files and package. `run_missing` starts
the other tasks: a process finds its options in request.json of the folder (run/options.py). An interrupted run
continues from its checkpoint. run.json records how a run ended; run.log holds its messages."""
import json
import os
import shutil
import signal
import subprocess
import time
from collections import deque
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

from ..base.atomic_write import remove, write_text
from ..base.errors import RunError
from ..base.files import make_folder
from ..base.json_types import require
from ..base.lock import is_locked, locked
from ..base.options import options
from ..base.processors import processors
from ..base.record_file import open_record, read_record
from ..recording.summary import NAME as SUMMARY
from ..recording.summary import Summary
from ..run.identity import made_from
from ..run.options import RunOptions, write_request
from ..text.english import counted

END, LOG = "run.json", "run.log"
ENTRY = Path(__file__).resolve().parents[1] / "api" / "requested.py"  # what a process starts
DRIVER = ".driver"  # lock of the driver that starts a run
STATES = ("done", "failed", "unfinished")
STOPS = ("SIGHUP", "SIGINT", "SIGKILL", "SIGTERM")  # signals after which a run is continued; others are crashes
POLL = 0.2  # wall time between two checks of the running processes. [s]
SAVE_TIME = 60.0  # longest wait for interrupted runs to save their checkpoints. [s]


@dataclass(frozen=True)
class Task:
    """A run: folder of its results, RunOptions that decide them."""

    folder: Path
    options: RunOptions

    def request(self):
        """RunOptions of its process: those that decide results, and those with which the driver runs it."""
        indecisive = {name: each.default for name, each in options(RunOptions).items() if not each.metadata["decides"]}
        own = {"out": self.folder, "resume": True, "or_anew": True, "no_views": True, "quiet": True}
        return replace(self.options, **{**indecisive, "no_frames": self.options.no_frames, **own})

    @property
    def summary(self):
        """Summary, or None if the run is not done or was made from other options, files or another package."""
        table = _read(self.folder / SUMMARY)
        return Summary.read(self.folder) if table and table.get("made_from") == made_from(self.options) else None

    @property
    def error(self):
        recorded = (_read(self.folder / END) or {}).get("error")
        return recorded if recorded and self.summary is None else None

    @property
    def status(self):
        """One of STATES."""
        return "failed" if self.error else "done" if self.summary is not None else "unfinished"

    def is_missing(self, retry):
        """Whether the run is to be started; retry: failed runs, too."""
        return self.summary is None and (retry or not self.error)


def record_end(folder, error):
    """Write run.json. error: message of a failed run, None of others"""
    write_text(folder / END, json.dumps({"status": "failed" if error else "done", "error": error}) + "\n")


def note_fault(folder, fault):
    """Record the InputError that ends the run of this process, unless another one computes a run in the folder."""
    if not is_locked(folder):
        record_end(folder, str(fault))


def _read(path):
    """Table of a JSON file, None without the file. Raises RunError."""
    if not os.path.lexists(path):
        return None
    try:
        return require(json.loads(read_record(path)), dict, "content")
    except (ValueError, RecursionError) as problem:
        if isinstance(problem, RunError):
            raise
        raise RunError(f"{path}: cannot be read: {problem}; remove it, or take another folder") from None


def run_missing(tasks, jobs=None, report=print, retry=True):
    """Run the tasks that are not done, `jobs` at a time (default: one per core); returns {task: summary or None}.

    report   called with one line for each run that ends retry    whether failed runs are started again

    Failed runs do not stop the others. Raises RunError without YADE, and KeyboardInterrupt after SIGINT or SIGTERM,
    when the started runs have saved their checkpoints."""
    tasks = list(dict.fromkeys(tasks))
    missing = [task for task in tasks if task.is_missing(retry)]
    for task in set(tasks).difference(missing):
        if not os.path.lexists(task.folder / END):  # its driver was killed before the run ended
            record_end(task.folder, None)
    if missing:
        report(f"{len(missing)} of {len(tasks)} runs to do")
        _run_all(missing, jobs or processors(), report)
    return {task: task.summary for task in tasks}


def _run_all(tasks, jobs, report):
    waiting, running, ended = deque(tasks), [], 0
    previous = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        while waiting or running:
            while waiting and len(running) < jobs:
                running.append(_Process(waiting.popleft()))
            for process in [process for process in running if process.has_ended()]:
                running.remove(process)
                ended += 1
                outcome = process.outcome()
                report(f"[{ended}/{len(tasks)}] {process.task.folder}: {outcome}")
                if ended == 1 and waiting and outcome.startswith("done"):
                    left = about(process.age * (len(tasks) - 1) / jobs)
                    report(f"{counted(len(tasks) - 1, 'other run')} as long as the first: {left}, {jobs} at a time")
            time.sleep(POLL if running else 0)
    finally:
        _stop(running)
        signal.signal(signal.SIGTERM, previous)


def about(seconds):
    """'about 45 s', 'about 12 min', 'about 3.5 h'."""
    return (f"about {seconds:.0f} s" if seconds < 90 else f"about {seconds / 60:.0f} min" if seconds < 5400
            else f"about {seconds / 3600:.1f} h")


def _stop(processes):
    """Interrupt the runs and wait until they have saved their checkpoints."""
    for process in processes:
        if process.child is not None:
            process.child.terminate()
    deadline = time.monotonic() + SAVE_TIME
    while any(not process.has_ended() for process in processes) and time.monotonic() < deadline:
        time.sleep(POLL)
    for process in processes:
        process.lock.close()


class _Process:
    """The YADE process of a task. None is started while another process computes a run in the task's folder."""

    def __init__(self, task):
        self.task, self.child, self.start = task, None, time.monotonic()
        make_folder(task.folder)
        self.outdated, self.lock = (task.folder / SUMMARY).exists(), ExitStack()
        if is_locked(task.folder) or not self.lock.enter_context(locked(task.folder, DRIVER)):
            return
        for name in (END, SUMMARY):
            remove(task.folder / name)
        write_request(task.request())
        with open_record(task.folder / LOG, os.O_RDWR | os.O_CREAT | os.O_TRUNC) as log:
            self.child = subprocess.Popen([*command(ENTRY), str(task.folder)], stdin=subprocess.DEVNULL, stdout=log,
                                          stderr=log, start_new_session=True,
                                          env={**os.environ, "OMP_NUM_THREADS": "1"})

    @property
    def age(self):
        """Time since it was started. [s]"""
        return time.monotonic() - self.start

    def has_ended(self):
        return self.child is None or self.child.poll() is not None

    def outcome(self):
        """Record how the run ended; returns one line."""
        with self.lock:
            if self.child is None or self.child.returncode and is_locked(self.task.folder):
                return "skipped: another process computes this run"
            ended_by = _signal(self.child.returncode)
            if ended_by in STOPS:
                return f"stopped by {ended_by}; the next start continues this run"
            error = f"crashed ({ended_by}); see {self.task.folder / LOG}" if ended_by else self._error()
            record_end(self.task.folder, error)
        if error:
            return f"failed: {error}"
        again = " again (other options, files or package)" if self.outdated else ""
        return f"done{again} in {self.age:.0f} s"

    def _error(self):
        if self.child.returncode:
            return self.task.error or f"exit status {self.child.returncode}; see {self.task.folder / LOG}"
        if self.task.summary is None:
            return (f"the run used another timber_houses than {Path(__file__).parents[1]}: start this script with"
                    " YADE's Python")
        return None


def _signal(status):
    """Name of the signal that ended a process, None for another exit status."""
    number = -status if status < 0 else status - 128
    return signal.Signals(number).name if number in set(signal.Signals) else None


def command(script, threads=1):
    """Command line that runs a script in YADE. Raises RunError."""
    yade = shutil.which("yade")
    if yade is None:
        raise RunError("no yade on the PATH: install it (scripts/setup)")
    return [yade, "-n", "-x", f"-j{threads}", str(script)]

# SPDX-License-Identifier: GPL-2.0-or-later
"""Many runs of the scripts, each a YADE process of its own, over all cores. Needs no YADE itself."""
import json
import os
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from ..run.identity import made_from

FAILURE, SUMMARY = "failed.txt", "summary.json"

MOTION_OPTIONS = ("record", "seed", "scale", "start", "end")
"""Options of the run scripts that runs without an earthquake refuse."""


@dataclass(frozen=True)
class Task:
    """A run: script name without .py, folder of its results, options of its command line."""

    script: str
    folder: Path
    options: tuple = field(default=())

    @property
    def summary(self):
        """Content of summary.json, or None when the run has not been done, or was made from something else (see provenance)."""
        path = self.folder / SUMMARY
        found = json.loads(path.read_text()) if path.is_file() else {}
        return found if found.get("made_from") == made_from(self.options) else None


def add_arguments(parser, folder):
    """Arguments that all studies share: where to, how many at a time, and what is handed to every run."""
    parser.add_argument("--out", type=Path, default=Path(folder), help=f"folder that holds a folder of each run (default {folder})")
    parser.add_argument("--jobs", type=int, help="runs at a time (default: all cores)")
    parser.add_argument("--record", metavar="FILE_OR_PREFIX", help="recorded ground motion for the runs with an earthquake")
    parser.add_argument("--seed", type=int, metavar="N", help="synthetic motion of another seed")
    parser.add_argument("--scale", type=float, metavar="X", help="factor on their ground motion")
    parser.add_argument("--start", type=float, metavar="S", help="leave out what comes before this time of the motion [s]")
    parser.add_argument("--end", type=float, metavar="S", help="leave out what comes after it [s]")
    parser.add_argument("--dt", type=float, metavar="S", help="time step of all runs [s]")
    parser.add_argument("--duration", type=float, metavar="S", help="simulated time of all runs [s]")


def handed_on(given, earthquake):
    """What is handed to a run, with or without an earthquake, as words of its command line."""
    names = ("dt", "duration", *(MOTION_OPTIONS if earthquake else ()))
    chosen = [(name, getattr(given, name, None)) for name in names]
    return tuple(word for name, value in chosen if value is not None for word in (f"--{name}", value))


def chosen(text, known, option):
    """Names of a comma-separated list; all of them without a list. Ends the process with a line when one is unknown."""
    names = text.split(",") if text else list(known)
    unknown = [name for name in names if name not in known]
    if unknown:
        sys.exit(f"error: {option}: unknown: {', '.join(unknown)}; known: {', '.join(known)}")
    return names


def run_missing(tasks, scripts, jobs=None, say=print):
    """Do the tasks that have no results yet, with the scripts of that folder, `jobs` at a time (default: all cores). Returns {task: summary or None}.

    A run that was stopped goes on from its checkpoint; one that was made from other options, files or another state of this package is done
    again; one that fails leaves its last words in failed.txt, and the others go on.
    """
    missing = [task for task in tasks if task.summary is None]
    if missing:
        say(f"{len(missing)} of {len(tasks)} runs to do")
    with ThreadPoolExecutor(jobs or os.cpu_count()) as pool:
        for task, line in zip(missing, pool.map(lambda task: _run(task, scripts), missing)):
            say(f"{task.folder}: {line}")
    return {task: task.summary for task in tasks}


def _run(task, scripts):
    """Do one run; returns what became of it in a line."""
    task.folder.mkdir(parents=True, exist_ok=True)
    again = (task.folder / SUMMARY).exists()
    for name in (FAILURE, SUMMARY):
        (task.folder / name).unlink(missing_ok=True)
    words = [*command(scripts / f"{task.script}.py"), "--out", str(task.folder), "--no-views", "--quiet", "--resume", "--or-anew", *map(str, task.options)]
    since = time.monotonic()
    done = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    if task.summary is not None:
        return f"done{' again (other options, files or package)' if again else ''} in {time.monotonic() - since:.0f} s"
    said = done.stderr if done.returncode else f"error: made by another yade_timber than that of this study in {Path(__file__).parents[1]}: start it with YADE's Python"
    (task.folder / FAILURE).write_text(said)
    return f"failed: {said.strip().splitlines()[-1] if said.strip() else f'exit status {done.returncode}'}"


def command(script):
    """Words that run a script in YADE on one thread. Ends the process with a line when there is no YADE."""
    yade = shutil.which("yade") or sys.exit("error: no yade on the PATH: install it (scripts/setup)")
    return [yade, "-n", "-x", "-j1", str(script)]

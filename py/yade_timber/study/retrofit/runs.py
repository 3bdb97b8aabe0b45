# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of a ranking: rounds of a batch, in which the better half of the candidates goes on. A stopped ranking continues."""
import os
from dataclasses import dataclass
from pathlib import Path

from ...base.atomic_write import write_text
from ...base.errors import RunError
from ...base.table import csv_text
from ..batch import read_table, run_rows, write_runs
from ..batch.table import COLUMNS
from ..batch.tasks import check_rows, task_of
from .candidates import AS_IT_IS
from .race import Entry, cost, halve, response, rounds

TABLE = "table.csv"


@dataclass
class Ranking:
    """A ranking in a folder. motions: [(name, cells)]; same: cells of all runs; scripts: folder of the run scripts; jobs: runs at a time."""

    folder: Path
    candidates: list
    motions: list
    same: dict
    scripts: Path
    jobs: int = None

    def __post_init__(self):
        self.folder = Path(self.folder)
        self.house = Entry(AS_IT_IS, {}, {})
        self.entries = [Entry(candidate, {}, {}) for candidate in self.candidates]

    def check(self):
        """Check all rows before the first run: each candidate under the first motion, the house as it is under all. Raises BatchError."""
        rows = self._rows([(AS_IT_IS, motion) for motion in self.motions] + [(candidate, self.motions[0]) for candidate in self.candidates])
        check_rows(rows, self.folder)

    def run(self, report=print):
        """All rounds. report: called with one line after each. Raises RunError when a run of the house as it is fails."""
        racing, pairs, before = self.entries, [], 0
        plan = rounds(len(self.motions), len(self.candidates))
        for number, (done, count) in enumerate(plan, 1):
            racing = halve([entry for entry in racing if not entry.failed], self.house.responses, count) if before else racing
            pairs += [(entry, motion) for motion in self.motions[before:done] for entry in (self.house, *racing)]
            found = self._run(pairs)
            left = cost(len(self.motions), len(self.candidates)) - len(pairs)
            report(f"round {number} of {len(plan)}: {len(racing)} candidates under {done} motions; {progress(found, left, self.jobs)}")
            before = done

    def _run(self, pairs):
        """Run [(Entry, motion)] and store responses; returns the rows of runs.csv. Raises RunError after a run that was stopped."""
        rows = self._rows([(entry.candidate, motion) for entry, motion in pairs])
        run_rows(rows, self.folder, self.scripts, self.jobs)
        found = write_runs(rows, self.folder)
        for (entry, (motion, _)), run in zip(pairs, found):
            if run["status"] == "unfinished":
                raise RunError(f"{run['run']} was stopped; the same command continues")
            if run["status"] == "done":
                entry.runs[motion], entry.responses[motion] = run, response(run)
            elif entry is self.house:
                raise RunError(f"the house as it is failed under {motion}: {run['error'] or run['status']}; nothing to compare with")
            else:
                entry.failed = run["error"] or run["status"]
        return found

    def _rows(self, pairs):
        """Rows of a batch table for [(candidate, motion)], written to the folder."""
        cells = [{**self.same, **motion, **candidate.changes, "description": f"{candidate.name}_{name}"} for candidate, (name, motion) in pairs]
        columns = [column for column in (*COLUMNS, "description") if any(column in row for row in cells)]
        write_text(self.folder / TABLE, csv_text(columns, [[row.get(column, "") for column in columns] for row in cells]))
        return read_table(self.folder / TABLE)

    def task(self, entry, motion):
        """Task of a run of an Entry under a motion's name, for its folder."""
        cells = next(pair for pair in self.motions if pair[0] == motion)
        return task_of(self._rows([(entry.candidate, cells)])[0], self.folder)


def progress(found, left, jobs):
    """'24 runs, 31 s each; 36 runs left, about 10 min'. jobs: runs at a time, None: one per core"""
    walls = [run["wall_s"] for run in found if run["status"] == "done"]
    each = sum(walls) / max(len(walls), 1)
    rest = f"; {left} runs left, about {each * left / (jobs or os.cpu_count()) / 60:.0f} min" if left > 0 else ""
    return f"{len(found)} runs, {each:.0f} s each{rest}"

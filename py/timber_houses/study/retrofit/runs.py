# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs of a ranking: pilots that choose the strength of the motions, rounds of selection, the finalists' test."""
import math
from dataclasses import dataclass
from pathlib import Path

from ...base.errors import RunError
from ...base.processors import processors
from ...run.options import RunOptions
from ...text.english import counted
from ..batch import Row, check_rows, run_rows, write_runs
from ..driver import about
from ..probe import estimate
from .candidates import AS_IT_IS
from .race import Entry, cost, rounds, select

PILOTS = 6  # number of motions under which the house as it is runs for the choice of their strength. [-]
WEAKEST, STRONGEST = 1 / 16, 16  # factors on the motions between which a strength is sought. [-]
FINEST = 1.2  # ratio of two factors that are not distinguished: as many motions differ. [-]


@dataclass
class Ranking:
    """A ranking in a folder. motions: [(name, {option: value})], the first for selection; same: options of all"""

    folder: Path
    candidates: list
    motions: list
    same: dict
    jobs: int | None = None

    def __post_init__(self):
        self.folder = Path(self.folder)
        self.house = Entry(AS_IT_IS, {})
        self.entries = [Entry(candidate, {}) for candidate in self.candidates]

    @property
    def plan(self):
        return rounds(len(self.motions), len(self.candidates))

    @property
    def tests(self):
        selection = ([0] + [done for done, _ in self.plan])[-2]
        return [name for name, _ in self.motions[selection:]]

    def check(self):
        """Check all rows first: each candidate under the first motion, the house under all. Raises BatchError."""
        rows = self._rows([(AS_IT_IS, motion) for motion in self.motions]
                          + [(candidate, self.motions[0]) for candidate in self.candidates])
        check_rows(rows, self.folder)

    def estimate(self, pilots):
        """A line about the computing time. pilots: whether the strength of the motions is chosen, once at least"""
        count = cost(len(self.motions), len(self.candidates)) + (PILOTS if pilots else 0)
        return estimate(self.task(self.house, self.motions[0][0]), count, self.jobs)

    def choose_scale(self, report=print):
        """Scale the motions so that half of the pilots bring the house down, by bisection; returns a sentence."""
        pilots, scale, low, high, shares = self.motions[:PILOTS], 1.0, None, None, {}
        while scale not in shares:
            shares[scale] = self._pilot(pilots, scale) / len(pilots)
            report(f"strength: motions times {scale:g} bring the house down in {shares[scale] * len(pilots):.0f} of"
                   f" {len(pilots)} runs")
            if abs(shares[scale] - 0.5) < 0.2:
                break
            low, high = (low, scale) if shares[scale] > 0.5 else (scale, high)
            if low and high and high / low < FINEST:
                break
            between = math.sqrt(low * high) if low and high else 2 * low if low else high / 2
            scale = float(f"{min(max(between, WEAKEST), STRONGEST):.3g}")
        scale = min(shares, key=lambda one: (abs(shares[one] - 0.5), one if shares[one] > 0.5 else -one))
        self.motions = [(name, {**options, "scale": scale}) for name, options in self.motions]
        fallen = f"{shares[scale] * len(pilots):.0f} of the first {len(pilots)}"
        return (f"The motions are scaled by {scale:g}, at which {fallen} bring the house as it is down; --scale chooses"
                " another strength.")

    def _pilot(self, pilots, scale):
        """Number of pilots, scaled, under which the house as it is collapses."""
        house = Entry(AS_IT_IS, {})
        self._run([(house, (name, {**options, "scale": scale})) for name, options in pilots], house)
        return sum(bool(run["collapsed"]) for run in house.runs.values())

    def run(self, report=print):
        """All rounds. report: called with a line after each. Raises RunError when a run of the house as it is fails."""
        first = self._run([(self.house, self.motions[0])], self.house)
        report(f"first run: {progress(first, cost(len(self.motions), len(self.candidates)) - 1, self.jobs)}")
        racing, pairs, before = self.entries, [], 0
        for number, (done, count) in enumerate(self.plan, 1):
            racing = select([entry for entry in racing if not entry.failed], self.house, count) if before else racing
            pairs += [(entry, motion) for motion in self.motions[before:done] for entry in (self.house, *racing)]
            runs = self._run(pairs, self.house)
            left = cost(len(self.motions), len(self.candidates)) - len(pairs)
            aim = "test" if number == len(self.plan) else "selection"
            report(f"{aim}: {len(racing)} measures under {done - before} motions; {progress(runs, left, self.jobs)}")
            before = done

    def _run(self, pairs, house):
        """Run [(Entry, motion)] and store the runs; returns the rows of runs.csv. house: Entry of the house as it is.
        Raises RunError after a run that was stopped."""
        rows = self._rows([(entry.candidate, motion) for entry, motion in pairs])
        run_rows(rows, self.folder, self.jobs)
        runs = write_runs(rows, self.folder)
        for (entry, (motion, _)), run in zip(pairs, runs):
            if run["status"] == "unfinished":
                raise RunError(f"{run['run']} was stopped; the same command continues")
            if run["status"] == "done":
                entry.runs[motion] = run
            elif entry is house:
                raise RunError(f"the house as it is failed under {motion}: {run['error'] or run['status']}; nothing to"
                               " compare with")
            else:
                entry.failed = run["error"] or run["status"]
        return runs

    def _rows(self, pairs):
        return [self._row(candidate, *motion) for candidate, motion in pairs]

    def _row(self, candidate, name, motion):
        description = f"{candidate.name}_{name}"
        options = RunOptions(quake=True, **{**self.same, **motion, **candidate.options})
        return Row(options, candidate.changes, description, description)

    def task(self, entry, motion):
        """Task of a run of an Entry under a motion's name, for its folder."""
        return self._row(entry.candidate, motion, dict(self.motions)[motion]).task(self.folder)


def progress(runs, left, jobs):
    """'24 runs of 31 s; 36 runs left, about 10 min'. jobs: runs at a time, None: one per core"""
    walls = [run["wall_s"] for run in runs if run["status"] == "done"]
    each = sum(walls) / max(len(walls), 1)
    rest = f"; {left} runs left, {about(each * left / (jobs or processors()))}" if left > 0 else ""
    return f"{counted(len(runs), 'run')} of {each:.0f} s{rest}"

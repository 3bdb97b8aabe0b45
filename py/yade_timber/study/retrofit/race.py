# SPDX-License-Identifier: GPL-2.0-or-later
"""Statistics of a ranking: paired responses, Wilcoxon's signed-rank test with Holm's correction, successive halving. Needs no YADE.

The response of a run is the logarithm of its largest storey drift; a collapse counts as a drift of CAP. A candidate is compared with the house
as it is under the same motions. Halving drops candidates before they are tested. It makes no false discovery more likely: the correction
is for all candidates at the start, and a dropped one is never called better or worse.
"""
import math
from dataclasses import dataclass

import numpy as np
from scipy import stats

SIGNIFICANCE = 0.05
LEAST_MOTIONS = 10
FIRST_ROUND, KEPT = 4, 4
"""Number of motions before the first candidates are dropped, and number of candidates that are never dropped."""
CAP, FLOOR = 1.0, 1e-4
"""Drift that stands for a collapse, and the smallest drift that is distinguished. [-]"""
NO_DIFFERENCE = "no difference can be shown"


def response(run):
    """Logarithm of the largest drift of a run, a row of runs.csv."""
    return math.log(CAP if run["collapsed"] else min(max(run["peak_drift"], FLOOR), CAP))


def rounds(motions, count):
    """[(motions so far, candidates in the round)] of successive halving: 4, 8, ... motions; after each round the better half goes on."""
    if count <= KEPT:
        return [(motions, count)]
    plan, done = [], min(FIRST_ROUND, motions)
    while done < motions:
        plan.append((done, count))
        done, count = min(2 * done, motions), max(KEPT, math.ceil(count / 2))
    return [*plan, (motions, count)]


def cost(motions, count):
    """Number of runs of a ranking, those of the house as it is included."""
    plan, before, total = rounds(motions, count), 0, motions
    for done, entered in plan:
        total += entered * (done - before)
        before = done
    return total


def needed_motions(count):
    """Smallest number of motions with which one of `count` candidates can be significant: the two-sided p of equal signs is 2 / 2^n."""
    return max(LEAST_MOTIONS, math.ceil(math.log2(2 * count / SIGNIFICANCE)))


def signed_rank(differences):
    """Two-sided p of Wilcoxon's signed-rank test; 1 without a difference that is not zero."""
    differences = _not_zero(differences)
    return float(stats.wilcoxon(differences).pvalue) if len(differences) else 1.0


def _not_zero(differences):
    differences = np.asarray(differences, float)
    return differences[differences != 0]


def is_lower(differences):
    """Whether the differences are negative by the ranks that `signed_rank` compares."""
    differences = _not_zero(differences)
    return float(np.sign(differences) @ stats.rankdata(np.abs(differences))) < 0


def holm(values, count):
    """p values corrected for `count` tests by Holm's method, of which those that are not given have p = 1."""
    order = np.argsort(values)
    corrected, largest = np.ones(len(values)), 0.0
    for rank, k in enumerate(order):
        largest = max(largest, min(1.0, (count - rank) * values[k]))
        corrected[k] = largest
    return corrected.tolist()


@dataclass
class Entry:
    """A candidate in the race. responses: {motion: response}; dropped: number of motions after which it was dropped, or None; failed: error."""

    candidate: object
    responses: dict
    runs: dict
    dropped: int = None
    failed: str = ""

    def differences(self, base):
        """Responses minus those of the house as it is, under the motions of both."""
        return np.array([value - base[motion] for motion, value in self.responses.items() if motion in base])

    def ratio(self, base):
        """Median ratio of the drift to that of the house as it is. [-]"""
        found = self.differences(base)
        return float(np.exp(np.median(found))) if len(found) else math.nan


def halve(entries, base, keep):
    """Mark all but the `keep` entries with the smallest median ratio as dropped; returns those that go on."""
    ranked = sorted(entries, key=lambda entry: (entry.ratio(base), float(np.mean(entry.differences(base)))))
    for entry in ranked[keep:]:
        entry.dropped = len(entry.responses)
    return ranked[:keep]


@dataclass(frozen=True)
class Result:
    """Row of the ranking. ratio: median of the drift over that of the house as it is; low, high: extremes; p: corrected, None if dropped."""

    entry: Entry
    ratio: float
    low: float
    high: float
    collapses: int
    p: float
    words: str


def ranking(entries, base):
    """Results, the best first: those of the last round, then the dropped ones in the order of the motions they had. base: {motion: response}"""
    last = [entry for entry in entries if entry.dropped is None and not entry.failed]
    corrected = dict(zip(map(id, last), holm([signed_rank(entry.differences(base)) for entry in last], len(entries))))
    found = [_result(entry, base, corrected.get(id(entry))) for entry in entries]
    return sorted(found, key=lambda result: (bool(result.entry.failed), -len(result.entry.responses), result.ratio))


def _result(entry, base, p):
    ratios = np.exp(entry.differences(base))
    low, high = (float(ratios.min()), float(ratios.max())) if len(ratios) else (math.nan, math.nan)
    ratio, collapses = entry.ratio(base), sum(bool(run["collapsed"]) for run in entry.runs.values())
    if entry.failed:
        words = f"a run failed: {entry.failed}"
    elif p is None:
        words = f"{NO_DIFFERENCE}: dropped after {entry.dropped} motions"
    else:
        words = NO_DIFFERENCE if p >= SIGNIFICANCE else "better" if is_lower(entry.differences(base)) else "worse"
    return Result(entry, ratio, low, high, collapses, p, words)

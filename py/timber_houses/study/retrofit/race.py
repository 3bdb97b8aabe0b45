# SPDX-License-Identifier: GPL-2.0-or-later
"""Statistics of a ranking: selection of finalists, their tests under motions of their own, Holm's correction.

The response of a run is the logarithm of its largest storey drift; a collapse counts as a drift of CAP. A measure is
compared with the house as it is under the same motions. The first motions select the finalists, the others test them. A
dropped measure has no test, and costs the finalists no significance: the motions that chose them do not test them."""
import math
from dataclasses import dataclass

import numpy as np
import scipy  # submodules load on first use; a plain run needs none

SIGNIFICANCE = 0.05
FINALISTS = 3  # number of measures that are tested. [-]
ROUND, CUT = 4, 5
"""Number of motions of a round of the selection, and about the ratio of the measures before and after it. [-]"""
TESTS, LEAST_TESTS = 16, 10  # number of motions of the test: by default, and the least. [-]
CAP, FLOOR = 1.0, 1e-4  # drift that stands for a collapse, and the smallest drift that is distinguished. [-]
NO_DIFFERENCE = "no difference can be shown"


def response(run):
    """Logarithm of the largest drift of a run, a row of runs.csv."""
    return math.log(CAP if run["collapsed"] else min(max(run["peak_drift"], FLOOR), CAP))


def selections(count):
    """Number of rounds that select the finalists of `count` measures."""
    return 0 if count <= FINALISTS else max(1, round(math.log(count / FINALISTS, CUT)))


def rounds(motions, count):
    """[(motions so far, measures in the round)]: rounds of the selection, then the test under all other motions."""
    number = min(selections(count), (motions - LEAST_TESTS) // ROUND)
    ratio = count / FINALISTS
    return [*((ROUND * (k + 1), math.ceil(count / ratio ** (k / number) - 1e-9)) for k in range(number)),
            (motions, min(count, FINALISTS))]


def cost(motions, count):
    """Number of runs of a ranking, those of the house as it is included."""
    done, entered = zip(*rounds(motions, count))
    return motions + int(np.dot(entered, np.diff(done, prepend=0)))


def default_motions(count):
    """Number of motions for `count` measures."""
    return ROUND * selections(count) + TESTS


def needed_motions(count):
    """Least number of motions for `count` measures."""
    return ROUND * min(selections(count), 1) + LEAST_TESTS


def signed_rank(differences):
    """Two-sided p of Wilcoxon's signed-rank test; 1 without a difference that is not zero."""
    differences = _not_zero(differences)
    return float(scipy.stats.wilcoxon(differences).pvalue) if len(differences) else 1.0


def exact_sign(fewer, more):
    """Two-sided p of McNemar's exact test: motions under which only the one or only the other house collapses."""
    return float(scipy.stats.binomtest(fewer, fewer + more).pvalue) if fewer + more else 1.0


def _not_zero(differences):
    differences = np.asarray(differences, float)
    return differences[differences != 0]


def holm(values, count):
    """p values corrected for `count` tests by Holm's method, of which those that are not given have p = 1."""
    order, corrected = np.argsort(values), np.empty(len(values))
    scaled = (count - np.arange(len(values))) * np.sort(values)
    corrected[order] = np.maximum.accumulate(np.minimum(scaled, 1.0))
    return corrected.tolist()


@dataclass
class Entry:
    """A measure. runs: {motion: row of runs.csv}; dropped: after so many motions, or None; failed: error."""

    candidate: object
    runs: dict
    dropped: int | None = None
    failed: str = ""


@dataclass(frozen=True)
class Comparison:
    """A measure and the house as it is. differences (M,) of the responses; fallen (M, 2): whether each collapses."""

    differences: np.ndarray
    fallen: np.ndarray

    @property
    def collapses(self):
        """Numbers of motions under which the measure and the house as it is collapse."""
        return self.fallen.sum(0).tolist()

    @property
    def mean(self):
        """Mean difference, infinite without motions."""
        return float(np.mean(self.differences)) if len(self.differences) else math.inf

    @property
    def by_collapses(self):
        """Whether collapses are compared: in half of the pairs or more, a house has collapsed, and no drift is known.

        Which of the two houses has is of no influence, so that this choice does not change how often equal houses are
        found different."""
        return 2 * int(self.fallen.any(1).sum()) >= len(self.differences)

    @property
    def p(self):
        """Two-sided p of a paired test: McNemar's of the collapses, or Wilcoxon's signed-rank test of the responses."""
        if self.by_collapses:
            measure, house = self.fallen.T
            return exact_sign(int((measure & ~house).sum()), int((house & ~measure).sum()))
        return signed_rank(self.differences)

    @property
    def is_better(self):
        """Direction of the difference that `p` belongs to."""
        if self.by_collapses:
            return self.collapses[0] < self.collapses[1]
        differences = _not_zero(self.differences)  # by the ranks that `signed_rank` compares
        return float(np.sign(differences) @ scipy.stats.rankdata(np.abs(differences))) < 0


def compare(entry, house, motions=None):
    """Comparison of two Entries under the motions of both, of which only those in `motions` count (None: all)."""
    both = [motion for motion in entry.runs if motion in house.runs and (motions is None or motion in motions)]
    pairs = [(entry.runs[motion], house.runs[motion]) for motion in both]
    differences = np.array([response(one) - response(other) for one, other in pairs])
    fallen = np.array([(bool(one["collapsed"]), bool(other["collapsed"])) for one, other in pairs], bool).reshape(-1, 2)
    return Comparison(differences, fallen)


def select(entries, house, keep):
    """Mark all but the `keep` entries with the smallest mean difference as dropped; returns those that go on."""
    ranked = sorted(entries, key=lambda entry: compare(entry, house).mean)
    for entry in ranked[keep:]:
        entry.dropped = len(entry.runs)
    return ranked[:keep]


@dataclass(frozen=True)
class Result:
    """Row of the ranking. comparison: of a finalist in the test, else of the selection; p: corrected or None."""

    entry: Entry
    comparison: Comparison
    p: float
    words: str

    @property
    def ratio(self):
        """Median ratio of the drift to that of the house as it is, a collapse as a drift of CAP. [-]"""
        return float(np.exp(np.median(self.comparison.differences))) if self.motions else math.nan

    @property
    def motions(self):
        return len(self.comparison.differences)

    @property
    def why(self):
        """'collapses under 3 motions instead of 10', or 'median drift times 0.55'."""
        if self.comparison.by_collapses:
            return "collapses under {} motions instead of {}".format(*self.comparison.collapses)
        return f"median drift times {self.ratio:.2f}"


def ranking(entries, house, tests):
    """Results, the best first: finalists, then dropped measures, the last first. tests: names of the test's motions"""
    finalists = [entry for entry in entries if entry.dropped is None and not entry.failed]
    compared = {id(entry): compare(entry, house, tests) for entry in finalists}
    corrected = dict(zip(compared, holm([one.p for one in compared.values()], len(compared))))
    results = []
    for entry in entries:
        comparison, p = compared.get(id(entry)) or compare(entry, house), corrected.get(id(entry))
        words = (f"a run failed: {entry.failed}" if entry.failed
                 else f"not tested: dropped after {entry.dropped} motions" if p is None
                 else NO_DIFFERENCE if p >= SIGNIFICANCE else "better" if comparison.is_better else "worse")
        results.append(Result(entry, comparison, p, words))
    return sorted(results, key=lambda result: (bool(result.entry.failed), -(result.entry.dropped or math.inf),
                                               result.comparison.mean))

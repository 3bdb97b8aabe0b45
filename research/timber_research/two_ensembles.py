# SPDX-License-Identifier: GPL-2.0-or-later
"""Two ensembles of one scenario that differ in one setting, as the time step: do their results have the same
distribution?

Medians: Mann-Whitney U test. Ranges: Brown-Forsythe test (Levene's test with deviations from the medians). Shares:
Fisher's exact test.
All are two-sided. The p values of all tests of a study are corrected by Holm's method.
"""
import math
from dataclasses import dataclass

import numpy as np
from scipy import stats
from timber_houses.text.english import counted, span
from timber_houses.recording.verdict import STATES
from timber_houses.study.retrofit.race import holm

from .claims import damage
from .screening.responses import drift, lean

SIGNIFICANCE = 0.05
"""Corrected p value below which two ensembles differ."""
FEWEST = 4
"""Values in each ensemble below which there is no test: of three and three, Mann and Whitney's smallest p is 0.1."""
RESAMPLES, RESAMPLING_SEED = 9999, 1
"""Of the bootstrap of ratios of medians."""


@dataclass(frozen=True)
class Quantity:
    """name: in tables; value: function of a summary; of: which runs have it; text: function of a value."""

    name: str
    value: object
    of: object
    text: object


def _all(_run):
    return True


def _stands(run):
    return not run.collapsed


def _falls(run):
    return run.collapsed


QUANTITIES = (Quantity("largest drift [-]", drift, _stands, "{:.3g}".format),
              Quantity("residual drift [-]", lean, _stands, "{:.3g}".format),
              Quantity("broken springs + 1 [-]", lambda run: 1 + damage(run), _all, "{:.0f}".format),
              Quantity("collapse time [s]", lambda run: run.collapse_time_s, _falls, "{:.2f}".format))
"""Positive numbers, whose logarithms are compared. Drifts are those of runs that stand; the collapses are compared as
shares.
"""


@dataclass(frozen=True)
class Comparison:
    """A test. case, quantity, test: names; first, second: texts of the two ensembles; p: None without a test.

    ratio: (ratio of the medians second / first, low, high), None where medians are not compared
    """

    case: str
    quantity: str
    test: str
    first: str
    second: str
    ratio: tuple
    p: float


def compare(case, first, second):
    """Comparisons of two lists of summaries."""
    found = []
    for quantity in QUANTITIES:
        a, b = ([quantity.value(run) for run in runs if quantity.of(run)] for runs in (first, second))
        if a or b:
            found += _numbers(case, quantity, a, b)
    return [*found, *_shares(case, first, second)]


def corrected(comparisons):
    """p values of all comparisons after Holm's correction, None without a test."""
    tested = [found.p for found in comparisons if found.p is not None]
    values = iter(holm(tested, len(tested)))
    return [None if found.p is None else next(values) for found in comparisons]


def _numbers(case, quantity, a, b):
    """Tests of the medians and of the ranges of two samples [lists of positive numbers]."""
    texts = _range(quantity, a), _range(quantity, b)
    enough = min(len(a), len(b)) >= FEWEST
    yield Comparison(case, quantity.name, "Mann-Whitney", *texts, median_ratio(a, b) if enough else None,
                     mann_whitney(a, b) if enough else None)
    yield Comparison(case, quantity.name, "Brown-Forsythe", *texts, None, brown_forsythe(a, b) if enough else None)


def _range(quantity, values):
    """'1/13 (1/15 to 1/11), 16 runs': median and range."""
    if not values:
        return "no run"
    low, middle, high = (quantity.text(value) for value in (min(values), np.median(values), max(values)))
    return f"{middle} ({span(low, high)}), {counted(len(values), 'run')}"


def _shares(case, first, second):
    """Fisher's exact test for each verdict that not all runs have; of two verdicts the second repeats the first."""
    occurring = [state for state in STATES if any(run.verdict == state for run in (*first, *second))]
    for state in occurring[-1:] if len(occurring) <= 2 else occurring:
        counts = [sum(run.verdict == state for run in runs) for runs in (first, second)]
        texts = [f"{count} of {len(runs)}" for count, runs in zip(counts, (first, second))]
        yield Comparison(case, state, "Fisher", *texts, None,
                         fisher(counts, (len(first), len(second))) if len(occurring) > 1 else None)


# --- tests ------------------------------------------------------------------------------------------------------------


def mann_whitney(a, b):
    """p value, two-sided; None for samples of one value."""
    return None if len({*a, *b}) == 1 else float(stats.mannwhitneyu(a, b, alternative="two-sided").pvalue)


def brown_forsythe(a, b):
    """p value of equal spread of the logarithms; None for two samples without spread."""
    if len(set(a)) == len(set(b)) == 1:
        return None
    p = float(stats.levene(np.log(a), np.log(b), center="median").pvalue)
    return None if math.isnan(p) else p


def fisher(counts, runs):
    """p value of equal shares."""
    return float(stats.fisher_exact([counts, [total - count for count, total in zip(counts, runs)]])[1])


def median_ratio(a, b):
    """(median of b over median of a, low, high): 95 % bootstrap interval (percentiles)."""
    random = np.random.default_rng(RESAMPLING_SEED)
    medians = [np.median(random.choice(values, (RESAMPLES, len(values))), axis=1) for values in (a, b)]
    low, high = np.quantile(medians[1] / medians[0], (0.025, 0.975))
    return float(np.median(b) / np.median(a)), float(low), float(high)


# --- table ------------------------------------------------------------------------------------------------------------

HEADER = ("run", "quantity", "first", "second", "ratio of medians", "95 % interval", "test", "p", "p_holm", "result")


def rows(comparisons):
    """Values of HEADER for each comparison."""
    return [_row(found, p) for found, p in zip(comparisons, corrected(comparisons))]


def _row(found, p):
    middle, interval = ((f"{found.ratio[0]:.3f}", f"{found.ratio[1]:.3f} to {found.ratio[2]:.3f}") if found.ratio
                        else ("", ""))
    result = "no test" if p is None else "differ" if p < SIGNIFICANCE else "no difference shown"
    values = ("", "") if p is None else (f"{found.p:.2g}", f"{p:.2g}")
    return (found.case, found.quantity, found.first, found.second, middle, interval, found.test, *values, result)

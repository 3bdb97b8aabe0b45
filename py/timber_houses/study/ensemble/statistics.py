# SPDX-License-Identifier: GPL-2.0-or-later
"""Medians, ranges and shares over the runs of an ensemble, and the run that stands for it."""
from collections import Counter
from numbers import Real

import numpy as np
import scipy  # submodules load on first use; a plain run needs none

from ...base.json_types import encode, leaves
from ...recording.verdict import STATES

CONFIDENCE = 0.95  # of the Clopper-Pearson intervals of shares
FIXED = ("scenario", "model", "sentence", "record", "versions", "made_from")
"""Entries of a summary that describe the run and its origin."""
NONE = "none"  # word for what has no value, as the time of a collapse that did not happen


def numbers(summary):
    """{path: number} of a summary, with the largest of its peak and residual drifts. Lists have no numbers."""
    own = {place: value for place, value in leaves(encode(summary))
           if isinstance(value, Real) and not isinstance(value, bool)}
    largest = {f"largest_{key}": summary.largest_drift(key)[0] for key in ("peak_drift", "residual_drift")}
    return {**largest, **own}


def words(summary):
    """{path: text} of the flags and texts among the results of a summary, NONE for what has no value."""
    results = leaves({key: value for key, value in encode(summary).items() if key not in FIXED})
    return {place: str(value).lower() if not isinstance(value, str) else value for place, value in results
            if isinstance(value, (str, bool)) or value is None}


def spread(values):
    """Number, median, quartiles (linear interpolation between ordered values) and range of some values."""
    quantiles = np.quantile(np.array(values, float), (0, 0.25, 0.5, 0.75, 1)).tolist()
    return {"runs": len(values),
            **dict(zip(("lowest", "lower_quartile", "median", "upper_quartile", "highest"), quantiles))}


def _columns(summaries, entries):
    """{path: values of all summaries that have it}. entries: function, summary -> {path: value}"""
    columns = {}
    for summary in summaries:
        for place, value in entries(summary).items():
            columns.setdefault(place, []).append(value)
    return columns


def spreads(summaries):
    """{path: spread} of every number that a summary has."""
    return {place: spread(values) for place, values in _columns(summaries, numbers).items()}


def counts(summaries):
    """{path: {text: number of runs}} of the flags and texts."""
    return {place: dict(Counter(texts)) for place, texts in _columns(summaries, words).items() if set(texts) != {NONE}}


def outcomes(summaries):
    """{verdict: number of runs} of the verdicts that occur, from the best to the worst."""
    frequency = Counter(summary.verdict for summary in summaries)
    return {state: frequency[state] for state in STATES if frequency[state]}


def share(count, runs):
    """Share of `count` of some runs, with its Clopper-Pearson interval."""
    low, high = scipy.stats.binomtest(count, runs).proportion_ci(CONFIDENCE, "exact")
    return {"runs": count, "share": count / runs, "low": float(low), "high": float(high)}


def representative(summaries):
    """Number of the run that stands for the ensemble {number: summary}: of the most frequent, then worst outcome,
    nearest to the median of the largest drift, of collapsed runs of the collapse time; the first of equal ones."""
    frequent = outcomes(summaries.values())
    outcome = max(frequent, key=lambda state: (frequent[state], STATES.index(state)))
    chosen = {number: summary for number, summary in summaries.items() if summary.verdict == outcome}
    values = {number: summary.collapse_time_s if summary.collapsed else summary.largest_drift()[0]
              for number, summary in chosen.items()}
    middle = np.median(list(values.values()))
    return min(values, key=lambda number: abs(values[number] - middle))

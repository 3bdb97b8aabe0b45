# SPDX-License-Identifier: GPL-2.0-or-later
"""Effects of factors and of their interactions on a response, with standard errors from the motions.

An effect is the mean of the cells at the factor's second level minus that at the first. The complete design is
orthogonal; for a part of its cells, effects are those of a least-squares fit, as far as the cells determine it: main
effects first, then interactions.

Two estimates of chance are made: the scatter of the motions, and the effects of the columns without a factor, which
also contain interactions of three factors. An effect stands out when it exceeds both.
"""
import math
from dataclasses import dataclass

import numpy as np

from .. import design

MAIN, INTERACTION, EMPTY = "main", "interaction", "empty"
"""Kinds of effects: of a factor, of a string of interactions, of a column without a factor."""
RESAMPLES, RESAMPLING_SEED = 2000, 0
"""Bootstrap over the motions."""
SIGNIFICANT = 2.0
"""An effect stands out beyond this many standard errors, of either estimate. [-]"""
TINY = 1e-9
"""Effects of this size are rounding errors. [of the response]"""


@dataclass(frozen=True)
class Effect:
    """kind: MAIN, INTERACTION or EMPTY; word: of its column; factors: numbers of the factors, or pairs of them.

    value, error: effect and its standard error by the motions, in the response's unit; chance: root mean square of the
    EMPTY effects, NaN without them.
    """

    kind: str
    word: str
    factors: tuple
    value: float
    error: float
    chance: float

    @property
    def significance(self):
        """Effect over the larger one of its standard errors; 0 for no effect, NaN for a single motion."""
        chance = 0.0 if math.isnan(self.chance) else self.chance
        return self.value / max(self.error, chance, TINY)

    @property
    def stands_out(self):
        return self.is_tested and abs(self.significance) > SIGNIFICANT

    @property
    def is_tested(self):
        """Whether it may stand out: it is that of a choice, it has an error, and the response is not the same in all
        cells and motions.
        """
        return self.kind != EMPTY and not math.isnan(self.error) and max(abs(self.value), self.error) > TINY


def expected_by_chance(tested):
    """Number of effects out of `tested` that stand out if all are normally distributed errors of zero mean."""
    return tested * math.erfc(SIGNIFICANT / math.sqrt(2))


def columns(count):
    """[(kind, word, factors)] of all effects that 32 cells determine, for `count` factors."""
    mains = [(MAIN, word, (k,)) for k, word in enumerate(design.words(count))]
    strings = [(INTERACTION, word, tuple(pairs)) for word, pairs in design.strings(count).items()]
    return mains + strings + [(EMPTY, word, ()) for word in design.empty_words(count)]


def effects(values, cells, count, typical):
    """List of Effect; empty when the cells do not determine the main effects.

    values   (motions, cells) response; cells with a NaN are left out
    cells    numbers of the cells
    count    number of factors
    typical  function of (values, axis) that represents the motions: mean or median
    """
    values, cells = np.asarray(values, float), np.asarray(cells, int)
    known = ~np.isnan(values).any(0)
    fitted, inverse = _fit(cells[known], columns(count))
    if not fitted:
        return []
    found = (2 * inverse @ typical(values[:, known], 0))[1:]
    errors = _errors(values[:, known], inverse, typical)[1:]
    empty = found[[kind == EMPTY for kind, _, _ in fitted]]
    chance = float(np.sqrt((empty**2).mean())) if len(empty) else math.nan
    return [Effect(*column, float(value), float(error), chance) for column, value, error in zip(fitted, found, errors)]


def _fit(cells, wanted):
    """(columns that these cells determine, (1 + columns, cells) matrix that gives mean and coefficients)."""
    basic = design.runs()[cells]
    matrix, fitted = np.ones((len(cells), 1)), []
    for kind in (MAIN, INTERACTION, EMPTY):
        more = [column for column in wanted if column[0] == kind]
        wider = np.column_stack([matrix, *(design.column(word, basic) for _, word, _ in more)])
        if len(cells) < wider.shape[1] or np.linalg.matrix_rank(wider) < wider.shape[1]:
            break
        matrix, fitted = wider, fitted + more
    return fitted, np.linalg.pinv(matrix)


def _errors(values, inverse, typical):
    """Standard errors of the effects: bootstrap over the motions, with the factor sqrt(n / (n - 1)) for small n; NaN
    for a single motion.
    """
    motions = len(values)
    if motions < 2:
        return np.full(len(inverse), np.nan)
    drawn = np.random.default_rng(RESAMPLING_SEED).integers(motions, size=(RESAMPLES, motions))
    cells = typical(values[drawn], 1)
    return 2 * (cells @ inverse.T).std(0) * np.sqrt(motions / (motions - 1))

# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""The two-level design: balance, orthogonality, resolution, strings of confounded interactions. All numbers are exact.
"""

from itertools import combinations

import numpy as np
import pytest
from timber_research import design

FACTORS = range(1, 17)


def test_size():
    assert design.MOST_FACTORS == 16 and design.RUNS == 32 and len(np.unique(design.runs(), axis=0)) == 32
    assert len(design.ODD_WORDS) + len(design.EVEN_WORDS) == 31
    for count in (0, 17):
        with pytest.raises(ValueError, match="1 to 16"):
            design.words(count)


@pytest.mark.parametrize("count", FACTORS)
def test_balanced_and_orthogonal(count):
    levels = design.levels(count)
    assert set(levels.ravel()) == {-1, 1} and not levels.sum(0).any()
    assert np.array_equal(levels.T @ levels, 32 * np.eye(count))


@pytest.mark.parametrize("count", FACTORS)
def test_main_effects_are_clear_of_two_factor_interactions(count):
    levels = design.levels(count)
    for i, j in combinations(range(count), 2):
        assert not (levels[:, i] * levels[:, j] @ levels).any()


@pytest.mark.parametrize("count", FACTORS)
def test_strings_hold_the_interactions_with_the_same_column(count):
    levels, strings = design.levels(count), design.strings(count)
    for word, pairs in strings.items():
        for i, j in pairs:
            assert np.array_equal(levels[:, i] * levels[:, j], design.column(word, design.runs()))
    assert sorted(pair for pairs in strings.values() for pair in pairs) == list(combinations(range(count), 2))


def test_the_first_half_is_of_resolution_three_and_the_second_its_fold_over():
    levels = design.levels(15)
    first, second = levels[:16], levels[16:]
    assert np.array_equal(first.T @ first, 16 * np.eye(15)) and not first.sum(0).any()
    assert {tuple(run) for run in second} == {tuple(-run) for run in first}
    assert (levels[0] == -1).all()


def test_twelve_factors_have_as_few_confounded_interactions_as_possible():
    """The best 2^(12-7) design of resolution IV has 38 words of length 4 (Chen, Sun, Wu 1993); each word confounds
    three pairs of pairs.
    """
    confounded = sum(len(pairs) * (len(pairs) - 1) // 2 for pairs in design.strings(12).values())
    assert confounded == 3 * 38 and len(design.empty_words(12)) == 4

# SPDX-License-Identifier: GPL-2.0-or-later
"""Two-level fractional factorial of resolution IV in 32 runs for up to 16 factors. Needs no YADE.

Five basic factors a to e make the 32 runs. A word is a product of basic factors; its column of the design is the
product of their columns.
The factors have the odd words, of one, three and five letters, as columns. The product of two odd words is an even
word, so that no main effect is confounded with a two-factor interaction. Interactions whose words are equal are
confounded with one another: they form a string.
The design is a 16-run design of resolution III and its fold-over, in which all levels are exchanged.
(Box, Hunter, Hunter: Statistics for Experimenters, 2nd edition, chapter 6.)
"""
from itertools import combinations, product

import numpy as np

BASIC = "abcde"
ODD_WORDS = tuple("".join(word) for length in (1, 3, 5) for word in combinations(BASIC, length))
EVEN_WORDS = tuple("".join(word) for length in (2, 4) for word in combinations(BASIC, length))
MOST_FACTORS = len(ODD_WORDS)
RUNS = 2 ** len(BASIC)
FOLD = ODD_WORDS[-1]
"""Word whose sign divides the runs into the first half and its fold-over."""


def runs():
    """(32, 5) levels -1 and +1 of the basic factors. The first 16 runs are of resolution III for up to 15 factors; run
    0 has all levels -1.
    """
    full = np.array([levels[::-1] for levels in product((-1, 1), repeat=len(BASIC))])
    return full[np.argsort(column(FOLD, full), kind="stable")]


def column(word, basic):
    """(n,) levels of a word. basic: (n, 5) levels of the basic factors."""
    return basic[:, [BASIC.index(letter) for letter in word]].prod(1)


def words(count):
    """Words of `count` factors."""
    if not 1 <= count <= MOST_FACTORS:
        raise ValueError(f"{count} factors: the design has room for 1 to {MOST_FACTORS}")
    return ODD_WORDS[:count]


def levels(count):
    """(32, count) levels -1 and +1 of the factors."""
    return np.array([column(word, runs()) for word in words(count)]).T


def times(word, other):
    """Product of two words: their common letters cancel."""
    return "".join(letter for letter in BASIC if (letter in word) != (letter in other))


def strings(count):
    """{even word: pairs (i, j) of factors whose interaction has that word}, without the words of no pair."""
    named = words(count)
    found = {word: [] for word in EVEN_WORDS}
    for i, j in combinations(range(count), 2):
        found[times(named[i], named[j])].append((i, j))
    return {word: pairs for word, pairs in found.items() if pairs}


def empty_words(count):
    """Odd words that no factor has: their columns show three-factor interactions and chance."""
    return ODD_WORDS[count:]

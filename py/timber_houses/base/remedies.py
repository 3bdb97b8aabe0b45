# SPDX-License-Identifier: GPL-2.0-or-later
"""Ends of error messages that name the remedy."""
import re
from difflib import get_close_matches

MAX_WORD = 60  # longest word that is compared with others. [characters]
_DECIMAL_COMMA = re.compile(r"[-+]?\d{1,20},\d{1,20}")


def close(word, words):
    """The word that a misspelt one is most like, whatever their case; None without one."""
    spelling = {str(each).lower(): each for each in words}
    matches = get_close_matches(str(word).lower(), spelling, 1, 0.6) if len(str(word)) <= MAX_WORD else []
    return spelling[matches[0]] if matches else None


def nearest(word, words):
    """"did you mean 'x'?" for a misspelt word, else the list of words."""
    words = list(words)
    match = close(word, words)
    return f"did you mean '{match}'?" if match else f"known: {', '.join(map(str, words))}"


def decimal_point(value):
    """Hint for a text like '2,73'."""
    comma = isinstance(value, str) and _DECIMAL_COMMA.fullmatch(value)
    return f"; write a decimal point: {value.replace(',', '.')}" if comma else ""

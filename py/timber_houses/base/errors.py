# SPDX-License-Identifier: GPL-2.0-or-later
"""Exceptions for input that cannot be used."""
from contextlib import contextmanager

MAX_MESSAGE = 900  # longest error message; the middle of a longer one is left out. [characters]


class InputError(ValueError):
    """Input that cannot be used. The message is one printable line: file:line, member, problem, range, remedy."""

    def __init__(self, message):
        super().__init__(one_line(str(message)))


class RunError(InputError):
    """A run that cannot be done as requested, or a file of a run that cannot be used."""


@contextmanager
def os_errors(message):
    """Context in which an OSError becomes a RunError. message: function of its text"""
    try:
        yield
    except OSError as problem:
        raise RunError(message(problem.strerror)) from None


@contextmanager
def located(place, kind=RunError, known=None):
    """Context in which an InputError gets a place before its message, unless that begins so or with a `known` text."""
    try:
        yield
    except InputError as problem:
        text = str(problem)
        raise kind(text if text.startswith(place if known is None else known) else f"{place}: {text}") from None


def one_line(text):
    """`text` with line breaks, control characters and lone surrogates escaped, at most MAX_MESSAGE characters long."""
    if len(text) > MAX_MESSAGE:
        text = f"{text[: MAX_MESSAGE * 2 // 3]} ... {text[-MAX_MESSAGE // 4 :]}"
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)

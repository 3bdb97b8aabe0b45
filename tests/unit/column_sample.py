# SPDX-License-Identifier: GPL-2.0-or-later
"""A column at rest on a plate, and the form of messages: for tests of misuse."""
import pytest
import yade_timber as yt
from yade import O


def column_on_plate(steps=20, joined=True, **options):
    """A column at rest on a fixed plate, joined to it: ids of plate and column."""
    O.reset()
    plate = O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    column = O.bodies.append(yt.box((0.105, 0.105, 1.0), (0, 0, 0.5)))
    O.dt, O.engines = 1e-4, yt.engines(**options)
    if joined:
        yt.connect(plate, column, [(x, y, 0) for x in (-0.05, 0.05) for y in (-0.05, 0.05)])
    O.run(steps, True)
    return plate, column


def is_one_line(error, *words):
    """Assert that the message of a caught error (pytest.ExceptionInfo) has one line, the words, and no trace of C++."""
    text = str(error.value)
    assert "\n" not in text and "C++" not in text and "Boost" not in text, text
    assert all(word in text for word in words), text


def refused(*words):
    """The next step is refused in one line with these words, and every later one."""
    for _ in range(2):
        with pytest.raises(RuntimeError) as error:
            O.step()
        is_one_line(error, *words)

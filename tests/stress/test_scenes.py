# SPDX-License-Identifier: GPL-2.0-or-later
"""200 random scenes that are not houses. Short form: tests/physics/test_scenes_short.py."""
import pytest
import scenes


@pytest.mark.parametrize("family", scenes.FAMILIES)
def test_sound(family, capsys):
    with capsys.disabled():
        print()
        verdicts = scenes.show(scenes.wanted([family]))
    scenes.expect_sound(verdicts)


def test_there_are_two_hundred():
    assert len(scenes.ALL) == 200

# SPDX-License-Identifier: GPL-2.0-or-later
"""Every attribute of every class of ours says its unit: the doc ends with [m], [-] ... and, maybe, a source in
parentheses.
"""
import re

import pytest
import yade.wrapper
import yade_timber

UNIT_AT_END = re.compile(r"\[[^\[\]]+\](\s*\(.+\))?\.?$", re.DOTALL)
MARKUP = re.compile(r":y[a-z]+:`[^`]*`|\|y[a-z]+\|")


def own_doc(doc):
    """An attribute's doc without the default, type and flags that YADE's macros add to it."""
    return MARKUP.sub("", doc or "").strip()


def undocumented(cls):
    """Names of a class's own data attributes whose doc has no unit at its end."""
    described = {
        name: item
        for name, item in vars(cls).items()
        if ":yattrtype:" in (getattr(item, "__doc__", None) or "")
    }
    return [name for name, item in described.items() if not UNIT_AT_END.search(own_doc(item.__doc__))]


@pytest.mark.parametrize("doc", ["Width. [m]", "Ratio. [-] (paper, Eq. 36)", "Load. [kN/m²] (Table 1).",
                                 "|ystatic| Size. [m] :ydefault:`1`"])
def test_accepts(doc):
    assert UNIT_AT_END.search(own_doc(doc))


@pytest.mark.parametrize("doc", ["", "Width.", "Width in m", "Width [m] of a beam.", "Width. []"])
def test_rejects(doc):
    assert not UNIT_AT_END.search(own_doc(doc))


def test_sees_a_class_without_units():
    assert "vel" in undocumented(yade.wrapper.State)  # YADE's own attributes have none


@pytest.mark.parametrize("name", sorted(yade_timber._class_names))
def test_every_attribute_has_a_unit(name):
    assert undocumented(getattr(yade.wrapper, name)) == []

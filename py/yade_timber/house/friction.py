# SPDX-License-Identifier: GPL-2.0-or-later
"""Friction of material pairs. A pair of YADE's materials has the smaller one of their own coefficients, so a description must be of that form."""

from .errors import HouseError

DEFAULT = 0.5  # [-] of a material whose pair with itself is not given


def own_coefficient(name, law, pairs):
    """Coefficient [-] of one material: that of its pair with itself; snow, which slides on others, takes the smallest of its pairs.

    law: 'timber' or 'snow'; pairs: [(material, material, coefficient)]
    """
    alone = [c for a, b, c in pairs if a == b == name] or [DEFAULT]
    return min(alone + [c for a, b, c in pairs if name in (a, b) and law == "snow"])


def check_friction(data):
    """HouseError for a pair whose coefficient is not the smaller one of the two materials' own."""
    pairs = [(*entry["between"], entry["coefficient"]) for entry in data["friction"]]
    own = {name: own_coefficient(name, material["law"], pairs) for name, material in data["materials"].items()}
    for entry, (a, b, wanted) in zip(data["friction"], pairs):
        if wanted != min(own[a], own[b]):
            raise HouseError(f"{entry.at('coefficient')}: friction of {a} and {b} is {wanted:g}, but comes out as {min(own[a], own[b]):g}: a pair has the smaller "
                             f"one of {a}'s own ({own[a]:g}) and {b}'s own ({own[b]:g}); change the pairs [{a}, {a}] and [{b}, {b}], too")

# SPDX-License-Identifier: GPL-2.0-or-later
"""Friction of material pairs. A description must have YADE's form: the smaller coefficient of both materials."""
from .errors import HouseError

DEFAULT = 0.5  # coefficient of a material whose pair with itself is not in the file, that of the class ElementMat. [-]


def own_coefficient(name, law, pairs):
    """Coefficient [-] of one material: that of its pair with itself; for snow the smallest of all its pairs. law:
    'timber' or 'snow'; pairs: [(material, material, coefficient)]"""
    alone = [c for a, b, c in pairs if a == b == name] or [DEFAULT]
    return min(alone + [c for a, b, c in pairs if name in (a, b) and law == "snow"])


def check_friction(data):
    """HouseError for a pair whose coefficient differs from the smaller one of its two materials."""
    pairs = [(*entry["between"], entry["coefficient"]) for entry in data["friction"]]
    own = {name: own_coefficient(name, material["law"], pairs) for name, material in data["materials"].items()}
    for entry, (a, b, wanted) in zip(data["friction"], pairs):
        if wanted != min(own[a], own[b]):
            raise HouseError(f"{entry.at('coefficient')}: friction of {a} and {b} is {wanted:g}; it must be"
                             f" {min(own[a], own[b]):g}, the smaller coefficient of {a} ({own[a]:g}) and {b}"
                             f" ({own[b]:g}); change the pairs [{a}, {a}] and [{b}, {b}], too")

# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of what users pass to the package's functions: argument, its value, admissible form in one line."""
import math
import numbers
import reprlib

import numpy as np
import yade.wrapper as yw
from yade.minieigenHP import Vector3

O = yw.Omega()


def shown(value):
    return " ".join(reprlib.repr(value).split())


def refuse(error, name, value, form):
    """Raise "snow: density = 'heavy': it must be a finite number [kg/m3]". name: 'snow: density'"""
    raise error(f"{name} = {shown(value)}: it must be {form}") from None


def number(name, value, unit="-"):
    """A finite real number. Ranges of attributes are checked by the classes themselves."""
    return float(_checked(name, value, numbers.Real, math.isfinite, f"a finite number [{unit}]"))


def positive(name, value, unit="-", infinite=False):
    """A number > 0; `infinite`: whether infinity is admissible."""
    form = f"a {'' if infinite else 'finite '}number > 0 [{unit}]"
    return float(_checked(name, value, numbers.Real, lambda v: v > 0 and (infinite or math.isfinite(v)), form))


def count(name, value):
    """An integer >= 0 that fits into a C++ int."""
    return int(_checked(name, value, numbers.Integral, lambda v: 0 <= v < 2**31, f"an integer from 0 to {2**31 - 1}"))


def _checked(name, value, kind, is_valid, form):
    """The value. Raises TypeError for another kind of number, ValueError for one that is not valid."""
    if not isinstance(value, kind):
        refuse(TypeError, name, value, form)
    if not is_valid(value):
        refuse(ValueError, name, value, form)
    return value


def flag(name, value):
    """True or False, 1 or 0."""
    if not isinstance(value, (bool, np.bool_, numbers.Integral)) or value not in (0, 1):
        refuse(TypeError, name, value, "True or False")
    return bool(value)


def text(name, value):
    return instance(name, value, str, "a string")


def instance(name, value, kinds, form):
    if not isinstance(value, kinds):
        refuse(TypeError, name, value, form)
    return value


def numbers_of_shape(name, value, shape, form):
    """Array of finite numbers; a length of None in `shape` stands for any length > 0."""
    try:
        array = np.array(value, float, ndmin=len(shape))
    except (TypeError, ValueError):
        refuse(TypeError, name, value, form)
    fits = array.ndim == len(shape) and all(n > 0 and m in (None, n) for n, m in zip(array.shape, shape))
    if not fits or not np.isfinite(array).all():
        refuse(ValueError, name, value, form)
    return array


def vector(name, value, unit="-"):
    """Vector3 of three finite numbers."""
    return Vector3(*numbers_of_shape(name, value, (3,), f"three finite numbers [{unit}]"))


def points(name, value, unit="m"):
    """(n, 3) array of finite numbers, n >= 1."""
    return numbers_of_shape(name, value, (None, 3), f"finite and of shape (n, 3), n >= 1 [{unit}]")


def ids_of(caller, *bodies):
    """Ids of bodies, each a Body of the scene or an id, also of an erased one. Raises ValueError."""
    ids, last = [body.id if isinstance(body, yw.Body) else body for body in bodies], len(O.bodies) - 1
    for body, number in zip(bodies, ids):
        if not isinstance(number, (int, np.integer)) or not 0 <= number <= last:
            raise ValueError(f"{caller}: there is no body {shown(number)}; bodies have the ids 0 ... {last}")
        if body is not number and O.bodies[number] != body:
            raise ValueError(f"{caller}: body {number} is not in the scene: append it to O.bodies first")
    return ids


def present_ids(caller, *bodies):
    """Ids of bodies in the scene, each given as Body or id. Raises ValueError."""
    ids = ids_of(caller, *bodies)
    for body in ids:
        if O.bodies[body] is None:
            raise ValueError(f"{caller}: body {body} was taken out")
    return ids

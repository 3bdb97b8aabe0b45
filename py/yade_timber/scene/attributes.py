# SPDX-License-Identifier: GPL-2.0-or-later
"""Assignment to attributes of the package's classes.

YADE's classes accept misspelt names in silence and keep a value that their `postLoad` has refused. `install` mends both
for the classes that it is given: unknown names are refused, and after a refused value the object is as before; numbers
are finite, unless the class's own value is not; `updateAttrs` sets what the attributes themselves would set. `guard`
extends the last two to classes of YADE."""
import difflib
import math
import re
from contextlib import contextmanager, suppress

import numpy as np
import yade.wrapper as yw
from yade.minieigenHP import Quaternion, Vector3

from .arguments import shown
from .background import between_steps, within
from .containers import LISTS

FORMS = {"Real": "a number", "int": "an integer", "long": "an integer", "bool": "True or False", "string": "a string",
         "Vector3r": "three numbers", "vector<Real>": "a list of numbers", "vector<int>": "a list of integers",
         "vector<Vector3r>": "a list of vectors"}
"""YADE's name of a type -> admissible form."""
REGISTERED = re.compile(r":yattrtype:`(.*?)`")
"""In the documentation of an attribute that is saved with the scene; other properties have none."""
CONVERSION_ERRORS = (TypeError, OverflowError)  # of Boost.Python for a value of another type
GEOMETRY = ("vertices", "radius")  # attributes of a shape that the geometry of a body follows from
VALIDATED_OF_YADE = ("density",)  # attributes of YADE's base classes on which the package's classes depend
RULED = {(yw.Body, "shape"), (yw.Body, "material"), (yw.Body, "state"), (yw.State, "angVel"), *LISTS}
"""Attributes of YADE's classes whose assignment `background` and `containers` guard."""
FINITE = (yw.State, yw.Aabb, yw.InsertionSortCollider)  # classes of YADE's own whose numbers must be finite, too
NOT_ZERO = dict.fromkeys(("ori", "refOri", "se3"), ", and the norm of a quaternion > 0")
"""Attributes that YADE divides by their norm: end of the message."""
MEASURED = ("rows",)  # attributes that a monitor fills: in a scene that fails, they are not finite
_own = set()
_update_attributes = yw.Serializable.updateAttrs


def install(classes):
    """Install the rules of this module on classes of the package."""
    _own.update(classes)
    read_all = within(between_steps, yw.Serializable.dict)
    for cls in classes:
        cls.__init__, cls.__setattr__ = _initialiser(cls.__init__), _set_attribute
        cls.updateAttrs, cls.dict = _update, read_all


def guard():
    """Install them on the classes of YADE that the package depends on."""
    for cls in FINITE:
        cls.__init__, cls.__setattr__ = _initialiser(cls.__init__), _set_finite
    yw.Serializable.updateAttrs = _update_of_yade


def _set_attribute(self, name, value):
    cls = type(self)
    attribute = getattr(cls, name, None)
    if not isinstance(attribute, property):
        if cls.__module__ != yw.__name__ or name.startswith("__"):  # a Python subclass has attributes of its own
            return object.__setattr__(self, name, value)
        raise AttributeError(_unknown(cls, name))
    _require_settable(self, name)
    with _restored(self):
        _assign(self, attribute, name, value)
        _require_finite(cls, {name: value})  # after the class's own check, which names its range


def _set_finite(self, name, value):
    _require_finite(type(self), {name: value})
    object.__setattr__(self, name, value)


def _require_finite(cls, attributes):
    """Raise ValueError for a value that is not finite, where the class's own value is."""
    for name, value in attributes.items():
        if name not in MEASURED and not _is_finite(value) and _is_finite(getattr(cls(), name, None)):
            raise ValueError(f"{cls.__name__}.{name} = {shown(value)}: it must be finite{NOT_ZERO.get(name, '')}")


def _is_finite(value):
    """Whether no number of a value is infinite or NaN, nor becomes so when YADE normalises a quaternion."""
    if isinstance(value, (float, np.floating)):
        return math.isfinite(value)
    if isinstance(value, Vector3):
        return math.isfinite(value[0]) and math.isfinite(value[1]) and math.isfinite(value[2])
    if isinstance(value, Quaternion):
        return 0 < value.norm() < math.inf
    return (not hasattr(value, "__len__") or isinstance(value, (str, dict))
            or all(_is_finite(value[k]) for k in range(len(value))))


def _require_settable(self, name):
    """Raise an error for a read-only attribute, and for a shape in the scene: boxes, contacts and mass of its body
    would remain those of the old geometry."""
    attribute = getattr(type(self), name, None)
    if isinstance(attribute, property) and attribute.fset is None:
        raise AttributeError(f"{type(self).__name__}.{name} is read-only")
    for body in yw.Omega().bodies if name in GEOMETRY and isinstance(self, yw.RoundedPolyhedron) else ():
        if body.shape == self:
            raise ValueError(f"RoundedPolyhedron.{name}: the shape of body {body.id} in the scene; assign another shape"
                             " to the body")


def _assign(self, attribute, name, value):
    """Set an attribute, then have the object validated: not all setters of YADE do so."""
    try:
        attribute.fset(self, value)
    except CONVERSION_ERRORS:
        raise TypeError(_wrong_type(type(self), attribute, name, value)) from None
    owner = next(c for c in type(self).__mro__ if name in vars(c))
    if name in VALIDATED_OF_YADE or (owner in _own and REGISTERED.search(attribute.__doc__ or "")):
        _update_attributes(self, {name: attribute.fget(self)})


def _update(self, attributes):
    """Update object attributes from given dictionary"""
    for name in attributes:
        _require_settable(self, name)
    cls = type(self)
    with _restored(self), _named_errors(cls, attributes):
        _update_attributes(self, attributes)
        _require_finite(cls, attributes)


def _update_of_yade(self, attributes):
    """Update object attributes from given dictionary"""
    if isinstance(self, FINITE):
        _require_finite(type(self), attributes)
    ruled = {name: value for name, value in attributes.items() if (type(self), name) in RULED}
    if isinstance(self, yw.Body) and "id" in attributes:
        raise AttributeError("Body.id is read-only")
    _update_attributes(self, {name: value for name, value in attributes.items() if name not in ruled})
    for name, value in ruled.items():
        setattr(self, name, value)


@contextmanager
def _restored(target):
    """Context between two steps: an exception leaves the object's attributes as they were."""
    with between_steps():
        before = target.dict()
        try:
            yield
        except BaseException:
            with suppress(ValueError):  # not complete before, either; its attributes are set all the same
                _update_attributes(target, before)
            raise


def _initialiser(construct):
    """Constructor whose errors name the keyword."""

    def __init__(self, *args, **attributes):
        with _named_errors(type(self), attributes):
            construct(self, *args, **attributes)
            _require_finite(type(self), attributes)

    return __init__


@contextmanager
def _named_errors(cls, attributes):
    """Context for setting attributes: errors of YADE and Boost name the attribute and its admissible form."""
    try:
        yield
    except (AttributeError, *CONVERSION_ERRORS):
        for name, value in attributes.items():
            _check_keyword(cls, name, value)
        raise


def _check_keyword(cls, name, value):
    """Raise an error that names a keyword if it is unknown or its value has another type than its attribute."""
    attribute = getattr(cls, name, None)
    if not isinstance(attribute, property):
        raise AttributeError(_unknown(cls, name)) from None
    try:
        with suppress(ValueError):  # of the right type
            _update_attributes(cls(), {name: value})
    except CONVERSION_ERRORS:
        raise TypeError(_wrong_type(cls, attribute, name, value)) from None


def _unknown(cls, name):
    """Message about a name that a class does not have."""
    attributes = [k for k in dir(cls) if isinstance(getattr(cls, k, None), property) and not k.startswith("_")]
    near = difflib.get_close_matches(name, attributes, 1, 0.5)
    remedy = f"did you mean {near[0]}?" if near else f"it has {', '.join(attributes)}"
    return f"{cls.__name__} has no attribute {name}; {remedy}"


def _wrong_type(cls, attribute, name, value):
    match = REGISTERED.search(attribute.__doc__ or "")
    kind = match.group(1).strip() if match else "value"
    return f"{cls.__name__}.{name} = {shown(value)}: it must be {FORMS.get(kind, f'a {kind}')}"

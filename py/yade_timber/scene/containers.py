# SPDX-License-Identifier: GPL-2.0-or-later
"""Lists of engines and functors, bodies and interactions of YADE.

YADE ends the process at None in a list. `guard` refuses it. A body that is erased takes its joints with it at once:
another body may get its id before the next step, or the scene may be saved. An interaction that is erased begins anew
as one of bodies that are placed."""
from functools import wraps

import yade.wrapper as yw

from ..plugin import compiled

FUNCTORS = (yw.BoundDispatcher, yw.IGeomDispatcher, yw.IPhysDispatcher, yw.LawDispatcher)
LISTS = ((yw.Omega, "engines"), (yw.ParallelEngine, "slaves"),
         (yw.InteractionLoop, "callbacks"), *((cls, "functors") for cls in FUNCTORS))
"""Class and attribute, a list without None, also inside its lists."""
BUILT_FROM_LISTS = (*FUNCTORS, yw.Collider, yw.InteractionLoop, yw.ParallelEngine)
"""Classes whose constructors, and those of classes derived from them, take such lists."""
FILLING = ("append", "appendClumped", "insertAtId", "replace")  # methods of O.bodies that take bodies
O = yw.Omega()


def guard():
    """Install the rules of this module on YADE's classes."""
    for owner, name in LISTS:
        setattr(owner, name, _without_none(f"{'O' if owner is yw.Omega else owner.__name__}.{name}",
                                           getattr(owner, name)))
    classes = [cls for cls in vars(yw).values() if isinstance(cls, type) and issubclass(cls, BUILT_FROM_LISTS)]
    for cls in classes:
        setattr(cls, "__init__", _checked(cls.__name__, getattr(cls, "__init__")))
    for method in filter(lambda method: hasattr(yw.BodyContainer, method), FILLING):
        setattr(yw.BodyContainer, method, _checked(f"O.bodies.{method}", getattr(yw.BodyContainer, method), alone=True))
    yw.BodyContainer.erase = _followed_by(_break_joints, yw.BodyContainer.erase)
    yw.InteractionContainer.erase = _followed_by(_begin_anew, yw.InteractionContainer.erase)
    yw.InteractionContainer.clear = _followed_by(_begin_anew, yw.InteractionContainer.clear)


def require_objects(name, value):
    """Raise ValueError for None in a list, or in a list in it."""
    if not isinstance(value, (list, tuple)):
        return
    for k, one in enumerate(value):
        if one is None:
            raise ValueError(f"{name}[{k}] = None: it must be an object")
        require_objects(f"{name}[{k}]", one)


def _without_none(name, part):
    def set_list(owner, value):
        require_objects(name, value)
        part.fset(owner, value)

    return property(part.fget, set_list, doc=part.__doc__)


def _checked(name, function, alone=False):
    """Constructor or method whose arguments are checked. alone: None is no argument itself, either."""

    @wraps(function)
    def call(self, *args, **options):
        for value in (*args, *options.values()):
            require_objects(name, [value] if alone else value)
        return function(self, *args, **options)

    return call


def _followed_by(consequence, function):
    """Method of a container after which a function is called with its result and its arguments."""

    @wraps(function)
    def call(container, *args, **options):
        result = function(container, *args, **options)
        consequence(result, *args, *options.values())
        return result

    return call


def _break_joints(erased, body, *_):
    if erased:
        compiled.break_joints_of(body)


def _begin_anew(_, *pair):
    """Begin the contacts of two bodies anew, or of all bodies."""
    for body in pair or range(len(O.bodies)):
        compiled.begin_contacts_anew(body)

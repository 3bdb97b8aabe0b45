# SPDX-License-Identifier: GPL-2.0-or-later
"""Lists of engines and functors, bodies and interactions of YADE.

YADE ends the process at None in a list. `guard` refuses it. A body that is erased takes its joints with it at once:
another body may get its id before the next step, or the scene may be saved. An interaction that is erased begins anew
as one of bodies that are placed.
"""
import yade.wrapper as yw

from ..plugin import compiled

FUNCTORS = (yw.BoundDispatcher, yw.IGeomDispatcher, yw.IPhysDispatcher, yw.LawDispatcher)
LISTS = ((yw.Omega, "engines"), (yw.ParallelEngine, "slaves"),
         (yw.InteractionLoop, "callbacks"), *((cls, "functors") for cls in FUNCTORS))
"""Class and attribute, a list without None, also inside its lists."""
BUILT_FROM_LISTS = (*FUNCTORS, yw.Collider, yw.InteractionLoop, yw.ParallelEngine)
"""Classes whose constructors, and those of classes derived from them, take such lists."""
FILLED = (("bodies", yw.BodyContainer, ("append", "appendClumped", "insertAtId", "replace")),)
"""Name of a container, its class, the methods that take its objects."""
O = yw.Omega()


def guard():
    """Install the rules of this module on YADE's classes."""
    for owner, name in LISTS:
        setattr(owner, name, _without_none(f"{'O' if owner is yw.Omega else owner.__name__}.{name}",
                                           getattr(owner, name)))
    classes = [cls for cls in vars(yw).values() if isinstance(cls, type) and issubclass(cls, BUILT_FROM_LISTS)]
    for cls in classes:
        setattr(cls, "__init__", _checked(cls.__name__, getattr(cls, "__init__")))
    for name, owner, methods in FILLED:
        for method in filter(lambda method: hasattr(owner, method), methods):
            setattr(owner, method, _checked(f"O.{name}.{method}", getattr(owner, method), alone=True))
    yw.BodyContainer.erase = _erase_body(yw.BodyContainer.erase)
    yw.InteractionContainer.erase = _erase_interaction(yw.InteractionContainer.erase)
    yw.InteractionContainer.clear = _clear_interactions(yw.InteractionContainer.clear)


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

    def call(self, *args, **options):
        for value in (*args, *options.values()):
            require_objects(name, [value] if alone else value)
        return function(self, *args, **options)

    call.__name__, call.__doc__ = function.__name__, function.__doc__
    return call


def _erase_body(erase):

    def call(bodies, id, *args, **options):
        erased = erase(bodies, id, *args, **options)
        if erased:
            compiled.break_joints_of(id)
        return erased

    call.__name__, call.__doc__ = "erase", erase.__doc__
    return call


def _erase_interaction(erase):

    def call(interactions, id1, id2):
        erase(interactions, id1, id2)
        for body in (id1, id2):
            compiled.begin_contacts_anew(body)

    call.__name__, call.__doc__ = "erase", erase.__doc__
    return call


def _clear_interactions(clear):

    def call(interactions):
        clear(interactions)
        for body in range(len(O.bodies)):
            compiled.begin_contacts_anew(body)

    call.__name__, call.__doc__ = "clear", clear.__doc__
    return call

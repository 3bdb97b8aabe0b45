# SPDX-License-Identifier: GPL-2.0-or-later
"""Changes to a scene while YADE computes it in the background.

YADE's containers are not locked: a body that is erased within a step ends the process. A scene that is replaced within
a step blocks it for ever if the step runs Python code. `O.pause()` returns before the step ends. `guard` lets such
changes wait for the end of the step. It also refuses a body's shape, material or state that the package's engines
cannot deal with.
"""
import threading
from contextlib import contextmanager

import yade.wrapper as yw
from yade.minieigenHP import Vector3

from ..plugin import compiled

BODY_PARTS = ("shape", "material", "state")
O = yw.Omega()


@contextmanager
def between_steps():
    """Context in which no step is computed; a run in the background goes on afterwards."""
    if _computes_steps():
        yield
        return
    limits, ended = (O.stopAtIter, O.stopAtTime), not O.running
    compiled.finish_step()
    ended = ended or limits != (O.stopAtIter, O.stopAtTime)  # the run had reached its last step
    try:
        yield
    finally:
        if not ended:
            O.run()


def _computes_steps():
    """Whether this thread computes the steps and is in a PyRunner: YADE, not Python, has started it."""
    return isinstance(threading.current_thread(), threading._DummyThread)


def _finish_step():
    """Wait for the end of the present step, unless this thread computes it."""
    if not _computes_steps():
        compiled.finish_step()


@contextmanager
def _after_step():
    """Context for methods that replace the scene: the step is done; a run in the background ends."""
    _finish_step()
    yield


@contextmanager
def _until_step():
    """Context in which `O.wait` also waits for the last step after `O.pause()`."""
    yield
    _finish_step()


@contextmanager
def _until_started():
    """Context in which `O.run` returns when the first step is done: YADE must not end a run whose thread has not
    started."""
    before = O.iter
    yield
    if not _computes_steps():
        compiled.await_step(before)


METHODS = (
    (yw.BodyContainer, between_steps, ("append", "appendClumped", "clump", "addToClump", "releaseFromClump", "erase",
                                       "insertAtId", "replace", "clear", "deleteClumpBody", "deleteClumpMember")),
    (yw.InteractionContainer, between_steps, ("erase", "eraseNonReal", "clear")),
    (yw.Omega, _after_step, ("reset", "resetThisScene", "resetCurrentScene", "resetAllScenes", "reload", "load",
                             "loadTmp", "switchScene", "switchToScene")),
    (yw.Omega, _until_step, ("wait",)),
    (yw.Omega, _until_started, ("run",)),
)
"""Class, context, methods that are called within it; which there are depends on YADE's version."""


def guard():
    """Install the rules of this module on YADE's containers and bodies."""
    for cls, context, names in METHODS:
        for name in filter(lambda name: hasattr(cls, name), names):
            setattr(cls, name, _within(context, getattr(cls, name)))
    for name in BODY_PARTS:
        setattr(yw.Body, name, _checked(name, getattr(yw.Body, name)))
    yw.State.angVel = _with_momentum(yw.State.angVel)


def _within(context, method):
    def call(self, *args, **options):
        with context():
            return method(self, *args, **options)

    call.__name__, call.__doc__ = method.__name__, method.__doc__
    return call


def _checked(name, part):
    """Property of a body that is set between two steps; elements keep their part if the new one is refused."""

    def set_part(body, value):
        with between_steps():
            before = part.fget(body)
            is_element = isinstance(body.shape, yw.RoundedPolyhedron)
            part.fset(body, value)
            if is_element and body.id >= 0:
                try:
                    _check(body, name, before)
                except (RuntimeError, ValueError) as error:
                    part.fset(body, before)
                    raise ValueError(str(error)) from None

    return property(part.fget, set_part, doc=part.__doc__)


def _with_momentum(part):
    """Property angVel of a state whose angular momentum, which the integrator uses, follows when it is set."""

    def set_velocity(state, value):
        with between_steps():
            part.fset(state, value)
            local = state.ori.conjugate() * state.angVel
            state.angMom = state.ori * Vector3(*(v * i for v, i in zip(local, state.inertia)))

    return property(part.fget, set_velocity, doc=part.__doc__)


def _check(body, name, before):
    """Raise an error if an element of the scene cannot be computed with its new part. before: the old one."""
    if body.shape is None:
        raise ValueError(f"body {body.id}: shape None: it must be a shape; O.bodies.erase({body.id}) takes the body"
                         " out")
    compiled.check_replaced_part(body)
    if name == "shape" or (name == "material" and type(body.material) is not type(before)):  # other functors
        for interaction in body.intrs():
            O.interactions.erase(interaction.id1, interaction.id2)

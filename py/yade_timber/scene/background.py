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

BODY_METHODS = ("append", "appendClumped", "clump", "addToClump", "releaseFromClump", "erase", "insertAtId", "replace",
                "clear", "deleteClumpBody", "deleteClumpMember")
INTERACTION_METHODS = ("erase", "eraseNonReal", "clear")
SCENE_METHODS = ("reset", "resetThisScene", "resetCurrentScene", "resetAllScenes", "reload", "load", "loadTmp",
                 "switchScene", "switchToScene")
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


def guard():
    """Install the rules of this module on YADE's containers and bodies."""
    for container, methods in ((yw.BodyContainer, BODY_METHODS), (yw.InteractionContainer, INTERACTION_METHODS)):
        for name in methods:
            if hasattr(container, name):  # it depends on YADE's version
                setattr(container, name, _deferred(getattr(container, name)))
    for name in SCENE_METHODS:
        if hasattr(yw.Omega, name):
            setattr(yw.Omega, name, _after_step(getattr(yw.Omega, name)))
    yw.Omega.wait = _until_step(yw.Omega.wait)
    yw.Omega.run = _until_started(yw.Omega.run)
    for name in BODY_PARTS:
        setattr(yw.Body, name, _checked(name, getattr(yw.Body, name)))
    yw.State.angVel = _with_momentum(yw.State.angVel)


def _deferred(method):
    """A container's method, called between two steps."""

    def call(self, *args, **options):
        with between_steps():
            return method(self, *args, **options)

    call.__name__, call.__doc__ = method.__name__, method.__doc__
    return call


def _after_step(method):
    """A method of Omega that replaces the scene, called when the step is done; a run in the background ends."""

    def call(self, *args, **options):
        if not _computes_steps():
            compiled.finish_step()
        return method(self, *args, **options)

    call.__name__, call.__doc__ = method.__name__, method.__doc__
    return call


def _until_step(wait):
    """`O.wait` that also waits for the last step after `O.pause()`."""

    def call(self):
        wait(self)
        if not _computes_steps():
            compiled.finish_step()

    call.__name__, call.__doc__ = wait.__name__, wait.__doc__
    return call


def _until_started(run):
    """`O.run` that returns when the first step is done: YADE must not end a run whose thread has not started."""

    def call(self, *args, **options):
        before = self.iter
        run(self, *args, **options)
        if not _computes_steps():
            compiled.await_step(before)

    call.__name__, call.__doc__ = run.__name__, run.__doc__
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

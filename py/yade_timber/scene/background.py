# SPDX-License-Identifier: GPL-2.0-or-later
"""Changes and queries of a scene while YADE computes it in the background.

YADE's containers and the lists of the engines are not locked: a body that is erased, or a list that is read, within a
step ends the process. A scene that is replaced within a step blocks it for ever if the step runs Python code.
`O.pause()` returns before the step ends. `install` lets what OWN lists wait for the end of the step, `guard` what YADES
lists. `guard` also refuses a body's shape, material or state that the package's engines cannot deal with.

Threads take turns to start, interrupt and await a run: what is guarded waits while another thread is in `O.wait()`."""
import threading
from contextlib import contextmanager
from functools import wraps

import yade.wrapper as yw
from yade.minieigenHP import Vector3

from ..plugin import compiled

BODY_PARTS = ("shape", "material", "state")
O = yw.Omega()
_turn = threading.RLock()
_pauses = 0  # number of calls of `O.pause`, counted after `guard`. [-]


@contextmanager
def between_steps():
    """Context in which no step is computed; a run in the background goes on afterwards."""
    if _computes_steps():
        yield
        return
    with _turn:
        pauses, limits = _pauses, (O.stopAtIter, O.stopAtTime)
        # the last step changes the limits, and one that failed was not left
        goes_on = compiled.finish_step() and limits == (O.stopAtIter, O.stopAtTime) and O.subStep < 0
        try:
            yield
        finally:
            if goes_on and pauses == _pauses:
                O.run()


def _computes_steps():
    """Whether this thread computes the steps and is in a PyRunner: YADE, not Python, has started it."""
    return isinstance(threading.current_thread(), threading._DummyThread)


@contextmanager
def _after_step():
    """Context for methods that replace the scene: the step is done; a run in the background ends."""
    with _turn:
        compiled.finish_step()
        yield


@contextmanager
def _until_step():
    """Context in which `O.wait` also waits for the last step after `O.pause()`."""
    with _turn:
        yield
        compiled.finish_step()


@contextmanager
def _until_started():
    """Context in which `O.run` returns when the first step is done: YADE must not end a run whose thread has not
    started."""
    with _turn:
        before = O.iter
        yield
        compiled.await_step(before)


YADES = (
    (yw.BodyContainer, between_steps, ("append", "appendClumped", "clump", "addToClump", "releaseFromClump", "erase",
                                       "insertAtId", "replace", "clear", "deleteClumpBody", "deleteClumpMember")),
    (yw.InteractionContainer, between_steps, ("erase", "eraseNonReal", "clear")),
    (yw.Omega, _after_step, ("reset", "resetThisScene", "resetCurrentScene", "resetAllScenes", "reload", "load",
                             "loadTmp", "stringToScene", "switchScene", "switchToScene")),
    (yw.Omega, between_steps, ("save", "saveTmp", "sceneToString")),
    (yw.Omega, _until_step, ("wait",)),
    (yw.Omega, _until_started, ("run",)),
    (yw.Serializable, between_steps, ("dict",)),
)
OWN = (
    (yw.ContactForces, between_steps, ("largestEigenvalue",)),
    (yw.HealthCheck, between_steps, ("check",)),
    (yw.Sampler, between_steps, ("axes", "load", "opening", "peaks", "pull", "rows", "shear", "take")),
    (yw.JointEngine, between_steps, ("append", "breaks", "joints")),
    (yw.TimberJoint, between_steps, ("broken", "cycles", "forces", "largestStretches", "load", "plasticStretches",
                                     "springs", "stretches")),
    (yw.ManifoldGeom, between_steps, ("points",)),
    (yw.ManifoldPhys, between_steps, ("points",)),
    (compiled, between_steps, ("created_energy", "dashpot_power", "energy", "packed_contacts", "packed_joints",
                               "packed_placements", "packed_springs")),
)
"""Class or module, context, its methods and attributes that are called and read within it; which there are of YADE's
depends on its version."""


def install():
    """Install the rules of this module on the package's classes."""
    _wrap(OWN)


def guard():
    """Install them on YADE's containers and bodies."""
    _wrap(YADES)
    for name in BODY_PARTS:
        setattr(yw.Body, name, _checked(name, getattr(yw.Body, name)))
    yw.State.angVel = _with_momentum(yw.State.angVel)
    engines = yw.Omega.engines
    yw.Omega.engines = property(engines.fget, within(between_steps, engines.fset), doc=engines.__doc__)
    yw.Omega.pause = _counted(yw.Omega.pause)


def _wrap(table):
    for owner, context, names in table:
        for name in filter(lambda name: hasattr(owner, name), names):
            setattr(owner, name, within(context, getattr(owner, name)))


def within(context, part):
    """A function, or a property with its getter, that waits within a context, but not in the thread of the steps."""
    if isinstance(part, property):
        return property(within(context, part.fget), part.fset, doc=part.__doc__)

    @wraps(part)
    def call(*args, **options):
        if _computes_steps():
            return part(*args, **options)
        with context():
            return part(*args, **options)

    return call


def _counted(pause):
    """`O.pause`, after which no run goes on that `between_steps` has interrupted."""

    @wraps(pause)
    def call(omega):
        global _pauses
        pause(omega)
        _pauses += 1

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


def follow_velocity(state):
    """Set the angular momentum of a state, which the integrator uses, to that of its angular velocity."""
    local = state.ori.conjugate() * state.angVel
    state.angMom = state.ori * Vector3(*(v * i for v, i in zip(local, state.inertia)))


def _with_momentum(part):
    """Property angVel of a state whose angular momentum follows when it is set."""

    def set_velocity(state, value):
        with between_steps():
            part.fset(state, value)
            follow_velocity(state)

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

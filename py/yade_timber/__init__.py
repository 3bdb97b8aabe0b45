# SPDX-License-Identifier: GPL-2.0-or-later
"""Timber-frame houses as rounded convex polyhedra in YADE.

    import yade_timber as yt
    run = yt.run(yt.house("C2"), motion="shipped", snow=1.0)
    run.drift, run.broken, run.player()

houses      house, House
motions     motion
runs        run
recordings  load_run, RunResult

In a YADE session only:

bodies      box, polyhedron, timber, snow, set_velocity
joints      connect, SlipLaw
engines     engines, stable_dt
queries     contacts, energy, energy_residual, export_scene
classes     the compiled ones: TimberMat, HouseMonitor, ...

`help(yt.box)` describes one of them. Guides: docs/python.md, docs/scenes.md.
"""
from . import host as _host
from . import house, motion, run
from .api.house import House
from .api.motion import ground_motion as _ground_motion
from .api.result import RunResult, load_run  # noqa: F401
from .api.run import run as _run
from .base.callable_package import make_callable as _make_callable

__version__ = "0.1.0"

for _package, _function in ((house, House), (motion, _ground_motion), (run, _run)):
    _make_callable(_package, _function)

EVERYWHERE = ("House", "RunResult", "house", "load_run", "motion", "run")
IN_YADE = ("SlipLaw", "box", "connect", "contacts", "energy", "energy_residual", "engines", "export_scene",
           "polyhedron", "set_velocity", "snow", "stable_dt", "timber")
"""Names that need a YADE session. There is no __all__: help() would print each of these functions in full."""
_class_names = ()

if _host.running():
    import yade.wrapper as _wrapper

    if not _host.has_prompt():
        _host.close_servers()
    from .plugin import class_names as _class_names

    _classes = {_name: getattr(_wrapper, _name) for _name in _class_names}
    globals().update(_classes)

    from .scene import attributes as _attributes, background as _background, containers as _containers, shown as _shown

    _containers.guard()
    _background.guard()
    _attributes.guard(_classes.values())
    _shown.install(_classes.values())

    from .scene.bodies import box, polyhedron, set_velocity, snow, timber  # noqa: E402,F401
    from .scene.engines import engines  # noqa: E402,F401
    from .scene.export import export_scene  # noqa: E402,F401
    from .scene.joints import SlipLaw, connect  # noqa: E402,F401
    from .scene.queries import contacts, energy, energy_residual, stable_dt  # noqa: E402,F401


def __dir__():
    return [*EVERYWHERE, *(IN_YADE if _host.running() else ()), *_class_names]


def __getattr__(name):
    """A useful message for the names that need a YADE session."""
    if name in IN_YADE:
        raise AttributeError(f"yade_timber.{name} needs YADE: import yade_timber in a YADE session, or start the script"
                             " with `yade -n -x script.py`")
    raise AttributeError(f"module 'yade_timber' has no attribute '{name}'")

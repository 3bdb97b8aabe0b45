# SPDX-License-Identifier: GPL-2.0-or-later
"""Rounded convex polyhedra, timber and snow contact laws, and breakable joints for any YADE session.

    import yade_timber as yt
    plate = O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
    O.dt, O.engines = 1e-4, yt.engines()

bodies      box, polyhedron, timber, snow, set_velocity
joints      connect, SlipLaw
engines     engines, stable_dt
queries     contacts, energy, energy_residual, export_scene, record
session     guard
classes     the compiled ones: TimberMat, Sampler, ...

The import registers the classes and changes nothing else of the session. `guard()` protects a scene that runs in the
background. `help(yt.box)` describes a function. Guide: docs/scenes.md. Houses: `import timber_houses`."""
from . import host as _host

__version__ = "0.2.0"

IN_YADE = ("SlipLaw", "box", "connect", "contacts", "energy", "energy_residual", "engines", "export_scene", "guard",
           "polyhedron", "record", "set_velocity", "snow", "stable_dt", "timber")
"""Names that need a YADE session. There is no __all__: help() would print each of these functions in full."""
_class_names: list[str] = []

if _host.running():
    import yade.wrapper as _wrapper

    from .plugin import class_names as _class_names

    _classes = {_name: getattr(_wrapper, _name) for _name in _class_names}
    globals().update(_classes)

    from .scene import attributes as _attributes, background as _background, shown as _shown

    _background.install()
    _attributes.install(_classes.values())
    _shown.install(_classes.values())

    from .scene.bodies import box, polyhedron, set_velocity, snow, timber  # noqa: E402,F401
    from .scene.engines import engines  # noqa: E402,F401
    from .scene.export import export_scene  # noqa: E402,F401
    from .scene.joints import SlipLaw, connect  # noqa: E402,F401
    from .scene.protection import guard  # noqa: E402,F401
    from .scene.queries import contacts, energy, energy_residual, stable_dt  # noqa: E402,F401
    from .scene.record import record  # noqa: E402,F401


def __dir__():
    return [*(IN_YADE if _host.running() else ()), *_class_names]


def __getattr__(name):
    """A useful message for the names that need a YADE session."""
    if name in IN_YADE:
        raise AttributeError(f"yade_timber.{name} needs YADE: import yade_timber in a YADE session, or start the script"
                             " with `yade -n -x script.py`")
    raise AttributeError(f"module 'yade_timber' has no attribute '{name}'")

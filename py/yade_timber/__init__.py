# SPDX-License-Identifier: GPL-2.0-or-later
"""Timber-frame houses as rounded convex polyhedra in YADE.

Inside a YADE session the import loads the compiled classes and re-exports them; elsewhere the parts that need no YADE
(ground motion, house description) still import.
"""
from . import host as _host

if _host.running():
    import yade.wrapper as _wrapper

    _plugin, _class_names = _host.load(__name__, __path__[0])
    _classes = {_name: getattr(_wrapper, _name) for _name in _class_names}
    globals().update(_classes)

    from .scene import attributes as _attributes, background as _background  # noqa: E402

    _background.guard(_plugin)
    _attributes.guard(_classes.values())

    from .scene.bodies import box, polyhedron, set_velocity, snow, timber  # noqa: E402,F401
    from .scene.engines import engines  # noqa: E402,F401
    from .scene.export import export_scene  # noqa: E402,F401
    from .scene.joints import SlipLaw, connect  # noqa: E402,F401
    from .scene.queries import contacts, energy, energy_residual, stable_dt  # noqa: E402,F401

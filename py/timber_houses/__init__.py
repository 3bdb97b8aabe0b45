# SPDX-License-Identifier: GPL-2.0-or-later
"""Timber-frame houses under earthquakes and snow, on the plugin yade_timber.

    import timber_houses as th
    run = th.run(th.house("C2"), motion="shipped", snow=1.0)
    run.drift, run.broken, run.player()

houses      house, House
motions     motion
runs        run (in a YADE session only)
recordings  load_run, RunResult

`help(th.run)` describes one of them. Guide: docs/python.md. Scenes of your own: `import yade_timber`."""
from inspect import signature as _signature
from types import ModuleType as _ModuleType

from yade_timber import __version__  # noqa: F401

from . import house, motion, run
from .api.house import House
from .api.motion import ground_motion as _ground_motion
from .api.result import RunResult, load_run  # noqa: F401
from .api.run import run as _run


class _Callable(_ModuleType):
    """A package that is called like a function: `run("C2")` runs a house, `run.cli` is a module."""

    def __call__(self, *arguments, **options):
        return self._function(*arguments, **options)


for _package, _function in ((house, House), (motion, _ground_motion), (run, _run)):
    _package.__class__ = _Callable
    vars(_package).update(_function=_function, __doc__=_function.__doc__, __signature__=_signature(_function))


def __dir__():
    return ["House", "RunResult", "house", "load_run", "motion", "run"]

# SPDX-License-Identifier: GPL-2.0-or-later
"""Packages that can be called: `timber_houses.run("C2")` runs a house, `timber_houses.run.cli` is a module."""
import inspect
from types import ModuleType


class CallablePackage(ModuleType):
    """A package with the call, the signature and the documentation of a function."""

    def __call__(self, *arguments, **options):
        return self._function(*arguments, **options)


def make_callable(package, function):
    """Let calls of a package go to a function."""
    package.__class__ = CallablePackage
    package._function, package.__doc__, package.__signature__ = function, function.__doc__, inspect.signature(function)

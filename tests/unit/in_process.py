# SPDX-License-Identifier: GPL-2.0-or-later
"""Python scripts run in the process of the test, which saves the start of an interpreter for each."""
import io
import runpy
import subprocess
import sys
import warnings
from contextlib import redirect_stderr, redirect_stdout
from unittest import mock

SHOWN = UserWarning, RuntimeWarning
"""Kinds of warnings that a process prints; here they are errors."""


def run(script, *arguments):
    """CompletedProcess of a script, which finds no other program."""
    argv, out, err, code = [str(script), *map(str, arguments)], io.StringIO(), io.StringIO(), None
    path = [str(script.parent), *sys.path]
    with (mock.patch.multiple(sys, argv=argv, path=path), mock.patch.dict(
            "os.environ", PATH=""), warnings.catch_warnings(), redirect_stdout(out), redirect_stderr(err)):
        for kind in SHOWN:
            warnings.simplefilter("error", kind)
        try:
            runpy.run_path(argv[0], run_name="__main__")
        except SystemExit as end:
            code = end.code
    if isinstance(code, str):
        print(code, file=err)
        code = 1
    return subprocess.CompletedProcess(argv, code or 0, out.getvalue(), err.getvalue())

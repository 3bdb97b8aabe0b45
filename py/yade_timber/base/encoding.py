# SPDX-License-Identifier: GPL-2.0-or-later
"""Paths and output in any encoding: names of files are bytes, and a terminal may have ASCII only."""
import os
import sys
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def encodable(path):
    """Path of the same file that has an encoding, for YADE: through a descriptor of its folder if need be."""
    path = Path(path)
    if str(path).isprintable():  # lone surrogates, which stand for undecodable bytes, are not
        yield str(path)
        return
    folder = os.open(path.parent, os.O_RDONLY | os.O_DIRECTORY)
    try:
        yield f"/proc/self/fd/{folder}/{path.name}"
    finally:
        os.close(folder)


def print_anything():
    """Let print() write letters that the terminal's encoding lacks as escapes, instead of ending with an error."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")

# SPDX-License-Identifier: GPL-2.0-or-later
"""Output in any encoding: a terminal may have ASCII only."""
import sys


def print_anything():
    """Let print() write letters that the terminal's encoding lacks as escapes, instead of ending with an error."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")

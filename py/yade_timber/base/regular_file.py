# SPDX-License-Identifier: GPL-2.0-or-later
"""Refusal of pipes, devices and folders, which would block or fill the memory when read. Needs no YADE."""
import stat
from pathlib import Path

from .errors import RunError


def require_regular(path, remedy=""):
    """Raise RunError unless `path` is a regular file, or a link to one. remedy: end of the message for a missing file."""
    try:
        mode = Path(path).stat().st_mode
    except FileNotFoundError:
        raise RunError(f"{path}: no such file{remedy and f'; {remedy}'}") from None
    except OSError as problem:
        raise RunError(f"{path}: cannot be read: {problem.strerror}") from None
    if not stat.S_ISREG(mode):
        raise RunError(f"{path}: not a regular file")

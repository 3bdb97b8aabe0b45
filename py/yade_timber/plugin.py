# SPDX-License-Identifier: GPL-2.0-or-later
"""The compiled module, checked and loaded in a YADE session, and the names of the YADE classes that it registers."""
from pathlib import Path

from . import host

compiled, class_names = host.load(__package__, Path(__file__).parent)

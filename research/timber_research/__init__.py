# SPDX-License-Identifier: GPL-2.0-or-later
"""What was studied with the package and is not installed with it: the paper's claims, and designed variants of the
houses. Needs no YADE.

claims -> report -> comparison; claims, design, factors -> screening; claims, screening -> two_ensembles
"""
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"
"""Folder of the run scripts."""

sys.path.append(str(ROOT / "py"))  # after the installed package, which the runs use

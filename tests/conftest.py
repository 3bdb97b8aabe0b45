# SPDX-License-Identifier: GPL-2.0-or-later
"""Folders whose modules tests import, after PYTHONPATH."""
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("py", "tests", "tests/physics", "tests/stress", "scripts/bench", "scripts/study", "scripts/validation")
sys.path += [str(ROOT / folder) for folder in FOLDERS]

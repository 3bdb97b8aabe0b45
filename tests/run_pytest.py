# SPDX-License-Identifier: GPL-2.0-or-later
"""Run one pytest file and exit with pytest's code: `yade -n -x run_pytest.py [--rare] FILE`, or with a plain Python.

Tests marked `pytest.mark.rare`, further cases of a rule that others check, run with --rare, and then alone.

A file in which pytest finds nothing to run (its exit code 5) counts as a failure, too.
"""
import os
import sys

import pytest

sys.stdout.flush()
code = int(pytest.main([sys.argv[-1], "-q", "-ra", "-p", "no:cacheprovider",
                        f"--rootdir={os.path.dirname(os.path.abspath(__file__))}", "-o",
                        "markers=rare: on request, label stress", "-m", "rare" if "--rare" in sys.argv
                        else "not rare"]))
sys.stdout.flush()
sys.exit(code)

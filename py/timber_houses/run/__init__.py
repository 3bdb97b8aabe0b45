# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs: command line, steps, checkpoint, summary."""

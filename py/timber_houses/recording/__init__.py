# SPDX-License-Identifier: GPL-2.0-or-later
"""Recordings of runs, from files alone: frames, tables over time, drift, damage, events, verdicts and sentences."""

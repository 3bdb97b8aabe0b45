# SPDX-License-Identifier: GPL-2.0-or-later
"""Recordings of runs, from files alone: frames, history, drift, damage, events, and sentences about them. Needs no YADE."""

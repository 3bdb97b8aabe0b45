# SPDX-License-Identifier: GPL-2.0-or-later
"""Ranking of strengthening measures: candidates, motions, paired tests, successive halving, overview."""

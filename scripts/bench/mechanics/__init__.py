# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes of rigid bodies with a known answer, run in several programs: docs/mechanics.md."""

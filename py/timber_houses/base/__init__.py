# SPDX-License-Identifier: GPL-2.0-or-later
"""Helpers without physics, for all rooms: complete files, tables, locks, errors, colours, limits of the time step."""

# SPDX-License-Identifier: GPL-2.0-or-later
"""Helpers without physics: whole files, locks, errors, colours. Needs no YADE."""

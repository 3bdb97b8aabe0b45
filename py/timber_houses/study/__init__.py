# SPDX-License-Identifier: GPL-2.0-or-later
"""Studies: many runs of a scenario, of a table, of variants of a house."""

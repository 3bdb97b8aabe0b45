# SPDX-License-Identifier: GPL-2.0-or-later
"""The package as users see it: houses, motions and runs as Python objects over the functions that the scripts use."""

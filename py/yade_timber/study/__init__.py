# SPDX-License-Identifier: GPL-2.0-or-later
"""Studies: claims of the paper, designed variants of the houses, batches of runs. Needs no YADE."""

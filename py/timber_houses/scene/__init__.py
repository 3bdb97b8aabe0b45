# SPDX-License-Identifier: GPL-2.0-or-later
"""Houses as scenes in YADE. Needs a running YADE."""

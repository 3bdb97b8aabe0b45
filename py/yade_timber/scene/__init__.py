# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies, joints, engines and queries of the scene in YADE. Needs a running YADE."""

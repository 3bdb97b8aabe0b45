# SPDX-License-Identifier: GPL-2.0-or-later
"""Bodies, joints, engines and scenarios in YADE. Needs a running YADE."""

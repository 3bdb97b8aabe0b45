# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that a run leaves: frames, history, events, and sentences about them. Needs no YADE."""

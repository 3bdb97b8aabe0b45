# SPDX-License-Identifier: GPL-2.0-or-later
"""Phrases for summaries and events: English, Japanese, and the lines of the report. Text is output only."""

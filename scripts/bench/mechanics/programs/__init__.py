# SPDX-License-Identifier: GPL-2.0-or-later
"""One module a program. Each has `program()`: name, version, settings, and how a scene runs."""

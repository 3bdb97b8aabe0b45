# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures, drawings and the player, made from a run's recording."""
REPORT = ("report.html", "report.pdf")
"""Files of a report."""

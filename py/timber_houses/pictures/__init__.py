# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures, drawings and the player, made from a run's recording."""
REPORT = ("report.html", "report.pdf")
"""Files of a report."""
TOWN = MAP, PAGE = ("map.png", "town.html")
"""Files of a town."""
OWNER = {"en": "owner.en.html", "ja": "owner.ja.html"}
"""{language: page for the owner of a house}"""
VERDICTS = {"undamaged": "#009E73", "repairable": "#E69F00", "unsafe": "#D55E00", "total loss": "#8C1C13",
            "collapsed": "#222222"}
"""Colours of the verdicts."""

# SPDX-License-Identifier: GPL-2.0-or-later
"""Results of a screening: responses of every cell under every motion, and their effects."""
from dataclasses import dataclass

import numpy as np

from ..factors import FACTORS
from .cells import SIGNS
from .effects import effects
from .responses import RESPONSES


@dataclass(frozen=True)
class Results:
    """cells: numbers of those with results; motions: names; values: {response: (motions, cells), NaN where a run is
    missing}.
    """

    cells: list
    motions: list
    values: dict

    @property
    def signs(self):
        """(cells, factors) levels -1 and +1."""
        return SIGNS[self.cells]

    def typical(self, name):
        """(cells,) value of a response over the motions: mean of shares, median of others; NaN where a motion is
        missing.
        """
        return RESPONSES[name].typical(self.values[name])

    def effects(self, name):
        """Effects on a response."""
        return effects(self.values[name], self.cells, len(FACTORS), RESPONSES[name].typical)


def collect(planned, summaries):
    """Results of the planned runs. summaries: of each of them, None for a run that is not done. Cells and motions
    without any result are left out.
    """
    done = [(entry, summary) for entry, summary in zip(planned, summaries, strict=True) if summary is not None]
    motions = list(dict.fromkeys(entry.motion for entry, _ in done if entry.motion))
    found = {}
    for entry, summary in done:
        for motion in [entry.motion] if entry.motion else motions:
            found.setdefault(entry.cell, {}).setdefault(motion, {})[entry.run] = summary
    cells = sorted(found)
    values = {name: _values(response, found, motions) for name, response in RESPONSES.items()}
    return Results(cells, motions, values)


def _values(response, found, motions):
    """(motions, cells) values of a response, NaN where a run is missing."""
    values = [[response.of(found[cell].get(motion, {})) for cell in sorted(found)] for motion in motions]
    return np.array(values).reshape(len(motions), len(found))

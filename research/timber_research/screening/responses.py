# SPDX-License-Identifier: GPL-2.0-or-later
"""Responses of the screening: numbers of one cell under one motion, from the summaries of its runs.

Drifts and ratios are decimal logarithms, so that effects are factors. A collapsed house counts as drift 1 and as broken
in all springs:
a run that ends at collapse says nothing about the wreck.
"""
import math
from dataclasses import dataclass

import numpy as np

from ..claims import CLAIMS, damage, judge, leaning, lost_columns, sway

LARGEST_DRIFT, SMALLEST_DRIFT = 1.0, 1e-4
"""Range of drifts in logarithms. [-]"""
LOG, SHARE, COUNT = "log10", "share", "count"
"""Kinds of responses. Over the motions, a share is averaged, others are represented by their median."""


@dataclass(frozen=True)
class Response:
    """name: of its column; title: in reports; kind: LOG, SHARE or COUNT; needs: runs; value: function of their
    summaries.
    """

    name: str
    title: str
    kind: str
    needs: tuple
    value: object

    def of(self, summaries):
        """Value [-] from {run: summary}; NaN when a run that it needs is missing."""
        if any(run not in summaries for run in self.needs):
            return math.nan
        return float(self.value(*(summaries[run] for run in self.needs)))

    def typical(self, values, axis=0):
        """Mean of shares, median of others, along an axis."""
        return (np.mean if self.kind == SHARE else np.median)(values, axis)


# --- numbers of one summary -------------------------------------------------------------------------------------------


def drift(run):
    """Largest drift of a run, 1 for a collapse. [-]"""
    return 1.0 if run.collapsed else _limited(max(sway(run, "ns"), sway(run, "ew")))


def lean(run, storey=None):
    """Residual drift of a storey, or the largest; 1 for a collapse. [-]"""
    return 1.0 if run.collapsed else _limited(leaning(run, storey))


def springs(run):
    """Broken springs, all of the house for a collapse, and 1 more, so that it has a logarithm."""
    return 1 + (4 * run.joints.total if run.collapsed else damage(run))


def _limited(value):
    return min(max(value, SMALLEST_DRIFT), LARGEST_DRIFT)


def _log_ratio(of, *arguments):
    """Function of two summaries: log10 of the ratio of `of` in the first to that in the second."""
    return lambda run, other: math.log10(of(run, *arguments) / of(other, *arguments))


def _across(across, along):
    return lambda run: math.log10(_limited(sway(run, across)) / _limited(sway(run, along)))


def _more_lost(run, other):
    return lost_columns(run) - lost_columns(other)


def _broken(kind, side):
    return lambda run: getattr(run.broken.by_place["1"][side], kind)


# --- the responses ----------------------------------------------------------------------------------------------------


def _quake(house):
    return f"model{house}_quake"


def _snow(house):
    return f"model{house}_snow"


def _all():
    houses, damaged = ("A", "B", "C", "B1", "B2", "C1", "C2"), ("B1", "B2", "C1", "C2")
    for house in houses:
        yield Response(f"falls_{house}", f"{house} falls", SHARE, (_quake(house),), lambda run: run.collapsed)
    yield Response("ns_A", "A tilts N-S", SHARE, (_quake("A"),), lambda run: run.tilt_direction == "ns")
    for house in houses:
        yield Response(f"drift_{house}", f"{house}: largest drift", LOG, (_quake(house),),
                       lambda run: math.log10(drift(run)))
    yield Response("across_B1", "B1: sway E-W / N-S", LOG, (_quake("B1"),), _across("ew", "ns"))
    yield Response("across_B2", "B2: sway N-S / E-W", LOG, (_quake("B2"),), _across("ns", "ew"))
    for one, other in (("C", "B"), ("C1", "B1"), ("C2", "B2")):
        yield Response(f"{one}_over_{other}", f"{one} / {other}: largest drift", LOG, (_quake(one), _quake(other)),
                       _log_ratio(drift))
    for house, side in (("B1", "west"), ("B2", "north")):
        for kind in ("column_beam", "brace_beam"):
            title = f"{house}, storey 1 {side}: {kind.replace('_', '-')} joints broken"
            yield Response(f"{kind}_{side}_{house}", title, COUNT, (_quake(house),), _broken(kind, side))
    for house in damaged:
        pair = (_snow(house), _quake(house))
        yield Response(f"snow_damage_{house}", f"{house}: broken springs with / without snow", LOG, pair,
                       _log_ratio(springs))
        yield Response(f"snow_lean_{house}", f"{house}: leaning with / without snow", LOG, pair, _log_ratio(lean))
        yield Response(f"snow_columns_{house}", f"{house}: more lost columns with snow", COUNT, pair, _more_lost)
    yield Response("snow_lean2_C2", "C2, storey 2: leaning with / without snow", LOG, (_snow("C2"), _quake("C2")),
                   _log_ratio(lean, "storey2"))
    for one, other in (("C1", "B1"), ("C2", "B2")):
        pair = (_snow(one), _snow(other))
        yield Response(f"snow_{one}_over_{other}", f"{one} / {other} with snow: broken springs", LOG, pair,
                       _log_ratio(springs))
    for name, (_, _, needs) in CLAIMS.items():
        yield Response(name, f"{name} holds", SHARE, needs, _holds(name, needs))
    everything = tuple(dict.fromkeys(run for _, _, needs in CLAIMS.values() for run in needs))
    yield Response("claims", "claims that hold", COUNT, everything,
                   lambda *found: sum(r.holds for r in judge(dict(zip(everything, found)))))


def _holds(name, needs):
    check = CLAIMS[name][1]
    return lambda *found: check(*found)[0]


RESPONSES = {response.name: response for response in _all()}

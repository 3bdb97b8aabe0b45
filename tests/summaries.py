# SPDX-License-Identifier: GPL-2.0-or-later
"""Summaries of runs that were never made."""
from dataclasses import is_dataclass, replace
from types import UnionType
from typing import get_origin

from timber_houses.base.json_types import types
from timber_houses.recording.summary import Summary
from timber_houses.recording.summary_parts import Record


def blank(kind):
    """Value of a type with zeros, empty texts, lists and tables, None where that is permitted."""
    if is_dataclass(kind):
        return kind(**{part.name: blank(hint) for part, hint in types(kind)})
    return None if get_origin(kind) is UnionType else (get_origin(kind) or kind)()


def sample_summary(**changes):
    """Of House A with these changes. Verdicts follow from them, the main structure from the totals."""
    empty = replace(blank(Summary), record=blank(Record) if changes.get("record") else None)
    summary = empty.changed(**{"model": "A", **changes, "structures": {}})
    main = {key: summary.largest_drift(key)[0] for key in ("peak_drift", "residual_drift")}
    main |= {"broken": summary.broken.total, "partly_broken": summary.broken.partly_broken,
             "columns_lost": summary.columns.fallen + summary.columns.loose, "collapsed": summary.collapsed}
    amplitude = summary.largest_drift("final_amplitude")[0]
    settled = not summary.still_moving or amplitude < main["residual_drift"]
    main["settled"] = settled and summary.missed_shaking is None
    structures = {"main": main, **changes.get("structures", {})}
    summary = summary.changed(structures=structures)
    return summary.changed(verdict=changes.get("verdict", summary.main.verdict))

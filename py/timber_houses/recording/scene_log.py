# SPDX-License-Identifier: GPL-2.0-or-later
"""The description of a user's scene in a log of `yt.record` (yade_timber.log), of unknown origin."""
import json

import numpy as np
from yade_timber.log import OWN_SCENE, SCENE

from ..base.errors import RunError
from ..base.json_types import require
from ..base.record_file import MAX_JSON
from . import append_log
from .table_file import KINDS

WITHOUT = {"group", "storey", "side", "sheet"}  # tables of a frames.h5 that the description does not have


def read(path, layout):
    """(title, elements, joints, records): {table: values} and the further records of the log. layout: of a frames.h5.
    Raises RunError, or an error of json or numpy, for other logs."""
    records = append_log.read(path, OWN_SCENE)
    try:
        kind, _, content = next(records, (b"", 0.0, b""))
    except RunError as problem:
        raise RunError(f"{problem}; an unfinished run is shown from its frames.h5") from None
    if kind != SCENE or len(content) > MAX_JSON:
        raise ValueError("no description of the scene")
    scene = require(json.loads(content), dict, "scene")
    if scene.keys() != {"title", "elements", "joints"}:
        raise ValueError("scene: unknown or missing entries")
    elements, joints = (_tables(require(scene[name], dict, name), layout[name].tables, name)
                        for name in ("elements", "joints"))
    return require(scene["title"], str, "title"), elements, joints, records


def _tables(values, layout, group):
    """{table: array, or list of texts} of lists from JSON. layout: as of table_file.Group. Raises ValueError."""
    if values.keys() != layout.keys() - WITHOUT:
        raise ValueError(f"{group}: unknown or missing tables")
    lengths: dict[str, int] = {}
    for name, column in values.items():
        kind, length, *width = layout[name]
        count = len(require(column, list, f"{group}/{name}"))
        if lengths.setdefault(length, count) != count:
            raise ValueError(f"{group}/{name}: {count} entries instead of {lengths[length]}")
        if kind != "text":
            values[name] = _numbers(column, kind, width, f"{group}/{name}")
        elif not all(isinstance(entry, str) for entry in column):
            raise ValueError(f"{group}/{name}: no texts")
    return values


def _numbers(column, kind, width, place):
    """Array of a list of numbers, or of rows of a width. Raises ValueError; only strengths may be infinite."""
    table = np.array(column) if column else np.empty((0, *width), int if kind == "whole" else float)
    if table.shape != (len(column), *width) or column and table.dtype.kind not in KINDS[kind]:
        raise ValueError(f"{place}: no {kind}s in rows of {width or 1}")
    if np.isnan(table).any() or np.isinf(table).any() and place != "joints/strength":
        raise ValueError(f"{place}: a number that is not finite")
    return table

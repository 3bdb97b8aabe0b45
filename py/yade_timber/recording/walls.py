# SPDX-License-Identifier: GPL-2.0-or-later
"""Wall sheets among the joints of a house. A sheet is two joints of one spring each, and is broken when both are. Needs no YADE."""
import numpy as np

WALL_KINDS = ("wall_beam", "wall_column")
"""Kinds of the two joints of a wall sheet: between beams, between columns."""


def wall_sheets(joints):
    """[[numbers of the joints of a wall sheet]] for each sheet; their names differ in the last part only. joints: frames.Joints"""
    sheets = {}
    for k, (kind, name) in enumerate(zip(joints.kind, joints.name)):
        if kind in WALL_KINDS:
            sheets.setdefault(name.rpartition(".")[0], []).append(k)
    return list(sheets.values())


def count_apart(joints, broken):
    """((broken, all) of the joints without those of walls, (broken, all) of the wall sheets). joints: frames.Joints; broken: (J,) bool"""
    sheets, other = wall_sheets(joints), np.array([kind not in WALL_KINDS for kind in joints.kind], bool)
    return (int((broken & other).sum()), int(other.sum())), (sum(bool(broken[sheet].all()) for sheet in sheets), len(sheets))

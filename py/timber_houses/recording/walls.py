# SPDX-License-Identifier: GPL-2.0-or-later
"""Wall sheets among the joints: two joints of one spring each, broken when both are, partly when one is."""
import numpy as np

from ..base.joint_kinds import WALL_KINDS


def of_walls(joints):
    """(J,) bool: joints that are halves of wall sheets. joints: frames.Joints"""
    return np.array([kind in WALL_KINDS for kind in joints.kind], bool)


def wall_sheets(joints):
    """[[numbers of the joints]] of each wall sheet; their names differ in the last part. joints: frames.Joints"""
    sheets = {}
    for k in np.flatnonzero(of_walls(joints)):
        sheets.setdefault(joints.name[k].rpartition(".")[0], []).append(int(k))
    return list(sheets.values())


def state(broken):
    """'broken' when all joints of a sheet or bay are, 'partly' when some are, else 'whole'. broken: bool of each"""
    return "broken" if all(broken) else "partly" if any(broken) else "whole"


def sheet_states(joints, broken):
    """['whole', 'partly' or 'broken'] for each wall sheet. joints: frames.Joints; broken: (J,) bool"""
    return [state(broken[sheet]) for sheet in wall_sheets(joints)]


def count_apart(joints, broken):
    """((broken, all) of the joints without walls, (broken, all) of the wall sheets). broken: (J,) bool"""
    sheets, other = sheet_states(joints, broken), ~of_walls(joints)
    return (int((broken & other).sum()), int(other.sum())), (sheets.count("broken"), len(sheets))

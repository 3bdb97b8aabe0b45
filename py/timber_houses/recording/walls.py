# SPDX-License-Identifier: GPL-2.0-or-later
"""Wall sheets among the joints: two joints of one spring each, broken when both are, partly when one is."""
import numpy as np


def of_walls(joints):
    """(J,) bool: joints that are halves of wall sheets. joints: frames.Joints"""
    return np.asarray(joints.sheet) >= 0


def wall_sheets(joints):
    """[[numbers of the joints]] of each wall sheet. joints: frames.Joints"""
    sheets = [[] for _ in range(int(np.max(joints.sheet, initial=-1)) + 1)]
    for k in np.flatnonzero(of_walls(joints)):
        sheets[joints.sheet[k]].append(int(k))
    return sheets


def sheet_states(joints, broken):
    """(..., S) 'broken' when all joints of a wall sheet are, 'partly' when some are, else 'whole'. joints:
    frames.Joints; broken: (..., J) bool"""
    halves = np.flatnonzero(of_walls(joints))
    sheet = np.asarray(joints.sheet)[halves]
    number = np.bincount(sheet)
    gone = np.zeros((*broken.shape[:-1], len(number)), int)
    np.add.at(gone, (..., sheet), broken[..., halves])
    return np.select([gone == number, gone > 0], ["broken", "partly"], "whole")


def count_apart(joints, broken):
    """((broken, all) of the joints without walls, (broken, all) of the wall sheets). broken: (J,) bool"""
    sheets, other = sheet_states(joints, broken), ~of_walls(joints)
    return (int((broken & other).sum()), int(other.sum())), (int((sheets == "broken").sum()), len(sheets))

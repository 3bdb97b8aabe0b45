# SPDX-License-Identifier: GPL-2.0-or-later
"""Timber-frame houses as data: YAML description -> elements and joints. Needs no YADE (numpy, scipy, PyYAML).

    model = build_house(load_house("C2"), snow_depth=1.0)
    model.elements, model.joints, model.counts()"""
from .bays import BayName, free_bays, free_wall_bays
from .build import build_house
from .check import check_house, overlaps
from .description import Description, load_house, shipped_houses
from .diagnosis import comparison, diagnose
from .errors import HouseError
from .loader import btlx_text
from .model import Element, HouseModel, JointSpec
from .overlay import changed_house
from .town import Lot, Town, load_town
from .wall_types import LEVELS, has_rated_walls
from .weight import weigh

__all__ = ["BayName", "Description", "Element", "HouseError", "HouseModel", "JointSpec", "LEVELS", "Lot", "Town",
           "btlx_text", "build_house", "changed_house", "check_house", "comparison", "diagnose", "free_bays",
           "free_wall_bays", "has_rated_walls", "load_house", "load_town", "overlaps", "shipped_houses", "weigh"]

# SPDX-License-Identifier: GPL-2.0-or-later
"""Processings of a BTLx part -> half-spaces in the part's frame, as far as they keep the part convex. Lengths in m.

Reference sides 1 to 4 lie around the part's length, 5 and 6 at its ends. Each has an own frame: origin at a corner of
the box, z outwards. Cuts of ends measure their angle in the side from its x axis and their inclination against the
side; at the part's end both are mirrored in x."""
from functools import lru_cache

import numpy as np

ACROSS = ("JackRafterCut", "Tenon", "DovetailTenon")
"""Processings with one plane across the part; of a tenon the shoulder, its volume lies in the other part."""
PAIRED = {**dict.fromkeys(("Tenon", "Mortise", "DovetailTenon", "DovetailMortise", "House", "HouseMortise",
                           "JapaneseTenon", "JapaneseMortise", "Dovetail", "TyroleanDovetail"), "tenon"),
          **dict.fromkeys(("Lap", "BirdsMouth", "StepJoint", "StepJointNotch", "FrenchRidgeLap", "LogHouseHalfLap",
                           "LogHouseJoint", "HipValleyRafterNotch", "SimpleScarf", "ScarfJoint"), "lap")}
"""Processings that join two parts -> how; the types of such joints in `cad.yaml`."""


def box_planes(size):
    """[(outward normal (3,), offset [m])] of a part's box, ends first. size: length, height, width [m]"""
    return [plane for axis, extent in zip(np.eye(3), size) for plane in ((-axis, 0.0), (axis, extent))]


@lru_cache
def side_frame(side, size):
    """(origin (3,) [m], rows x, y, z (3, 3)) of reference side 1 to 6 in the part's frame."""
    length, height, width = size
    x, y, z = np.eye(3)
    origin, u, v = {1: ((0, 0, 0), x, z), 2: ((0, height, 0), x, -y), 3: ((0, height, width), x, -z),
                    4: ((0, 0, width), x, y), 5: ((0, 0, 0), z, y), 6: ((length, height, 0), z, -y)}[side]
    return np.array(origin, float), np.array([u, v, np.cross(u, v)])


def half_spaces(processing, size):
    """Planes [(unit normal to the removed side (3,), offset [m])] of a processing; [] where its volume is none.
    size: of the part. Raises HouseError."""
    if not 1 <= processing.side <= 6:
        return []
    origin, axes = side_frame(processing.side, size)
    found = []
    for normal, point in _planes(processing, size):
        normal = normal @ axes
        found.append((normal, float(normal @ (origin + point @ axes))))
    return found


def _planes(processing, size):
    """[(normal, point [m])] in the frame of the processing's side."""
    kind = processing.kind
    if kind in ACROSS:
        depth = processing.length("StartDepth", 50 if kind != "JackRafterCut" else 0)
        across = 0 if kind == "JackRafterCut" else 50
        point = np.array([processing.length("StartX"), processing.length("StartY", across), -depth])
        return [(_across(processing, "", 90), point)]
    if kind == "DoubleCut" and processing.angle("Angle1", 45) > processing.angle("Angle2"):
        point = np.array([processing.length("StartX"), processing.length("StartY", 50), 0.0])
        return [(_across(processing, "1", 45), point), (_across(processing, "2", 90), point)]
    if kind == "LongitudinalCut" and not any(map(processing.is_set, ("StartLimited", "EndLimited", "DepthLimited"))):
        inclination = processing.angle("Inclination", 45)
        point = np.array([0.0, processing.length("StartY", 20), 0.0])
        return [(np.array([0.0, -np.sin(inclination), np.cos(inclination)]), point)]
    return _outline(processing, size) if kind == "FreeContour" else []


def _across(processing, number, angle):
    """Normal towards the removed end. number: of the angle; angle: its default [deg]"""
    a, i = processing.angle(f"Angle{number}", angle), processing.angle(f"Inclination{number}")
    out = -1.0 if processing.values.get("Orientation") == "start" else 1.0
    return np.array([out * np.sin(i) * np.sin(a), np.sin(i) * np.cos(a), -np.cos(i)])


def _outline(processing, size):
    """Planes of a closed contour whose outside is removed through the whole part, if it is convex."""
    corners = np.array([corner for corner, _ in processing.contour]).reshape(-1, 2)
    ahead = np.diff(corners, axis=0)
    left = 1.0 if processing.values.get("ToolPosition") == "left" else -1.0
    turns = left * (ahead[:, 0] * np.roll(ahead[:, 1], -1) - ahead[:, 1] * np.roll(ahead[:, 0], -1))
    through = size[2 if processing.side in (2, 4) else 1 if processing.side < 5 else 0]
    if processing.is_set("DepthBounded") and processing.length("Depth") < through - 1e-4:
        return []
    if len(ahead) < 3 or turns.max() > 1e-9 or (ahead == 0).all(1).any() or processing.is_set("CounterSink"):
        return []
    planes = []
    for start, (x, y), (_, inclination) in zip(corners, ahead, processing.contour[1:]):
        tilt, across = np.radians(inclination), np.array([-y, x]) / np.hypot(x, y)
        planes.append((left * np.array([*(np.cos(tilt) * across), np.sin(tilt)]), np.array([*start, 0.0])))
    return planes


def reference_point(processing, size):
    """(3,) point of a processing in the part's frame: the middle of a lap's volume, else its reference point. [m]"""
    if not 1 <= processing.side <= 6:
        return np.array(size) / 2
    point = np.array([processing.length("StartX"), processing.length("StartY"), -processing.length("StartDepth")])
    if processing.kind == "Lap":
        length, width = processing.length("Length", 100), processing.length("Width", 50)
        angle, towards = processing.angle("Angle"), -1.0 if processing.values.get("Orientation") == "end" else 1.0
        along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([np.sin(angle), -np.cos(angle)])
        middle = np.array([towards, 1.0]) * (width * along + length * across) / 2
        point = point + [*middle, -processing.length("Depth", 40) / 2]
    origin, axes = side_frame(processing.side, size)
    return origin + point @ axes

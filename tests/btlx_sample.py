# SPDX-License-Identifier: GPL-2.0-or-later
"""Small BTLx files: parts from boxes and cutting planes, in mm and degrees, and a braced portal of them."""
import numpy as np

X, Y, Z = np.eye(3)
SIDES = {1: ("000", X, Z), 2: ("0h0", X, -Y), 3: ("0hw", X, -Z), 4: ("00w", X, Y)}
"""Reference side -> corner of the box that is its origin, its x and y (BTLx interface description, reference sides)."""


def side(number, size):
    """(origin (3,) [mm], x, y, z (3,)) of a reference side. size: length, height, width [mm]"""
    corner, x, y = SIDES[number]
    return np.where([c != "0" for c in corner], size, 0.0), x, y, np.cross(x, y)


def end_cut(normal, point, size, number=1, kind="JackRafterCut"):
    """A cut along a plane in the part's frame [mm], whose normal points to the removed end: StartX where the plane
    meets the side's reference edge, Angle between the edge and the plane's trace in the side, Inclination between side
    and plane."""
    origin, x, y, z = side(number, size)
    normal = np.asarray(normal, float) / np.linalg.norm(normal)
    trace = np.cross(normal, z)
    trace = trace * np.sign(trace @ y) / np.linalg.norm(trace)
    is_start = normal @ x < 0
    return processing(kind, number, Orientation="start" if is_start else "end", StartY=0.0, StartDepth=0.0,
                      StartX=normal @ (point - origin) / (normal @ x), Inclination=np.degrees(np.arccos(-normal @ z)),
                      Angle=np.degrees(np.arccos(trace @ x if is_start else -trace @ x)))


def processing(kind, number, attributes="", **values):
    """values: numbers [mm, deg] or texts"""
    inner = "".join(f"<{name}>{value if isinstance(value, str) else f'{value:.6f}'}</{name}>"
                    for name, value in values.items())
    return f'<{kind} Name="{kind}" Process="yes" ReferencePlaneID="{number}" {attributes}>{inner}</{kind}>\n'


def part(number, size, places, steps=(), designation="", count=None, digits=6):
    """places: [(origin [mm], x, y)]"""
    count = len(places) if count is None else count
    length, height, width = size
    return (f'<Part SingleMemberNumber="{number}" Designation="{designation}" Count="{count}" Length="{length}"'
            f' Height="{height}" Width="{width}">\n<Transformations>{"".join(_place(*p, digits) for p in places)}'
            f'</Transformations>\n<Processings>\n{"".join(steps)}</Processings>\n</Part>\n')


def _place(origin, x, y, digits):
    names = zip(("ReferencePoint", "XVector", "YVector"), (origin, x, y))
    rows = (f"<{name} " + " ".join(f'{c}="{v:.{digits}f}"' for c, v in zip("XYZ", vector)) + "/>"
            for name, vector in names)
    return f"<Transformation><Position>{''.join(rows)}</Position></Transformation>\n"


def project(*parts, name="portal"):
    return f'<Project Name="{name}">\n<Parts>\n{"".join(parts)}</Parts>\n</Project>\n'


def btlx(*projects):
    return ('<?xml version="1.0"?>\n<BTLx xmlns="https://www.design2machine.com" Version="2.0.0" Language="en">\n'
            f'{"".join(projects)}</BTLx>\n')


def portal(turn=np.eye(3), shift=(0, 0, 0), digits=6):
    """A portal of 3 m x 2.64 m: sill, posts with tenons of 40 mm at both ends, beam, a brace at 45 degrees between the
    first post and the beam, as a BTLx file.

    turn: rotation (3, 3) of the whole; shift [mm]; digits: of places and directions
    """
    def placed(origin, x, y):
        return [(turn @ np.array(origin, float) + shift, turn @ x, turn @ y)]

    def mortises(number):
        return [processing("Mortise", number, StartX=x, StartY=60.0) for x in (60, 2940)]

    def post(number, x):
        size = (2480, 120, 120)
        steps = [end_cut(-X, np.array([40.0, 0, 0]), size, 1, "Tenon"), end_cut(X, np.array([2440.0, 0, 0]), size, 2,
                                                                             "Tenon")]
        return part(number, size, placed((x + 120, 0, 80), Z, Y), steps, "post", digits=digits)

    long, brace = (3000, 120, 120), (1400, 100, 80)
    along, across = (X + Z) / np.sqrt(2), (Z - X) / np.sqrt(2)
    middle = np.array([620.0, 60, 2020])  # of the brace, from x = 120 to z = 2520 mm
    start = middle - 700 * along - 50 * across - 40 * -Y
    frame = np.array([along, across, np.cross(along, across)])
    cuts = [end_cut(frame @ normal, frame @ (np.array(at) - start), brace, number)
            for normal, at, number in ((-X, (120, 0, 0), 3), (Z, (0, 0, 2520), 4))]
    return btlx(project(
        part(1, long, placed((0, 0, 0), X, Y), mortises(4), "sill", digits=digits),
        post(2, 0), post(3, 2880),
        part(4, long, placed((0, 0, 2520), X, Y), mortises(2), "beam", digits=digits),
        part(5, brace, placed(start, along, across), cuts, "brace", digits=digits)))

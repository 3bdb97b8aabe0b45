# SPDX-License-Identifier: GPL-2.0-or-later
"""Schema of a house file: every key, its unit and its admissible range. SI units, lengths in m."""
from .limits import MAX_ELEMENTS, MAX_LINES, MAX_NAME, MAX_PAIRS
from .schema import REQUIRED, Choice, Either, Flag, ListOf, MapOf, Number, Pair, Record, Text, Variants

SIDES = ("north", "south", "east", "west")
ACROSS = {"x": "y", "y": "x"}
ENDS = {"x": ("west", "east"), "y": ("south", "north")}
"""Sides of a house at the lower and at the higher end of an axis."""
OUTWARD = {"west": (-1, 0), "east": (1, 0), "south": (0, -1), "north": (0, 1)}  # horizontal unit vectors
MEMBERS = ("foundation", "sill", "column", "beam", "rafter", "floor", "brace", "roof")
KINDS = (*MEMBERS, "snow", "ground")
FRAME = "frame"  # key of the frame, and its name among the structures
MIN_SNOW, MAX_SNOW = 1e-3, 6.0  # range of the depth of snow, which may also be 0. [m]
MAX_WOOD = 1400.0  # density of a material `timber`; the heaviest woods have 1300. [kg/m3]
MIN_SPACING = 0.01  # smallest distance of two grid positions. [m]
MAX_STOREYS, MAX_LAYERS, MAX_AREAS, MAX_REGIONS = 20, 50, 50, 50  # of one structure; MAX_REGIONS of the house's damage
MAX_POINTS, MAX_BOARDS = 50, 20  # of a wall type: points of its envelope, boards above one another
WALL_LEVELS = ("design", "mean")  # levels of walls of a rated multiplier: wall_types.LEVELS


def length(low=0.0, high=100.0, default=REQUIRED, open_low=True):
    return Number("m", low, high, open_low, default=default)


def word(default=REQUIRED):
    """Text that names something."""
    return Text(default, MAX_NAME)


node = Number("grid nodes", -1000, 1000)
nodes = ListOf(node, scalar=True, most=MAX_LINES)
storey = Number("", 1, MAX_STOREYS, whole=True)
storeys = ListOf(storey, scalar=True, most=MAX_STOREYS, default=())
axis = Record({"module": length(0.1, 20.0, default=None), "count": Number("modules", 1, 200, whole=True, default=None),
               "positions": ListOf(Number("m", -200, 200), most=MAX_LINES, default=None)},
              one_of=("module", "positions"))
line = Record({"along": Choice(("x", "y")), "at": nodes, "from": node, "to": node, "cut": Flag(False)})
column_group = Record({"section": length(0.01, 1.0), "storeys": storeys, "at": ListOf(ListOf(node, 2), default=None),
                       "grid": Record({"x": nodes, "y": nodes}, default=None),
                       "lines": ListOf(line, most=MAX_LINES, default=None)}, one_of=("at", "grid", "lines"))
brace_line = Record({"along": Choice(("x", "y")), "at": nodes, "runs": ListOf(ListOf(node, 2)), "storeys": storeys})
braces = Record({"width": length(0.005, 0.5, 0.09), "thickness": length(0.005, 0.5, 0.045),
                 "material": word("timber"), "lines": ListOf(brace_line, default=())}, default={})


def _layer(kind, one_of=(), **fields):
    return Record({"layer": Choice((kind,)), "material": word("timber"), **fields}, one_of=one_of)


def _strip(kind, fixed):
    return _layer(kind, height=length(0.01, 2.0), width=length(0.01, 2.0), fixed=Flag(fixed),
                  lines=ListOf(line, most=MAX_LINES, default=None))


area = Record({"x": ListOf(node, 2), "y": ListOf(node, 2)}, default=None)


def _roof(kind, one_of=(), **fields):
    common = dict(type=Choice((kind,)), thickness=length(0.01, 2.0),
                  eaves=length(high=3.0, default=0.0, open_low=False), area=area, snow=Flag(True))
    return _layer("roof", one_of=one_of, **common, **fields)


_RISE = ("pitch", "ridge_height")
_rise = dict(pitch=Number("rise over run", 0.02, 3.0, default=None), ridge_height=length(default=None))
roof = Variants("type", {"hip": _roof("hip", _RISE, corner_cut=length(high=5.0, default=0.2), **_rise),
                         "gable": _roof("gable", _RISE, ridge=Choice(("x", "y"), None), **_rise),
                         "mono": _roof("mono", _RISE, falls=Choice(SIDES), **_rise),
                         "flat": _roof("flat")})
layer = Variants("layer", {
    "foundation": _strip("foundation", True), "sill": _strip("sill", True),
    "columns": _layer("columns", height=length(0.1, 20.0)), "beams": _strip("beams", False),
    "floor": _layer("floor", thickness=length(0.01, 2.0), areas=ListOf(area, least=1, most=MAX_AREAS, default=None)),
    "roof": roof
})
OPENINGS = ("window", "door")
wall_line = Record({"along": Choice(("x", "y")), "at": nodes, "from": node, "to": node,
                    "type": ListOf(word(), scalar=True, least=1, most=5),
                    "opening": Choice(("none", *OPENINGS), "none"), "panel": Number("", 0.1, 1.0, default=None),
                    "storeys": storeys})
_slab_load = Number("kN/m2", 0.05, 10.0, default=None)
loads = Record({"roof": _slab_load, "floor": _slab_load, "wall": Number("kN/m2", 0.0, 10.0, default=None)}, default={})
PLACE = Record({"origin": ListOf(Number("m", -1000, 1000), 2, default=None), "beside": word(None),
                "side": Choice(SIDES, "east"), "align": Choice(("middle", *SIDES), "middle"),
                "gap": length(high=100.0, default=0.0, open_low=False),
                "shift": Number("m", -100, 100, default=0.0)}, one_of=("origin", "beside"))
structure = Record({"place": PLACE, "grid": Record({"x": axis, "y": axis}), "margin": length(high=2.0, open_low=False),
                    "lines": ListOf(line, most=MAX_LINES), "stack": ListOf(layer, most=MAX_LAYERS),
                    "columns": ListOf(column_group), "braces": braces, "walls": ListOf(wall_line, default=()),
                    "loads": loads})
material = Variants("law", {
    "timber": Record({"law": Choice(("timber",)), "density": Number("kg/m3", 20, 30000),
                      "young": Number("Pa", 1e6, 1e12),
                      "poisson": Number("", 0.0, 0.49)}),  # of known materials; TimberMat takes (-1, 0.5]
    "snow": Record({"law": Choice(("snow",)), "density": Number("kg/m3", 10, 1000),
                    "stiffness_per_kg": Number("N/m per kg", 0.0, 1e9, open_low=True)})
})
_stretch = Number("m", 1e-5, 0.5, default=None)
joint_type = Record({"law": Choice(("brittle", "slip"), "brittle"), "at": Choice(("corners", "centre"), "corners"),
                     "kn": Number("N/m", 1e4, 1e12), "ks": Number("N/m", 1e4, 1e12),
                     "strength": Number("N", 100.0, infinite=True),
                     "per": Choice(("spring", "joint"), None), "damping_ratio": Number("", 0.0, 1.0, default=None),
                     "friction_share": Number("", 0.0, 1.0, default=None), "softening_stretch": _stretch,
                     "ultimate_stretch": _stretch})
SLIP_KEYS = ("friction_share", "softening_stretch", "ultimate_stretch")
"""Keys of a joint type that its law `slip` needs and `brittle` refuses."""
_drift = Number("rad", 1e-4, 0.5, default=None)
board = Record({"width": length(0.1, 10.0), "heights": ListOf(length(0.1, 10.0), scalar=True, most=MAX_BOARDS),
                "thickness": length(0.001, 0.2), "shear_modulus": Number("Pa", 1e6, 1e11),
                "edge": length(high=0.1, default=0.01, open_low=False)})
nails = Record({"k": Number("N/m", 1e4, 1e8), "Pv": Number("N", 50.0, 1e5), "dv": length(high=0.1, default=None),
                "du": length(1e-4, 0.5), "spacing": length(0.01, 1.0), "inner_spacing": length(0.01, 1.0, default=None),
                "board": board, "height": length(0.1, 20.0, default=None)},
               default=None)
envelope = ListOf(Pair(Number("rad", 0.0, 0.5), Number("N/m", 0.0, 1e6)), most=MAX_POINTS, default=None)
saws = Record({"F0": Number("N", 100.0, 1e7), "FI": Number("N", 0.0, 1e7), "DU": length(1e-3, 0.5),
               "S0": Number("N/m", 1e4, 1e9), "R1": Number("", 0.0, 1.0), "R2": Number("", -1.0, -1e-4),
               "R3": Number("", 1.0, 10.0), "R4": Number("", 0.0, 0.9), "alpha": Number("", 0.05, 2.0),
               "beta": Number("", 1.0, 2.0), "length": length(0.1, 20.0), "height": length(0.1, 20.0)}, default=None)
SAWS_STATES = ("friction_force", "pinched_share", "reload_share", "reload_drift", "reload_power", "reload_target")
"""Keys of a wall type that follow from `saws`."""
wall_type = Record({"multiplier": Number("", 0.0, 20.0, default=None),
                    "quasi_multiplier": Number("", 0.0, 20.0, default=None),
                    "strength": Number("N/m", 100.0, 1e6, default=None),
                    "stiffness": Number("N/m per rad", 1e4, 1e9, default=None), "envelope": envelope, "nails": nails,
                    "saws": saws, "friction_force": Number("N/m", 0.0, 1e5, default=None),
                    "pinched_share": Number("", 0.0, 0.9, default=None),
                    "reload_share": Number("", 0.0, 1.0, default=None),
                    "reload_drift": Number("rad", 1e-7, 0.5, default=None),
                    "reload_power": Number("", 0.05, 2.0, default=None),
                    "reload_target": Number("", 1.0, 2.0, default=None),
                    "friction_share": Number("", 0.0, 1.0, default=None), "softening_drift": _drift,
                    "ultimate_drift": _drift, "residual_share": Number("", 0.0, 0.95, default=0.0),
                    "panel_share": Number("", 0.1, 1.0, default=0.6), "finish": Flag(False)})
_fittings = {"number": Number("fittings", 1, 100, whole=True, default=1), "share": Number("", 0.01, 1.0, default=1.0),
             "strength": Number("N", 100.0, infinite=True, default=None)}
joint_rule = Record({"between": ListOf(ListOf(Choice(KINDS), scalar=True, most=len(KINDS)), 2), "type": word(),
                     "kind": word(), "across": Flag(False), **_fittings})
_coordinate = Number("m", -500, 500)
point = ListOf(_coordinate, 3)
_place = Number("m", -500, 500, default=None)
_offset = Number("m", -500, 500, default=0.0)
end = Either(point, Record({"of": word(), "end": Choice(("from", "to"), "from"), "at": _offset,
                            "offset": ListOf(_coordinate, 3, default=(0.0, 0.0, 0.0)), "flush": Flag(True)}))
cut = Record({"normal": ListOf(Number("", -1000, 1000), 3, default=None), "point": ListOf(_coordinate, 3, default=None),
              "x": _place, "y": _place, "z": _place, "by": word(None)}, one_of=("normal", "x", "y", "z", "by"))
repeat = ListOf(Record({"by": ListOf(_coordinate, 3, default=None), "turn": Number("degrees", -360, 360, default=None),
                        "mirror": Choice(("x", "y"), None), "count": Number("", 2, 200, whole=True, default=2),
                        "about": ListOf(_coordinate, 2, default=(0.0, 0.0)), "at": _offset},
                       one_of=("by", "turn", "mirror")), scalar=True, most=5, default=())
_parts = {"material": word("timber"), "fixed": Flag(False), "repeat": repeat}
member = Record({"from": end, "to": end, "section": ListOf(length(0.005, 5.0), 2, default=None),
                 "profile": ListOf(ListOf(Number("m", -3, 3), 2), least=3, most=12, default=None),
                 "roll": Number("degrees", -360, 360, default=0.0), "kind": Choice(MEMBERS, "beam"),
                 "cuts": ListOf(cut, most=20, default=()), **_parts}, one_of=("section", "profile"))
plate = Record({"corners": ListOf(point, least=3, most=12, default=None), "over": ListOf(word(), 2, default=None),
                "overhang": length(high=5.0, default=0.0, open_low=False), "thickness": length(0.001, 2.0),
                "kind": Choice(MEMBERS, "floor"), "snow": Flag(True), **_parts}, one_of=("corners", "over"))
named_joint = Record({"between": ListOf(word(), 2), "type": word(), "kind": word(None), **_fittings,
                      "gap": length(high=0.1, default=0.0, open_low=False)})
frame = Record({"members": MapOf(member, most=MAX_ELEMENTS), "plates": MapOf(plate, default={}),
                "storeys": ListOf(ListOf(_coordinate, 2), most=MAX_STOREYS, default=()),
                "joints": ListOf(named_joint, most=MAX_PAIRS, default=()), "loads": loads}, default=None)
_broken = Record({"count": Number("joints", 1, 10000, whole=True), "end": Choice(("top", "bottom"), None)},
                 default=None)
damage_region = Record({"structure": word(None), "side": Choice(SIDES), "storey": storey, "column_beam": _broken,
                        "brace_beam": _broken})
diagnosis = Record({"rule": Choice(("weights_2025", "table_1981"), "weights_2025"),
                    "roof": Choice(("metal", "slates", "tiles"), None),
                    "wall": Choice(("boards", "metal", "siding", "mortar", "mud"), None),
                    "solar": Number("kN/m2", 0.0, 2.0, default=0.0), "snow": Flag(False),
                    "c0": Number("", 0.2, 0.3, default=0.2)}, default={})
HOUSE = Record({
    "name": word(),
    "description": Text(""),
    "materials": MapOf(material),
    "friction": ListOf(Record({"between": ListOf(word(), 2), "coefficient": Number("", 0.0, 2.0)})),
    "law": Record({"per": Choice(("spring", "joint"), "joint"),
                   "joint_damping": Number("", 0.0, 1.0, default=0.0),
                   "damping_stiffness": Choice(("tangent", "initial"), "tangent"),
                   "wall_level": Choice(WALL_LEVELS, "mean"),
                   "vertex_edge_contacts": Flag(True), "flush_supports": Flag(True),
                   "hertz": Choice(("closed", "increment"), "closed"),
                   "bearing": Number("Pa", 1e5, 1e9, off=True, default=6e6)}, default={}),
    "ground": Record({"size": length(1.0, 1000.0), "thickness": length(0.05, 100.0), "material": word("timber")}),
    "structures": MapOf(structure, default={}),
    FRAME: frame,
    "loads": loads,
    "joint_types": MapOf(joint_type),
    "wall_types": MapOf(wall_type, default={}),
    "finishes": Flag(True),
    "diagnosis": diagnosis,
    "joints": MapOf(joint_rule),
    "joint_search": Record({"plane_tolerance": Number("m", 0.0, 1e-3, True, default=1e-6),
                            "min_area": Number("m2", 0.0, 1.0, default=1e-3),
                            "gap": length(high=0.1, default=0.0, open_low=False)}, default={}),
    "damage": Record({"end": Choice(("top", "bottom"), "bottom"), "plate": Choice(("whole", "beam"), "whole"),
                      "regions": ListOf(damage_region, most=MAX_REGIONS, default=())}, default={}),
    "snow": Record({"material": word("snow"), "depth": Number("m", 0.0, MAX_SNOW, default=0.0)}, default={}),
    "plumb": Record({"drift": Number("", 0.0, 0.05, default=0.0), "towards": Choice(SIDES, "north")}, default={}),
})

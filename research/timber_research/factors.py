# SPDX-License-Identifier: GPL-2.0-or-later
"""Choices that the paper leaves open, as factors of two levels. Each level is a set of house-file entries. Needs no
YADE.

The first level is the plainer reading of the paper's text, the second the alternative. Both state their entries, so
that neither depends on the values of the shipped houses.
"""
import copy
import json
from dataclasses import dataclass, field

from timber_houses.house.loader import SHIPPED, load_table

MATERIALS = ("timber", "roofing", "snow")


@dataclass(frozen=True)
class Level:
    """description: a few words; entries: of the house file of every house; houses: further entries by the house's
    letter A, B, C.

    The entry `friction` is a table of the materials' own coefficients [-], so that two factors can change one each.
    """

    description: str
    entries: dict = field(default_factory=dict)
    houses: dict = field(default_factory=dict)


@dataclass(frozen=True)
class Factor:
    """name: of its column in tables; title: in pictures, says what the second level does; levels: (first, second)."""

    name: str
    title: str
    levels: tuple

    def level(self, sign):
        """Level of sign -1 (first) or +1 (second)."""
        return self.levels[int(sign > 0)]


def house_entries(house, factors, signs):
    """Entries of the house file of a shipped house ('B1'; those for B hold for B1 and B2), with each factor at the
    level of its sign.
    """
    entries = {}
    for factor, sign in zip(factors, signs, strict=True):
        level = factor.level(sign)
        entries = merged(merged(entries, level.entries), level.houses.get(house[0], {}))
    if "friction" in entries:
        entries["friction"] = [{"between": [name, name], "coefficient": entries["friction"][name]}
                               for name in MATERIALS]
    return {"extends": house, **entries}


def merged(base, change):
    """`base` with the entries of `change`: tables are merged entry by entry, other values replaced."""
    result = copy.deepcopy(base)
    for key, value in change.items():
        both = isinstance(value, dict) and isinstance(result.get(key), dict)
        result[key] = merged(result[key], value) if both else copy.deepcopy(value)
    return result


def shipped(name):
    """A shipped house file and the files it extends, as plain tables."""
    return json.loads(json.dumps(load_table(SHIPPED / f"{name}.yaml")))


# --- entries ----------------------------------------------------------------------------------------------------------


def rules(**named):
    """Rules of joints by name; None removes a rule."""
    return {"joints": named}


def supports(support):
    """Frame and joints with columns and braces that stand on sills or on the foundation itself. support: 'sill' or
    'foundation'.
    """
    stacks = {name: _stack(structure["stack"], support == "sill")
              for name, structure in shipped("paper")["structures"].items()}
    ends = [support, "beam", "floor"]
    joined = rules(column_ends={"between": ["column", ends]}, brace_ends={"between": ["brace", ends]})
    return {"structures": {name: {"stack": stack} for name, stack in stacks.items()}, **joined}


def _stack(layers, sill):
    foundation, *rest = [layer for layer in layers if layer["layer"] != "sill"]
    return [foundation, *([{"layer": "sill", "height": 0.12, "width": 0.105}] if sill else []), *rest]


def fastened(**values):
    """Values of the joints of floors and roof with the beams below."""
    return {"joint_types": {name: dict(values) for name in ("floor_bolt", "roof_plate")}}


def inner_columns(*nodes):
    """The seven inner columns of a storey at these nodes (x, y)."""
    groups = [{**group, "at": [list(node) for node in nodes]} if "at" in group else group
              for group in shipped("paper")["structures"]["main"]["columns"]]
    return {"structures": {"main": {"columns": groups}}}


def braces(house, turned):
    """Lines of braces of a shipped house; turned: foot and head of each brace exchanged."""
    lines = {name: structure["braces"].get("lines", [])
             for name, structure in shipped(f"model{house}")["structures"].items()}
    step = -1 if turned else 1
    return {
        "structures": {
            name: {"braces": {"lines": [{**line, "runs": [run[::step] for run in line["runs"]]} for line in some]}}
            for name, some in lines.items()
        }
    }


BRACE_SIDES = {"between": ["brace", "column"], "type": "bracing_plate", "kind": "brace_column", "share": 1}
BEAMS = {"between": ["beam", "beam"], "type": "corner_fitting", "kind": "beam_beam"}
SHIPPED_INNER = ((4, 1), (4, 3), (4, 5), (4, 7), (4, 8), (1, 4), (7, 4))
OTHER_INNER = ((4, 2), (4, 3), (4, 5), (4, 6), (4, 7), (2, 4), (6, 4))

FACTORS = (
    Factor("brace_sides", "braces joined to columns, too", (
        Level("braces joined to beams only", rules(brace_sides=None)),
        Level("braces joined to beams and columns", rules(brace_sides=BRACE_SIDES)))),
    Factor("reading", "values of the connection", (
        Level("values of each spring", {"law": {"per": "spring"}}),
        Level("values of the connection", {"law": {"per": "joint"}}))),
    Factor("fittings", "two fittings a column end", (
        Level("one fitting at a column end", rules(column_ends={"number": 1})),
        Level("two fittings at a column end", rules(column_ends={"number": 2})))),
    Factor("beams", "butting beams joined", (Level("butting beams not joined", rules(beams=None)),
                                             Level("butting beams joined by corner fittings", rules(beams=BEAMS)))),
    Factor("floors", "floors and roof with fittings", (
        Level("floors and roof nailed, unbreakable", fastened(kn=1e7, ks=1e7, strength=float("inf"), per="joint")),
        Level("floors and roof with the corner fitting's values", fastened(kn=58800, ks=58800, strength=5880,
                                                                           per=None)))),
    Factor("supports", "columns on the foundation", (
        Level("columns on sills", supports("sill")),
        Level("columns on the foundation itself", supports("foundation")))),
    Factor("friction", "friction of timber 0.3", (Level("friction of timber 0.5", {"friction": {"timber": 0.5}}),
                                                  Level("friction of timber 0.3", {"friction": {"timber": 0.3}}))),
    Factor("damaged_end", "damage at column heads", (
        Level("damaged joints at column feet", {"damage": {"end": "bottom"}}),
        Level("damaged joints at column heads", {"damage": {"end": "top"}}))),
    Factor("snow_friction", "snow guards", (
        Level("friction of snow and roof 0.5", {"friction": {"roofing": 0.5, "snow": 0.5}}),
        Level("friction of snow and roof 2: snow guards", {"friction": {"roofing": 2.0, "snow": 2.0}}))),
    Factor("braces_c", "C's braces lean the other way", (
        Level("C's braces as shipped", houses={"C": braces("C", turned=False)}),
        Level("C's braces with foot and head exchanged", houses={"C": braces("C", turned=True)}))),
    Factor("inner_columns", "inner columns elsewhere", (  # of A and B: all seven of C carry braces
        Level("inner columns as shipped", houses=dict.fromkeys("AB", inner_columns(*SHIPPED_INNER))),
        Level("inner columns of A and B at other nodes", houses=dict.fromkeys("AB", inner_columns(*OTHER_INNER))))),
    Factor("plate", "damaged plates broken whole", (
        Level("damaged bracing plates: joint with the beam broken", {"damage": {"plate": "beam"}}),
        Level("damaged bracing plates: joints with beam and column broken", {"damage": {"plate": "whole"}}))),
)
"""In the order of the design's columns: the interactions of the first five have strings of their own."""

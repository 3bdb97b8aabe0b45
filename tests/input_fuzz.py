# SPDX-License-Identifier: GPL-2.0-or-later
"""Damaged house files, frames from CAD, towns, records, tables and motion options for hypothesis, and the check that
each is used or refused in one line.
"""
import argparse
import copy
import re
import resource
import signal
import warnings
from functools import cache

import numpy as np
import yaml
from hypothesis import strategies as st
from btlx_sample import portal
from timber_houses.base.errors import InputError
from timber_houses.house import build_house, load_house, load_town
from timber_houses.house.town import check_places
from timber_houses.motion import add_motion_options, motion_request, read_motion
from timber_houses.study.batch import read_table

SECONDS = 5
"""Processor time of one example. [s]"""
MEMORY = 1 << 20
"""Peak resident memory of the process. [kB]"""

SHED = """\
extends: base
name: shed
description: a shed
structures:
  main: null
  entrance: null
  shed:
    place: {origin: [0, 0]}
    grid: {x: {module: 1, count: 2}, y: {positions: [0, 1, 2.5]}}
    margin: 0.06
    lines: [{along: y, at: [0, 2], from: 0, to: 2}, {along: x, at: [0, 2], from: 0, to: 2, cut: true}]
    stack:
      - {layer: sill, height: 0.12, width: 0.12}
      - {layer: columns, height: 2}
      - {layer: beams, height: 0.12, width: 0.12}
      - {layer: roof, type: gable, pitch: 0.4, eaves: 0.1, thickness: 0.12}
    columns: [{section: 0.12, lines: [{along: y, at: [0, 2], from: 0, to: 2}]}]
    braces: {lines: [{along: y, at: 0, runs: [[0, 1]]}]}
joint_types:
  peg: {kn: 1e5, ks: 1e5, strength: 2000}
damage:
  regions: [{side: west, storey: 1, column_beam: {count: 1}}]
snow: {depth: 0.5}
plumb: {drift: 0.001}
"""

FRAME = """\
extends: frame
name: portal
frame:
  members:
    sill: {from: [0, -1, 0.1], to: [0, 1, 0.1], section: [0.2, 0.2], kind: sill, fixed: true,
           repeat: {mirror: x, at: 1}}
    post: {from: {of: sill, at: 1}, to: [0, 0, 2], section: [0.1, 0.1], kind: column,
           repeat: {turn: 180, about: [1, 0]}}
    tie: {from: [-0.2, 0, 2.1], to: [2.2, 0, 2.1], section: [0.1, 0.2]}
    rafter: {from: [0, 0, 2.2], to: [1, 0, 2.7], profile: [[-0.05, -0.1], [0.05, -0.1], [0.05, 0.1], [-0.05, 0.1]],
             kind: rafter, roll: 0, cuts: [{by: tie}, {x: 1}], repeat: {mirror: x, at: 1}}
    king: {from: {of: tie, at: 1.2, offset: [0, 0, 0.1]}, to: [1, 0, 2.6], section: [0.1, 0.1], kind: column,
           cuts: [{by: rafter}, {by: rafter.2}, {point: [1, 0, 2.45], normal: [0, 0, 1]}]}
    knee: {from: {of: post, at: 1.2}, to: {of: tie, at: 0.9}, section: [0.08, 0.08], kind: brace}
  plates:
    roof: {over: [rafter, rafter], overhang: 0.3, thickness: 0.1, kind: roof, material: roofing}
    slab: {corners: [[0.3, -0.5, 2.2], [0.5, -0.5, 2.2], [0.5, 0.5, 2.2]], thickness: 0.05}
  storeys: [[0.2, 2]]
  joints: [{between: [knee, tie], type: bracing_plate, gap: 0.01}]
loads: {roof: 0.5}
snow: {depth: 0.2}
joint_search: {gap: 0.02}
"""

HOSTILE = ["", " ", "-", "0", "-1", "1e308", "-1e-308", "1e-12", "1e400", ".inf", ".nan", "nan", "2,73", "010", "1:30",
           "0x10", "9" * 30, "9" * 400, "9" * 5000, "1.2.3", "null", "true", "[]", "{}", "[[]]", "[" * 200,
           "{a: " * 200, "&a [*a, *a]", "*a", "!!int x", "!!float x", "!!bool x", "!!timestamp x", "!!binary x",
           "!!set {a}", "!!python/object:os.system x", '"\\0"', '"\\e[31m"', '"\\ud800"', '"\\UFFFFFFFF"', "\0", "\x1b",
           "\u2028", "\ufeff", "<<: {a: b}", "%YAML 9.9", "---", "...", "? a", "2020-13-45", "x" * 2000, "a/" * 3000,
           "../" * 50, "A $\\frac{$ B", "\t", "|", ">", "'", '"', "#", ": ", "- ", "1_000", "=", "<", "@", "`", "%"]
hostile = st.sampled_from(HOSTILE) | st.floats().map(repr) | st.integers().map(str) | st.text(max_size=20)


def record_texts():
    """One small record of each format."""
    rows = [f"{100 * np.sin(0.3 * i):.3f}" for i in range(40)]
    counts = "\n".join(" ".join(str(int(1000 * float(v)) + 13000) for v in rows[i : i + 8]) for i in range(0, 40, 8))
    knet = ["Origin Time       2004/10/23 17:56:00", "Lat.              37.3", "Long.             138.9",
            "Depth. (km)       13", "Mag.              6.8", "Station Code      TST001", "Station Lat.      37.3",
            "Station Long.     138.8", "Station Height(m) 56", "Record Time       2004/10/23 17:56:20",
            "Sampling Freq(Hz) 100Hz", "Duration Time(s)  0.4", "Dir.              N-S",
            "Scale Factor      2000(gal)/2000000", "Max. Acc. (gal)   100", "Last Correction   2004/10/23 17:56:00",
            "Memo.             "]
    at2 = [
        "PEER NGA STRONG MOTION DATABASE RECORD", "Somewhere, 1/1/2000, TST, 090",
        "ACCELERATION TIME SERIES IN UNITS OF G", "NPTS=   40, DT=   .0200 SEC,", " ".join(
            f"{float(v) / 981:.5E}" for v in rows)
    ]
    peknold = ["Data for El Centro 1940 North South Component (Peknold Version)",
               "40 points at equal spacing of 0.02 sec", "The units are (g)", "", *at2[4:]]
    jma = ["SITE CODE= 1", "LAT.= 35", "LON.= 135", "SAMPLING RATE= 100Hz", "UNIT= gal(cm/s/s)",
           "INITIAL TIME= 2004 10 23 17 56 00", "NS,EW,UD", *[f"{v},{v},{v}" for v in rows]]
    csv = ["# units: gal", "# dt: 0.01", "# samples: 40", "time [s],ns [gal],ew_gal,ud(gal)",
           *[f"{0.01 * i:.2f},{v},{v},{v}" for i, v in enumerate(rows)]]
    return ["\n".join([*knet, counts]), *("\n".join(lines) + "\n" for lines in (at2, peknold, jma, csv))]


@st.composite
def damaged_texts(draw, texts):
    """One of `texts` with a few words replaced, lines removed, repeated or lengthened, or cut at some place."""
    text = draw(st.sampled_from(texts))
    for _ in range(draw(st.integers(1, 3))):
        at, to = sorted(draw(st.tuples(st.integers(0, len(text)), st.integers(0, len(text)))))
        to = draw(st.sampled_from([to, at, min(at + 3, to)]))
        kind = draw(st.sampled_from(["insert", "replace", "word", "repeat", "cut"]))
        new = draw(hostile) if kind in ("insert", "replace", "word") else ""
        if kind == "word":
            at, to = _word(text, at)
        if kind == "repeat":
            new = text[at : min(to, at + 300)] * draw(st.sampled_from([2, 50, 2000]))
        text = text[:at] + new + text[at if kind == "insert" else to :]
    return text.encode("utf-8", "surrogatepass")


def _word(text, at):
    """Ends of the word of `text` around the index."""
    separators = " \n,:[]{}()=/"
    start = max((text.rfind(c, 0, at) for c in separators), default=-1) + 1
    ends = [i for i in (text.find(c, at) for c in separators) if i >= 0]
    return start, max(start, min(ends, default=len(text)))


VALUES = st.sampled_from([
    None, True, [], {}, [[]], "", "x", "timber", "2,73", "x" * 2000, "\x1b", "\ud800", -1, 0, 1, 2, 3, 1e-12, 1e-3, 0.1,
    0.5, 5, 50, 1e3, 1e9, 1e308, 10**30,
    float("inf"),
    float("nan"), [0, 1], [0, 1, 2], [2, 0],
    list(range(300)), [[0, 1]] * 500, [0.1 * i for i in range(20)], [i * 1e-6 for i in range(300)],
    ["timber", "roofing"], "column", "roof", "north", "hip"
]) | st.floats() | st.floats(0, 3) | st.integers(-3, 300)


@st.composite
def damaged_trees(draw):
    """The shed or the frame with some values replaced, removed or repeated."""
    tree = yaml.safe_load(draw(st.sampled_from([SHED, FRAME])))
    for _ in range(draw(st.integers(1, 3))):
        node, places = tree, []
        while node and isinstance(node, (dict, list)):
            key = draw(st.sampled_from(list(node) if isinstance(node, dict) else range(len(node))))
            places.append((node, key))
            node = node[key]
        node, key = draw(st.sampled_from(places)) if draw(st.booleans()) else places[-1]
        kind = draw(st.sampled_from(["value", "value", "value", "remove", "repeat"]))
        if kind == "remove":
            del node[key]
        elif kind == "repeat" and isinstance(node, list):
            node *= draw(st.sampled_from([2, 3, 200]))
        else:
            node[key] = copy.deepcopy(draw(VALUES))  # later replacements may be within it
        if not tree:
            break
    return yaml.safe_dump(tree, allow_unicode=True, sort_keys=False).encode("utf-8", "surrogatepass")


SIZES = st.sampled_from([0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-4, 1e-3, 0.0101, 0.02, 0.05, 0.1, 0.3, 0.49, 0.5, 1, 1.99, 2, 3,
                         20, 99]) | st.floats(0, 3)
ROOFS = st.sampled_from(["type: gable, pitch", "type: gable, ridge: x, pitch", "type: hip, pitch",
                         "type: hip, corner_cut: 0.1, pitch", "type: gable, ridge_height", "type: hip, ridge_height"])


@st.composite
def varied_trees(draw):
    """The shed with another roof, or the frame, and a few numbers replaced by others, small and large, that often are
    admissible.
    """
    tree = yaml.safe_load(draw(st.sampled_from([SHED.replace("type: gable, pitch", draw(ROOFS)), FRAME])))
    for _ in range(draw(st.integers(1, 3))):
        node, key = draw(st.sampled_from(list(_numbers(tree))))
        node[key] = draw(SIZES) if draw(st.booleans()) else node[key] * draw(st.floats(0.5, 2))
    return yaml.safe_dump(tree, sort_keys=False).encode()


def _numbers(node):
    """(table or list, key) of all numbers in a tree."""
    for key, value in node.items() if isinstance(node, dict) else enumerate(node):
        if isinstance(value, (dict, list)):
            yield from _numbers(value)
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            yield node, key


house_files = varied_trees() | damaged_trees() | damaged_texts([SHED, FRAME]) | st.binary(max_size=200)


@st.composite
def varied_btlx(draw):
    """The portal with some numbers replaced."""
    text = portal()
    for _ in range(draw(st.integers(1, 4))):
        number = draw(st.sampled_from(list(re.finditer(r"-?\d+\.\d+", text))))
        value = draw(SIZES) * draw(st.sampled_from([1, -1, 100, 1e3])) if draw(st.booleans()) else float(number[0])
        text = text[:number.start()] + repr(value * draw(st.floats(0.9, 1.1))) + text[number.end():]
    return text.encode()


btlx_files = varied_btlx() | damaged_texts([portal()]) | st.binary(max_size=200)
record_files = damaged_texts(record_texts()) | st.binary(max_size=200)

TOWNS = {
    "town.yaml": """\
name: harbour
wave: {velocity: 500, direction: 90}
lots:
  west: {house: A, x: -100, y: 3}
  east: {house: small.yaml, x: 150, y: 0, rotation: 90, snow: 0.5}
""",
    "lots.csv": """\
lot,house,x [m],y [m],rotation,snow,,
"west",A,-100,3,,,,
east,small.yaml,150.5,0,90,0.5,,
""",
    "lots.geojson": """\
{"type": "FeatureCollection", "features": [
 {"type": "Feature", "properties": {"name": "west", "house": "A", "rotation": 12, "id": 3},
  "geometry": {"type": "Point", "coordinates": [138.79, 37.31]}},
 {"type": "Feature", "properties": {"name": "east", "house": "small.yaml", "snow": 0.5},
  "geometry": {"type": "Polygon", "coordinates": [[[138.8, 37.31], [138.8001, 37.31], [138.8, 37.3101],
                                                   [138.8, 37.31]]]}}]}
""",
}
TABLES = {
    "runs.txt": """\
house snow scale walls set braces description !threads
A * 1.5 mean snow.depth=0.5;plumb.drift=0.001 * first 2
small.yaml 1 = * * * "second" 1   # a comment
""",
    "runs.csv": """\
house,record,pga,strength,until_collapse,description,,
A,small.csv,400,0.8,yes,"a,b",,
small.yaml,none,,,no,,,
""",
}
"""{file: text} of each format."""


def damaged_files(files):
    """(name, content) of one of {name: text}, damaged."""
    return st.sampled_from(sorted(files)).flatmap(
        lambda name: st.tuples(st.just(name), damaged_texts([files[name]]) | st.binary(max_size=200)))


town_files, table_files = damaged_files(TOWNS), damaged_files(TABLES)

_OPTIONS = ("record", "seed", "component", "units", "azimuth", "start", "end", "detrend", "highpass", "pga",
            "intensity", "scale")
_option_values = st.sampled_from(["0", "1", "-1", "0.1", "2", "30", "1e-3", "100", "300", "1e5", "1e6", "nan", "inf",
                                  "-inf", "1e308", "9" * 30, "9" * 400, "9" * 5000, "", " ", "nonsense", "x" * 5000,
                                  "a,b", "," * 500, "ns,ew,ud", "gal", "g", "/", "/dev/zero", "/dev/null", "/proc/kmsg",
                                  "~nobody-of-that-name/x", "\ud800", "\x1b[31m"])


def _command_line(pairs):
    return [f"--{name}={value}" for name, value in pairs]


motion_options = st.lists(
    st.tuples(st.sampled_from(_OPTIONS), _option_values | st.floats().map(repr) | st.floats(0, 30).map(repr)),
    max_size=4).map(_command_line)


class _Stopped(Exception):
    """What argparse would print before it ends the process."""


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise _Stopped(message)


def use_house(folder, content, name="house.yaml"):
    """Load and build a house file; None or the message of refusal."""
    path = folder / name
    path.write_bytes(content)
    return _refusal(lambda: build_house(load_house(path)))


def use_btlx(folder, content):
    """The same of a frame from CAD."""
    return use_house(folder, content, "frame.btlx")


def use_record(folder, content, name="record.txt"):
    """Read a record file; None or the message of refusal."""
    path = folder / name
    path.write_bytes(content)
    return _refusal(lambda: read_motion(path))


def _beside(folder, file):
    """Path of (name, content), with a house and a record that it may name beside it."""
    name, content = file
    for other, text in (("small.yaml", "extends: storehouse\n"), ("small.csv", record_texts()[-1])):
        (folder / other).write_text(text)
    (folder / name).write_bytes(content)
    return folder / name


@cache
def _built(house):
    """HouseModel of a shipped house, or of the file beside the towns, which is always the same."""
    return build_house(load_house(house))


def use_town(folder, file):
    """Read a town and place its houses; None or the message of refusal. file: (name, content)"""
    path = _beside(folder, file)

    def use():
        lots = load_town(path).lots
        if len(lots) <= 3:
            check_places([(lot, _built(lot.house)) for lot in lots])

    return _refusal(use)


def use_table(folder, file):
    """Read a table of runs, check their options and name them; None or the message of refusal. file: (name, content)"""
    path = _beside(folder, file)
    return _refusal(lambda: [(row.name, row.options.check()) for row in read_table(path)])


def use_options(folder, words):
    """Make the motion of a command line; None or the message of refusal. Seeds are only checked: a synthetic motion
    takes a second.
    """
    parser = _Parser(add_help=False)
    add_motion_options(parser)
    record = folder / "small.csv"
    record.write_text(record_texts()[-1])

    def use():
        given = parser.parse_args([f"--record={record}"] *
                                  (not any(word.startswith(("--record", "--seed")) for word in words)) + words)
        request = motion_request(given)
        if request.seed is None:
            request.motion(2.5e-4)

    return _refusal(use)


def _refusal(use):
    """Message of the refusal, None without one; AssertionError for a message of several lines, more than SECONDS or
    MEMORY.
    """
    message = None

    def stop(_signal, _frame):
        raise AssertionError(f"more than {SECONDS} s")

    previous = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, SECONDS)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            use()
    except (InputError, _Stopped) as refusal:
        message = str(refusal)
        assert isinstance(refusal, _Stopped) or message and message.isprintable() and len(message) < 4000, repr(message)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, previous)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss < MEMORY
    return message


KINDS = {"houses": (house_files, use_house), "btlx": (btlx_files, use_btlx), "records": (record_files, use_record),
         "towns": (town_files, use_town), "tables": (table_files, use_table), "options": (motion_options, use_options)}
"""{name: (examples, use(folder, example))}"""

# SPDX-License-Identifier: GPL-2.0-or-later
"""Options as fields of a dataclass. Readers of command lines, table cells and keywords follow from the fields."""
import argparse
from dataclasses import field, fields
from numbers import Integral, Real
from pathlib import Path

from .errors import RunError
from .input_file import shown
from .remedies import decimal_point, nearest

FLAGS = {"yes": True, "true": True, "1": True, "no": False, "false": False, "0": False}
KINDS = {int: ("a whole number", Integral), float: ("a number", Real), bool: ("yes or no", bool),
         str: ("a text", (str, Path)), Path: ("a path", (str, Path))}
"""Kind of an option: its name in messages, and the Python types that a keyword may have."""
HIDDEN = "hidden"  # group of options that the help leaves out: of studies of this package
BY_SCRIPT = ("house", "quake", "snow")  # options that a run script decides, unless it is house.py or town.py


def option(kind, about, metavar=None, low=None, high=None, default=None, choices=(), group="motion", decides=True):
    """Field of a dataclass that is an option. low, high: range, both included; decides: whether it decides results."""
    default = False if kind is bool else default
    return field(
        default=default,
        metadata={"kind": kind, "help": about, "metavar": metavar, "low": low, "high": high, "choices": choices,
                  "group": group, "decides": decides},
    )


def options(kind):
    """{name: field} of the options of a dataclass."""
    return {f.name: f for f in fields(kind) if "kind" in f.metadata}


def command_option(name):
    """Name on the command line: joint_damping -> --joint-damping."""
    return f"--{name.replace('_', '-')}"


def is_given(values, name):
    """Whether an option has another value than its default."""
    return getattr(values, name) != options(type(values))[name].default


def check_ranges(values, name, error):
    """Raise `error` for a value out of its range. name: function that names an option in messages"""
    for each in options(type(values)).values():
        value = getattr(values, each.name)
        low, high, choices = (each.metadata[key] for key in ("low", "high", "choices"))
        if value is None:
            continue
        if choices and value not in choices:
            raise error(f"{name(each.name)} {shown(value)}: must be one of {', '.join(choices)};"
                        f" {each.metadata['help']}")
        if low is not None and not low <= value <= high:
            number = shown(value) if isinstance(value, int) else f"{value:g}"
            raise error(f"{name(each.name)} {number}: must be {_range(value, low, high)}; {each.metadata['help']}")


def _range(value, low, high):
    if high < 1e5:
        return f"between {low:g} and {high:g}"
    return f">= {low:g}" + (f" and at most {high:.10g}" if value > high else "")


def read(each, text, name):
    """Value of an option from a text. name: its name in messages. Raises RunError."""
    kind = each.metadata["kind"]
    if kind is Path and not text.strip():
        raise RunError(f"{name} '': a path must not be empty")
    try:
        return FLAGS[text.lower()] if kind is bool else kind(text)
    except (ValueError, KeyError):
        raise RunError(f"{name} {shown(text)}: must be {KINDS[kind][0]}{decimal_point(text)};"
                       f" {each.metadata['help']}") from None


def add_options(parser, wanted):
    """Give an ArgumentParser, or a group of one, these options; `read_arguments` reads their texts."""
    for each in wanted:
        form = {"action": "store_true"} if each.metadata["kind"] is bool else {"metavar": each.metadata["metavar"]}
        about = argparse.SUPPRESS if each.metadata["group"] == HIDDEN else each.metadata["help"]
        parser.add_argument(command_option(each.name), dest=each.name, default=None, help=about, **form)


def read_arguments(kind, arguments):
    """{option: value} of the options that a command line (argparse.Namespace) gives. Raises RunError."""
    texts = {name: getattr(arguments, name, None) for name in options(kind)}
    return {name: text if text is True else read(options(kind)[name], text, command_option(name))
            for name, text in texts.items() if text is not None}


def words(values, named):
    """Arguments of a run script. named: whether the script gives BY_SCRIPT; otherwise its house is first."""
    passed = {name: value for name, value in values.items() if name not in (BY_SCRIPT if named else ("house",))}
    return [*([] if named else [values["house"]]),
            *(command_option(name) + ("" if value is True else f"={value}") for name, value in passed.items())]


def read_keywords(kind, function, keywords, instead={}):
    """{option: value} of a function's keywords, without None. instead: {excluded option: remedy}. Raises RunError."""
    names = [name for name in options(kind) if name not in instead]
    for name in keywords:
        if name not in names:
            raise TypeError(f"{function}() has no option '{name}'; {instead.get(name) or nearest(name, names)}")
    values = {}
    for name, value in ((name, value) for name, value in keywords.items() if value is not None):
        each, place = options(kind)[name], f"{function}: {name}"
        noun, types = KINDS[each.metadata["kind"]]
        if not isinstance(value, types):
            raise TypeError(f"{place} {shown(value)}: must be {noun}")
        is_text = isinstance(value, (str, Path))
        values[name] = read(each, str(value), place) if is_text else each.metadata["kind"](value)
    return values

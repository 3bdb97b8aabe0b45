# SPDX-License-Identifier: GPL-2.0-or-later
"""The page of the C++ classes, from the documentation of their attributes that YADE's macros keep."""
import re

MARKUP = re.compile(r":ydefault:`(?P<default>[^`]*)`|:yattrtype:`(?P<type>[^`]*)`|:yattrflags:`[^`]*`|\|y[a-z]+\|")
REFERENCE = re.compile(r":yref:`(?:(?P<text>[^<`]+)<(?P<target>[^>`]+)>|(?P<name>[^`]+))`")
GROUPS = (
    ("Bodies", ("RoundedPolyhedron", "ElementMat", "TimberMat", "SnowMat", "Bo1_RoundedPolyhedron_Aabb")),
    ("Contacts", ("ManifoldGeom", "ManifoldPhys", "TimberPhys", "SnowPhys",
                  "Ig2_RoundedPolyhedron_RoundedPolyhedron_ManifoldGeom",
                  "Ip2_TimberMat_TimberMat_TimberPhys", "Ip2_ElementMat_ElementMat_SnowPhys",
                  "Law2_ManifoldGeom_TimberPhys_Hertz",
                  "Law2_ManifoldGeom_SnowPhys_Linear")),
    ("Joints", ("TimberJoint", "JointBreak", "JointEngine")),
)
REST = "Engines and display"


def write_classes(path):
    """Write the page of all registered classes, unless it is the same already."""
    import yade.wrapper
    import yade_timber

    named = {name for _, names in GROUPS for name in names}
    groups = [*GROUPS, (REST, sorted(set(yade_timber._class_names) - named))]
    lines = ["C++ classes", "===========", "", "Classes of ``yade.wrapper``, which ``yade_timber`` exports as well.",
             "Attributes are set through the constructor: ``yt.TimberMat(young=7e9)``.", ""]
    for title, names in groups:
        lines += [title, "-" * len(title), ""]
        for name in names:
            lines += class_lines(getattr(yade.wrapper, name))
    text = "\n".join(lines) + "\n"
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def class_lines(cls):
    """reST of a class: its base, its documentation, its own attributes and methods."""
    base = cls.__mro__[1].__name__
    lines = [f".. py:class:: yade_timber.{cls.__name__}", "", f"   Bases: ``{base}``", "", *indented(cls.__doc__, 3)]
    for name, item in vars(cls).items():
        doc = getattr(item, "__doc__", None) or ""
        if isinstance(item, property):
            lines += attribute_lines(name, doc)
        elif not name.startswith("_") and name not in ("dict", "updateAttrs") and callable(item):
            lines += [f"   .. py:method:: {name}()", "", *indented(body_of(doc), 6)]
    return lines


def attribute_lines(name, doc):
    """reST of an attribute with its type and default."""
    facts = {key: value for match in MARKUP.finditer(doc) for key, value in match.groupdict().items() if value}
    lines = [f"   .. py:attribute:: {name}"]
    lines += [f"      :type: {facts['type']}"] if "type" in facts else []
    lines += [f"      :value: {facts['default']}"] if "default" in facts else []
    return [*lines, "", *indented(MARKUP.sub("", doc), 6)]


def body_of(doc):
    """A method's documentation without the signatures that Boost.Python puts before it."""
    return "\n".join(line for line in doc.splitlines() if not line.rstrip().endswith(" :"))


def indented(text, width):
    """Lines of a text, each paragraph on one line, and an empty line."""
    escaped = " ".join(text.split()).replace("|", r"\|").replace("*", r"\*")
    return [" " * width + REFERENCE.sub(link, escaped), ""]


def link(found):
    """reST of a reference in YADE's markup."""
    return f":py:obj:`{found['text'] or found['name']} <yade_timber.{found['target'] or found['name']}>`"

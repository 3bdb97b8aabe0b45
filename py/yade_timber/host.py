# SPDX-License-Identifier: GPL-2.0-or-later
"""Compatibility of the compiled module with the running YADE.

`load()` is called at import. It raises an ImportError, before any class is registered, when

1. the build record inside the module file (read before the file is loaded) names another YADE version, feature set or
Python, or
2. a value stored through YADE's own Python attribute does not come back through the module's compiled layout, or the
reverse."""
import importlib
import json
import mmap
import sys
from pathlib import Path

RECORD_MARK = b"@timber-build"
MODULE = "_yade_timber"
FASTER = "x86_64_v3"  # folder of a second module for processors with AVX2 (Debian package)
REMEDY = "Rerun scripts/setup to build yade-timber for this YADE."


def running() -> bool:
    """Whether this Python is inside a YADE session."""
    return "yade.wrapper" in sys.modules


def host_facts() -> dict:
    """Version, features (space separated, sorted) and Python of the running YADE."""
    import yade.config

    return {"yade": yade.config.version, "features": " ".join(sorted(set(yade.config.features))),
            "python": "%d.%d" % sys.version_info[:2]}


def build_record(module_file) -> dict:
    """Build record in a module file, which is not loaded: yade, headers, features, python, package. Or ImportError."""
    with open(module_file, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
        start = content.find(RECORD_MARK + b"{")
        if start < 0:
            raise ImportError(f"{module_file} has no build record: it is no yade-timber module. {REMEDY}")
        start += len(RECORD_MARK)
        return json.loads(content[start : content.find(b"}", start) + 1])


def check_build(record: dict, host: dict) -> None:
    """Raise ImportError unless a build record (see build_record) fits a host (see host_facts)."""
    for key, noun in (("yade", "YADE"), ("python", "Python")):
        if record[key] != host[key]:
            raise ImportError(f"yade-timber was built for {noun} {record[key]}, but this is {noun} {host[key]}."
                              f" {REMEDY}")
    built, features = set(record["features"].split()), set(host["features"].split())
    if built != features:
        changes = [f"+{name}" for name in sorted(features - built)] + [f"-{name}" for name in sorted(built - features)]
        raise ImportError(f"yade-timber was built for YADE {record['yade']} with other features: this host has"
                          f" {' '.join(changes)}. {REMEDY}")


def check_value(place: str, expected, actual, record: dict, host: dict) -> None:
    """Raise ImportError unless a value stored at `place` ("Class.attribute (direction)") came back unchanged."""
    if not expected == actual:  # a NaN differs, too
        raise ImportError(f"YADE's {place}: stored {expected!r}, read back {actual!r}; the layout of the class differs"
                          f" between the running YADE {host['yade']} and the headers ({record['headers']}) that"
                          f" yade-timber was built with. {REMEDY}")


def _sentinel(wrapper, default, pointee: str, number: int):
    """A value of the type of a default (of class `pointee` for a pointer), different for each attribute."""
    if pointee:
        return getattr(wrapper, pointee)()
    if isinstance(default, bool):
        return not default
    if isinstance(default, int):
        return 4000 + number
    if isinstance(default, float):
        return 0.5 + number
    if type(default).__name__ == "Quaternion":
        return type(default)((0.6, 0.0, 0.8), 0.01 * number)
    return type(default)(number + 0.25, number + 0.5, -number)


def _store(wrapper, owner: str, attribute: str, value):
    """An instance of a YADE class with one attribute set by YADE itself, as read-only ones need."""
    try:
        return getattr(wrapper, owner)(**{attribute: value})
    except AttributeError:  # shorthands (State.pos) are no keywords of the constructor
        instance = getattr(wrapper, owner)()
        setattr(instance, attribute, value)
        return instance


def check_layout(plugin, wrapper, record: dict, host: dict, shift: int = 0) -> int:
    """Round trips through every member in the module's table; returns their number.

    Reads come before writes: a write through a wrong layout would corrupt memory. `shift` [bytes] displaces every
    compiled read, so that a test can simulate another layout. Raises ImportError that names class and attribute."""
    table = list(enumerate(plugin.layout_fields()))
    for index, (owner, attribute, pointee) in table:
        default = getattr(getattr(wrapper, owner)(), attribute)
        value = _sentinel(wrapper, default, pointee, index)
        seen = plugin.read_field(index, _store(wrapper, owner, attribute, value), shift)
        expected = plugin.address(value) if pointee else getattr(_store(wrapper, owner, attribute, value), attribute)
        check_value(f"{owner}.{attribute} (YADE to module)", expected, seen, record, host)
    for index, (owner, attribute, pointee) in table:
        instance = getattr(wrapper, owner)()
        value = _sentinel(wrapper, getattr(instance, attribute), pointee, index)
        plugin.write_field(index, instance, value)
        seen = getattr(instance, attribute)
        check_value(f"{owner}.{attribute} (module to YADE)", value, seen, record, host)
    return len(table)


def check_containers(plugin, wrapper, record: dict, host: dict) -> None:
    """Containers without a Python attribute: of a scene, a collider, an InteractionLoop. Raises as check_layout."""
    omega, force = wrapper.Omega(), type(wrapper.State().pos)(1.5, 2.5, 3.5)
    scene = wrapper.Scene()
    before = plugin.swap_scene(scene)
    try:
        check_value("Scene.energy", plugin.address(omega.energy), plugin.energy_address(scene), record, host)
        omega.engines = [wrapper.ForceResetter()] * 3
        omega.bodies.append(wrapper.Body())
        omega.forces.addF(0, force)
        seen = plugin.read_containers(scene)
    finally:
        plugin.swap_scene(before)
    for name, stored, value in zip(("engines", "bodies", "interactions", "forces"), (3, 1, 0, force), seen):
        check_value(f"Scene.{name}", stored, value, record, host)
    collider = wrapper.InsertionSortCollider([wrapper.Bo1_Sphere_Aabb()])
    check_value("BoundDispatcher.functors", 1, plugin.count_bound_functors(collider), record, host)
    loop = wrapper.InteractionLoop(
        [wrapper.Ig2_Sphere_Sphere_ScGeom()],
        [wrapper.Ip2_FrictMat_FrictMat_FrictPhys(), wrapper.Ip2_ElastMat_ElastMat_NormPhys()], []
    )
    check_value("InteractionLoop functors", (1, 2, 0), plugin.count_contact_functors(loop), record, host)


def import_module(package: str, directory):
    """Import the compiled module in `directory`, or the one in FASTER where it is there and fits this processor."""
    if (Path(directory) / FASTER / f"{MODULE}.so").exists():
        try:
            return importlib.import_module(f".{FASTER}.{MODULE}", package)
        except ImportError as problem:
            if "ISA level" not in str(problem):
                raise
    return importlib.import_module(f".{MODULE}", package)


def load(package: str, directory):
    """Check and load `<package>._yade_timber` in `directory`; returns (module, classes). ImportError as above."""
    file = Path(directory) / f"{MODULE}.so"
    if not file.exists():
        raise ImportError(f"yade-timber's compiled module is missing ({file}). {REMEDY}")
    record, host = build_record(file), host_facts()
    check_build(record, host)
    wrapper = importlib.import_module("yade.wrapper")
    plugin = import_module(package, directory)
    check_layout(plugin, wrapper, record, host)
    if not wrapper.Omega().running:
        check_containers(plugin, wrapper, record, host)
    names = list(plugin.register_classes())
    viewer = sys.modules.get("yade.qt")
    if viewer is not None and hasattr(plugin, "refresh_viewer"):
        plugin.refresh_viewer(viewer.Renderer())
    return plugin, names

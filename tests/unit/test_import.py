# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""What `import yade_timber` and `yt.guard()` change of a YADE session, and what the plugin does without."""
import json
import subprocess

SNAPSHOT = """
import json, signal, sys
import numpy, yade.remote, yade.runtime, yade.utils, yade.wrapper
from ports import listening_ports
HANDLERS = {"SIGINT": signal.SIGINT, "SIGTERM": signal.SIGTERM}

def snapshot():
    \"\"\"{owner: {attribute: object}} of all modules of YADE, of all of their classes, and of the process.\"\"\"
    modules = {name: module for name, module in sys.modules.items() if name == "yade" or name.startswith("yade.")}
    owners = {name: vars(module) for name, module in modules.items()}
    owners |= {f"{name}.{key}": vars(value) for name, module in modules.items()
               for key, value in vars(module).items() if isinstance(value, type)}
    owners["process"] = {name: signal.getsignal(number) for name, number in HANDLERS.items()}
    owners["process"] |= {name: getattr(sys, name) for name in ("displayhook", "excepthook", "flags")}
    owners["process"] |= {f"numpy {key}": value for key, value in numpy.geterr().items()}
    return {owner: dict(attributes) for owner, attributes in owners.items()}

def values():
    \"\"\"What is equal, not identical.\"\"\"
    return {"ports": listening_ports(), "path": list(sys.path), "tags": dict(O.tags), "engines": len(O.engines),
            "bodies": len(O.bodies), "iter": O.iter, "dt": O.dt, "scene": O.sceneToString().__len__()}

def changed(before, after):
    \"\"\"'owner.attribute' of all that another object has replaced, and of all that is new.\"\"\"
    return sorted(f"{owner}.{name}" for owner in before for name in after[owner].keys() | before[owner].keys()
                  if not name.startswith("__warning") and (
                      name not in before[owner] or after[owner].get(name) is not before[owner][name]))
"""
IMPORT = SNAPSHOT + """
O.bodies.append(utils.sphere((0, 0, 0), 1))
before, held = snapshot(), values()
import yade_timber as yt
after, now = snapshot(), values()
yt.guard()
guarded = snapshot()
yt.guard()
print("@" + json.dumps({"import": changed(before, after), "values": [held, now], "guard": changed(after, guarded),
                        "again": changed(guarded, snapshot()), "classes": list(yt._class_names)}))
"""
WITHOUT = """
import sys
MISSING = {"h5py", "matplotlib", "yaml", "scipy", "timber_houses"}

class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in MISSING:
            raise ImportError(f"{name} is not installed")

for name in [name for name in sys.modules if name.partition(".")[0] in MISSING]:
    del sys.modules[name]  # of YADE's own start
sys.meta_path.insert(0, Missing())
import yade_timber as yt
plate = O.bodies.append(yt.box((2, 2, 0.2), (0, 0, -0.1), fixed=True))
column = O.bodies.append(yt.box((0.105, 0.105, 2.73), (0, 0, 1.365)))
O.dt, O.engines = 1e-4, yt.engines()
joint = yt.connect(plate, column, [(x, y, 0) for x in (-.05, .05) for y in (-.05, .05)])
O.run(3000, True)
yt.set_velocity(column, (0.1, 0, 0), (0, 0.1, 0))
O.run(100, True)
yt.export_scene(sys.argv[1])
force = sum(spring["force"][2] for spring in joint.springs)
carried = sum(point["normal_force"] for point in yt.contacts(plate, column))
print("@" + str([MISSING & {name.partition(".")[0] for name in sys.modules}, carried > 0, yt.energy()["kinetic"] > 0]))
"""


def said(folder, text, *arguments):
    """What a script prints behind an @ in a YADE session with a prompt's ports."""
    script = folder / "script.py"
    script.write_text(text)
    done = subprocess.run(["yade", "-n", "-x", str(script), *map(str, arguments)], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, timeout=120)
    assert "@" in done.stdout, done.stdout + done.stderr
    return done.stdout.partition("@")[2]


def test_import_registers_classes_and_changes_nothing_else(tmp_path):
    found = json.loads(said(tmp_path, IMPORT))
    assert found["import"] == sorted(f"yade.wrapper.{name}" for name in found["classes"])
    before, after = found["values"]
    assert after == before and len(before["ports"]) == 2 and before["bodies"] == 1


def test_guard_changes_classes_of_yade_once(tmp_path):
    found = json.loads(said(tmp_path, IMPORT))
    owners = {name.rpartition(".")[0].rpartition(".")[2] for name in found["guard"]}
    assert owners >= {"Omega", "BodyContainer", "InteractionContainer", "Body", "State", "Serializable", "Aabb"}
    assert not owners & set(found["classes"])
    assert {"yade.wrapper.Omega.run", "yade.wrapper.State.__setattr__"} <= {*found["guard"]}
    assert found["again"] == []


def test_a_scene_without_what_houses_need(tmp_path):
    assert said(tmp_path, WITHOUT, tmp_path / "scene.json").strip() == "[set(), True, True]"
    assert json.loads((tmp_path / "scene.json").read_text())["joints"]


def test_runs_load_no_matplotlib(tmp_path):
    """It takes as long as the start of YADE: a run without pictures does without."""
    script = "import sys\nfrom timber_houses.run import cli, session\nprint('@', 'matplotlib' in sys.modules)\n"
    assert said(tmp_path, script).split() == ["False"]

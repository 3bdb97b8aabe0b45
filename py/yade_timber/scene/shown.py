# SPDX-License-Identifier: GPL-2.0-or-later
"""One line about each object of the package's classes, and a table of a joint's springs, for the prompt: units, four
digits."""
ATTRIBUTES = {"TimberMat": (("young", "Pa"), ("poisson", ""), ("density", "kg/m3"), ("friction", ""),
                            ("bearing", "Pa")),
              "SnowMat": (("density", "kg/m3"), ("friction", "")),
              "GroundMotionEngine": (("start", "s"), ("scale", "")), "Sampler": (("interval", "s"),),
              "ContactForces": (("sweeps", ""), ("tolerance", ""), ("unconverged", "steps")),
              "UniformGravity": (("gravity", "m/s2"),)}
"""Class -> attributes that its line names, and their units."""


def install(classes):
    """Give classes of yade.wrapper their lines."""
    for cls in classes:
        cls.__repr__ = cls.__str__ = LINES.get(cls.__name__, _line)
        if cls.__name__ == "TimberJoint":
            springs = cls.springs
            cls.springs = property(lambda joint: Springs(springs.fget(joint)), doc=springs.__doc__)


class Springs(list):
    """Springs of a joint; a short table at the prompt."""

    def __repr__(self):
        rows = (f"{k:6}  {' '.join(f'{x:10.4g}' for x in spring['force'])}  {spring['stretch'] * 1e3:12.4g}"
                f"  {'broken' if spring['broken'] else 'intact'}"
                for k, spring in enumerate(self))
        return "\n".join(["spring  force x, y, z on body 1 [N]           stretch [mm]  state", *rows])


def _line(part):
    name = type(part).__name__
    values = ", ".join(f"{key} {_text(getattr(part, key), unit)}" for key, unit in ATTRIBUTES.get(name, ()))
    return f"<{name}: {values}>" if values else f"<{name}>"


def _text(value, unit):
    numbers = f"{value:.4g}" if isinstance(value, (int, float)) else " ".join(f"{number:.4g}" for number in value)
    return f"{numbers} {unit}".rstrip()


def _joint(joint):
    broken, count = sum(map(bool, joint.broken)), len(joint.anchors1)
    state = "intact" if not broken else "broken" if broken == count else f"{broken} broken"
    label = " ".join(filter(None, (joint.kind, joint.name)))
    load = f"load {joint.load:.4g} of {joint.strength / 1e3:.4g} kN{'' if joint.perJoint else ' a spring'}"
    return f"<TimberJoint{label and f' {label}'}: bodies {joint.id1} and {joint.id2}, {count} springs, {load}, {state}>"


def _polyhedron(shape):
    extent = " x ".join(f"{max(side) - min(side):.4g}" for side in zip(*shape.vertices)) if shape.vertices else "none"
    return f"<RoundedPolyhedron: {len(shape.vertices)} vertices, {extent} m, radius {shape.radius:.4g} m>"


LINES = {"TimberJoint": _joint, "RoundedPolyhedron": _polyhedron,
         "JointEngine": lambda one: f"<JointEngine: {len(one.joints)} joints, {len(one.breaks)} springs broken>",
         "JointBreak": lambda entry: (f"<JointBreak: {entry.time:.4g} s, joint {entry.joint}, spring {entry.spring},"
                                      f" {entry.cause}>")}
"""Class -> its line, where attributes alone do not say enough."""

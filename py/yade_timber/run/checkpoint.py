# SPDX-License-Identifier: GPL-2.0-or-later
"""A run's state on disk, so that it can go on after a kill: one file, YADE's own save with one more line.

The last line is JSON: `identity` of the run, `wall_s` spent so far, `sha256` of all bytes before that line. YADE's loader
stops before it, so the file also opens with a plain `O.load`. A binary save keeps every bit of every number.
"""
import hashlib
import json
from pathlib import Path

import yade.wrapper as yw

from ..base.errors import RunError
from ..base.atomic_write import written_whole
from .identity import package

NAME = "checkpoint.yade"
O = yw.Omega()


def digest(*arrays):
    """Hexadecimal fingerprint of numpy arrays: shapes and bits."""
    total = hashlib.sha256()
    for array in arrays:
        total.update(f"{array.shape}{array.dtype}".encode())
        total.update(array.tobytes())
    return total.hexdigest()[:16]


def identity(scenario, model, version):
    """What must agree between a checkpoint and the run that goes on from it: {property: value as JSON gives it back}.

    The scenario's fingerprint, the house as built (geometry, stiffness and strength of the joints, materials, laws), the package's version and files.
    """
    elements = digest(*(e.vertices for e in model.elements))
    joints = digest(*(j.points for j in model.joints))
    values = [[j.kn, j.ks, j.strength, j.per, j.broken] for j in model.joints]
    known = {**scenario.fingerprint(), "elements": elements, "joints": joints, "joint values": _text_digest(values)}
    known |= {"materials": _text_digest([model.materials, model.friction]), "law": _text_digest(model.law), "version": version, "package": package()}
    return json.loads(json.dumps(known))


def _text_digest(values):
    return hashlib.sha256(json.dumps(values, sort_keys=True).encode()).hexdigest()[:16]


def save(path, identity, wall_s):
    """Save the scene in YADE. A kill at any moment leaves the file of before or the new one. Raises OSError."""
    with written_whole(path) as part:
        O.save(str(part), quiet=True)
        seal = {"identity": identity, "wall_s": wall_s, "sha256": hashlib.sha256(part.read_bytes()).hexdigest()}
        with open(part, "ab") as file:
            file.write(b"\n" + json.dumps(seal).encode())


def load(path, identity):
    """Put the saved scene into YADE; returns the wall time spent on it so far [s].

    Raises RunError when the file is damaged or belongs to a run of another identity.
    """
    path = Path(path)
    try:
        body, _, line = path.read_bytes().rpartition(b"\n")
        seal = json.loads(line)
        whole = hashlib.sha256(body).hexdigest() == seal["sha256"]
    except (ValueError, KeyError, TypeError):
        whole = False
    except OSError as problem:
        raise RunError(f"{path}: cannot read the checkpoint: {problem.strerror}") from None
    if not whole:
        raise RunError(f"{path}: damaged, or no checkpoint of this package; run without --resume to start anew")
    _require_same(path, seal["identity"], identity)
    try:
        O.load(str(path), quiet=True)
    except Exception as problem:  # whole, but written by other classes than today's
        raise RunError(f"{path}: YADE cannot load it ({problem}); run without --resume to start anew") from None
    return seal["wall_s"]


def _require_same(path, saved, wanted):
    for key in sorted(saved.keys() | wanted.keys()):
        there, here = saved.get(key), wanted.get(key)
        if there != here:
            raise RunError(f"{path}: checkpoint of another scenario: {key} is {there} there and {here} here; "
                           "use the same options, another --out, or no --resume")

# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes a ground motion as the plain CSV that `read_motion` reads."""
from __future__ import annotations

from pathlib import Path

from ..base.atomic_write import write_text
from .record import GAL, RecordError

DECIMALS = 2
"""Decimals of the written gal. The rounding, 0.005 gal, shifts the velocity of 40 s by less than 0.02 cm/s."""


def write_csv(motion, path, comments=()):
    """Write `motion` in gal with named columns, whole or not at all. comments: of the header. Raises RecordError."""
    path = Path(path)
    header = [*comments, "units: gal", f"dt: {motion.dt:.10g}", f"samples: {len(motion)}"]
    lines = [f"# {line}" for line in header] + ["ns,ew,ud"]
    lines += [",".join(map(_number, (ns, ew, ud))) for ew, ns, ud in motion.acceleration / GAL]
    try:
        write_text(path, "\n".join(lines) + "\n")
    except OSError as error:
        raise RecordError(f"{path}: cannot be written ({error.strerror}); give a folder that exists") from None


def _number(value):
    text = f"{value:.{DECIMALS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text

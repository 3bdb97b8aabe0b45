# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes a ground motion as the plain CSV that `read_motion` reads."""
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
    rounded = (motion.acceleration[:, [1, 0, 2]] / GAL).tolist()
    lines += [",".join(f"{round(value, DECIMALS) + 0.0}".removesuffix(".0") for value in row) for row in rounded]
    try:
        write_text(path, "\n".join(lines) + "\n")
    except OSError as error:
        raise RecordError(f"{path}: cannot be written ({error.strerror}); give a folder that exists") from None

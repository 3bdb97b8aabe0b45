# SPDX-License-Identifier: GPL-2.0-or-later
"""Compressed arrays of numbers for the player (read by player/src/run.js).

Layout: zlib( length of the JSON, 4 bytes little-endian; the JSON; the arrays, in the order of its "arrays" ), as base64
text. Numbers are rounded to multiples of their array's step. Each column is stored as differences from row to row, the
sign in the lowest bit (zigzag), with the four bytes of all differences in separate planes: a column that hardly changes
becomes a run of zeros.
"""
import base64
import json
import math
import zlib

import numpy as np

LEVEL = 6
"""Of zlib: two hundredths larger than at 9, in half of the time."""
LARGEST = 2**30
"""Largest multiple of a step that is stored. [-]"""
TIME_STEP = 1e-6
"""Step of times, of long runs 1e-6 of the last one or more. [s]"""


def pack(info, arrays):
    """Base64 text. info: JSON content; arrays: {name: (values (rows, ...), step)}. Raises ValueError."""
    header = {
        **info,
        "arrays": [{"name": name, "shape": np.shape(values), "step": step} for name, (values, step) in arrays.items()],
    }
    text = json.dumps(header, allow_nan=False).encode()
    parts = [len(text).to_bytes(4, "little"), text,
             *(planes(name, values, step) for name, (values, step) in arrays.items())]
    return base64.b64encode(zlib.compress(b"".join(parts), LEVEL)).decode()


def time_step(values):
    """Step of increasing times [s] for `pack`."""
    last = values[-1] if len(values) else 0.0
    return TIME_STEP if last < LARGEST * TIME_STEP else 10.0 ** math.ceil(math.log10(last / LARGEST) + 1e-9)


def planes(name, values, step):
    """The bytes of one array, 4 per number."""
    whole = np.rint(np.asarray(values, float) / step)
    if not (np.abs(whole) < LARGEST).all():  # also refuses NaN
        raise ValueError(f"{name}: numbers must be finite and below {LARGEST * step:g}")
    columns = whole.astype(np.int64).reshape(len(whole), int(np.prod(whole.shape[1:]))).T
    change = np.diff(columns, axis=1, prepend=0)
    folded = np.where(change < 0, -2 * change - 1, 2 * change).astype("<u4")
    return np.ascontiguousarray(folded).view(np.uint8).reshape(-1, 4).T.tobytes()

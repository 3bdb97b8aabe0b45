# SPDX-License-Identifier: GPL-2.0-or-later
"""The comparator of all Python tests."""
import numpy as np


def assert_close(value, reference, rtol=0.0, atol=0.0):
    """Fail unless shapes agree and |value - reference| <= atol + rtol |reference| for all elements; fails on NaN.

    value, reference: numbers or arrays of any one shape, same unit; rtol [-]; atol in that unit. Raises AssertionError
    with the largest difference and all values.
    """
    value, reference = np.asarray(value, dtype=float), np.asarray(reference, dtype=float)
    assert value.shape == reference.shape, f"shape {value.shape} instead of {reference.shape}"
    with np.errstate(invalid="ignore"):
        excess = np.abs(value - reference) - (atol + rtol * np.abs(reference))
    bad = ~(excess <= 0)
    if bad.any():
        worst = np.unravel_index(np.argmax(np.where(np.isnan(excess), np.inf, excess)), value.shape)
        raise AssertionError(
            f"{bad.sum()} of {value.size} differ; worst at {tuple(map(int, worst))}: {float(value[worst])!r} instead "
            f"of {float(reference[worst])!r} "
            f"(rtol {rtol:g}, atol {atol:g}). Value: {value.tolist()!r}")

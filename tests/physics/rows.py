# SPDX-License-Identifier: GPL-2.0-or-later
"""Rows of the accuracy table, and the registry of the cases that compute them. Needs no YADE.

A file of cases creates a registry and adds functions to it; each returns a list of rows:

    case = Registry()

    @case
    def hertz_duration():
        ...
        return [Row("1", "impact duration [s]", expected=t, got=T, bound=1e-3, dt=1e-5)]

`case.functions` lists them in the order of the file; tests call a function and pass its rows to `check`.
"""
import dataclasses
import math


@dataclasses.dataclass
class Row:
    """One line of the table. `error` is |got - expected| / |expected|, or |got - expected| where expected = 0 or
    `absolute`.
    """

    item: str  # section of the accuracy page, "1" ... "9"
    quantity: str  # with its unit: "peak overlap, 1 m/s [m]"
    expected: float  # closed form or independent solution
    got: float  # computed by the package
    error: float = None  # computed when not given
    bound: float = math.inf  # largest error that passes; inf: for information only
    dt: float = None  # time step [s]; None: static
    order: float = None  # observed order of convergence in dt; None: does not apply
    note: str = ""  # dominant error; source of `expected`
    absolute: bool = False  # error in the unit of the quantity, not relative
    least_order: float = None  # smallest order that passes; None: for information only

    def __post_init__(self):
        if self.error is None:
            scale = 1.0 if self.absolute or self.expected == 0 else abs(self.expected)
            self.error = abs(self.got - self.expected) / scale

    @property
    def passes(self):
        """Whether the error is within the bound and the order is reached; False for NaN."""
        return math.isfinite(self.got) and self.error <= self.bound and (
            self.least_order is None or (self.order or math.nan) >= self.least_order
        )


class Registry:
    """List of functions that return rows; used as a decorator. Names are those of the functions."""

    def __init__(self):
        self.functions = []

    def __call__(self, function):
        self.functions.append(function)
        return function


def check(rows):
    """Raise AssertionError that lists every row out of its bound, or for an empty list."""
    rows = list(rows)
    assert rows, "no rows: nothing was compared"
    wrong = [row for row in rows if not row.passes]
    assert not wrong, "\n" + "\n".join(
        f"{r.item} {r.quantity}: expected {r.expected:.9g}, got {r.got:.9g}, error {r.error:.3g} (bound "
        f"{r.bound:.3g}), "
        f"order {r.order} (least {r.least_order}), dt {r.dt}" for r in wrong)


def observed_order(steps, errors):
    """Slope of log(error) over log(dt), least squares over all runs; NaN if an error is zero or not finite."""
    pairs = [(math.log(h), math.log(e)) for h, e in zip(steps, errors) if math.isfinite(e) and e > 0]
    if len(pairs) < max(2, len(steps)):
        return math.nan
    mean_x = sum(x for x, _ in pairs) / len(pairs)
    mean_y = sum(y for _, y in pairs) / len(pairs)
    return sum((x - mean_x) * (y - mean_y) for x, y in pairs) / sum((x - mean_x) ** 2 for x, _ in pairs)


def series(item, quantity, expected, gots, dts, bound, least_order=None, **row):
    """Rows of one quantity at several time steps, for the plot of error against dt.

    `bound` and `least_order` apply to the row of the smallest step, which also states the observed order; the others
    show the convergence.
    """
    rows = [Row(item, quantity, expected, got, dt=dt, **row) for got, dt in zip(gots, dts)]
    finest = min(rows, key=lambda r: r.dt)
    finest.bound, finest.least_order = bound, least_order
    finest.order = observed_order(dts, [r.error for r in rows])
    return rows


def worst(item, quantity, pairs, bound, **row):
    """The (expected, got) pair with the largest error, as a row."""
    rows = [Row(item, quantity, expected, got, bound=bound, **row) for expected, got in pairs]
    return max(rows, key=lambda r: r.error if r.error == r.error else float("inf"))

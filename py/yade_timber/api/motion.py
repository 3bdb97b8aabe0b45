# SPDX-License-Identifier: GPL-2.0-or-later
"""A ground motion from a record, with its processing. Needs no YADE."""
from dataclasses import fields
from difflib import get_close_matches
from numbers import Integral, Real
from pathlib import Path

from ..base.time_step import DEFAULT_DT
from ..motion import GroundMotion, MotionRequest, RecordError, scaled

SHIPPED = "shipped"
"""Name of the shipped ground motion."""


def ground_motion(source=SHIPPED, dt=DEFAULT_DT, **processing):
    """Ground motion of a record, for `run`.

    Parameters
    ----------
    source : str, Path or GroundMotion
        ``"shipped"`` for the synthetic motion of the package, a record's file or the common prefix of its three files
        (K-NET, KiK-net, PEER AT2, JMA CSV, plain CSV), or a motion to process further.
    dt : float
        Time step for ``resample=True``. [s]
    **processing
        ``seed`` (another synthetic motion), ``component``, ``units``, ``azimuth`` [degrees], ``start`` and ``end`` [s], ``detrend`` (order),
        ``highpass`` [Hz], and one of ``pga`` [gal], ``intensity`` (JMA) and ``scale`` [-], as in the options of the run scripts.

    Returns
    -------
    GroundMotion
        With ``dt`` [s] and ``acceleration`` (n, 3) [m/s2], columns east, north, up.

    Raises
    ------
    RecordError
        One line, for a file that is no record or a value out of range.

    Examples
    --------
    >>> weak = yt.motion("shipped", scale=0.5)
    >>> kobe = yt.motion("RSN1106_KOBE_KJM", pga=400)
    """
    given, record = None, None
    if isinstance(source, (str, Path)):
        record = None if str(source) == SHIPPED else str(source)
    elif isinstance(source, GroundMotion):
        given = source
    else:
        refuse_motion(source)
    _check_types(processing)
    request = MotionRequest(record=record, **processing)
    request.check("motion: {}")
    if given is not None and request.seed is not None:
        raise RecordError("motion: seed: a GroundMotion is given; leave one of them out")
    return scaled(request.motion(dt, given), 1.0 if request.scale is None else request.scale)


def refuse_motion(value):
    """Raise TypeError for a value that names no motion."""
    raise TypeError(f"motion {value!r:.60}: must be 'shipped', the path or prefix of a record, or a GroundMotion")


def _check_types(processing):
    """Raise TypeError for an unknown processing or a value of another type."""
    kinds = {f.name: f.metadata["kind"] for f in fields(MotionRequest) if f.name != "record"}
    for name, value in processing.items():
        require_known("motion", name, kinds)
        kind = {int: Integral, float: Real}.get(kinds[name], kinds[name])
        if value is not None and not isinstance(value, kind):
            raise TypeError(f"motion: {name} {value!r:.60}: must be of type {kinds[name].__name__}")


def require_known(function, name, known):
    """Raise TypeError for an option that a function does not have."""
    if name not in known:
        near = get_close_matches(name, known, 1)
        raise TypeError(f"{function}() has no option '{name}'; " + (f"did you mean '{near[0]}'?" if near else f"it must be one of {', '.join(known)}"))

# SPDX-License-Identifier: GPL-2.0-or-later
"""A ground motion from a record, with its processing. Needs no YADE."""
from pathlib import Path

from ..base.options import read_keywords
from ..base.remedies import close
from ..base.time_step import DEFAULT_DT
from ..motion import GroundMotion, MotionRequest, RecordError, scaled
from ..motion.readers import find_files

SHIPPED = "shipped"  # name of the shipped ground motion


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
        ``seed`` (another synthetic motion), ``component``, ``units``, ``azimuth`` [degrees], ``start`` and ``end`` [s],
        ``detrend`` (order), ``highpass`` [Hz], and one of ``pga`` [gal], ``intensity`` (JMA) and ``scale`` [-], as in
        the options of the run scripts.

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
    >>> weak = th.motion("shipped", scale=0.5)
    >>> kobe = th.motion("RSN1106_KOBE_KJM", pga=400)
    """
    record, measured = source_of(source)
    keywords = read_keywords(MotionRequest, "motion", processing, {"record": "give it as the first argument"})
    request = MotionRequest(**{**keywords, "record": record})
    request.check("motion: {}".format)
    return scaled(request.motion(dt, measured), request.factor)


def source_of(motion):
    """(record or None, GroundMotion or None): both None for the shipped motion. Raises TypeError, RecordError."""
    if isinstance(motion, GroundMotion):
        return None, motion
    if not isinstance(motion, (str, Path)):
        raise TypeError(f"motion {motion!r:.60}: must be 'shipped', the path or prefix of a record, or a GroundMotion")
    if str(motion) == SHIPPED:
        return None, None
    try:
        find_files(motion)
    except RecordError as problem:
        raise RecordError(f"{problem}; did you mean '{SHIPPED}'?" if close(motion, [SHIPPED])
                          else str(problem)) from None
    return str(motion), None

# SPDX-License-Identifier: GPL-2.0-or-later
"""Item 9: the shaken portal frame of reference_frame.py, in YADE and without it."""
import reference_frame
import yade.wrapper as yw
from planar_scene import build_frame, places, recorded
from rows import Registry, Row
from yade.minieigenHP import Vector3

case = Registry()
O = yw.Omega()
EVERY = 5e-3
"""Between compared instants. [s]"""
DURATION = 1.0
"""[s] At rest until 0.3 s, feet and brace slide from 0.5 s, the right foot is 8 mm up at 0.8 s."""
REFERENCE_DT = 2e-5
"""Largest step at which the explicit dashpots of the brace are stable with room to spare. [s]"""


def in_yade(dt, **options):
    """Displacements (m, parts, 3) of the frame in YADE [m]."""
    motion = yw.GroundMotionEngine(
        step=reference_frame.SAMPLE, acceleration=[Vector3(a, 0, 0) for a in reference_frame.ground_samples()], start=reference_frame.START
    )
    build_frame(reference_frame.portal(), dt, ground_motion=motion, **options)
    start = places()
    return recorded(DURATION, EVERY, places) - start


def in_plane(places):
    """x + i z of places (..., 3)."""
    return places[..., 0] + 1j * places[..., 2]


@case
def portal_frame():
    """Histories of all parts: with the reference's own scheme, and with the package's dashpots at its own step."""
    moved, _, last = reference_frame.history(REFERENCE_DT, DURATION, EVERY)
    peak = abs(moved).max()
    explicit = in_yade(REFERENCE_DT, sweeps=0)
    rows = [
        # The scene is the same only if it slides and lifts: no row would tell otherwise.
        Row("9", "portal: did feet slide (> 1 mm) and lift (> 1 mm)? [-]", 1, float(last.slid > 1e-3 and moved[:, 1:3].imag.max() > 1e-3), bound=0),
        # Same equations, same scheme, written twice: rounding, 1e-16 m per step, grown by impacts of stiff contacts. Seen: 1e-12 to 3e-10, as the order of products has it.
        Row("9", "portal: explicit dashpots, largest distance [m]", 0, abs(in_plane(explicit) - moved).max(), bound=1e-9, dt=REFERENCE_DT, note=f"of {peak:.3g} m"),
        # The prisms are symmetric about the plane: nothing pushes them out of it but rounding.
        Row("9", "portal: out of the plane [m]", 0, abs(explicit[:, :, 1]).max(), bound=1e-12, dt=REFERENCE_DT),
    ]
    for dt, bound in ((1e-4, 5e-3), (5e-5, 5e-3)):
        # Step size: landings are resolved to dt, and what a foot has slid by then stays. Seen: 1.2e-3 and 4e-4 of the peak.
        off = abs(in_plane(in_yade(dt)) - moved).max() / peak
        rows.append(Row("9", "portal: implicit dashpots, largest distance / peak [-]", 0, off, bound=bound, dt=dt, note=f"peak {peak:.3g} m"))
    return rows

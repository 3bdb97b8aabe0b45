# SPDX-License-Identifier: GPL-2.0-or-later
"""Origin of a run in one line, shown by every picture of it: record, factor, PGA, intensity, time step, versions. Needs no YADE."""
from ..motion import GAL, GroundMotion, jma_intensity, pga


def provenance(frames):
    """'Record ojiya_like.csv x 1, PGA 1308 gal, JMA intensity 6.8; time step 0.00025 s; yade-timber 1.0, YADE 2023.02a'"""
    found = frames.summary or {}
    parts = [shaking(frames, found.get("record") or {})]
    if found.get("dt"):
        parts.append(f"time step {found['dt']:g} s")
    host = (found.get("versions") or {}).get("yade")
    parts.append(", ".join(filter(None, (f"yade-timber {frames.version}".strip(), host and f"YADE {host}"))))
    return "; ".join(filter(None, parts))


def shaking(frames, record):
    """Record, factor, PGA and intensity of the motion as applied. record: of the summary"""
    if frames.motion is None:
        return "No ground motion"
    applied = GroundMotion(frames.motion.dt, frames.motion.acceleration)
    factor = f" x {record['scale']:g}" if record.get("scale") is not None else ""
    source = f"Record {record['source']}{factor}" if record.get("source") else "Ground motion"
    intensity = jma_intensity(applied).official
    return f"{source}, PGA {pga(applied):.0f} gal, JMA intensity {intensity:.1f}"

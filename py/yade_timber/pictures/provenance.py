# SPDX-License-Identifier: GPL-2.0-or-later
"""Origin of a run in one line, shown by every picture of it: record, factor, PGA, intensity, place in an ensemble, time step, versions."""
from ..motion import GroundMotion, jma_intensity, pga
from ..recording.sentences import place_in_ensemble

SHORTEST = 1.0
"""Duration of a motion that has an intensity. [s]"""


def provenance(frames):
    """'Record ojiya_like.csv x 1, PGA 1308 gal, JMA intensity 6.7; time step 0.00025 s; yade-timber 1.0, YADE 2023.02a'"""
    found = frames.summary or {}
    record, versions = (part if isinstance(part, dict) else {} for part in (found.get("record"), found.get("versions")))
    step = f"time step {found['dt']:g} s" if isinstance(found.get("dt"), (int, float)) else ""
    programs = [f"yade-timber {frames.version}".strip(), f"YADE {versions['yade']}" if versions.get("yade") else ""]
    return "; ".join(filter(None, (shaking(frames, record), place_in_ensemble(found), step, ", ".join(filter(None, programs)))))


def shaking(frames, record):
    """Record, factor, PGA and intensity of the motion as applied. record: of the summary"""
    if frames.motion is None:
        return "No ground motion"
    applied = GroundMotion(frames.motion.dt, frames.motion.acceleration)
    source = f"Record {record['source']}" if record.get("source") else "Ground motion"
    factor = f" x {record['scale']:g}" if isinstance(record.get("scale"), (int, float)) else ""
    parts = [source + factor, f"PGA {pga(applied):.0f} gal"]
    if applied.duration >= SHORTEST and pga(applied) > 0:
        parts.append(f"JMA intensity {jma_intensity(applied).official:.1f}")
    return ", ".join(parts)

# SPDX-License-Identifier: GPL-2.0-or-later
"""Origin of a run in one line: record, factor, PGA, intensity, place in an ensemble, time step, versions."""
from ..motion import GroundMotion, pga
from ..motion.measures import stated_intensity
from ..text import english


def provenance(frames, language=english):
    """'Record ojiya_like.csv x 1, PGA 1308 gal, ...; time step 0.00025 s; ...'. language: module of text/"""
    return "; ".join(parts(frames, language))


def parts(frames, language=english):
    """The parts of `provenance`, the most important first."""
    summary, words = frames.summary, language.ORIGIN
    texts, programs = [shaking(frames, words)], f"yade-timber {frames.version}".strip()
    if summary:
        place = language.place_in_ensemble(summary.ensemble) if summary.ensemble else ""
        texts += [place, f"{words['step']} {summary.dt:g} s"]
        programs += f", YADE {summary.versions.yade}"
    return [*filter(None, (*texts, programs))]


def shaking(frames, words):
    """Record, factor, PGA and intensity of the motion as applied; of a user's scene it is unknown."""
    if frames.motion is None:
        return words["none"] if frames.scenario else ""
    applied = GroundMotion(frames.motion.dt, frames.motion.acceleration)
    record = frames.summary and frames.summary.record
    source = f"{words['record']} {record.source}" if record and record.source else words["motion"]
    factor = f" x {record.scale:g}" if record else ""
    parts = [source + factor, f"PGA {pga(applied):.0f} gal"]
    intensity = stated_intensity(applied)
    if intensity is not None:
        parts.append(f"{words['intensity']} {intensity:.1f}")
    return ", ".join(parts)

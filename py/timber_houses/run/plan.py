# SPDX-License-Identifier: GPL-2.0-or-later
"""RunOptions -> Scenario, or plan of a town: motion, duration and snow depth that options leave to files."""
from dataclasses import dataclass, replace

from ..base.notes import noted
from ..house import Town, load_town
from ..motion import constant_note, interpolation_error, onset
from ..motion.processing import in_axes
from ..recording.summary_parts import PartOfRecord, Record
from ..scene.scenario import Scenario


@dataclass(frozen=True)
class TownPlan:
    """A Town, (Scenario, RunOptions) of each lot, and Record of the motion that reaches the town, or None."""

    town: Town
    lots: list
    record: object


@noted()
def planned(options):
    """Scenario, or TownPlan of a town. Raises HouseError, RecordError."""
    motion = options.requested_motion()
    if options.town is None:
        return _scenario(options, motion)
    town = load_town(options.town)
    delays = town.delays()
    last = max(delays) if motion else 0.0
    lots = []
    for lot, delay in zip(town.lots, delays):
        own = replace(options, name=f"{options.title}.{lot.name}", house=lot.house,
                      snow=options.snow if lot.snow is None else lot.snow,
                      out=options.folder / "lots" / lot.name, no_views=True, quiet=True)
        with lot.located():
            lots.append((_scenario(own, motion and in_axes(motion, lot.axes), delay, last, lot.name), own))
    return TownPlan(town, lots, motion and record(motion, options.factor, options.dt))


def _scenario(options, motion, delay=0.0, last=0.0, lot=None):
    """motion: GroundMotion or None; delay: time at which it begins, last: the largest of a town [s]; lot: its name"""
    duration = options.simulated(motion) + (last if options.duration is None else 0.0)
    return Scenario(options.title, options.house, motion, snow_depth=options.snow, scale=options.factor,
                    delay=delay if motion else 0.0, dt=options.dt, duration=duration,
                    until_collapse=options.until_collapse, until_rest=options.duration is None,
                    joint_damping=options.joint_damping, wall_level=options.walls, disturb=options.disturb,
                    options={"skip_rest": 0} if options.every_step else {},
                    record=motion and record(motion, options.factor, options.dt, delay), lot=lot)


def record(motion, scale, dt, delay=0.0):
    """Record of the summary: the motion times a factor in a run of time step dt, from `delay` on [s]. Raises
    RecordError."""
    parts = [PartOfRecord(source=part.source, start_s=round(part.start, 6), duration_s=round(part.duration, 6),
                          scale=scale * part.scale, pga_gal=_scaled(part.pga_gal, scale)) for part in motion.parts]
    begin, end = (None if time is None else time + delay for time in (onset(motion), onset(motion, 0.95)))
    return Record(source=motion.source or motion.name, pga_gal=_scaled(motion.pga_gal, scale), scale=scale,
                  dt=motion.dt, interpolation_error=round(interpolation_error(motion, dt), 6), onset_s=begin,
                  strong_end_s=end,
                  note=constant_note(motion, scale) or None, sequence=parts or None)


def _scaled(accelerations, scale):
    return {axis: round(scale * value, 6) for axis, value in accelerations.items()}

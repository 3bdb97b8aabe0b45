# SPDX-License-Identifier: GPL-2.0-or-later
"""The same run with rated walls of the other level, for a report with both verdicts."""

from ..base.errors import RunError
from ..house import LEVELS, has_rated_walls, load_house
from ..recording.summary import OtherWalls
from .driver import Task, run_missing

OPTION = "--walls"


def run(script, scenario, output):
    """OtherWalls of the summary; None for a house without rated walls.

    The run is in the folder walls_LEVEL of the results. script: path of the run script; output: run.cli.Output. Raises HouseError, RunError,
    and KeyboardInterrupt after a signal.
    """
    data = load_house(scenario.house).data
    if not has_rated_walls(data):
        return None
    (level,) = set(LEVELS) - {scenario.wall_level or data["law"]["wall_level"]}
    task = Task(script.stem, output.folder / f"walls_{level}", (*_without_walls(output.options), OPTION, level), frames=False, house=scenario.house)
    report = (lambda _line: None) if output.quiet else lambda line: print(line, flush=True)
    found = run_missing([task], script.resolve().parent, 1, report)[task]
    if found is None:
        raise RunError(f"the run with walls of the level {level} has no results: {task.error or task.folder}")
    return OtherWalls(level=level, verdict=found.verdict, peak_drift=found.peak_drift)


def _without_walls(options):
    """The options of a command line without --walls LEVEL and --walls=LEVEL."""
    kept = []
    for before, option in zip(("", *options), options):
        if OPTION not in (before, option) and not option.startswith(f"{OPTION}="):
            kept.append(option)
    return tuple(kept)

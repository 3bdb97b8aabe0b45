#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Rank strengthening measures of a house: a brace in each free bay, double fittings in each group of joints, snow
cleared.

    scripts/study/retrofit.py HOUSE [--group wall] [--motions N | --records FOLDER] [--pga GAL | --intensity I | --scale
    X] [--snow 1] [-j 2] [--pictures 2]

Each measure is compared with the original house under the same motions. The first motions select three measures, the
others test them (paired exact test of the collapses or of the drifts, Holm's correction). The motions are scaled so
that about half of them bring the house down, unless the options give their strength. Writes index.html (overview with
links to the runs) and retrofit.csv. All rows are checked before the first run. Stop it at any time: the same command
continues.
"""

from dataclasses import replace
from pathlib import Path

from study_common import house_name

from timber_houses.base.atomic_write import write_text
from timber_houses.base.errors import RunError
from timber_houses.base.time_step import DEFAULT_DT
from timber_houses.pictures import all_pictures
from timber_houses.study.driver import Task, run_missing
from timber_houses.study.options import (Parser, add_driver_options, count, list_of, non_negative, positive,
                                         run_script)
from timber_houses.study.retrofit import motions, overview, race
from timber_houses.study.retrofit.candidates import GROUPS, KINDS, USUAL_KINDS, candidates
from timber_houses.study.retrofit.runs import Ranking


def arguments():
    made = Parser(__doc__)
    add_driver_options(made, "results/study_retrofit")
    made.add_argument("house", type=house_name, metavar="HOUSE", help="shipped house or house file")
    made.add_argument("--motions", type=count, metavar="N",
                      help=f"number of synthetic motions (default: {race.TESTS} for the test, and those that select the"
                           " measures to be tested)")
    made.add_argument("--records", type=Path, metavar="FOLDER",
                      help="folder of recorded motions, instead of synthetic ones")
    made.add_argument("--units", metavar="UNIT", help="unit of records that state none: gal, m/s2 or g")
    strength = made.add_mutually_exclusive_group()
    strength.add_argument("--pga", type=positive, metavar="GAL", help="scale each motion to this PGA [gal]")
    strength.add_argument("--intensity", type=positive, metavar="I", help="scale each motion to this JMA intensity")
    strength.add_argument("--scale", type=positive, metavar="X", help="factor on each motion")
    made.add_argument("--snow", type=non_negative, default=0.0, metavar="M",
                      help="snow depth [m] (default %(default)g)")
    made.add_argument("--kinds", type=list_of(str), default=list(USUAL_KINDS), metavar="KIND,KIND",
                      help=f"of {', '.join(KINDS)} (default: {', '.join(USUAL_KINDS)})")
    made.add_argument("--group", choices=GROUPS, default="bay", help="braces and walls in one free bay, or in all free"
                      " bays of a wall of a storey (default %(default)s)")
    made.add_argument("--only", type=list_of(str), default=[""], metavar="TEXT,TEXT",
                      help="only measures whose names contain such a text")
    made.add_argument("--dt", type=positive, default=DEFAULT_DT, metavar="S",
                      help="time step [s] (default %(default)g)")
    made.add_argument("--end", type=positive, default=motions.END, metavar="S",
                      help="end of the synthetic motions [s] (default %(default)g)")
    made.add_argument("--pictures", type=count, metavar="N",
                      help="repeat the house and the best N measures with pictures and report")
    made.add_argument("--dry-run", action="store_true", help="check all rows, print the number of runs, and end")
    return made.parse_args()


def target_of(options):
    """{'pga' | 'intensity' | 'scale': number} of the motions, empty where the ranking chooses their strength."""
    given = {key: getattr(options, key) for key in ("pga", "intensity", "scale")}
    return {key: value for key, value in given.items() if value is not None}


def ranking_of(options):
    """The Ranking that the options ask for. Raises RunError, BatchError, RecordError, HouseError."""
    unknown = set(options.kinds) - set(KINDS)
    if unknown:
        raise RunError(f"--kinds {', '.join(sorted(unknown))}: must be of {', '.join(KINDS)}")
    found = candidates(options.house, options.snow, options.kinds, options.only, options.group)
    if not found:
        raise RunError(f"{options.house}: no measure of these kinds and names")
    number = options.motions or race.default_motions(len(found))
    shaking = (motions.records(options.records, target_of(options), options.units) if options.records
               else motions.seeds(number, target_of(options), options.end))
    needed = race.needed_motions(len(found))
    if len(shaking) < needed:
        raise RunError(f"{len(shaking)} motions are too few to select and to test {len(found)} measures; give at least"
                       f" {needed}")
    same = {"house": options.house, "snow": options.snow, "until_collapse": True, "dt": options.dt}
    return Ranking(options.out, found, shaking, same, options.jobs)


def cheaper(ranking, options):
    """'; --group wall: 120' where a ranking of whole walls has fewer runs, else ''."""
    grouped = len(candidates(options.house, options.snow, options.kinds, options.only, "wall"))
    fewer = 0 < grouped < len(ranking.candidates)
    return f"; --group wall: {race.cost(len(ranking.motions), grouped)}" if fewer else ""


def pictures(ranking, results, number):
    """Repeat the house as it is and the best measures with frames, under the motion worst for the house; returns
    [(text, folder)].
    """
    worst = max(ranking.tests, key=lambda motion: race.response(ranking.house.runs[motion]))
    chosen = [ranking.house, *(result.entry for result in results[:number] if worst in result.entry.runs)]
    tasks = {entry.candidate.text: Task(ranking.folder / "pictures" / entry.candidate.name,
                                        replace(ranking.task(entry, worst).options, no_frames=False))
             for entry in chosen}
    done = run_missing(tasks.values(), ranking.jobs)
    drawn = {text: task.folder for text, task in tasks.items() if done[task]}
    for folder in drawn.values():
        all_pictures.write(folder, page=True)
    return [(f"{text}, {worst}", folder.relative_to(ranking.folder)) for text, folder in drawn.items()]


def write(ranking, options, strength, shown=()):
    """Write overview and table; returns the results. strength: sentence about the choice of the motions' strength"""
    results, name = race.ranking(ranking.entries, ranking.house, ranking.tests), Path(options.house).stem
    scaled = "".join(f", {key} {value:g}" for key, value in target_of(options).items())
    source = f"records of {options.records.name}" if options.records else "synthetic motions like the Ojiya record"
    snow = f", {options.snow:g} m of snow" if options.snow else ""
    filled = ", those with braces or walls in all free bays of a wall at once" if options.group == "wall" else ""
    runs = [run for entry in (ranking.house, *ranking.entries) for run in entry.runs.values()]
    about = [f"House {name}{snow}; {len(ranking.motions)} {source}{scaled};"
             f" {len(ranking.candidates)} measures{filled}.",
             f"{len(runs)} runs, {sum(run['wall_s'] for run in runs) / 60:.0f} minutes of computing.",
             *filter(None, [strength]), overview.summary(results)]
    write_text(ranking.folder / "retrofit.csv", overview.table_text(results))
    write_text(ranking.folder / "index.html",
               overview.page(f"Strengthening of house {name}", about, results, ranking.house, shown))
    return results


def main():
    options = arguments()
    ranking = ranking_of(options)
    ranking.check()
    runs = race.cost(len(ranking.motions), len(ranking.candidates))
    print(f"{len(ranking.candidates)} measures, {len(ranking.motions)} motions: {runs} runs{cheaper(ranking, options)}")
    if options.dry_run:
        return 0
    print(ranking.estimate(pilots=not target_of(options)), flush=True)
    strength = "" if target_of(options) else ranking.choose_scale()
    ranking.run()
    results = write(ranking, options, strength)
    if options.pictures:
        write(ranking, options, strength, pictures(ranking, results, options.pictures))
    print(overview.summary(results))
    print(f"written: {ranking.folder / 'index.html'}, {ranking.folder / 'retrofit.csv'}")
    return int(any(entry.failed for entry in ranking.entries))


if __name__ == "__main__":
    run_script(main)

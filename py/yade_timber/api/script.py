# SPDX-License-Identifier: GPL-2.0-or-later
"""The run scripts: `main`, `main_house` and `main_town` turn the command line into a run in this process, or into an
ensemble of processes of the same script."""
import signal
import sys
from pathlib import Path

from ..run.launch import launch, leave


def main(house, earthquake=False, snow=False, argv=None):
    """Run a house (name of a shipped one, or path of a YAML file); returns the Run.

    earthquake, snow: loads of the script; argv: command line (default: sys.argv)
    """
    return _launch(lambda cli, arguments: cli.read(house, earthquake, snow, arguments), argv)


def main_house(argv=None):
    """Run the house that the command line names; returns the Run."""
    return _launch(lambda cli, arguments: cli.read_house(arguments), argv)


def main_town(argv=None):
    """Run the town that the command line names; returns the TownRun."""
    return _launch(lambda cli, arguments: cli.read_town(arguments), argv)


def _launch(read, argv):
    script = Path((sys.argv if argv is None else argv)[0])
    return launch(
        lambda cli, arguments: _planned(script, read(cli, arguments)),
        lambda scenario, options: _ensemble(script, scenario, options),
        argv,
    )


def _planned(script, options):
    """(Scenario or TownPlan, options); with a report, after a run with walls of the other level. Raises InputError."""
    from ..run.plan import planned
    from ..study import other_walls

    scenario = planned(options)
    if options.report and options.ensemble is None:
        try:
            scenario.other_walls = other_walls.run(script, options)
        except KeyboardInterrupt:
            leave("stopped; the same command continues", 128 + signal.SIGINT)
    return scenario, options


def _ensemble(script, scenario, options):
    """Run an ensemble; returns the RunResult of the run that it shows. Raises InputError."""
    from ..run import runner, session
    from ..study import ensemble
    from .result import RunResult

    scenario.build_model()  # a fault of the house is reported once
    try:
        with session.reserved(options):
            runner.clear(options, *runner.RECORDED, *runner.STATE)
            ensemble.complete(script, options)
    except KeyboardInterrupt:
        leave("stopped; the same command continues", 128 + signal.SIGINT)
    return RunResult(options.folder)

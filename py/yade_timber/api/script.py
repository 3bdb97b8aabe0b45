# SPDX-License-Identifier: GPL-2.0-or-later
"""The run scripts: `main`, `main_house` and `main_town` turn the command line into a run in this process, or into an ensemble of processes of the
same script."""
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
    return launch(lambda cli, arguments: _with_other_walls(script, *read(cli, arguments)), lambda scenario, output: _ensemble(script, scenario, output), argv)


def _with_other_walls(script, scenario, output):
    """(scenario, output), for a report on a house with rated walls after a run with those of the other level. Raises InputError."""
    from ..run.cli import TownPlan
    from ..study import other_walls

    if output.report and output.ensemble is None and not isinstance(scenario, TownPlan):
        try:
            output.other_walls = other_walls.run(script, scenario, output)
        except KeyboardInterrupt:
            leave("stopped; the same command continues", 128 + signal.SIGINT)
    return scenario, output


def _ensemble(script, scenario, output):
    """Run an ensemble; returns the RunResult of the run that it shows. Raises InputError."""
    from ..run import runner, session
    from ..study import ensemble
    from .result import RunResult

    scenario.build_model()  # a fault of the house is reported once
    try:
        with session.reserved(output.folder):
            runner.clear(output.folder, *runner.RECORDED, *runner.STATE)
            ensemble.complete(script, scenario.house, output)
    except KeyboardInterrupt:
        leave("stopped; the same command continues", 128 + signal.SIGINT)
    return RunResult(output.folder)

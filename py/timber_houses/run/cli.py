# SPDX-License-Identifier: GPL-2.0-or-later
"""Command line of the run scripts -> RunOptions. YADE's own options (-n, -x, -j2) stand before the script."""
import argparse
import re
from pathlib import Path

from ..base.errors import RunError
from ..base.options import BY_SCRIPT, HIDDEN, add_options, command_option, options, read_arguments
from ..base.remedies import close
from ..motion import with_then
from ..text import english
from .options import SNOW_DEPTH, RunOptions, scripted

GROUPS = {"run": "time and results", "motion": "ground motion"}
"""Titles of groups of options in the help, after the main ones."""
NUMBER = re.compile(r"-(\d|\.\d|inf|nan)")  # beginning of a negative number, which is no option


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise RunError(f"{message} (options: {self.prog} -h; YADE's own options stand before the script)")

    def parse(self, argv):
        """{option: value} of a command line (as sys.argv). Raises RunError."""
        arguments, unknown = self.parse_known_args(with_then(argv[1:]))
        if unknown:
            match = (close(unknown[0].partition("=")[0], self._option_string_actions) if unknown[0].startswith("--")
                     else None)
            self.error(f"unrecognized arguments: {' '.join(unknown)}" + (f"; did you mean '{match}'?" if match else ""))
        town = {"town": arguments.town} if "town" in arguments else {}
        return {**read_arguments(RunOptions, arguments), **town}


def parser(script, file=None, loads=""):
    """ArgumentParser of a run script. file: kind of its input file, None: the script gives house and `loads`"""
    prog, name = f"yade [-n] [-x] {script}.py", f"{file.upper()} " if file else ""
    about = (f"{loads}Results go to results/<name of the {file or 'script'}{' file' if file else ''}>/, or to the"
             " folder of --out.")
    reader = _Parser(prog=prog, usage=f"{prog} {name}[options]", allow_abbrev=False, description=about)
    reader._negative_number_matcher = NUMBER
    offered = {each: field for each, field in options(RunOptions).items()
               if each != "house" and (file or each not in BY_SCRIPT)}
    if file:
        reader.add_argument(file, metavar=file.upper(),
                          help="town file" if file == "town" else options(RunOptions)["house"].metadata["help"])
    for group in ("main", *GROUPS, HIDDEN):
        place = reader if group in ("main", HIDDEN) else reader.add_argument_group(GROUPS[group])
        add_options(place, [field for field in offered.values() if field.metadata["group"] == group])
    return reader


def read(house, earthquake, snow, argv):
    """RunOptions of a script that gives house and loads. argv: as sys.argv. Raises RunError, RecordError."""
    script = Path(argv[0]).stem
    loads = f"House {house}: {english.loads(earthquake, SNOW_DEPTH if snow else 0)}. "
    return scripted(script, house, earthquake, snow, **parser(script, loads=loads).parse(argv)).check()


def read_house(argv):
    """RunOptions of scripts/house.py, which runs any house. Raises RunError, RecordError."""
    return RunOptions(**parser("house", "house").parse(argv)).check()


def read_town(argv):
    """RunOptions of scripts/town.py, which runs a town. Raises RunError, RecordError."""
    request = RunOptions(**parser("town", "town").parse(argv)).check()
    for name in ("export", "ensemble", "disturb", "report"):
        if getattr(request, name):
            raise RunError(f"{command_option(name)}: not for towns; run a house with scripts/house.py")
    return request

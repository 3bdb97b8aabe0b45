# SPDX-License-Identifier: GPL-2.0-or-later
"""A run of a batch or a study: its options, the changes of its house, and a name that follows from both."""
import re
from dataclasses import asdict, dataclass
from pathlib import Path

from ...base.errors import RunError
from ...base.options import is_given, option, options
from ...run.identity import content, made_from, of_values
from ...run.options import RunOptions

NO_EARTHQUAKE = "none"  # value of the column `record` for a run without an earthquake
DECISIVE = {name: each for name, each in options(RunOptions).items() if each.metadata["decides"] and name != "quake"}


class BatchError(RunError):
    """A row or table that cannot be run; the message is one line: place, column, admissible values."""


@dataclass(frozen=True)
class HouseChanges:
    """Columns that change the house of a row; in a table ; separates the entries of a list."""

    set: tuple = option(str, "changes of the house: key=value;key=value, keys as in house files, list items counted"
                        " from 1", default=())
    braces: tuple = option(str, "names of braces and walls to add to the house, separated by ;", default=())
    strength: float = option(float, "factor on the strength of all joints (default 1)", default=1.0)


HOUSE_CHANGES = options(HouseChanges)


@dataclass(frozen=True)
class Row:
    """One run. options: RunOptions with the house before its changes; place: of messages, 'runs.txt:5'; line: of a
    table."""

    options: RunOptions
    changes: HouseChanges = HouseChanges()
    description: str = ""
    place: str = "row"
    line: int | None = None

    def where(self, column):
        """'runs.txt:5, column scale'."""
        return f"{self.place}, column {column}"

    @property
    def name(self):
        """Name of the run and its folder: it follows from its options and the content of its house and record."""
        origin = content(made_from(self.options))
        if origin["content of files"] is None:  # faulty ones, reported by the check
            origin["content of files"] = [self.options.house, self.options.record, self.options.then]
        label = self.description or Path(self.options.house).stem
        return f"{re.sub(r'[^A-Za-z0-9._+=-]+', '_', label)[:60]}-{of_values([origin, asdict(self.changes)])[:8]}"

    @property
    def cells(self):
        """{column: value} of a table with this row, without defaults."""
        given = {name: getattr(part, name) for part, names in ((self.options, DECISIVE), (self.changes, HOUSE_CHANGES))
                 for name in names if is_given(part, name)}
        calm = {} if self.options.shaken else {"record": NO_EARTHQUAKE}
        return {name: ";".join(value) if isinstance(value, tuple) else value for name, value in (given | calm).items()}

# SPDX-License-Identifier: GPL-2.0-or-later
"""Progress of the run of a town on standard error: a bar."""
import sys

from tqdm import tqdm

from .progress import BAR, LOG_REFRESH, TERMINAL_REFRESH


class TownProgress:
    """Bar of the mean simulated time of all lots, a context. ends: of the lots [s]; quiet: print nothing"""

    def __init__(self, name, ends, quiet):
        self.count = len(ends)
        refresh = TERMINAL_REFRESH if sys.stderr.isatty() else LOG_REFRESH
        self.bar = tqdm(total=sum(ends) / self.count, desc=name, bar_format=BAR, mininterval=refresh, disable=quiet)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.bar.close()

    def update(self, times):
        """Refresh the bar. times: of the lots [s]"""
        self.bar.update(min(sum(times) / self.count, self.bar.total) - self.bar.n)

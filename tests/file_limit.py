# SPDX-License-Identifier: GPL-2.0-or-later
"""A limit of the size of files, as by `ulimit -f`."""
import resource
from contextlib import contextmanager


@contextmanager
def file_limit(size):
    """Context in which no file, also none in memory, grows beyond a size. [bytes]"""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)

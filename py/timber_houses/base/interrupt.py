# SPDX-License-Identifier: GPL-2.0-or-later
"""Ctrl-C at a time when the process can take it."""
import signal
from contextlib import contextmanager


@contextmanager
def deferred_interrupt():
    """Ctrl-C takes effect at the end of the block: within an import it may crash compiled modules."""
    received = []
    before = signal.signal(signal.SIGINT, lambda *_: received.append(True))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
    if received:
        raise KeyboardInterrupt

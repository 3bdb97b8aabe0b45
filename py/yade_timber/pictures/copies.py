# SPDX-License-Identifier: GPL-2.0-or-later
"""Copies of this process (fork), which draw at the same time; what it has loaded need not be sent."""
import ctypes
import gc
import multiprocessing
import os
import signal
import threading
from contextlib import contextmanager, suppress

from ..base.errors import RunError

fork = multiprocessing.get_context("fork")
PR_SET_PDEATHSIG = 1
"""Of prctl(2): the signal that a process gets when the one that made it ends."""
WAITING = "IPythonHistorySavingThread"
"""Thread that YADE has from IPython; it waits until a user types a line."""


def possible():
    """Whether copies are of use and safe: several processors, no other thread at work, no OpenGL."""
    from . import renderer  # here: a run without pictures needs none

    at_work = [thread for thread in threading.enumerate() if thread.name != WAITING]
    return len(os.sched_getaffinity(0)) > 1 and len(at_work) == 1 and not renderer.used()


@contextmanager
def ahead(make):
    """Context with an iterator over `make()`; a copy of this process makes the next item while this one uses the last.

    The iterator raises RunError when the copy is killed, and any exception of the generator. Without copies it makes
    the items itself.
    """
    if not possible():
        yield make()
        return
    receiver, sender = fork.Pipe(duplex=False)
    fork.Process(target=_send_all, args=(make, sender, receiver, os.getpid()), daemon=True).start()
    sender.close()
    with receiver:  # when it is closed, a copy that is not at its end stops
        yield _received(receiver)


def _send_all(make, sender, receiver, original):
    """In the copy: send all items. It ends with the process `original`, not by Ctrl-C."""
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != original:  # killed before
        return
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    gc.freeze()  # leaves the other process's objects out of garbage collections, which take a tenth of the time
    receiver.close()
    with suppress(BrokenPipeError):  # the other process does not want more
        try:
            for item in make():
                sender.send(item)
            sender.send(StopIteration())
        except BrokenPipeError:
            raise
        except Exception as problem:
            sender.send(problem)


def _received(receiver):
    while True:
        try:
            item = receiver.recv()
        except EOFError:
            raise RunError("a process that draws was killed, as by lack of memory") from None
        if isinstance(item, StopIteration):
            return
        if isinstance(item, Exception):
            raise item
        yield item

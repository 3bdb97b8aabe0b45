# SPDX-License-Identifier: GPL-2.0-or-later
"""Copies of this process (fork), which draw while it does something else. What it has loaded, they have: frames need not be sent. Needs no YADE."""
import gc
import multiprocessing
import os
import signal
import threading
from contextlib import contextmanager

from ..base.errors import RunError

fork = multiprocessing.get_context("fork")


def possible():
    """Whether copies are of use and safe: there is more than one processor, one Python thread (a live session has more), and no OpenGL."""
    from . import renderer  # here: a run without pictures needs none

    return len(os.sched_getaffinity(0)) > 1 and threading.active_count() == 1 and not renderer.used()


def begin():
    """For the start of a copy: Ctrl-C ends it with this process only; objects of this process are left out of its garbage collections, which take a
    tenth of its time."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    gc.freeze()


@contextmanager
def ahead(make):
    """Context with an iterator over the items of `make()`, a generator; a copy of this process makes the next item while this one uses the last.

    Raises RunError when the copy ends too early, and any exception of the generator.
    """
    if not possible():
        yield make()
        return
    receiver, sender = fork.Pipe(duplex=False)
    copy = fork.Process(target=_send_all, args=(make, sender, receiver), daemon=True)
    copy.start()
    sender.close()
    try:
        yield _received(receiver)
    finally:
        receiver.close()  # a copy that is not at its end stops here
        copy.join()


def _send_all(make, sender, receiver):
    begin()
    receiver.close()
    try:
        for item in make():
            sender.send(item)
        sender.send(StopIteration())
    except BrokenPipeError:
        pass
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

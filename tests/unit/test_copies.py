# SPDX-License-Identifier: GPL-2.0-or-later
# runner: python
"""Copies of a process that draw: order, errors, loss of a copy, when they are possible. Needs no YADE."""
import os
import signal
import threading

import pytest
from yade_timber.base.errors import RunError
from yade_timber.pictures import copies


@pytest.fixture
def two_processors(monkeypatch):
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1})


def test_another_process_makes_the_items_in_order(two_processors):
    with copies.ahead(lambda: ((number, os.getpid()) for number in range(50))) as items:
        numbers, processes = zip(*items)
    assert numbers == tuple(range(50)) and set(processes).isdisjoint({os.getpid()}) and len(set(processes)) == 1


def test_a_reader_that_stops_ends_the_copy(two_processors):
    """The copy waits for the reader with items of 1 MB; the block ends although it has 1000 of them."""
    with copies.ahead(lambda: (bytes(10**6) for _ in range(1000))) as items:
        assert len(next(items)) == 10**6


def fails():
    yield 1
    raise RunError("no OpenGL")


def dies():
    yield 1
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.parametrize("make, said", [(fails, "no OpenGL"), (dies, "was killed")])
def test_errors_of_the_copy(two_processors, make, said):
    with copies.ahead(make) as items:
        assert next(items) == 1
        with pytest.raises(RunError, match=said):
            next(items)


def test_no_copies_beside_a_thread_at_work(two_processors):
    assert copies.possible()
    done = threading.Event()
    for name, possible in (("worker", False), (copies.WAITING, True)):
        thread = threading.Thread(target=done.wait, name=name)
        thread.start()
        assert copies.possible() is possible
        done.set()
        thread.join()
        done.clear()


def test_one_processor_makes_no_copies(monkeypatch):
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0})
    with copies.ahead(lambda: iter([os.getpid()])) as items:
        assert list(items) == [os.getpid()]

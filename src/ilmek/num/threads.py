"""Threads: the same work on the parts of a large task, on all processors at hand.

Kernels run without the interpreter's lock. The parts must not depend on each other, so that the result is that of one
thread.
"""

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

Part = TypeVar("Part")
Done = TypeVar("Done")

MOST_THREADS = 4


def in_threads(work: Callable[[Part], Done], parts: Iterable[Part]) -> Iterator[tuple[Part, Done]]:
    """Each part and its result, in order; after an error or an interrupt no further part begins.

    >>> list(in_threads(abs, [-1, 2, -3]))
    [(-1, 1), (2, 2), (-3, 3)]
    """
    every = list(parts)
    if len(every) == 1:
        yield every[0], work(every[0])
        return
    pool = ThreadPoolExecutor(min(MOST_THREADS, os.cpu_count() or 1))
    try:
        yield from zip(every, pool.map(work, every), strict=True)
    finally:
        pool.shutdown(cancel_futures=True)

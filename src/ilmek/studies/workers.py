"""Where designs are evaluated: in this process, in processes of their own, or on a Dask cluster."""

import multiprocessing
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import ExitStack
from importlib import import_module
from threading import current_thread, main_thread
from typing import Any

from ilmek.errors import ParameterError
from ilmek.params import Value
from ilmek.studies.outcome import DIED, Outcome, Question, evaluated

MOST_WORKERS = 64
"""Largest number of processes."""

CHUNK = 16
"""Designs that a worker gets at once."""

Design = Mapping[str, Value]


class Workers:
    """Evaluates designs; the outcomes come in the order of the designs. Use it in a `with` block.

    count    processes; 1: this one, unless a time limit needs another
    cluster  address of a Dask scheduler; None: none
    A process that ends by itself costs one design: its row has the reason. Raises ParameterError without the extra, or
    where no scheduler answers or goes away.
    """

    def __init__(self, question: Question, count: int = 1, cluster: str | None = None) -> None:
        self._question, self._count, self._cluster = question, count, cluster
        self._together = question.target.together
        self._stack = ExitStack()
        self._executor: Executor | None = None

    def __enter__(self) -> "Workers":
        self._start()
        return self

    def __exit__(self, *_error: object) -> None:
        if isinstance(self._executor, ProcessPoolExecutor):
            self._executor.shutdown(wait=False, cancel_futures=True)
        self._stack.close()

    def _start(self) -> None:
        if self._cluster is not None and self._question.time_limit:
            raise ParameterError("--time-limit on a cluster", allowed="a time limit needs processes of this machine")
        if self._cluster is not None:
            self._executor = self._stack.enter_context(cluster_client(self._cluster)).get_executor(pure=False)
        elif self._count > 1 or (self._question.time_limit and current_thread() is not main_thread()):
            self._executor = _pool(self._count)  # a time limit interrupts the main thread of a process alone

    def outcomes(self, designs: Sequence[Design]) -> Iterator[Outcome]:
        """The outcome of each design, in order."""
        size = self._together  # of arrays the same at any number of workers: their last bits may depend on it
        if self._executor is not None and size == 1:
            size = max(1, min(CHUNK, len(designs) // (2 * max(self._count, 1))))
        chunks = [designs[first : first + size] for first in range(0, len(designs), size)]
        if self._executor is None:
            for chunk in chunks:
                yield from evaluated(self._question, chunk)
            return
        while chunks:
            futures = [self._executor.submit(evaluated, self._question, chunk) for chunk in chunks]
            for number, future in enumerate(futures):
                try:
                    yield from future.result()
                except BrokenProcessPool:
                    yield from self._one_by_one(chunks[number])
                    chunks = chunks[number + 1 :]
                    self._executor = _pool(self._count)
                    break
                except Exception as error:
                    raise ParameterError(
                        f"the cluster {self._cluster or ''} gave no result: {type(error).__name__}",
                        do="start it again and go on with --resume; all designs until now are kept",
                    ) from error
            else:
                return

    def _one_by_one(self, designs: Sequence[Design]) -> Iterator[Outcome]:
        """The designs of a chunk whose process ended, each in a process of its own: one of them ended it."""
        for design in designs:
            with _pool(1) as alone:
                try:
                    yield from alone.submit(evaluated, self._question, [design]).result()
                except BrokenProcessPool:
                    yield Outcome(DIED, "its process ended by itself")


def _pool(count: int) -> ProcessPoolExecutor:
    return ProcessPoolExecutor(count, mp_context=multiprocessing.get_context("spawn"))


def cluster_client(address: str) -> Any:
    """A client of a Dask scheduler. Raises ParameterError without the extra, or where none answers."""
    try:
        distributed = import_module("distributed")
    except ImportError:
        raise ParameterError("--cluster needs the extra cluster", do="pip install 'ilmek[cluster]'") from None
    try:
        return distributed.Client(address, timeout=10)
    except (OSError, ValueError, TimeoutError) as error:
        raise ParameterError(f"--cluster {address}: no scheduler answers ({error})", do="check the address") from None

"""The runs of many seeds: in this process, in processes, or on a Dask cluster. The numbers are those of one process."""

import multiprocessing
import os
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from ilmek.arrays import IntArray
from ilmek.io.any_programme import open_any_programme
from ilmek.loom.operations import LoomProgramme
from ilmek.loom.twin.faults import StopParams, fault_table
from ilmek.loom.twin.seed_runs import run_seeds
from ilmek.progress import SILENT, Progress
from ilmek.studies.workers import MOST_WORKERS, cluster_client

_WORTH = 20_000_000
"""Rows times seeds from which processes of their own are quicker: they start in a second."""


def runs_of(  # noqa: PLR0917
    programme: LoomProgramme, path: Path, params: StopParams, first: int, count: int, workers: int | None,
    cluster: str | None, progress: Progress = SILENT,
) -> IntArray:  # fmt: skip
    """The sums of `count` seeds from `first` on, (count, SUM_COLUMNS), in order.

    programme  open, of the file `path`, which the workers open again; those of a cluster by the same path
    workers    processes; default: one, or for long work one for each processor
    cluster    address of a Dask scheduler
    Raises ParameterError without the extra, or where no scheduler answers; the errors of the programme; Cancelled.
    """
    if cluster is not None:
        return _on_cluster(path, params, first, count, cluster, progress)
    if workers is None:
        workers = min(MOST_WORKERS, os.cpu_count() or 1) if programme.setup.rows * count > _WORTH else 1
    if workers == 1:
        table = fault_table(params, programme.setup)
        return run_seeds(programme, table, range(first, first + count), progress=progress)
    parts = list(_parts(first, count, workers))
    with ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn")) as pool:
        futures = [pool.submit(run_part, str(path), params, *part) for part in parts]
        try:
            return _gathered(futures, as_completed(futures), progress)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def run_part(path: str, params: StopParams, first: int, count: int) -> IntArray:
    """The sums of some seeds of a programme's file, for a process of its own."""
    with open_any_programme(Path(path)) as programme:
        return run_seeds(programme, fault_table(params, programme.setup), range(first, first + count))


def _parts(first: int, count: int, workers: int) -> Iterator[tuple[int, int]]:
    """First seed and number of seeds of each worker."""
    edges = [first + count * part // workers for part in range(workers + 1)]
    yield from ((low, high - low) for low, high in pairwise(edges) if high > low)


def _gathered(futures: Sequence[Any], completed: Iterable[Any], progress: Progress) -> IntArray:
    """The results of futures in their order; completed: the same as they end."""
    for number, _ in enumerate(completed, 1):
        progress(number / len(futures))
    return np.concatenate([future.result() for future in futures])


def _on_cluster(  # noqa: PLR0917
    path: Path, params: StopParams, first: int, count: int, address: str, progress: Progress
) -> IntArray:
    """The same on a Dask cluster, in a few parts for each of its workers."""
    with cluster_client(address) as client:
        known = max(1, len(client.scheduler_info()["workers"]))
        parts = list(_parts(first, count, 4 * known))
        futures = [client.submit(run_part, str(path.resolve()), params, *part, pure=False) for part in parts]
        return _gathered(futures, import_module("distributed").as_completed(futures), progress)

"""Settings of the whole test run."""

import gc
import os
from collections import defaultdict

import effort
import pytest
from hypothesis import settings

os.environ["ILMEK_LEAVE_NOTHING_OUT"] = "1"  # a figure that cannot be made is an error
# Threads of small products of matrices wait for each other on busy processors: a run-up of 1 s took 35 s of their time.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # numpy is not imported yet, and workers inherit it

# No test is a timed test. The examples are the same in every run, so that a change breaks it and not chance;
# `make campaigns` looks for new ones, and so does `pytest --hypothesis-profile=explore`, 100 for each property.
settings.register_profile("explore", deadline=None)
settings.register_profile("ilmek", deadline=None, derandomize=True, max_examples=15)


def pytest_configure(config: pytest.Config) -> None:
    """The marks of a test of many cases."""
    config.addinivalue_line("markers", "matrix(light): so many of the cases in `make test`, all in a campaign")
    config.addinivalue_line(
        "markers", "one_in(count): a case in so many in `make test`, others for each test; all in a campaign"
    )


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out cases of a matrix, evenly."""
    cases = defaultdict[tuple[str, str], list[pytest.Item]](list)
    for item in items:
        for choice in CHOICES.keys() & {mark.name for mark in item.iter_markers()}:
            cases[item.nodeid.partition("[")[0], choice].append(item)
    left_out = set[pytest.Item]()
    for (name, choice), part in cases.items():
        left_out |= {*part} - {*CHOICES[choice](name, part, part[0].get_closest_marker(choice))}
    items[:] = [item for item in items if item not in left_out]
    config.hook.pytest_deselected(items=list(left_out))


CHOICES = {
    "matrix": lambda _, part, mark: effort.some(part, mark.kwargs["light"]),
    "one_in": lambda name, part, mark: effort.share_of(part, mark.args[0], name),
}
"""The cases that stay, by the mark: of a test's name, its cases and the mark."""


def pytest_collection_finish() -> None:
    """What all tests share stays: collections of garbage leave it out."""
    gc.enable()
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000, 20, 50)


gc.disable()  # while the tests are collected: a third of that time
settings.load_profile("ilmek" if effort.SEED is None else "explore")

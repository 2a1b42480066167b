"""Settings of the whole test run."""

import gc
import os
from collections import defaultdict

import effort
import pytest
from hypothesis import settings

os.environ["ILMEK_LEAVE_NOTHING_OUT"] = "1"  # a figure that cannot be made is an error

# No test is a timed test. The examples are the same in every run, so that a change breaks it and not chance;
# `make campaigns` looks for new ones, and so does `pytest --hypothesis-profile=explore`, 100 for each property.
settings.register_profile("explore", deadline=None)
settings.register_profile("ilmek", deadline=None, derandomize=True, max_examples=25)


def pytest_configure(config: pytest.Config) -> None:
    """The mark of a test of many cases."""
    config.addinivalue_line("markers", "matrix(light): so many of the cases in `make test`, all in a campaign")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out cases of a matrix, evenly."""
    cases = defaultdict[str, list[pytest.Item]](list)
    for item in items:
        if mark := item.get_closest_marker("matrix"):
            cases[f"{item.nodeid.partition('[')[0]} {mark.kwargs['light']}"].append(item)
    kept = {item for name, part in cases.items() for item in effort.some(part, int(name.rpartition(" ")[2]))}
    left_out = [item for part in cases.values() for item in part if item not in kept]
    items[:] = [item for item in items if item not in set(left_out)]
    config.hook.pytest_deselected(items=left_out)


def pytest_collection_finish() -> None:
    """What all tests share stays: collections of garbage leave it out."""
    gc.enable()
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000, 20, 50)


gc.disable()  # while the tests are collected: a third of that time
settings.load_profile("ilmek" if effort.SEED is None else "explore")

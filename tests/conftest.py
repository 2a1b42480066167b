"""Settings of the whole test run."""

import gc
import os

import effort
from hypothesis import settings

os.environ["ILMEK_LEAVE_NOTHING_OUT"] = "1"  # a figure that cannot be made is an error

# No test is a timed test. The examples are the same in every run, so that a change breaks it and not chance;
# `make campaigns` looks for new ones, and so does `pytest --hypothesis-profile=explore`, 100 for each property.
settings.register_profile("explore", deadline=None)
settings.register_profile("ilmek", deadline=None, derandomize=True, max_examples=40)


def pytest_collection_finish() -> None:
    """What all tests share stays: collections of garbage leave it out."""
    gc.enable()
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000, 20, 50)


gc.disable()  # while the tests are collected: a third of that time
settings.load_profile("ilmek" if effort.SEED is None else "explore")

"""Settings of the whole test run."""

import os

from hypothesis import settings

import campaign

os.environ["ILMEK_LEAVE_NOTHING_OUT"] = "1"  # a figure that cannot be made is an error

# No test is a timed test. The examples are the same in every run, so that a change breaks it and not chance;
# `make campaigns` looks for new ones, and so does `pytest --hypothesis-profile=explore`, 100 for each property.
settings.register_profile("explore", deadline=None)
settings.register_profile("ilmek", deadline=None, derandomize=True, max_examples=40)
settings.load_profile("ilmek" if campaign.SEED is None else "explore")

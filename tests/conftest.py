"""Settings of the whole test run."""

import os

from hypothesis import settings

os.environ["ILMEK_LEAVE_NOTHING_OUT"] = "1"  # a figure that cannot be made is an error

# No test is a timed test. The examples are the same in every run, so that a change breaks it and not chance;
# `pytest --hypothesis-profile=explore` looks for new ones, 100 for each property.
settings.register_profile("explore", deadline=None)
settings.register_profile("ilmek", deadline=None, derandomize=True, max_examples=40)
settings.load_profile("ilmek")

"""Settings of the whole test run."""

from hypothesis import settings

settings.register_profile("ilmek", deadline=None)  # no test is a timed test
settings.load_profile("ilmek")

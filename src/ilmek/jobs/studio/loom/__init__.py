"""The loom in space, and the run of its twin."""

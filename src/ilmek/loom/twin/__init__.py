"""The loom's digital twin: it executes a programme in time, knot by knot."""

"""The knot chart as files: a picture of its cells and printed sheets."""

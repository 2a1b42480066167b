"""Squared paper: from the picture of a sheet to its cells, one knot a cell."""

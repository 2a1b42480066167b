"""Flat reading: drawings, with few colours and edges, onto the grid of knots."""

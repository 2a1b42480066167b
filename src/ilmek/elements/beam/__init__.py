"""Straight beams on any number of supports: model, solution, result, and formulas of uniform beams."""

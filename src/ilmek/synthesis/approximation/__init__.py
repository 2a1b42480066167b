"""Approximate synthesis: synthesis polynomials, least squares and minimax, function generators over a whole range."""

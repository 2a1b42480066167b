"""The knots of pile yarn: kinds, words of their topology, curves in section, proof of the knot tied."""

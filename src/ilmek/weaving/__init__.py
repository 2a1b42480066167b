"""Textile mechanics: warp, shed, fell, tension, and the knot that a path of the yarn ties."""

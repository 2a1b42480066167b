"""The path of the yarn in a knot: its crossing word, its curve, and the proof of which knot a motion ties."""

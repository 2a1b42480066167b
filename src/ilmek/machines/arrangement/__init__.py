"""The arrangement of a loom: where its parts stand in the side view.

Coordinates: the fell at 0, x to the front, towards the weaver, y up, in m. Positions are complex.
"""

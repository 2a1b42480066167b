"""Tufting by a gun: regions of a chart that rows of pile can make, the strokes that fill them, their order."""

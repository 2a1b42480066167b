"""Rendered files: pictures that are drawn when they are read, at the resolution that the knots need.

kind        which of them a file is
resolution  the pixels of a drawing
svg         SVG without anything from outside the file
strokes     strokes of an SVG drawing that are thinner than a knot
pdf         a page of a PDF file
layers      PSD and PSB files without a merged picture
"""

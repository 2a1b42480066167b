"""Rendered files: pictures that are drawn when they are read, at the resolution that the knots need.

kind    which of them a file is, and its pixels as a PNG file
svg     SVG without anything from outside the file, thin strokes made wider
pdf     a page of a PDF file
layers  PSD and PSB files without a merged picture
"""

"""Carpets: sizes, quality, yarn, colour, chart, yarn bill."""

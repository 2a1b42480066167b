"""Mechanisms of other programs: their files as the data of a mechanism file, and what has no equivalent there."""

"""Cam tables for controllers; one module per format."""

from collections.abc import Mapping

from ilmek.io.cam_tables import codesys, iec, kollmorgen, lenze, neutral, twincat
from ilmek.io.cam_tables.format import Format

__all__ = ["FORMATS", "Format"]

FORMATS: Mapping[str, Format] = {
    kind.name: kind
    for kind in (
        neutral.FORMAT,
        iec.FORMAT,
        codesys.FORMAT,
        twincat.POSITIONS,
        twincat.MOTION,
        kollmorgen.FORMAT,
        lenze.FORMAT,
    )
}
"""Formats by name."""

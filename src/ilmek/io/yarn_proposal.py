"""Proposed shades as a yarn list that `--yarns` reads: to dye, or to match."""

from collections.abc import Sequence
from pathlib import Path

from ilmek.carpet.proposal import MatchedShade
from ilmek.io.toml_text import toml_section


def write_proposal(path: Path, proposed: Sequence[MatchedShade]) -> None:
    """Write the shades in UTF-8, without count and price. Raises OSError."""
    path.write_text(proposal_text(proposed), encoding="utf-8")


def proposal_text(proposed: Sequence[MatchedShade]) -> str:
    """The TOML text of a yarn list of the shades."""
    heading = "# Shades proposed from the picture itself, to dye or to match: ilmek weave PICTURE --yarns proposed.toml"
    parts = [f"{heading}\n# The count of the yarn follows from the quality; add nm and ply to state it.\n"]
    for shade in proposed:
        comment = f"# {shade.shade.share:.1%} of the knots; nearest shipped wool: {shade.nearest}"
        section = toml_section(("yarn",), {"name": shade.shade.name, "srgb": shade.shade.hex}, many=True)
        parts.append(f"{comment}, CIEDE2000 {shade.difference:.1f}\n{section}\n")
    return "\n".join(parts)

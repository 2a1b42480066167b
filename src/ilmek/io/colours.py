"""Colours of parts in files of space: by their material, or as envelopes."""

from ilmek.part.part import Part

COLOURS = {
    "structural steel": (0.55, 0.58, 0.62),
    "induction-hardened steel": (0.42, 0.45, 0.5),
    "beech": (0.76, 0.6, 0.42),
}
OTHER, ENVELOPE = (0.62, 0.64, 0.67), (0.45, 0.6, 0.8)

Rgba = tuple[float, float, float, float]


def colour_of(part: Part) -> Rgba:
    """Red, green, blue and opacity of a part."""
    return colour(part.material.name if part.material else "", envelope=part.envelope)


def colour(material: str, *, envelope: bool) -> Rgba:
    """Red, green, blue and opacity of a material, or of an envelope."""
    return (*ENVELOPE, 0.35) if envelope else (*COLOURS.get(material, OTHER), 1.0)

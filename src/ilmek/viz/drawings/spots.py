"""Spots for texts: directions of leaders to try, room below a text, positions that keep apart."""

import math

import numpy as np

from ilmek.viz.drawings.picture import Box

TURNS = np.deg2rad(
    np.fromstring(  # rounder directions first
        "45 60 30 120 135 150 75 15 105 165 -30 -45 -60 -135 -120 -150 0 180 90 -90 52 22 112 142 -15 -52 -112", sep=" "
    )
)


def box_below(box: Box, hanging: Box, anchor: str) -> Box:
    """The room of what hangs below the box of a text, on the side of its leader."""
    wide, tall = hanging[2] - hanging[0], hanging[3] - hanging[1]
    left = box[0] if anchor == "left" else box[2] - wide
    return left, box[1] - tall, left + wide, box[1]


def turns_from(centre: complex, sector: tuple[complex, complex] | None) -> np.ndarray:
    """Directions from a centre to try, within an arc where one is given."""
    if sector is None:
        return np.asarray(TURNS)
    start = float(np.angle(sector[0] - centre))
    sweep = float(np.angle((sector[1] - centre) / (sector[0] - centre)) % (2 * math.pi)) or 2 * math.pi
    return start + sweep * np.array([0.5, 0.35, 0.65, 0.2, 0.8, 0.1, 0.9])


def spread(positions: np.ndarray, least: float) -> np.ndarray:
    """Ascending positions at least so far apart, near the wanted ones: blocks that touch share their mean."""
    blocks: list[list[float]] = []
    for value in (positions - least * np.arange(len(positions))).tolist():
        blocks.append([value, 1.0])
        while len(blocks) > 1 and blocks[-2][0] > blocks[-1][0]:
            mean, count = blocks.pop()
            total = blocks[-1][1] + count
            blocks[-1] = [(blocks[-1][0] * blocks[-1][1] + mean * count) / total, total]
    level = np.concatenate([np.full(int(count), mean) for mean, count in blocks])
    return np.asarray(level + least * np.arange(len(positions)))

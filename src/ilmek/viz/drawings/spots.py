"""Spots for texts: directions of leaders to try, room below a text, positions that keep apart."""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, Float
from ilmek.viz.drawings.picture import Box

TURNS = np.deg2rad(
    np.fromstring(  # rounder directions first
        "45 60 30 120 135 150 75 15 105 165 -30 -45 -60 -135 -120 -150 0 180 90 -90 52 22 112 142 -15 -52 -112", sep=" "
    )
)


PAD = 0.8
"""Distance of texts from each other, at least [mm]."""


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


_ALONG = np.linspace(0.0, 1.0, 25)
"""Shares of a leader at which it must be free."""


@dataclass(frozen=True, eq=False)
class TakenRoom:
    """What a text must keep off: boxes of others, and points of lines in the order of their x."""

    boxes: Float[np.ndarray, "boxes 4"]
    samples: ComplexArray

    def fault(self, box: Box, tip: complex, elbow: complex, least: float = np.inf) -> float:
        """How bad a spot for a text is: 0 where it is free, 1000 for each text that it or its line covers.

        least  from which on it need not be exact
        """
        low_x, low_y, high_x, high_y = self.boxes.T
        over = (box[0] < high_x + PAD) & (low_x < box[2] + PAD) & (box[1] < high_y + PAD) & (low_y < box[3] + PAD)
        fault = 1000.0 * np.count_nonzero(over)
        across = self.samples.real
        first, last = np.searchsorted(across, box[0] - 0.5, "right"), np.searchsorted(across, box[2] + 0.5)
        heights = self.samples.imag[first:last]
        fault += float(np.count_nonzero((heights > box[1] - 0.5) & (heights < box[3] + 0.5)))
        if tip != elbow and fault < least:
            shelf = complex(box[2] if elbow.real < box[2] else box[0], elbow.imag)
            path = np.concatenate([tip + (elbow - tip) * _ALONG, elbow + (shelf - elbow) * _ALONG[::2]])[:, None]
            beside = (path.real > low_x - 0.4) & (path.real < high_x + 0.4)
            inside = beside & (path.imag > low_y - 0.4) & (path.imag < high_y + 0.4)
            fault += 1000.0 * np.count_nonzero(inside.any(axis=0))
        return fault


def within(points: ComplexArray, box: Box) -> np.ndarray:
    """Which points are in a box, or very near."""
    beside = (points.real > box[0] - 0.4) & (points.real < box[2] + 0.4)
    return np.asarray(beside & (points.imag > box[1] - 0.4) & (points.imag < box[3] + 0.4))

"""Placement of names beside the parts that they name, clear of lines and of each other."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.spatial import KDTree

from ilmek.arrays import BoolArray, ComplexArray, FloatArray
from ilmek.records import record
from ilmek.viz.font import text_width

_AROUND = np.exp(1j * np.radians([45, 135, -45, -135, 90, -90, 0, 180, 22, 158, -22, -158, 68, 112, -68, -112]))
_REACHES = (1.0, 1.8, 2.8)


@record
class LabelRequest:
    """A name to place.

    anchors   points beside which it may be placed [pt], the best first
    size      of the letters [pt]
    distance  least distance from the anchor [pt]
    pull      cost factor of the distance: the higher, the closer the name stays to its anchor
    """

    anchors: ComplexArray
    text: str
    size: float
    distance: float = 6.0
    pull: float = 1.0

    @property
    def half(self) -> complex:
        """Half the width + i half the height of the text [pt]."""
        return complex(text_width(self.text, self.size) / 2 + 1.0, 0.62 * self.size)


def placed(requests: list[LabelRequest], obstacles: ComplexArray, lower: complex, upper: complex) -> list[complex]:
    """Centres of the names [pt], chosen one after the other among positions around their anchors.

    obstacles     points that should not be covered [pt]
    lower, upper  corners of the area in which all names lie [pt]

    A position costs 1 for each point covered, 200 for each name touched, 400 outside the sheet, and a little for its
    distance.
    """
    boxes: list[tuple[complex, complex]] = []
    for request in requests:
        half = request.half
        candidates, cost = _candidates(request)
        least, most = lower + half, upper - half
        out = (candidates.real < least.real) | (candidates.real > most.real)
        out |= (candidates.imag < least.imag) | (candidates.imag > most.imag)
        cost += 400.0 * out + covered(candidates, half, obstacles)
        for centre, other in boxes:
            apart = np.abs((candidates - centre).real) < (half + other).real
            cost += 200.0 * (apart & (np.abs((candidates - centre).imag) < (half + other).imag))
        boxes.append((complex(candidates[int(np.argmin(cost))]), half))
    return [centre for centre, _ in boxes]


def steady(
    requests: Sequence[LabelRequest], obstacles: Sequence[ComplexArray], lower: complex, upper: complex
) -> list[ComplexArray]:
    """Centres of the names of moving points at every frame [pt], each always on the same side of its point.

    requests   names with their points over the frames as anchors
    obstacles  points that should not be covered at each frame [pt]

    The costs are those of `placed`, summed over the frames.
    """
    found: list[tuple[ComplexArray, complex]] = []
    for request in requests:
        half = request.half
        offsets, cost = _candidates(replace(request, anchors=np.zeros(1, complex)))
        centres = request.anchors[:, np.newaxis] + offsets
        least, most = lower + half, upper - half
        out = (centres.real < least.real) | (centres.real > most.real)
        out |= (centres.imag < least.imag) | (centres.imag > most.imag)
        total = 400.0 * out + cost + [covered(at, half, met) for at, met in zip(centres, obstacles, strict=True)]
        for other, own in found:
            apart = centres - other[:, np.newaxis]
            total += 200.0 * ((np.abs(apart.real) < (half + own).real) & (np.abs(apart.imag) < (half + own).imag))
        found.append((centres[:, int(np.argmin(total.sum(axis=0)))], half))
    return [centres for centres, _ in found]


def _candidates(one: LabelRequest) -> tuple[ComplexArray, FloatArray]:
    """Centres at which the box of the text just keeps the distance from an anchor, and the costs of their distances."""
    half = one.half
    direction = np.tile(_AROUND, len(_REACHES))
    reach = np.repeat(_REACHES, len(_AROUND))
    beside = np.sign(np.round(direction.real, 1)) * half.real + 1j * np.sign(np.round(direction.imag, 1)) * half.imag
    offsets = direction * one.distance * reach + beside
    cost = one.pull * (np.array(reach) - 1.0) * one.distance * 0.3 + 0.05 * np.arange(len(direction)) / len(direction)
    rank_cost = 0.8 * np.arange(len(one.anchors))
    return (one.anchors[:, np.newaxis] + offsets).ravel(), (rank_cost[:, np.newaxis] + cost).ravel()


def covered(centres: ComplexArray, half: complex, obstacles: ComplexArray) -> FloatArray:
    """Number of obstacle points that each box covers, at most 12."""
    if not len(obstacles):
        return np.zeros(len(centres))
    reach = half + (1 + 1j)
    near = _between(obstacles.real, centres.real, reach.real) & _between(obstacles.imag, centres.imag, reach.imag)
    tree = KDTree(_scaled(obstacles[near], reach))
    inside = tree.query_ball_point(_scaled(centres, reach), 1.0, p=np.inf, return_length=True)
    return np.asarray(np.minimum(inside, 12).astype(float))


def _scaled(points: ComplexArray, reach: complex) -> FloatArray:
    """Coordinates in which a box of a reach is a square of the side 2."""
    return np.stack([points.real / reach.real, points.imag / reach.imag], axis=1)


def _between(values: FloatArray, middles: FloatArray, reach: float) -> BoolArray:
    """Which values lie within `reach` of the range of the middles: only these can lie within it of one."""
    return np.asarray((values > middles.min() - reach) & (values < middles.max() + reach))

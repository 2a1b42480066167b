"""Widths between two faces of a part that slide on one other part: a slot or a tongue, with its sliding fit H8/f7."""

from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np

from ilmek.elements.fits import ToleranceZone, tolerance_zone
from ilmek.part.tolerances import FeatureKind, FitDuty, ToleratedFeature
from ilmek.units import mm

SLOT, TONGUE = "H8", "f7"
"""Classes of a width inside two faces, and of one outside: the usual sliding fit."""

_BESIDE, _OPPOSITE = 1 * mm, 1e-6
"""Distance of the middles of two faces along them [m], and deviation of their directions, of opposite ones at most."""


def guided_widths(features: Sequence[ToleratedFeature]) -> Iterator[tuple[bool, ToleranceZone]]:
    """Whether each width is a slot, and its zone, those of one size once.

    >>> from ilmek.part.placement import placement
    >>> from math import pi
    >>> of_fork, limits = ("fork", "", FeatureKind.FACE), (0.0, 0.02, "", 0.0, 0.0, 0.8e-6, FitDuty.SLIDING)
    >>> lies = placement(), placement(z=0.008, about=(1.0, 0.0, 0.0), angle=pi)
    >>> faces = [ToleratedFeature(*of_fork, own, *limits, mates=("rod",)) for own in lies]
    >>> [(slot, zone.name) for slot, zone in guided_widths(faces)]
    [(True, 'H8')]
    """
    faces = [own for own in features if own.kind is FeatureKind.FACE and own.duty is FitDuty.SLIDING]
    widths = dict[tuple[bool, float], None]()
    for first, second in combinations(faces, 2):
        out, apart = first.position.rotation[:, 2], second.position.origin - first.position.origin
        across = float(apart @ out)
        opposite = float(out @ second.position.rotation[:, 2]) < _OPPOSITE - 1
        if first.mates == second.mates and opposite and np.linalg.norm(apart - across * out) < _BESIDE:
            widths[across > 0, round(abs(across), 7)] = None
    for slot, width in widths:
        yield slot, tolerance_zone(SLOT if slot else TONGUE, width)

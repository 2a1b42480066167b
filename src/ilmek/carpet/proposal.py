"""Proposal: the shades of a picture itself, as a yarn list to dye or match.

A drawing's shades are colours of the drawing: all of them where they are no more than required, else the k of least
total CIEDE2000 (k-medoids). A photo's shades are means of its colours (k-means from the k-medoids of its pooled
colours): each colour goes to the shade of least CIEDE2000, each shade to the mean of its colours in CIELAB, while the
total falls.
"""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.carpet.colour import lab_to_srgb, srgb_to_lab
from ilmek.carpet.colour_difference import nearest
from ilmek.carpet.palette import Colours, additions, difference_table, pooled, swap_while_better
from ilmek.carpet.picture_points import hex_colour
from ilmek.carpet.yarn import Yarn, yarn_labs
from ilmek.progress import SILENT, Progress

_CANDIDATES = 600
"""Largest number of pooled colours among which the medoids are."""

_COLOURS = 60_000
"""Largest number of pooled colours of which the means are formed."""

_ROUNDS = 12


@dataclass(frozen=True, slots=True)
class ProposedShade:
    """A shade of a picture: sRGB codes, and the share of the knots to which it is the nearest shade [-]."""

    srgb: tuple[int, int, int]
    share: float

    @property
    def hex(self) -> str:
        """The colour as `#rrggbb`."""
        return hex_colour(self.srgb)


@dataclass(frozen=True, slots=True)
class MatchedShade:
    """A proposed shade, its name, and the nearest yarn of another list with its CIEDE2000."""

    name: str
    shade: ProposedShade
    nearest: str
    difference: float


def match_shades(shades: Sequence[ProposedShade], yarns: Sequence[Yarn]) -> tuple[MatchedShade, ...]:
    """The shades, named by number, each with the nearest of the yarns."""
    if not shades:
        return ()
    labs = srgb_to_lab(np.array([shade.srgb for shade in shades], dtype=np.uint8))
    index, difference = nearest(labs, yarn_labs(yarns))
    found = zip(shades, index.tolist(), difference.tolist(), strict=True)
    return tuple(
        MatchedShade(f"shade {number}", shade, yarns[yarn].name, delta_e)
        for number, (shade, yarn, delta_e) in enumerate(found, start=1)
    )


def propose_shades(
    colours: Colours, count: int, *, drawn: bool, progress: Progress = SILENT
) -> tuple[ProposedShade, ...]:
    """At most `count` shades of a picture, that with the most knots first.

    drawn  the picture is a drawing: its shades are colours that it has
    """
    if len(colours.labs) <= count:
        shades = colours.labs
    else:
        shades = _medoids(colours, count, progress.part(0.0, 0.6))
        if not drawn:
            shades = _means(*pooled(colours, _COLOURS, progress), shades, progress.part(0.6, 1.0))
    codes = np.unique(lab_to_srgb(shades), axis=0)
    index, _ = nearest(colours.labs, srgb_to_lab(codes))
    knots = np.bincount(index, weights=colours.counts, minlength=len(codes))
    order = np.argsort(-knots, kind="stable").tolist()
    total = float(knots.sum())
    found = [(codes[number].tolist(), float(knots[number]) / total) for number in order]
    return tuple(ProposedShade((red, green, blue), share) for (red, green, blue), share in found)


def _medoids(colours: Colours, count: int, progress: Progress) -> FloatArray:
    """The `count` colours with the least total CIEDE2000 over the picture."""
    candidates, knots = pooled(colours, _CANDIDATES, progress)
    table = difference_table(candidates, knots, candidates, progress.part(0.0, 0.7))
    begun = [yarn for yarn, _ in itertools.islice(additions(table), min(count, len(candidates)))]
    return np.asarray(candidates[swap_while_better(table, begun, progress.part(0.7, 1.0))])


def _means(labs: FloatArray, knots: FloatArray, shades: FloatArray, progress: Progress) -> FloatArray:
    """The shades moved to the means of their colours while the total difference falls."""
    best, least = shades, np.inf
    for number in range(_ROUNDS):
        index, difference = nearest(labs, shades)
        total = float((difference * knots).sum())
        if total >= least * (1 - 1e-6):
            break
        best, least = shades, total
        weights = np.bincount(index, weights=knots, minlength=len(shades))
        means = [np.bincount(index, weights=knots * axis, minlength=len(shades)) for axis in labs.T]
        moved = np.stack(means, axis=-1) / np.maximum(weights, 1)[:, None]
        shades = np.where(weights[:, None] > 0, moved, shades)
        progress((number + 1) / _ROUNDS)
    return best

"""Proposal: the shades of a picture itself, as a yarn list to dye or match.

A drawing's shades are colours of the drawing: all of them where they are no more than required, else the k of least
total CIEDE2000 (k-medoids). A photo's shades are means of its colours (k-means from the k-medoids of its pooled
colours): each colour goes to the shade of least CIEDE2000, each shade to the mean of its colours in CIELAB, while the
total falls.

A picture without a yarn list is tied in its own shades [`own_yarns`]: a shade within SAME of a wool that is in stock is
that wool, and the others are dyed to order. A picture whose shades are all in stock is charted from the stock, and so
is a drawing that it serves: each colour has a wool of its own, none farther than FAR, and their mean is at most NEAR.
"""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ilmek.arrays import FloatArray, Rgb
from ilmek.carpet.colour import lab_to_srgb, srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.colour_names import colour_name, unique_name
from ilmek.carpet.nearest_colour import nearest
from ilmek.carpet.palette import Colours, additions, difference_table, pooled, swap_while_better
from ilmek.carpet.picture_points import hex_colour
from ilmek.carpet.yarn import Yarn, yarn_labs
from ilmek.progress import SILENT, Progress

SAME = 2.0
"""CIEDE2000 below which a shade is taken for a wool in stock: beside each other they are hard to tell apart."""

NEAR, FAR = 5.0, 12.0
"""Mean and greatest CIEDE2000 to wools in stock for which nothing is dyed for a drawing; assumed by this project."""

PLAIN = 0.05
"""Share of the knots above which one colour of a photo is a plain ground: white paper, black night."""

RARE = 0.03
"""Share of the knots below which a shade of a photo is left out if it is a copy of another."""

_CANDIDATES = 300
"""Largest number of pooled colours among which the medoids are."""

_COLOURS = 6_000
"""Largest number of colours of which the means are formed; more are pooled."""

_ROUNDS = 12


@dataclass(frozen=True, slots=True)
class ProposedShade:
    """A shade of a picture: name, sRGB codes, and the share of the knots to which it is the nearest shade [-]."""

    name: str
    srgb: tuple[int, int, int]
    share: float

    @property
    def hex(self) -> str:
        """The colour as `#rrggbb`."""
        return hex_colour(self.srgb)


@dataclass(frozen=True, slots=True)
class MatchedShade:
    """A proposed shade, and the nearest yarn of another list with its CIEDE2000."""

    shade: ProposedShade
    nearest: str
    difference: float


def match_shades(shades: Sequence[ProposedShade], yarns: Sequence[Yarn]) -> tuple[MatchedShade, ...]:
    """The shades, each with the nearest of the yarns."""
    if not shades:
        return ()
    labs = srgb_to_lab(np.array([shade.srgb for shade in shades], dtype=np.uint8))
    index, difference = nearest(labs, yarn_labs(yarns))
    return tuple(
        MatchedShade(shade, yarns[yarn].name, delta_e)
        for shade, yarn, delta_e in zip(shades, index.tolist(), difference.tolist(), strict=True)
    )


def propose_shades(
    colours: Colours,
    count: int,
    *,
    drawn: bool,
    evenness: float = 0.0,
    least_gain: float = 0.0,
    progress: Progress = SILENT,
) -> tuple[ProposedShade, ...]:
    """At most `count` shades of a picture, that with the most knots first, each with a name of its own.

    drawn     the picture is a drawing: its shades are colours that it has
    evenness  0: a colour counts by its knots; 1: all alike; between, by a power of its knots, so that a face is not
              given up for the ground
    least_gain  gain in the mean CIEDE2000, so weighted, below which no shade is added to two
    A colour of more than PLAIN of a photo's knots is a plain ground, and a shade as it is.
    """
    labs, knots = pooled(colours, _COLOURS, progress)
    plain = colours.counts > PLAIN * float(colours.counts.sum())
    number = count - int(np.count_nonzero(plain))
    if len(labs) <= count:
        shades = labs
    elif drawn or not 2 <= number < count:
        shades = _chosen(replace(colours, labs=labs, counts=knots), count, evenness, least_gain, progress, drawn=drawn)
    else:
        few, weights = pooled(replace(colours, labs=colours.labs[~plain], counts=colours.counts[~plain]), _COLOURS)
        others = replace(colours, labs=few, counts=weights)
        shades = _chosen(others, number, evenness, least_gain, progress, drawn=False)
        shades = np.concatenate([colours.labs[plain], shades])
    codes = np.unique(lab_to_srgb(shades), axis=0)
    if not drawn:
        codes = _apart(codes, labs, knots)
    index, _ = nearest(labs, srgb_to_lab(codes))
    shares = np.bincount(index, weights=knots, minlength=len(codes)) / float(knots.sum())
    shades_by_name: dict[str, ProposedShade] = {}
    for number in np.argsort(-shares, kind="stable").tolist():
        red, green, blue = codes[number].tolist()
        name = unique_name(colour_name(srgb_to_lab(codes[number])), shades_by_name)
        shades_by_name[name] = ProposedShade(name, (red, green, blue), float(shares[number]))
    return tuple(shades_by_name.values())


def _apart(codes: Rgb, labs: FloatArray, knots: FloatArray) -> Rgb:
    """The shades without the rare ones within SAME of one with more knots: smoothed edges have such copies."""
    shades = srgb_to_lab(codes)
    counts = np.bincount(nearest(labs, shades)[0], weights=knots, minlength=len(codes))
    order = np.argsort(-counts, kind="stable").tolist()
    kept = order[:2]
    for number in order[2:]:
        rare = counts[number] < RARE * counts.sum()
        if not rare or float(np.min(delta_e_2000(shades[kept], shades[number]))) >= SAME:
            kept.append(number)
    return np.asarray(codes[sorted(kept)])


def _chosen(
    colours: Colours, count: int, evenness: float, least_gain: float, progress: Progress, *, drawn: bool
) -> FloatArray:
    """At most `count` shades of pooled colours, in CIELAB: medoids of a drawing, means of a photo."""
    shades = _medoids(colours, count, evenness, least_gain, progress.part(0.0, 0.6))
    if drawn:
        return shades
    return _means(colours.labs, colours.counts ** (1.0 - evenness), shades, progress.part(0.6, 1.0))


def own_yarns(
    shades: Sequence[ProposedShade], stock: Sequence[Yarn], never: frozenset[str], needed: frozenset[str]
) -> tuple[tuple[Yarn, ...], tuple[ProposedShade, ...]]:
    """The yarns of a picture's shades, in their order, and the shades that are dyed to order for them.

    stock   wools that a shade within SAME of one is; they all have one count, and that of the dyed yarns
    never   names of wools, in lower case, that no shade is      needed  names of wools that follow in any case
    A dyed yarn costs as much as the dearest wool. Where all shades are wools in stock, the yarns are the stock.
    """
    labs, names = yarn_labs(stock), {yarn.name.casefold() for yarn in stock}
    dearest = max((yarn.price for yarn in stock if yarn.price is not None), default=None)
    found, dyed = dict[str, Yarn](), list[ProposedShade]()
    for shade in shades:
        lab = srgb_to_lab(np.array(shade.srgb, dtype=np.uint8))
        number, difference = (one[0] for one in nearest(lab[None], labs))
        wool = stock[number]
        if difference < SAME and wool.name.casefold() not in never:
            found[wool.name] = wool
            continue
        name = unique_name(colour_name(lab), {*names, *found})
        lightness, a, b = lab.tolist()
        found[name] = replace(wool, name=name, srgb=shade.srgb, lab=(lightness, a, b), price=dearest)
        dyed.append(replace(shade, name=name))
    if not dyed:
        return tuple(stock), ()
    extra = [wool for wool in stock if wool.name.casefold() in needed and wool.name not in found]
    if len(found) + len(extra) < 2:
        extra = [stock[int(nearest(srgb_to_lab(np.array([dyed[0].srgb], dtype=np.uint8)), labs)[0][0])]]
    return (*found.values(), *extra), tuple(dyed)


def _medoids(colours: Colours, count: int, evenness: float, least_gain: float, progress: Progress) -> FloatArray:
    """The `count` colours, or fewer, with the least total CIEDE2000 over the picture."""
    candidates, knots = pooled(colours, _CANDIDATES, progress)
    weights = knots ** (1.0 - evenness)
    table = difference_table(candidates, weights, candidates, progress.part(0.0, 0.7))
    begun, before, enough = list[int](), np.inf, least_gain * float(weights.sum())
    for yarn, total in itertools.islice(additions(table), min(count, len(candidates))):
        if len(begun) >= 2 and before - total < enough:
            break
        begun.append(yarn)
        before = total
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

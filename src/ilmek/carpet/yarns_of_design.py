"""The yarns of a design: which it takes, and which of them each of its colours has.

1. Without a list of the customer the yarns are the picture's own shades [`proposal.own_yarns`].
2. The palette rules choose from the list [`palette_rules`].
3. A drawing's colours get their yarns together [`assignment`], a photo's each the nearest. Pairs that are given hold.
4. A photo that would lose its edges, because its tones lie between two yarns, has them stretched towards the range of
   lightness of the yarns before they are matched, as little as keeps the edges.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ilmek.arrays import Float, FloatArray, Rgb, UInt8
from ilmek.carpet.assignment import assign_yarns
from ilmek.carpet.blends import blends
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.colour_groups import TWIN, ColourGroups, colour_groups
from ilmek.carpet.edges_kept import Edges, LostColour, colours_beside, edges_kept, edges_of, lost_colours
from ilmek.carpet.nearest_colour import nearest
from ilmek.carpet.palette import Colours, nearest_yarns, paint
from ilmek.carpet.palette_rules import (
    LEAST_EDGES,
    NEUTRAL_NO,
    Palette,
    PaletteParams,
    check_palette,
    choose_yarns,
    mapped_colours,
    yarn_names,
)
from ilmek.carpet.picture_points import hex_colour
from ilmek.carpet.proposal import FAR, NEAR, ProposedShade, own_yarns, propose_shades
from ilmek.carpet.reading import Design
from ilmek.carpet.yarn import Yarn, yarn_labs
from ilmek.errors import YarnError
from ilmek.progress import SILENT, Progress
from ilmek.records import record

DRAWN_SHADES, MOST_DRAWN, PHOTO_SHADES = 24, 48, 24
"""Largest number of shades of a drawing, of one that would lose colours with fewer, and of a photo, without a yarn list
and unless the number of colours is given.
"""

EVENNESS, LEAST_GAIN = 0.5, 0.15
"""How evenly the colours of a photo count for its shades, and the least gain in mean CIEDE2000 of a further one; both
chosen by looking at charts of photographs.
"""

BLENDED = 100
"""Knots on edges that count as one for the shades of a photo: smoothed edges make no yarns of their own."""

_OWN = 1.0
"""CIEDE2000 to a yarn within which a colour is drawn in that yarn, whatever the colours like it."""

_STRETCHES = (0.25, 0.5, 1.0)
"""Shares of the way to the whole range of the yarns that are tried."""

_MARGIN = 0.1
"""Share of the edges that may be lost after, with small patches."""

_ENDS = (0.5, 99.5)
"""Percentiles of the knots between which the tones of a photo lie."""


@record
class YarnsOfDesign:
    """The yarns of a design.

    palette   the yarns, and how they were chosen      proposed  the shades that are dyed for it
    yarn_of, difference  yarn of each distinct colour and CIEDE2000 of the two
    least     mean CIEDE2000 of the knots, each with its nearest yarn
    groups    of the colours of a drawing              stretched  the tones of a photo were stretched
    edges     of the design, where they were needed
    """

    palette: Palette
    yarn_of: UInt8[np.ndarray, " colours"]
    difference: Float[np.ndarray, " colours"]
    least: float
    proposed: tuple[ProposedShade, ...] = ()
    groups: ColourGroups | None = None
    stretched: bool = False
    edges: Edges | None = None

    def lost(self, distinct: Colours) -> tuple[LostColour, ...]:
        """The colours of a drawing that vanish; the yarn of a group is that of its most frequent colour."""
        if self.groups is None:
            return ()
        lead = np.zeros(len(self.groups), dtype=np.uint8)
        order = np.argsort(distinct.counts, kind="stable")
        lead[self.groups.of[order]] = self.yarn_of[order]
        return lost_colours(self.groups, lead, yarn_labs(self.palette.yarns))


def yarns_of_design(
    distinct: Colours,
    design: Design,
    yarns: Sequence[Yarn],
    rules: PaletteParams,
    *,
    dyed: bool = False,
    chosen: bool = False,
    progress: Progress = SILENT,
) -> YarnsOfDesign:
    """The yarns of a design.

    yarns  the list, or with `dyed` the wools in stock, all with their counts      distinct  colours of the design
    chosen  the yarns are shades that were chosen for this design before
    Raises YarnError for rules that the list cannot meet, and for a given pair whose colour the design does not have.
    """
    drawn = design.kind != "photo"
    groups = colour_groups(design.colours, distinct) if drawn else None
    proposed: tuple[ProposedShade, ...] = ()
    if dyed:
        yarns, proposed, rules = _own(distinct, design.colours, groups, yarns, rules, progress.part(0.0, 0.3))
    palette = choose_yarns(distinct, yarns, rules, progress.part(0.3, 0.6))
    labs = yarn_labs(palette.yarns)
    yarn_of, difference = nearest_yarns(distinct, labs, progress.part(0.6, 0.9))
    least = float(np.sum(distinct.counts * difference)) / float(distinct.counts.sum())
    pairs = _given_pairs(distinct, palette.yarns, rules, drawn=drawn)
    taken, stretched, edges = yarn_of.copy(), False, None
    if groups is not None:
        fixed = {int(groups.of[of[0]]): yarn for of, yarn in pairs}
        found = assign_yarns(groups, labs, fixed, neutral=rules.neutral != NEUTRAL_NO)[groups.of]
        yarn_of = np.where(difference <= _OWN, yarn_of, found)
    elif not (proposed or chosen):
        edges = edges_of(design.colours, distinct)
        better = _stretched(distinct, design, edges, labs, yarn_of, progress.part(0.9, 1.0))
        stretched, yarn_of = better is not None, yarn_of if better is None else better
    for of, yarn in pairs:
        yarn_of[of] = yarn
    others = np.flatnonzero(yarn_of != taken)
    difference[others] = delta_e_2000(distinct.labs[others], labs[yarn_of[others]])
    return YarnsOfDesign(palette, yarn_of, difference, least, proposed, groups, stretched, edges)


def _own(  # noqa: PLR0917
    distinct: Colours,
    design: Rgb,
    groups: ColourGroups | None,
    stock: Sequence[Yarn],
    rules: PaletteParams,
    progress: Progress,
) -> tuple[tuple[Yarn, ...], tuple[ProposedShade, ...], PaletteParams]:
    """The picture's own shades as yarns, those that are dyed, and the rules as they act on these yarns."""
    check_palette(replace(rules, colours=None, mapped=None), stock)
    names = [name for _, name in mapped_colours(rules.mapped)]
    needed = frozenset(name.casefold() for name in (*yarn_names("keep", rules.keep), *names))
    count = PHOTO_SHADES if groups is None else DRAWN_SHADES
    if isinstance(rules.colours, int):
        count = max(2, rules.colours - len(needed))
    if groups is None:
        photo = {"evenness": EVENNESS, "least_gain": LEAST_GAIN if rules.colours is None else 0.0}
        inner = BLENDED * distinct.counts - (BLENDED - 1) * blends(design, distinct)
        shades = propose_shades(replace(distinct, counts=inner), count, drawn=False, **photo, progress=progress)
    elif _served(groups, stock):
        return tuple(stock), (), rules
    else:
        most = count if isinstance(rules.colours, int) else MOST_DRAWN
        shades = _shades_of_drawing(distinct, groups, count, most, progress)
    never = frozenset(name.casefold() for name in yarn_names("never", rules.never))
    yarns, dyed = own_yarns(shades, stock, never, needed)
    if not dyed:
        return yarns, (), rules
    few = isinstance(rules.colours, int) and rules.colours >= len(yarns)
    return yarns, dyed, replace(rules, never=None, colours=None if few else rules.colours)


def _shades_of_drawing(
    distinct: Colours, groups: ColourGroups, count: int, most: int, progress: Progress
) -> tuple[ProposedShade, ...]:
    """At most `count` shades of a drawing, or as many more, up to `most`, as keep its colours apart."""
    of_groups = replace(distinct, labs=groups.labs, counts=groups.knots.astype(np.int64))
    while True:
        shades_of = distinct if len(distinct.counts) <= count else of_groups
        shades = propose_shades(shades_of, count, drawn=True, progress=progress)
        labs = srgb_to_lab(np.array([shade.srgb for shade in shades], dtype=np.uint8))
        lost = lost_colours(groups, nearest(groups.labs, labs)[0].astype(np.uint8), labs)
        if not lost or count >= min(most, len(groups)):
            return shades
        count = min(most, count + len(lost))


def _served(groups: ColourGroups, stock: Sequence[Yarn]) -> bool:
    """Whether the wools in stock serve a drawing."""
    wool, difference = nearest(groups.labs, yarn_labs(stock))
    mean = float((groups.knots * difference).sum() / groups.knots.sum())
    return len(np.unique(wool)) == len(wool) and mean <= NEAR and float(difference.max()) <= FAR


def _given_pairs(
    distinct: Colours, yarns: Sequence[Yarn], rules: PaletteParams, *, drawn: bool
) -> list[tuple[np.ndarray, int]]:
    """For each pair that is given the distinct colours that it means, the nearest first, and the index of its yarn.

    Raises YarnError for a colour that the design does not have.
    """
    numbers = {yarn.name.casefold(): number for number, yarn in enumerate(yarns)}
    given_pairs = []
    for srgb, name in mapped_colours(rules.mapped):
        difference = delta_e_2000(distinct.labs, srgb_to_lab(np.array(srgb, dtype=np.uint8)))
        of = np.flatnonzero(difference <= (TWIN if drawn else 2 * TWIN))
        if len(of) == 0:
            raise YarnError(
                f"--map {hex_colour(srgb)}: the design has no such colour",
                allowed=f"like {', '.join(_frequent(distinct, difference))}",
                do="give a colour that the chart's JSON lists under assignment",
            )
        given_pairs.append((of[np.argsort(difference[of], kind="stable")], numbers[name.casefold()]))
    return given_pairs


def _frequent(distinct: Colours, difference: FloatArray) -> list[str]:
    """The nearest colour, then the most frequent ones."""
    numbers = [int(difference.argmin()), *np.argsort(-distinct.counts, kind="stable")[:4].tolist()]
    codes = np.flatnonzero(distinct.index)
    of_number = dict(zip((distinct.index[codes] - 1).tolist(), codes.tolist(), strict=True))
    wanted = dict.fromkeys(of_number[number] for number in numbers)
    return [hex_colour((code >> 16, code >> 8 & 255, code & 255)) for code in wanted]


def _stretched(  # noqa: PLR0917
    distinct: Colours,
    design: Design,
    edges: Edges,
    labs: FloatArray,
    yarn_of: UInt8[np.ndarray, " colours"],
    progress: Progress,
) -> UInt8[np.ndarray, " colours"] | None:
    """The nearest yarns of the tones stretched as little as keeps the edges, or most of them; None: as they are."""
    kept = edges_kept(edges, paint(design.colours, distinct, yarn_of), labs)
    if kept is None or kept >= LEAST_EDGES + _MARGIN / 2:
        return None
    order = np.argsort(distinct.labs[:, 0])
    place = np.cumsum(distinct.counts[order]) / float(distinct.counts.sum())
    dark, light = (float(distinct.labs[order[np.searchsorted(place, end / 100)], 0]) for end in _ENDS)
    if light - dark < 1.0:
        return None
    own, least, most = distinct.labs[:, 0], float(labs[:, 0].min()), float(labs[:, 0].max())
    whole = least + (most - least) * (own - dark) / (light - dark)
    best, beside = None, colours_beside(edges, design.colours, distinct)
    for share in _STRETCHES:
        toned = distinct.labs.copy()
        toned[:, 0] = own + share * (whole - own)
        found = yarn_of.copy()
        few = replace(distinct, labs=toned[beside], counts=distinct.counts[beside])
        found[beside], _ = nearest_yarns(few, labs, progress)
        now = edges_kept(edges, paint(design.colours, distinct, found), labs) or 0.0
        if now > kept:
            best, kept = toned, now
        if kept >= LEAST_EDGES + _MARGIN:
            break
    return None if best is None else nearest_yarns(replace(distinct, labs=best), labs, progress)[0]

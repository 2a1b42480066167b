"""Palette rules: which yarns of the list a carpet takes.

1. Yarns that are never used leave the list.
2. Of the rest the best N are taken (`palette.best_yarns`), with those that are kept. N is given, or found (`auto`): the
   least, from two, for which the best N + 1 lower the mean CIEDE2000 of the best N by less than LEAST_GAIN.
3. A grey picture takes neutral yarns alone, where the list has two or more.
4. Yarns below the least share of the knots are merged, the rarest first: each of its colours goes to the nearest yarn
   that remains. Kept yarns stay.

A kept yarn is in the palette in any case; it has knots only where it is the nearest to a colour.
"""

import itertools
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.carpet.assignment import NEUTRAL_CHROMA
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.nearest_colour import nearest
from ilmek.carpet.palette import (
    Colours,
    best_of_table,
    best_yarns,
    difference_table,
    nearest_yarns,
    pooled,
    total_difference,
)
from ilmek.carpet.picture_points import hex_colour, read_colour
from ilmek.carpet.yarn import MOST_YARNS, Yarn, yarn_labs
from ilmek.errors import ParameterError, YarnError, did_you_mean, shortened
from ilmek.params import Params, kind, param
from ilmek.progress import SILENT, Progress
from ilmek.records import value_record
from ilmek.sentences import Sentence
from ilmek.units import counted

AUTO = "auto"

NEUTRAL_NO = "no"
"""Choice of `neutral`: greys take the nearest yarns, whatever their chroma."""

LEAST_GAIN = 0.25
"""Least gain in mean CIEDE2000 for which `auto` adds a yarn; assumed by this project."""

GREY, MOST_TINTED = 8.0, 2e-3
"""Chroma in CIELAB beyond which a knot is tinted, and largest share of such knots in a grey picture."""

LEAST_DIFFERENCE = 2.0
"""CIEDE2000 below which two yarns are near twins; assumed by this project."""

LEAST_EDGES, MOST_LOST, MOST_FINE_LOST = 0.85, 0.003, 0.05
"""Limits of what a chart loses; chosen by this project on drawings and photographs, by looking at their charts."""

LEAST_DETAILS = MappingProxyType({"exact": 0.0, "flat": 0.6, "photo": 0.3})
"""Default of the least detail by the kind of reading, chosen so too: the lines of a drawing are all meant."""

MOST_PROPOSED = 64
"""Largest number of shades that are proposed."""

_LARGEST_TABLE = 1 << 22
"""Largest number of entries of the table of colours × yarns by which `auto` counts; near colours are pooled."""

NAMES = 'names are separated by commas or semicolons; put "..." around a name that contains one'
_NAME = re.compile(r'\s*(?:"([^"]*)"|([^",;]*))\s*(?:[,;]|$)')


@dataclass(frozen=True, slots=True)
class PaletteParams(Params):
    """Which yarns of the list a carpet takes."""

    colours: int | str | None = param(
        None,
        at_least=2,
        at_most=MOST_YARNS,
        choices=(AUTO,),
        doc="number of yarns, those of the list that match the picture best; auto: as many as lower the mean CIEDE2000 "
        f"by {LEAST_GAIN:g} or more; default: all",
    )
    keep: str | None = kind.text(None, doc="yarns that are in the palette in any case, names separated by commas")
    never: str | None = kind.text(None, doc="yarns of the list that are not used, names separated by commas")
    mapped: str | None = param(None, doc='yarns of colours of the picture, like "#6c9136=dark green"', alias="map")
    neutral: str = kind.choice(
        AUTO,
        (AUTO, NEUTRAL_NO),
        doc="auto: greys take neutral yarns, and a grey picture these alone; no: any, which may be blue or brown",
    )
    least_share: float = param(
        0.0,
        unit="%",
        at_least=0.0,
        at_most=0.2,
        doc="share of the knots below which a yarn is merged into the nearest that remains, unless it is kept",
    )
    least_edges: float = param(
        LEAST_EDGES,
        unit="%",
        at_least=0.0,
        at_most=1.0,
        doc="least share of the picture's edges that the chart keeps, of which less is a failed check",
    )
    least_detail: float | None = param(
        None,
        unit="%",
        at_least=0.0,
        at_most=1.0,
        doc="least share of the picture's detail that the chart keeps, of which less is a failed check; default: "
        "flat 60 %, photo 30 %",
    )
    most_fine_lost: float | None = param(
        None,
        unit="%",
        at_least=0.0,
        at_most=1.0,
        doc="largest share of the detail of a drawing, or of a photo half of which is one yarn, that is finer than the "
        f"knots and lost, as small print, beyond which is a failed check; default: {MOST_FINE_LOST:.0%}, with "
        "least_detail any",
    )
    most_lost: float = param(
        MOST_LOST,
        unit="%",
        at_least=0.0,
        at_most=1.0,
        doc="largest share of the knots of a drawing's colours that are lost in others, beyond which is a failed check",
    )
    propose: int | None = kind.count(
        None,
        at_least=2,
        at_most=MOST_PROPOSED,
        doc="number of shades proposed from the picture itself, as a yarn list to dye or match; default: none",
    )

    def check_together(self) -> None:
        """Raise ParameterError for texts that cannot be read, a yarn kept and never used, and more kept than N."""
        mapped_colours(self.mapped)
        kept, never = yarn_names("keep", self.keep), yarn_names("never", self.never)
        both = {name.casefold() for name in kept} & {name.casefold() for name in never}
        if both:
            name = next(name for name in kept if name.casefold() in both)
            raise ParameterError(Sentence("yarn.kept-and-never", name=name), do=Sentence("yarn.leave-out"))
        if isinstance(self.colours, int) and len(kept) > self.colours:
            raise ParameterError(f"keep has {counted(len(kept), 'yarn')}, more than colours={self.colours}")


@dataclass(frozen=True, slots=True)
class MergedYarn:
    """A yarn below the least share of the knots [-], and the yarn that has most of its knots."""

    name: str
    into: str
    share: float


@dataclass(frozen=True, slots=True)
class Knee:
    """Number of yarns that `auto` found, the mean CIEDE2000 with them, and with one more (None: there is none)."""

    colours: int
    mean: float
    next_mean: float | None


@value_record
class Palette:
    """The yarns that a carpet takes, in the order of the list, and how they were found."""

    yarns: tuple[Yarn, ...]
    merged: tuple[MergedYarn, ...] = ()
    knee: Knee | None = None


@dataclass(frozen=True, slots=True)
class TwinYarns:
    """Two yarns that differ by less than LEAST_DIFFERENCE, and their CIEDE2000."""

    names: tuple[str, str]
    difference: float


def yarn_names(option: str, text: str | None) -> tuple[str, ...]:
    """The names of a text, each once. Raises ParameterError for a text without a name.

    >>> yarn_names("keep", 'ivory, madder red; "No. 7, blue"')
    ('ivory', 'madder red', 'No. 7, blue')
    """
    if text is None:
        return ()
    names, at = [], 0
    while at < len(text):
        found = _NAME.match(text, at)
        if found is None:
            raise ParameterError(f"{option}={shortened(text)!r} cannot be read", do=NAMES)
        names.append((found[1] or found[2] or "").strip())
        at = found.end()
    if not all(names) or not names:
        raise ParameterError(f"{option}={shortened(text)!r} has an empty name", do=NAMES)
    return tuple({name.casefold(): name for name in names}.values())


def mapped_colours(text: str | None) -> tuple[tuple[tuple[int, int, int], str], ...]:
    """The pairs of a text: sRGB of a colour, and the name of its yarn. Raises ParameterError.

    >>> mapped_colours("#6c9136=dark green; #ffffff = ivory")
    (((108, 145, 54), 'dark green'), ((255, 255, 255), 'ivory'))
    """
    if text is None:
        return ()
    found: dict[tuple[int, int, int], str] = {}
    for pair in filter(None, (part.strip() for part in text.split(";"))):
        colour, equals, name = pair.partition("=")
        if not equals or not name.strip():
            raise ParameterError(Sentence("yarn.no-pair", pair=shortened(pair)), do=Sentence("yarn.pair-example"))
        srgb = read_colour("map", colour.strip())
        if found.setdefault(srgb, name.strip().strip('"')) != name.strip().strip('"'):
            raise ParameterError(Sentence("yarn.two-yarns", colour=hex_colour(srgb)), do=Sentence("yarn.colour-once"))
    if not found:
        raise ParameterError(f"map={shortened(text)!r} has no pair", do='write it like "#6c9136=dark green"')
    return tuple(found.items())


def check_palette(params: PaletteParams, yarns: Sequence[Yarn]) -> None:
    """Raise YarnError for rules that the list of yarns cannot meet."""
    _kept_and_allowed(params, yarns)


def names_text(names: Iterable[str]) -> str:
    """The text of names, as `yarn_names` reads it; a name with a quotation mark is left out.

    >>> names_text(["ivory", "No. 7, blue"])
    '"ivory", "No. 7, blue"'
    """
    return ", ".join(f'"{name}"' for name in names if '"' not in name)


def choose_yarns(
    distinct: Colours, yarns: Sequence[Yarn], params: PaletteParams, progress: Progress = SILENT
) -> Palette:
    """The yarns of the list that a design takes, in the order of the list. Raises YarnError."""
    kept, allowed = _kept_and_allowed(params, yarns)
    count = params.colours
    if params.neutral == AUTO and (neutral := _neutrals(distinct, yarns, kept, allowed)):
        allowed, count = neutral, min(count, len(neutral)) if isinstance(count, int) else count
    yarns, knee = [yarns[number] for number in allowed], None
    fixed = tuple(allowed.index(number) for number in kept)
    if count == AUTO:
        knee = _knee(distinct, yarn_labs(yarns), fixed, progress.part(0.0, 0.4))
        count = knee.colours
    if isinstance(count, int):
        chosen = best_yarns(distinct, yarn_labs(yarns), count, progress.part(0.4, 0.8), fixed)
        yarns, fixed = [yarns[number] for number in chosen], tuple(chosen.index(number) for number in fixed)
    merged: tuple[MergedYarn, ...] = ()
    if params.least_share > 0:
        merged = _merged(distinct, yarns, fixed, params.least_share, progress.part(0.8, 1.0))
        gone = {one.name for one in merged}
        yarns = [yarn for yarn in yarns if yarn.name not in gone]
    return Palette(tuple(yarns), merged, knee)


def twin_yarns(yarns: Sequence[Yarn]) -> tuple[TwinYarns, ...]:
    """The pairs of yarns that differ by less than LEAST_DIFFERENCE, the nearest first; one number is one yarn."""
    labs, found = yarn_labs(yarns), []
    for number, yarn in enumerate(yarns[1:], start=1):
        differences = np.atleast_1d(delta_e_2000(labs[:number], labs[number]))
        found += [
            TwinYarns((yarns[other].name, yarn.name), float(differences[other]))
            for other in np.flatnonzero(differences < LEAST_DIFFERENCE).tolist()
            if yarn.number is None or yarn.number != yarns[other].number
        ]
    return tuple(sorted(found, key=lambda twins: twins.difference))


def _kept_and_allowed(params: PaletteParams, yarns: Sequence[Yarn]) -> tuple[tuple[int, ...], list[int]]:
    """Indices of the yarns that are kept, and of all that may be used."""
    kept, never = (
        _indices(name, yarn_names(name, text), yarns) for name, text in (("keep", params.keep), ("never", params.never))
    )
    pairs = mapped_colours(params.mapped)
    mapped = tuple(_indices(f"map {hex_colour(srgb)}", (name,), yarns)[0] for srgb, name in pairs)
    kept = tuple(dict.fromkeys((*kept, *mapped)))
    if twice := [number for number in mapped if number in never]:
        raise YarnError(Sentence("yarn.mapped-and-never", name=yarns[twice[0]].name), do=Sentence("yarn.leave-out"))
    allowed = [number for number in range(len(yarns)) if number not in never]
    without = "-without" if never else ""
    if len(allowed) < 2:
        left = Sentence("yarn.never", left=len(allowed), all=len(yarns))
        raise YarnError(left, allowed=Sentence("yarn.two"))
    if isinstance(params.colours, int) and params.colours > len(allowed):
        raise YarnError(
            Sentence("yarn.count", count=params.colours),
            allowed=Sentence(f"yarn.count-allowed{without}", most=len(allowed)),
            do=Sentence("yarn.count-do"),
        )
    return kept, allowed


def _neutrals(distinct: Colours, yarns: Sequence[Yarn], kept: tuple[int, ...], allowed: list[int]) -> list[int]:
    """The yarns of a grey picture: the neutral ones and those kept; none where there is one, and of other pictures."""
    tinted = distinct.counts[(distinct.labs[:, 1:] ** 2).sum(axis=1) > GREY**2].sum()
    if tinted > MOST_TINTED * distinct.counts.sum():
        return []
    chroma = np.hypot(*yarn_labs(yarns)[:, 1:].T)
    neutral = [number for number in allowed if chroma[number] <= NEUTRAL_CHROMA]
    return [number for number in allowed if number in (*neutral, *kept)] if len(neutral) >= 2 else []


def _indices(option: str, names: Iterable[str], yarns: Sequence[Yarn]) -> tuple[int, ...]:
    numbers = {yarn.name.casefold(): number for number, yarn in enumerate(yarns)}
    indices = []
    for name in names:
        if name.casefold() not in numbers:
            near = did_you_mean(name.casefold(), numbers, otherwise=Sentence("yarn.listed", names=_listed(yarns)))
            raise YarnError(Sentence("yarn.missing", option=option, name=shortened(name)), do=near)
        indices.append(numbers[name.casefold()])
    return tuple(indices)


def _listed(yarns: Sequence[Yarn]) -> str:
    names = [yarn.name for yarn in yarns[:20]]
    return ", ".join(names) + (", ..." if len(yarns) > len(names) else "")


def _knee(distinct: Colours, labs: FloatArray, kept: tuple[int, ...], progress: Progress) -> Knee:
    """The least number of yarns, at least two and those kept, after which a further yarn gains less than LEAST_GAIN."""
    table = difference_table(*pooled(distinct, _LARGEST_TABLE // len(labs), progress), labs, progress.part(0.0, 0.4))
    knots, most = int(distinct.counts.sum()), len(labs)
    begun = max(2, len(kept))
    trying = progress.part(0.4, 1.0)

    def mean(count: int) -> float:
        trying(1 - 1 / (2 + count - begun))
        return total_difference(table, best_of_table(table, count, SILENT, kept)) / knots

    least = mean(begun)
    for count in range(begun, most):
        further = mean(count + 1)
        if least - further < LEAST_GAIN:
            return Knee(count, least, further)
        least = further
    return Knee(most, least, None)


def _merged(
    distinct: Colours, yarns: Sequence[Yarn], kept: tuple[int, ...], least_share: float, progress: Progress
) -> tuple[MergedYarn, ...]:
    """The yarns below the least share, in the order in which they are merged. Raises YarnError if only one is left."""
    labs, total = yarn_labs(yarns), int(distinct.counts.sum())
    yarn_of = nearest_yarns(distinct, labs, progress)[0].astype(np.int64)
    remaining, merged = list(range(len(yarns))), list[MergedYarn]()
    for step in itertools.count():
        progress(1 - 1 / (2 + step))
        knots = _knots(yarn_of, distinct, len(yarns))
        rare = [yarn for yarn in remaining if 0 < knots[yarn] < least_share * total and yarn not in kept]
        if not rare:
            return tuple(merged)
        leaving = min(rare, key=knots.__getitem__)
        remaining.remove(leaving)
        if sum(knots[yarn] > 0 for yarn in remaining) < 2:
            raise YarnError(
                f"--least-share {least_share:.3%} would leave a single yarn",
                allowed=f"the second most frequent has {knots[leaving] / total:.3%} of the knots",
                do="give less, or --keep a yarn",
            )
        moved = yarn_of == leaving
        yarn_of[moved] = np.array(remaining)[nearest(distinct.labs[moved], labs[remaining])[0]]
        gained = [new - old for new, old in zip(_knots(yarn_of, distinct, len(yarns)), knots, strict=True)]
        into = max(remaining, key=gained.__getitem__)
        merged.append(MergedYarn(yarns[leaving].name, yarns[into].name, knots[leaving] / total))
    raise AssertionError("each step leaves fewer yarns")


def _knots(yarn_of: np.ndarray, distinct: Colours, yarns: int) -> list[int]:
    counts = np.bincount(yarn_of, weights=distinct.counts, minlength=yarns)
    return [round(count) for count in counts.tolist()]

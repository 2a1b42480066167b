"""Shape of a carpet: which cells of its grid are knots, which plain weave, and which are cut away.

A cell is inside where its middle is. With x and y from the middle of the carpet, width w and length l,

    round    x² + y² <= (w/2)²,   w = l                              area pi w²/4
    oval     (2x/w)² + (2y/l)² <= 1                                  area pi w l/4
    octagon  |x| + |y| <= (w + l)/2 - c,   c = min(w, l)/(2 + √2)    area w l - 2 c²; of equal sides where w = l
    stair    the two corners of the lower edge rounded, r = min(w, l)/2          area w l - (2 - pi/2) r²
    runner   both ends round, r = w/2, or r = l/2 across             area max(w, l) 2r - (4 - pi) r²

At the height of a row's middle the outline of the cells is at most half a knot from that of the shape.
"""

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
from scipy import ndimage

from ilmek.arrays import BoolArray, FloatArray, Indices
from ilmek.carpet.cells import CARVED, CUT_AWAY, OUTSIDE, PILE, PLAIN_GROUND, TALLEST, Carving, CellKind, all_knots
from ilmek.carpet.chart import Chart, used_first
from ilmek.errors import CarpetError, ParameterError, did_you_mean, shortened
from ilmek.params import Params, kind
from ilmek.units import counted, deg, mm, parse_quantity

RECTANGLE, PICTURE, ALL = "rectangle", "picture", "all"
MOST_LEVELS = 16
"""Largest number of piles of a map: neighbours differ by 17 of 255 codes of grey."""

LEAST_PART = 3
"""Least width and height of a part of a shape, in knots: a narrower one does not hold in the ground."""

_PLAIN = re.compile(r"(\d{1,6})(?:-(\d{1,6}))?(?:/(\d{1,6})-(\d{1,6}))?")
_PILE = re.compile(r"([0-9.]+ ?[a-zµ]+)(?: +(loop|cut))?|(loop|cut)")

Inside = Callable[[FloatArray, FloatArray, float, float], BoolArray]
"""Whether points are inside of a shape: x across and y up from its middle, width and length [m]."""


def _octagon(x: FloatArray, y: FloatArray, width: float, length: float) -> BoolArray:
    return np.asarray(abs(x) + abs(y) <= (width + length) / 2 - min(width, length) / (2 + math.sqrt(2)))


def _stair(x: FloatArray, y: FloatArray, width: float, length: float) -> BoolArray:
    radius = min(width, length) / 2
    aside, below = abs(x) - (width / 2 - radius), -y - (length / 2 - radius)
    return np.asarray(np.hypot(np.maximum(aside, 0.0), np.maximum(below, 0.0)) <= radius)


def _runner(x: FloatArray, y: FloatArray, width: float, length: float) -> BoolArray:
    radius = min(width, length) / 2
    beyond = np.hypot(np.maximum(abs(x) - (width / 2 - radius), 0.0), np.maximum(abs(y) - (length / 2 - radius), 0.0))
    return np.asarray(beyond <= radius)


SHAPES: Mapping[str, Inside] = MappingProxyType(
    {
        "round": lambda x, y, width, _: np.hypot(x, y) <= width / 2,
        "oval": lambda x, y, width, length: np.hypot(2 * x / width, 2 * y / length) <= 1,
        "octagon": _octagon,
        "stair": _stair,
        "runner": _runner,
    }
)
"""The shapes with an equation, by name."""


@dataclass(frozen=True, slots=True)
class ShapeParams(Params):
    """Shape, flat weave and pile of a carpet."""

    shape: str | None = kind.text(
        None,
        doc=f"outline: {', '.join(SHAPES)}; picture: its transparent parts are cut away; or a file, whose opaque or "
        "light part is the carpet, like outline.svg or mask.png; default: the whole rectangle",
    )
    kilim_ends: float = kind.length(
        0.0,
        unit="cm",
        at_least=0.0,
        at_most=5.0,
        doc="flat weave at each end, beyond the pile: the carpet is longer by both",
    )
    flat_weave: str | None = kind.text(
        None,
        doc='flat weave without knots: rows from the lower edge, and knots from the left, like "1-12, 40-60/10-30"',
    )
    pile: str | None = kind.text(
        None, doc='height of the pile by yarn, and loops: "Red=6mm, Blue=4mm loop, Ivory=loop"; default: one cut pile'
    )
    pile_map: str | None = kind.text(
        None, doc="picture of the pile: its greys are those of pile_levels; transparent parts leave the pile as it is"
    )
    pile_levels: str = kind.text(
        "6mm, 12mm", doc='piles of pile_map from black to white, at equal steps of grey, like "4mm, 8mm loop, 12mm"'
    )
    carve: str | None = kind.text(
        None, doc='lines cut into the pile where colours meet: round yarns like "Red, Blue", or all; default: none'
    )
    carve_depth: float = kind.length(
        4 * mm, above=0.0, below=TALLEST, doc="depth of carved lines, from the tips of the pile"
    )
    carve_angle: float = kind.angle(
        60 * deg, unit="deg", at_least=CARVED[0], at_most=CARVED[1], doc="angle between the sides of a carved line"
    )

    @property
    def named(self) -> bool:
        """Whether the shape has an equation."""
        return self.shape in SHAPES

    def cuts(self, outside: float) -> bool:
        """Whether the shape is that of a picture's opaque part; outside: share of it around a round part [-]."""
        fits = self.shape in {"round", "oval"} or self.file is not None
        return self.shape == PICTURE or (fits and outside > 0)

    @property
    def file(self) -> str | None:
        """The file of the outline, if it has one."""
        return None if self.named or self.shape in (None, RECTANGLE, PICTURE) else self.shape

    def check_together(self) -> None:
        """Raise ParameterError for a shape that is no name and no file, and for texts that cannot be read."""
        if self.file is not None and "." not in self.file:
            names = (RECTANGLE, *SHAPES, PICTURE)
            hint = did_you_mean(self.file, names)
            allowed = f"{', '.join(names)}, or a file"
            raise ParameterError(f"shape {shortened(self.file)!r} is unknown", allowed=allowed, do=hint)
        plain_areas(self.flat_weave)
        pile_kinds(self.pile)
        levels = self.levels
        if not 2 <= len(levels) <= MOST_LEVELS:
            raise ParameterError(f"pile_levels: {counted(len(levels), 'level')}", allowed=f"2 to {MOST_LEVELS}")

    @property
    def levels(self) -> tuple[CellKind, ...]:
        """The piles of the map, from black to white."""
        return tuple(pile_kind(part.strip()) for part in self.pile_levels.split(","))


def plain_areas(text: str | None) -> tuple[tuple[int, int, int | None, int | None], ...]:
    """The areas of a text: first and last row, from 1 at the lower edge; first and last knot, None: whole rows.

    >>> plain_areas("1-12, 40/10-30")
    ((1, 12, None, None), (40, 40, 10, 30))
    """
    areas = []
    for part in [] if text is None else text.split(","):
        found = _PLAIN.fullmatch(part.strip())
        first, last, left, right = (None if one is None else int(one) for one in found.groups()) if found else (0,) * 4
        last = first if last is None else last
        if not first or not last or last < first or (left is not None and not 0 < left <= (right or 0)):
            given = f"plain area {shortened(part.strip())!r} cannot be read"
            raise ParameterError(given, allowed="rows from 1, and knots from 1, first to last", do="write 1-12/10-30")
        areas.append((first, last, left, right))
    return tuple(areas)


def pile_kinds(text: str | None) -> dict[str, CellKind]:
    """The kinds of the knots of yarns, by the name of the yarn.

    >>> {name: str(kind) for name, kind in pile_kinds("Red=6 mm, Blue=4 mm loop").items()}
    {'Red': 'pile 6 mm, 6 mm', 'Blue': 'pile 4 mm loop, 4 mm, loop'}
    """
    kinds: dict[str, CellKind] = {}
    for part in [] if text is None else text.split(","):
        name, _, pile = (piece.strip() for piece in part.rpartition("="))
        if not name or name in kinds:
            given = f"two piles of {name}" if name else f"pile {shortened(pile)!r} has no yarn"
            raise ParameterError(given, allowed="a yarn of the list, its height, and loop", do="write Red=6mm")
        kinds[name] = pile_kind(pile)
    return kinds


def pile_kind(text: str) -> CellKind:
    """The kind of the knots of a pile: its height, loop or cut. Raises ParameterError.

    >>> str(pile_kind("6mm loop"))
    'pile 6mm loop, 6 mm, loop'
    """
    found = _PILE.fullmatch(text)
    if found is None:
        given = f"pile {shortened(text)!r} cannot be read"
        raise ParameterError(given, allowed="a height, loop or both", do="write Red=6mm, or Red=6mm loop")
    height = None if found[1] is None else parse_quantity(found[1], "mm")
    words = " ".join(filter(None, (found[1], found[2] or found[3])))
    pile = CellKind(f"pile {words}", height=height, loop="loop" in (found[2], found[3]))
    return pile if pile.loop or height is not None else PILE


def shaped(chart: Chart, params: ShapeParams, outline: BoolArray | None = None, levels: Indices | None = None) -> Chart:
    """The chart with the cells that its shape, flat weave and pile give; what its own cells are already stays.

    outline  of a shape without an equation: which cells are inside, (rows, columns)
    levels   the pile of each cell as an index in `params.levels`, (rows, columns); NO_KNOT: left as it is
    Raises CarpetError for a round carpet of unequal sides, a part of a shape narrower than LEAST_PART knots, rows and
    knots that the carpet does not have, and a pile of an unknown yarn.
    """
    cells = chart.cells or all_knots(chart.rows, chart.columns)
    if params.shape is not None:
        inside = _inside(params.shape, chart) if outline is None else outline
        require_wide(inside)
        cells = cells.woven(~inside, CUT_AWAY)
    plain = _plain(chart, params)
    if not (cells.tied & ~plain).any():
        do = "leave rows with knots: --flat-weave with fewer rows, or --kilim-ends"
        raise CarpetError("flat weave takes every knot of the carpet", allowed="at least one knot", do=do)
    if plain.any():
        cells = cells.woven(plain & ~cells.are(OUTSIDE), PLAIN_GROUND)
    for name, pile in pile_kinds(params.pile).items():
        cells = cells.woven((chart.knots == _index_of(name, chart, f"the pile of {name!r}")) & cells.tied, pile)
    if levels is not None:
        for level, pile in enumerate(params.levels):
            cells = cells.woven((levels == level) & cells.tied, pile)
    if params.carve is not None:
        cells = replace(cells, carving=_carving(params, chart))
    merged = cells.merged()
    made = chart if merged is None else replace(chart, cells=merged)
    made = with_ends(made, round(params.kilim_ends * chart.quality.along))
    return made if made is chart or made.creel is not None else used_first(made)


def _index_of(name: str, chart: Chart, noun: str) -> int:
    """The index of the yarn of a name. Raises CarpetError, which begins with the noun."""
    names = [yarn.name for yarn in chart.yarns]
    index = next((at for at, one in enumerate(names) if one.casefold() == name.casefold()), None)
    if index is None:
        hint = did_you_mean(name, names)
        raise CarpetError(f"{noun}: no yarn has this name", allowed=", ".join(names), do=hint)
    return index


def _carving(params: ShapeParams, chart: Chart) -> Carving:
    """The carved lines. Raises CarpetError for an unknown yarn."""
    named = [] if str(params.carve).strip().casefold() == ALL else str(params.carve).split(",")
    indices = [_index_of(name.strip(), chart, f"lines carved round {name.strip()!r}") for name in named]
    return Carving(params.carve_depth, params.carve_angle, tuple(chart.yarns[index].name for index in indices))


def with_ends(chart: Chart, rows: int) -> Chart:
    """The chart with a number of rows of flat weave more at each end."""
    if not rows:
        return chart
    cells = (chart.cells or all_knots(chart.rows, chart.columns)).woven(np.zeros_like(chart.knots, bool), PLAIN_GROUND)
    plain, beyond = cells.kinds.index(PLAIN_GROUND), ((rows, rows), (0, 0))
    size = replace(chart.size, length=chart.size.length + 2 * rows / chart.quality.along, name="")
    return replace(
        chart,
        knots=np.pad(chart.knots, beyond),
        cells=replace(cells, index=np.pad(cells.index, beyond, constant_values=plain)),
        overlay=replace(chart.overlay, rows=chart.overlay.rows + np.int32(rows)),
        size=size,
    )


def _inside(shape: str, chart: Chart) -> BoolArray:
    """Which cells are inside of a shape with an equation, by their middles."""
    size = chart.size
    if shape == RECTANGLE:
        return np.ones((chart.rows, chart.columns), dtype=bool)
    if shape == "round" and not math.isclose(size.width, size.length, rel_tol=1e-6):
        given = f"a round carpet of {size}"
        raise CarpetError(given, allowed="equal sides", do="--shape oval, or a size like 200x200cm")
    x = ((np.arange(chart.columns) + 0.5) / chart.columns - 0.5) * size.width
    y = (0.5 - (np.arange(chart.rows) + 0.5) / chart.rows) * size.length
    return SHAPES[shape](x[np.newaxis], y[:, np.newaxis], size.width, size.length)


def require_wide(inside: BoolArray, touched: BoolArray | None = None) -> None:
    """Raise CarpetError for a shape that is empty, or has an island narrower than LEAST_PART knots either way.

    touched  cells that the outline covers in part, too: an island may be smaller than a cell
    """
    if not inside.any():
        raise CarpetError("the shape has no cell inside", do="take another shape, or a finer quality")
    square = np.ones((LEAST_PART, LEAST_PART), dtype=bool)
    islands, _ = ndimage.label(inside if touched is None else touched, np.ones((3, 3)))
    kept = ndimage.binary_opening(inside, square)
    thin = np.setdiff1d(np.unique(islands), np.append(np.unique(islands[kept]), 0))
    if len(thin):
        rows, columns = ndimage.find_objects((islands == thin[0]).astype(int))[0]
        first, last = len(inside) - rows.stop + 1, len(inside) - rows.start
        where = f"rows {first}..{last}, knots {columns.start + 1}..{columns.stop}"
        more = "" if len(thin) == 1 else f", and {counted(len(thin) - 1, 'other')}"
        raise CarpetError(
            f"the shape has an island too thin to weave, {where}{more}",
            allowed=f"parts of at least {LEAST_PART} × {LEAST_PART} knots",
            do="leave it out, widen it, or take a finer quality",
        )


def _plain(chart: Chart, params: ShapeParams) -> BoolArray:
    """The cells of flat weave. Raises CarpetError for rows and knots that the carpet does not have."""
    plain = np.zeros((chart.rows, chart.columns), dtype=bool)
    for first, last, left, right in plain_areas(params.flat_weave):
        if last > chart.rows or (right or 0) > chart.columns:
            given = f"plain rows {first}-{last}" + (f", knots {left}-{right}" if left else "")
            raise CarpetError(given, allowed=f"the carpet has {chart.rows} rows of {chart.columns} knots")
        plain[chart.rows - last : chart.rows - first + 1, (left or 1) - 1 : right or chart.columns] = True
    return plain

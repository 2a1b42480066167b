"""Composition: the design of a recipe, one colour for each knot.

From the edge inwards: the borders, then the field with its picture, repeat or plain ground, then the motifs. A yarn
that is named is drawn in its colour and listed, so that the chart has exactly this yarn there. All parts are composed
before the palette rules, which therefore see the whole carpet.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from ilmek.arrays import Bool, Pixels
from ilmek.carpet.cells import CellKind, all_knots
from ilmek.carpet.chart import Chart
from ilmek.carpet.design import knot_grid, resampled
from ilmek.carpet.exact import few_colours
from ilmek.carpet.fitted import fitted_design
from ilmek.carpet.fitting import Fit, FitParams, fit_notes, prepare_picture
from ilmek.carpet.quality import Quality
from ilmek.carpet.reading import Design, ReadParams, read_design
from ilmek.carpet.recipe.border import draw_border, edges, teeth_tile
from ilmek.carpet.recipe.edits import located, srgb_of, yarn_number
from ilmek.carpet.recipe.layout import BorderLayout, CarpetLayout, lay_out
from ilmek.carpet.recipe.mirror import complete, part_grid
from ilmek.carpet.recipe.recipe import MOST_TILE, Motif, Recipe
from ilmek.carpet.recipe.repeat import repeated
from ilmek.carpet.recipe.structure import Area, DesignStructure, MotifCopy
from ilmek.carpet.shape import pile_kind
from ilmek.carpet.sizes import LARGEST, SMALLEST, CarpetSize
from ilmek.carpet.yarn import MOST_YARNS, Yarn
from ilmek.errors import CarpetError
from ilmek.progress import SILENT, Progress
from ilmek.records import record

_KINDS = ("exact", "flat", "photo")
_HALF = 188
"""The sRGB code of half the light."""


@record
class Composition:
    """The design of a recipe.

    yarns   areas in which the knots of a yarn's colour are that yarn, by its index in the list; later ones prevail
    drawn   areas of an exacter reading than that of the whole, to which none of its rules applies, and which knots
    structure  where its parts lie      notes  on the fit
    piles   areas of parts with a pile of their own, which of their knots, and the pile; later ones prevail
    """

    design: Design
    structure: DesignStructure
    yarns: tuple[tuple[Area, int], ...] = ()
    drawn: tuple[tuple[Area, Bool[np.ndarray, "rows columns"] | None], ...] = ()
    notes: tuple[str, ...] = ()
    piles: tuple[tuple[Area, Bool[np.ndarray, "rows columns"], CellKind], ...] = ()

    def piled(self, chart: Chart) -> Chart:
        """The chart of the design with the piles of its parts."""
        cells = all_knots(chart.rows, chart.columns) if chart.cells is None else chart.cells
        for area, shown, pile in self.piles:
            where = np.zeros(chart.knots.shape, dtype=bool)
            where[area] = shown
            cells = cells.woven(where & cells.tied, pile)
        return replace(chart, cells=cells.merged()) if self.piles else chart


@dataclass(slots=True)
class _Canvas:
    """What is drawn so far, and from what: pictures of parts, and what every part is made of."""

    colours: Pixels
    pictures: Mapping[Path, Pixels]
    list_of_yarns: tuple[Yarn, ...]
    quality: Quality
    reading: ReadParams
    yarns: list[tuple[Area, int]] = field(default_factory=list)
    drawn: list[tuple[Area, str, Bool[np.ndarray, "rows columns"] | None]] = field(default_factory=list)
    designs: list[Design] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    piles: list[tuple[Area, Bool[np.ndarray, "rows columns"], CellKind]] = field(default_factory=list)

    def raise_pile(self, pile: str, area: Area, shown: Bool[np.ndarray, "rows columns"]) -> None:
        """Give the knots of an area that are shown a pile; "": leave it."""
        if pile:
            self.piles.append((area, shown, pile_kind(pile)))

    def colour(self, name: str, area: Area) -> tuple[int, int, int]:
        """The colour of a yarn, which the area has; a yarn that is named is listed."""
        if name.startswith("#"):
            return srgb_of(name)
        number = yarn_number(name, self.list_of_yarns)
        self.yarns.append((area, number))
        return self.list_of_yarns[number].srgb

    def read_tile(self, rgb: Pixels, grid: tuple[int, int]) -> Pixels:
        """A tile on its grid; each of its pixels is a knot where it has that grid and few colours."""
        exact = None
        if self.reading.reading in ("auto", "exact") and rgb.shape[:2] == grid and few_colours(rgb, MOST_YARNS):
            exact = Design(rgb, "exact", f"its pixels are the {grid[1]} × {grid[0]} knots", 0)
        elif self.reading.reading == "exact":
            pixels = f"{rgb.shape[1]} × {rgb.shape[0]} pixels"
            given = f"reading is exact, and a tile of {pixels} has {grid[1]} × {grid[0]} knots"
            raise CarpetError(given, do="leave out its width and length, or the reading")
        self.designs.append(exact or read_design(rgb, grid, self.reading))
        return self.designs[-1].colours

    def mark(self, area: Area, kind: str = "", shown: Bool[np.ndarray, "rows columns"] | None = None) -> None:
        """List an area with its reading; default: that of the picture that was read last."""
        self.drawn.append((area, kind or self.designs[-1].kind, shown))

    def tile(self, path: Path, grid: tuple[int, int]) -> Pixels:
        """A tile on its grid."""
        rgb = self.pictures[path]
        for (height, width), noun in ((rgb.shape[:2], "pixels"), (grid, "knots")):
            if height * width > MOST_TILE:
                given = f"{path.name} has {width} × {height} {noun}"
                raise CarpetError(given, allowed=f"at most {MOST_TILE:,} of a tile or a motif", do="make it smaller")
        return self.read_tile(rgb, grid)


def compose(
    recipe: Recipe,
    size: CarpetSize,
    quality: Quality,
    yarns: tuple[Yarn, ...],
    pictures: Mapping[Path, Pixels],
    *,
    fit: FitParams | None = None,
    reading: ReadParams | None = None,
    progress: Progress = SILENT,
) -> Composition:
    """The design of a recipe from the pixels of its pictures.

    pictures  sRGB of each file of `recipe.pictures`
    yarns     the list, in which the recipe's yarns are found
    Raises CarpetError, with file and line, for a part that does not fit and a yarn that is not in the list.
    """
    grid = knot_grid(size, quality)
    shapes = {path: (int(rgb.shape[0]), int(rgb.shape[1])) for path, rgb in pictures.items()}
    layout = lay_out(recipe, size, quality, grid, shapes)
    canvas = _Canvas(np.empty((*grid, 3), dtype=np.uint8), pictures, yarns, quality, reading or ReadParams())
    for border in layout.borders:
        with located(border.border.where):
            _draw_border(canvas, border)
        progress(0.1)
    with located(recipe.where):
        done = _draw_field(canvas, recipe, layout, fit or FitParams(), progress.part(0.1, 0.9))
    motifs = []
    for motif in recipe.motifs:
        with located(motif.where):
            motifs.append(_draw_motif(canvas, motif, layout))
        progress(0.9)
    whole = _whole(canvas, recipe.file.name)
    kept = tuple((area, shown) for area, kind, shown in canvas.drawn if _KINDS.index(kind) < _KINDS.index(whole.kind))
    structure = DesignStructure(recipe, grid, layout, done, _tile_sides(recipe, pictures), tuple(motifs))
    return Composition(whole, structure, tuple(canvas.yarns), kept, tuple(canvas.notes), tuple(canvas.piles))


def _whole(canvas: _Canvas, file: str) -> Design:
    """The design of all parts: a photo if one of them is, else flat if one is."""
    kinds = [design.kind for design in canvas.designs]
    kind = max(kinds, key=_KINDS.index, default="exact")
    counted = ", ".join(f"{kinds.count(one)} {one}" for one in _KINDS if one in kinds)
    reason = f"composed by {file} of pictures: {counted}" if counted else f"composed by {file} without pictures"
    if len(canvas.designs) == 1:
        reason = f"composed by {file}: {canvas.designs[0].reason}"
    foreign = [design.foreign for design in canvas.designs]
    total = None if None in foreign else sum(count or 0 for count in foreign)
    return Design(canvas.colours, kind, reason, total)


def _draw_border(canvas: _Canvas, one: BorderLayout) -> None:
    border, (high, wide) = one.border, one.breadth
    rows, columns = canvas.colours.shape[:2]
    area = (slice(one.inset[0], rows - one.inset[0]), slice(one.inset[1], columns - one.inset[1]))
    out = canvas.colours[area]
    ring = np.zeros(out.shape[:2], dtype=bool)
    for part in edges(out.shape[0], out.shape[1], one.breadth):
        ring[part] = True
    canvas.raise_pile(border.pile, area, ring)
    if border.yarn:
        colour = canvas.colour(border.yarn, area)
        for part in edges(out.shape[0], out.shape[1], one.breadth):
            out[part] = colour
        return
    assert one.tile is not None
    if border.teeth:
        outer, inner = (canvas.colour(name, area) for name in border.teeth)
        tiles = [teeth_tile((outer, inner), breadth) for breadth in one.breadth]
    else:
        assert border.tile is not None
        kind = len(canvas.designs)
        tiles = [canvas.tile(border.tile, (high, one.tile[0]))]
        same = (wide, one.tile[1]) == (high, one.tile[0])
        tiles.append(tiles[0] if same else canvas.tile(border.tile, (wide, one.tile[1])))
        del canvas.designs[kind + 1 :]
    corner = None if border.corner is None else canvas.tile(border.corner, (high, wide))
    draw_border(out, (tiles[0], np.swapaxes(tiles[1], 0, 1)), one.units, one.motifs, corner)
    _mark_sides(canvas, area, one.breadth, "exact" if border.teeth else "")


def _mark_sides(canvas: _Canvas, area: Area, breadth: tuple[int, int], kind: str) -> None:
    """List the four sides of a border."""
    top, left = area[0].start, area[1].start
    for rows, columns in edges(area[0].stop - top, area[1].stop - left, breadth):
        canvas.mark((slice(rows.start + top, rows.stop + top), slice(columns.start + left, columns.stop + left)), kind)


def _draw_field(canvas: _Canvas, recipe: Recipe, layout: CarpetLayout, fitting: FitParams, progress: Progress) -> Fit:
    """Draw the field; returns how its picture was fitted."""
    (top, left), (rows, columns) = layout.inset, layout.field
    area = (slice(top, top + rows), slice(left, left + columns))
    out, done = canvas.colours[area], Fit()
    if recipe.plain:
        out[:] = canvas.colour(recipe.plain, area)
    if recipe.picture is not None:
        part = part_grid(recipe.mirror, layout.field)
        size = _part_size(part, canvas.quality)
        prepared, done = prepare_picture(canvas.pictures[recipe.picture], fitting, progress.part(0.0, 0.3), size=size)
        design, fitted, done = fitted_design(
            prepared,
            done,
            size,
            canvas.quality,
            fitting=fitting,
            reading=canvas.reading,
            grid=part,
            progress=progress.part(0.3, 1.0),
        )
        canvas.designs.append(design)
        canvas.notes += fit_notes(done, fitted.shape[:2], size, part)
        out[: part[0], : part[1]] = design.colours
    if recipe.repeat is not None:
        with located(recipe.repeat.where):
            _draw_repeat(canvas, recipe, out, progress)
        canvas.mark(area)
    complete(out, recipe.mirror)
    return done


def _part_size(part: tuple[int, int], quality: Quality) -> CarpetSize:
    """The size of a part of the carpet. Raises CarpetError for one that no picture can fill."""
    width, length = part[1] / quality.across, part[0] / quality.along
    if min(width, length) < SMALLEST or max(width, length) > LARGEST:
        raise CarpetError(
            f"the field of {part[1]} × {part[0]} knots is too small for a picture",
            do="make the borders narrower, or take a larger size",
        )
    return CarpetSize(width, length)


def _draw_repeat(canvas: _Canvas, recipe: Recipe, out: Pixels, progress: Progress) -> None:
    repeat = recipe.repeat
    assert repeat is not None
    sides = _tile_sides(recipe, canvas.pictures)
    assert sides is not None
    tile = canvas.tile(repeat.tile, sides)
    filled = repeated(tile, out, repeat.order, cut=repeat.cut, progress=progress)
    if not filled and not recipe.plain:
        given = f"whole tiles of {tile.shape[1]} × {tile.shape[0]} knots do not fill the field of "
        given += f"{out.shape[1]} × {out.shape[0]}"
        raise CarpetError(given, do='give the ground, like plain = "ivory", or cut = true')


def _tile_sides(recipe: Recipe, pictures: Mapping[Path, Pixels]) -> tuple[int, int] | None:
    """Rows and columns of the tile that the field repeats; None: it has none."""
    if (repeat := recipe.repeat) is None:
        return None
    height, width = pictures[repeat.tile].shape[:2]
    return repeat.length or height, repeat.width or width


def _draw_motif(canvas: _Canvas, motif: Motif, layout: CarpetLayout) -> tuple[MotifCopy, ...]:
    """Draw a motif and its reflections."""
    rgb = canvas.pictures[motif.picture]
    height, width = _sides(motif, rgb)
    first = _first(motif, (height, width), layout, canvas.colours.shape[:2])
    colours = canvas.tile(motif.picture, (height, width))
    shown = _shown(motif, rgb, (height, width))
    rows, columns = canvas.colours.shape[:2]
    copies = []
    for down, right in _copies(motif):
        top = rows - first[0] - height if down else first[0]
        left = columns - first[1] - width if right else first[1]
        step = (slice(None, None, -1 if down else 1), slice(None, None, -1 if right else 1))
        area = (slice(top, top + height), slice(left, left + width))
        canvas.colours[area][shown[step]] = colours[step][shown[step]]
        canvas.mark(area, shown=shown[step])
        canvas.raise_pile(motif.pile, area, shown[step])
        copies.append(MotifCopy(area, (down, right)))
    return tuple(copies)


def _sides(motif: Motif, rgb: Pixels) -> tuple[int, int]:
    """Rows and columns of a motif; in proportion to its pixels where one of them is given."""
    height, width = int(rgb.shape[0]), int(rgb.shape[1])
    if motif.width is None and motif.length is None:
        return height, width
    if motif.width is None:
        return motif.length or height, max(1, round(width * (motif.length or height) / height))
    return motif.length or max(1, round(height * motif.width / width)), motif.width


def _first(motif: Motif, sides: tuple[int, int], layout: CarpetLayout, grid: tuple[int, ...]) -> tuple[int, int]:
    """Row and column of the upper left knot of a motif. Raises CarpetError if it lies outside field or carpet."""
    (height, width), (top, left), (rows, columns) = sides, layout.inset, layout.field
    given = f"the motif of {width} × {height} knots"
    if isinstance(motif.position, tuple):
        row, column = grid[0] - motif.position[0] - height + 1, motif.position[1] - 1
        if min(row, column) < 0 or motif.position[0] < 1 or column + width > grid[1]:
            at = f"{given} with its lower left knot at {motif.position[0]},{motif.position[1]} lies outside the carpet"
            raise CarpetError(at, allowed=f"rows 1 to {grid[0]}, columns 1 to {grid[1]}")
        return row, column
    if height > rows or width > columns:
        raise CarpetError(f"{given} does not fit into the field", allowed=f"at most {columns} × {rows} knots")
    middle = top + (rows - height) // 2, left + (columns - width) // 2
    corner = motif.position == "corners"
    return (
        top if corner or motif.position == "ends" else middle[0],
        left if corner or motif.position == "sides" else middle[1],
    )


def _copies(motif: Motif) -> list[tuple[bool, bool]]:
    """Whether each copy is reflected downwards and to the right."""
    mirror = {"corners": "both", "ends": "along", "sides": "across"}.get(str(motif.position), motif.mirror)
    down = (False, True) if mirror in ("along", "both") else (False,)
    right = (False, True) if mirror in ("across", "both") else (False,)
    return [(one, other) for one in down for other in right]


def _shown(motif: Motif, rgb: Pixels, sides: tuple[int, int]) -> Bool[np.ndarray, "rows columns"]:
    """The knots of a motif that are not transparent."""
    if not motif.transparent:
        return np.ones(sides, dtype=bool)
    opaque = (rgb != np.array(srgb_of(motif.transparent), dtype=np.uint8)).any(axis=-1)
    light = np.where(opaque[..., None], np.uint8(255), np.uint8(0)).repeat(3, axis=-1)
    return np.asarray(resampled(light, *sides)[..., 0] >= _HALF)

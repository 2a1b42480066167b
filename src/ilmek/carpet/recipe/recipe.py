"""The records of a recipe.

A yarn is named as in the yarn list, and is then exactly that yarn; or it is a colour, #rrggbb, and is then the nearest
yarn of the list. `where` is the file and line of an entry, for messages.
"""

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ilmek.carpet.quality import shortest_quality
from ilmek.carpet.recipe.anchor import CARPET, grid_text
from ilmek.carpet.recipe.edits import Edit
from ilmek.records import JsonObject

ORDERS = ("straight", "brick", "half-drop", "mirrored")
"""straight: in rows and columns; brick: every second row is shifted by half a tile; half-drop: every second column is;
mirrored: every second tile is reflected, in both directions."""

POSITIONS = ("centre", "corners", "ends", "sides")
"""Of a motif in the field: its centre; at the corners, drawn for the upper left one; at the middle of the upper and the
lower end, drawn for the upper one; at the middle of both sides, drawn for the left one."""

MOST_BORDERS, MOST_MOTIFS, MOST_EDITS = 60, 60, 10_000
"""Largest numbers of borders, motifs and edits of a recipe."""

MOST_TILE = 4_000_000
"""Largest number of pixels of a tile, a corner or a motif."""


@dataclass(frozen=True, slots=True)
class Breadth:
    """A breadth: a number of knots, or a length [m]."""

    knots: int | None = None
    length: float | None = None

    def on(self, density: float) -> int:
        """The number of knots at a density [1/m]."""
        if self.knots is not None:
            return self.knots
        assert self.length is not None
        return max(1, round(self.length * density))

    def as_plain(self) -> int | str:
        """As in a file: knots, or a length with its unit."""
        return self.knots if self.knots is not None else f"{self.length!r}m"


@dataclass(frozen=True, slots=True)
class Repeat:
    """A tile over the field.

    width, length  of the tile [knots]; default: its own pixels
    cut            the tiles at the edges of the field are cut; else the whole tiles that fit are centred
    """

    tile: Path
    width: int | None = None
    length: int | None = None
    order: str = ORDERS[0]
    cut: bool = False
    where: str = ""


@dataclass(frozen=True, slots=True)
class Border:
    """A border, from one edge to the next: a stripe of one yarn, teeth of two, or a tile.

    width   default: that of the tile; of teeth it is half their length along the border
    length  of the tile along the border [knots]; default: its own pixels, in proportion to the width
    corner  picture of the upper left corner; default: the tile, reflected at the diagonal
    alternate  the tile is two motifs that alternate: a side begins and ends with the first, the corner is the second
    adjust  the motifs of a side are made a little longer until they fill it
    pile    of its knots: a height, loop or both; "": as the carpet has it
    """

    width: Breadth | None = None
    yarn: str = ""
    teeth: tuple[str, ...] = ()
    tile: Path | None = None
    length: int | None = None
    corner: Path | None = None
    alternate: bool = False
    adjust: bool = False
    pile: str = ""
    where: str = ""


@dataclass(frozen=True, slots=True)
class Motif:
    """A picture in the field.

    position     of POSITIONS, or row and column of the motif's lower left knot, counted from 1 at the carpet's lower
                 left corner
    mirror       further copies by reflection, of MIRRORS; "": none
    width, length  [knots]; default: its own pixels
    transparent  colour of its pixels that leave the field as it is; "": none
    pile         of its knots, as of a border
    """

    picture: Path
    position: str | tuple[int, int] = POSITIONS[0]
    mirror: str = ""
    width: int | None = None
    length: int | None = None
    transparent: str = ""
    pile: str = ""
    where: str = ""


@dataclass(frozen=True, slots=True)
class Recipe:
    """A carpet as a recipe.

    picture  of the field, or with `mirror` of its half or quarter      plain  yarn of the field
    repeat   tile of the field; `plain` is the ground of tiles that do not fill it
    """

    file: Path
    picture: Path | None = None
    plain: str = ""
    repeat: Repeat | None = None
    mirror: str = ""
    borders: tuple[Border, ...] = ()
    motifs: tuple[Motif, ...] = ()
    edits: tuple[Edit, ...] = ()
    where: str = ""

    @property
    def pictures(self) -> Mapping[Path, str]:
        """The files of all pictures, and where each is first named."""
        found: list[tuple[Path | None, str]] = [(self.picture, self.where)]
        found += [] if self.repeat is None else [(self.repeat.tile, self.repeat.where)]
        found += [(path, border.where) for border in self.borders for path in (border.tile, border.corner)]
        found += [(motif.picture, motif.where) for motif in self.motifs]
        return {path: where for path, where in reversed(found) if path is not None}

    @property
    def named(self) -> Iterator[tuple[str, str]]:
        """The yarns that the recipe gives to knots, by name or colour, and where each is named."""
        yield from self.laid
        for edit in self.edits:
            yield edit.yarns.rpartition(" by ")[2], edit.where

    @property
    def laid(self) -> Iterator[tuple[str, str]]:
        """Those of them that the design has, before the edits."""
        yield self.plain, self.where
        for border in self.borders:
            yield from ((name, border.where) for name in (border.yarn, *border.teeth))

    @property
    def is_composed(self) -> bool:
        """Whether anything but one whole picture makes the design."""
        return self.picture is None or bool(self.mirror or self.borders or self.motifs)

    def as_dict(self) -> JsonObject:
        """The recipe as plain data; paths are relative to its folder."""
        return plain_data(self, lambda path: path.relative_to(self.file.parent).as_posix())


def plain_data(recipe: Recipe, named: Callable[[Path], str]) -> JsonObject:
    """The layout and the edits of a recipe with the keys of a file; what is left open is left out.

    named  a picture's path as it is written
    """

    def path(file: Path | None) -> str:
        return "" if file is None else named(file)

    def given(**entries: object) -> JsonObject:
        return {key: value for key, value in entries.items() if value}

    data = given(picture=path(recipe.picture), plain=recipe.plain, mirror=recipe.mirror)
    if (tiled := recipe.repeat) is not None:
        order = tiled.order if tiled.order != ORDERS[0] else ""
        data["repeat"] = given(
            tile=path(tiled.tile), width=tiled.width, length=tiled.length, order=order, cut=tiled.cut
        )
    if recipe.borders:
        data["border"] = [
            given(
                width=border.width and border.width.as_plain(),
                yarn=border.yarn,
                teeth=list(border.teeth),
                tile=path(border.tile),
                length=border.length,
                corner=path(border.corner),
                alternate=border.alternate,
                adjust=border.adjust,
                pile=border.pile,
            )
            for border in recipe.borders
        ]
    if recipe.motifs:
        data["motif"] = [
            given(
                picture=path(motif.picture),
                position=list(motif.position) if isinstance(motif.position, tuple) else motif.position,
                mirror=motif.mirror,
                width=motif.width,
                length=motif.length,
                transparent=motif.transparent,
                pile=motif.pile,
            )
            for motif in recipe.motifs
        ]
    return {**data, **given(edits=_plain_edits(recipe.edits))}


def _plain_edits(edits: Sequence[Edit]) -> list[Any]:
    """The lines of edits; where any states what it counts, tables of neighbours that count the same."""
    if all(edit.anchor.is_open for edit in edits):
        return [edit.text for edit in edits]
    tables = []
    for anchor, lines in itertools.groupby(edits, lambda edit: edit.anchor):
        keys: JsonObject = {} if anchor.on == CARPET else {"on": anchor.name}
        keys |= {} if anchor.grid is None else {"grid": grid_text(anchor.grid)}
        keys |= {} if anchor.grid is None or anchor.quality is None else {"quality": shortest_quality(anchor.quality)}
        tables.append({**keys, "lines": [edit.text for edit in lines]})
    return tables

"""Main dimensions of a plate in its DXF: outer size, bores, distances of holes."""

import math
from collections.abc import Iterator
from itertools import combinations, pairwise

import numpy as np
from ezdxf.document import Drawing
from ezdxf.layouts.layout import Modelspace

from ilmek.io.plate_shape import PlateShape
from ilmek.plane.contours import along
from ilmek.report import Contour, Hole, Plate
from ilmek.units import mm

STYLE = "ILMEK"
_HEIGHTS = (0.35, 0.5, 0.7, 1.0, 1.8, 2.5, 3.5, 5.0, 7.0, 10.0, 14.0, 20.0, 28.0, 40.0)
_LAYER = {"layer": "DIMENSION"}


def text_height(shape: PlateShape) -> float:
    """Height of letters of the standard series [mm], about 1/50 of the plate's size."""
    target = shape.size / mm / 50
    return min(_HEIGHTS, key=lambda height: abs(math.log(height / target)))


def dimension(document: Drawing, space: Modelspace, plate: Plate, shape: PlateShape) -> complex:
    """Add the dimensions. Returns the lower left corner of their bounding box [m]."""
    height = text_height(shape)
    _add_style(document, height)
    gap = 4 * height * mm
    around = (shape.outline, *shape.paths.values())
    low, high = shape.box(shape.outline)
    reached = min(shape.box(path)[0].real for path in around), min(shape.box(path)[0].imag for path in around)
    beyond = complex(*reached) - (1 + 1j) * (2 * gap if len(plate.holes) > 1 else gap)
    _straight(space, low, complex(high.real, low.imag), beyond, 0.0)
    _straight(space, low, complex(low.real, high.imag), beyond, 90.0)
    for number, (first, second) in enumerate(_pairs(plate.holes)):
        space.add_aligned_dim(
            p1=_xy(first),
            p2=_xy(second),
            distance=_clear(shape.outline, first, second, gap + number * 0.6 * gap) / mm,
            dimstyle=STYLE,
            dxfattribs=_LAYER,
        ).render()
    for number, (hole, count) in enumerate(_kinds(plate.holes)):
        _diameter(space, hole, count, 45.0 + 25 * number, height)
    for cutout in shape.cutouts:
        _size_of(space, shape, cutout, gap)
    return beyond


def _add_style(document: Drawing, height: float) -> None:
    style = document.dimstyles.duplicate_entry("EZDXF", STYLE)
    style.dxf.dimtxt, style.dxf.dimasz = height, height
    style.dxf.dimexo, style.dxf.dimexe, style.dxf.dimgap = 0.4 * height, 0.5 * height, 0.3 * height
    style.dxf.dimdec, style.dxf.dimzin, style.dxf.dimlfac = 3, 8, 1.0
    style.dxf.dimtad, style.dxf.dimblk = 1, ""
    style.dxf.dimclrd, style.dxf.dimclre, style.dxf.dimclrt = 0, 0, 0
    style.dxf.dimtxsty = "OpenSans"


def _xy(point: complex) -> tuple[float, float]:
    return float(point.real / mm), float(point.imag / mm)


def _straight(space: Modelspace, first: complex, second: complex, base: complex, angle: float) -> None:
    space.add_linear_dim(
        base=_xy(base), p1=_xy(first), p2=_xy(second), angle=angle, dimstyle=STYLE, dxfattribs=_LAYER
    ).render()


def _pairs(holes: tuple[Hole, ...]) -> Iterator[tuple[complex, complex]]:
    """Pairs of holes whose distance is given, the left one first: all pairs of up to three holes, else neighbours."""
    centres = sorted((hole.at for hole in holes), key=lambda at: (round(at.real, 9), at.imag))
    yield from combinations(centres, 2) if len(centres) <= 3 else pairwise(centres)


def _clear(outline: Contour, first: complex, second: complex, gap: float) -> float:
    """Offset of a dimension line from the line between two holes, outside of the outline [m]."""
    points = along(outline, 1e-4)
    beside = ((points - first) * np.conj((second - first) / abs(second - first))).imag
    left, right = float(beside.max()), float(-beside.min())
    return left + gap if left <= right * (1 + 1e-9) else -(right + gap)


def _kinds(holes: tuple[Hole, ...]) -> Iterator[tuple[Hole, int]]:
    """One hole of each size, and the number of holes of that size."""
    sizes = [round(hole.radius, 9) for hole in holes]
    for size in dict.fromkeys(sizes):
        yield holes[sizes.index(size)], sizes.count(size)


def _diameter(space: Modelspace, hole: Hole, count: int, angle: float, height: float) -> None:
    """A diameter with its line outside of the hole."""
    outside = hole.at + (hole.radius + 3 * height * mm) * np.exp(1j * math.radians(angle))
    space.add_diameter_dim(
        center=_xy(hole.at),
        radius=hole.radius / mm,
        location=_xy(outside),
        text=f"{count}x <>" if count > 1 else "<>",
        dimstyle=STYLE,
        override={"dimpost": "Ø<>", "dimtoh": 1, "dimtofl": 0, "dimtmove": 1, "dimtix": 0},
        dxfattribs=_LAYER,
    ).render()


def _size_of(space: Modelspace, shape: PlateShape, cutout: Contour, gap: float) -> None:
    """Width and height of a cutout."""
    low, high = shape.box(cutout)
    _straight(space, low, complex(high.real, low.imag), low - 0.5j * gap, 0.0)
    _straight(space, low, complex(low.real, high.imag), low - 0.5 * gap, 90.0)

"""Sheets against the solids that they are of: sizes over all, bores and where they are, by ezdxf and the CAD kernel.

The sheets are read as DXF files by ezdxf; the solids by the kernel: boxes, cylindrical faces. Nothing of the drawing
code has a part in it.
"""

import math
import re
from collections.abc import Iterator
from itertools import combinations
from pathlib import Path
from typing import NamedTuple

import ezdxf
import numpy as np
from ezdxf.document import Drawing
from OCP.Bnd import Bnd_Box
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepBndLib import BRepBndLib
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Shape

from ilmek.io.drawings.dxf import write_sheet_dxf
from ilmek.io.hidden_lines import projected
from ilmek.io.step import part_solid
from ilmek.jobs.workshop import _own_names
from ilmek.machines.catalogue import find_machine
from ilmek.part.bolting import bolted
from ilmek.part.part import Part
from ilmek.part.plates import of_tree, tolerated
from ilmek.part.shapes import Prism
from ilmek.part.tree import Tree
from ilmek.report.sheet import DrawingSheet, Issue
from ilmek.viz.drawings.compose import sheets_of
from ilmek.viz.drawings.drawn_part import DrawnPart, drawn_piece, drawn_plate

NEAR = 2e-3
"""Deviation of what a sheet prints, with three decimals, from the solid [mm]."""

LISTED = 6e-3
"""Deviation of what a table of holes prints, to 0.01 mm [mm]."""

LINEAR, ALIGNED, DIAMETER, RADIUS, ORDINATE = 0, 1, 3, 4, 6


class Bore(NamedTuple):
    """An inner cylinder: diameter, a point of its axis and its direction [mm], and the angle that it goes round."""

    diameter: float
    point: np.ndarray
    axis: np.ndarray
    sweep: float


class ReadSheet(NamedTuple):
    """What ezdxf reads: dimensions by type, whether upright, and value [mm]; all texts; all of the file."""

    dimensions: tuple[tuple[int, bool, float], ...]
    texts: tuple[str, ...]
    document: Drawing

    def has(self, size: float, *kinds: int) -> bool:
        """Whether a size stands there as a dimension."""
        return any(abs(value - size) < NEAR for kind, _, value in self.dimensions if kind in kinds)


def made_parts(machine: str, **values: str) -> Iterator[tuple[DrawnPart, Part]]:
    """The made parts of a design as they are drawn, with their holes for screws, and what they are drawn of."""
    own, params = find_machine(machine).ordered(values)
    report = own.report(own.design(params), illustrated=False, assembled=False)
    every = *report.all_plates, *report.all_pieces
    trees = [made.tree for made in every if isinstance(made.tree, Tree)]
    whole = bolted(max(trees, key=lambda tree: len(tree.bodies))) if trees else None
    for listed, draw in ((report.all_plates, drawn_plate), (report.all_pieces, drawn_piece)):
        for name, each in _own_names([tolerated(of_tree(made, whole)) for made in listed]).items():
            if isinstance(each.part, Part):
                yield draw(each, report.machine, name), each.part  # type: ignore[operator]


def drawn_sheet(part: DrawnPart) -> DrawingSheet:
    """The first sheet of a part."""
    return sheets_of(part, Issue(), projected)[0]


def read(sheet: DrawingSheet, path: Path) -> ReadSheet:
    """A sheet, written to a file and read."""
    write_sheet_dxf(path, sheet)
    document = ezdxf.readfile(path)
    space = document.modelspace()
    dimensions = [(own, own.dxf.get("angle", 0.0) == 90.0) for own in space.query("DIMENSION")]
    return ReadSheet(
        tuple((own.dimtype, upright or _is_upright(own), own.dxf.actual_measurement) for own, upright in dimensions),
        tuple(text.dxf.text for text in space.query("TEXT")) + tuple(own.dxf.text for own, _ in dimensions),
        document,
    )


def _is_upright(dimension: object) -> bool:
    """Whether an ordinate measures along y."""
    own = dimension
    return own.dimtype == ORDINATE and not own.dxf.dimtype & 64  # type: ignore[attr-defined,no-any-return]


def envelope(solid: TopoDS_Shape) -> np.ndarray:
    """Sides of the box about a solid [mm]."""
    return np.asarray(np.ptp(corners_of(solid), axis=0))


def corners_of(solid: TopoDS_Shape) -> np.ndarray:
    """Least and greatest x, y, z of a solid [mm]."""
    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(solid, box, False, False)
    return np.array([[at.X(), at.Y(), at.Z()] for at in (box.CornerMin(), box.CornerMax())])


def bores(solid: TopoDS_Shape) -> list[Bore]:
    """The inner cylinders of a solid, pieces of one about the same axis together."""
    explorer, found = TopExp_Explorer(solid, TopAbs_ShapeEnum.TopAbs_FACE), dict[tuple[float, ...], Bore]()
    while explorer.More():
        face = TopoDS.Face(explorer.Current())
        surface = BRepAdaptor_Surface(face)
        if surface.GetType() == GeomAbs_SurfaceType.GeomAbs_Cylinder:
            cylinder = surface.Cylinder()
            axis, point = cylinder.Axis().Direction(), cylinder.Location()
            if (face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED) == cylinder.Direct():
                along, begin = (np.array([own.X(), own.Y(), own.Z()]) for own in (axis, point))
                sweep = surface.LastUParameter() - surface.FirstUParameter()
                key = tuple(round(own, 4) + 0.0 for own in (2 * cylinder.Radius(), *begin, *np.abs(along)))
                before = found[key].sweep if key in found else 0.0
                found[key] = Bore(2 * cylinder.Radius(), begin, along, before + sweep)
        explorer.Next()
    return [*found.values()]


def faults_of(part: DrawnPart, source: Part, sheet: ReadSheet) -> list[str]:
    """What of the solid its sheet does not say: sizes over all, diameters of bores, where they are in a plate."""
    solid = part_solid(source)
    faults = [
        f"size {size:.3f}"
        for size in envelope(solid).tolist()
        if not sheet.has(size, LINEAR, ALIGNED, DIAMETER, ORDINATE)
        and not any(
            size <= value < 1.03 * size for kind, _, value in sheet.dimensions if kind == DIAMETER
        )  # over teeth
    ]
    inner = [own for own in bores(solid) if own.sweep > 2 * math.pi - 1e-6]
    curve = part.smooth or part.cam is not None
    if not curve and isinstance(part.shape, Prism) and not part.bent:
        inner += [own for own in bores(solid) if own.sweep < 2 * math.pi - 1e-6]
    for size in sorted({round(own.diameter, 3) for own in inner}):
        words = [text for text in sheet.texts if re.search(rf"[⌀M]{size:.6g}\b", text)]
        if not (sheet.has(size, DIAMETER) or sheet.has(size / 2, RADIUS) or words):
            faults.append(f"bore {size}")
    if isinstance(part.shape, Prism) and not part.bent and source.drawing is None:
        faults += _unplaced(sheet, [own for own in inner if own.sweep > 2 * math.pi - 1e-6], corners_of(solid))
    return faults


def _unplaced(sheet: ReadSheet, holes: list[Bore], corners: np.ndarray) -> Iterator[str]:
    """Coordinates of bores that no dimension and no table gives from one datum: an end of the part, or one of them.

    Bores that are all on one line across a direction are their own datum in it.
    """
    centres = every = [complex(*own.point[:2]) for own in holes if abs(own.axis[2]) > 1 - 1e-9]
    for text in sheet.texts:  # evenly on a circle: its centre instead
        circle = re.match(r"(\d+)× [⌀M]([\d.]+).* on ⌀([\d.]+)", text)
        if circle is not None:
            number, size, across = (float(own) for own in circle.groups())
            alike = [complex(*own.point[:2]) for own in holes if abs(own.diameter - size) < NEAR]
            others = [centre for centre in centres if centre not in alike]
            centres = others + _by_circle([c for c in centres if c in alike], int(number), across / 2)
    tables = [number for number, text in enumerate(sheet.texts) if text.startswith("Holes, from the datum")]
    cells = sheet.texts[tables[0] :] if tables else ()
    listed = [float(text) for text in cells if re.fullmatch(r"-?[\d.]+", text)]
    radii = [value for kind, _, value in sheet.dimensions if kind == RADIUS]
    for name, upright in (("x", False), ("y", True)):
        own = sorted({round(centre.imag if upright else centre.real, 4) for centre in centres})
        given = [v for kind, up, v in sheet.dimensions if kind in {LINEAR, ORDINATE} and up is upright]
        values = np.abs(np.array([0.0, *given, *listed]))
        near = np.array([NEAR] * (1 + len(given)) + [LISTED] * len(listed))
        ends = corners[:, int(upright)].tolist()
        ends += [end + sign * radius for end, sign in zip(ends, (1, -1), strict=True) for radius in radii]
        others = [centre.imag if upright else centre.real for centre in every]
        datums = [*ends, *others]
        placed = any(all(np.min(np.abs(values - abs(c - datum)) - near) < 0 for c in own) for datum in datums)
        if own and not placed:
            yield f"{name} of bores {own}"


def _by_circle(centres: list[complex], number: int, radius: float) -> list[complex]:
    """Centres with so many on a pitch circle left out, and its centre put in."""
    for first, second in combinations(centres, 2):
        for middle in (first, (first + second) / 2, sum(centres) / len(centres)):
            ring = [c for c in centres if abs(abs(c - middle) - radius) < NEAR]
            if len(ring) == number:
                return [*(c for c in centres if c not in ring), middle]
    return centres

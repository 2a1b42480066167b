"""Plates as DXF: contours of lines and exact arcs in mm, on layers by their use.

PROFILE      the outline to cut            BORE    holes and cutouts        CUTTER_PATH  paths of the cutter's centre
PITCH        pitch curves, paths of eyes   MARK    lines to scribe          CENTRE       centre marks
GROOVE       flanks of a groove laid flat
DIMENSION    main dimensions               TEXT         title, material, number of pieces
"""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from ezdxf._options import options
from ezdxf.document import Drawing
from ezdxf.entities.circle import Circle
from ezdxf.entities.lwpolyline import LWPolyline
from ezdxf.enums import TextEntityAlignment
from ezdxf.filemanagement import new, readfile
from ezdxf.layouts.layout import Modelspace
from ezdxf.lldxf.const import DXFError
from ezdxf.units import MM

from ilmek.errors import OutputError
from ilmek.io.dxf_dimensions import dimension, text_height
from ilmek.io.plate_shape import PlateShape, plate_shape
from ilmek.part.tolerances import ToleratedFeature
from ilmek.plane.contours import area
from ilmek.report import Contour, Plate, RoundSolid
from ilmek.units import format_quantity, mm

options.write_fixed_meta_data_for_testing = True  # no time, no random number: the same plate gives the same bytes

LAYERS = {
    "PROFILE": (7, "Continuous", 50),
    "BORE": (5, "Continuous", 35),
    "GROOVE": (7, "Continuous", 35),
    "CUTTER_PATH": (1, "DASHDOT", 18),
    "PITCH": (3, "CENTER", 18),
    "MARK": (6, "Continuous", 25),
    "DIMENSION": (8, "Continuous", 18),
    "CENTRE": (4, "CENTER", 18),
    "TEXT": (7, "Continuous", 18),
}
"""Layer -> colour of the AutoCAD index, linetype, line weight [0.01 mm]."""


@dataclass(frozen=True, slots=True)
class DxfFacts:
    """Quantities of a DXF file of a plate that is read back.

    area    inside the profile [m^2]
    bored   area of holes and cutouts [m^2]
    points  number of points of the profile
    errors  number of errors found by the audit
    """

    area: float
    bored: float
    points: int
    errors: int


def write_dxf(path: Path, plate: Plate) -> PlateShape:
    """Write a plate to a file. Returns its shape as written. Raises OSError."""
    shape = plate_shape(plate)
    document = dxf_document(plate, shape)
    for name in sorted(document.entitydb.dxf_types_in_use()):  # the library adds them in the order of a set
        document.classes.add_class(name)
    with path.open("w", encoding=document.output_encoding, errors="dxfreplace", newline="\n") as stream:
        document.write(stream)
    return shape


def dxf_document(plate: Plate, shape: PlateShape) -> Drawing:
    """The plate as a DXF document (R2010, mm)."""
    document = new("R2010", setup=["linetypes", "styles", "dimstyles"], units=MM)
    for name, (colour, linetype, weight) in LAYERS.items():
        document.layers.add(name, color=colour, linetype=linetype, lineweight=weight)
    document.layers.get("0").dxf.lineweight = LAYERS["DIMENSION"][2]  # the layer of dimension lines inside their blocks
    height = text_height(shape)
    document.header["$LTSCALE"] = height / 4
    space = document.modelspace()
    _add(space, "PROFILE", shape.outline)
    for cutout in shape.cutouts:
        _add(space, "BORE", cutout)
    for name, path in shape.paths.items():
        _add(space, "CUTTER_PATH" if "cutter" in name else "PITCH", path)
    for hole in plate.holes:
        space.add_circle(_xy(hole.at), hole.radius / mm, dxfattribs={"layer": "BORE"})
    for name, line in plate.marks.items():
        space.add_lwpolyline([_xy(point) for point in line], dxfattribs={"layer": _layer_of_mark(name)})
    _mark_centres(space, plate, shape)
    low = dimension(document, space, plate, shape)
    _write_texts(space, plate, shape, low, height)
    return document


def _layer_of_mark(name: str) -> str:
    """Flanks of a groove are cut, paths of the cutter are followed, other lines are scribed."""
    if "flank" in name:
        return "GROOVE"
    return "CUTTER_PATH" if "cutter" in name else "MARK"


def read_dxf(path: Path) -> DxfFacts:
    """Read back and audit the DXF file of a plate. Raises OutputError for a file without exactly one profile."""
    try:
        document = readfile(path)
    except (OSError, DXFError) as error:
        raise OutputError(f"{path} cannot be read back: {error}") from None
    space = document.modelspace()
    lines = [line for line in space if isinstance(line, LWPolyline)]
    profiles = [_contour(line) for line in lines if line.dxf.layer == "PROFILE"]
    if len(profiles) != 1:
        raise OutputError(f"{path} has {len(profiles)} outlines", allowed="a plate has one")
    cut = sum(area(_contour(line)) for line in lines if line.dxf.layer == "BORE")
    circles = [circle for circle in space if isinstance(circle, Circle) and circle.dxf.layer == "BORE"]
    drilled = sum(np.pi * (circle.dxf.radius * mm) ** 2 for circle in circles)
    errors = len(document.audit().errors)
    return DxfFacts(area(profiles[0]), float(cut + drilled), len(profiles[0].points), errors)


def _xy(point: complex) -> tuple[float, float]:
    return float(point.real / mm), float(point.imag / mm)


def _add(space: Modelspace, layer: str, contour: Contour) -> None:
    """A contour as one closed polyline with bulges: a circle as a circle."""
    points = [(*_xy(at), float(bulge)) for at, bulge in zip(contour.points, contour.bulges, strict=True)]
    space.add_lwpolyline(points, format="xyb", close=True, dxfattribs={"layer": layer})


def _contour(line: LWPolyline) -> Contour:
    """A polyline read back [m]."""
    rows = np.array(line.get_points("xyb"))
    return Contour(mm * (rows[:, 0] + 1j * rows[:, 1]), rows[:, 2])


def _mark_centres(space: Modelspace, plate: Plate, shape: PlateShape) -> None:
    """Crosses at the holes, and at the origin if a cutout surrounds it."""
    reaches = [(hole.at, hole.radius) for hole in plate.holes]
    inside = [max(abs(corner) for corner in shape.box(cutout)) for cutout in shape.cutouts]
    if inside and all(at != 0 for at, _ in reaches):
        reaches.append((0j, max(inside)))
    for at, radius in reaches:
        for arm in (1.4 * radius, 1.4j * radius):
            space.add_line(_xy(at - arm), _xy(at + arm), dxfattribs={"layer": "CENTRE"})


def _write_texts(space: Modelspace, plate: Plate, shape: PlateShape, low: complex, height: float) -> None:
    """Title, material, thickness, number and area of the plate, below the drawing and its dimensions."""
    pieces = f"{plate.number} piece{'s' if plate.number > 1 else ''}"
    known = f"area {format_quantity(area(shape.outline) - shape.bored, 'cm^2', 6)}, without holes"
    thick = f"{format_quantity(plate.thickness, 'mm')} thick"
    round_solid = plate.solid if isinstance(plate.solid, RoundSolid) else None
    size = thick if round_solid is None else f"diameter {format_quantity(2 * round_solid.outer, 'mm')}"
    features = [feature for feature in plate.features if isinstance(feature, ToleratedFeature)]
    fits = dict.fromkeys(feature.label for feature in features if feature.tolerance)
    first = f"{plate.title} ({plate.name})", f"{plate.material}, {size}, {pieces}"
    _put(space, (*first, *plate.notes, *fits, f"mm, 1:1; {known}"), low, height)


def _put(space: Modelspace, lines: Iterable[str], low: complex, height: float) -> None:
    x, y = _xy(low)
    for index, line in enumerate(lines):
        text = space.add_text(line, height=height, dxfattribs={"layer": "TEXT", "style": "OpenSans"})
        text.set_placement((x, y - (2.5 + 1.7 * index) * height), align=TextEntityAlignment.LEFT)

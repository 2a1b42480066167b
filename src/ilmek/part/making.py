"""How a made part is made: the steps by which it is priced, with their quantities, from its own shape.

    sheet   a plate, or the flat pattern of a bent one; several plates are welded along the edges of what touches
    milled  from a box about it: what is removed, and all surfaces but the two of the stock, 2 V / t
    turned  from a round bar about it: what is removed, and all surfaces, of a plain bar its ends
    stock   a bar or tube cut to length, with what is cut from it

Surfaces are exact for prisms and turned shapes, 2 pi integral of r ds; those of sums count where their members touch.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache
from itertools import combinations
from typing import NamedTuple

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.making import BENDING, COATING, GRINDING, HARDENING, LASER, MILLING, SAWING, TURNING, WELDING
from ilmek.elements.materials import Material
from ilmek.part.folding import folded_sheet
from ilmek.part.part import Part
from ilmek.part.placement import IDENTITY, Placement
from ilmek.part.profile import line_moment
from ilmek.part.shapes import Placed, Prism, Shape, Sum, Turned, shape_box
from ilmek.plane.contours import area, bounds, length
from ilmek.report import ProcessStep
from ilmek.units import mm

WEB, KERF, ALLOWANCE, OFFCUT = 8 * mm, 3 * mm, 2 * mm, 0.05
"""Width between plates on a sheet, width of a saw's cut, allowance of a blank [m], share of stock that is left; assumed
by this project."""

_ROUND = 0.85
"""Share of a circle about its axis from which a section is round: of a square it is 0.64, of a hexagon 0.83."""

_TOUCHES = 0.05 * mm


class PartForm(NamedTuple):
    """What the making of a shape depends on: a box about it, volume, surface, holes, and whether it is round about z.

    size  sides of the box [m]      plain  a cylinder, bored or not, as stock has it
    """

    size: tuple[float, float, float]
    volume: float
    surface: float
    holes: int
    round: bool
    plain: bool


@lru_cache(maxsize=4096)
def form_of(shape: Shape) -> PartForm:
    """The form of a shape; of one that is no prism, turned or sum, by its mesh."""
    low, high = shape_box(shape)
    x, y, z = (high - low).tolist()
    size = (x, y, z)
    if isinstance(shape, Prism):
        section = shape.section
        surface = shape.length * _perimeter(shape) + 2 * section.area
        return PartForm(size, shape.volume, surface, len(section.holes), _is_round(shape), plain=False)
    if isinstance(shape, Turned):
        surface = 2 * math.pi * sum(line_moment(contour) for contour in shape.profile.contours)
        plain = len(shape.profile.outline.points) == 4
        return PartForm(size, shape.volume, surface, 0, round=True, plain=plain)
    if isinstance(shape, Sum):
        each = [(form_of(member.shape), len(member.positions)) for member in shape.members]
        surface, holes = (sum(count * getattr(form, name) for form, count in each) for name in ("surface", "holes"))
        return PartForm(size, shape.volume, surface, int(holes), all(form.round for form, _ in each), plain=False)
    solid = shape.mesh()
    a, b, c = (solid.points[solid.triangles[:, k]] for k in range(3))
    surface = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
    return PartForm(size, shape.volume, surface, 0, round=False, plain=False)


def _perimeter(prism: Prism) -> float:
    """Length of all contours of a section [m]."""
    return sum(length(contour) for contour in prism.section.contours)


def _is_round(prism: Prism) -> bool:
    outline = prism.section.outline
    radius = float(np.abs(outline.points).max())
    return abs(area(outline)) > _ROUND * math.pi * radius**2


Steps = Iterator[ProcessStep]


def _of_material(material: Material, volume: float) -> ProcessStep:
    return ProcessStep(material.name, mass=material.density * volume)


def _sheet(shape: Shape, material: Material) -> Steps:
    """Cut of sheet, bent where it is a folded strip, welded where it is of several plates."""
    plates = [placed for member in _members(shape) for placed in member]
    for plate, _ in plates:
        if not isinstance(plate, Prism):
            yield from _milled(plate, material)
            continue
        thick, wide, deep, cut = _flat(plate)
        yield _of_material(material, thick * (wide + WEB) * (deep + WEB))
        piercings = len(plate.section.contours) if thick == plate.length else 1
        yield ProcessStep(LASER, length=cut, area=cut * thick, features=piercings)
        sheet = folded_sheet(plate)
        if sheet is not None:
            yield ProcessStep(BENDING, features=len(sheet.bends))
    if len(plates) > 1:
        yield ProcessStep(WELDING, length=seam_length(shape))


def _flat(plate: Prism) -> tuple[float, float, float, float]:
    """Thickness, both sides of the blank, and length of the cut of a plate, flat or folded [m]."""
    sheet = folded_sheet(plate)
    if sheet is not None:
        return sheet.thickness, sheet.width, sheet.length, 2 * (sheet.width + sheet.length)
    low, high = bounds(plate.section.outline)
    across = high - low
    return plate.length, across.real, across.imag, _perimeter(plate)


def _members(shape: Shape) -> Iterator[list[tuple[Shape, Placement]]]:
    members = shape.members if isinstance(shape, Sum) else (Placed(shape),)
    return ([(member.shape, position) for position in member.positions] for member in members)


def seam_length(shape: Shape) -> float:
    """Length of the joints between the members of a sum [m]: the perimeters of what their boxes share, where it is
    flat.
    """
    return sum(2 * float(np.sort(high - low)[1:].sum()) for low, high in seams(shape))


def seams(shape: Shape) -> Iterator[tuple[FloatArray, FloatArray]]:
    """What the boxes of two members of a sum share, where it is flat: its least and greatest x, y, z [m]."""
    boxes = [
        shape_box(member) if position is IDENTITY else shape_box(Sum((Placed(member, (position,)),)))
        for members in _members(shape)
        for member, position in members
    ]
    for (low, high), (other_low, other_high) in combinations(boxes, 2):
        begin, end = np.maximum(low, other_low), np.minimum(high, other_high)
        shared = np.sort(end - begin)
        if abs(shared[0]) < _TOUCHES < shared[1]:
            yield begin, end


def _milled(shape: Shape, material: Material) -> Steps:
    """Sawn of a bar and milled all round, but for the two faces of the stock; round ones are turned."""
    form = form_of(shape)
    if form.round and not isinstance(shape, Prism):
        yield from _turned(shape, material)
        return
    thick, wide, long = sorted(form.size)
    blank = thick * (wide + 2 * ALLOWANCE) * (long + 2 * ALLOWANCE)
    yield _of_material(material, blank * (1 + OFFCUT))
    yield ProcessStep(SAWING, area=thick * (wide + 2 * ALLOWANCE))
    finished = max(form.surface - 2 * form.volume / thick, 0.0)
    yield ProcessStep(MILLING, area=finished, volume=max(blank - form.volume, 0.0), features=form.holes)


def _turned(shape: Shape, material: Material) -> Steps:
    """Turned of a bar; what is not round about the axis is milled."""
    form = form_of(shape)
    members = [member for members in _members(shape) for member, _ in members]
    milled = sum(not form_of(member).round for member in members)
    if milled == len(members):
        yield from _milled(shape, material)
        return
    x, y, long = form.size
    solid = form.plain and math.isclose(form.volume, math.pi / 4 * x**2 * long)
    diameter = max(x, y) + (0.0 if form.plain else 2 * ALLOWANCE)
    blank = math.pi / 4 * diameter**2 * (long + KERF)
    yield _of_material(material, blank * (1 + OFFCUT))
    ends = math.pi / 2 * diameter**2
    yield ProcessStep(TURNING, area=ends if solid else form.surface, volume=max(blank - form.volume, 0.0))
    if milled:
        yield ProcessStep(MILLING, features=milled)


def _cam(shape: Shape, material: Material) -> Steps:
    """Cut of sheet, its bores milled, its outline ground."""
    yield from _sheet(shape, material)
    if isinstance(shape, Prism):
        bores = sum(length(hole) for hole in shape.section.holes) * shape.length
        yield ProcessStep(MILLING, area=bores, features=len(shape.section.holes))
        yield ProcessStep(GRINDING, area=length(shape.section.outline) * shape.length)


def _stock(shape: Shape, material: Material) -> Steps:
    """Sawn off stock at both ends; what its section or its steps have less than the stock is milled or turned."""
    form, section = form_of(shape), stock_section(shape)
    long = form.size[2] if _is_hollow(shape) else max(form.size)
    yield _of_material(material, section * (long + KERF) * (1 + OFFCUT))
    yield ProcessStep(SAWING, area=2 * section)
    removed = section * long - form.volume
    if removed > _LEAST_CUT * section * long:
        finished = form.surface if isinstance(shape, Turned) else 0.0
        yield ProcessStep(MILLING if isinstance(shape, Prism) else TURNING, area=finished, volume=removed)


_LEAST_CUT = 1e-3
"""Share of a stock's volume below which nothing is cut from it."""


def stock_section(shape: Shape) -> float:
    """Area of the section of the bar or tube of which a part is cut [m²]."""
    if isinstance(shape, Turned):
        low, high = bounds(shape.profile.outline)
        return math.pi * (high.imag**2 - low.imag**2)
    if isinstance(shape, Sum):
        return max(stock_section(member.shape) for member in shape.members)
    if isinstance(shape, Prism) and _is_hollow(shape):
        wide, high, _ = form_of(shape).size
        outer = math.pi / 4 * wide**2 if _is_round(shape) else wide * high
        return outer - sum(abs(area(hole)) for hole in shape.section.holes)
    thick, wide, _ = sorted(form_of(shape).size)
    return thick * wide


def _is_hollow(shape: Shape) -> bool:
    return isinstance(shape, Prism) and bool(shape.section.holes)


def _welded(shape: Shape, material: Material) -> Steps:
    """Stock that is welded to others all round at both ends, and coated."""
    yield from _stock(shape, material)
    if isinstance(shape, Prism):
        around = length(shape.section.outline)
        yield ProcessStep(WELDING, length=2 * around)
        yield ProcessStep(COATING, area=around * shape.length)


ROUTES: Mapping[str, Callable[[Shape, Material], Steps]] = {
    "laser-cut part": _sheet,
    "cam plate": _cam,
    "machined link": _milled,
    "turned part": _turned,
    "pin or bush": _turned,
    "steel bar": _stock,
    "steel tube": _stock,
    "carbon tube": _stock,
    "welded frame": _welded,
}
"""How the parts of each process are made."""


def steps_of(part: Part) -> tuple[ProcessStep, ...]:
    """The steps in the making of a part; none for one that is bought, or made as no route has it."""
    if part.material is None or part.shape is None or part.process not in ROUTES:
        return ()
    return _steps(part.shape, part.material, part.process)


@lru_cache(maxsize=4096)
def _steps(shape: Shape, material: Material, process: str) -> tuple[ProcessStep, ...]:
    treated = (ProcessStep(HARDENING, mass=material.density * shape.volume),) if material.treatment else ()
    return (*ROUTES[process](shape, material), *treated)

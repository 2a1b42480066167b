"""How a made part is made: the steps by which it is priced, with their quantities, from its own shape and its blank.

sheet   a plate, or the flat pattern of a bent one; several plates are welded along the edges of what touches
milled  what is removed, and all surfaces but the two of the stock, 2 V / t
turned  what is removed, and all surfaces, of a plain bar its ends
stock   a bar or tube cut to length, with what is cut from it
"""

import math
from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache
from itertools import combinations

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.making import (
    BENDING,
    COATING,
    DRILLING,
    GRINDING,
    HARDENING,
    LASER,
    MILLING,
    SAWING,
    TURNING,
    WELDING,
)
from ilmek.elements.materials import Material
from ilmek.part.blanks import BAR, PLATE, Blank, flat_of, is_round, milled_of, sheet_of, stock_of, turned_of
from ilmek.part.features import drillings
from ilmek.part.folding import folded_sheet
from ilmek.part.forms import form_of, members_of
from ilmek.part.part import Part
from ilmek.part.placement import IDENTITY, Placement
from ilmek.part.shapes import Placed, Prism, Shape, Sum, Turned, shape_box
from ilmek.plane.contours import as_hole, as_keyed, length
from ilmek.report import ProcessStep
from ilmek.units import mm

WEB, KERF, OFFCUT = 8 * mm, 3 * mm, 0.05
"""Width between plates on a sheet, width of a saw's cut [m], share of stock that is left; assumed by this project."""

_TOUCHES = 0.05 * mm

Steps = Iterator[ProcessStep]
PlacedShape = tuple[Shape, Placement]


def _of_material(material: Material, volume: float) -> ProcessStep:
    return ProcessStep(material.name, mass=material.density * volume)


def _sheet(shape: Shape, material: Material) -> Steps:
    """Cut of sheet, bent where it is a folded strip, welded where it is of several plates; milled to its thickness."""
    plates = [plate for plate, _ in members_of(shape)]
    for plate in plates:
        if not isinstance(plate, Prism):
            yield from _milled(plate, material)
            continue
        thick, wide, deep, cut = flat_of(plate)
        (stock,) = sheet_of(plate).section
        yield _of_material(material, stock * (wide + WEB) * (deep + WEB))
        piercings = len(plate.section.contours) if thick == plate.length else 1
        yield ProcessStep(LASER, length=cut, area=cut * stock, features=piercings)
        if stock > thick * (1 + _LEAST_CUT):
            yield ProcessStep(MILLING, area=2 * wide * deep, volume=(stock - thick) * wide * deep)
        sheet = folded_sheet(plate)
        if sheet is not None:
            yield ProcessStep(BENDING, features=len(sheet.bends))
    if len(plates) > 1:
        yield ProcessStep(WELDING, length=seam_length(shape))


def seam_length(shape: Shape) -> float:
    """Length of the joints between the members of a sum [m]: the perimeters of what their boxes share, where it is
    flat.
    """
    return sum(2 * float(np.sort(high - low)[1:].sum()) for (low, high), _ in seams(shape))


def seams(shape: Shape) -> Iterator[tuple[tuple[FloatArray, FloatArray], tuple[PlacedShape, PlacedShape]]]:
    """What the boxes of two members of a sum share, where it is flat: its least and greatest x, y, z [m], and these."""
    boxes = [
        (shape_box(own) if position is IDENTITY else shape_box(Sum((Placed(own, (position,)),))), (own, position))
        for own, position in members_of(shape)
    ]
    for ((low, high), first), ((other_low, other_high), second) in combinations(boxes, 2):
        begin, end = np.maximum(low, other_low), np.minimum(high, other_high)
        shared = np.sort(end - begin)
        if abs(shared[0]) < _TOUCHES < shared[1]:
            yield (begin, end), (first, second)


def _milled(shape: Shape, material: Material) -> Steps:
    """Sawn of a bar and milled all round, but for the two faces of the stock; round ones are turned."""
    blank, form = milled_of(shape), form_of(shape)
    if blank.form != PLATE:
        yield from _turned(shape, material)
        return
    (thick,), short = blank.section, min(blank.sides)
    yield _of_material(material, blank.volume * (1 + OFFCUT))
    yield ProcessStep(SAWING, area=thick * short)
    finished = max(form.surface - 2 * form.volume / thick, 0.0)
    yield ProcessStep(MILLING, area=finished, volume=max(blank.volume - form.volume, 0.0), features=form.holes)


def _turned(shape: Shape, material: Material) -> Steps:
    """Turned of a bar; what is not round about the axis is milled."""
    blank, form = turned_of(shape), form_of(shape)
    if blank.form == BAR:
        yield from _milled(shape, material)
        return
    yield _of_material(material, blank.area * (blank.length + KERF) * (1 + OFFCUT))
    pin = math.isclose(form.volume, blank.area * form.size[2])
    turned = 2 * blank.area if pin else form.surface
    yield ProcessStep(TURNING, area=turned, volume=max(blank.volume - form.volume, 0.0))
    milled = sum(not form_of(member).round for member, _ in members_of(shape))
    if milled:
        yield ProcessStep(MILLING, features=milled)
    else:
        yield from _grooves(shape)


def _cam(shape: Shape, material: Material) -> Steps:
    """Cut of sheet, its bores milled, its outline ground."""
    yield from _sheet(shape, material)
    prisms = [prism for prism, _ in members_of(shape) if isinstance(prism, Prism)]
    bores = [(length(hole), prism.length) for prism in prisms for hole in prism.section.holes]
    yield ProcessStep(MILLING, area=sum(around * deep for around, deep in bores), features=len(bores))
    yield ProcessStep(GRINDING, area=sum(length(prism.section.outline) * prism.length for prism in prisms))


def _stock(shape: Shape, material: Material) -> Steps:
    """Sawn off stock at both ends; what its section or its steps have less than the stock is milled or turned."""
    yield from _cut_off(stock_of(shape), shape, material)


def _bar(shape: Shape, material: Material) -> Steps:
    """Sawn off a solid bar."""
    yield from _cut_off(stock_of(shape, hollow=False), shape, material)


def _cut_off(blank: Blank, shape: Shape, material: Material) -> Steps:
    form = form_of(shape)
    yield _of_material(material, blank.area * (blank.length + KERF) * (1 + OFFCUT))
    yield ProcessStep(SAWING, area=2 * blank.area)
    removed = blank.volume - form.volume
    if removed > _LEAST_CUT * blank.volume:
        finished = form.surface if isinstance(shape, Turned) else 0.0
        yield ProcessStep(MILLING if isinstance(shape, Prism) else TURNING, area=finished, volume=removed)
    yield from _grooves(shape)


_LEAST_CUT = 1e-3
"""Share of a stock's volume below which nothing is cut from it."""


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
    "steel bar": _bar,
    "steel tube": _stock,
    "carbon tube": _stock,
    "welded frame": _welded,
}
"""How the parts of each process are made."""


def steps_of(part: Part) -> tuple[ProcessStep, ...]:
    """The steps in the making of a part; none for one that is bought, or made as no route has it."""
    if part.material is None or part.shape is None or part.process not in ROUTES:
        return ()
    return _steps(part.shape, part.material, part.process, part.machined)


@lru_cache(maxsize=4096)
def _steps(shape: Shape, material: Material, process: str, machined: bool) -> tuple[ProcessStep, ...]:
    treated = (ProcessStep(HARDENING, mass=material.density * shape.volume),) if material.treatment else ()
    seats = _seats(shape) if machined else ()
    holes = len(drillings(shape))
    drilled = (ProcessStep(DRILLING, features=holes),) if holes else ()
    return (*ROUTES[process](shape, material), *seats, *drilled, *treated)


def _seats(shape: Shape) -> Steps:
    """What is round of it is turned, bores of other members are bored; where it has neither, its greatest face."""
    members = [member for member, _ in members_of(shape)]
    turned = sum(form_of(member).surface for member in members if is_round(member))
    plates = [own for own in members if isinstance(own, Prism) and not is_round(own)]
    bores = [(length(hole), own.length) for own in plates for hole in own.section.holes if as_hole(hole)]
    if turned:
        yield ProcessStep(TURNING, area=turned)
    if bores or not turned:
        _, wide, long = sorted(form_of(shape).size)
        area = sum(around * deep for around, deep in bores) or wide * long
        yield ProcessStep(MILLING, area=area, features=len(bores))


def _grooves(shape: Shape) -> Steps:
    """The keyways of shafts and hubs, which are milled or slotted."""
    sections = [prism.section for prism, _ in members_of(shape) if isinstance(prism, Prism)]
    keyed = sum(as_keyed(contour) is not None for section in sections for contour in section.contours)
    if keyed:
        yield ProcessStep(MILLING, features=keyed)

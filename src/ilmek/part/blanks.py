"""What a made part is cut from: bar, tube, section, plate or sheet of a size that is sold, no less than the part.

    sheet   of the plate's thickness, or the next one, from which it is milled; of a folded strip its developed width
    milled  a plate of the next thickness, with an allowance at its edges, of links and cams
    turned  a round bar: a pin of a size that is sold is that bar, bored or not; else the next one over an allowance
    stock   the bar, tube or section itself

A blank's size is a function of the shape; parts list, cut list, drawing and price read it from here.
"""

import math
from functools import lru_cache

import numpy as np

from ilmek.elements.stock_sizes import PLATES, ROUNDS, SQUARES, offered
from ilmek.part.folding import folded_sheet
from ilmek.part.forms import form_of, members_of, perimeter
from ilmek.part.part import Part
from ilmek.part.shapes import Prism, Shape, Sum, Turned, shape_box
from ilmek.plane.contours import bounds
from ilmek.records import record
from ilmek.units import format_number, mm

ALLOWANCE = 2 * mm
"""Allowance of a blank at a milled edge, and of both turned ends together [m]; assumed by this project."""

_TURNED, _LEAST_TURNED = 0.04, 0.5 * mm
"""Allowance of a turned diameter over it, and the least [m]; assumed by this project."""

SHEET, MILLED = ("laser-cut part",), ("machined link", "cam plate")
TURNED = ("turned part", "pin or bush")
SOLID = "steel bar"
STOCK = (SOLID, "steel tube", "carbon tube", "welded frame")
"""Processes by what they start from."""

ROUND, TUBE, SQUARE, HOLLOW, BAR, PLATE = "round", "tube", "square", "hollow section", "bar", "plate"
"""Forms of stock."""

_IN_SERIES = 1e-6
_SQUARE = 0.525
"""Distance of a corner from the middle over the least side up to which a section is round."""


@record
class Blank:
    """Stock that a part is cut from.

    form     of it         section  what it is ordered by: diameter; diameter and wall; sides and wall; thickness [m]
    sides    length that it is cut to, of a plate both sides [m]         area  of its section, of a plate its face [m²]
    """

    form: str
    section: tuple[float, ...]
    sides: tuple[float, ...]
    area: float

    @property
    def name(self) -> str:
        """Form and section in mm: `tube 140 x 5`."""
        return f"{self.form} {_crossed(self.section)}"

    @property
    def size(self) -> str:
        """Section and what is cut off it: `round 20 mm, 135 mm`."""
        return f"{self.name} mm, {_crossed(self.sides)} mm"

    @property
    def length(self) -> float:
        """Greatest side [m]."""
        return max(self.sides)

    @property
    def volume(self) -> float:
        """Volume [m³]."""
        return self.area * (self.section[0] if self.form == PLATE else self.length)


def _crossed(sizes: tuple[float, ...]) -> str:
    return " x ".join(format_number(size / mm) for size in sizes)


def size_of(part: Part) -> str:
    """The size of a part for people: of a made one its blank, of a bought one its size or designation."""
    if part.purchase is not None:
        return part.size or part.purchase.row
    blanks = dict.fromkeys(blank.size for blank in blanks_of(part))
    return " + ".join(blanks) or part.size


def blanks_of(part: Part) -> tuple[Blank, ...]:
    """What a made part is cut from; none of a bought one, and of one that is made as no route has it."""
    if part.material is None or part.shape is None:
        return ()
    return _blanks(part.shape, part.process)


@lru_cache(maxsize=4096)
def _blanks(shape: Shape, process: str) -> tuple[Blank, ...]:
    if process in SHEET:
        plates = (member for member, _ in members_of(shape))
        return tuple(sheet_of(plate) if isinstance(plate, Prism) else milled_of(plate) for plate in plates)
    if process in MILLED:
        return (milled_of(shape),)
    if process in TURNED:
        return (turned_of(shape),)
    return (stock_of(shape, hollow=process != SOLID),) if process in STOCK else ()


def sheet_of(plate: Prism) -> Blank:
    """The rectangle of sheet about a plate, flat or unfolded."""
    thick, *sides, _ = flat_of(plate)
    return _plate(thick, *sides)


def milled_of(shape: Shape) -> Blank:
    """The plate about a part, sawn with an allowance; the bar that it is turned from where it is round."""
    form = form_of(shape)
    if form.round and not isinstance(shape, Prism):
        return turned_of(shape)
    thick, *sides = sorted(form.size)
    return _plate(thick, *(side + 2 * ALLOWANCE for side in sides))


def _plate(thick: float, *sides: float) -> Blank:
    return Blank(PLATE, (offered(thick, PLATES),), tuple(sorted(sides)), math.prod(sides))


def turned_of(shape: Shape) -> Blank:
    """The round bar about a part along z; the flat bar where nothing of it is round."""
    form = form_of(shape)
    if not any(form_of(member).round for member, _ in members_of(shape)):
        thick, wide, long = sorted(form.size)
        section = offered(thick, PLATES), wide + 2 * ALLOWANCE
        return Blank(BAR, section, (long + 2 * ALLOWANCE,), math.prod(section))
    across = max(form.size[:2])
    pin = isinstance(shape, Turned) and _is_even(shape)
    bar = offered(across, ROUNDS)
    if not pin or bar - across > _IN_SERIES:
        bar = offered(across + max(_TURNED * across, _LEAST_TURNED), ROUNDS)
    return Blank(ROUND, (bar,), (form.size[2] + ALLOWANCE,), math.pi / 4 * bar**2)


def _is_even(shape: Turned) -> bool:
    """Whether the outside of a turned shape is one cylinder from end to end."""
    points, outer = shape.profile.outline.points, shape.outer_radius
    outside = points.real[points.imag > outer - _IN_SERIES]
    return bool(np.ptp(outside) > np.ptp(points.real) - _IN_SERIES)


def sold_as(part: Part) -> str:
    """Designation under which the stock of a made part is ordered: its form and size have their own standard.

    >>> from ilmek.elements.materials import find_material
    >>> from ilmek.part.shapes import bar
    >>> sold_as(Part("probe/wire", "wire", "turned part", bar(0.9e-3, 0.1), find_material("heat-treatable steel")))
    'SH EN 10270-1'
    """
    if part.material is None:
        return ""
    own = part.material.designation
    blank = next(iter(blanks_of(part)), None)
    if blank is None:
        return own
    rows = (row for row in _SOLD if row[0] == own and blank.form in row[1] and blank.section[0] < row[2])
    return next((row[3] for row in rows), own)


_STRUCTURAL, _HEAT_TREATABLE = "S235JR EN 10025-2", "C45+QT EN 10083-2"
_SOLD = (
    (_STRUCTURAL, (HOLLOW,), math.inf, "S235JRH EN 10219-1"),
    (_STRUCTURAL, (TUBE,), math.inf, "E235 EN 10305-1"),
    (_STRUCTURAL, (ROUND, SQUARE), 100 * mm, "S235JRC+C EN 10277"),
    (_STRUCTURAL, (PLATE,), 1.5 * mm, "HC260LA EN 10268"),
    (_HEAT_TREATABLE, (ROUND,), 2 * mm, "SH EN 10270-1"),
    (_HEAT_TREATABLE, (SQUARE,), 8 * mm, "C45+C DIN 6880"),
    (_HEAT_TREATABLE, (PLATE, BAR), 3 * mm, "C45E+QT EN 10132"),
)
"""Steel by its designation as plate or bar; form, and size below which it is sold otherwise [m]; what is sold: hollow
sections, precision tubes, bright bars, cold rolled sheet, spring wire, key steel, strip, none weaker than the first.
"""


def stock_of(shape: Shape, *, hollow: bool = True) -> Blank:
    """The bar, tube or section of which a part is a piece: that of the widest member of a sum.

    hollow  it may be a tube or a hollow section; else it is a bar of the next size
    """
    form, own = form_of(shape), _widest(shape)
    wide, high, _ = form_of(own).size
    across = max(wide, high)
    others = [one for one in form.size if abs(one - across) > _IN_SERIES]
    long = form.size[2] if own is shape else max(others or form.size)
    wall = _wall(own) if hollow or across > ROUNDS[-1] else 0.0  # a forged ring
    if is_round(own) and wall and _ring(across, wall) * long >= shape.volume * (1 - _IN_SERIES):
        return Blank(TUBE, (across, wall), (long,), _ring(across, wall))
    if is_round(own):
        sides = list(form.size)
        sides.remove(long)
        bar = offered(max(sides), ROUNDS)
        return Blank(ROUND, (bar,), (long,), math.pi / 4 * bar**2)
    if wall:
        inner_area = (wide - 2 * wall) * (high - 2 * wall)
        return Blank(HOLLOW, (*sorted((wide, high)), wall), (long,), wide * high - inner_area)
    thick, wide, long = sorted(form.size)
    if wide - thick < _IN_SERIES:
        side = offered(wide, SQUARES)
        return Blank(SQUARE, (side,), (long,), side**2)
    thick = offered(thick, PLATES)
    return Blank(BAR, (thick, wide), (long,), thick * wide)


def _ring(outer: float, wall: float) -> float:
    return math.pi * wall * (outer - wall)


def _widest(shape: Shape) -> Shape:
    """The shape, or that member of a sum which is the widest."""
    if not isinstance(shape, Sum):
        return shape
    return max((_widest(member.shape) for member in shape.members), key=lambda own: float(np.ptp(shape_box(own), 0)[0]))


def _wall(shape: Shape) -> float:
    """Wall of a tube or hollow section [m]; 0: it is solid, or has a bore of another form."""
    if isinstance(shape, Turned):
        radii = shape.profile.outline.points.imag
        inner = _least_inner(shape)
        return float(radii.max()) - inner if inner > _IN_SERIES else 0.0
    if not isinstance(shape, Prism) or not shape.section.holes:
        return 0.0
    (low, high), (begin, end) = bounds(shape.section.outline), bounds(shape.section.holes[0])
    walls = (high - low - (end - begin)) / 2
    return walls.real if abs(walls.real - walls.imag) < _IN_SERIES else 0.0


def _least_inner(shape: Turned) -> float:
    return float(shape.profile.outline.points.imag.min())


def is_round(shape: Shape) -> bool:
    """Whether it is cut from round stock: no corner of its section is much farther out than all its sides."""
    if not isinstance(shape, Prism):
        return isinstance(shape, Turned)
    low, high = bounds(shape.section.outline)
    size, middle = high - low, (low + high) / 2
    return float(np.abs(shape.section.outline.points - middle).max()) <= _SQUARE * min(size.real, size.imag)


@lru_cache(maxsize=4096)
def flat_of(plate: Prism) -> tuple[float, float, float, float]:
    """Thickness, both sides of the blank, and length of the cut of a plate, flat or bent; of a board its least side."""
    sheet = folded_sheet(plate)
    if sheet is not None:
        return sheet.thickness, sheet.width, sheet.length, 2 * (sheet.width + sheet.length)
    low, high = bounds(plate.section.outline)
    across = high - low
    if plate.length <= min(across.real, across.imag):
        return plate.length, across.real, across.imag, perimeter(plate)
    thick, wide, long = sorted((across.real, across.imag, plate.length))
    return thick, wide, long, 2 * (wide + long)

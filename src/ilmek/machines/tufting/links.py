"""Parts of a needle mechanism: eccentric, links with eyes, needle bar, pins, driven shaft; and their inertia as made.

    eccentric: a disc about A, bored at O, R = l1 + 0.75 d             coupler: a ring about it, and an eye at B
    rocker and arm: an eye on the driven shaft at C, and one at the other pin             rod: a flat link

d is the main shaft's diameter. An eye's radius is half the link's width, or what leaves a wall about its hole. The
needle bar has a bored head at E and is round from there to F; its diameter follows from its mass, with the needles.
"""

import math
from functools import lru_cache
from typing import NamedTuple

from scipy.optimize import brentq

from ilmek.dynamics.inertia import Inertia
from ilmek.elements.materials import MATERIALS, Material
from ilmek.machines.link_tree import GAP, Levels, LinkageParts, LinkSize, link_inertias, linkage_parts
from ilmek.machines.linkage_strength import largest_bar
from ilmek.machines.tufting.model import mechanism
from ilmek.machines.tufting.params import TuftingParams
from ilmek.part.flat_link import eyed_link
from ilmek.part.part import Part, Seat
from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, bar, rectangle
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import circle
from ilmek.report import Contour
from ilmek.sentences import Sentence

NAME = "tufting"
LINKS = ("coupler", "rocker", "arm", "rod")
STEEL = MATERIALS["heat-treatable steel"]

LEVELS = (("crank", "coupler"), ("rocker",), ("arm",), ("rod",), ("needle",))
"""Planes of the links; the eccentric turns in the coupler."""

SHAFTS = ("O", "A", "C", "shaft")
"""Joints without a pin: shafts, and the eccentric."""

WALL = 0.25
"""Wall of an eye or of the eccentric about its hole, over the hole's diameter; assumed by this project."""


class NeedleSizes(NamedTuple):
    """Diameters of both shafts, and of the pins by name [m]."""

    main: float
    driven: float
    pins: tuple[tuple[str, float], ...]

    def covers(self, other: "NeedleSizes") -> bool:
        """Whether none is less than another's."""
        return self == self.with_least(other)

    def with_least(self, other: "NeedleSizes") -> "NeedleSizes":
        """The greater of each."""
        pins = tuple((name, max(size, dict(other.pins)[name])) for name, size in self.pins)
        return NeedleSizes(max(self.main, other.main), max(self.driven, other.driven), pins)


def link_sections(params: TuftingParams) -> dict[str, tuple[float, float]]:
    """Width and thickness of each link [m]: as given, or by its mass."""
    density = params.strength.of_links.density
    link_sections = {}
    for link in LINKS:
        width, thickness = largest_bar(getattr(params, f"{link}_mass"), getattr(params, link), density)
        link_sections[link] = params.link_width or width, params.link_thickness or thickness
    return link_sections


@lru_cache(maxsize=16)
def needle_parts(params: TuftingParams, sizes: NeedleSizes) -> LinkageParts:
    """Plates, needle bar and pins of one mechanism."""
    sections, material = link_sections(params), params.strength.of_links
    thick = sections["coupler"][1]
    pins = dict(sizes.pins)
    plates = {name: LinkSize(*section, min(pins.values()), material) for name, section in sections.items()}
    needle = needle_diameter(params, pins["E"])
    room = {"crank": LinkSize(2 * params.crank, thick, sizes.main, material), **plates}
    if needle > 0:
        room["needle"] = LinkSize(needle, needle, pins["E"], material)
    formed = {
        "crank": eccentric(f"{NAME}/crank", params.crank, sizes.main, thick, material),
        "coupler": _eyed(params, "coupler", ring(params.crank, sizes.main), pins["B"]),
        "rocker": _eyed(params, "rocker", circle(0j, sizes.driven / 2), pins["B"]),
        "arm": _eyed(params, "arm", circle(0j, sizes.driven / 2), pins["D"]),
        "rod": _eyed(params, "rod", circle(0j, pins["D"] / 2), pins["E"]),
        **({"needle": needle_bar(params, pins["E"])} if needle > 0 else {}),
    }
    levels = Levels(tuple(level for level in LEVELS if set(level) <= set(room)), room, pins)
    return linkage_parts(NAME, mechanism(params), levels, formed, SHAFTS)


def made_inertias(params: TuftingParams, sizes: NeedleSizes) -> dict[str, Inertia]:
    """Inertias of the links as made with their pins, the driven shaft with the rocker."""
    shaft = driven_shaft(params, sizes)
    inertias = link_inertias(needle_parts(params, sizes), mechanism(params), {"rocker": (shaft,)})
    return inertias | ({} if params.needle_mass > 0 else {"needle": Inertia(0.0, 0j, 0.0)})


def mechanism_depth(params: TuftingParams, sizes: NeedleSizes) -> tuple[float, float]:
    """Least and greatest height of the links of a mechanism, with a gap on both sides [m]."""
    levels = needle_parts(params, sizes).levels
    low, high = levels.across(list(levels.sizes))
    gap = GAP * max(size.thickness for size in levels.sizes.values())
    return low - gap, high + gap


def driven_shaft(params: TuftingParams, sizes: NeedleSizes) -> Occurrence:
    """The driven shaft of one mechanism, in the frame of the rocker: through the links and the plates beside them."""
    low, high = mechanism_depth(params, sizes)
    beyond = sizes.driven
    return Occurrence(
        shaft_part("driven-shaft", "driven shaft", sizes.driven, high - low + 2 * beyond), (placement(z=low - beyond),)
    )


def shaft_part(name: str, title: str, diameter: float, length: float) -> Part:
    """A shaft about z from z = 0 [m]."""
    return Part(f"{NAME}/{name}", title, "steel bar", bar(diameter, length), STEEL, machined=True)


def needle_diameter(params: TuftingParams, pin: float) -> float:
    """Diameter of a bar from E to F that weighs, with its bored head, as much as bar and needles [m]; pin  at E [m].

    The head lets it weigh more than a round bar of that length, whose diameter is the greatest.
    """
    volume = params.needle_mass / STEEL.density
    round_one = math.sqrt(4 * volume / (math.pi * params.needle))
    if volume <= 0:
        return 0.0
    return float(brentq(lambda one: _needle_shape(params, pin, one).volume - volume, 1e-3 * round_one, round_one))


def needle_bar(params: TuftingParams, pin: float) -> Part:
    """The needle bar from E downwards, its lower side at z = 0, with a head about the pin at E."""
    diameter = needle_diameter(params, pin)
    shape = _needle_shape(params, pin, diameter)
    title = "needle bar with its needles"
    return Part(f"{NAME}/needle", title, "steel bar", shape, STEEL, envelope=True, machined=True)


def _needle_shape(params: TuftingParams, pin: float, diameter: float) -> Sum:
    """A bored block about E, as thick as the bar, and the bar below it."""
    side = min(max(diameter, pin * (1 + 2 * WALL)), params.needle)
    head = Prism(Profile(rectangle(side, side), (circle(0j, min(pin, 0.9 * side) / 2),)), diameter)
    down = placement(y=-side / 2, z=diameter / 2, about=(1.0, 0.0, 0.0), angle=math.pi / 2)
    return Sum((Placed(head), Placed(bar(diameter, params.needle - side / 2), (down,))))


def eccentric_radius(crank: float, shaft: float) -> float:
    """Radius of the eccentric of a crank on a shaft of a diameter [m]: R = l + 0.75 d."""
    return crank + (0.5 + WALL) * shaft


def ring(crank: float, shaft: float) -> Contour:
    """The coupler's hole for the eccentric, about its first pin."""
    return circle(0j, eccentric_radius(crank, shaft))


def eccentric(name: str, crank: float, shaft: float, thickness: float, material: Material) -> Part:
    """A crank on a shaft of a diameter [m]: a disc about A with the bore of the shaft at O, too thin for a key."""
    radius = eccentric_radius(crank, shaft)
    shape = Prism(Profile(circle(complex(crank), radius), (circle(0j, shaft / 2),)), thickness)
    seats = {"O": Seat(placement(), shaft), "A": Seat(placement(crank), 2 * radius)}
    notes = (Sentence("sheet.bonded"),)
    title, process = "eccentric of the crank", "machined link"
    return Part(name, title, process, shape, material, seats=seats, notes=notes, machined=True)


def _eyed(params: TuftingParams, link: str, hole: Contour, pin: float) -> Part:
    """A link with a hole about its first pin and one for the pin at its other end; diameter of the pin [m]."""
    ends = {"coupler": "AB", "rocker": "CB", "arm": "CD", "rod": "DE"}[link]
    section, length = link_sections(params)[link], getattr(params, link)
    return eyed((f"{NAME}/{link}", link), ends, length, section, hole, pin, params.strength.of_links)


def eyed(  # noqa: PLR0917
    names: tuple[str, str],
    ends: str,
    length: float,
    section: tuple[float, float],
    hole: Contour,
    pin: float,
    material: Material,
) -> Part:
    """A link with eyes: a hole about the origin, and one for a pin of a diameter at x = length [m].

    names  id and title      ends  names of both pins      section  width and thickness [m]
    """
    width, thickness = section
    inner = float(abs(hole.points[0]))
    eyes = [max(width / 2, radius * (1 + 2 * WALL)) for radius in (inner, pin / 2)]
    cut = (hole, circle(complex(length), pin / 2))
    shape = Prism(Profile(eyed_link(length, *eyes), cut), thickness)
    seats = {ends[0]: Seat(placement(), 2 * inner), ends[1]: Seat(placement(length), pin)}
    return Part(*names, "machined link", shape, material, seats=seats)

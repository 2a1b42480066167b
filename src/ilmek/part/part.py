"""Parts: kinds of things, made or bought, each with its shape and its seats; no position."""

import math
from collections.abc import Mapping
from dataclasses import field

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.class_masses import class_mass
from ilmek.elements.materials import Material
from ilmek.errors import ParameterError
from ilmek.part.moments import Moments
from ilmek.part.placement import Placement
from ilmek.part.shapes import Shape
from ilmek.records import record
from ilmek.report import Plate

PITCH, CUTTER, ZERO = "pitch curve", "cutter path", "zero"
"""Names of a cam's paths, of its roller and of the cutter, and of the mark of its angle 0."""

SET_SCREW, CLAMP = "set screw", "clamp"
"""Names of the seats of what holds a hub along its shaft: of a set screw, of a bush or rings that clamp it."""

WELDED, LASER_CUT = "welded frame", "laser-cut part"
"""Processes of stock that is welded to others, and of plates, which it is welded to."""


@record
class HolePattern:
    """The holes for screws of a bought part, about the middle of the face that it stands on or that carries others.

    across, along  distances of neighbouring holes [m]; 0: one row, at the middle      thread  by name
    in_rows  the row along the face is repeated over its length, of a rail; else there are two
    ring     so many evenly on the circle through the four; 0: the four
    tapped    they are threads; else holes for screws with their heads in the part
    faces     that have them, by z of their normals in the part's axes: its ends, -1 and 1, its sides, 0
    """

    across: float
    along: float
    thread: str
    in_rows: bool = False
    ring: int = 0
    tapped: bool = False
    faces: tuple[int, ...] = (-1, 1)

    @property
    def number(self) -> int:
        """Of the holes about the middle of a face."""
        return self.ring or math.prod(2 if apart else 1 for apart in (self.across, self.along))


@record
class Bought:
    """A bought part, by its row of a catalogue.

    row     of the catalogue, as ordered: `NEMA 34`        mass  of one [kg]; nan: that of its class [`class_masses`]
    data    what a buyer must know besides: flange, shaft, torque; default: the part's size
    length  of one [m], power  of one [W]: where the price depends on them
    drives  how many of them drive an axis of the control together; 0: it is no motor
    holes   for its screws      drilled  faces without holes have them where its seat is, by its maker, or slots
    housing  tolerance class of the bore in which its outer ring sits
    piece_of  id of the bought part that it is a length of, drawn apart: it is ordered with that; "": by itself
    hardness  least one of the shaft on which its rollers run [HRC]; 0: they run on a ring of its own
    """

    row: str
    mass: float = math.nan
    length: float = 0.0
    power: float = 0.0
    drives: int = 0
    data: str = ""
    holes: tuple[HolePattern, ...] = ()
    drilled: bool = False
    housing: str = "H7"
    hardness: int = 0
    piece_of: str = ""


@record
class Seat:
    """A place on a part where another part sits.

    position  its frame on the part, z along the axis of a bore, journal or screw, or normal to a face
    size   nominal: diameter of a bore or journal, width of a key [m]
    """

    position: Placement
    size: float


@record
class CamMaking:
    """How a disc cam is cut and checked.

    cutter, largest_cutter  radius that its path is for, and least hollow radius of the profile [m]; inf: convex
    tolerance  of its radii at each degree, ± [m]      increment  of their errors from one degree to the next, ± [m]
    spare      acceleration of the follower that these add at most [m/s²]
    speed      at which that is so [rad/s]; above 0 the cam turns counter-clockwise about z
    """

    cutter: float
    largest_cutter: float
    tolerance: float
    increment: float
    spare: float
    speed: float


@record
class Part:
    """A kind of thing: what it is, how it is made, of what, and where others sit on it.

    id       unique: machine and part, `tension-compensator/lever`         title   for people
    process  how it is made [`making`], or the kind by which it is bought      shape   in the part's own axes
    material  of a part that is made          purchase  of a bought one     seats   by name
    envelope  the shape is the room that the part takes: its form is not designed, or the maker's
    paths     closed curves of a flat part that guide a tool, not cut through      marks  lines to scribe, by name
    notes     what else the workshop must know: fits, a keyway's standard
    cam       how a disc cam is cut; None: it is none
    machined  its seats are machined after it is cut, sawn or welded: bores, threads, faces of guides, journals
    yarns     run on its edges, which are rounded and polished
    throat    of the weld that holds it, where strength sets it [m]; 0: by the wall
    joins     ids of the parts that a fastener holds together, or that a made part is welded to
    drawing   of a made part that is no flat plate, but drawn as one: a groove in a disc, a barrel laid flat
    fixing    by what it holds itself where it stands, with no screw, weld or fit of this tree; ""
    size      of a bought part, for people; default: the catalogue's row. That of a made one is its blank's [`blanks`]

    A made part has a shape and a material, and weighs what these say. A bought part weighs what its catalogue says.
    Raises ParameterError for a part that is both or neither.
    """

    id: str
    title: str
    process: str
    shape: Shape | None = None
    material: Material | None = None
    purchase: Bought | None = None
    seats: Mapping[str, Seat] = field(default_factory=dict)
    envelope: bool = False
    paths: Mapping[str, ComplexArray] = field(default_factory=dict)
    marks: Mapping[str, ComplexArray] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    drawing: Plate | None = None
    cam: CamMaking | None = None
    throat: float = 0.0
    machined: bool = False
    yarns: bool = False
    joins: tuple[str, ...] = ()
    fixing: str = ""
    size: str = ""

    def __post_init__(self) -> None:
        if (self.purchase is None) == (self.material is None):
            raise ParameterError(f"part {self.id} without one source", allowed="a material, or a purchase")
        if self.material is not None and self.shape is None:
            raise ParameterError(f"part {self.id} of {self.material.name} without a shape", do="give its shape")

    @property
    def moments(self) -> Moments | None:
        """Moments of its mass (kg, kg m, kg m²); None where it is not weighed.

        A bought part with an envelope has its mass spread over it, one without stands as a point at its origin.
        """
        if self.material is not None and self.shape is not None:
            return self.shape.moments * self.material.density
        assert self.purchase is not None
        mass = self.mass
        if math.isnan(mass):
            return None
        if self.shape is None:
            return Moments(mass, np.zeros(3), np.zeros((3, 3)))
        volume = self.shape.moments
        return volume * (mass / volume.zeroth)

    @property
    def designation(self) -> str:
        """As a bought part is ordered: its catalogue's row with its data; of a made one none."""
        if self.purchase is None:
            return ""
        row, data = self.purchase.row, self.purchase.data or self.size
        return row if data in row else data if row in data else f"{row}, {data}"

    @property
    def mass(self) -> float:
        """Mass of one [kg]: of a made part by its shape, of a bought one its catalogue's, else that of its class."""
        if self.material is not None and self.shape is not None:
            return self.shape.volume * self.material.density
        bought = self.purchase
        assert bought is not None
        return class_mass(self.process, bought.length, bought.power) if math.isnan(bought.mass) else bought.mass


def bought_part(
    name: str, title: str, process: str, shape: Shape, purchase: Bought, *, size: str = "", fixing: str = ""
) -> Part:
    """A bought part whose shape is the room that it takes: its form is the maker's, or not designed."""
    return Part(name, title, process, shape, purchase=purchase, envelope=True, fixing=fixing, size=size)

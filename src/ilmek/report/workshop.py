"""What a design sends to the workshop and to a controller: plates with their holes, and motions of an axis."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.records import record


@dataclass(frozen=True, slots=True)
class Hole:
    """A round hole of a plate: centre and radius [m], and what it is for."""

    at: complex
    radius: float
    label: str = ""


@record
class Contour:
    """A closed line of straight pieces and exact arcs [m]; `ilmek.plane.contours` reckons with it.

    points  corners and joints, counter-clockwise, the first not said again at the end
    bulges  of the piece from each point to the next: tan(sweep/4), above 0 where it turns left, 0 where it is straight
    """

    points: ComplexArray
    bulges: FloatArray


@record
class RoundSolid:
    """A solid of revolution about z with surfaces of a cam: a barrel with its groove, or an end cam [m].

    inner, outer  radii; inner 0: a full cylinder          low, high  its ends along the axis
    lower         points of the flank below the roller, (angles, radii, 3), once round, the last angle the first; the
                  radii reach beyond those of the solid where the flank cuts it
    upper         the same of the flank above it; None: an end cam, which ends at its lower flank
    bore          contour in the plane of revolution, cut through; None: none
    volume        [m^3], computed apart from the points
    """

    inner: float
    outer: float
    low: float
    high: float
    lower: FloatArray
    upper: FloatArray | None
    bore: Contour | None
    volume: float


@record
class WorkPiece:
    """A part that is turned, sawn or welded, for the workshop: a solid without a flat drawing.

    size    section and length, for people        number  pieces to be made
    shape   a shape of the package `part`         volume  of it, exact [m^3]
    part    of the package `part`, of which it is the view; None: of none        tree  in which it meets others
    features  what they must hold, where they are added
    """

    name: str
    title: str
    size: str
    material: str
    number: int
    shape: object
    volume: float
    part: object = None
    tree: object = None
    features: tuple[object, ...] = ()


@record
class Plate:
    """A flat part for the workshop, in its own frame [m].

    outline   the closed contour: exact, as a `Contour`; or points of it, counter-clockwise, the first not said again at
              the end, close enough that arcs can be laid through them (a curve: 720 a turn or more; corners and both
              ends of straight edges among them)
    holes     round holes             cutouts  closed contours inside the outline: a bore with its keyway, a groove
    paths     closed curves that guide a tool or an eye, not cut through, by name: `cutter path`, `pitch curve`
    marks     open lines, by name: `zero` to scribe at the angle 0, flanks and cutter path of a groove laid flat
    area      inside the outline [m^2], holes and cutouts not taken off, reckoned apart from the points; None: not known
    number    pieces to be made        notes  what else the workshop must know: fits, a keyway's standard
    solid     the part itself, where the outline is its development, or a groove is in it; None: the outline,
              `thickness` thick
    part      of the package `part`, of which it is the view; None: of none        tree  in which it meets others
    features  what they must hold, where they are added
    """

    name: str
    title: str
    outline: ComplexArray | Contour
    thickness: float
    material: str
    holes: tuple[Hole, ...] = ()
    cutouts: tuple[ComplexArray | Contour, ...] = ()
    paths: Mapping[str, ComplexArray | Contour] = field(default_factory=dict)
    marks: Mapping[str, ComplexArray] = field(default_factory=dict)
    area: float | None = None
    number: int = 1
    notes: tuple[str, ...] = ()
    solid: RoundSolid | WorkPiece | None = None
    part: object = None
    tree: object = None
    features: tuple[object, ...] = ()


@record
class CamTable:
    """A motion of a slave axis over one turn of the master, for a controller's electronic cam.

    motion    master angles [rad], of any shape, to the rows s, s', s'' by the master angle [SI, SI/rad, SI/rad^2]
    knots     master angles, ascending from 0 to 2 pi, between which the motion is smooth [rad]
    unit      the unit that a controller is given positions in
    period    time of a turn [s]      revolves  what the slave gains in a turn [SI]; 0: it returns
    """

    name: str
    title: str
    motion: Callable[[FloatArray], FloatArray]
    knots: FloatArray
    unit: str
    period: float
    revolves: float = 0.0

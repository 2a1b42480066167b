"""Sizes of a linkage's links and pins: pins by their forces, eyes by pin and bush.

A pin is a stud: its shank is pressed into the body of the lowest layer, its collar carries the next body, on its
journal the others turn in bushes or bearings, and a ring holds them. It bears as a cantilever, with the forces F of the
bodies in the middle of their bearing lengths at z:

    M(z0) = sum F (z - z0),   sigma = 32 M / (pi d³),   tau = 4 sum F / (pi d²),   p = F / (d l)      [pin_joints]

at the foot z0 of the journal (d) and of the collar (the shank's d). Without forces a pin has the diameter of the
standard sizes next below a third of the least width of its links, which is also the least with them.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from ilmek.dynamics.own_machine import FlatMember, OwnMachine, PinMember
from ilmek.elements.bearing_table import RollingBearing
from ilmek.elements.bearings import ROLLING_BEARINGS, find_bearing
from ilmek.elements.hubs import bore_for, hub_for
from ilmek.elements.linear_guides import LINEAR_GUIDES, LinearGuide
from ilmek.elements.machine_screws import SOCKET_SCREWS
from ilmek.elements.pin_joints import PIN_DIAMETERS, mean_pressure, pin_bending, pin_shear
from ilmek.elements.plates import PIN_SHARE
from ilmek.elements.retaining_rings import RETAINING_RINGS, RetainingRing, retaining_ring
from ilmek.linkage.model import GROUND, Mechanism
from ilmek.machines.own_linkage.axes import JointLoads, PinAxis, SlideLine
from ilmek.records import record
from ilmek.units import mm, um

WIDTH_SHARE, SLENDER, WIDE = 0.2, 6 * mm, 40 * mm
"""Width of a link that is not given: a fifth of the shortest one, within these bounds; assumed by this project."""

THICKNESS_SHARE, THIN = 1 / 3, 3 * mm
"""Thickness of a link that is not given, over its width, and at least."""

MATERIAL = "structural steel"
"""Of a link that is not given."""

DIAMETERS = (3 * mm, 4 * mm, 5 * mm, *(size for size in PIN_DIAMETERS if size <= 100 * mm))
"""Diameters of pins: those that have rings."""

EYE_SHARE, LEAST_EYE = 0.25, 1.5 * mm
"""Wall of an eye over its bore, and at least; assumed by this project."""

SHOULDER_SHARE, LEAST_SHOULDER = 0.1, 1 * mm
"""Height of a collar over its pin's diameter, and at least; assumed by this project."""

WALLS = ((18 * mm, 1 * mm), (28 * mm, 1.5 * mm), (48 * mm, 2 * mm), (100 * mm, 2.5 * mm))
"""Wall of a bush up to an inner diameter: ISO 4379, series 1."""

KEYED = 6 * mm
"""Diameter up to which a driven shaft is pressed into its link: DIN 6885 has no key."""

BUSHED = 10 * mm
"""Diameter below which a driven shaft runs in bushes: there are no bearings of the table."""

BESIDE = 0.5 * mm
"""Between the head of a carriage's screw and the bore of a pin, at least [m]; assumed by this project."""

SCREWED = 8.0
"""Length of such a plate for its own screws on both sides of the bore, over their diameter; assumed by this project."""

SAFE_LOAD = 2.0
"""Static load rating of a carriage over its load; makers ask for 1.5 to 3."""


@record
class StudSize:
    """Sizes of the pin or shaft of an axis [m].

    journal, shank  diameters on which bodies turn, and in the body that it is fixed in
    bearing         of the bodies that turn on it; None: bushes
    lengths         body -> length of its bush or bearing
    member          what the pin is allowed to bear      given  its diameter is given, not chosen
    """

    axis: PinAxis
    journal: float
    shank: float
    bearing: RollingBearing | None
    lengths: Mapping[str, float]
    member: PinMember
    given: bool = False

    @property
    def ring(self) -> RetainingRing:
        """The ring at the end of its journal."""
        return retaining_ring(self.journal)

    @property
    def outer(self) -> float:
        """Outer diameter of the bushes or bearings on it."""
        return self.bearing.outer if self.bearing else self.journal + 2 * bush_wall(self.journal)

    @property
    def collar(self) -> float:
        """Diameter of its collar, and of its spacers."""
        thick = max(self.journal, self.shank)
        return thick + 2 * max(SHOULDER_SHARE * thick, LEAST_SHOULDER)

    def bore(self, *, keyed: bool) -> float:
        """Greatest distance of the edge of a driven link's bore from its axis."""
        return hub_for(self.journal).reach if keyed else self.shank / 2

    def eye(self, body: str, *, keyed: bool) -> float:
        """Radius of a body's eye: a wall about its hole."""
        hole = self.hole(body, keyed=keyed)
        return hole + max(2 * EYE_SHARE * hole, LEAST_EYE)

    def hole(self, body: str, *, keyed: bool) -> float:
        """Greatest distance of the edge of a body's bore from its axis: for the bush, the shank, or the keyed shaft."""
        return self.bore(keyed=keyed) if body == self.axis.driven else max(self.outer, self.shank) / 2


def bush_wall(diameter: float) -> float:
    """Wall of a bush for a pin of a diameter [m]."""
    return next((wall for upto, wall in WALLS if diameter <= upto), WALLS[-1][1])


def link_members(machine: OwnMachine) -> dict[str, FlatMember]:
    """Section of each moving body's plate: its own, else one by the shortest link."""
    mechanism, given = machine.mechanism, machine.members
    spans = [abs(b - a) for body in mechanism.bodies for a, b in pairwise(_joined(mechanism, body.name)) if b != a]
    width = min(max(WIDTH_SHARE * min(spans, default=WIDE), SLENDER), WIDE)
    thickness = max(THICKNESS_SHARE * width, THIN)
    like = next(iter(given.values()), None) or FlatMember(width, thickness, MATERIAL)
    return {body: given.get(body, like) for body in mechanism.moving}


def _joined(mechanism: Mechanism, body: str) -> list[complex]:
    return [mechanism.point(body, joint.name) for joint in mechanism.joints if body in joint.bodies]


def first_studs(
    machine: OwnMachine, axes: Sequence[PinAxis], members: Mapping[str, FlatMember], loads: JointLoads
) -> dict[str, StudSize]:
    """Pins and shafts by the names of their axes, without regard to the layers of their bodies yet."""
    return {axis.name: _first_stud(machine, axis, members, loads) for axis in axes}


def _first_stud(machine: OwnMachine, axis: PinAxis, members: Mapping[str, FlatMember], loads: JointLoads) -> StudSize:
    given = next((machine.pins[name] for name in axis.joints if name in machine.pins), None)
    moving = [body for body in axis.points if body != GROUND]
    thick = {body: members[body].thickness for body in moving}
    width = min(members[body].width for body in moving)
    default = usual_diameter(width)
    if axis.driven:
        return _shaft(axis, given, default, thick, loads)
    bearing = find_bearing(given.bearing) if given is not None and given.bearing else None
    long = bearing.width if bearing else given.length if given is not None else 0.0
    lengths = {body: bearing.width if bearing else max(size, long) for body, size in thick.items()}
    if given is not None:
        return StudSize(axis, given.diameter, given.diameter, bearing, lengths, given, given=True)
    stud = StudSize(axis, default, default, None, lengths, PinMember(default, max(lengths.values())))
    force = loads.pins.get(axis.name, {})
    while stud.journal < DIAMETERS[-1] and any(
        mean_pressure(force.get(body, 0.0), stud.journal, long) > stud.member.pressure for body, long in lengths.items()
    ):
        stud = thicker(stud, journal=True)
    return stud


def usual_diameter(width: float) -> float:
    """The diameter next below a third of a link's width [m], of a pin or a hole without a force.

    >>> usual_diameter(0.025), usual_diameter(0.001)
    (0.008, 0.003)
    """
    return max((size for size in DIAMETERS if size <= PIN_SHARE * width * (1 + 1e-9)), default=DIAMETERS[0])


def _shaft(
    axis: PinAxis, given: PinMember | None, default: float, thick: Mapping[str, float], loads: JointLoads
) -> StudSize:
    """A driven shaft: as thick as its torque and its bearings ask for; the diameter that is given, or the next."""
    least = given.diameter if given is not None else max(default, bore_for(loads.torques.get(axis.driven, 0.0)))
    size = next(shaft for shaft in SHAFTS if shaft >= least * (1 - 1e-9) or shaft == SHAFTS[-1])
    member = given or PinMember(size, max(thick.values()))
    return StudSize(axis, size, size, None, dict(thick), member, given=given is not None)


def shaft_bearing(diameter: float) -> RollingBearing | None:
    """The bearing of a driven shaft of a diameter [m]; None: it runs in bushes."""
    rows = (row for row in ROLLING_BEARINGS.values() if abs(row.bore - diameter) < 1e-9)
    return None if diameter < BUSHED - 1e-9 else next(rows, None)


SHAFTS = (
    *(size for size in DIAMETERS if size < BUSHED - 1e-9),
    *(
        ring.shaft
        for ring in RETAINING_RINGS
        if any(abs(row.bore - ring.shaft) < 1e-9 for row in ROLLING_BEARINGS.values())
    ),
)
"""Diameters of driven shafts: those of bearings and rings."""


def thicker(stud: StudSize, *, journal: bool) -> StudSize:
    """The pin with the next thicker journal, or shank; the shank is never thinner."""
    sizes = SHAFTS if stud.axis.driven else DIAMETERS
    old = stud.journal if journal else stud.shank
    new = next((size for size in sizes if size > old + 1e-9), sizes[-1])
    thick = new if journal else stud.journal
    shank = new if stud.axis.driven or not journal else max(stud.shank, new)
    return replace(stud, journal=thick, shank=shank)


def guide_for(line: SlideLine, member: FlatMember, loads: JointLoads, studs: Iterable[StudSize]) -> LinearGuide:
    """The guide of a slide: the smallest that bears twice its force, with a carriage as wide as half the link, and its
    screws' heads beside the bore of a pin over it; where none has these, the smallest with a plate between.
    """
    force, _ = loads.slides.get(line.name, (0.0, 0.0))
    strong = [row for row in LINEAR_GUIDES if row.static >= SAFE_LOAD * force and row.block >= member.width / 2]
    over = tuple(studs)
    beside = (row for row in strong if not riser_size(line, row, over)[1])
    return next(beside, (strong or LINEAR_GUIDES[-1:])[0])


def riser_size(line: SlideLine, row: LinearGuide, studs: Iterable[StudSize]) -> tuple[float, float]:
    """Length along the line and least height of the plate between a carriage and its link [m]: as long as the carriage,
    and none; where the bore of a pin leaves the carriage's screws no room in the link, with room for its own beside it.
    """
    over = (stud for stud in studs if abs(stud.axis.points.get(line.body, math.inf) - line.at) < um)
    bore = max((max(stud.outer, stud.shank) + 2 * BESIDE for stud in over), default=0.0)
    screw = SOCKET_SCREWS[row.block_screw]
    if abs(complex(*row.holes)) > bore + screw.sink:
        return row.block_length, 0.0
    return max(row.block_length, bore + SCREWED * screw.diameter), screw.head + screw.diameter


@record
class StudStress:
    """What a pin bears: bending, shear and pressure [Pa]."""

    bending: float
    shear: float
    pressure: float


def journal_stress(stud: StudSize, arms: Mapping[str, float], forces: Mapping[str, float]) -> StudStress:
    """Stress at the foot of the journal; arms  of the bodies on it from there [m], forces  of each [N]."""
    pressed = max((mean_pressure(forces[body], stud.journal, stud.lengths[body]) for body in arms), default=0.0)
    return _stress(stud.journal, arms, forces, pressed)


def shank_stress(stud: StudSize, arms: Mapping[str, float], forces: Mapping[str, float]) -> StudStress:
    """Stress at the foot of the collar, arms from there."""
    return _stress(stud.shank, arms, forces, 0.0)


def _stress(diameter: float, arms: Mapping[str, float], forces: Mapping[str, float], pressed: float) -> StudStress:
    moment = sum(forces[body] * arm for body, arm in arms.items())
    total = sum(forces[body] for body in arms)
    # A fork's pin has the moment F (l + 2 g) / 8: that of a force over l = 8, g = 0.
    return StudStress(pin_bending(moment, diameter, 8.0, 0.0), pin_shear(total, diameter, fork=False), pressed)

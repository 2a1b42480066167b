"""Couplings: gears, belts, racks, cams and Geneva wheels between two bodies of a mechanism."""

from dataclasses import dataclass
from typing import Protocol

from ilmek.arguments import Arguments
from ilmek.arrays import RealField
from ilmek.errors import MechanismError
from ilmek.linkage.joints import GROUND, NamedPoint, about, set_points, set_texts
from ilmek.plane.teeth import PRESSURE_ANGLE
from ilmek.units import deg

KINDS = ("gears", "belt", "rack", "cam", "geneva")
"""Kinds of couplings."""

GREATEST_PRESSURE_ANGLE = 45 * deg
"""Greatest pressure angle of a coupling [rad]; teeth have 14.5° to 30°."""


class TransferLaw(Protocol):
    """A law q_2 = f(q_1) of a higher pair, periodic in q_1 but for a constant; `geneva.Geneva`, the lift of a cam."""

    @property
    def slides(self) -> bool:
        """Whether q_2 is a displacement [m], not an angle."""

    @property
    def turns(self) -> int:
        """Turns of q_1 after which the second body is as before."""

    @property
    def one_sided(self) -> bool:
        """Whether the first body can only press on the second."""

    def motion(self, angle: RealField, /) -> tuple[RealField, RealField, RealField, RealField]:
        """F and its first three derivatives at angles [rad]."""


@dataclass(frozen=True, slots=True)
class BeltSpans:
    """The spans of a belt or chain between its pulleys, whose forces load their bearings.

    radius      r_1 of the first pulley [m]; r_2 = r_1 / |ratio|
    pretension  T_0 of each span at rest [N]; 0: a chain, whose slack span has no force
    friction    mu of a flat belt on its pulleys; None: teeth, which do not slip

    >>> BeltSpans("40mm", pretension="300N", friction=0.3).radius
    0.04
    """

    radius: float
    pretension: float = 0.0
    friction: float | None = None

    def __post_init__(self) -> None:
        given = Arguments("a belt", MechanismError)
        object.__setattr__(self, "radius", given.not_negative("radius", self.radius, "m"))
        if not self.radius:
            raise MechanismError("the radius of a pulley is 0", allowed="above 0")
        object.__setattr__(self, "pretension", given.not_negative("pretension", self.pretension, "N"))
        if self.friction is not None:
            object.__setattr__(self, "friction", given.not_negative("friction", self.friction, ""))

    def lean(self, ratio: float, distance: RealField) -> RealField:
        """Sin alpha = (r_1 -+ r_2) / a: of the spans against the line of centres, at a distance a of these [m]."""
        return self.radius * (1 - 1 / ratio) / distance


@dataclass(frozen=True, slots=True)
class Coupling:
    """A fixed relation of the motions of two bodies on one carrier: gears, belt or chain, rack, cam, Geneva wheel.

        q_second - second_at = ratio (q_first - first_at),   or  = f(q_first - first_at) by a law

    kind     "gears", "belt", "rack", "cam" or "geneva"
    first    point of a body in the middle of the wheel, "body.point"; q is its angle against the carrier [rad]
    second   the same of the other wheel; for a rack the sliding body and its slide, q the slide's displacement s [m]
    ratio    gears outside one another -z1/z2, one inside the other z1/z2; an open belt r1/r2, a crossed one -r1/r2;
             rack: travel per radian of the pinion [m/rad], the signed pitch radius
    first_at, second_at   both q in the assembled position: the mesh is given, never assumed
    carrier  the body that carries both wheels; it may move (planetary gears); for a rack the slide's guide
    pressure_angle   of gears and racks: of their teeth at the pitch point [rad]; a belt has none
    law      f of a cam or Geneva wheel, in place of the ratio; the angle of a Geneva crank from the line of its centres
    spans    of a belt or chain; None: the forces that depend on its tension are open
    roller   point of a cam's follower in the middle of its roller; "": a flat face square to its slide

    Angles determined by inputs and ratios alone count full turns. Any other angle of `first` (or `second`) is assumed
    to be within half a turn of `first_at` (`second_at`).

    >>> Coupling("mesh", "gears", "pinion.P0", "wheel.W0", ratio=-20 / 60, first_at=0, second_at=0).bodies
    ('pinion', 'wheel', 'ground')
    """

    name: str
    kind: str
    first: NamedPoint
    second: NamedPoint
    ratio: float
    first_at: float
    second_at: float
    carrier: str = GROUND
    pressure_angle: float = PRESSURE_ANGLE
    law: TransferLaw | None = None
    roller: str = ""
    spans: BeltSpans | None = None

    def __post_init__(self) -> None:
        set_texts(self, "name", "kind", "carrier", "roller")
        given = Arguments(f"coupling {self.name!r}", MechanismError)
        rack = self.slides
        with about("couplings", self.name):
            set_points(self, "first", "second")
            units = {"ratio": "m" if rack else "", "first_at": "rad", "second_at": "m" if rack else "rad"}
            units["pressure_angle"] = "rad"
            for name, unit in units.items():
                object.__setattr__(self, name, given.number(name, getattr(self, name), unit))

    @property
    def bodies(self) -> tuple[str, str, str]:
        """First, second, carrier."""
        return self.first[0], self.second[0], self.carrier

    @property
    def ends(self) -> tuple[tuple[str, str], tuple[str, str]]:
        """Body and point of `first` and of `second`."""
        return self.first, self.second  # type: ignore[return-value]  # texts became pairs when it was made

    @property
    def slides(self) -> bool:
        """Whether the second body slides."""
        return self.kind == "rack" if self.law is None else self.law.slides

    def transfer(self, turned: RealField) -> tuple[RealField, RealField, RealField, RealField]:
        """q_second - second_at and its derivatives by q_first, at q_first - first_at [rad]."""
        if self.law is not None:
            return self.law.motion(turned)
        return self.ratio * turned, self.ratio, 0.0, 0.0

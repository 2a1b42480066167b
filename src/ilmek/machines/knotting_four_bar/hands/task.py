"""The task of hands that tie: knot, cloth, finger, room, and the limits of the search."""

from dataclasses import dataclass
from functools import partial

from ilmek.errors import ParameterError
from ilmek.params import Params, kind, nested
from ilmek.units import deg, format_quantity, mm
from ilmek.weaving.cloth import Cloth
from ilmek.weaving.knots.word import Knot, knot

NO_KNOT = "none"

KNOTS = {
    "turkish": ("symmetric", "left", 1),
    "persian-left": ("asymmetric", "left", 1),
    "persian-right": ("asymmetric", "right", 1),
    "jufti": ("symmetric", "left", 2),
}
"""Kind, open side, and warps on each side of each knot that hands can be searched for."""

_size = partial(kind.length, at_least=0.05 * mm, at_most=0.5)


@dataclass(frozen=True, slots=True)
class HandsTask(Params):
    """What a pair of hands has to tie, and within what."""

    knot: str = kind.choice(NO_KNOT, (NO_KNOT, *KNOTS), doc="knot to tie; none: no hands are searched")
    cloth: Cloth = nested(Cloth, doc="warps and pile yarn")
    finger_thickness: float = _size(0.5 * mm, doc="of the finger, a blade bent to an arc, across its plane")
    finger_width: float = _size(1.8 * mm, doc="of the finger, in its plane")
    clearance: float = kind.length(
        0.1 * mm, at_least=0.0, at_most=10 * mm, doc="least distance of the fingers from warps, and from each other"
    )
    standoff: float = _size(8 * mm, doc="height over the warps that all but the fingers leave free, as for pile")
    room_length: float = _size(150 * mm, doc="room of the hands in their plane, along the warps")
    room_height: float = _size(80 * mm, doc="room of the hands over the warps")
    inclination: float | None = kind.angle(
        None,
        at_least=0.0,
        at_most=88 * deg,
        doc="of the plane of the hands from the section across the warps; default: the least of the search that does",
        symbol="β",
    )
    transmission_limit: float = kind.angle(40 * deg, above=0.0, at_most=80 * deg, doc="least transmission angle")
    swing_limit: float = kind.angle(150 * deg, above=0.0, at_most=300 * deg, doc="greatest swing of a crank")
    stroke_time: float = kind.time(
        0.4, at_least=0.01, at_most=60.0, doc="time of a stroke of the fingers behind the warps"
    )
    yarn_pull: float = kind.force(0.5, at_least=0.0, at_most=1e3, doc="force of the yarn against the finger's tip")
    gravity: float = kind.acceleration(9.81, at_least=0.0, at_most=1e3, doc="gravity, along the warps")
    servo_mass: float = kind.mass(0.06, unit="g", above=0.0, at_most=1.0, doc="heaviest servo that is chosen")
    tried: int = kind.count(4000, at_least=200, at_most=100_000, doc="four-bars that are tried at each inclination")

    def check_together(self) -> None:
        """Raise ParameterError that names all limits that contradict each other."""
        if self.knot == NO_KNOT:
            return
        refused = [f"{given} ({allowed})" for given, allowed, holds in self._conditions() if not holds]
        if refused:
            raise ParameterError(
                "no hands for " + "; ".join(refused),
                do="set a wider task.cloth.warp_pitch, finer yarns or a finer finger, or more room",
            )

    def _conditions(self) -> tuple[tuple[str, str, bool], ...]:
        """What is given, what is allowed, and whether it holds."""
        shown = partial(format_quantity, unit="mm", digits=3)
        pitch, gap = self.cloth.warp_pitch, self.cloth.warp_pitch - self.warp
        needs = self.finger_thickness + 2 * self.clearance
        least_height = self.standoff + LEAST_HEIGHT
        return (
            (f"warps {shown(pitch)} apart", f"more than the yarn, {shown(self.yarn)}", pitch > self.yarn),
            (f"a gap of {shown(gap)} between warps", f"{shown(needs)} for a finger with its clearance", gap >= needs),
            (
                f"fingers {shown(self.finger_width)} wide",
                f"not less than thick, {shown(self.finger_thickness)}",
                self.finger_width >= self.finger_thickness,
            ),
            (
                f"room {shown(self.room_height)} high",
                f"{shown(least_height)} or more over a standoff of {shown(self.standoff)}",
                self.room_height >= least_height,
            ),
        )

    @property
    def warp(self) -> float:
        """Diameter of a warp [m]."""
        return self.cloth.carpet_yarns.warp.diameter

    @property
    def yarn(self) -> float:
        """Diameter of the pile yarn [m]."""
        return self.cloth.carpet_yarns.pile.diameter

    @property
    def each(self) -> int:
        """Warps on each side of the knot's middle."""
        return KNOTS[self.knot][2]

    @property
    def front(self) -> float:
        """Height over the warps' axes at which the fingers' tips begin and end: clear of the yarn in front [m]."""
        return self.warp / 2 + self.yarn + self.finger_width / 2 + self.clearance

    def knot_after(self, warps: int) -> Knot:
        """The knot, with a number of warps left of it."""
        name, opens, each = KNOTS[self.knot]
        return knot(name, warps + 1, opens=opens, each=each)


LEAST_HEIGHT = 30 * mm
"""Height over the standoff in which hands can swing at all: two links of the least length, with their eyes [m]."""

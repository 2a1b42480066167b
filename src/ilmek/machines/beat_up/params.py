"""Parameters of a beat-up mechanism."""

import difflib
import math
from dataclasses import dataclass, replace
from typing import Any

from ilmek.elements.carpet_yarns import CarpetYarnParams
from ilmek.elements.materials import Material
from ilmek.errors import ParameterError
from ilmek.machines.beat_up.hand import HAND, hand_positions, hand_swing
from ilmek.machines.beat_up.use_params import CastLinkParams, CrankStartParams, TravelParams
from ilmek.machines.strength_params import StrengthParams
from ilmek.params import Params, kind, nested
from ilmek.units import deg, format_quantity, turn
from ilmek.weaving.cloth import Cloth

SMALL, LARGE = 1e-4, 1e2
"""Plausible range of lengths [m]."""

BEATER_RATIO = 1.3
"""Beater over rocker, AE / AB: 0.3001 m / 0.2308 m; inferred from the paper, which prints AE only."""

LINK_MASSES = ("made", "bars")

OBJECTIVES = {
    "force_at_beat": ("force_at_beat", +1),
    "transmission_angle": ("transmission_angle_min", +1),
    "ratio": ("crank_coupler_ratio", +1),
    "link_ratio": ("link_ratio", -1),
    "size": ("size", -1),
    "acceleration": ("beater_acceleration_max", -1),
    "rocker_acceleration": ("rocker_acceleration_max", -1),
    "drive_torque": ("drive_torque_max", -1),
    "joint_force": ("joint_force_max", -1),
}
"""Objectives: the quantity of a member, and whether the greatest (+1) or the least (-1) is best."""

LIMITS = {
    "ratio_min": ("crank_coupler_ratio", +1, "1"),
    "ratio_max": ("crank_coupler_ratio", -1, "1"),
    "transmission_min": ("transmission_angle_min", +1, "deg"),
    "link_ratio_max": ("link_ratio", -1, "1"),
    "size_max": ("size", -1, "mm"),
    "acceleration_max": ("beater_acceleration_max", -1, "m/s^2"),
    "rocker_acceleration_max": ("rocker_acceleration_max", -1, "rad/s^2"),
    "force_at_beat_min": ("force_at_beat", +1, "N"),
    "torque_max": ("drive_torque_max", -1, "N*m"),
    "joint_force_max": ("joint_force_max", -1, "N"),
}
"""Limits: the quantity of a member, whether it must be at least (+1) or at most (-1) that, its unit."""

THESIS_CLOTH = Cloth(yarns=CarpetYarnParams(warp_stiffness=1350.0))
"""The thesis' warps, by which the fell resists where no loom gives them."""

CHOOSING = ("objective", *LIMITS)
"""Parameters by which the member is chosen."""


def _length(default: float | None, doc: str, symbol: str = "") -> Any:
    return kind.length(default, at_least=SMALL, at_most=LARGE, doc=doc, symbol=symbol)


@dataclass(frozen=True, slots=True)
class BeatUpParams(Params):
    """A beat-up mechanism, its masses and its run, or limits by which it is chosen; the defaults are the paper's."""

    hand: str = kind.text(
        HAND, doc="first, second and final position of the weaver's hand, which the beater follows: (x,y) (x,y) (x,y)"
    )
    swing: float | None = kind.angle(
        None,
        above=0.0,
        below=math.pi,
        doc="swing of the rocker between its dead centres; default: about the centre of the hand's positions, 30 deg",
        symbol="ψ",
    )
    crank_rotation: float = kind.angle(
        180 * deg,
        above=math.pi / 2,
        below=2 * math.pi,
        doc="rotation of the crank from the beat to the other dead centre; 180 deg has the best transmission angle",
        symbol="φ",
    )
    beta: float | None = kind.angle(
        None,
        above=0.0,
        below=math.pi,
        doc="crank angle of the beat; default: chosen by transmission angle and crank/coupler ratio",
        symbol="β",
    )
    ground: float = _length(0.3, "distance of the pivots of crank and rocker", "AD")
    crank: float | None = _length(None, "length of the crank; default: by synthesis", "DC")
    coupler: float | None = _length(None, "length of the coupler; default: by synthesis", "CB")
    rocker: float | None = _length(None, "length of the rocker; default: by synthesis", "AB")
    beater: float | None = _length(None, "beater from the rocker's pivot; default: 1.3 times the rocker", "AE")
    speed: float = kind.angular_speed(15.5, unit="rad/s", above=0.0, at_most=1e4, doc="speed of the crank", symbol="ω")
    beater_mass: float = kind.mass(2.5, at_least=0.0, at_most=1e5, doc="mass of the beater", symbol="m_E")
    link_mass: str = kind.choice(
        "made",
        LINK_MASSES,
        doc="mass of the links: as made, with round ends, holes and pins, or of bars from pin to pin, as in the paper",
    )
    density: float | None = kind.density(
        None, above=0.0, at_most=1e5, doc="density of the links; default: of strength.material", symbol="ρ"
    )
    width: float = _length(0.03, "width of the links, in the plane of motion", "w")
    thickness: float = _length(0.01, "thickness of the links")
    gravity: float = kind.acceleration(
        0.0, at_least=0.0, at_most=1e3, doc="acceleration of gravity; the paper leaves weight out", symbol="g"
    )
    gravity_direction: float = kind.angle(
        -90 * deg,
        at_least=-turn,
        at_most=turn,
        doc="direction of the weight, from the ground line D-A counter-clockwise; it turns with the loom",
    )
    beat_force: float = kind.force(60.0, at_least=0.0, at_most=1e6, doc="required peak force on the beater")
    balance_share: float = kind.ratio(
        1.0,
        at_least=0.0,
        at_most=2.0,
        doc="share of the shaking force's first harmonic, the part that turns with the crank, that a counterweight on "
        "it cancels",
    )
    counterweight_radius: float | None = _length(
        None, "distance of the counterweight's mass centre from the pivot; default: the crank"
    )
    fluctuation: float = kind.ratio(
        0.05, at_least=1e-4, at_most=1.0, doc="allowed fluctuation of the speed, kept by the flywheel", symbol="δ"
    )
    flywheel: float | None = kind.inertia(
        None,
        at_least=0.0,
        at_most=1e6,
        doc="moment of inertia of flywheel and rotor on the crank; default: what the fluctuation needs",
    )
    motor_torque: float | None = kind.torque(
        None,
        at_least=1e-6,
        at_most=1e9,
        doc="greatest torque of the motor on the crank; default: the greatest that the constant speed needs",
    )
    slip: float = kind.ratio(0.1, at_least=1e-3, at_most=1.0, doc="loss of speed at which the motor gives its torque")
    crank_angle: float | None = kind.angle(
        None, at_least=-2 * turn, at_most=2 * turn, doc="crank angle at which to report forces", symbol="θ"
    )
    objective: str | None = kind.choice(
        None,
        tuple(OBJECTIVES),
        doc="what is best among the crank-rockers within the limits; default, where a limit is given: force_at_beat",
    )
    ratio_min: float | None = kind.ratio(None, above=0.0, at_most=1.0, doc="limit: crank/coupler ratio, r/l")
    ratio_max: float | None = kind.ratio(None, above=0.0, at_most=1.0, doc="limit: crank/coupler ratio, r/l")
    transmission_min: float | None = kind.angle(
        None, above=0.0, below=math.pi / 2, doc="limit: least acute transmission angle over a turn"
    )
    link_ratio_max: float | None = kind.ratio(
        None, at_least=1.0, at_most=1e6, doc="limit: longest link over the shortest"
    )
    size_max: float | None = _length(None, "limit: overall size, the greatest distance of points that it reaches")
    acceleration_max: float | None = kind.acceleration(
        None, above=0.0, at_most=1e9, doc="limit: greatest acceleration of the beater, at the speed"
    )
    rocker_acceleration_max: float | None = kind.angular_acceleration(
        None, above=0.0, at_most=1e9, doc="limit: greatest angular acceleration of the rocker"
    )
    force_at_beat_min: float | None = kind.force(
        None, above=0.0, at_most=1e9, doc="limit: force on the beater at the beat itself"
    )
    torque_max: float | None = kind.torque(None, above=0.0, at_most=1e9, doc="limit: greatest drive torque")
    joint_force_max: float | None = kind.force(None, above=0.0, at_most=1e9, doc="limit: greatest force in any pin")
    front: str = kind.text(
        "transmission_angle force_at_beat drive_torque",
        doc=f"objectives of the Pareto front, two or more of: {' '.join(OBJECTIVES)}",
    )
    members: int = kind.count(500, at_least=10, at_most=10_000, doc="crank-rockers of the family that are compared")
    interval: float | None = kind.time(
        None, above=0.0, at_most=1e6, doc="time from the start of a beat to that of the next; default: no rest between"
    )
    strength: StrengthParams = nested(CastLinkParams, doc="material of the links, and what they and their pins bear")
    start: CrankStartParams = nested(CrankStartParams, doc="start and stop of the crank")
    cloth: Cloth = nested(Cloth, default=THESIS_CLOTH, doc="the warps whose rows are beaten")
    travel: TravelParams = nested(TravelParams, doc="the slide along the carpet")

    def check_together(self) -> None:
        """Crank, coupler and rocker together or not at all; limits only where there is something to choose."""
        links = ("crank", "coupler", "rocker")
        given = [name for name in links if getattr(self, name) is not None]
        if 0 < len(given) < len(links):
            missing = [name for name in links if name not in given]
            do = "give crank, coupler and rocker, or none of them"
            raise ParameterError(f"{' and '.join(given)} given without {' and '.join(missing)}", do=do)
        front_objectives(self.front)
        if not 0 < self.rocker_swing < math.pi:
            raise ParameterError(
                f"the hand's positions give a swing of {format_quantity(self.rocker_swing, 'deg')}",
                allowed="above 0 and below 180 deg",
                do="set other positions of the hand, or swing",
            )
        choosing = [name for name in CHOOSING if getattr(self, name) is not None]
        if choosing and (given or self.beta is not None):
            fixed = "beta" if self.beta is not None else "crank, coupler and rocker"
            raise ParameterError(
                f"{choosing[0]} given with {fixed}",
                allowed=f"with {fixed} nothing is left to choose",
                do=f"leave out {fixed}, or {' and '.join(choosing)}",
            )

    @property
    def rocker_swing(self) -> float:
        """Swing of the rocker [rad]: as given, or about the centre of the hand's positions."""
        return self.swing or hand_swing(*hand_positions(self.hand))

    @property
    def before_beater(self) -> float:
        """From the beater's edge to the middle of the round end of the rocker, which ends where the bar begins [m]."""
        return self.travel.bar_distance + self.width / 2

    @property
    def link_material(self) -> Material:
        """Material of the links, with the given density."""
        material = self.strength.of_links
        return material if self.density is None else replace(material, density=self.density)

    @property
    def gravity_vector(self) -> complex:
        """Acceleration of gravity [m/s²] in the frame of the ground line."""
        return self.gravity * complex(math.cos(self.gravity_direction), math.sin(self.gravity_direction))


def front_objectives(text: str) -> tuple[str, ...]:
    """Names of `OBJECTIVES` with blanks or commas between, as `front` lists them.

    Raises ParameterError for an unknown or repeated name, and for fewer than two.
    """
    names = tuple(text.replace(",", " ").split())
    for name in names:
        if name not in OBJECTIVES:
            near = difflib.get_close_matches(name, OBJECTIVES, n=1)
            hint = f"did you mean {near[0]}?" if near else ""
            raise ParameterError(f"front={text!r}: {name!r} is unknown", allowed=f"of {' '.join(OBJECTIVES)}", do=hint)
    if len(set(names)) < max(2, len(names)):
        given, do = f"front={text!r} does not name two different objectives", "name the objectives of the front"
        raise ParameterError(given, allowed=f"two or more different ones of {' '.join(OBJECTIVES)}", do=do)
    return names

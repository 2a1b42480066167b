"""What may be asked of a beat-up mechanism."""

import difflib
import math
from dataclasses import dataclass

from ilmek.errors import ParameterError
from ilmek.params import Params, param
from ilmek.units import deg, turn

SMALL, LARGE = 1e-4, 1e2
"""Lengths that are taken for meant [m]."""

BEATER_RATIO = 1.3
"""Beater over rocker, AE / AB: 0.3001 m / 0.2308 m; inferred from the paper, which prints AE only."""


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
"""What may be sought: the quantity of a member, and whether the greatest (+1) or the least (-1) is best."""

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
"""What may be limited: the quantity of a member, whether it must be at least (+1) or at most (-1) that, its unit."""

CHOOSING = ("objective", *LIMITS)
"""Parameters by which the member is chosen."""


@dataclass(frozen=True, slots=True)
class BeatUpParams(Params):
    """A beat-up mechanism, its masses and its run, or limits by which it is chosen; the defaults are the paper's."""

    swing: float = param(
        30 * deg, unit="deg", above=0.0, below=math.pi, doc="swing of the rocker between its dead centres", symbol="ψ"
    )
    crank_rotation: float = param(
        180 * deg,
        unit="deg",
        above=math.pi / 2,
        below=2 * math.pi,
        doc="turn of the crank from the beat to the other dead centre; 180 deg has the best transmission angle",
        symbol="φ",
    )
    beta: float | None = param(
        None,
        unit="deg",
        above=0.0,
        below=math.pi,
        doc="crank angle of the beat; unsaid: chosen by transmission angle and crank/coupler ratio",
        symbol="β",
    )
    ground: float = param(
        0.3, unit="mm", at_least=SMALL, at_most=LARGE, doc="distance of the pivots of crank and rocker", symbol="AD"
    )
    crank: float | None = param(
        None, unit="mm", at_least=SMALL, at_most=LARGE, doc="crank outright, instead of synthesis", symbol="DC"
    )
    coupler: float | None = param(
        None, unit="mm", at_least=SMALL, at_most=LARGE, doc="coupler outright, instead of synthesis", symbol="CB"
    )
    rocker: float | None = param(
        None, unit="mm", at_least=SMALL, at_most=LARGE, doc="rocker outright, instead of synthesis", symbol="AB"
    )
    beater: float | None = param(
        None,
        unit="mm",
        at_least=SMALL,
        at_most=LARGE,
        doc="beater from the rocker's pivot; unsaid: 1.3 times the rocker",
        symbol="AE",
    )
    speed: float = param(15.5, unit="rad/s", above=0.0, at_most=1e4, doc="speed of the crank", symbol="ω")
    beater_mass: float = param(2.5, unit="kg", at_least=0.0, at_most=1e5, doc="mass of the beater", symbol="m_E")
    density: float = param(
        7210.0, unit="kg/m^3", above=0.0, at_most=1e5, doc="density of the links; cast iron", symbol="ρ"
    )
    width: float = param(
        0.03, unit="mm", at_least=SMALL, at_most=LARGE, doc="width of the links, in the plane of motion", symbol="w"
    )
    thickness: float = param(0.01, unit="mm", at_least=SMALL, at_most=LARGE, doc="thickness of the links")
    gravity: float = param(
        0.0, unit="m/s^2", at_least=0.0, at_most=1e3, doc="free fall; the paper leaves weight out", symbol="g"
    )
    gravity_direction: float = param(
        -90 * deg,
        unit="deg",
        at_least=-turn,
        at_most=turn,
        doc="where weight points, from the ground line D-A counter-clockwise; turns with the place of the loom",
    )
    beat_force: float = param(
        60.0, unit="N", at_least=0.0, at_most=1e6, doc="force on the beater that is wanted at its peak"
    )
    balance_share: float = param(
        1.0,
        at_least=0.0,
        at_most=2.0,
        doc="share of the shaking force's first harmonic, the part that turns with the crank, that a counterweight on "
        "it cancels",
    )
    counterweight_radius: float | None = param(
        None, unit="mm", at_least=SMALL, at_most=LARGE, doc="of its mass centre from the pivot; unsaid: the crank"
    )
    fluctuation: float = param(
        0.05, at_least=1e-4, at_most=1.0, doc="fluctuation of the speed that the flywheel is to keep", symbol="δ"
    )
    flywheel: float | None = param(
        None,
        unit="kg*m^2",
        at_least=0.0,
        at_most=1e6,
        doc="moment of inertia of flywheel and rotor on the crank; unsaid: as the fluctuation asks",
    )
    motor_torque: float | None = param(
        None,
        unit="N*m",
        at_least=1e-6,
        at_most=1e9,
        doc="greatest torque of the motor on the crank; unsaid: the greatest that the constant speed asks",
    )
    slip: float = param(0.1, at_least=1e-3, at_most=1.0, doc="loss of speed at which the motor gives its torque")
    crank_angle: float | None = param(
        None, unit="deg", at_least=-2 * turn, at_most=2 * turn, doc="crank angle at which to report forces", symbol="θ"
    )
    objective: str | None = param(
        None,
        choices=tuple(OBJECTIVES),
        doc="what is best among the crank-rockers within the limits; unsaid, where a limit is given: force_at_beat",
    )
    ratio_min: float | None = param(None, above=0.0, at_most=1.0, doc="limit: crank/coupler ratio, r/l")
    ratio_max: float | None = param(None, above=0.0, at_most=1.0, doc="limit: crank/coupler ratio, r/l")
    transmission_min: float | None = param(
        None, unit="deg", above=0.0, below=math.pi / 2, doc="limit: least acute transmission angle over a turn"
    )
    link_ratio_max: float | None = param(None, at_least=1.0, at_most=1e6, doc="limit: longest link over the shortest")
    size_max: float | None = param(
        None, unit="mm", at_least=SMALL, at_most=LARGE, doc="limit: greatest distance of places that its points get to"
    )
    acceleration_max: float | None = param(
        None, unit="m/s^2", above=0.0, at_most=1e9, doc="limit: greatest acceleration of the beater, at the speed"
    )
    rocker_acceleration_max: float | None = param(
        None, unit="rad/s^2", above=0.0, at_most=1e9, doc="limit: greatest angular acceleration of the rocker"
    )
    force_at_beat_min: float | None = param(
        None, unit="N", above=0.0, at_most=1e9, doc="limit: force on the beater at the beat itself"
    )
    torque_max: float | None = param(None, unit="N*m", above=0.0, at_most=1e9, doc="limit: greatest drive torque")
    joint_force_max: float | None = param(
        None, unit="N", above=0.0, at_most=1e9, doc="limit: greatest force in any pin"
    )
    front: str = param(
        "transmission_angle force_at_beat drive_torque",
        doc=f"what Pareto's front weighs, two or more of: {' '.join(OBJECTIVES)}",
    )
    members: int = param(500, at_least=10, at_most=100_000, doc="crank-rockers of the family that are looked at")

    def check_together(self) -> None:
        """Crank, coupler and rocker together or not at all; limits only where there is something to choose."""
        self._check_links()
        weighed_names(self.front)
        asked = [name for name in CHOOSING if getattr(self, name) is not None]
        settled = [name for name in ("beta", "crank") if getattr(self, name) is not None]
        if asked and settled:
            given = "beta" if settled[0] == "beta" else "crank, coupler and rocker"
            raise ParameterError(
                f"{asked[0]} given with {given}",
                allowed=f"with {given} nothing is left to choose",
                do=f"leave out {given}, or {' and '.join(asked)}",
            )

    def _check_links(self) -> None:
        outright = {"crank": self.crank, "coupler": self.coupler, "rocker": self.rocker}
        missing = [name for name, length in outright.items() if length is None]
        if 0 < len(missing) < len(outright):
            given = [name for name in outright if name not in missing]
            raise ParameterError(
                f"{' and '.join(given)} given without {' and '.join(missing)}",
                do="give crank, coupler and rocker, or none of them",
            )


def weight(params: BeatUpParams) -> complex:
    """Free fall [m/s²] in the frame of the ground line."""
    return params.gravity * complex(math.cos(params.gravity_direction), math.sin(params.gravity_direction))


def weighed_names(text: str) -> tuple[str, ...]:
    """Names of `OBJECTIVES` with blanks or commas between, as `front` says them.

    Raises ParameterError for an unknown or repeated name, and for fewer than two.
    """
    names = tuple(text.replace(",", " ").split())
    for name in names:
        if name not in OBJECTIVES:
            near = difflib.get_close_matches(name, OBJECTIVES, n=1)
            hint = f"did you mean {near[0]}?" if near else ""
            raise ParameterError(f"front={text!r}: {name!r} is unknown", allowed=f"of {' '.join(OBJECTIVES)}", do=hint)
    if len(set(names)) < max(2, len(names)):
        raise ParameterError(
            f"front={text!r} is no choice between two things",
            allowed=f"two or more different ones of {' '.join(OBJECTIVES)}",
            do="say what the front is to weigh",
        )
    return names

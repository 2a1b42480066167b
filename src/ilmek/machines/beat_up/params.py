"""What may be asked of a beat-up mechanism."""

import math
from dataclasses import dataclass

from ilmek.errors import ParameterError
from ilmek.params import Params, param
from ilmek.units import deg, turn

SMALL, LARGE = 1e-4, 1e2
"""Lengths that are taken for meant [m]."""


@dataclass(frozen=True, slots=True)
class BeatUpParams(Params):
    """What may be asked of a beat-up mechanism; the defaults are the paper's."""

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

    def check_together(self) -> None:
        """Crank, coupler and rocker are given together or not at all."""
        outright = {"crank": self.crank, "coupler": self.coupler, "rocker": self.rocker}
        missing = [name for name, length in outright.items() if length is None]
        if 0 < len(missing) < len(outright):
            given = [name for name in outright if name not in missing]
            raise ParameterError(
                f"{' and '.join(given)} given without {' and '.join(missing)}",
                do="give crank, coupler and rocker, or none of them",
            )

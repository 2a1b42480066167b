"""A follower that gives: its mass hangs on a linkage of finite stiffness, lags behind the cam and swings on.

Reckoned in the follower's own coordinate, m of a slide or rad of an arm, as `forces` does; said along its arc.
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.cams.follower_dynamics import FollowerModel, Response, one_mass, residual_of, steady_response
from ilmek.cams.laws import LAWS, SMOOTH_LAWS, Law
from ilmek.cams.vibration import least_ratio, residual
from ilmek.errors import ParameterError
from ilmek.machines.cam.design import CamDesign
from ilmek.machines.cam.params import CamParams
from ilmek.report import Axis, Check, Column, Figure, Mark, Plot, Result, Series, Table, at_least
from ilmek.units import format_quantity

SHARE = 0.01
"""Residual vibration that the table of laws asks for, of the lift."""

MOST_SWINGS = 2000
"""Natural swings in a turn of the cam up to which a follower's own motion is reckoned."""

BESIDE = ("harmonic", "modified-sine", "cycloidal", "4-5-6-7")
"""Laws drawn beside the cam's own."""

SOURCE = "Norton, Cam Design and Manufacturing, 10-12"


@dataclass(frozen=True, slots=True)
class CompliantFollower:
    """The follower on its linkage, and what it does over a turn; `arc`: length of arc by its coordinate."""

    params: CamParams
    follower: FollowerModel
    response: Response
    arc: float

    @property
    def frequency(self) -> float:
        """Natural frequency [Hz]."""
        return float(self.follower.frequencies[0]) / (2 * math.pi)

    @property
    def times(self) -> tuple[float, float]:
        """Times of the rise and of the fall [s]."""
        return self.params.rise / self.params.speed, self.params.fall_angle / self.params.speed

    def residuals(self) -> tuple[float, float]:
        """Amplitudes left after the rise and after the fall, each from rest, along the arc [m]."""
        left = (
            float(residual_of(self.follower, law, time)[0])
            for law, time in zip(self.params.laws(), self.times, strict=True)
        )
        rise, fall = left
        return self.params.lift * rise, self.params.lift * fall


def springy(design: CamDesign) -> CompliantFollower | None:
    """The follower on its linkage; None where it is rigid.

    Raises ParameterError for a follower without mass, or a cam that does not turn.
    """
    params, held, arc = design.params, design.held, design.params.per_unit
    if params.linkage_stiffness is None:
        return None
    if not (params.mass > 0 and params.speed > 0):
        wrong = "mass" if not params.mass > 0 else "speed"
        raise ParameterError(f"linkage_stiffness with {wrong}=0", allowed=f"{wrong} above 0", do="or leave it out")
    preload = held.preload + held.load
    stiffness = params.linkage_stiffness * arc**2
    swings = math.sqrt(stiffness / held.mass) / params.speed
    if swings > MOST_SWINGS:
        raise ParameterError(
            f"linkage_stiffness={format_quantity(params.linkage_stiffness, 'N/mm')} swings {swings:.0f} times a turn",
            allowed=f"at most {MOST_SWINGS} times: beyond it follows the cam",
            do="leave linkage_stiffness out: take it as rigid",
        )
    follower = one_mass(held.mass, stiffness, params.linkage_damping, held.rate, preload)
    return CompliantFollower(params, follower, steady_response(follower, design.programme, params.speed), arc)


def springy_results(made: CompliantFollower) -> tuple[Result, ...]:
    """Frequency, time ratio, lag, what swings on, and the force on the cam."""
    after_rise, after_fall = made.residuals()
    lag = made.arc * float(np.max(np.abs(made.response.lag)))
    return (
        Result("natural_frequency", made.frequency, "Hz", "of the follower on its linkage"),
        Result("time_ratio", made.times[0] * made.frequency, "", "time of the rise over the natural period"),
        Result("lag_max", lag, "mm", "largest distance of the mass from where the cam would have it"),
        Result("residual_vibration", after_rise, "mm", "amplitude that the mass swings on with after the rise"),
        Result("residual_vibration_fall", after_fall, "mm", "amplitude that it swings on with after the fall"),
        Result("contact_springy_min", _least_force(made), "N", "least force on the cam along the motion, with the lag"),
    )


def springy_checks(made: CompliantFollower) -> tuple[Check, ...]:
    """That the follower on its linkage stays on the cam; nothing of a cam that leads it both ways."""
    if made.params.led:
        return ()
    return (at_least("force on the cam of the follower that gives", _least_force(made), 0.0, "N", SOURCE),)


def springy_table(made: CompliantFollower) -> Table:
    """What swings on by each law at this lift, time and follower, and up to which speed it is little."""
    columns = (
        Column("law"),
        Column("residual vibration", "mm"),
        Column("time ratio for 1 % of the lift"),
        Column("speed for 1 % of the lift", "rpm"),
    )
    own, damping = made.params.laws()[0], made.params.linkage_damping
    rows = []
    for name in SMOOTH_LAWS:
        law = own if name == own.name else LAWS[name]
        left = made.params.lift * float(residual_of(made.follower, law, made.times[0])[0])
        ratio = least_ratio(law, SHARE, damping) if damping < 1 and math.isfinite(law.acceleration_peak) else math.nan
        rows.append((name, left, ratio, made.params.rise * made.frequency / ratio))
    return Table("cam-vibration", "What swings on after the rise, by law", columns, tuple(rows))


def springy_figures(made: CompliantFollower) -> tuple[Figure, ...]:
    """Lag over the turn, and residual vibration over the speed."""
    response = made.response
    lag = Series("mass", response.at, made.arc * response.lag[0])
    over_turn = Plot(
        "cam-lag",
        "Mass less cam: behind it below 0, beyond it above",
        Axis("cam angle", "deg"),
        Axis("mass less cam", "mm"),
        (lag,),
        note=f"natural frequency {made.frequency:.4g} Hz, damping {100 * made.params.linkage_damping:g} %",
    )
    return (over_turn,) if made.params.linkage_damping >= 1 else (over_turn, _over_speed(made))


def _over_speed(made: CompliantFollower) -> Plot:
    params = made.params
    own = params.laws()[0]
    speeds = params.speed * np.linspace(0.2, 1.5, 240)
    ratios = made.frequency * params.rise / speeds
    laws: dict[str, Law] = {own.name: own, **{name: LAWS[name] for name in BESIDE if name != own.name}}
    series = tuple(
        Series(name, speeds, params.lift * residual(law, ratios, params.linkage_damping), dashed=law is not own)
        for name, law in laws.items()
    )
    marks = (Mark(params.speed, "speed"),)
    x, y = Axis("speed of the cam", "rpm"), Axis("amplitude", "mm")
    note = "without the return spring's share"
    return Plot("cam-vibration", "What swings on after the rise, over the speed", x, y, series, marks, note)


def _least_force(made: CompliantFollower) -> float:
    return float(np.min(made.response.contact)) / made.arc

"""A compliant follower: its mass is driven through a linkage of finite stiffness, lags behind the cam and vibrates.

Computed in the follower's own coordinate, m of a slide or rad of an arm, as in `forces`; reported along its arc.
"""

import math

import numpy as np

from ilmek.cams.follower_dynamics import FollowerModel, Response, one_mass, residual_of, steady_response
from ilmek.cams.laws import LAWS, SMOOTH_LAWS, Law
from ilmek.cams.vibration import least_ratio, residual
from ilmek.errors import ParameterError
from ilmek.machines.cam.design import CamDesign
from ilmek.machines.cam.params import CamParams
from ilmek.records import computed, record
from ilmek.report import Axis, Check, Figure, Mark, Plot, Series, Table, at_least, columns
from ilmek.units import format_quantity

SHARE = 0.01
"""Residual vibration over the lift, for which the table of laws gives a speed."""

MOST_SWINGS = 2000
"""Natural periods in a turn of the cam up to which a follower's own motion is computed."""

BESIDE = ("harmonic", "modified-sine", "cycloidal", "4-5-6-7")
"""Laws drawn beside the cam's own."""

SOURCE = "Norton, Cam Design and Manufacturing, 10-12"


@record
class CompliantFollower:
    """The follower on its linkage, and its response over a turn; `arc`: length of arc by its coordinate."""

    params: CamParams
    follower: FollowerModel
    response: Response
    arc: float

    natural_frequency = computed(
        "Hz", "of the follower on its linkage", lambda it: float(it.follower.frequencies[0]) / (2 * math.pi)
    )
    time_ratio = computed("", "time of the rise over the natural period", lambda it: it.times[0] * it.natural_frequency)

    @computed("mm", "largest distance of the mass from its position by the cam")
    def lag_max(self) -> float:
        return self.arc * float(np.max(np.abs(self.response.lag)))

    residual_vibration = computed("mm", "amplitude of the mass after the rise", lambda it: it.residual(0))
    residual_vibration_fall = computed("mm", "amplitude of the mass after the fall", lambda it: it.residual(1))

    @computed("N", "least force on the cam along the motion, with the lag")
    def contact_springy_min(self) -> float:
        return float(np.min(self.response.contact)) / self.arc

    @property
    def times(self) -> tuple[float, float]:
        """Times of the rise and of the fall [s]."""
        return self.params.rise / self.params.speed, self.params.fall_angle / self.params.speed

    def residual(self, stroke: int) -> float:
        """Amplitude along the arc [m] after the rise, 0, or after the fall, 1, each from rest."""
        return self.params.lift * float(residual_of(self.follower, self.params.laws()[stroke], self.times[stroke])[0])


def compliant_follower(design: CamDesign) -> CompliantFollower | None:
    """The follower on its linkage; None where it is rigid.

    Raises ParameterError for a follower without mass, or a cam that does not turn.
    """
    params, follower_load, arc = design.params, design.follower_load, design.params.per_unit
    if params.linkage_stiffness is None:
        return None
    if not (params.mass > 0 and params.speed > 0):
        wrong = "mass" if not params.mass > 0 else "speed"
        raise ParameterError(f"linkage_stiffness with {wrong}=0", allowed=f"{wrong} above 0", do="or leave it out")
    preload = follower_load.preload + follower_load.load
    stiffness = params.linkage_stiffness * arc**2
    swings = math.sqrt(stiffness / follower_load.mass) / params.speed
    if swings > MOST_SWINGS:
        raise ParameterError(
            f"linkage_stiffness={format_quantity(params.linkage_stiffness, 'N/mm')} vibrates {swings:.0f} times a turn",
            allowed=f"at most {MOST_SWINGS} times: a stiffer one follows the cam",
            do="leave linkage_stiffness out: take it as rigid",
        )
    follower = one_mass(follower_load.mass, stiffness, params.linkage_damping, follower_load.rate, preload)
    return CompliantFollower(params, follower, steady_response(follower, design.programme, params.speed), arc)


def vibration_checks(follower: CompliantFollower) -> tuple[Check, ...]:
    """Contact of the follower on its linkage; none of a cam that leads it both ways."""
    if follower.params.led:
        return ()
    return (at_least("force of the compliant follower on the cam", follower.contact_springy_min, 0.0, "N", SOURCE),)


def vibration_table(follower: CompliantFollower) -> Table:
    """Residual vibration by each law at this lift, time and follower, and the speed up to which it is small."""
    heads = columns("law", "residual vibration [mm]", "time ratio for 1 % of lift", "speed for 1 % of lift [rpm]")
    own, damping = follower.params.laws()[0], follower.params.linkage_damping
    rows = []
    for name in SMOOTH_LAWS:
        law = own if name == own.name else LAWS[name]
        left = follower.params.lift * float(residual_of(follower.follower, law, follower.times[0])[0])
        ratio = least_ratio(law, SHARE, damping) if damping < 1 and math.isfinite(law.acceleration_peak) else math.nan
        rows.append((name, left, ratio, follower.params.rise * follower.natural_frequency / ratio))
    return Table("cam-vibration", "Residual vibration after the rise, by law", heads, tuple(rows))


def vibration_figures(follower: CompliantFollower) -> tuple[Figure, ...]:
    """Lag over the turn, and residual vibration over the speed."""
    response = follower.response
    lag = Series("mass", response.at, follower.arc * response.lag[0])
    title = "Lag of the mass: below 0 behind the cam, above 0 ahead of it"
    note = f"natural frequency {follower.natural_frequency:.4g} Hz, damping {100 * follower.params.linkage_damping:g} %"
    over_turn = Plot("cam-lag", title, Axis("cam angle", "deg"), Axis("mass less cam", "mm"), (lag,), note=note)
    return (over_turn,) if follower.params.linkage_damping >= 1 else (over_turn, _over_speed(follower))


def _over_speed(follower: CompliantFollower) -> Plot:
    params = follower.params
    own = params.laws()[0]
    speeds = params.speed * np.linspace(0.2, 1.5, 240)
    ratios = follower.natural_frequency * params.rise / speeds
    laws: dict[str, Law] = {own.name: own, **{name: LAWS[name] for name in BESIDE if name != own.name}}
    series = tuple(
        Series(name, speeds, params.lift * residual(law, ratios, params.linkage_damping), dashed=law is not own)
        for name, law in laws.items()
    )
    marks = (Mark(params.speed, "speed"),)
    x, y = Axis("speed of the cam", "rpm"), Axis("amplitude", "mm")
    note = "without the return spring"
    return Plot("cam-vibration", "Residual vibration after the rise, over the speed", x, y, series, marks, note)

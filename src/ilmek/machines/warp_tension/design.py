"""The warp tension cylinder's parameters and its design.

    w = T n / l,   slope = w l^3 / (24 E I),   deflection = 5 w l^4 / (384 E I),   M = n T R       [thesis, eq. 3.4-3.8]

Every warp pulls the cylinder one way with its tension T. Slope and deflection are the thesis', of the pull alone; the
tube's weight, 2 % of the pull on the thesis' loom but half of it on a wide one, is added where limits are judged and a
tube is chosen: the upper cylinder of a loom with upright warps bears both. Carpet that is wound on the cylinder makes
its radius, and so the torque, grow: pi (R^2 - Ro^2) = length x thickness.
"""

import math
from dataclasses import dataclass

from ilmek.cams.laws import LAWS
from ilmek.elements import shafts
from ilmek.elements.beam import uniform
from ilmek.elements.materials import GRAVITY
from ilmek.elements.motors import Motor, Reducer, geared_motor, most_torque
from ilmek.elements.tubes import TUBES, Tube, find_tube
from ilmek.errors import ParameterError
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.units import format_quantity, mm, turn

INNER_RADIUS = 65 * mm
"""The thesis' tube, 140 x 5 mm."""

LIGHTEST = "lightest"

TAKE_UP_LAW = LAWS["3-4-5"]
"""How the cylinder turns on by a row: from rest to rest; its motor must reach 15/8 of the mean speed."""

RATIOS = (100.0, 150.0, 200.0, 300.0, 500.0, 1000.0)
"""The thesis' reducer, and larger ones, a worm behind a first stage, for wide looms."""


@dataclass(frozen=True, slots=True)
class WarpTensionDesign:
    """The cylinder, designed; forces N, N/m, lengths m, angles rad, torques N m.

    outer_radius_min             least outer radius for the slope with the inner radius given
    outer_radius_min_deflection  the same for the deflection
    slope, deflection            under the pull of the warps alone
    slope_loaded, deflection_loaded, stress    with the tube's own weight
    roll_radius                  radius with the whole carpet wound on; the outer radius where none is
    torque, torque_full          of all warps on the bare cylinder, and on the full one
    motor_speed                  the largest, while a row is taken up
    motor_limit                  lasting torque of the motor; where none is strong enough, the most of any so quick
    """

    params: WarpTensionParams
    load: float
    inner_radius: float
    outer_radius: float
    outer_radius_min: float
    outer_radius_min_deflection: float
    slope: float
    deflection: float
    slope_loaded: float
    deflection_loaded: float
    stress: float
    torque: float
    torque_full: float
    roll_radius: float
    reducer: Reducer
    motor_torque: float
    motor_speed: float
    motor: Motor | None
    motor_limit: float

    @property
    def inertia(self) -> float:
        """Second moment of area of the tube [m^4]."""
        return float(uniform.tube_inertia(self.outer_radius, self.inner_radius))

    @property
    def reaction(self) -> float:
        """Force on each bearing [N]."""
        return float(uniform.reaction(self.load, self.params.width))

    @property
    def mass(self) -> float:
        """Mass of the tube between its bearings [kg]."""
        section = math.pi * (self.outer_radius**2 - self.inner_radius**2)
        return section * self.params.width * self.params.density

    @property
    def self_weight(self) -> float:
        """Weight of the tube per length [N/m]."""
        return tube_weight(self.params, self.inner_radius, self.outer_radius)

    @property
    def take_up_turns(self) -> float:
        """Turns of the cylinder for the whole carpet."""
        params = self.params
        if params.carpet_thickness == 0:
            return params.carpet_length / (turn * self.outer_radius)
        return (self.roll_radius - self.outer_radius) / params.carpet_thickness


def design(params: WarpTensionParams) -> WarpTensionDesign:
    """Cylinder and drive for the parameters."""
    load, pull = params.warps * params.tension / params.width, params.warps * params.tension
    inner, outer = _tube(params)
    for_slope, for_deflection = outer_radii_min(params, inner)
    inertia = float(uniform.tube_inertia(outer, inner))
    loaded = load + tube_weight(params, inner, outer)
    roll = math.sqrt(outer**2 + params.carpet_length * params.carpet_thickness / math.pi)
    reducer, motor, speed = _drive(params, pull * roll, peak_rate(params, outer))
    return WarpTensionDesign(
        params=params,
        load=load,
        inner_radius=inner,
        outer_radius=outer,
        outer_radius_min=for_slope,
        outer_radius_min_deflection=for_deflection,
        slope=float(uniform.slope_max(load, params.width, params.modulus, inertia)),
        deflection=float(uniform.deflection_max(load, params.width, params.modulus, inertia)),
        slope_loaded=float(uniform.slope_max(loaded, params.width, params.modulus, inertia)),
        deflection_loaded=float(uniform.deflection_max(loaded, params.width, params.modulus, inertia)),
        stress=float(uniform.bending_stress(uniform.moment_max(loaded, params.width), outer, inertia)),
        torque=pull * outer,
        torque_full=pull * roll,
        roll_radius=roll,
        reducer=reducer,
        motor_torque=reducer.motor_torque(pull * roll),
        motor_speed=speed,
        motor=motor,
        motor_limit=params.motor_torque or (motor.torque if motor else most_torque(speed)),
    )


def tube_weight(params: WarpTensionParams, inner: float, outer: float) -> float:
    """Weight of a tube per length [N/m]."""
    return math.pi * (outer**2 - inner**2) * params.density * GRAVITY


def keeps_limits(params: WarpTensionParams, inner: float, outer: float) -> bool:
    """Whether a tube [m] keeps slope and deflection under the warps and its own weight."""
    loaded = params.warps * params.tension / params.width + tube_weight(params, inner, outer)
    inertia = uniform.tube_inertia(outer, inner)
    slope = uniform.slope_max(loaded, params.width, params.modulus, inertia)
    sag = uniform.deflection_max(loaded, params.width, params.modulus, inertia)
    return bool(slope <= params.slope_limit and sag <= params.deflection_limit)


def peak_rate(params: WarpTensionParams, outer: float) -> float:
    """Largest speed of the cylinder [rad/s] while a row is taken up."""
    return TAKE_UP_LAW.velocity_peak * params.row_pitch / outer / params.take_up_time


def _tube(params: WarpTensionParams) -> tuple[float, float]:
    """Inner and outer radius [m]: as given; the other by the wall; both, the first millimetre that keeps the limits."""
    if params.tube is not None:
        chosen = lightest_tube(params) if params.tube.strip().casefold() == LIGHTEST else find_tube(params.tube)
        return chosen.inner_radius, chosen.outer_radius
    inner, outer, wall = params.inner_radius, params.outer_radius, params.wall
    if outer is not None:
        return (max(outer - wall, 0.0) if inner is None else inner), outer
    steps = (step * mm for step in range(2000))
    if inner is not None:
        least = _whole_millimetre(max(*outer_radii_min(params, inner), inner + wall))
        tubes = ((inner, least + step) for step in steps)
    else:
        # A wider tube with the same wall is stiffer; no cylinder is wider than the largest radius that can be given.
        tubes = ((INNER_RADIUS + step, INNER_RADIUS + step + wall) for step in steps)
    found = next((tube for tube in tubes if keeps_limits(params, *tube)), None)
    if found is None:
        given = f"no tube with a wall of {format_quantity(wall, 'mm')} keeps slope and deflection"
        raise ParameterError(given, do="set a larger wall or inner_radius")
    return found


def lightest_tube(params: WarpTensionParams) -> Tube:
    """The lightest stock tube that keeps slope and deflection. Raises ParameterError where none does."""
    for tube in sorted(TUBES.values(), key=lambda tube: tube.area):
        if keeps_limits(params, tube.inner_radius, tube.outer_radius):
            return tube
    widest = max(TUBES.values(), key=lambda tube: tube.inertia)
    pull = format_quantity(params.warps * params.tension / params.width, "kN/m")
    raise ParameterError(
        f"no stock tube carries {pull} of warps over {format_quantity(params.width, 'm')}",
        allowed=f"up to {widest.name} mm, with {format_quantity(params.deflection_limit, 'mm')} of deflection",
        do="set a lower tension, or a narrower loom",
    )


def _drive(params: WarpTensionParams, torque: float, rate: float) -> tuple[Reducer, Motor | None, float]:
    """Reducer, the motor chosen and its speed [rad/s], for a torque [N m] and a speed [rad/s] at the cylinder.

    Where the ratio is free, it is the least of those with the motor of least power.
    """
    ratios = RATIOS if params.ratio is None else (params.ratio,)
    reducers = [Reducer(ratio, params.efficiency) for ratio in ratios]
    if params.motor_torque is not None:
        return reducers[0], None, reducers[0].ratio * rate
    motor, reducer = geared_motor(torque, rate, reducers) or (None, reducers[-1])
    return reducer, motor, reducer.ratio * rate


def outer_radii_min(params: WarpTensionParams, inner_radius: float) -> tuple[float, float]:
    """Least outer radii [m] for the slope and for the deflection, with an inner radius [m]."""
    load, width, modulus = params.warps * params.tension / params.width, params.width, params.modulus
    for_slope = shafts.inertia_for_slope(load, width, modulus, params.slope_limit)
    for_deflection = shafts.inertia_for_deflection(load, width, modulus, params.deflection_limit)
    return shafts.tube_outer_radius(for_slope, inner_radius), shafts.tube_outer_radius(for_deflection, inner_radius)


def _whole_millimetre(radius: float) -> float:
    """The radius, or the next whole millimetre above; rounding below a nanometre is no reason for another one."""
    return math.ceil(radius / mm - 1e-6) * mm

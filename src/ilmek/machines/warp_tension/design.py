"""Design of the warp tension cylinder.

    w = T n / l,   slope = w l^3 / (24 E I),   deflection = 5 w l^4 / (384 E I),   M = n T R       [thesis, eq. 3.4-3.8]

All warps pull the cylinder in one direction, each with its tension T. Slope and deflection are the thesis', of the pull
alone. The weight of the tube, 2 % of the pull on the thesis' loom but half of it on a wide one, is added for checks and
for the choice of a tube: the upper cylinder of a loom with upright warps carries both. Carpet wound on the cylinder
increases its radius, and with it the torque: pi (R^2 - Ro^2) = length x thickness.
"""

import math
from collections.abc import Iterable

from ilmek.cams.laws import LAWS
from ilmek.elements import shafts
from ilmek.elements.beam import uniform
from ilmek.elements.bearings import bearings_for
from ilmek.elements.materials import GRAVITY
from ilmek.elements.motors import NO_MOTOR, Motor, Reducer, geared_motor, most_torque
from ilmek.elements.tubes import TUBES, Tube, find_tube
from ilmek.errors import ParameterError
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.records import computed, record, result
from ilmek.units import format_quantity, mm, turn

INNER_RADIUS = 65 * mm
"""The thesis' tube, 140 x 5 mm."""

LIGHTEST = "lightest"

TAKE_UP_LAW = LAWS["3-4-5"]
"""Motion of the cylinder for a row, from rest to rest; its motor must reach 15/8 of the mean speed."""

RATIOS = (100.0, 150.0, 200.0, 300.0, 500.0, 1000.0)
"""The thesis' reducer, and larger ones, a worm behind a first stage, for wide looms."""


@record
class WarpTensionDesign:
    """The design of the cylinders; `motor_limit`: continuous torque of the motor [N m], or the most of any so quick."""

    params: WarpTensionParams
    slope: float = result("rad", "slope of the cylinder in its bearings, under the warps alone")
    deflection: float = result("mm", "deflection at mid-width, under the warps alone")
    slope_loaded: float = result("rad", "slope with the tube's own weight")
    deflection_loaded: float = result("mm", "deflection with the tube's own weight")
    torque: float = result("Nm", "torque of all warps on the bare cylinder")
    outer_radius: float = result("mm", "outer radius of the tube", least=0.0)
    inner_radius: float = result("mm", "inner radius of the tube", least=0.0)
    outer_radius_min: float = result("mm", "least outer radius for the slope, at this inner radius")
    outer_radius_min_deflection: float = result("mm", "least outer radius for the deflection")
    load: float = result("kN/m", "pull of the warps per length of the cylinder")
    stress: float = result("MPa", "bending stress at mid-width, own weight included")
    roll_radius: float = result("mm", "radius with the carpet wound on", least=0.0)
    torque_full: float = result("Nm", "torque of all warps with the carpet wound on")
    reducer: Reducer
    motor_torque: float = result("Nm", "required torque of the motor")
    motor_speed: float = result("rpm", "largest speed of the motor while a row is taken up")
    motor: Motor | None
    motor_limit: float

    reaction = computed("N", "force on each bearing", lambda it: float(uniform.reaction(it.load, it.params.width)))
    force = computed("kN", "pull of all warps", lambda it: it.load * it.params.width)
    self_weight = computed("N/m", "own weight", lambda it: tube_weight(it.params, it.inner_radius, it.outer_radius))
    mass = computed(
        "kg",
        "mass of the tube between its bearings",
        lambda it: math.pi * (it.outer_radius**2 - it.inner_radius**2) * it.params.width * it.params.density,
    )
    bearings = computed(
        "",
        "kinds of bearings that allow the slope, own weight included",
        lambda it: [one.name for one in bearings_for(it.slope_loaded)],
    )
    ratio = computed("1", "ratio of the reducer", lambda it: it.reducer.ratio)
    self_locking = computed("", "whether the reducer holds the warps by itself", lambda it: it.reducer.self_locking)
    back_driving_efficiency = computed(
        "1", "2 - 1/efficiency; self-locking at 0 and below", lambda it: it.reducer.back_driving_efficiency
    )
    motor_name = computed(
        "",
        "class of motor chosen",
        lambda it: it.motor.name if it.motor else None,
        name="motor",
        absent=NO_MOTOR,
    )
    take_up_angle = computed(
        "deg", "rotation of the cylinder per row", lambda it: it.params.row_pitch / it.outer_radius
    )
    take_up_motor_turns = computed("1", "motor turns a row", lambda it: it.take_up_angle * it.ratio / turn)

    @computed("1", "turns of the cylinder for the whole carpet")
    def take_up_turns(self) -> float:
        params = self.params
        if params.carpet_thickness == 0:
            return params.carpet_length / (turn * self.outer_radius)
        return (self.roll_radius - self.outer_radius) / params.carpet_thickness


def design(params: WarpTensionParams) -> WarpTensionDesign:
    """Cylinder and drive for the parameters. Raises ParameterError where no tube keeps the limits."""
    load, pull = params.pull / params.width, params.pull
    inner, outer = _tube(params)
    for_slope, for_deflection = outer_radii_min(params, inner)
    loaded = load + tube_weight(params, inner, outer)
    bent = (params.width, params.modulus, float(uniform.tube_inertia(outer, inner)))
    roll = math.sqrt(outer**2 + params.carpet_length * params.carpet_thickness / math.pi)
    reducer, motor, speed = _drive(params, pull * roll, _peak_rate(params, outer))
    return WarpTensionDesign(
        params=params,
        slope=float(uniform.slope_max(load, *bent)),
        deflection=float(uniform.deflection_max(load, *bent)),
        slope_loaded=float(uniform.slope_max(loaded, *bent)),
        deflection_loaded=float(uniform.deflection_max(loaded, *bent)),
        torque=pull * outer,
        outer_radius=outer,
        inner_radius=inner,
        outer_radius_min=for_slope,
        outer_radius_min_deflection=for_deflection,
        load=load,
        stress=float(uniform.bending_stress(uniform.moment_max(loaded, params.width), outer, bent[2])),
        roll_radius=roll,
        torque_full=pull * roll,
        reducer=reducer,
        motor_torque=reducer.motor_torque(pull * roll),
        motor_speed=speed,
        motor=motor,
        motor_limit=params.motor_torque or (motor.torque if motor else most_torque(speed)),
    )


def tube_weight(params: WarpTensionParams, inner: float, outer: float) -> float:
    """Weight of a tube per length [N/m]."""
    return math.pi * (outer**2 - inner**2) * params.density * GRAVITY


def keeps_limits(params: WarpTensionParams, inner: float, outer: float, load: complex | None = None) -> bool:
    """Whether a tube of these radii [m] keeps slope and deflection under its own weight and a load.

    load  [N/m], complex, the weight along -i; default: the pull of the warps, downwards
    """
    loaded = abs((-1j * params.pull / params.width if load is None else load) - 1j * tube_weight(params, inner, outer))
    bent = (loaded, params.width, params.modulus, uniform.tube_inertia(outer, inner))
    return bool(
        uniform.slope_max(*bent) <= params.slope_limit and uniform.deflection_max(*bent) <= params.deflection_limit
    )


def tubes_within_limits(params: WarpTensionParams, tubes: Iterable[Tube]) -> tuple[Tube, ...]:
    """Those of the tubes that keep slope and deflection under the warps and their own weight, the lightest first."""
    by_mass = sorted(tubes, key=lambda tube: tube.area)
    return tuple(tube for tube in by_mass if keeps_limits(params, tube.inner_radius, tube.outer_radius))


def _peak_rate(params: WarpTensionParams, outer: float) -> float:
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
    found = tubes_within_limits(params, TUBES.values())
    if found:
        return found[0]
    widest = max(TUBES.values(), key=lambda tube: tube.inertia)
    pull = format_quantity(params.pull / params.width, "kN/m")
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
    load, width, modulus = params.pull / params.width, params.width, params.modulus
    for_slope = shafts.inertia_for_slope(load, width, modulus, params.slope_limit)
    for_deflection = shafts.inertia_for_deflection(load, width, modulus, params.deflection_limit)
    return shafts.tube_outer_radius(for_slope, inner_radius), shafts.tube_outer_radius(for_deflection, inner_radius)


def _whole_millimetre(radius: float) -> float:
    """The radius, or the next whole millimetre above; an excess below a nanometre is rounding."""
    return math.ceil(radius / mm - 1e-6) * mm

"""Design of the warp tension cylinder.

    w = T n / l,   slope = w l^3 / (24 E I),   deflection = 5 w l^4 / (384 E I),   M = n T R       [thesis, eq. 3.4-3.8]

All warps pull the cylinder in one direction, each with its tension T. Slope and deflection are the thesis', of the pull
alone, standing. Checks and the choice of a tube take the worst of three cases, standing, shed open and beat
(`warp_loads`), with the weight of the tube, 2 % of the pull on the thesis' loom but half of it on a wide one: the upper
cylinder of a loom with upright warps carries both. Carpet wound on the cylinder increases its radius, and with it the
torque: pi (R^2 - Ro^2) = length x thickness. The motor takes up while the warps stand; the reducer holds the
worst case.
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
from ilmek.machines.warp_loads import WarpLoads
from ilmek.machines.warp_tension.loads import loads_of
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.records import computed, group, record, result
from ilmek.units import mm, turn

INNER_RADIUS = 65 * mm
"""The thesis' tube, 140 x 5 mm."""

LIGHTEST, USUAL = "lightest", "usual"
"""Values of the parameter `tube`: the lightest of all stock tubes, and of the usual ones."""

LARGE_TUBES = tuple(Tube(outer * mm, wall * mm, "EN 10210-2") for outer, wall in ((508, 25), (610, 30), (711, 40)))
"""Large tubes for wide looms."""

USUAL_TUBES = (
    *map(find_tube, ("140x5", "139.7x10", "168.3x6.3", "168.3x10", "193.7x8", "219.1x8", "219.1x12.5", "244.5x10")),
    *map(find_tube, ("273x10", "273x16", "323.9x12.5", "355.6x16", "406.4x16", "457x20")),
    *LARGE_TUBES,
)
"""Tubes for the cylinders of a loom: the thesis' 140 x 5 mm, others of stock, and the large ones."""

STEPS = 1000
"""Millimetres by which the radius of a tube is increased at most."""

TAKE_UP_LAW = LAWS["3-4-5"]
"""Motion of the cylinder for a row, from rest to rest; its motor must reach 15/8 of the mean speed."""

RATIOS = (100.0, 150.0, 200.0, 300.0, 500.0, 1000.0)
"""The thesis' reducer, and larger ones, a worm behind a first stage, for wide looms."""


@record
class WarpTensionDesign:
    """The design of the cylinders; `motor_limit`: continuous torque of the motor [N m], or the most of any so quick."""

    params: WarpTensionParams
    loads: WarpLoads = group()
    slope: float = result("rad", "slope of the cylinder in its bearings, under the warps alone")
    deflection: float = result("mm", "deflection at mid-width, under the warps alone")
    slope_loaded: float = result("rad", "slope in the worst case, with the tube's own weight")
    deflection_loaded: float = result("mm", "deflection in the worst case, with the tube's own weight")
    torque: float = result("Nm", "torque of all warps on the bare cylinder")
    outer_radius: float = result("mm", "outer radius of the tube", least=0.0)
    inner_radius: float = result("mm", "inner radius of the tube", least=0.0)
    outer_radius_min: float = result("mm", "least outer radius for the slope, at this inner radius")
    outer_radius_min_deflection: float = result("mm", "least outer radius for the deflection")
    load: float = result("kN/m", "pull of the warps per length of the cylinder")
    stress: float = result("MPa", "bending stress at mid-width in the worst case, own weight included")
    roll_radius: float = result("mm", "radius with the carpet wound on", least=0.0)
    torque_full: float = result("Nm", "torque of all warps with the carpet wound on")
    holding_torque: float = result("Nm", "torque that the reducer holds in the worst case, the carpet wound on")
    reducer: Reducer
    motor_torque: float = result("Nm", "required torque of the motor, or of the hand at its crank")
    motor_speed: float = result("rpm", "largest speed of the motor while a row is taken up, or of the crank")
    motor: Motor | None
    motor_limit: float

    reaction = computed("N", "force on each bearing", lambda it: float(uniform.reaction(it.load, it.params.span)))
    force = computed("kN", "pull of all warps", lambda it: it.load * it.params.span)
    self_weight = computed("N/m", "own weight", lambda it: tube_weight(it.params, it.inner_radius, it.outer_radius))

    @computed("kg", "mass of the tube between its bearings")
    def mass(self) -> float:
        return math.pi * (self.outer_radius**2 - self.inner_radius**2) * self.params.span * self.params.density

    @computed("", "kinds of bearings that allow the slope, own weight included")
    def bearings(self) -> list[str]:
        return [bearing.name for bearing in bearings_for(self.slope_loaded)]

    ratio = computed("1", "ratio of the reducer", lambda it: it.reducer.ratio)
    self_locking = computed("", "whether the reducer holds the warps by itself", lambda it: it.reducer.self_locking)
    back_driving_efficiency = computed(
        "1", "2 - 1/efficiency; self-locking at 0 and below", lambda it: it.reducer.back_driving_efficiency
    )
    motor_name = computed(
        "", "class of motor chosen", lambda it: it.motor.name if it.motor else None, name="motor", absent=NO_MOTOR
    )
    take_up_angle = computed(
        "deg", "rotation of the cylinder per row", lambda it: it.params.cloth.row_distance / it.outer_radius
    )
    take_up_motor_turns = computed("1", "motor turns a row", lambda it: it.take_up_angle * it.ratio / turn)

    @computed("1", "turns of the cylinder for the whole carpet")
    def take_up_turns(self) -> float:
        params = self.params
        if params.carpet_thickness == 0:
            return params.carpet_length / (turn * self.outer_radius)
        return (self.roll_radius - self.outer_radius) / params.carpet_thickness


def design(params: WarpTensionParams) -> WarpTensionDesign:
    """Cylinder and drive for the parameters; with the largest tube where none keeps the limits."""
    load, pull, loads = params.cloth.pull / params.span, params.cloth.pull, loads_of(params)
    inner, outer = _tube(params)
    for_slope, for_deflection = outer_radii_min(params, inner)
    loaded = loads.worst / params.span + tube_weight(params, inner, outer)
    bent = (params.span, params.modulus, float(uniform.tube_inertia(outer, inner)))
    roll = math.sqrt(outer**2 + params.carpet_length * params.carpet_thickness / math.pi)
    reducer, motor, speed = _drive(params, pull * roll, peak_rate(params, outer))
    return WarpTensionDesign(
        params=params,
        loads=loads,
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
        stress=float(uniform.bending_stress(uniform.moment_max(loaded, params.span), outer, bent[2])),
        roll_radius=roll,
        torque_full=pull * roll,
        holding_torque=loads.worst * roll,
        reducer=reducer,
        motor_torque=reducer.motor_torque(pull * roll),
        motor_speed=speed,
        motor=motor,
        motor_limit=_most_torque(params, motor, speed),
    )


def tube_weight(params: WarpTensionParams, inner: float, outer: float) -> float:
    """Weight of a tube per length [N/m]."""
    return math.pi * (outer**2 - inner**2) * params.density * GRAVITY


def keeps_limits(params: WarpTensionParams, inner: float, outer: float, load: complex) -> bool:
    """Whether a tube of these radii [m] keeps slope and deflection under its own weight and a load.

    load  [N/m], complex, the weight along -i
    """
    loaded = abs(load - 1j * tube_weight(params, inner, outer))
    bent = (loaded, params.span, params.modulus, uniform.tube_inertia(outer, inner))
    return bool(
        uniform.slope_max(*bent) <= params.slope_limit and uniform.deflection_max(*bent) <= params.deflection_limit
    )


def worst_load(params: WarpTensionParams) -> complex:
    """Load of the upper cylinder in the worst case [N/m], downwards."""
    return -1j * loads_of(params).worst / params.span


def tubes_within_limits(params: WarpTensionParams, tubes: Iterable[Tube]) -> tuple[Tube, ...]:
    """Those of the tubes that keep slope and deflection under the warps and their own weight, the lightest first."""
    by_mass, load = sorted(tubes, key=lambda tube: tube.area), worst_load(params)
    return tuple(tube for tube in by_mass if keeps_limits(params, tube.inner_radius, tube.outer_radius, load))


def peak_rate(params: WarpTensionParams, outer: float) -> float:
    """Largest speed of the cylinder [rad/s] while a row is taken up."""
    return TAKE_UP_LAW.velocity_peak * params.cloth.row_distance / outer / params.take_up_time


def _tube(params: WarpTensionParams) -> tuple[float, float]:
    """Inner and outer radius [m]: as given; the other by the wall; both, the first millimetre that keeps the limits.

    Where no tube that was tried keeps them, the largest: its checks fail.
    """
    if params.tube is not None:
        offered = tubes_offered(params)
        chosen = lightest_tube(params, offered) if offered else find_tube(params.tube)
        return chosen.inner_radius, chosen.outer_radius
    inner, outer, wall = params.inner_radius, params.outer_radius, params.wall
    if outer is not None:
        return (max(outer - wall, 0.0) if inner is None else inner), outer
    least = inner + wall if inner is not None else INNER_RADIUS + wall
    if inner is not None:
        least = _whole_millimetre(max(*outer_radii_min(params, inner), least))
    load, steps = worst_load(params), [step * mm for step in range(STEPS)]
    # A wider tube with the same wall is stiffer.
    tubes = [(INNER_RADIUS + step if inner is None else inner, least + step) for step in steps]
    return next((tube for tube in tubes if keeps_limits(params, *tube, load)), tubes[-1])


def tubes_offered(params: WarpTensionParams) -> tuple[Tube, ...]:
    """The tubes that the parameter `tube` leaves open; none where it names one, or is not given."""
    named = (params.tube or "").strip().casefold()
    return {LIGHTEST: tuple(TUBES.values()), USUAL: USUAL_TUBES}.get(named, ())


def lightest_tube(params: WarpTensionParams, tubes: Iterable[Tube]) -> Tube:
    """The lightest of some tubes that keeps slope and deflection; the stiffest where none does."""
    offered = tuple(tubes)
    found = tubes_within_limits(params, offered)
    return found[0] if found else max(offered, key=lambda tube: tube.inertia)


def _drive(params: WarpTensionParams, torque: float, rate: float) -> tuple[Reducer, Motor | None, float]:
    """Reducer, the motor chosen and its speed [rad/s], for a torque [N m] and a speed [rad/s] at the cylinder.

    Where the ratio is free, it is the least of those with the motor of least power, or that a hand can turn.
    """
    ratios = RATIOS if params.ratio is None else (params.ratio,)
    reducers = [Reducer(ratio, params.efficiency) for ratio in ratios]
    if params.by_hand:
        light = (one for one in reducers if one.motor_torque(torque) <= hand_torque(params))
        return next(light, reducers[-1]), None, params.hands.crank_speed
    if params.motor_torque is not None:
        return reducers[0], None, reducers[0].ratio * rate
    motor, reducer = geared_motor(torque, rate, reducers) or (None, reducers[-1])
    return reducer, motor, reducer.ratio * rate


def hand_torque(params: WarpTensionParams) -> float:
    """Torque of a hand on its crank [N m]."""
    return params.crank * params.hands.pull


def _most_torque(params: WarpTensionParams, motor: Motor | None, speed: float) -> float:
    """Torque [N m] of the motor at its speed [rad/s], or of the hand."""
    if params.by_hand:
        return hand_torque(params)
    return params.motor_torque or (motor.torque if motor else most_torque(speed))


def outer_radii_min(params: WarpTensionParams, inner_radius: float) -> tuple[float, float]:
    """Least outer radii [m] for the slope and for the deflection, with an inner radius [m]."""
    load, width, modulus = params.cloth.pull / params.span, params.span, params.modulus
    for_slope = shafts.inertia_for_slope(load, width, modulus, params.slope_limit)
    for_deflection = shafts.inertia_for_deflection(load, width, modulus, params.deflection_limit)
    return shafts.tube_outer_radius(for_slope, inner_radius), shafts.tube_outer_radius(for_deflection, inner_radius)


def _whole_millimetre(radius: float) -> float:
    """The radius, or the next whole millimetre above; an excess below a nanometre is rounding."""
    return math.ceil(radius / mm - 1e-6) * mm

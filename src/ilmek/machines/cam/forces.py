"""Forces between cam and follower over the turn: contact force, torque, rolling and Hertz pressure.

The parameters of an arm hold at the length of the arm; the formulas use its moment of inertia, moments, and a rate by
the angle, so that those of a slide hold with the coordinate in rad.
"""

import math
from dataclasses import replace

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.contact import ContactForce, ContactPoint, FollowerLoad, contact_force
from ilmek.cams.hertz import LINE_YIELD, POINT_YIELD, contact_modulus, ellipse_contact, line_contact
from ilmek.cams.programme import TURN, CamProgramme
from ilmek.cams.return_spring import doubling_spring, least_preload, least_rate, velocity_drop
from ilmek.cams.trace import CamTrace
from ilmek.elements.cam_rollers import POWER, RollerDuty
from ilmek.elements.materials import MATERIALS
from ilmek.machines.cam.params import CamParams
from ilmek.machines.cam.shape import CamShape
from ilmek.num.piecewise import EQUAL, Curve, Extremum, infimum, integral, supremum
from ilmek.plane.vectors import dot, unit
from ilmek.records import computed, record, result

POISSON = 0.3
"""Of steels; of irons and light metals within 10 %, which changes the pressure by 1 %."""

MARGIN = 1.2
"""Speed up to which a chosen spring holds the follower, over the speed of the cam."""


@record
class CamState:
    """Cam and follower at cam angles.

    trace    geometry of the cam                    force   required along the motion [N; N m of an arm]
    normal   force on the normal [N], below 0 where the follower lifts off, or is held by the other flank or cam
    torque   of the shaft [N m]                     bend    curvature of the surface in contact [1/m]
    """

    trace: CamTrace
    force: FloatArray
    normal: FloatArray
    torque: FloatArray
    bend: FloatArray


@record
class CamExtremes:
    """Extremes over the turn; `pressure`: the Hertz pressure [Pa], None for a knife edge."""

    normal: Extremum
    torque: Extremum
    back_torque: Extremum
    torque_rms: float = result("N*m", "root mean square of the torque over the turn")
    pressure: Extremum | None

    @property
    def largest_torque(self) -> Extremum:
        """The torque of largest magnitude; forwards where both are equal but for rounding."""
        forwards = self.torque.value >= -self.back_torque.value * (1 - EQUAL)
        return self.torque if forwards else self.back_torque

    torque_max = computed("N*m", "largest torque of the shaft, in magnitude", lambda it: abs(it.largest_torque.value))
    torque_at = computed("deg", "cam angle of the largest torque", lambda it: it.largest_torque.at)
    torque_range = computed("N*m", "least and largest torque", lambda it: [it.back_torque.value, it.torque.value])
    contact_force_max = computed("N", "largest force between cam and follower", lambda it: it.normal.value)
    contact_force_at = computed("deg", "cam angle of the largest force", lambda it: it.normal.at)

    @computed("MPa", "largest Hertz pressure; null of a knife edge, or where undercut leaves no face")
    def hertz_pressure_max(self) -> float | None:
        return None if self.pressure is None or not math.isfinite(self.pressure.value) else self.pressure.value

    @computed("deg", "cam angle of the largest Hertz pressure")
    def hertz_at(self) -> float | None:
        return None if self.pressure is None or self.hertz_pressure_max is None else self.pressure.at


def held_by(params: CamParams, programme: CamProgramme) -> FollowerLoad:
    """Mass, load and return spring; by default the weakest spring that holds up to the hold speed."""
    if params.led:
        return FollowerLoad(params.speed, params.mass * params.per_unit**2, load=params.load * params.per_unit)
    hold = MARGIN * params.speed if params.hold_speed is None else params.hold_speed
    arc = params.per_unit
    rate, preload = (params.spring_rate or 0.0) * arc**2, (params.preload or 0.0) * arc
    bare = FollowerLoad(hold, params.mass * arc**2, rate, preload, params.load * arc)
    if velocity_drop(programme) is not None:
        return replace(bare, speed=params.speed)
    if params.spring_rate is None and params.preload is None:
        bare = doubling_spring(programme, bare)
    elif params.preload is None:
        bare = replace(bare, preload=least_preload(programme, bare))
    elif params.spring_rate is None:
        bare = replace(bare, rate=least_rate(programme, bare))
    return replace(bare, speed=params.speed)


def duty_of(params: CamParams, cams: CamShape, held: FollowerLoad) -> RollerDuty:
    """The duty of a roller over the turn; it rolls on its stud, which an arm carries with it."""

    def borne(angle: FloatArray) -> tuple[FloatArray, FloatArray]:
        state = state_of(params, cams, held, angle)
        swung = params.side_sign * state.trace.motion.ds if params.motion == "oscillating" else 0.0
        spin = np.abs(state.trace.flow / cams.cam.roller_radius - (0 if params.laid_flat else 1) - swung)
        return _size(params, state.normal), spin

    def worn(angle: FloatArray) -> FloatArray:
        force, spin = borne(angle)
        return np.asarray(force**POWER * spin)

    knots = cams.cam.knots
    turns = integral(lambda angle: borne(angle)[1], knots)
    mean = (integral(worn, knots) / turns) ** (1 / POWER)
    return RollerDuty(mean, supremum(lambda angle: borne(angle)[0], knots).value, turns / TURN, params.speed)


def state_of(params: CamParams, cams: CamShape, held: FollowerLoad, angle: FloatArray) -> CamState:
    """Geometry and forces at cam angles [rad]."""
    trace = cams.cam.trace(angle)
    force = held.force(trace.motion.s, trace.motion.dds)
    found = _pressed(params, trace, force, cams.cam.prime_radius)
    bend, back = trace.surface_curvature, force < 0
    if cams.pair is not None:
        other = cams.pair.second.trace(angle + cams.pair.lag)
        second = _pressed(params, other, -force, cams.pair.second.prime_radius)
        bend = np.where(back, other.surface_curvature, bend)
        normal = np.where(back, -second.normal, found.normal)
        return CamState(trace, force, normal, np.where(back, second.torque, found.torque), bend)
    if params.led:
        bend = np.where(back, -trace.curvature_at(cams.cam.roller_radius), bend)
    return CamState(trace, force, found.normal, found.torque, bend)


def _pressed(params: CamParams, trace: CamTrace, force: FloatArray, radius: float) -> ContactForce:
    if params.laid_flat:
        return _pressed_flat(params, trace, force, radius)
    sliding = 0.0 if params.follower == "roller" else params.sliding_friction
    touch = ContactPoint(trace.surface, trace.normal, _direction(params, trace))
    return contact_force(touch, trace.motion.ds, force, sliding=sliding, guide=params.guide_friction)


def _pressed_flat(params: CamParams, trace: CamTrace, force: FloatArray, radius: float) -> ContactForce:
    """N = F / (cos mu - mu_g |sin mu| sign(s')), T = N rho sin mu: the cam moves at right angles to the follower."""
    sense = np.where(force < 0, -1.0, 1.0) * np.sign(trace.motion.ds)
    cosine, sine = np.cos(trace.pressure_angle), np.sin(trace.pressure_angle)
    along = cosine - params.guide_friction * np.abs(sine) * sense
    with np.errstate(divide="ignore", invalid="ignore"):
        normal = np.where(along > 0, force / along, np.nan)
    return ContactForce(np.asarray(normal), np.asarray(normal * radius * sine))


def _direction(params: CamParams, trace: CamTrace) -> ComplexArray:
    """Velocity of the follower at the point of contact by its coordinate, in the cam's frame."""
    along = trace.normal * np.exp(-1j * trace.pressure_angle)
    if params.motion == "translating":
        return np.asarray(along)
    pivot = params.pivot_distance * unit(-trace.angle)
    turned = np.sign(dot(along, 1j * (trace.pitch - pivot)))
    return np.asarray(turned * 1j * (trace.surface - pivot))


def pressure_of(params: CamParams, state: CamState, width: float) -> FloatArray:
    """Hertz pressure [Pa] on a face of a width [m]; NaN where cam and follower cannot be in contact."""
    first, second = MATERIALS[params.material], MATERIALS[params.follower_material]
    modulus = contact_modulus(first.modulus, POISSON, second.modulus, POISSON)
    round_follower = 1 / state.trace.roller_radius if state.trace.roller_radius > 0 else 0.0
    along, normal = state.bend + round_follower, _size(params, state.normal)
    if params.follower == "spherical" or params.crown_radius is not None:
        across = round_follower if params.crown_radius is None else 1 / params.crown_radius
        return ellipse_contact(normal, along, across, modulus).pressure
    return line_contact(normal / width, along, modulus).pressure


def _size(params: CamParams, normal: FloatArray) -> FloatArray:
    """Magnitude of the contact force [N]; below 0 there is no contact but of a cam that leads both ways."""
    return np.asarray(np.abs(normal) if params.led else np.maximum(normal, 0.0))


def pressure_limit(params: CamParams) -> float:
    """Where the weaker of both materials first yields, below its surface [Johnson, Contact Mechanics]."""
    if params.pressure_limit is not None:
        return params.pressure_limit
    strength = min(MATERIALS[name].strength for name in (params.material, params.follower_material))
    point = params.follower == "spherical" or params.crown_radius is not None
    return strength * (POINT_YIELD if point else LINE_YIELD)


def extremes_of(params: CamParams, cams: CamShape, held: FollowerLoad, width: float) -> CamExtremes:
    """The extremes over the turn, on a face of a width [m]."""
    knots = cams.cam.knots

    def of(pick: str) -> Curve:
        def value(angle: FloatArray) -> FloatArray:
            return np.asarray(getattr(state_of(params, cams, held, angle), pick))

        return value

    def hertz(angle: FloatArray) -> FloatArray:
        return pressure_of(params, state_of(params, cams, held, angle), width)

    return CamExtremes(
        normal=supremum(lambda angle: _size(params, of("normal")(angle)), knots),
        torque=supremum(of("torque"), knots),
        back_torque=infimum(of("torque"), knots),
        torque_rms=math.sqrt(integral(lambda angle: of("torque")(angle) ** 2, knots) / TURN),
        pressure=None if params.follower == "knife" else supremum(hertz, knots),
    )

"""Forces between a cam and its follower over the turn: contact force, torque, rolling and Hertz pressure.

An arm's coordinate is its angle: moment of inertia, moments and torsional rate replace mass, forces and rate in the
formulas of a slide. The cam is a plate, a pair of conjugate plates, or a developed strip that passes under its
follower. [formulas and sources: `contact` (Norton, Cam Design and Manufacturing, 9), `hertz`, `elements.cam_rollers`]
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.conjugate import ConjugatePair
from ilmek.cams.contact import ContactForce, ContactPoint, FollowerLoad, contact_force
from ilmek.cams.hertz import contact_modulus, ellipse_contact, line_contact
from ilmek.cams.programme import TURN
from ilmek.cams.trace import CamRole, CamTrace
from ilmek.elements.cam_rollers import POWER, RollerDuty
from ilmek.elements.materials import MATERIALS
from ilmek.num.piecewise import EQUAL, Extremum, infimum, integral, supremum
from ilmek.plane.vectors import dot, unit
from ilmek.records import computed, record

POISSON = 0.3
"""Poisson's ratio of steels; that of irons and light metals differs by up to 10 %, the pressure by 1 %."""


JAMMED = "the follower jams"


class CamShape(NamedTuple):
    """The cam; with conjugate cams also the pair."""

    cam: CamRole
    pair: ConjugatePair | None = None


@record
class FollowerContact:
    """Contact of a follower with its cam.

    follower   "roller", "spherical", "flat" or "knife"          led      whether the cam drives it in both directions
    laid_flat  whether the cam is a strip that passes under it   pivot    distance of an arm's pivot [m]; None: slide
    side       of an arm: +1 trailing, -1 leading                crown    radius of a crowned roller [m]; None: straight
    sliding, guide  coefficients of friction at the contact, and in a straight guide
    material, follower_material  names of `MATERIALS`
    """

    follower: str
    led: bool
    laid_flat: bool
    pivot: float | None
    side: int
    crown: float | None
    sliding: float
    guide: float
    material: str
    follower_material: str

    @property
    def at_a_point(self) -> bool:
        """Whether the contact is a point, not a line."""
        return self.follower == "spherical" or self.crown is not None


@record
class CamState:
    """Cam and follower at cam angles.

    trace    geometry of the cam                    force   required along the motion [N; N m of an arm]
    normal   force along the normal [N]; below 0 the follower lifts off, or the other flank or cam carries it
    torque   of the shaft [N m]                     bend    curvature of the surface in contact [1/m]
    along    share of the normal force along the motion, friction subtracted: 0 and below the follower jams
    """

    trace: CamTrace
    force: FloatArray
    normal: FloatArray
    torque: FloatArray
    bend: FloatArray
    along: FloatArray


def _unless_jammed(unit: str, doc: str, value: "Callable[[CamExtremes], Any]") -> Any:
    return computed(unit, doc, lambda it: None if it.jammed else value(it), absent=JAMMED)


@record
class CamExtremes:
    """Extremes over the turn; `pressure`: the Hertz pressure [Pa], None for a knife edge.

    Where the follower jams their values are NaN.
    """

    normal: Extremum
    torque: Extremum
    back_torque: Extremum
    rms: float
    pressure: Extremum | None

    @property
    def largest_torque(self) -> Extremum:
        """The torque of largest magnitude; the positive one where both are equal up to rounding."""
        forwards = self.torque.value >= -self.back_torque.value * (1 - EQUAL)
        return self.torque if forwards else self.back_torque

    @property
    def jammed(self) -> bool:
        """Whether the follower jams in its guide or at the contact."""
        return math.isnan(self.normal.value)

    torque_rms = _unless_jammed("N*m", "root mean square of the torque over the turn", lambda it: it.rms)
    torque_max = _unless_jammed(
        "N*m", "largest torque of the shaft, in magnitude", lambda it: abs(it.largest_torque.value)
    )
    torque_at = _unless_jammed("deg", "cam angle of the largest torque", lambda it: it.largest_torque.at)
    torque_range = _unless_jammed("N*m", "least and largest torque", lambda it: [it.back_torque.value, it.torque.value])
    contact_force_max = _unless_jammed("N", "largest force between cam and follower", lambda it: it.normal.value)
    contact_force_at = _unless_jammed("deg", "cam angle of the largest force", lambda it: it.normal.at)

    @computed("MPa", "largest Hertz pressure", absent="a knife edge, or undercut leaves no surface")
    def hertz_pressure_max(self) -> float | None:
        return None if self.pressure is None or not math.isfinite(self.pressure.value) else self.pressure.value

    @computed("deg", "cam angle of the largest Hertz pressure", absent="no such pressure")
    def hertz_at(self) -> float | None:
        return None if self.pressure is None or self.hertz_pressure_max is None else self.pressure.at


@record
class LoadedCam:
    """A cam and its follower under load."""

    contact: FollowerContact
    shape: CamShape
    load: FollowerLoad

    def state(self, angle: FloatArray) -> CamState:
        """Geometry and forces at cam angles [rad]."""
        cam, pair = self.shape
        trace = cam.trace(angle)
        force = self.load.force(trace.motion.s, trace.motion.dds)
        found = self._force(trace, force, cam.prime_radius)
        bend, back = trace.surface_curvature, force < 0
        if pair is not None:
            other = pair.second.trace(angle + pair.lag)
            second = self._force(other, -force, pair.second.prime_radius)
            bend = np.where(back, other.surface_curvature, bend)
            normal = np.where(back, -second.normal, found.normal)
            torque, along = (np.where(back, *both) for both in zip(second[1:], found[1:], strict=True))
            return CamState(trace, force, normal, torque, bend, along)
        if self.contact.led:
            bend = np.where(back, -trace.curvature_at(cam.roller_radius), bend)
        return CamState(trace, force, found.normal, found.torque, bend, found.along)

    def hertz(self, angle: FloatArray, width: float) -> FloatArray:
        """Hertz pressure [Pa] at cam angles [rad] on a face of a width [m]; NaN where contact is impossible."""
        contact, state = self.contact, self.state(angle)
        first, second = MATERIALS[contact.material], MATERIALS[contact.follower_material]
        modulus = contact_modulus(first.modulus, POISSON, second.modulus, POISSON)
        round_follower = 1 / state.trace.roller_radius if state.trace.roller_radius > 0 else 0.0
        along, normal = state.bend + round_follower, self._size(state.normal)
        if contact.at_a_point:
            across = round_follower if contact.crown is None else 1 / contact.crown
            return ellipse_contact(normal, along, across, modulus).pressure
        return line_contact(normal / width, along, modulus).pressure

    def duty(self) -> RollerDuty:
        """The duty of a roller over the turn; it rotates on its stud, which moves with an arm."""
        cam, contact = self.shape.cam, self.contact

        def borne(angle: FloatArray) -> tuple[FloatArray, FloatArray]:
            state = self.state(angle)
            swung = 0.0 if contact.pivot is None else contact.side * state.trace.motion.ds
            spin = np.abs(state.trace.flow / cam.roller_radius - (0 if contact.laid_flat else 1) - swung)
            return self._size(state.normal), spin

        def worn(angle: FloatArray) -> FloatArray:
            force, spin = borne(angle)
            return np.asarray(force**POWER * spin)

        turns = integral(lambda angle: borne(angle)[1], cam.knots)
        mean = (integral(worn, cam.knots) / turns) ** (1 / POWER)
        largest = supremum(lambda angle: borne(angle)[0], cam.knots).value
        return RollerDuty(mean, largest, turns / TURN, self.load.speed)

    def extremes(self, width: float) -> CamExtremes:
        """The extremes over the turn, on a face of a width [m]."""
        knots = self.shape.cam.knots

        def torque(angle: FloatArray) -> FloatArray:
            return self.state(angle).torque

        def pressure(angle: FloatArray) -> FloatArray:
            return self.hertz(angle, width)

        return CamExtremes(
            normal=supremum(lambda angle: self._size(self.state(angle).normal), knots),
            torque=supremum(torque, knots),
            back_torque=infimum(torque, knots),
            rms=math.sqrt(integral(lambda angle: torque(angle) ** 2, knots) / TURN),
            pressure=None if self.contact.follower == "knife" else supremum(pressure, knots),
        )

    def _size(self, normal: FloatArray) -> FloatArray:
        """Magnitude of the contact force [N]; below 0 only a cam that drives in both directions has contact."""
        return np.asarray(np.abs(normal) if self.contact.led else np.maximum(normal, 0.0))

    def _force(self, trace: CamTrace, force: FloatArray, radius: float) -> ContactForce:
        """Contact force and torque; radius: prime radius of the cam [m].

        A developed cam moves perpendicular to the follower: N = F / (cos mu - mu_g |sin mu| sign(s')) and
        T = N rho sin mu.
        """
        contact = self.contact
        if not contact.laid_flat:
            sliding = 0.0 if contact.follower == "roller" else contact.sliding
            touch = ContactPoint(trace.surface, trace.normal, self._direction(trace))
            return contact_force(touch, trace.motion.ds, force, sliding=sliding, guide=contact.guide)
        sense = np.where(force < 0, -1.0, 1.0) * np.sign(trace.motion.ds)
        cosine, sine = np.cos(trace.pressure_angle), np.sin(trace.pressure_angle)
        along = cosine - contact.guide * np.abs(sine) * sense
        with np.errstate(divide="ignore", invalid="ignore"):
            normal = np.where(along > 0, force / along, np.nan)
        return ContactForce(np.asarray(normal), np.asarray(normal * radius * sine), np.asarray(along))

    def _direction(self, trace: CamTrace) -> ComplexArray:
        """Velocity of the follower at the point of contact by its coordinate, in the cam's frame."""
        along = trace.normal * np.exp(-1j * trace.pressure_angle)
        if self.contact.pivot is None:
            return np.asarray(along)
        pivot = self.contact.pivot * unit(-trace.angle)
        turned = np.sign(dot(along, 1j * (trace.pitch - pivot)))
        return np.asarray(turned * 1j * (trace.surface - pivot))

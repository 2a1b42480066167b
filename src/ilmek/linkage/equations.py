"""Loop equations of joints and inputs, with their exact derivatives.

An equation c(poses, t) = 0 is differentiated twice along the motion:

    c'  = sum over bodies (J_x x' + J_y y' + J_theta theta') - input's rate                  = 0
    c'' = the same sum over accelerations + bias(poses, velocities) - input's second rate    = 0

A pose is the world position of a body's origin (x + i y) and its direction. The error of an angle
is its sine, which near the solution is the error itself [Nikravesh, Computer-Aided Analysis of Mechanical Systems,
chapter 3].
"""

from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexField, RealField
from ilmek.linkage.body_jerk import carried_jerk
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.groups.group import Group, InputMotion, Known
from ilmek.linkage.model import Coupling, Joint, Mechanism, Pin, Rotation, Slide
from ilmek.plane.vectors import dot
from ilmek.records import record

Row: TypeAlias = dict[str, tuple[RealField, RealField, RealField]]
"""Derivatives of one equation by x, y [1/m] and theta [1/rad] of each body in it."""


@record
class Equation:
    """One scalar loop equation in the present poses: value, derivatives, bias, and the first to third rates of its
    input.

    length  1 if its value is a length, 0 if it is an angle
    """

    value: RealField
    row: Row
    bias: RealField
    rate: RealField = 0.0
    second_rate: RealField = 0.0
    third_rate: RealField = 0.0
    length: int = 1


def pin_equations(mechanism: Mechanism, pin: Pin, bodies: Known) -> list[Equation]:
    """P_first - P_second = 0 [m], in x and in y."""
    p, q = (bodies[body] for body in pin.bodies)
    r, s = (bodies[body].direction * mechanism.point(body, pin.name) for body in pin.bodies)
    gap = p.anchor.position + r - q.anchor.position - s
    bias = q.omega**2 * s - p.omega**2 * r
    return [
        Equation(gap.real, {pin.first: (1, 0, -r.imag), pin.second: (-1, 0, s.imag)}, bias.real),
        Equation(gap.imag, {pin.first: (0, 1, r.real), pin.second: (0, -1, -s.real)}, bias.imag),
    ]


def slide_equations(mechanism: Mechanism, slide: Slide, bodies: Known) -> list[Equation]:
    """D x f = 0 [m] and theta_body - theta_guide - turned = 0 [rad], D from the guide's point to the body's along f."""
    across = _along(mechanism, slide, bodies, 1j)
    return [across, _angle(slide.body, slide.guide, slide.turned, bodies)]


def displacement_equation(mechanism: Mechanism, slide: Slide, drive: InputMotion, bodies: Known) -> Equation:
    """D . f - s = 0 of a driven slide; s [m] is the input."""
    along = _along(mechanism, slide, bodies, 1)
    return Equation(along.value - drive.value, along.row, along.bias, drive.speed, drive.acceleration, drive.jerk)


def rotation_equation(mechanism: Mechanism, entry: Rotation, drive: InputMotion, bodies: Known) -> Equation:
    """theta_body - theta_carrier - input = 0 [rad] of a driven pin."""
    first, second = mechanism.joint(entry.about).bodies
    carrier = second if entry.body == first else first
    equation = _angle(entry.body, carrier, drive.value, bodies)
    return Equation(equation.value, equation.row, equation.bias, drive.speed, drive.acceleration, drive.jerk, length=0)


def coupling_equation(mechanism: Mechanism, coupling: Coupling, near: RealField, bodies: Known) -> Equation:
    """q_second - second_at - f(q_first - first_at) = 0; near: q_first [rad] to within half a turn."""
    (first, _), (second, point) = coupling.ends
    turned = angle_near(bodies[first].direction, bodies[coupling.carrier].direction, near) - coupling.first_at
    value, ratio, second_ratio, _ = coupling.transfer(turned)
    required = coupling.second_at + value
    joint = mechanism.joint(point) if coupling.slides else None
    share: RealField = 1.0
    if isinstance(joint, Slide):
        equation = _along(mechanism, joint, bodies, 1)
        error, length = equation.value - required, 1
    else:
        equation = _angle(second, coupling.carrier, required, bodies)
        share, error, length = equation.row[second][2], equation.value, 0
    row, geared = dict(equation.row), share * ratio
    x, y, spin = row[coupling.carrier]
    row |= {first: (0, 0, -geared), coupling.carrier: (x, y, spin + geared)}
    bent = second_ratio * (bodies[first].omega - bodies[coupling.carrier].omega) ** 2
    return Equation(error, row, (equation.bias if length else 0.0) - bent, length=length)


def _bent_third(coupling: Coupling, bodies: Known) -> RealField:
    """F''' q_1'^3 + 3 f'' q_1' q_1'' of a coupling's first body."""
    first, carrier = bodies[coupling.first[0]], bodies[coupling.carrier]
    _, _, second, third = coupling.transfer(angle_near(first.direction, carrier.direction, 0.0) - coupling.first_at)
    speed, acceleration = first.omega - carrier.omega, first.alpha - carrier.alpha
    return third * speed**3 + 3 * second * speed * acceleration


def third_biases(group: Group, bodies: Known) -> list[RealField]:
    """Bias of the third rates: their values at zero jerks of the bodies; in the order of joints, inputs, couplings."""
    mechanism = group.mechanism
    biases: list[RealField] = []
    for joint in group.joints:
        if isinstance(joint, Pin):
            first, second = (_arm_jerk(bodies[body], mechanism.point(body, joint.name)) for body in joint.bodies)
            biases += [(first - second).real, (first - second).imag]
        else:
            biases += [_along_third(mechanism, joint, bodies, 1j), 0.0]
    driven: list[tuple[Joint | None, RealField]] = [(mechanism.joint(entry.joint), 0.0) for entry in group.inputs]
    driven += [
        (mechanism.joint(coupling.ends[1][1]) if coupling.slides else None, _bent_third(coupling, bodies))
        for coupling in group.couplings
    ]
    for one, bent in driven:
        biases.append((_along_third(mechanism, one, bodies, 1) if isinstance(one, Slide) else 0.0) - bent)
    return biases


def _arm_jerk(body: BodyMotion, local: complex) -> ComplexField:
    return carried_jerk(0j, body.direction * local, body.omega, body.alpha, 0.0)


def _along_third(mechanism: Mechanism, slide: Slide, bodies: Known, quarter: complex) -> RealField:
    """Third rate of D . f at zero jerks of the bodies: the product rule of D and f, three times."""
    body, guide = bodies[slide.body], bodies[slide.guide]
    p, q = body.carry(mechanism.point(slide.body, slide.name)), guide.carry(mechanism.point(slide.guide, slide.name))
    f, w = guide.direction * np.exp(1j * slide.along) * quarter, guide.omega
    thrown = _arm_jerk(body, mechanism.point(slide.body, slide.name))
    thrown = thrown - _arm_jerk(guide, mechanism.point(slide.guide, slide.name))
    return (
        dot(carried_jerk(0j, f, w, guide.alpha, 0.0), p.position - q.position)
        + 3 * dot((1j * guide.alpha - w * w) * f, p.velocity - q.velocity)
        + 3 * dot(1j * w * f, p.acceleration - q.acceleration)
        + dot(f, thrown)
    )


def angle_near(direction: ComplexField, against: ComplexField, near: RealField) -> RealField:
    """Angle [rad] from one direction to another, within half a turn of `near`."""
    turned: RealField = near + np.angle(direction * np.conj(against) * np.exp(-1j * np.asarray(near)))
    return turned


def travel(mechanism: Mechanism, slide: Slide, bodies: Known) -> RealField:
    """Displacement s = D . f [m] of a slide in the present poses."""
    return _along(mechanism, slide, bodies, 1).value


def relative_angle(mechanism: Mechanism, entry: Rotation, bodies: Known) -> RealField:
    """Angle [rad] of a driven body against the other body at its pin, in the present poses."""
    first, second = mechanism.joint(entry.about).bodies
    carrier = second if entry.body == first else first
    turned: RealField = np.angle(bodies[entry.body].direction * np.conj(bodies[carrier].direction))
    return turned


def _along(mechanism: Mechanism, slide: Slide, bodies: Known, quarter: complex) -> Equation:
    """D . f for f along the line (quarter = 1) or square to it (quarter = i), without an input."""
    body, guide = bodies[slide.body], bodies[slide.guide]
    r = body.direction * mechanism.point(slide.body, slide.name)
    s = guide.direction * mechanism.point(slide.guide, slide.name)
    f = guide.direction * np.exp(1j * slide.along) * quarter
    separation = body.anchor.position + r - guide.anchor.position - s
    parting = _velocity(body, r) - _velocity(guide, s)
    spin = guide.omega
    bias = dot(f, spin**2 * s - body.omega**2 * r) + 2 * dot(1j * spin * f, parting) - spin**2 * dot(f, separation)
    row: Row = {
        slide.body: (f.real, f.imag, dot(f, 1j * r)),
        slide.guide: (-f.real, -f.imag, dot(1j * f, separation) - dot(f, 1j * s)),
    }
    return Equation(dot(f, separation), row, bias)


def _angle(body: str, against: str, angle: RealField, bodies: Known) -> Equation:
    """sin(theta_body - theta_against - angle), without an input."""
    error = bodies[body].direction * np.conj(bodies[against].direction * np.exp(1j * np.asarray(angle)))
    bias = -error.imag * (bodies[body].omega - bodies[against].omega) ** 2
    return Equation(error.imag, {body: (0, 0, error.real), against: (0, 0, -error.real)}, bias, length=0)


def _velocity(body: BodyMotion, arm: ComplexField) -> ComplexField:
    return body.anchor.velocity + 1j * body.omega * arm

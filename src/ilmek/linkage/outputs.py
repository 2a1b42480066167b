"""Outputs of a mechanism: scalar functions of its bodies' poses, with exact rates.

    y = y(poses),    y' = sum over bodies (y_x x' + y_y y' + y_theta theta'),    y'' = the same sum of x'' + bias

An output has the form of a loop equation (see `equations` and its source [Nikravesh, chapter 3]), so that the same
methods apply.

>>> from ilmek.linkage.fourbar import slider_crank
>>> from ilmek.linkage.solve import solve
>>> from ilmek.linkage.structure import plan
>>> motion = solve(plan(slider_crank(0.1, 0.3, branch=+1)), np.array([0.0, np.pi / 2]), 1.0)
>>> output_history(motion, Travel("line")).rate.round(6)
array([ 0. , -0.1])
"""

import math
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from ilmek.arrays import Float
from ilmek.errors import MechanismError, did_you_mean
from ilmek.linkage.displacements import at_origins, contracted
from ilmek.linkage.equations import Equation, Row, displacement_equation
from ilmek.linkage.groups.group import InputMotion, Known
from ilmek.linkage.model import GROUND, Mechanism, Slide
from ilmek.linkage.motion import Motion
from ilmek.plane.vectors import dot, unit
from ilmek.records import record


@runtime_checkable
class Output(Protocol):
    """A scalar of a mechanism's poses."""

    @property
    def location(self) -> str:
        """Name of the point or slide whose dimensions act on the output directly; "" for none."""

    def equation(self, mechanism: Mechanism, bodies: Known) -> Equation:
        """Its value, derivatives by the bodies' poses and bias; `bodies` are anchored at their origins."""


@dataclass(frozen=True, slots=True)
class RelativeAngle:
    """The angle [rad] of a body's frame against another's, in (-pi, pi]."""

    body: str
    against: str = GROUND

    @property
    def location(self) -> str:
        """None: a body turns as a whole."""
        return ""

    def equation(self, mechanism: Mechanism, bodies: Known) -> Equation:
        """theta_body - theta_against."""
        for name in (self.body, self.against):
            mechanism.body(name)
        turned = np.angle(bodies[self.body].direction * np.conj(bodies[self.against].direction))
        return Equation(turned, {self.body: (0, 0, 1), self.against: (0, 0, -1)}, 0.0, length=0)


@dataclass(frozen=True, slots=True)
class Coordinate:
    """The world coordinate [m] of a body's point in the direction `along` [rad]: 0 for x, pi/2 for y."""

    body: str
    point: str
    along: float = 0.0

    @property
    def location(self) -> str:
        """The point."""
        return self.point

    def equation(self, mechanism: Mechanism, bodies: Known) -> Equation:
        """Coordinate u . (a + r) with the unit direction u."""
        body, u = bodies[self.body], unit(self.along)
        r = body.direction * mechanism.point(self.body, self.point)
        row: Row = {self.body: (u.real, u.imag, dot(u, 1j * r))}
        return Equation(dot(u, body.anchor.position + r), row, -(body.omega**2) * dot(u, r))


@dataclass(frozen=True, slots=True)
class Travel:
    """The displacement s [m] of a slide, from the guide's point along the line."""

    slide: str

    @property
    def location(self) -> str:
        """The slide."""
        return self.slide

    def equation(self, mechanism: Mechanism, bodies: Known) -> Equation:
        """D . f, as for a driven slide. Raises MechanismError where the joint is a pin."""
        joint = mechanism.joint(self.slide)
        if not isinstance(joint, Slide):
            raise MechanismError(f"{self.slide!r} is not a slide", allowed="a travel is that of a slide")
        return displacement_equation(mechanism, joint, InputMotion(0.0, 0.0, 0.0), bodies)


AXES = {"x": 0.0, "y": math.pi / 2}
"""Directions of the coordinates of a point [rad]."""


def output_named(mechanism: Mechanism, name: str) -> Output:
    """The output of a name: "rocker" the angle of a body, "coupler.P x" a coordinate of a point, "S" a slide's travel.

    Raises MechanismError, with the nearest, for a name of none.

    >>> from ilmek.linkage.fourbar import slider_crank
    >>> press = slider_crank(0.1, 0.3, branch=+1)
    >>> [type(output_named(press, name)).__name__ for name in ("rod", "rod.B y", "line")]
    ['RelativeAngle', 'Coordinate', 'Travel']
    """
    named: dict[str, Output] = {
        joint.name: Travel(joint.name) for joint in mechanism.joints if isinstance(joint, Slide)
    }
    named |= {body: RelativeAngle(body) for body in mechanism.moving}
    for body in mechanism.moving:
        for point in mechanism.body(body).points:
            named |= {f"{body}.{point} {axis}": Coordinate(body, point, along) for axis, along in AXES.items()}
    if name not in named:
        hint = did_you_mean(name, named, otherwise=f"one of {', '.join(list(named)[:12])}, ...")
        raise MechanismError(f"{mechanism.name} has no output {name!r}", do=hint)
    return named[name]


@record
class OutputHistory:
    """An output over a motion: value [rad or m], rate and second rate at each sample; an angle is unwrapped."""

    value: Float[np.ndarray, " samples"]
    rate: Float[np.ndarray, " samples"]
    second_rate: Float[np.ndarray, " samples"]


def output_history(motion: Motion, output: Output) -> OutputHistory:
    """Value [m or rad] and rates [by s, s²] of an output over a motion, (samples,); NaN where it does not close."""
    mechanism = motion.plan.mechanism
    bodies = {body.name: motion.body(body.name) for body in mechanism.bodies}
    with np.errstate(invalid="ignore", over="ignore"):  # at a dead centre rates are infinite; `status` says so
        return output_history_of_bodies(mechanism, bodies, output)


def output_history_of_bodies(mechanism: Mechanism, bodies: Known, output: Output) -> OutputHistory:
    """Value and rates of an output from the bodies' motions, (samples,); rates by the parameter of the motions."""
    bodies = at_origins(bodies)
    equation = output.equation(mechanism, bodies)
    rates = {name: (body.anchor.velocity, body.omega) for name, body in bodies.items()}
    seconds = {name: (body.anchor.acceleration, body.alpha) for name, body in bodies.items()}
    # A body that only translates has one direction and many positions.
    shape = np.broadcast_shapes(
        *(np.shape(field) for body in bodies.values() for field in (body.direction, body.anchor.position))
    )
    value, rate, second = (
        np.array(np.broadcast_to(field, shape), dtype=float)
        for field in (
            equation.value,
            contracted(equation.row, rates),
            contracted(equation.row, seconds) + equation.bias,
        )
    )
    if not equation.length:
        closed = np.isfinite(value)
        value[closed] = np.unwrap(value[closed])
    return OutputHistory(value, rate, second)

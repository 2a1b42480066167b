"""Any group without a closed form: Newton's method on its loop equations.

    J(x) dx = -c(x) to convergence;    J x' = input rates;    J x'' = second input rates - bias

The start is a motion of the group's own bodies, given by `solve` with the known motions; see `newton_starts`.
Angles are scaled to lengths by the group's size, so that the condition of J does not depend on units [Nikravesh,
Computer-Aided Analysis of Mechanical Systems, chapter 3].
"""

from collections.abc import Callable, Mapping
from dataclasses import field, replace
from typing import ClassVar

import numpy as np

from ilmek.arrays import ComplexField, FloatArray, RealField
from ilmek.linkage import equations
from ilmek.linkage.anchors import anchors
from ilmek.linkage.body_jerk import BodyJerk
from ilmek.linkage.body_motion import BodyMotion, PointMotion
from ilmek.linkage.equations import Equation
from ilmek.linkage.groups.group import Columns, Group, GroupSolution, InputMotion, Known, KnownJerks, Step
from ilmek.linkage.groups.winding import LinearRelation, angles, first_angle
from ilmek.linkage.model import Body, Pin, Rotation, Slide
from ilmek.num.linear import reciprocal_condition, solve_many
from ilmek.num.newton import System, damped_newton, newton
from ilmek.records import value_record

TOLERANCE = 1e-9
"""Last step of the iteration relative to the group's size; quadratic convergence leaves an error at rounding."""


@value_record
class GeneralGroup(Step):
    """A group of any class; all its loop equations are solved together.

    group      with every body's frame at its anchor, if it has one
    scale      its size [m]
    relations  of the angles determined by inputs and couplings alone, by body
    anchors    body -> its anchor in its own frame [m]; default: the origin
    """

    kind: ClassVar[str] = "general"

    group: Group
    scale: float
    relations: Mapping[str, LinearRelation] = field(default_factory=dict, compare=False)
    anchors: Mapping[str, complex] = field(default_factory=dict, compare=False)

    @property
    def bodies(self) -> tuple[str, ...]:
        """All bodies of the group."""
        return self.group.bodies

    @property
    def parents(self) -> tuple[str, ...]:
        """The bodies to which it is attached."""
        return self.group.parents

    @property
    def description(self) -> str:
        """Description of the step for users."""
        joints = ", ".join(joint.name for joint in self.group.joints)
        return f"{', '.join(self.bodies)} with joints {joints}: Newton's method on the loop equations"

    @property
    def failure(self) -> str:
        """Name of the Status of a sample that it cannot solve."""
        return "NOT_CONVERGED"

    @property
    def lengths(self) -> tuple[float, ...]:
        """The largest distance of a body's point from its anchor, for every body [m]."""
        points = (self.group.mechanism.body(body).points.values() for body in self.bodies)
        return tuple(max((abs(point) for point in one), default=0.0) for one in points)

    def gap(self, known: Known) -> RealField:  # noqa: ARG002 - common signature
        """NaN: the iteration has no measure of the gap."""
        return np.nan

    def solve(self, known: Known, drives: Mapping[str, InputMotion]) -> GroupSolution:
        """Directions, rates and anchors of all bodies, starting from their motions in `known`."""
        posed, matrix = self._posed(known, drives)
        return self._rates(known, posed, drives, matrix)

    def disturbed(self, known: Known, drives: Mapping[str, InputMotion], noise: FloatArray) -> GroupSolution:
        """The solution with residuals `noise` [m], one number per equation, left in the loop equations."""
        posed, matrix = self._posed(known, drives)
        step = solve_many(matrix, np.broadcast_to(noise, matrix.shape[:-1]))
        posed = self._parents_at(known) | self._moved(posed, step)
        return self._rates(known, posed, drives, self._matrix(self.equations(posed, drives), matrix.shape[:-2]))

    def _posed(self, known: Known, drives: Mapping[str, InputMotion]) -> tuple[dict[str, BodyMotion], FloatArray]:
        """The bodies at rest in their poses, with the parents, and the matrix there."""
        samples = np.broadcast_shapes(*(np.shape(drive.value) for drive in drives.values()))
        at, system = self._system(known, drives, samples)
        x = newton(system, np.zeros((*samples, 3 * len(self.bodies))), tolerance=TOLERANCE * self.scale)
        posed = at(x)
        return posed, self._matrix(self.equations(posed, drives), samples)

    def settled(self, known: Known, drives: Mapping[str, InputMotion]) -> dict[str, BodyMotion]:
        """The bodies at rest, assembled from a rough start in `known` at one sample; NaN where that fails."""
        at, system = self._system(known, drives, ())
        x = damped_newton(system, np.zeros(3 * len(self.bodies)), tolerance=TOLERANCE * self.scale)
        posed = at(x)
        if not upright(self.equations(posed, drives)):
            posed = at(np.full_like(x, np.nan))
        return {body: replace(posed[body], at=self._anchor(body)) for body in self.bodies}

    def _parents_at(self, known: Known) -> dict[str, BodyMotion]:
        return {body: self._still(known, body) for body in self.parents}

    def _system(
        self, known: Known, drives: Mapping[str, InputMotion], samples: tuple[int, ...]
    ) -> tuple[Callable[[FloatArray], dict[str, BodyMotion]], System]:
        """Displacements of the bodies from their start -> the bodies; -> values and derivatives of the equations."""
        start = {body: self._still(known, body) for body in self.bodies}
        fixed = self._parents_at(known)

        def at(x: FloatArray) -> dict[str, BodyMotion]:
            return fixed | self._moved(start, x)

        def system(x: FloatArray) -> tuple[FloatArray, FloatArray]:
            found = self.equations(at(x), drives)
            return _stack([equation.value * self._unit(equation) for equation in found], samples), self._matrix(
                found, samples
            )

        return at, system

    def locate(self, known: Known, columns: Mapping[str, Columns]) -> Mapping[str, BodyMotion]:  # noqa: ARG002
        """The bodies at their anchors."""
        return {
            body: BodyMotion(PointMotion(*columns[body][3:]), self._anchor(body), *columns[body][:3])
            for body in self.bodies
        }

    @staticmethod
    def in_world(columns: Mapping[str, Columns], origin: complex) -> dict[str, Columns]:
        """The columns of a solution about the ground's anchor, in the ground's frame, where that is at `origin` [m]."""
        return {body: (*fields[:3], fields[3] + origin, *fields[4:]) for body, fields in columns.items()}

    def equations(self, bodies: Known, drives: Mapping[str, InputMotion]) -> list[Equation]:
        """The group's loop equations in the poses and at the velocities of `bodies`, anchored at their origins."""
        mechanism, loop_equations = self.group.mechanism, []
        for joint in self.group.joints:
            if isinstance(joint, Pin):
                loop_equations += equations.pin_equations(mechanism, joint, bodies)
            else:
                loop_equations += equations.slide_equations(mechanism, joint, bodies)
        for entry in self.group.inputs:
            joint, drive = mechanism.joint(entry.joint), drives[entry.name]
            if isinstance(entry, Rotation):
                loop_equations.append(equations.rotation_equation(mechanism, entry, drive, bodies))
            elif isinstance(joint, Slide):
                loop_equations.append(equations.displacement_equation(mechanism, joint, drive, bodies))
        for coupling in self.group.couplings:
            near = first_angle(coupling, self.relations, drives)
            loop_equations.append(equations.coupling_equation(mechanism, coupling, near, bodies))
        return loop_equations

    def _rates(
        self, known: Known, posed: Known, drives: Mapping[str, InputMotion], matrix: FloatArray
    ) -> GroupSolution:
        """Velocities, then accelerations: the same matrix twice."""
        samples = matrix.shape[:-2]
        moving = dict(posed) | {body: self._anchored(known[body], body) for body in self.parents}
        loop_equations = self.equations(moving, drives)
        speeds = {body: (moving[body].anchor.velocity, moving[body].omega) for body in self.parents}
        demand = [(equation.rate - _share(equation, speeds)) * self._unit(equation) for equation in loop_equations]
        v = solve_many(matrix, _stack(demand, samples))
        moving |= {body: self._with_velocity(posed[body], v, k) for k, body in enumerate(self.bodies)}
        loop_equations = self.equations(moving, drives)
        gains = {body: (moving[body].anchor.acceleration, moving[body].alpha) for body in self.parents}
        demand = [
            (equation.second_rate - equation.bias - _share(equation, gains)) * self._unit(equation)
            for equation in loop_equations
        ]
        a = solve_many(matrix, _stack(demand, samples))
        columns = {body: self._columns(moving[body], a, k) for k, body in enumerate(self.bodies)}
        return GroupSolution(columns, reciprocal_condition(matrix))

    def jerk(
        self,
        known: KnownJerks,
        located: Known,
        columns: Mapping[str, Columns],  # noqa: ARG002 - common signature
        drives: Mapping[str, InputMotion],
    ) -> Mapping[str, BodyJerk]:
        """Jerks of the bodies: the matrix of `solve` with the right side of the third rates."""
        motions = dict(located) | {body: known[body].motion for body in self.parents}
        moving = {body: self._anchored(motion, body) for body, motion in motions.items()}
        shapes = (np.shape(field) for body in moving.values() for field in (body.direction, body.alpha))
        samples = np.broadcast_shapes(*shapes)
        loop_equations = self.equations(moving, drives)
        biases = equations.third_biases(self.group, moving)
        jerks = {body: (known[body].carry(self._anchor(body)), known[body].beta) for body in self.parents}
        demand = [
            (one.third_rate - bias - _share(one, jerks)) * self._unit(one)
            for one, bias in zip(loop_equations, biases, strict=True)
        ]
        x = solve_many(self._matrix(loop_equations, samples), _stack(demand, samples))
        return {
            body: BodyJerk(located[body], x[..., 3 * k] + 1j * x[..., 3 * k + 1], x[..., 3 * k + 2] / self.scale)
            for k, body in enumerate(self.bodies)
        }

    def _anchor(self, body: str) -> complex:
        return self.anchors.get(body, 0j)

    def _anchored(self, motion: BodyMotion, body: str) -> BodyMotion:
        """The same motion in the frame at the body's anchor."""
        return BodyMotion(motion.carry(self._anchor(body)), 0j, motion.direction, motion.omega, motion.alpha)

    def _still(self, known: Known, body: str) -> BodyMotion:
        """The pose alone, in the frame at the body's anchor."""
        position, direction = known[body].carry(self._anchor(body)).position, known[body].direction
        return BodyMotion(PointMotion(position, 0j, 0j), 0j, direction, 0.0, 0.0)

    def _unit(self, equation: Equation) -> float:
        return 1.0 if equation.length else self.scale

    def _matrix(self, loop_equations: list[Equation], samples: tuple[int, ...]) -> FloatArray:
        """Derivatives by (x, y, scale theta) of the group's bodies."""
        size = 3 * len(self.bodies)
        matrix = np.zeros((*samples, size, size))
        for i, one in enumerate(loop_equations):
            for k, body in enumerate(self.bodies):
                if body in one.row:
                    for j, (slope, per) in enumerate(zip(one.row[body], (1, 1, self.scale), strict=True)):
                        matrix[..., i, 3 * k + j] = slope * self._unit(one) / per
        return matrix

    def _moved(self, start: Known, x: FloatArray) -> dict[str, BodyMotion]:
        """The bodies displaced by x from the start, at rest."""
        moved = {}
        for k, body in enumerate(self.bodies):
            shift, turn = x[..., 3 * k] + 1j * x[..., 3 * k + 1], x[..., 3 * k + 2] / self.scale
            position = start[body].anchor.position + shift
            rest = np.zeros_like(turn)
            anchor = PointMotion(position, 0j, 0j)
            moved[body] = BodyMotion(anchor, 0j, start[body].direction * np.exp(1j * turn), rest, rest)
        return moved

    def _with_velocity(self, body: BodyMotion, v: FloatArray, k: int) -> BodyMotion:
        anchor = PointMotion(body.anchor.position, v[..., 3 * k] + 1j * v[..., 3 * k + 1], 0j)
        return BodyMotion(anchor, 0j, body.direction, v[..., 3 * k + 2] / self.scale, body.alpha)

    def _columns(self, body: BodyMotion, a: FloatArray, k: int) -> Columns:
        acceleration, alpha = a[..., 3 * k] + 1j * a[..., 3 * k + 1], a[..., 3 * k + 2] / self.scale
        return body.direction, body.omega, alpha, body.anchor.position, body.anchor.velocity, acceleration

    @classmethod
    def recognise(cls, group: Group) -> Step:
        """Any group as a step for Newton's method, with every body's frame at its anchor."""
        at = anchors(group.mechanism)
        bodies = (
            Body(body.name, {name: point - at[body.name] for name, point in body.points.items()})
            for body in group.mechanism.bodies
        )
        known = angles(group.mechanism) if group.couplings else {}
        local = replace(group, mechanism=replace(group.mechanism, bodies=tuple(bodies)))
        return cls(local, group.span, known, at)


def upright(loop_equations: list[Equation]) -> bool:
    """Whether no angle is off by half a turn: there its equation, a sine, is solved too."""
    return all(np.all(next(iter(equation.row.values()))[2] > 0) for equation in loop_equations if not equation.length)


def _share(one: Equation, rates: Mapping[str, tuple[ComplexField, RealField]]) -> RealField:
    """Contribution of the known bodies to an equation's rate, from the rates of their origins and angles."""
    share: RealField = 0.0
    for body, (move, turn) in rates.items():
        if body in one.row:
            dx, dy, dtheta = one.row[body]
            share = share + dx * move.real + dy * move.imag + dtheta * turn
    return share


def _stack(values: list[RealField], samples: tuple[int, ...]) -> FloatArray:
    return np.stack([np.broadcast_to(np.asarray(value, dtype=float), samples) for value in values], axis=-1)

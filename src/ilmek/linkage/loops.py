"""All loop equations of a mechanism, joint by joint, and the displacements of the bodies that satisfy them.

    J dx = right side        x: the poses (x, y, theta) of all moving bodies

Angles are measured in lengths (times the mechanism's size), so that the condition of J is free of units.
[Nikravesh, Computer-Aided Analysis of Mechanical Systems, chapter 3]
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.linkage.body_motion import STILL
from ilmek.linkage.displacements import Moves
from ilmek.linkage.equations import Equation
from ilmek.linkage.groups.general import GeneralGroup
from ilmek.linkage.groups.group import Group, InputMotion, Known
from ilmek.linkage.groups.winding import angles
from ilmek.linkage.model import Mechanism


@dataclass(frozen=True, slots=True)
class Loops:
    """The loop equations of a whole mechanism, one block per joint and per input, by the name of the joint.

    scale  the mechanism's size [m]      joints  the joint of each equation
    """

    mechanism: Mechanism
    scale: float
    blocks: tuple[tuple[str, GeneralGroup], ...]
    joints: tuple[str, ...]

    def equations(self, seen: Callable[[str], Known], drives: Mapping[str, InputMotion]) -> list[Equation]:
        """All equations; `seen` gives the bodies, anchored at their origins, for the equations of each joint."""
        return [equation for joint, block in self.blocks for equation in block.equations(seen(joint), drives)]

    def matrix(self, equations: list[Equation], samples: tuple[int, ...]) -> FloatArray:
        """J: derivatives by x, y and (scale theta) of all moving bodies."""
        moving = self.mechanism.moving
        matrix = np.zeros((*samples, len(equations), 3 * len(moving)))
        for i, one in enumerate(equations):
            for k, body in enumerate(moving):
                for j, slope in enumerate(one.row.get(body, ())):
                    matrix[..., i, 3 * k + j] = slope * (self.unit(one) / (1 if j < 2 else self.scale))
        return matrix

    def column(self, equations: list[Equation], values: list[RealField], samples: tuple[int, ...]) -> FloatArray:
        """A right side; angles are scaled to lengths as in J."""
        scaled = [
            np.broadcast_to(value * self.unit(one), samples) for one, value in zip(equations, values, strict=True)
        ]
        return np.stack(scaled, axis=-1)

    def moves(self, x: FloatArray) -> Moves:
        """Displacements of the bodies from a solution of J x = right side."""
        return {
            body: (x[..., 3 * k] + 1j * x[..., 3 * k + 1], x[..., 3 * k + 2] / self.scale)
            for k, body in enumerate(self.mechanism.moving)
        }

    def unit(self, one: Equation) -> float:
        """Factor of an equation: 1 for a length, the mechanism's size [m] for an angle."""
        return 1.0 if one.length else self.scale


def loops(mechanism: Mechanism) -> Loops:
    """The loop equations [m; rad] of a mechanism, in the order of joints, couplings, inputs."""
    whole = Group(mechanism, mechanism.moving, mechanism.joints, mechanism.inputs)
    scale = whole.reach
    joints = [(joint.name, Group(mechanism, mechanism.moving, (joint,), ())) for joint in mechanism.joints]
    inputs = [(one.joint, Group(mechanism, mechanism.moving, (), (one,))) for one in mechanism.inputs]
    couplings = [
        (coupling.name, Group(mechanism, mechanism.moving, (), (), (coupling,))) for coupling in mechanism.couplings
    ]
    known = angles(mechanism) if couplings else {}
    blocks = tuple((name, GeneralGroup(group, scale, known)) for name, group in joints + couplings + inputs)
    at_rest = {body.name: STILL for body in mechanism.bodies}
    drives = {entry.name: InputMotion(0.0, 0.0, 0.0) for entry in mechanism.inputs}
    counted = tuple(name for name, block in blocks for _ in block.equations(at_rest, drives))
    return Loops(mechanism, scale, blocks, counted)

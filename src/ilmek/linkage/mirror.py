"""A mechanism of pins and one crank, its mirror image in an upright line, and both coupled 1:-1 by equal gears."""

import math

from ilmek.linkage.model import GROUND, Body, Coupling, Mechanism, Pin, Rotation
from ilmek.plane.teeth import PRESSURE_ANGLE

GEARS = "gears"
"""Name of the coupling of both cranks."""


def other(name: str) -> str:
    """The name of a body or point of the mirror image."""
    return f"{name} *"


def mirrored(mechanism: Mechanism, mirror: float) -> Mechanism:
    """The mirror image of a mechanism in the upright line x = mirror [m], its bodies' frames turned the other way."""
    ground = {other(name): 2 * mirror - point.conjugate() for name, point in mechanism.body(GROUND).points.items()}
    return Mechanism(
        name=other(mechanism.name),
        bodies=(
            Body(GROUND, ground),
            *(
                Body(other(body.name), {other(name): point.conjugate() for name, point in body.points.items()})
                for body in mechanism.bodies
                if body.name != GROUND
            ),
        ),
        joints=tuple(
            Pin(other(pin.name), *(name if name == GROUND else other(name) for name in pin.bodies))
            for pin in mechanism.joints
        ),
        inputs=tuple(Rotation(other(crank.body), other(crank.about)) for crank in _cranks(mechanism)),
        branches={other(name): -branch for name, branch in mechanism.branches.items()},
    )


def coupled(mechanism: Mechanism, mirror: float, pressure_angle: float = PRESSURE_ANGLE) -> Mechanism:
    """Both sides, mirrored in x = mirror [m], as one mechanism: equal gears drive the second crank from the first.

    pressure_angle  of the gears' teeth at the pitch point [rad]

    The first crank at 0 meets the second at half a turn: mirror images of one another at every angle.
    """
    image = mirrored(mechanism, mirror)
    ground = {**mechanism.body(GROUND).points, **image.body(GROUND).points}
    moving = [body for side in (mechanism, image) for body in side.bodies if body.name != GROUND]
    (crank,) = _cranks(mechanism)
    second = other(crank.body), other(crank.about)
    mesh = Coupling(GEARS, "gears", (crank.body, crank.about), second, -1.0, 0.0, math.pi, GROUND, pressure_angle)
    return Mechanism(
        name=f"{mechanism.name} of two sides",
        bodies=(Body(GROUND, ground), *moving),
        joints=(*mechanism.joints, *image.joints),
        inputs=mechanism.inputs,
        branches={**mechanism.branches, **image.branches},
        couplings=(mesh,),
    )


def _cranks(mechanism: Mechanism) -> tuple[Rotation, ...]:
    return tuple(one for one in mechanism.inputs if isinstance(one, Rotation))

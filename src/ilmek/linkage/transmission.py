"""Force transmission of any mechanism: transmission angle, pressure angle at a slider, velocity ratio, advantage.

[Norton, Design of Machinery, chapter 6, for mechanical advantage; the rates by the input are those of `outputs`]
"""

from collections.abc import Iterator, Sequence

import numpy as np

from ilmek.arrays import ComplexField, Float, FloatArray
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Mechanism, Pin, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.one_input import OneInput
from ilmek.linkage.outputs import Output, output_history
from ilmek.plane.vectors import cross, dot, unit


def pressure_angle(motion: Motion, slide: str, link: str = "") -> Float[np.ndarray, " samples"]:
    """Acute angle [rad] between a slide's line and the link that drives its body; NaN where they do not close.

    0 is best; at pi/2 the link presses the body onto its guide. The force of a link with two pins and no other load is
    along the link.
    link  a body pinned to the sliding body, with a further pin; default: the only one. Its direction is that of the
          line from its first further pin
    Raises MechanismError for a pin instead of a slide, and for no such link or several.

    >>> from ilmek.linkage.fourbar import slider_crank
    >>> from ilmek.linkage.solve import solve
    >>> from ilmek.linkage.structure import plan
    >>> motion = solve(plan(slider_crank(0.1, 0.2, branch=+1)), np.array([0.0, np.pi / 2]))
    >>> np.degrees(pressure_angle(motion, "line")).round(9)
    array([ 0., 30.])
    """
    mechanism = motion.plan.mechanism
    joint = mechanism.joint(slide)
    if not isinstance(joint, Slide):
        raise MechanismError(f"{slide!r} is a pin", allowed="a pressure angle is at a slide")
    body, start, end = _pushing(mechanism, joint, link)
    rod = motion.direction(body) * (mechanism.point(body, end) - mechanism.point(body, start))
    line = motion.direction(joint.guide) * unit(joint.along)
    angle: Float[np.ndarray, " samples"] = np.arctan2(np.abs(cross(line, rod)), np.abs(dot(line, rod)))
    return angle


def transmission_angles(motion: Motion, pins: Sequence[str] = ()) -> dict[str, Float[np.ndarray, " samples"]]:
    """Acute transmission angle [rad] at free pins of dyads: pin -> one value per sample; NaN where it does not close.

    The angle between the two bodies of the dyad at their common pin: of a link the line from its other pin, of a slider
    the normal of its line. pi/2 is best, 0 a dead centre.
    pins  default: the free pins of all dyads. A pin of another group has the angle between its two links
    Raises MechanismError for a slide, an unknown pin, and a link with no other pin.    [Norton, section 4.10]

    >>> from ilmek.linkage.fourbar import slider_crank
    >>> from ilmek.linkage.solve import solve
    >>> from ilmek.linkage.structure import plan
    >>> motion = solve(plan(slider_crank(0.1, 0.2, branch=+1)), np.array([0.0, np.pi / 2]))
    >>> np.degrees(transmission_angles(motion)["B"]).round(9)
    array([90., 60.])
    """
    mechanism = motion.plan.mechanism
    free = dict(_free_pins(motion))
    for pin in pins:
        if not isinstance(mechanism.joint(pin), Pin):
            raise MechanismError(f"{pin!r} is a slide", allowed="a transmission angle is at a pin between two links")
    transmission_angles = {}
    for pin in pins or free:
        joint = mechanism.joint(pin)
        outer = free.get(pin, {})
        first, second = (_direction(motion, body, pin, outer.get(body)) for body in joint.bodies)
        angle = np.arctan2(np.abs(cross(first, second)), np.abs(dot(first, second)))
        transmission_angles[pin] = np.array(np.broadcast_to(angle, motion.status.shape))
    return transmission_angles


def _free_pins(motion: Motion) -> Iterator[tuple[str, dict[str, Pin | Slide]]]:
    """The free pin of each dyad, with the outer joint of each of its bodies."""
    driven = {entry.joint for entry in motion.plan.mechanism.inputs}
    known = {GROUND}
    for step in motion.plan.steps:
        own = set(step.bodies)
        joints = [
            joint
            for joint in motion.plan.mechanism.joints
            if own & set(joint.bodies) and set(joint.bodies) <= own | known and joint.name not in driven
        ]
        inner = [joint for joint in joints if set(joint.bodies) <= own]
        if len(own) == 2 and len(joints) == 3 and len(inner) == 1 and isinstance(inner[0], Pin):
            outer = [joint for joint in joints if joint is not inner[0]]
            yield inner[0].name, {body: joint for joint in outer for body in own & set(joint.bodies)}
        known |= own


def _direction(motion: Motion, body: str, pin: str, outer: Pin | Slide | None) -> ComplexField:
    """Direction of a body at its pin: the line from its outer pin, or the normal of its slide's line."""
    mechanism = motion.plan.mechanism
    if isinstance(outer, Slide):
        return motion.direction(outer.guide) * 1j * unit(outer.along)
    others = [
        joint for joint in mechanism.joints if isinstance(joint, Pin) and body in joint.bodies and joint.name != pin
    ]
    start = outer or next(iter(others), None)
    if start is None:
        raise MechanismError(f"body {body!r} of {mechanism.name} has no pin but {pin!r}", do="choose another pin")
    return motion.direction(body) * (mechanism.point(body, pin) - mechanism.point(body, start.name))


def velocity_ratio(moved: OneInput, output: Output, values: FloatArray) -> Float[np.ndarray, " samples"]:
    """Rate dy/dq [rad or m by rad or m] of an output at values of the input; NaN at dead centres and open samples.

    values  of the moving input [rad; m], shape (samples,), the shape of the result
    """
    return output_history(moved.motion(values), output).rate


def mechanical_advantage(moved: OneInput, output: Output, values: FloatArray) -> Float[np.ndarray, " samples"]:
    """Ratio of the output's force or torque to the input's, [N or N m by N or N m], without friction and weight.

    values  of the moving input [rad; m], shape (samples,), the shape of the result
    1 / velocity ratio, by virtual power. Negative where the output moves backwards; infinite at the output's dead
    centres, where the mechanism is a toggle.
    """
    with np.errstate(divide="ignore"):
        return 1.0 / velocity_ratio(moved, output, values)


def _pushing(mechanism: Mechanism, slide: Slide, link: str) -> tuple[str, str, str]:
    """The link that drives a slide's body, its far pin and its pin on the body."""
    pins = [joint for joint in mechanism.joints if isinstance(joint, Pin)]
    found = []
    for pin in pins:
        if slide.body in pin.bodies:
            other = next(body for body in pin.bodies if body != slide.body)
            further = [one.name for one in pins if other in one.bodies and one is not pin]
            found += [(other, further[0], pin.name)] if further and link in ("", other) else []
    if len(found) != 1:
        names = ", ".join(name for name, _, _ in found) or "none"
        raise MechanismError(
            f"links with two pins, one of them on {slide.body!r} of {mechanism.name}: {names}",
            allowed="the pressure angle is that of one link",
            do="name one of them" if found else "",
        )
    return found[0]

"""Force transmission of any mechanism: pressure angle at a slider, velocity ratio, mechanical advantage.

[Norton, Design of Machinery, chapter 6, for mechanical advantage; the rates by the input are those of `outputs`]
"""

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.errors import MechanismError
from ilmek.linkage.model import Mechanism, Pin, Slide
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

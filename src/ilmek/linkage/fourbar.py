"""The two common mechanisms, four-bar and slider-crank.

The crank's pivot is at the origin. Names of points and links:

    four-bar        crank A0-A, coupler A-B, rocker B0-B, ground A0-B0 along x
    slider-crank    crank A0-A, rod A-B, slider at B on a line parallel to x, `offset` above the crank's pivot
"""

import math
from collections.abc import Mapping

from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND, Body, Mechanism, Pin, Rotation, Slide

Points = Mapping[str, Mapping[str, complex]]
"""Body's name -> further points of it, in its frame [m]."""


def four_bar(
    ground: float,
    crank: float,
    coupler: float,
    rocker: float,
    *,
    branch: int,
    points: Points | None = None,
    name: str = "four-bar",
) -> Mechanism:
    """Four-bar driven by its crank: link lengths [m].

    A0 = 0, B0 = `ground` on the x axis; the crank turns by its angle against x about A0. Each link's frame has its
    origin at its first pin (crank A0, coupler A, rocker B0) and its x axis to the second.

    branch  +1: pin B on the left of A -> B0, -1: on the right
    points  further points by body, in those frames: `{"rocker": {"E": 0.3}}`

    Raises MechanismError for a length that is not above zero.
    """
    lengths(name, ground=ground, crank=crank, coupler=coupler, rocker=rocker)
    return Mechanism(
        bodies=(
            _body(GROUND, {"A0": 0, "B0": ground}, points),
            _body("crank", {"A0": 0, "A": crank}, points),
            _body("coupler", {"A": 0, "B": coupler}, points),
            _body("rocker", {"B0": 0, "B": rocker}, points),
        ),
        joints=(
            Pin("A0", GROUND, "crank"),
            Pin("A", "crank", "coupler"),
            Pin("B", "coupler", "rocker"),
            Pin("B0", GROUND, "rocker"),
        ),
        inputs=(Rotation("crank", "A0"),),
        branches={"B": branch},
        name=name,
    )


def slider_crank(
    crank: float,
    rod: float,
    *,
    branch: int,
    offset: float = 0.0,
    points: Points | None = None,
    name: str = "slider-crank",
) -> Mechanism:
    """Slider-crank driven by its crank: link lengths and offset of the slider's line [m].

    The line is y = offset; its own point is (0, offset), so that the slide's s is the x of pin B.
    branch  +1: the slider is at greater x than pin A, -1: at smaller x
    points  further points by body: crank (origin A0, x to A), rod (origin A, x to B), slider (origin B, x along)

    Raises MechanismError for a length that is not above zero.
    """
    lengths(name, crank=crank, rod=rod)
    return Mechanism(
        bodies=(
            _body(GROUND, {"A0": 0, "line": 1j * offset}, points),
            _body("crank", {"A0": 0, "A": crank}, points),
            _body("rod", {"A": 0, "B": rod}, points),
            _body("slider", {"B": 0, "line": 0}, points),
        ),
        joints=(
            Pin("A0", GROUND, "crank"),
            Pin("A", "crank", "rod"),
            Pin("B", "rod", "slider"),
            Slide("line", "slider", GROUND),
        ),
        inputs=(Rotation("crank", "A0"),),
        branches={"B": branch},
        name=name,
    )


def link_lengths(mechanism: Mechanism) -> dict[str, float] | None:
    """Lengths [m] of a four-bar by link: ground, crank (turned by the input), coupler, rocker; None of any other.

    >>> link_lengths(four_bar(0.300, 0.060, 0.200, 0.230, branch=+1))
    {'ground': 0.3, 'crank': 0.06, 'coupler': 0.2, 'rocker': 0.23}
    """
    pins = [joint for joint in mechanism.joints if isinstance(joint, Pin)]
    if not len(mechanism.bodies) == len(mechanism.joints) == len(pins) == 4 or len(mechanism.inputs) != 1:
        return None
    loop, joint = [GROUND], mechanism.inputs[0].joint
    first = joint
    lengths: dict[str, float] = {}
    for link in ("crank", "coupler", "rocker", "ground"):
        pin = mechanism.joint(joint)
        if loop[-1] not in pin.bodies:
            return None
        (body,) = (name for name in pin.bodies if name != loop[-1])
        following = [other.name for other in pins if body in other.bodies and other.name != joint]
        if len(following) != 1 or (body in loop and link != "ground"):
            return None
        lengths[link] = abs(mechanism.point(body, following[0]) - mechanism.point(body, joint))
        loop.append(body)
        joint = following[0]
    return {link: lengths[link] for link in ("ground", "crank", "coupler", "rocker")} if joint == first else None


def lengths(mechanism: str, **named: float) -> None:
    """Raise MechanismError unless every length is finite and above zero."""
    for name, length in named.items():
        if not (math.isfinite(length) and length > 0):
            raise MechanismError(f"{name} of {mechanism} is {length:g} m", allowed="lengths are finite and above 0")


def _body(name: str, own: Mapping[str, complex], further: Points | None) -> Body:
    extra = (further or {}).get(name, {})
    return Body(name, {**extra, **own})

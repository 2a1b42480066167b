"""What a cam moves, of the parts as they are: the mass that counts at its tool.

    m = sum of m_k (v_k / v)² + sum of J_k (w_k / v)²        over all that moves with the tool     [kinetic energy]

A lever counts with its inertia about its pivot over the square of its arm to the tool, a follower by the ratio; what
turns with the handler with its inertia about that axis over the square of the handler's radius. Springs count a third.
"""

from collections.abc import Mapping
from functools import lru_cache

from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.followers import follower_id
from ilmek.machines.weaver.lever_parts import lever_id
from ilmek.machines.weaver.motions import CENTRE_GRASP, CENTRE_MOTION, HANDLER, OPENER, SIDE_GRASP, SIDE_MOTION, SLEY
from ilmek.machines.weaver.return_springs import SEATS, spring_part
from ilmek.machines.weaver.tool_parts import CENTRE, LEFT, PLATES, RIGHT, SLEY_BODY
from ilmek.machines.weaver.tree import head_tree
from ilmek.machines.weaver.turning import HANDLER_BODY, PINION_BODY
from ilmek.part.tree import RigidBody

_SLIDING = {
    SIDE_MOTION: (PLATES, LEFT, RIGHT),
    OPENER: (PLATES,),
    CENTRE_MOTION: (CENTRE,),
    SLEY: (SLEY_BODY,),
    SIDE_GRASP: (),
    CENTRE_GRASP: (),
}
"""Bodies that slide with the tool of a track."""


def moved_mass(weaver: Weaver, track: str) -> float:
    """The mass that a track's cam moves, at its tool [kg]; of the handler as if all at its tip."""
    tree, cam = head_tree(weaver), weaver.cam(track)
    spring = spring_part(weaver, track)
    sprung = 0.0 if spring is None else SEATS[track].number * spring.mass / 3
    follower = tree.body(follower_id(track)).moments.zeroth
    if track == HANDLER:
        turning = sum(about_axis(tree.body(name)) for name in (HANDLER_BODY, PINION_BODY))
        return (turning + (follower + sprung) * weaver.params.pinion**2) / weaver.handler_radius**2
    masses = _masses(weaver)
    sliding = sum(masses[name] for name in _SLIDING[track])
    lever = weaver.shape.levers.get(track)
    swung = 0.0 if lever is None else about_axis(tree.body(lever_id(track))) / (lever.ratio * lever.arm) ** 2
    return sliding + swung + sprung + follower / cam.ratio**2


def about_axis(body: RigidBody) -> float:
    """Moment of inertia of a body about the z axis of its frame [kg m²]."""
    second = body.moments.second
    return float(second[0, 0] + second[1, 1])


@lru_cache(maxsize=8)
def _masses(weaver: Weaver) -> Mapping[str, float]:
    """Mass of each body that slides, and of what it carries but the bodies that are named themselves [kg]."""
    masses = dict.fromkeys((LEFT, RIGHT, CENTRE, PLATES, SLEY_BODY), 0.0)
    for body in head_tree(weaver).bodies:
        own = body.id if body.id in masses else body.parent
        if own in masses:
            masses[own] += body.moments.zeroth
    return masses

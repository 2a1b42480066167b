"""What takes the motion of a head's cam shaft to its tools, and what keeps it together.

cam - follower            the return spring of the track, or both flanks of a groove
follower - lever - tool   a pin in a slot at each end of the lever
follower - rocker - collar   the spring of the jaws, which presses the collar on the rocker, it on the rail
collar - finger           the wire;     opener - side gripper: its screw
follower - pinion - handler  rack, pinion and freewheel
"""

from collections.abc import Iterator

from ilmek.machines.weaver.carriages import screw_id
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.followers import LEVER_PIN, follower_id
from ilmek.machines.weaver.jaws import collar_body, finger_body, rocker_id, wire_id
from ilmek.machines.weaver.lever_parts import lever_id
from ilmek.machines.weaver.motions import CENTRE_GRASP, CENTRE_MOTION, HANDLER, OPENER, SIDE_GRASP, SIDE_MOTION, SLEY
from ilmek.machines.weaver.parts import cam_id
from ilmek.machines.weaver.return_springs import spring_id
from ilmek.machines.weaver.tool_parts import CENTRE, LEFT, PLATES, RIGHT, SLEY_BODY, part_id
from ilmek.machines.weaver.turning import FREEWHEEL, HANDLER_BODY, PINION, PINION_BODY, RACK
from ilmek.part.tree import Closure, JointKind

CAM_SHAFT = part_id("turning cam shaft")
"""Id of the body of the cams."""

_TOOLS = {SIDE_MOTION: PLATES, OPENER: PLATES, CENTRE_MOTION: CENTRE, SLEY: SLEY_BODY}
"""Body that the lever of a track moves."""

_GRIPPERS = {SIDE_GRASP: (LEFT, RIGHT), CENTRE_GRASP: (CENTRE,)}
"""Grippers whose jaws a track moves."""


def transmissions(weaver: Weaver) -> Iterator[Closure]:
    """From each cam to the bodies that follow it."""
    for cam in weaver.cams:
        follower = follower_id(cam.name)
        yield _from(CAM_SHAFT, follower, spring_id(cam.name) if cam.preload > 0 else cam_id(cam.name))
        if cam.name in weaver.shape.levers:
            yield _from(follower, lever_id(cam.name), LEVER_PIN)
            yield _from(lever_id(cam.name), _TOOLS[cam.name], LEVER_PIN)
        elif cam.name == HANDLER:
            yield _from(follower, PINION_BODY, RACK, PINION)
            yield _from(PINION_BODY, HANDLER_BODY, FREEWHEEL)
        elif not weaver.params.with_arms:
            yield from _of_jaws(cam.name, follower)
    if not weaver.params.with_arms:
        yield from (_from(PLATES, gripper, screw_id(gripper)) for gripper in (LEFT, RIGHT))


def _of_jaws(track: str, follower: str) -> Iterator[Closure]:
    """From the follower of jaws to their fingers."""
    yield _from(follower, rocker_id(track), spring_id(track))
    for gripper in _GRIPPERS[track]:
        yield _from(rocker_id(track), collar_body(gripper), spring_id(track))
        yield _from(collar_body(gripper), finger_body(gripper), wire_id(track))


def _from(leading: str, following: str, *kept_by: str) -> Closure:
    return Closure(JointKind.TRANSMISSION, (leading, following), kept_by=kept_by)

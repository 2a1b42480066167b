"""The knotting heads in space: the bodies of their tree on the rail, the arms on them, and the yarn that they tie."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.linkage.mirror import other
from ilmek.machines.automated_loom.cyclogram import CARRIAGE
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.maker import (
    COARSE,
    COARSEST,
    FINE,
    KNOT,
    MachineTree,
    along_track,
    half_width,
    motion,
    track_angles,
)
from ilmek.machines.automated_loom.knotting import DYAD
from ilmek.machines.automated_loom.own_parts import RAIL
from ilmek.machines.knotting_dyad import KnottingDyad
from ilmek.machines.knotting_dyad.drives import head_motion
from ilmek.machines.knotting_dyad.tree import CENTRE as CENTRE_OF_ARMS
from ilmek.machines.knotting_dyad.tree import needle_level
from ilmek.machines.knotting_dyad.tree import tree as arms_tree
from ilmek.machines.link_tree import body_id
from ilmek.machines.weaver import Weaver
from ilmek.machines.weaver.cutter import eccentricity, half_turn
from ilmek.machines.weaver.followers import follower_id
from ilmek.machines.weaver.grippers import Grippers, front_of, wrapped
from ilmek.machines.weaver.jaws import collar_body, drawn, finger_body, opened, rocker_id, turned
from ilmek.machines.weaver.knife import BLADE_BODY, ECCENTRIC_BODY
from ilmek.machines.weaver.knot import led_between
from ilmek.machines.weaver.lever_parts import lever_id
from ilmek.machines.weaver.motions import (
    CENTRE_ARM,
    CENTRE_GRASP,
    CENTRE_MOTION,
    HANDLER,
    LEFT_ARM,
    OPENER,
    RIGHT_ARM,
    SIDE_GRASP,
    SIDE_MOTION,
    SLEY,
)
from ilmek.machines.weaver.tool_parts import CENTRE, LEFT, PLATES, RIGHT, SLEY_BODY
from ilmek.machines.weaver.transmissions import CAM_SHAFT
from ilmek.machines.weaver.tree import HEAD, head_tree, placed
from ilmek.machines.weaver.turning import HANDLER_BODY, PINION_BODY
from ilmek.part.placement import Placement, placement
from ilmek.part.tree import Joint, JointKind, Tree
from ilmek.report.scene import SceneMotion, SceneYarn
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import sample
from ilmek.units import turn

_ARMS, _HANDS = (LEFT_ARM, RIGHT_ARM, CENTRE_ARM), ((LEFT, -1), (RIGHT, 1))
_TOOLS = {
    PLATES: "warp opener",
    LEFT: "left side gripper",
    RIGHT: "right side gripper",
    CENTRE: "centre gripper",
    HANDLER_BODY: "pile handler",
    BLADE_BODY: "knife",
    SLEY_BODY: "sley",
}
_ARM_TOOLS = {"link 1": "left arm", other("link 1"): "right arm", CENTRE_OF_ARMS: "centre gripper"}
_YARN_SAMPLES, _ON_WARP, _LIFTS, _CUT = 181, 12, 121, 25


def heads(loom: LoomDesign) -> tuple[MachineTree, ...]:
    """The heads on their rail; none where weavers tie."""
    if not loom.heads:
        return ()
    return (MachineTree("weaver", heads_tree(loom), parent=RAIL, deviations=(FINE, COARSE, COARSEST)),)


def arms(loom: LoomDesign) -> tuple[MachineTree, ...]:
    """The arms that tie the knots, on the heads; none where their cams do."""
    if DYAD not in loom.machines:
        return ()
    dyad = loom.machines[DYAD].design_as(KnottingDyad)
    return (MachineTree(DYAD, _arms_tree(loom, dyad), _section(loom, dyad), HEAD),)


def tools(loom: LoomDesign) -> Mapping[str, str]:
    """What people call the tools that tie a knot, by the bodies that they are, or that carry the rest of them."""
    of_arms = {body_id(DYAD, body): name for body, name in _ARM_TOOLS.items()}
    if not loom.heads:
        return {}
    return _TOOLS | of_arms if loom.weaver.params.with_arms else _TOOLS


def _section(loom: LoomDesign, dyad: KnottingDyad) -> Placement:
    """The axes of the arms' section in a head's: x and y become x and z, the needles amid the opener."""
    assert dyad.head is not None
    opener, x = loom.weaver.params.opener, -dyad.head.section.middle
    level = opener.front_span + opener.height / 2 + needle_level(dyad)
    return placement(x, level, about=(1.0, 0.0, 0.0), angle=turn / 4)


def _arms_tree(loom: LoomDesign, dyad: KnottingDyad) -> Tree:
    """The bodies of the arms, fixed to their head, with their motions over a knot: at rest until the warps are open."""
    assert dyad.head is not None
    knot, cycle = loom.knot_cyclogram, head_motion(dyad.params, dyad.head).cycle
    opened = min(segment.start for name in _ARMS for segment in knot.track(name).segments)
    first = next(part.start for part in cycle.parts if not part.grippers)

    def over_the_knot(own: SceneMotion) -> SceneMotion:
        angle = opened + (own.angle / turn * cycle.period - first) * knot.speed
        every = np.unique(np.concatenate([[0.0, turn], angle[(angle > 0) & (angle < turn)]]))
        shift = np.stack([np.interp(every, angle, along) for along in own.shift.T], axis=1)
        return motion(knot, every, shift=shift, rotation=np.interp(every, angle, own.rotation))

    tree = arms_tree(dyad)
    moved = {body.id: over_the_knot(body.joint.motion) for body in tree.bodies if body.joint.motion is not None}
    return tree.replaced(
        replace(body, joint=Joint()) if body.joint.kind is JointKind.MISSING else body
        for body in tree.moving(moved).bodies
    )


def heads_tree(loom: LoomDesign) -> Tree:
    """The heads in the rail's axes: each in the middle of its share of the row.

    A head's origin lies in the side view's: at the fell, in the heads' origin while they knot.
    """
    rail = loom.side.of_heads.rail
    middle, share = rail.corner + rail.size / 2, loom.task.cloth.width / loom.heads
    middles = [(number + 0.5) * share - half_width(loom) for number in range(loom.heads)]
    return placed(loom.weaver, [placement(x, -middle.imag, -middle.real) for x in middles]).moving(motions(loom))


def head_alone(loom: LoomDesign) -> Tree:
    """A head in its own axes, over a knot."""
    bodies = head_tree(loom.weaver).moving(motions(loom))
    for branch in arms(loom):
        bodies = bodies.carrying(branch.parent, branch.tree, branch.position)
    # The carriage steps on at the end of a knot: the head by itself stands.
    return bodies.moving({HEAD: motion(loom.knot_cyclogram, np.array([0.0, turn]))})


def motions(loom: LoomDesign) -> Mapping[str, SceneMotion]:
    """The motions of a head's bodies over a knot."""
    weaver, knot, angle = loom.weaver, loom.knot_cyclogram, np.linspace(0.0, turn, 3)
    back, opener = (0.0, 0.0, -1.0), SIDE_MOTION if not weaver.params.with_arms else OPENER
    driven = {
        HEAD: along_track(knot, CARRIAGE, (1.0, 0.0, 0.0)),
        CAM_SHAFT: motion(knot, angle, rotation=angle),
        PLATES: along_track(knot, opener, back),
        SLEY_BODY: along_track(knot, SLEY, (0.0, -1.0, 0.0)),
        **_of_cams(weaver, knot),
        **_of_handler(weaver, knot),
        **_of_knife(weaver, knot),
    }
    if weaver.params.with_arms:
        return driven
    by, side = weaver.grippers, knot.track(SIDE_MOTION)
    angle = track_angles(side)
    position = sample(side, angle).position
    hands = {name: motion(knot, angle, rotation=hand * by.turned(position)) for name, hand in _HANDS}
    return {
        **driven,
        **hands,
        **_of_jaws(weaver, knot, SIDE_GRASP, (LEFT, RIGHT)),
        **_of_jaws(weaver, knot, CENTRE_GRASP, (CENTRE,)),
        CENTRE: along_track(knot, CENTRE_MOTION, back),
    }


def _of_cams(weaver: Weaver, knot: Cyclogram) -> Mapping[str, SceneMotion]:
    """The followers along x of their frames, and the levers that they turn."""
    moved = {}
    for cam in weaver.cams:
        angle, lift = _lift(knot, cam.name, weaver)
        still = 0 * lift
        moved[follower_id(cam.name)] = motion(knot, angle, shift=np.stack([lift[0] - lift, still, still], axis=1))
        if (lever := weaver.shape.levers.get(cam.name)) is not None:
            turned = lever.turned(lift)
            moved[lever_id(cam.name)] = motion(knot, angle, rotation=turned - turned[0])
    return moved


def _of_handler(weaver: Weaver, knot: Cyclogram) -> Mapping[str, SceneMotion]:
    """The handler, and its pinion, which the rack turns to and fro."""
    angle, lift = _lift(knot, HANDLER, weaver)
    track = knot.track(HANDLER)
    own = track_angles(track)
    return {
        HANDLER_BODY: motion(knot, own, rotation=sample(track, own).position),
        PINION_BODY: motion(knot, angle, rotation=(lift - lift[0]) / weaver.params.pinion),
    }


def _of_knife(weaver: Weaver, knot: Cyclogram) -> Mapping[str, SceneMotion]:
    """The eccentric, half a turn about the middle of the time that the cut has, and half a turn back; its blade."""
    handler, takes = knot.track(HANDLER), weaver.params.cutter_turn * knot.speed
    middle = (handler.segment("draw").end + handler.segment("present").start) / 2
    share = np.linspace(0.0, 1.0, _CUT)
    angle = middle + takes * np.concatenate([share - 0.5, share[1:] + 0.5])
    turned = np.concatenate([half_turn(share), turn / 2 + half_turn(share[1:])])
    angle, turned = np.array([0.0, *angle, turn]), np.array([0.0, *turned, turn])
    lift = eccentricity(weaver.params.yarn) * (1 - np.cos(turned))
    still = 0 * lift
    return {
        ECCENTRIC_BODY: motion(knot, angle, rotation=turned),
        BLADE_BODY: motion(knot, angle, shift=np.stack([still, lift, still], axis=1)),
    }


def _of_jaws(weaver: Weaver, knot: Cyclogram, track: str, names: tuple[str, ...]) -> Mapping[str, SceneMotion]:
    """The rocker of jaws, and the collars and fingers of their grippers."""
    angle, lift = _lift(knot, track, weaver)
    swung = turned(weaver, track, lift)
    moved = {rocker_id(track): motion(knot, angle, rotation=swung - swung[0])}
    for number, name in enumerate(names):
        along = drawn(weaver, track, number, lift)
        still = 0 * along
        moved[collar_body(name)] = motion(knot, angle, shift=np.stack([still, still, along - along[0]], axis=1))
        moved[finger_body(name)] = motion(
            knot, angle, rotation=opened(weaver, track, lift) - opened(weaver, track, 0.0)
        )
    return moved


def _lift(knot: Cyclogram, track: str, weaver: Weaver) -> tuple[FloatArray, FloatArray]:
    """The lift of a track's follower [m] at angles of the knot [rad]; its last angle closes the turn."""
    cam, own = weaver.cam(track), knot.track(track)
    angle = np.unique(np.concatenate([track_angles(own), np.linspace(0.0, turn, _LIFTS)]))
    return angle, np.interp(angle, cam.angle, cam.motion.s, period=turn)


def knot_yarn(loom: LoomDesign) -> tuple[SceneYarn, ...]:
    """The taut yarn of a knot over its angle, from where it is presented; none of a head with arms, or of weavers.

    It is led by the side grippers, drawn by the centre gripper, pushed down by the sley, and stays when the head steps.
    """
    if not loom.heads or loom.weaver.params.with_arms or loom.weaver.tied.knot is None:
        return ()
    weaver, knot, by = loom.weaver, loom.knot_cyclogram, loom.weaver.grippers
    angle = np.linspace(0.0, turn, _YARN_SAMPLES)
    _, taken, released = led_between(knot)
    side, centre, sley, step = (
        sample(knot.track(name), np.minimum(angle, last)).position
        for name, last in ((SIDE_MOTION, taken), (CENTRE_MOTION, released), (SLEY, turn), (CARRIAGE, turn))
    )
    drawn = angle > taken
    # The right half is the mirror image of one whose tip is the stagger before the left one.
    tips = [np.where(drawn, 1j * by.centre(centre).imag, by.tip(side) + 1j * before) for before in (0.0, by.stagger)]
    wraps = [np.where(drawn, wrapped(by, tip, out=True)[1], wrapped(by, tip)[1]) for tip in tips]
    front = front_of(by, tips, wraps)
    left, right = (
        np.stack([_half(by, *at) for at in zip(tip, wrap, front, strict=True)])
        for tip, wrap in zip(tips, wraps, strict=True)
    )
    flat = np.concatenate([left, -np.conj(right[:, ::-1])], axis=1)
    middle = weaver.tool_bodies.tied + by.arm * np.sin(by.turned(side))
    far = np.cumsum(np.abs(np.diff(flat, axis=1, prepend=flat[:, :1])), axis=1)
    y = middle[:, None] + np.where(drawn, 0.0, by.lift)[:, None] * (far / far[:, -1:] - 0.5)
    foot = np.minimum.accumulate(weaver.params.sley_stroke - sley)[:, None]
    pushed = np.minimum(y, foot)
    pushed[:, [0, -1]] = np.where(angle[:, None] < released, y, pushed)[:, [0, -1]]
    points = np.stack([flat.real - step[:, None], pushed, flat.imag], axis=2)
    points[angle < knot.track(HANDLER).segment("present").end] = points[0, 0]
    pile = loom.task.yarns.pile.diameter
    return (SceneYarn("yarn of the knot", "yarn of the knot", HEAD, KNOT, angle, points, pile),)


def _half(by: Grippers, tip: complex, wrap: float, front: float) -> ComplexArray:
    """The left half of the taut yarn in the plan, from its end at a tip to the middle, which is at `front` [m]."""
    if wrap <= 0:
        return np.linspace(tip, 1j * front, _ON_WARP + 1, endpoint=False)
    on_warp = by.wrap_radius * np.exp(1j * (turn / 4 + np.linspace(wrap, 0.0, _ON_WARP))) - by.pair / 2
    return np.concatenate([[tip], on_warp])

"""Chains of tolerances of a loom, from the fits of its parts: the shed, the opener over the warps, grippers at a warp.

shed      two cams, one lifted: their profiles, and their play on the square bar; in the ratio of shed and lift
opener    its points between two warps as they come from the fell: the warps' places on the cam shaft, in the
ratio of the distances from the fell; the head's place; the opener on its rods; its teeth
gripper   a side gripper beside a warp that the opener holds: both on their rods and bores, which carry its tip
farther out: (z2 - z) / (z2 - z1) and (z1 - z) / (z2 - z1) for a tip at z and bores at z1, z2  [derived]
"""

from collections.abc import Iterator

from ilmek.elements.tolerance_chains import ToleranceLink, ToleranceStack
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.shedding.tolerance_chain import tolerance_chain
from ilmek.part.meetings import Meeting, meetings
from ilmek.part.tolerances import Characteristic, FeatureKind
from ilmek.part.tolerancing import play_of, tolerances_of
from ilmek.part.tree import Tree
from ilmek.report import Check, Table, at_most, columns
from ilmek.units import mm

PROFILE = 0.1 * mm
"""Deviation of a cam's profile, cut by a laser [m]; assumed by this project."""

TEETH = 0.05 * mm
"""Deviation of the opener's teeth from the bores of its rods, and of its walls [m]; assumed by this project."""

CAM_SHAFT = "shedding/cam-shaft"
GRIPPER, FACE, BAR = "weaver/side-gripper", "weaver/face", "weaver/cross-bar"
ROD, PARTITION = "weaver/carriage-rod", "weaver/partition"


def tolerance_stacks(loom: LoomDesign) -> tuple[ToleranceStack, ...]:
    """The chains of a loom: of one without heads that of the shed alone."""
    return tuple(_stacks(loom))


def _stacks(loom: LoomDesign) -> Iterator[ToleranceStack]:
    shedding, tree = loom.shedding, loom_tree(loom)
    params = shedding.params
    ratio = shedding.shed_opening / params.lift
    cams = [ToleranceLink(f"profile of the {which} cam", PROFILE, ratio) for which in ("upper", "lower")]
    loose = _on_bar(tree) / 2
    cams += [ToleranceLink(f"{which} cam on its bar", loose, ratio, play=True) for which in ("upper", "lower")]
    yield ToleranceStack("height of the shed", shedding.shed_opening - params.shuttle_height, tuple(cams))
    met = [(meeting.bore.part.id, meeting.inner.part.id) for meeting in meetings(tree)] if loom.heads else []
    if (PARTITION, ROD) not in met:
        return
    own, opener = loom.weaver.params.opener, loom.weaver.opener
    on_rods = (
        ToleranceLink("opener on its rods", play_of(tree, PARTITION, ROD) / 2, play=True),
        ToleranceLink("bores of the rods", _placed(loom, PARTITION, ROD)),
        ToleranceLink("teeth of the opener", TEETH),
    )
    near = (own.front_span + own.height) / loom.side.spans.front[0]
    shaft = shedding.first
    warps = (
        ToleranceLink("cam of the warp", tolerance_chain(shaft.params, shaft.stack.shares).statistical, near),
        ToleranceLink("warp between its guides", shaft.stack.shares.play / 2, near, play=True),
    )
    room = (opener.pitch - loom.weaver.params.warp - own.tip) / 2
    head = ToleranceLink("head on its rail", own.placing)
    yield ToleranceStack("opener between two warps", room, (*warps, head, *on_rods))
    guided = [
        meeting
        for meeting in meetings(tree)
        if meeting.inner.part.id == GRIPPER and meeting.bore.part.id in {FACE, BAR}
    ]
    if len({one.bore.part.id for one in guided}) == len((FACE, BAR)):
        yield ToleranceStack("gripper beside a warp", loom.weaver.params.clearance, (*_guides(loom, guided), *on_rods))


def _on_bar(tree: Tree) -> float:
    """Largest play of the cams on the bar of the first shaft [m]; 0: their bore does not fit, and that check fails."""
    tolerances = tolerances_of(tree)
    bars = [one for one in tolerances.get(CAM_SHAFT, ()) if one.kind is FeatureKind.SQUARE]
    bores = [one for own in tolerances.values() for one in own if CAM_SHAFT in one.mates]
    return max((bore.upper - bar.lower for bar in bars for bore in bores if bar.nominal == bore.nominal), default=0.0)


def _guides(loom: LoomDesign, guided: list[Meeting]) -> Iterator[ToleranceLink]:
    """Play and position of the two bores of a gripper, in the ratio in which they move its tip."""
    near, far = (next(meeting for meeting in guided if meeting.bore.part.id == part) for part in (FACE, BAR))
    first, second = (sum(one.along) / 2 for one in (near, far))
    for part, ratio in ((FACE, second / (second - first)), (BAR, first / (first - second))):
        title = "face" if part == FACE else "opener's cross-bar"
        yield ToleranceLink(f"gripper in the {title}", play_of(loom_tree(loom), part, GRIPPER) / 2, ratio, play=True)
        yield ToleranceLink(f"bore of the {title}", _placed(loom, part, GRIPPER), ratio)


def _placed(loom: LoomDesign, part: str, mate: str) -> float:
    """How far a bore of a part for another may be beside its place [m]; 0: all others are measured from it."""
    features = (tolerance for tolerance in tolerances_of(loom_tree(loom))[part] if mate in tolerance.mates)
    positions = (
        own for feature in features for own in feature.geometric if own.characteristic is Characteristic.POSITION
    )
    return max((own.value / 2 for own in positions), default=0.0)


def chain_checks(loom: LoomDesign) -> tuple[Check, ...]:
    """The statistical closure of each chain against its room."""
    source = "fits of ISO 286; 99.7 % of all looms"
    cures = {"height of the shed": "set a larger lift"}
    return tuple(
        at_most(f"tolerance chain: {stack.title}", stack.statistical, stack.room, "mm", source).with_cure(
            cures.get(stack.title, "set a coarser quality, or thinner warps")
        )
        for stack in tolerance_stacks(loom)
    )


def chain_table(loom: LoomDesign) -> Table:
    """The links of the chains, and their closures."""
    heads = columns("chain", "link", "to each side [mm]", "ratio", "share [mm]")
    rows = [
        row
        for stack in tolerance_stacks(loom)
        for row in (
            *((stack.title, link.name, link.deviation, link.ratio, link.share) for link in stack.links),
            (stack.title, "worst case", stack.worst, 1.0, stack.worst),
            (stack.title, "statistical", stack.statistical, 1.0, stack.statistical),
            (stack.title, "room", stack.room, 1.0, stack.room),
        )
    ]
    return Table("loom-tolerance-chains", "Tolerance chains", heads, tuple(rows))

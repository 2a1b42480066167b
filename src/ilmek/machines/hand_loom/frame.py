"""The frame of a hand loom: two columns on feet, beams between them, brackets of the cylinders, the weavers' bench.

Where the beat is driven, posts on the front feet carry its beam, and a cabinet stands behind a rear foot.
"""

from collections.abc import Iterator
from functools import lru_cache

from ilmek.elements.columns import STEEL
from ilmek.elements.materials import GRAVITY
from ilmek.errors import LoomError
from ilmek.machines.automated_loom.cabinet import control_needs, control_parts
from ilmek.machines.automated_loom.equipment.bench import (
    BOARD,
    ELBOW,
    LEAST_SEAT,
    SECTION,
    WEIGHT,
    Bench,
    bench_for,
    bench_parts,
)
from ilmek.machines.automated_loom.equipment.signals import beat_signals
from ilmek.machines.automated_loom.equipment.site import LoomSite
from ilmek.machines.automated_loom.feet import FOOT, Foot, foot_for
from ilmek.machines.automated_loom.frame import member, part_id
from ilmek.machines.automated_loom.in_space.beating import beat_branch
from ilmek.machines.automated_loom.in_space.machines import joined
from ilmek.machines.automated_loom.in_space.maker import MachineTree
from ilmek.machines.beat import BeatDrive
from ilmek.machines.hand_beat import HandBeat
from ilmek.machines.hand_beat.report import tree as tools_tree
from ilmek.machines.hand_beat.tools import comb_wide, shelf_length, tool_bodies
from ilmek.machines.hand_loom.design import HandLoom
from ilmek.machines.hand_loom.driven_beat import two_beats
from ilmek.machines.hand_loom.equipment import OWN, beat_site, equipment
from ilmek.machines.hand_loom.layout import CylinderBracket
from ilmek.machines.hand_shed.tree import tree as shed_tree
from ilmek.machines.warp_tension.tree import tree as winding_tree
from ilmek.part.part import Part
from ilmek.part.placement import ALONG_WIDTH, IN_SIDE_VIEW, UPRIGHT, placement
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.units import mm

SHELF_LEVEL = 0.45
"""Shelf of the tools above the fell [m]; assumed by this project."""

BENCH_BEFORE = 0.3
"""Front edge of the bench before the warps [m]; assumed by this project."""

_LEAST = 0.05 * mm


@lru_cache(maxsize=4)
def tree(loom: HandLoom) -> Tree:
    """Every body of the loom, in the axes of the scene."""
    return joined(branches(loom))


def branches(loom: HandLoom) -> tuple[MachineTree, ...]:
    """The trees of frame and machines, and of what a driven beat needs beside."""
    return (*_whole(loom, foot_of(loom)), *(equipment(site_of(loom)) if loom.drive else ()))


@lru_cache(maxsize=4)
def site_of(loom: HandLoom) -> LoomSite:
    """What the guards of a driven beat and its weavers' station are made for. Raises LoomError without a drive."""
    if loom.drive is None:
        raise LoomError("no guards", allowed="a loom of which something is driven")
    return beat_site(loom.drive, joined(_whole(loom, foot_of(loom))), loom.layout.floor, loom.weavers)


def own_tree(loom: HandLoom) -> Tree:
    """The bodies that are in none of its machines: frame and bench, tools beside a driven beat, guards, control."""
    own = (branch.tree for branch in branches(loom) if branch.machine == OWN)
    return Tree(tuple(body for one in own for body in one.bodies))


def _whole(loom: HandLoom, foot: Foot | None) -> tuple[MachineTree, ...]:
    """The trees, with a levelling foot or without."""
    layout, drive, comb = loom.layout, loom.drive, loom.machines.get("hand-beat")
    over = layout.floor + FOOT + layout.base.side  # the feet
    axes = {"upper": layout.upper.at, "lower": layout.lower.at, "spacer": layout.spacer.at}
    positions = {name: placement(0.0, at.imag, at.real).after(ALONG_WIDTH) for name, at in axes.items()}
    made = None if comb is None else comb.design_as(HandBeat)
    wide = 0.0 if made is None else comb_wide(made.params, made.warps)
    aside = layout.face + shelf_length(wide) / 2
    shelf = placement(aside, SHELF_LEVEL, layout.depth + layout.column.side / 2)
    parts = (
        *_standing(loom, foot),
        *(occurrence for own in layout.brackets for occurrence in _bracket(loom, own)),
        *(bench_parts(bench_of(loom), over, over) if drive is None else _of_a_drive(loom, drive)),
    )
    tools = MachineTree(OWN, Tree(tuple(tool_bodies(shelf))))
    return (
        MachineTree(OWN, Tree((RigidBody(part_id("frame"), parts),))),
        MachineTree("warp-tension", winding_tree(loom.winding, positions)),
        MachineTree("hand-shed", shed_tree(loom.shed, layout.depth, layout.face)),
        tools if made is None else MachineTree("hand-beat", tools_tree(made, shelf)),
        *(() if drive is None else (beat_branch(drive, two_beats(drive.beat)),)),
    )


def _of_a_drive(loom: HandLoom, drive: BeatDrive) -> Iterator[Occurrence]:
    """Posts of the beat on the front feet, and the cabinet of its control."""
    layout, section, posts = loom.layout, loom.layout.column, loom.posts
    assert posts is not None
    x, over = layout.face + section.side / 2, layout.floor + FOOT + layout.base.side
    post = member("beat-post", "post of the beat", posts.section, posts.height)
    yield Occurrence(post, tuple(placement(side, over, posts.depth).after(UPRIGHT) for side in (-x, x)))
    motors = ((line.kind, line.power, line.number) for line in drive.parts if line.drives)
    needs = control_needs(motors, len(beat_signals(loom.weavers)))
    yield from control_parts(layout.face + section.side, layout.floor, layout.depth - layout.reach, needs)


@lru_cache(maxsize=4)
def foot_of(loom: HandLoom) -> Foot:
    """The levelling foot."""
    return foot_for(foot_load(loom))


@lru_cache(maxsize=4)
def foot_load(loom: HandLoom) -> float:
    """Load of a levelling foot where two bear the loom, on an uneven floor, with all weavers on its bench [N]."""
    return (joined(_whole(loom, None)).mass + loom.weavers * WEIGHT) * GRAVITY / 2


def _standing(loom: HandLoom, foot: Foot | None) -> Iterator[Occurrence]:
    """Columns, beams between them at the floor and at the top, feet."""
    layout, section, base = loom.layout, loom.layout.column, loom.layout.base
    half, x, low = section.side / 2, layout.face + section.side / 2, layout.floor + FOOT
    column = member("column", "column of the frame", section, layout.top - low)
    yield Occurrence(column, tuple(placement(side, low, layout.depth).after(UPRIGHT) for side in (-x, x)))
    for name, title, own, y in (
        ("beam", "beam across", section, layout.top - half),
        ("floor-beam", "beam across at the floor", base, low + base.side / 2),
    ):
        beam = member(name, title, own, 2 * layout.face)
        yield Occurrence(beam, (placement(-layout.face, y, layout.depth).after(ALONG_WIDTH),))
    posts, rear = loom.posts, layout.depth - layout.reach
    front = BENCH_BEFORE + BOARD[0] if posts is None else posts.depth + max(posts.section.side, section.side)
    for name, title, begin, end in (
        ("front-foot", "front foot of the frame", layout.depth + half, front),
        ("rear-foot", "rear foot of the frame", rear, layout.depth - half),
    ):
        lies = member(name, title, base, end - begin)
        yield Occurrence(lies, tuple(placement(side, low + base.side / 2, begin) for side in (-x, x)))
    if foot is not None:
        ends = (rear + foot.pad / 2, front - foot.pad / 2)
        pads = tuple(placement(side, layout.floor, z).after(UPRIGHT) for side in (-x, x) for z in ends)
        yield Occurrence(foot.part(part_id("levelling-foot")), pads)


def _bracket(loom: HandLoom, own: CylinderBracket) -> Iterator[Occurrence]:
    """A bracket on both sides, and its spacers to the columns."""
    layout, name = loom.layout, own.cylinder.name
    title = f"bracket of the {name} cylinder"
    plate = Part(part_id(f"{name}-bracket"), title, "laser-cut part", own.plate, STEEL, machined=True)
    yield Occurrence(plate, tuple(placement(x).after(IN_SIDE_VIEW) for x in (-own.inner, own.outer)))
    gap = layout.face - own.outer
    if gap > _LEAST:
        spacer = member(f"{name}-bracket-spacer", f"spacer of the {title}", layout.column, gap)
        yield Occurrence(
            spacer, tuple(placement(x, own.at.imag, layout.depth).after(ALONG_WIDTH) for x in (own.outer, -layout.face))
        )


@lru_cache(maxsize=4)
def bench_of(loom: HandLoom) -> Bench:
    """The bench: elbows of a weaver at the middle of what she weaves before it is wound on; it stands on the feet."""
    layout = loom.layout
    seat = max(loom.params.hands.advance / 2 - ELBOW - layout.floor, LEAST_SEAT)
    half = layout.face + (layout.column.side + SECTION.side) / 2
    return bench_for(BENCH_BEFORE, seat, layout.floor, half, loom.weavers)

"""The scene of a loom: all its parts, its warps, yarns and carpet."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import Float
from ilmek.machines.automated_loom.cyclogram import EVEN, ODD
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.creel import PACKAGE
from ilmek.machines.automated_loom.equipment.guards import GUARDS
from ilmek.machines.automated_loom.equipment.tree import equipment
from ilmek.machines.automated_loom.in_space.cams import warp_positions
from ilmek.machines.automated_loom.in_space.heads import knot_yarn, tools
from ilmek.machines.automated_loom.in_space.machines import joined, machine_branches
from ilmek.machines.automated_loom.in_space.maker import KNOT, ROW, STANDS, MachineTree, track_angles
from ilmek.machines.automated_loom.in_space.standing import carpet_roll
from ilmek.machines.automated_loom.in_space.weft import wefts
from ilmek.machines.beat import GUIDED
from ilmek.machines.hammer.tree import COMB
from ilmek.machines.shedding.stack import part_id
from ilmek.machines.shedding.tree import warp_shafts
from ilmek.machines.weaver.parts import TUBE
from ilmek.machines.weaver.tree import HEAD
from ilmek.part.placement import IDENTITY, Placement
from ilmek.part.space import frames_of, parts_of, rotations
from ilmek.part.tree import GROUND, Closure, JointKind, RigidBody, Tree
from ilmek.report import Report
from ilmek.report.scene import Scene, SceneBody, SceneCarpet, SceneFrame, ScenePhase, SceneWarps
from ilmek.timing.track import sample
from ilmek.units import turn

NEAREST_PAIRS = "nearest_pairs"
"""Name of the result with the pairs of parts that come nearest, in a report that compares them."""

_ARC = 7
"""Points of the warps' line over the back rest."""


@lru_cache(maxsize=2)
def scene(loom: LoomDesign, report: Report) -> Scene:
    """The scene of a loom, with the checks of its report at the parts that they concern."""
    branches, checks = _in_the_scene(branches_of(loom)), report.all_checks
    parts = (
        part
        for branch in branches
        for part in parts_of(branch.tree, branch.machine, branch.position, checks, branch.deviations)
    )
    frames = (
        frame for branch in branches for frame in frames_of(branch.tree, branch.parent or STANDS, branch.position)
    )
    drawn = {plate.name for plate in report.all_plates}
    return Scene(
        title=report.title,
        frames=(SceneFrame(STANDS, np.zeros((1, 3))), *frames),
        parts=(*(part if part.plate in drawn else replace(part, plate="") for part in parts), carpet_roll(loom)),
        warps=_warps(loom),
        yarns=(*wefts(loom), *knot_yarn(loom)),
        carpet=_carpet(loom),
        periods=periods_of(loom),
        heads=HEAD,
        tools=tools(loom),
        dyed=(PACKAGE, TUBE),
        phases=tuple(
            ScenePhase(drive, track.name, own.name, own.start, own.end)
            for drive, cyclogram in ((ROW, loom.row_cyclogram), *(((KNOT, loom.knot_cyclogram),) if loom.heads else ()))
            for track in cyclogram.tracks
            for own in track.segments
        ),
        guards=GUARDS,
        floor=loom.side.floor,
        failures=tuple(check for check in report.all_checks if not check.ok),
        bodies=_bodies(loom_tree(loom)),
        nearest=report[NEAREST_PAIRS] if NEAREST_PAIRS in report.names() else None,
    )


def periods_of(loom: LoomDesign) -> dict[str, float]:
    """Times of a row and of a head's knot [s]."""
    return {ROW: loom.row_cyclogram.period, **({KNOT: loom.times.knot} if loom.heads else {})}


def _in_the_scene(branches: tuple[MachineTree, ...]) -> tuple[MachineTree, ...]:
    """The trees with their positions in the axes of the scene, which all its frames have at rest."""
    turned, moved = {GROUND: IDENTITY.rotation}, list[MachineTree]()
    for branch in branches:
        position = Placement(np.zeros(3), turned[branch.parent]).after(branch.position)
        turned |= {name: own for name, own in rotations(branch.tree, position).items() if name != GROUND}
        moved.append(replace(branch, position=position))
    return tuple(moved)


@lru_cache(maxsize=4)
def branches_of(loom: LoomDesign) -> tuple[MachineTree, ...]:
    """The trees of all machines of a loom and of its equipment, each after what carries it."""
    return (*machine_branches(loom), *equipment(loom))


@lru_cache(maxsize=4)
def loom_tree(loom: LoomDesign) -> Tree:
    """All bodies of a loom in the axes of the scene, with their motions."""
    whole = joined(branches_of(loom))
    if loom.params.beat != GUIDED:
        return whole
    # The comb hangs on the vertical axes with the cam system, which sinks with it.
    sinking = (Closure(JointKind.TRANSMISSION, (COMB, part_id("stand", index))) for index in range(len(loom.side.cams)))
    return Tree(whole.bodies, (*whole.closures, *sinking))


def _bodies(tree: Tree) -> dict[str, SceneBody]:
    """What holds each body of a tree, and what moves it: its motor, or what leads it, it is fixed to, or carries it."""
    titles = {part.id: part.title for part, _ in tree.occurrences()}
    fixed = [closure.bodies for closure in tree.closures if closure.kind is JointKind.FIXED]
    leads = [closure.bodies for closure in tree.closures if closure.kind is not JointKind.FIXED]

    def held(body: RigidBody) -> SceneBody:
        joint, drive = body.joint, "" if body.joint.motion is None else body.joint.motion.drive
        leading = tuple(first for first, second in leads if second == body.id)
        fixed_to = tuple(second for first, second in fixed if first == body.id)
        carrier = (body.parent,) if drive and not joint.passive and body.parent != GROUND else ()
        follows = () if joint.motor else leading or fixed_to or carrier
        return SceneBody(body.parent, joint.kind.value, drive, titles.get(joint.motor, ""), follows, joint.passive)

    return {body.id: held(body) for body in tree.bodies}


def _warps(loom: LoomDesign) -> SceneWarps:
    side, row = loom.side, loom.row_cyclogram
    line, lifted = warp_line(loom)
    even, odd = row.track(EVEN), row.track(ODD)
    angle = track_angles(even, odd)
    shaft, is_odd = warp_shafts(loom.shedding)
    return SceneWarps(
        x=warp_positions(loom),
        shaft=shaft,
        odd=is_odd,
        line=line,
        lifted=lifted,
        lifts=tuple(float(cam.lift) for cam in side.cams),
        angle=angle,
        even=sample(even, angle).position / loom.row_timing.lift,
        odd_share=sample(odd, angle).position / loom.row_timing.lift,
        diameter=loom.task.yarns.warp.diameter,
    )


def warp_line(loom: LoomDesign) -> tuple[Float[np.ndarray, "points 2"], tuple[int, ...]]:
    """A warp at rest in the side view, z and y [m], and the numbers of its points that the cam shafts lift.

    From the fell by the cam shafts to the back rest, over it, and level to the upper cylinder.
    """
    side = loom.side
    rest = side.back_rest
    heights = [float(cam.at.imag) for cam in side.cams]
    points = [0j, *(1j * height for height in heights)]
    over = rest.at + rest.radius * np.exp(1j * np.linspace(0.0, turn / 4, _ARC))
    points += [*over.tolist(), complex(side.upper.at + 1j * side.upper.radius)]
    line = np.array(points)
    return np.stack([line.real, line.imag], axis=1), tuple(range(1, len(heights) + 1))


def _carpet(loom: LoomDesign) -> SceneCarpet:
    """The carpet from the fell down the fronts of spacer and lower cylinder, and half round the roll."""
    side = loom.side
    round_ = side.lower.at + side.lower.radius * np.exp(-1j * np.linspace(0.0, turn / 2, 17))
    line = np.concatenate([[0j], round_])
    return SceneCarpet(
        width=loom.task.cloth.width,
        columns=loom.columns,
        rows=loom.rows,
        column_pitch=loom.knot_pitch,
        row_pitch=loom.task.cloth.row_distance,
        pile=side.pile,
        line=np.stack([line.real, line.imag], axis=1),
    )

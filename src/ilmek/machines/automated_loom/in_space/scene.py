"""The scene of a loom: all its parts, its warps, yarns and carpet."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray, Float
from ilmek.machines.arrangement.cylinders import RoundPart
from ilmek.machines.automated_loom.cyclogram import EVEN, ODD
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.creel import PACKAGE
from ilmek.machines.automated_loom.equipment.guards import GUARDS
from ilmek.machines.automated_loom.equipment.tree import equipment
from ilmek.machines.automated_loom.in_space.heads import knot_yarn, tools
from ilmek.machines.automated_loom.in_space.machines import joined, machine_branches
from ilmek.machines.automated_loom.in_space.maker import KNOT, ROW, STANDS, MachineTree, track_angles
from ilmek.machines.automated_loom.in_space.standing import carpet_roll
from ilmek.machines.automated_loom.in_space.weft import wefts
from ilmek.machines.beat import GUIDED
from ilmek.machines.hammer.tree import COMB
from ilmek.machines.shedding.stack import part_id
from ilmek.machines.shedding.tree import warp_positions, warp_shafts
from ilmek.machines.weaver.parts import TUBE
from ilmek.machines.weaver.tree import HEAD
from ilmek.part.bolting import bolted
from ilmek.part.part import Part
from ilmek.part.placement import IDENTITY, Placement
from ilmek.part.space import frames_of, parts_of, rotations
from ilmek.part.tree import GROUND, Closure, JointKind, RigidBody, Tree
from ilmek.report import Report
from ilmek.report.scene import Scene, SceneBody, SceneCarpet, SceneFrame, ScenePart, ScenePhase, SceneYarn
from ilmek.timing.cyclogram import Cyclogram
from ilmek.timing.track import sample
from ilmek.units import turn
from ilmek.weaving.cloth import Cloth

NEAREST_PAIRS = "nearest_pairs"
"""Name of the result with the pairs of parts that come nearest, in a report that compares them."""

_ARC = 7
"""Points of the warps' line over the back rest."""


@lru_cache(maxsize=2)
def scene(loom: LoomDesign, report: Report) -> Scene:
    """The scene of a loom, with the checks of its report at the parts that they concern."""
    side, winding = loom.side, loom.warp_tension
    whole = scene_of(
        report,
        tuple(screwed_branches(loom)),
        loom_tree(loom),
        warps=_warps(loom),
        carpet=carpet(winding.params.cloth, (loom.rows, loom.columns), side.pile, side.lower),
        roll=carpet_roll(winding, side.lower, side.roll),
        periods=periods_of(loom),
        phases=tuple(
            phase
            for cyclogram in (loom.row_cyclogram, *((loom.knot_cyclogram,) if loom.heads else ()))
            for phase in phases_of(cyclogram)
        ),
        floor=side.floor,
    )
    yarns = (*wefts(loom), *knot_yarn(loom))
    return replace(whole, yarns=yarns, heads=HEAD, tools=tools(loom), dyed=(PACKAGE, TUBE), guards=GUARDS)


def phases_of(cyclogram: Cyclogram) -> Iterator[ScenePhase]:
    """What moves when, over the cyclogram that names the drive."""
    return (
        ScenePhase(cyclogram.name, track.name, own.name, own.start, own.end)
        for track in cyclogram.tracks
        for own in track.segments
    )


def scene_of(
    report: Report,
    branches: tuple[MachineTree, ...],
    tree: Tree,
    *,
    warps: tuple[SceneYarn, ...],
    carpet: SceneCarpet,
    roll: ScenePart,
    periods: Mapping[str, float],
    phases: tuple[ScenePhase, ...],
    floor: float,
) -> Scene:
    """The scene of a loom of any kind: its trees and its cloth, without heads; tree: all its bodies."""
    branches, checks = _in_the_scene(branches), report.all_checks
    parts = (
        part
        for branch in branches
        for part in parts_of(branch.tree, branch.machine, branch.position, checks, branch.deviations)
    )
    frames = (
        frame for branch in branches for frame in frames_of(branch.tree, branch.parent or STANDS, branch.position)
    )
    plates = {plate.part.id: plate.name for plate in report.all_plates if isinstance(plate.part, Part)}
    return Scene(
        title=report.title,
        frames=(SceneFrame(STANDS, np.zeros((1, 3))), *frames),
        parts=(*(replace(part, plate=plates.get(part.ids[0], "")) for part in parts), roll),
        warps=warps,
        carpet=carpet,
        periods=periods,
        phases=phases,
        floor=floor,
        bodies=_bodies(tree),
        failures=tuple(check for check in checks if not check.ok),
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


@lru_cache(maxsize=16)
def branches_of(loom: LoomDesign) -> tuple[MachineTree, ...]:
    """The trees of all machines of a loom and of its equipment, each after what carries it."""
    return (*machine_branches(loom), *equipment(loom))


def screwed_branches(loom: LoomDesign) -> Iterator[MachineTree]:
    """The trees with the screws of their fixed joints."""
    screwed = {body.id: body for body in bolted(loom_tree(loom)).bodies}
    for branch in branches_of(loom):
        bodies = (replace(body, occurrences=screwed[body.id].occurrences) for body in branch.tree.bodies)
        yield replace(branch, tree=branch.tree.replaced(bodies))


@lru_cache(maxsize=16)
def loom_tree(loom: LoomDesign) -> Tree:
    """All bodies of a loom in the axes of the scene, with their motions."""
    whole = joined(branches_of(loom))
    if loom.params.beat != GUIDED:
        return whole
    # The comb hangs on the vertical axes with the cam system, which sinks with it.
    sinking = (Closure(JointKind.TRANSMISSION, (COMB, part_id("stand", index))) for index in range(len(loom.side.cams)))
    return Tree(whole.bodies, (*whole.closures, *sinking))


def _bodies(tree: Tree) -> dict[str, SceneBody]:
    """What holds each body of a tree, and what moves it: motor, hand, what leads it, it is fixed to, leads what slides
    on it, or carries it.
    """
    titles = {part.id: part.title for part, _ in tree.occurrences()}
    fixed = [closure.bodies for closure in tree.closures if closure.kind is JointKind.FIXED]
    leads = [closure.bodies for closure in tree.closures if closure.kind is not JointKind.FIXED]
    parents = {body.id: body.parent for body in tree.bodies if body.joint.kind is JointKind.SLIDE}
    drawn = {parents[second]: first for first, second in leads if second in parents}

    def held(body: RigidBody) -> SceneBody:
        joint, drive = body.joint, "" if body.joint.motion is None else body.joint.motion.drive
        leading = tuple(first for first, second in leads if second == body.id)
        fixed_to = tuple(second for first, second in fixed if first == body.id)
        carrier = (body.parent,) if drive and not joint.passive and body.parent != GROUND else ()
        through = (drawn[body.id],) if drive and body.id in drawn else ()
        follows = () if joint.motor or joint.hand else leading or fixed_to or through or carrier
        return SceneBody(
            body.parent, joint.kind.value, drive, titles.get(joint.motor or joint.hand, ""), follows, joint.passive
        )

    return {body.id: held(body) for body in tree.bodies}


def _warps(loom: LoomDesign) -> tuple[SceneYarn, ...]:
    """A sheet for the even and the odd warps of each cam shaft, the lowest first."""
    row, lift, line = loom.row_cyclogram, loom.row_timing.lift, _warp_line(loom)
    tracks = row.track(EVEN), row.track(ODD)
    angle = track_angles(*tracks)
    shaft, odd = warp_shafts(loom.shedding)
    x, diameter = warp_positions(loom.shedding), loom.task.yarns.warp.diameter
    sheets = []
    for number, cam in enumerate(loom.side.cams):
        lifted = np.interp(line.imag, [0.0, cam.at.imag, loom.side.back_rest.at.imag], [0.0, cam.lift, 0.0])
        for parity, track in enumerate(tracks):
            points = line + sample(track, angle).position[:, None] / lift * lifted
            own = x[(shaft == number) & (odd == bool(parity))]
            name = f"{track.name} of shaft {number + 1}"
            sheets.append(SceneYarn(name, name, STANDS, ROW, angle, upright(points), diameter, own))
    return tuple(sheet for sheet in sheets if sheet.across is not None and sheet.across.size)


def _warp_line(loom: LoomDesign) -> ComplexArray:
    """A warp at rest in the side view: from the fell by the cam shafts to the back rest, over it, level to the upper
    cylinder.
    """
    side = loom.side
    over = side.back_rest.at + side.back_rest.radius * np.exp(1j * np.linspace(0.0, turn / 4, _ARC))
    return np.array([0j, *(1j * cam.at.imag for cam in side.cams), *over, side.upper.at + 1j * side.upper.radius])


def upright(points: ComplexArray) -> Float[np.ndarray, "... 3"]:
    """Points of the side view, z + i y [m], in space at x = 0."""
    return np.stack([np.zeros(points.shape), points.imag, points.real], axis=-1)


def carpet(cloth: Cloth, grid: tuple[int, int], pile: float, lower: RoundPart) -> SceneCarpet:
    """The carpet from the fell down the fronts of spacer and lower cylinder, and half round the roll.

    grid  rows and knots of a row      pile  before the warps [m]
    """
    round_ = lower.at + lower.radius * np.exp(-1j * np.linspace(0.0, turn / 2, 17))
    line = np.concatenate([[0j], round_])
    return SceneCarpet(
        width=cloth.width,
        columns=grid[1],
        rows=grid[0],
        column_pitch=cloth.knot_pitch,
        row_pitch=cloth.row_distance,
        pile=pile,
        line=np.stack([line.real, line.imag], axis=1),
    )

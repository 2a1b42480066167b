"""Screws of fixed joints: by the meshes of the parts, of which neither the faces nor the holes of the code know."""

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from default_machines import SETTLED
from made_parts import measured

from ilmek.arrays import Float, FloatArray
from ilmek.elements.columns import STEEL
from ilmek.elements.machine_screws import SOCKET_SCREWS, screw_of
from ilmek.elements.motors import MOTORS, Motor
from ilmek.machines.automated_loom import MACHINE, loom_tree
from ilmek.machines.catalogue import MACHINES
from ilmek.part import catalogue
from ilmek.part.bolting import bolted
from ilmek.part.fastenings import Means, fastenings
from ilmek.part.features import drillings
from ilmek.part.part import Bought, HolePattern, Part, bought_part
from ilmek.part.placement import Placement, placement
from ilmek.part.poses import chains, poses
from ilmek.part.shapes import Drilling, Placed, Prism, Shape, Sum, box, square_tube
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.report.scene import Solid
from ilmek.units import mm, um

SETTINGS = (SETTLED, {**SETTLED, "beat": "linkage"})
LONE = ("weft", "tufting-machine", "shedding", "hammer", "beat-up")


def plate(name: str, thickness: float, wide: float = 0.06, z: float = 0.0) -> Occurrence:
    part = Part(f"test/{name}", name, "machined link", box(wide, 0.05, thickness), STEEL)
    return Occurrence(part, (placement(z=z),))


def on_each_other(first: float, second: float) -> Tree:
    upright = placement(about=(1.0, 0.0, 0.0), angle=-math.pi / 2)  # only the lower one stands on the floor
    plates = plate("lower", first), plate("upper", second, z=first)
    return Tree((RigidBody("test/body", plates, positions=(upright,)),))


def test_two_plates_have_four_screws_and_what_is_too_thin_is_loose() -> None:
    tree = bolted(on_each_other(12 * mm, 10 * mm))
    (screw,) = (own for own in tree.bodies[0].occurrences if own.part.joins)
    assert set(screw.part.joins) == {"test/lower", "test/upper"}
    assert len(screw.positions) == 4
    assert screw_of(screw.part.purchase.row if screw.part.purchase else "") in SOCKET_SCREWS.values()
    assert fastenings(tree).loose == ()
    assert Means.NONE not in fastenings(tree).contacts
    loose = fastenings(bolted(on_each_other(1 * mm, 1 * mm))).loose
    assert set(loose) & {"test/lower", "test/upper"}


def test_a_part_that_holds_itself_needs_no_screw_and_gets_none() -> None:
    (body,) = on_each_other(12 * mm, 10 * mm).bodies
    lower, upper = body.occurrences
    clipped = replace(upper, part=replace(upper.part, fixing="snaps onto the lower one"))
    tree = bolted(Tree((replace(body, occurrences=(lower, clipped)),)))
    assert not any(own.part.joins for own in tree.bodies[0].occurrences)
    assert fastenings(tree).contacts == {Means.OWN: 1}
    assert fastenings(tree).loose == ()


@pytest.mark.parametrize("row", [MOTORS[3], MOTORS[-1]])
def test_of_two_bought_parts_the_heads_are_in_the_flange_of_the_motor(row: Motor) -> None:
    shorter = box(row.face, row.face, row.length / 2)
    axis = bought_part("test/axis", "axis", "linear axis", shorter, Bought("axis"))
    motor = catalogue.motor("test/motor", "motor", row, 1.0, 1.0)
    tree = bolted(Tree((RigidBody("test/body", (Occurrence(axis), Occurrence(motor))),)))
    (screw,) = (own for own in tree.bodies[0].occurrences if own.part.joins)
    assert screw.part.joins == ("test/motor", "test/axis")
    assert len(screw.positions) == 4


def test_a_tube_has_threads_in_its_wall_and_no_heads_in_it() -> None:
    tube = Part("test/tube", "tube", "welded frame", square_tube(0.06, 0.006, 0.3), STEEL)
    lies = placement(y=0.03, about=(1.0, 0.0, 0.0), angle=-math.pi / 2)
    tree = bolted(Tree((RigidBody("test/body", (Occurrence(tube), Occurrence(plate("top", 0.012).part, (lies,)))),)))
    (screw,) = (own.part for own in tree.bodies[0].occurrences if own.part.joins)
    assert screw.joins == ("test/top", "test/tube")
    (drilled,) = (own.part.shape for own in tree.bodies[0].occurrences if own.part.id == "test/tube")
    assert {hole.through for hole in drillings(drilled)} == {True}
    assert {round(hole.steps[0][1], 9) for hole in drillings(drilled)} == {0.006}


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("settings", SETTINGS)
def test_every_screw_of_a_loom_is_in_a_hole_and_in_a_thread(settings: dict[str, str]) -> None:
    loom = MACHINE.designed(MACHINE.params.read(settings))
    tree = bolted(loom_tree(loom))
    assert sum(number for part, number in tree.occurrences() if part.joins and part.purchase) > 300
    assert not list(faults(tree))


@pytest.mark.parametrize("machine", LONE)
def test_every_screw_of_a_machine_is_in_a_hole_and_in_a_thread(machine: str) -> None:
    component = MACHINES[machine]
    assert component.tree is not None
    assert not list(faults(bolted(component.tree(component.designed(component.params())))))


def test_a_planted_screw_without_holes_is_seen() -> None:
    tree = bolted(on_each_other(12 * mm, 10 * mm))
    body = tree.bodies[0]
    (screw,) = (own for own in body.occurrences if own.part.joins)
    bare = on_each_other(12 * mm, 10 * mm).bodies[0]
    assert len(list(faults(Tree((RigidBody("test/body", (*bare.occurrences, screw)),))))) == 1


def test_heads_are_sunk_no_deeper_than_they_are_high_where_screws_are_long_enough() -> None:
    tree = bolted(loom_tree(MACHINE.designed(MACHINE.params())))
    rows = {round(row.sink, 6): row for row in SOCKET_SCREWS.values()}
    made = (part.shape for part, _ in tree.occurrences() if part.material is not None)
    holes = [hole for shape in made if shape is not None for hole in drillings(shape)]
    mouths = [(rows.get(round(hole.steps[0][0], 6)), hole.steps[0][1]) for hole in holes]
    over = {row.name for row, deep in mouths if row is not None and deep > row.head + 1.001 * mm}
    assert len([row for row, _ in mouths if row is not None]) > 100
    assert over <= {"M2", "M2.5"}  # no longer than ten of their diameters, in parts that are thicker


@pytest.mark.parametrize("settings", SETTINGS)
def test_bought_parts_of_a_loom_have_screws_in_all_holes_of_their_catalogue(settings: dict[str, str]) -> None:
    tree = bolted(loom_tree(MACHINE.designed(MACHINE.params.read(settings))))
    assert not list(unlike_catalogue(tree))
    motors = {part.id for part, _ in tree.occurrences() if part.purchase and part.purchase.drives}
    assert motors <= {name for part, _ in tree.occurrences() if part.purchase for name in part.joins}


@pytest.mark.parametrize("machine", LONE)
def test_bought_parts_of_a_machine_have_screws_in_all_holes_of_their_catalogue(machine: str) -> None:
    component = MACHINES[machine]
    assert component.tree is not None
    assert not list(unlike_catalogue(bolted(component.tree(component.designed(component.params())))))


def test_a_planted_screw_beside_the_holes_of_a_catalogue_is_seen() -> None:
    row = next(own for own in MOTORS if own.face == 42.3 * mm)
    motor = catalogue.motor("test/motor", "motor", row, 1.0, 1.0)
    tree = bolted(Tree((RigidBody("test/body", (Occurrence(motor), plate("top", 0.012))),)))
    body = tree.bodies[0]
    (screw,) = (own for own in body.occurrences if own.part.joins)
    assert screw.part.joins == ("test/top", "test/motor")
    assert not list(unlike_catalogue(tree))
    moved = replace(screw, positions=(screw.positions[0].after(placement(x=0.2 * mm)), *screw.positions[1:]))
    for changed in (moved, replace(screw, positions=screw.positions[:3])):
        others = tuple(own for own in body.occurrences if own is not screw)
        assert list(unlike_catalogue(Tree((replace(body, occurrences=(*others, changed)),))))


def faults(tree: Tree) -> Iterator[str]:
    """Screws of which a ring about the shank is not in its hole, or one at its thread's tip is not in the material.

    Of each part of screws the first is tried, at four points round: through the part under the head there is a hole
    wider than the screw, in material; the other part has material about the thread, of a diameter's length at least.
    """
    stands = standing(tree)
    parts = {part.id: part for part, _ in tree.occurrences()}
    for screw in (part for part in parts.values() if part.joins and part.purchase):
        row = screw_of(screw.purchase.row) if screw.purchase else None
        assert row is not None
        assert screw.shape is not None
        length = float(screw.shape.mesh().points[:, 2].max())
        head, thread = (parts[name] for name in screw.joins)
        lies = stands[screw.id][0]
        under = ring(lies, row.hole / 2 - 50 * um, 0.2 * mm)
        about = ring(lies, row.hole / 2 + 100 * um, 0.2 * mm)
        tapped = ring(lies, row.diameter / 2 - 100 * um, length - 0.2 * mm)
        ends = (ring(lies, row.diameter / 2 + 100 * um, length - share * row.diameter) for share in (0.05, 0.95))
        around = np.concatenate([*ends])
        if not any(hollow(head, own, under, about) for own in stands[head.id]):
            yield f"{screw.id}: no hole in {head.id}"
        elif not any(hollow(thread, own, tapped, around) for own in stands[thread.id]):
            yield f"{screw.id}: no thread in {thread.id}"


def ring(lies: Placement, radius: float, z: float) -> Float[np.ndarray, "points 3"]:
    """Points round the axis of a screw [m]."""
    angle = math.pi / 8 + np.arange(4) * math.pi / 2
    return lies.points(np.stack([radius * np.cos(angle), radius * np.sin(angle), np.full(4, z)], axis=1))


def hollow(part: Part, lies: Placement, free: FloatArray, filled: FloatArray) -> bool:
    """Whether a part that lies there has no material at some points and has it at others."""
    assert part.shape is not None
    solid = part.shape.mesh(5 * um)
    back = lies.inverse
    return not inside(solid, back.points(free)).any() and bool(inside(solid, back.points(filled)).all())


def inside(solid: Solid, points: FloatArray) -> FloatArray:
    """Whether points are in a closed surface: its solid angle there is a whole one.   [Van Oosterom, Strackee 1983]"""
    found = []
    for point in points:
        a, b, c = (solid.points[solid.triangles[:, k]] - point for k in range(3))
        x, y, z = (np.linalg.norm(own, axis=1) for own in (a, b, c))
        above = (a * np.cross(b, c)).sum(1)
        below = x * y * z + (a * b).sum(1) * z + (b * c).sum(1) * x + (c * a).sum(1) * y
        found.append(abs(float(np.arctan2(above, below).sum())) > math.pi)
    return np.array(found)


def drilled_parts() -> list[Shape]:
    """Ten drilled shapes of a loom, the most drilled first."""
    loom = MACHINE.designed(MACHINE.params())
    shapes = (part.shape for part, _ in bolted(loom_tree(loom)).occurrences() if part.material is not None)
    holed = [shape for shape in shapes if isinstance(shape, Prism) and shape.drilled]
    return sorted(holed, key=lambda shape: -len(drillings(shape)))[:10]  # type: ignore[return-value]


def test_drilled_parts_weigh_what_their_surface_encloses_and_the_kernel_measures() -> None:
    shapes = drilled_parts()
    assert len(shapes) == 10
    step = pytest.importorskip("ilmek.io.step")
    for shape in shapes:
        mass, centre, _ = measured(shape.mesh(2 * um), 1.0)
        assert (
            abs(mass - shape.volume) < 5e-3 * sum(hole.shape.volume for hole in drillings(shape)) + 1e-6 * shape.volume
        )
        assert np.abs(centre - shape.moments.centre).max() < 2 * um
        assert step._volume(step.shape_solid(shape)) * mm**3 == pytest.approx(shape.volume, rel=1e-6)


def test_a_counterbored_hole_takes_away_what_it_is_made_of() -> None:
    lies = placement(z=0.02, about=(1.0, 0.0, 0.0), angle=math.pi)
    hole = Drilling(lies, ((0.011, 0.006), (0.0066, 0.014)), through=True)
    shape = Prism(box(0.05, 0.04, 0.02).section, 0.02, (hole,))
    taken = math.pi / 4 * (0.011**2 * 0.006 + 0.0066**2 * 0.014)
    assert shape.volume == pytest.approx(0.05 * 0.04 * 0.02 - taken, rel=1e-12)


def unlike_catalogue(tree: Tree) -> Iterator[str]:
    """Pieces of bought parts of which a face has screws that are not those of its catalogue, by their mesh."""
    stands = standing(tree)
    screws = [part for part, _ in tree.occurrences() if part.joins and part.purchase]
    axes = {part.id: [(lies.origin, lies.rotation[:, 2]) for lies in stands[part.id]] for part in screws}
    for part, _ in tree.occurrences():
        if part.purchase is None or not part.purchase.holes:
            continue
        assert part.shape is not None
        members = part.shape.members if isinstance(part.shape, Sum) else (Placed(part.shape),)
        (body,) = {max(members, key=lambda own: own.shape.volume)}  # without its shaft
        points = body.positions[0].points(body.shape.mesh().points)
        low, high = points.min(0), points.max(0)
        own = [axis for screw in screws if part.id in screw.joins for axis in axes[screw.id]]
        for lies in stands[part.id]:
            back, faces = lies.inverse, dict[tuple[int, int], list[FloatArray]]()
            for origin, ahead in own:
                at, along = back.points(origin[None])[0], back.rotation @ ahead
                axis = int(np.abs(along).argmax())
                if abs(along[axis]) > 1 - 1e-9 and inside_box(at, low, high, axis):
                    up = 1 if at[axis] > (low + high)[axis] / 2 else -1
                    faces.setdefault((axis, up), []).append(np.delete(at - (low + high) / 2, axis))
            for (axis, up), found in faces.items():
                rows = [row for row in part.purchase.holes if (up if axis == 2 else 0) in row.faces]
                if rows or not part.purchase.drilled:
                    size = np.delete(high - low, axis)
                    if not any(same_points(np.array(found), expected(row, size)) for row in rows):
                        yield f"{part.id}: {np.round(np.array(found) / mm, 2).tolist()}"


def expected(row: HolePattern, size: FloatArray) -> Float[np.ndarray, "n 2"]:
    """The holes of a row on a face, by the catalogue's words, the longer distance along the longer side."""
    if row.in_rows:
        number = int(size.max() // row.along)
        line = (np.arange(number) - (number - 1) / 2) * row.along
        points = np.stack([np.zeros(number), line], axis=1)
        return points if size[1] > size[0] else points[:, ::-1]
    pairs = [(-apart / 2, apart / 2) if apart else (0.0,) for apart in (row.across, row.along)]
    points = np.array(list(product(*pairs)))
    swapped = (size[0] - size[1]) * (row.across - row.along) < 0
    return points[:, ::-1] if swapped else points


def same_points(one: FloatArray, other: FloatArray) -> bool:
    """Whether two sets of points are one, in any order, those that stand twice once."""
    gaps = np.linalg.norm(one[:, None] - other, axis=2)
    return bool((gaps.min(0) < um).all() and (gaps.min(1) < um).all())


def inside_box(at: FloatArray, low: FloatArray, high: FloatArray, axis: int) -> bool:
    """Whether a line along an axis through a point is in a box, and the point near to it."""
    across = np.delete(np.stack([low - at, at - high]), axis, axis=1)
    return bool((across < 0).all() and low[axis] - 25 * mm < at[axis] < high[axis] + 25 * mm)


def standing(tree: Tree) -> dict[str, list[Placement]]:
    """By part where its pieces stand."""
    stands: dict[str, list[Placement]] = {}
    for chain in chains(tree):
        here = poses(chain, "", np.zeros(1))
        for occurrence in chain[-1].body.occurrences:
            lies = Placement(here.origin[0], here.rotation[0])
            stands.setdefault(occurrence.part.id, []).extend(lies.after(own) for own in occurrence.positions)
    return stands

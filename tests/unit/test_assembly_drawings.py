"""Assembly drawings: each line of a list has one balloon, whose leader ends on its item; all clear of each other.

The judges know nothing of the code: segments by hand, rays on triangles, another program's reader of DXF, the tree.
"""

import math
from collections import Counter
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from default_machines import default_design
from manifold3d import CrossSection

from ilmek.elements.materials import find_material
from ilmek.elements.prices import PRICES
from ilmek.io.drawings.dxf import write_sheet_dxf
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.catalogue import MACHINES
from ilmek.part.assemblies import AssemblyUnit, assembly_mass, assembly_of, items_of, pieces_of_assembly
from ilmek.part.exploded import exploded
from ilmek.part.part import Part
from ilmek.part.part_lists import parts_list
from ilmek.part.placement import IDENTITY, placement
from ilmek.part.shapes import bar, box, tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.part.visible_lines import PlacedShape, depth_picture, polylines
from ilmek.report.sheet import Issue
from ilmek.viz.drawings.assembly import AssemblySheet, assembly_sheets
from ilmek.viz.drawings.balloons import RADIUS, balloons_about
from ilmek.viz.drawings.item_views import rotation_to
from ilmek.viz.drawings.paper import EDGE, LEFT

STEEL = find_material("structural steel")
FRONT = rotation_to((0.0, 0.0, 1.0), (1.0, 0.0, 0.0))


def machine_tree(name: str) -> Tree:
    machine, design = MACHINES[name], default_design(name)
    return loom_tree(design) if machine.tree is None else machine.tree(design)


def some_assemblies() -> list[tuple[str, int]]:
    """Machine and number of the assembly: small machines, and some of the loom, one of many items among them."""
    return [*((name, 1) for name in ("beat-up", "hammer")), *(("automated-loom", number) for number in (2, 15, 16))]


def sheets_of_assembly(name: str, number: int) -> tuple[Tree, AssemblyUnit, tuple[AssemblySheet, ...]]:
    tree = machine_tree(name)
    assembly = next(own for own in assembly_of(tree, name).every if own.number == number)
    return tree, assembly, tuple(assembly_sheets(tree, assembly, Issue()))


def distance(start: complex, end: complex, point: complex) -> float:
    """Of a point from a segment."""
    share = ((point - start) * (end - start).conjugate()).real / abs(end - start) ** 2
    return abs(start + min(max(share, 0.0), 1.0) * (end - start) - point)


def cross(a: complex, b: complex, c: complex, d: complex) -> bool:
    """Whether segments a b and c d meet, by the signs of areas."""

    def side(p: complex, q: complex, r: complex) -> float:
        return ((q - p).conjugate() * (r - p)).imag

    return side(a, b, c) * side(a, b, d) <= 0 and side(c, d, a) * side(c, d, b) <= 0


def assert_sheet_is_clear(drawn: AssemblySheet) -> None:
    sheet, balloons = drawn.sheet, drawn.balloons
    for number, own in enumerate(balloons):
        assert LEFT + RADIUS < own.centre.real < sheet.width - EDGE - RADIUS
        assert EDGE + RADIUS < own.centre.imag < sheet.height - EDGE - RADIUS
        for other in balloons[:number]:
            assert abs(own.centre - other.centre) > 2 * RADIUS
            assert not cross(own.centre, own.tip, other.centre, other.tip), (own.name, other.name)
        for other in balloons:
            assert other is own or distance(own.centre, own.tip, other.centre) > RADIUS, (own.name, other.name)


@pytest.mark.parametrize(("name", "number"), some_assemblies())
def test_lists_balloons_and_tree_are_one_to_one_and_clear(name: str, number: int, tmp_path: Path) -> None:
    tree, assembly, sheets = sheets_of_assembly(name, number)
    names = sorted(item.name for item in items_of(tree, assembly))
    assert len([drawn for drawn in sheets if drawn.balloons]) == 2
    assert all(drawn.balloons for drawn in sheets[:2])  # a third one has the positions of welded pieces
    for drawn in sheets[:2]:
        assert sorted(own.name for own in drawn.balloons) == names
        assert_sheet_is_clear(drawn)
        write_sheet_dxf(tmp_path / "a.dxf", drawn.sheet)
        space = ezdxf.readfile(tmp_path / "a.dxf").modelspace()
        leaders = [line for line in space.query("LWPOLYLINE[layer=='LEADER']") if not line.closed]
        circles = [line for line in space.query("LWPOLYLINE[layer=='LEADER']") if line.closed]
        centres = [np.mean(line.get_points("xy"), axis=0) for line in circles]
        texts = [(entity.dxf.text, np.array([*entity.get_placement()[1]][:2])) for entity in space.query("TEXT")]
        inside = [[text for text, at in texts if np.hypot(*(at - centre)) < RADIUS - 1] for centre in centres]
        assert sorted(text for found in inside for text in found) == names
        assert len(leaders) == len(circles) == len(names)


def test_assemblies_divide_the_loom_as_its_parts_list_says() -> None:
    tree = machine_tree("automated-loom")
    whole = assembly_of(tree, "loom")
    pieces, once = Counter[str](), Counter[str]()
    for assembly in whole.every:
        once.update(body.id for body in assembly.bodies)
        for item in items_of(tree, assembly):
            if isinstance(item.made_of, Part):
                pieces[item.made_of.id] += item.quantity * assembly.count
    assert once == Counter(body.id for body in tree.bodies)
    assert pieces == {part.id: number for part, number in tree.occurrences()}
    assert assembly_mass(tree, whole) == pytest.approx(tree.mass)
    for assembly in whole.every:
        listed = math.fsum(item.quantity * item.mass for item in items_of(tree, assembly) if not math.isnan(item.mass))
        assert listed == pytest.approx(assembly_mass(tree, assembly))
    rows = parts_list(tree, PRICES).rows
    numbers = {str(row[1]): str(row[0]) for row in rows}
    drawn = {str(row[1]): str(row[4]).split() for row in rows}
    for assembly in whole.every:
        for item in items_of(tree, assembly):
            if isinstance(item.made_of, Part):
                assert item.name == numbers[item.made_of.id]
                drawn[item.made_of.id].remove(assembly.drawing)
    assert not any(drawn.values())


def nearest_item(pieces: list[PlacedShape], rotation: np.ndarray, point: complex) -> int:
    """The item that a ray towards the eye's side meets last: of all triangles over a point that nearest to the eye."""
    best, item = -math.inf, -1
    for piece in pieces:
        mesh = piece.shape.mesh(5e-5)
        a, b, c = np.moveaxis((piece.position.points(mesh.points) @ rotation.T)[mesh.triangles], 1, 0)
        u, v, w = b - a, c - a, np.array([point.real, point.imag]) - a[:, :2]
        area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
        area = np.where(area == 0, np.inf, area)
        s, t = (w[:, 0] * v[:, 1] - w[:, 1] * v[:, 0]) / area, (u[:, 0] * w[:, 1] - u[:, 1] * w[:, 0]) / area
        hit = (s >= 0) & (t >= 0) & (s + t <= 1) & np.isfinite(area)
        heights = (a[:, 2] + s * u[:, 2] + t * v[:, 2])[hit]
        if len(heights) and heights.max() > best:
            best, item = float(heights.max()), piece.item
    return item


@pytest.mark.parametrize("eye", [FRONT, rotation_to((-1.0, 0.0, 0.0), (0.0, 0.0, 1.0))])
def test_what_is_seen_is_what_a_ray_meets(eye: np.ndarray) -> None:
    tree = machine_tree("beat-up")
    pieces = [
        PlacedShape(own.item, own.part.shape, own.position)
        for own in pieces_of_assembly(tree, assembly_of(tree, ""))
        if own.part.shape is not None
    ]
    picture = depth_picture(pieces, eye, 1e-3)
    rows, columns = picture.items.shape
    missed = 0
    choose = np.random.default_rng(1)
    for row, column in zip(choose.integers(0, rows, 150), choose.integers(0, columns, 150), strict=True):
        missed += nearest_item(pieces, eye, picture.point(int(row), int(column))) != picture.items[row, column]
    assert missed <= 2  # at rims


def test_a_bar_hides_what_is_behind_it() -> None:
    """A square of 100 before a bar of 300 x 20: of each of the bar's long sides two pieces of 100 are seen."""
    square, across = box(0.1, 0.1, 0.01), box(0.3, 0.02, 0.01)
    pieces = [PlacedShape(0, square, placement(z=0.02)), PlacedShape(1, across, IDENTITY)]
    lines = depth_picture(pieces, FRONT, 1e-4).lines()
    total = sum(float(np.abs(np.diff(line)).sum()) for line in lines)
    assert total == pytest.approx(4 * 0.1 + 2 * 0.02 + 4 * 0.1, abs=8e-4)


def test_lines_are_joined_where_two_meet() -> None:
    square = np.array([[0j, 4 + 0j], [4 + 4j, 4 + 0j], [4j, 4 + 4j], [0j, 4j]])
    star = np.array([[10 + 10j, 14 + 10j], [10 + 10j, 6 + 10j], [10 + 10j, 10 + 14j]])
    joined = polylines(np.concatenate([square, star]))
    assert sorted(len(line) for line in joined) == [2, 2, 2, 5]


def test_leaders_do_not_cross_for_tips_at_random() -> None:
    choose = np.random.default_rng(3)
    for _ in range(20):
        tips = choose.uniform(0, 180, 25) + 1j * choose.uniform(0, 120, 25)
        made = balloons_about([str(k) for k in range(25)], tips, (0.0, 0.0, 180.0, 120.0), ("left", "top", "right"))
        assert len({own.centre for own in made}) == 25
        assert not any(
            cross(own.centre, own.tip, other.centre, other.tip) for k, own in enumerate(made) for other in made[:k]
        )
    with pytest.raises(ValueError, match="26 balloons"):
        balloons_about([str(k) for k in range(26)], np.zeros(26, dtype=complex), (0, 0, 100, 100), ("left",))


def test_a_shaft_is_taken_out_of_its_hub_along_their_axis() -> None:
    hub = Part("probe/hub", "hub", "turned part", tube(0.06, 0.015, 0.02), STEEL)
    shaft = Part("probe/shaft", "shaft", "turned part", bar(0.03, 0.02), STEEL)
    plate = Part("probe/plate", "plate", "laser-cut part", box(0.2, 0.2, 0.01), STEEL)
    turned = placement(about=(1.0, 0.0, 0.0), angle=math.pi / 2)
    stand = RigidBody("stand", (Occurrence(plate, (placement(z=-0.3),)), Occurrence(hub, (turned,))))
    turning = RigidBody("turning", (Occurrence(shaft, (turned,)),), "stand", Joint(JointKind.PIN, axis=(0.0, 1.0, 0.0)))
    tree = Tree((stand, turning))
    whole = assembly_of(tree, "probe")
    blocks = {own.pieces[0].part.id: own for own in exploded(tree, whole, pieces_of_assembly(tree, whole))}
    assert not blocks["probe/plate"].shift.any()
    x, y, z = (blocks["probe/shaft"].shift - blocks["probe/hub"].shift).tolist()
    assert (x, z) == pytest.approx((0.0, 0.0), abs=1e-9)
    assert abs(y) > 0.02  # clear of the hub


def middle(points: np.ndarray, axis: np.ndarray) -> float:
    heights = points @ axis
    return float(heights.max() + heights.min()) / 2


@pytest.mark.parametrize("name", ["automated-loom", "tension-compensator", "beat-up", "weft"])
def test_what_is_taken_apart_keeps_its_order_along_each_line(name: str) -> None:
    """By manifold3d: blocks moved along one axis, whose outlines along it have 5 % of the smaller in common."""
    tree, pairs = machine_tree(name), 0
    for assembly in assembly_of(tree, name).every:
        blocks = exploded(tree, assembly, pieces_of_assembly(tree, assembly))
        meshes = [
            np.concatenate([own.position.points(own.part.shape.mesh(2e-4).points) for own in block.pieces])
            for block in blocks
        ]
        moves = [block.line[1] - block.line[0] for block in blocks]
        for k, axis in ((k, move / np.linalg.norm(move)) for k, move in enumerate(moves) if np.linalg.norm(move) > 0):
            across = np.linalg.svd(axis[None])[2][1:]
            outline = CrossSection.hull_points(meshes[k] @ across.T)
            for n, move in enumerate(moves):
                apart = blocks[k].shift - blocks[n].shift
                along = np.linalg.norm(move) > 0 and abs(move @ axis) > (1 - 1e-6) * np.linalg.norm(move)
                if n == k or not along or np.linalg.norm(np.cross(apart, axis)) > 1e-6:
                    continue
                other = CrossSection.hull_points(meshes[n] @ across.T)
                before = middle(meshes[k], axis) - middle(meshes[n], axis)
                if abs(before) > 1e-4 and (outline ^ other).area() > 0.05 * min(outline.area(), other.area()):
                    pairs += 1
                    assert before * (before + apart @ axis) > 0, (assembly.name, blocks[k].pieces[0].part.id)
    assert pairs > 10

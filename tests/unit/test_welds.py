"""Welds of a frame made by hand, and their symbols on a sheet, read by ezdxf."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from ilmek.elements.materials import find_material
from ilmek.jobs.workshop import write_workshop
from ilmek.part.part import Part
from ilmek.part.part_lists import cut_list
from ilmek.part.placement import Placement, placement
from ilmek.part.plates import pieces_of, plates_of
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, box, square_tube
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.part.welds import welds_of
from ilmek.plane.contours import polygon
from ilmek.report import Report
from ilmek.report.scene import SceneMotion
from ilmek.units import mm

STEEL = find_material("structural steel")
X = (1.0, 0.0, 0.0)
SIDE = 40 * mm
"""Of an arm, which leaves room for a fillet on its post on both sides."""


def tube(name: str, wall: float, length: float, throat: float = 0.0, side: float = 50 * mm) -> Part:
    shape = square_tube(side, wall, length)
    return Part(f"probe/{name}", name, "welded frame", shape, STEEL, throat=throat)


def frame(gap: float = 0.0, throat: float = 0.0) -> Tree:
    """A post along z, and an arm of a thinner wall whose end stands on its side y = 25 mm, 300 mm up."""
    post, arm = tube("post", 5 * mm, 0.6), tube("arm", 3 * mm, 0.4, throat, SIDE)
    lies = placement(0.0, 25 * mm + gap, 0.3, about=X, angle=-np.pi / 2)
    return Tree((RigidBody("body", (Occurrence(post), Occurrence(arm, (lies,)))),))


def test_an_arm_is_welded_round_its_end_by_its_wall_or_its_strength() -> None:
    ((part, (weld,)),) = welds_of(frame()).items()
    assert (part, weld.other, weld.all_round) == ("probe/arm", "probe/post", True)
    assert weld.throat == 2 * mm  # 0.7 of 3 mm is the largest
    assert np.allclose(weld.middle, 0, atol=1e-12)
    assert welds_of(frame(throat=4 * mm))["probe/arm"][0].throat == 4 * mm


def test_what_is_apart_or_moves_is_not_welded() -> None:
    assert not welds_of(frame(gap=0.5 * mm))
    (body,) = frame().bodies
    post, arm = (RigidBody(own.part.id, (own,)) for own in body.occurrences)
    assert welds_of(Tree((post, arm)))  # both stand
    turn = SceneMotion("row", np.array([0.0, 6.0]), np.zeros((2, 3)), np.array([0.0, 0.1]))
    assert not welds_of(Tree((post, replace(arm, joint=Joint(JointKind.PIN, motion=turn)))))


def test_the_sheet_of_an_arm_has_the_symbol_and_the_cut_of_the_list(tmp_path: Path) -> None:
    tree = frame()
    report = Report("probe", "Probe", {}, (), (), plates=plates_of(tree), pieces=pieces_of(tree))
    write_workshop(report, tmp_path / "out")
    sheet = ezdxf.readfile(tmp_path / "out" / "arm.sheet.dxf")
    drawn = list(sheet.modelspace().query("LWPOLYLINE[layer=='WELD']"))
    fillets = [line for line in drawn if len(line) == 3 and line.closed]
    rings = [line for line in drawn if len(line) == 2 and all(bulge for *_, bulge in line.get_points("xyb"))]
    assert len(fillets) == len(rings) == 1
    corners = np.array(fillets[0].get_points("xy"))
    legs = sorted(abs(complex(*(b - a))) for a, b in pairwise([*corners, corners[0]]))
    assert legs[0] == pytest.approx(legs[1])
    assert legs[2] ** 2 == pytest.approx(2 * legs[0] ** 2)
    words = [text.dxf.text for text in sheet.modelspace().query("TEXT")]
    assert any(text.startswith("a2") and text.endswith("post") and "160" in text for text in words)
    row = words[words.index("all round") :][:6]
    assert row == ["all round", "160", "0…40", "0…40", "0", "1/1"]
    rows = {row[-1]: row for row in cut_list(tree).rows}
    section, _, _, named = rows["probe/arm"][:4]
    assert section in words
    assert named == f"1 x {words[words.index(section) + 1]} mm"


def beside(corners: tuple[complex, ...]) -> Tree:
    """A post along z, and a plate of those corners [mm], which lies flat on its side x = 25 mm: its x upwards."""
    post = tube("post", 5 * mm, 0.6)
    plate = Part(
        "probe/plate", "plate", "laser-cut part", Prism(Profile(polygon(np.array(corners) * mm)), 10 * mm), STEEL
    )
    turned = Placement(np.array([25 * mm, -40 * mm, 0.1]), np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]]))
    return Tree((RigidBody("body", (Occurrence(post), Occurrence(plate, (turned,)))),))


PLATES = {
    "rectangle": (0, -200, -200 + 80j, 80j),
    "trapezium": (0, -200, -120 + 80j, 80j),
    "short": (0, -50, -50 + 80j, 80j),
}


@pytest.mark.parametrize("name", PLATES)
def test_seams_lie_on_the_edges_of_the_common_face_that_the_kernel_finds(name: str) -> None:
    """A plate on a post is welded where the post's edges lie on it, or where it ends on the post."""
    tree = beside(PLATES[name])
    ((owner, (weld,)),) = welds_of(tree).items()
    assert owner == "probe/post"
    found = [np.sort(edge, axis=0) for edge in common_edges(tree)]
    for seam in weld.seams:
        ends = np.sort(seam, axis=0)
        assert any(np.allclose(ends, edge, atol=0.2 * mm) for edge in found), ends
    assert len(weld.seams) == 2
    longest = sorted(np.linalg.norm(np.ptp(edge, axis=0)) for edge in found)
    parallel = [v for v in longest if v > 45 * mm]
    assert sum(weld.lengths) <= sum(parallel) + 0.5 * mm


def common_edges(tree: Tree) -> list[np.ndarray]:
    """Straight edges of the face that both parts share [m], by the CAD kernel."""
    pytest.importorskip("OCP")
    from OCP.BRepAdaptor import BRepAdaptor_Curve  # noqa: PLC0415
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Section  # noqa: PLC0415
    from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform  # noqa: PLC0415
    from OCP.gp import gp_Trsf  # noqa: PLC0415
    from OCP.TopAbs import TopAbs_ShapeEnum  # noqa: PLC0415
    from OCP.TopExp import TopExp_Explorer  # noqa: PLC0415
    from OCP.TopoDS import TopoDS  # noqa: PLC0415

    from ilmek.io.step import shape_solid  # noqa: PLC0415

    solids = []
    for occurrence in tree.bodies[0].occurrences:
        move, (lies,) = gp_Trsf(), occurrence.positions
        rows = np.column_stack([lies.rotation, lies.origin / mm]).ravel().tolist()
        move.SetValues(*rows)
        solids.append(BRepBuilderAPI_Transform(shape_solid(occurrence.part.shape), move, True).Shape())
    explorer, found = TopExp_Explorer(BRepAlgoAPI_Section(*solids).Shape(), TopAbs_ShapeEnum.TopAbs_EDGE), []
    while explorer.More():
        curve = BRepAdaptor_Curve(TopoDS.Edge(explorer.Current()))
        ends = [curve.Value(at) for at in (curve.FirstParameter(), curve.LastParameter())]
        found.append(np.array([[end.X(), end.Y(), end.Z()] for end in ends]) * mm)
        explorer.Next()
    return found


def test_two_pieces_of_a_part_may_have_unlike_welds() -> None:
    """Each weld says how many of the pieces have it."""
    post, arm = tube("post", 5 * mm, 0.6), tube("arm", 3 * mm, 0.4, side=SIDE)
    along, back = (
        placement(0.0, 25 * mm, 0.3, about=X, angle=-np.pi / 2),
        placement(0.0, -25 * mm, 0.3, about=X, angle=np.pi / 2),
    )
    tree = Tree((RigidBody("body", (Occurrence(post), Occurrence(arm, (along, back)))),))
    ((_, (weld,)),) = welds_of(tree).items()
    assert weld.pieces == 2
    assert weld.lengths == pytest.approx((0.16,))


def welds_at(height: float, aside: float = 0.0, side: float = SIDE) -> dict[bool, tuple[float, ...]]:
    """Lengths of the fillets and of the bevels of an arm of a side on a post of 50 mm, which ends 0.6 m up [mm]."""
    post, arm = tube("post", 5 * mm, 0.6), tube("arm", 5 * mm, 0.4, side=side)
    lies = placement(aside, 25 * mm, height, about=X, angle=-np.pi / 2)
    welds = welds_of(Tree((RigidBody("body", (Occurrence(post), Occurrence(arm, (lies,)))),)))["probe/arm"]
    return {weld.bevel: tuple(round(length / mm, 1) for length in weld.lengths) for weld in welds}


def test_an_edge_has_a_fillet_where_the_other_face_goes_on_and_a_bevel_where_both_end() -> None:
    assert welds_at(0.3) == {False: (160.0,)}
    assert welds_at(0.3, side=50 * mm) == {False: (50.0, 50.0), True: (50.0, 50.0)}
    assert welds_at(0.58) == {False: (40.0, 40.0, 40.0), True: (40.0,)}  # flush with the post's end
    assert welds_at(0.3, aside=5 * mm) == {False: (40.0, 40.0, 40.0), True: (40.0,)}


def test_no_seam_crosses_the_open_end_of_a_tube() -> None:
    """Of an arm that half of stands out over the post, the post's edge lies before the opening: two sides are short."""
    assert welds_at(0.6) == {False: (40.0, 20.0, 20.0)}
    assert welds_at(0.3, aside=25 * mm) == {False: (40.0, 20.0, 20.0)}


def test_a_long_seam_is_stitched() -> None:
    bar = Part("probe/bar", "bar", "laser-cut part", box(30 * mm, 10 * mm, 0.5), STEEL)
    lies = placement(0.0, 30 * mm, 0.05)
    (weld,) = welds_of(Tree((RigidBody("body", (Occurrence(tube("post", 5 * mm, 0.6)), Occurrence(bar, (lies,)))),)))[
        "probe/post"
    ]
    assert weld.stitched
    assert weld.lengths == (50 * mm,) * 8  # 2 x 4 of 150 mm pitch in 500 mm

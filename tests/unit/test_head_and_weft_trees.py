"""Head and weft as trees: each line a part and back, masses by the meshes, six cams in the case, the opener's walls."""

import itertools
from functools import cache
from typing import Any

import numpy as np
import pytest
from cloths import cloth
from default_machines import loom_report
from hypothesis import given
from hypothesis import strategies as st
from manifold3d import Manifold, Mesh
from matplotlib.path import Path as Outline

from ilmek.elements.involute import Gear
from ilmek.errors import ParameterError
from ilmek.machines.automated_loom import MACHINE as LOOM
from ilmek.machines.automated_loom.in_space.scene import loom_tree, scene
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.machines.component import Component
from ilmek.machines.weaver import MACHINE as HEAD
from ilmek.machines.weaver import Weaver, WeaverParams, head_mass, turning
from ilmek.machines.weaver.followers import follower_id
from ilmek.machines.weaver.lever_parts import lever_id
from ilmek.machines.weaver.motions import HANDLER, SLEY
from ilmek.machines.weaver.moved import moved_mass
from ilmek.machines.weaver.parts import AXIAL_PLAY, BEARING, LEAST_LIP, SIDE_PLATES
from ilmek.machines.weaver.return_springs import spring_id
from ilmek.machines.weaver.tool_parts import OPENER_PLATE, SLEY_BODY
from ilmek.machines.weaver.transmissions import CAM_SHAFT
from ilmek.machines.weaver.tree import head_tree
from ilmek.machines.weaver.widths import case_width
from ilmek.machines.weft import MACHINE as WEFT
from ilmek.machines.weft import Rapier, Shuttle, WeftParams
from ilmek.machines.weft.carriers import BOBBIN, FITTINGS, MAGNET, RAPIER_TUBE, SHUTTLE_WOOD
from ilmek.machines.weft.tree import DRAGGING
from ilmek.part.bolting import bolted
from ilmek.part.part import Part
from ilmek.part.placement import IDENTITY, Placement
from ilmek.part.seat_faces import prism_of
from ilmek.part.tree import GROUND, Occurrence, Tree
from ilmek.plane.solids import bounds, is_closed, volume
from ilmek.report.scene import Scene
from ilmek.units import mm

_HEADS = st.fixed_dictionaries(
    {
        "cloth": st.floats(5e-4, 6e-3).map(lambda pitch: cloth(warp_pitch=pitch)),
        "tubes": st.integers(1, 60),
        "magazine": st.sampled_from(["drum", "slide"]),
        "shaft": st.floats(0.01, 0.04),
        "cam_thickness": st.floats(2e-3, 20e-3),
        "cam_gap": st.sampled_from([0.0, 3e-3]),
        "side_plate": st.sampled_from([0.0, 8e-3]),
        "opening": st.floats(5e-3, 40e-3),
        "sley_stroke": st.floats(20e-3, 90e-3),
        "tool_mass": st.sampled_from([0.0, 0.15, 2.0]),
    }
)

_WEFTS = st.fixed_dictionaries(
    {
        "carrier": st.sampled_from(["shuttle", "rapier"]),
        "cloth": st.integers(20, 2000).map(lambda warps: cloth(warps=warps)),
        "wall": st.floats(1e-3, 10e-3),
        "nose": st.sampled_from([0.0, 40e-3]),
        "fittings": st.sampled_from([0.0, 0.15]),
        "lift": st.floats(0.03, 0.2),
        "turn": st.sampled_from([0.0, 0.02]),
    }
)


def _kept(component: Component, design: Any, bodies: Tree) -> None:
    """Each line is a part and back; made parts weigh their closed shapes; checks name parts that are there."""
    report = component.report(design, illustrated=False)
    parts = {part.id: (part, number) for part, number in bodies.occurrences()}
    assert [line.part for line in report.parts] == list(parts)
    for line in report.parts:
        part, number = parts[line.part]
        assert (line.name, line.number) == (part.title, number)
        assert part.shape is not None, part.id
        solid = part.shape.mesh()
        assert is_closed(solid), part.id
        if part.material is not None:
            assert line.mass == pytest.approx(part.shape.moments.zeroth * part.material.density, rel=1e-12)
            assert volume(solid) == pytest.approx(part.shape.moments.zeroth, rel=0.03)
    assert {name for check in report.checks for name in check.parts} <= set(parts)


@given(_HEADS)
def test_every_line_of_a_head_is_a_part_of_its_tree_and_back(settings: dict[str, Any]) -> None:
    try:
        made = HEAD.design(WeaverParams(**settings))
    except ParameterError:
        return
    assert HEAD.tree is not None
    _kept(HEAD, made, HEAD.tree(made))


@given(_WEFTS)
def test_every_line_of_a_weft_is_a_part_of_its_tree_and_back(settings: dict[str, Any]) -> None:
    made = WEFT.design(WeftParams(**settings))
    _kept(WEFT, made, made.bodies.tree.carrying(GROUND, made.bodies.stand))


@cache
def _head(**settings: Any) -> Weaver:
    made: Weaver = HEAD.design(WeaverParams(**settings))
    return made


@pytest.mark.parametrize("settings", [{}, {"tubes": 40}, {"cam_thickness": 12e-3, "cam_gap": 1e-3}])
def test_six_cams_stand_beside_each_other_between_the_side_plates(settings: dict[str, Any]) -> None:
    """Along the axis no two plates overlap, the outermost of all are the side plates, and the head is no narrower."""
    made = _head(**settings)
    shaft = head_tree(made).body(CAM_SHAFT)
    spans = [
        (occurrence.positions[0].origin[2], occurrence.part)
        for occurrence in shaft.occurrences
        if occurrence.part.process == "cam plate"
    ]
    assert len(spans) == len(made.cams) == 6
    ends = [(float(z), float(z) + made.params.cam_thickness) for z, _ in sorted(spans, key=lambda one: one[0])]
    inner = case_width(made.params) / 2 - made.params.side_plate
    assert ends[0][0] >= -inner + made.params.cam_gap - 1e-12
    assert ends[-1][1] <= inner - made.params.cam_gap + 1e-12
    assert all(end <= begin for (_, end), (begin, _) in itertools.pairwise(ends))
    assert made.width >= case_width(made.params) - 1e-12


def _in_space(own: Occurrence, number: int, frame: Placement, x: float = 0.0, slim: float = 1.0) -> Manifold:
    """A piece of a body at a frame, moved along the row [m]; slim: share of its size about its axis."""
    assert own.part.shape is not None
    mesh = own.part.shape.mesh()
    points = frame.after(own.positions[number]).points(mesh.points * [slim, slim, 1.0]) + np.array([x, 0.0, 0.0])
    return Manifold(Mesh(points.astype(np.float32), mesh.triangles.astype(np.uint32)))


@pytest.mark.parametrize("settings", [{}, {"side_plate": 10e-3}, {"cam_gap": 3e-3}])
def test_lips_and_spacers_hold_the_cam_shaft_along_its_axis_with_play(settings: dict[str, Any]) -> None:
    """By manifold3d: each bearing meets its plate beyond half the play outwards, and what is on the shaft inwards."""
    tree = head_tree(_head(**settings))
    case, shaft = tree.bodies[0], tree.body(CAM_SHAFT)
    (bearing,) = (own for own in case.occurrences if own.part.id == BEARING)
    plates = [own for own in case.occurrences if own.part.id in SIDE_PLATES]
    assert len(plates) == len(bearing.positions) == 2

    def common(number: int, x: float) -> tuple[float, float]:
        """With the plates, and with what is on the shaft [mm³]."""
        ring = _in_space(bearing, number, IDENTITY, x, slim=0.98)
        turning = [
            _in_space(own, at, shaft.positions[0])
            for own in shaft.occurrences
            if "spacer" in own.part.id
            for at in range(len(own.positions))
        ]
        walls = [_in_space(own, 0, IDENTITY) for own in plates]
        of_plates, of_shaft = (sum((ring ^ other).volume() for other in every) * 1e9 for every in (walls, turning))
        return of_plates, of_shaft

    for number, position in enumerate(bearing.positions):
        outwards = float(np.sign(position.origin[0]))
        assert common(number, 0.4 * outwards * AXIAL_PLAY)[0] < 0.01
        assert common(number, 0.9 * outwards * AXIAL_PLAY)[0] > 5.0
        assert common(number, -0.1 * outwards * AXIAL_PLAY)[1] > 2.0


def test_a_plate_too_thin_for_a_lip_fails() -> None:
    (lip,) = (check for check in HEAD.report(_head(side_plate=6e-3)).checks if "lip" in check.name)
    assert not lip.ok
    assert lip.limit == pytest.approx(LEAST_LIP)


def test_the_head_weighs_what_its_solids_and_the_catalogue_say() -> None:
    """Of the made parts the volumes of their meshes in the scene, of the bought ones the rows' masses."""
    made = _head()
    total = 0.0
    for part, number in head_tree(made).occurrences():
        if part.material is not None and part.shape is not None:
            total += number * volume(part.shape.mesh(2e-6)) * part.material.density
        else:
            total += number * part.mass
    assert head_mass(made) == pytest.approx(total, rel=1e-4)
    assert any(part.id == SIDE_PLATES[0] and part.mass > 0.5 for part, _ in head_tree(made).occurrences())


def test_no_cam_moves_more_than_it_is_designed_for() -> None:
    """The sley with all that moves with it, by the meshes' masses: block, lever about its pivot, spring, follower."""
    made = _head()
    tree = head_tree(made)
    for cam in made.cams:
        tool = made.tool_bodies.moved(cam.name)
        assert moved_mass(made, cam.name) <= tool
        arm = made.handler_radius if cam.name == HANDLER else 1.0
        assert cam.mass_moved[0] == pytest.approx(tool * (arm * cam.ratio) ** 2)
    lever = made.shape.levers[SLEY]
    swung = tree.body(lever_id(SLEY)).moments.second
    spring = next(part.mass for part, _ in tree.occurrences() if part.id == spring_id(SLEY)) / 3
    sliding = tree.body(SLEY_BODY).moments.zeroth + tree.body(follower_id(SLEY)).moments.zeroth / lever.ratio**2
    turning = (swung[0, 0] + swung[1, 1]) / (lever.ratio * lever.arm) ** 2
    assert moved_mass(made, SLEY) == pytest.approx(sliding + turning + spring)
    light = _head(tool_mass=0.01)
    assert not next(check for check in HEAD.report(light).checks if check.name.startswith("mass that a cam")).ok


@pytest.mark.parametrize("pitch", [2 * mm, 4 * mm, 8 * mm])
def test_the_plates_of_the_opener_pass_between_the_warps_and_spread_them(pitch: float) -> None:
    """At each depth the warps, spread evenly over the travel, lie outside the plate, and touch its walls at most."""
    made = _head(cloth=cloth(warp_pitch=pitch / 2))
    opener = made.opener
    part = next(part for part, _ in head_tree(made).occurrences() if part.id == OPENER_PLATE)
    outline = _outline(part)
    radius = opener.diameter / 2
    for depth in np.linspace(1e-5, min(opener.reach, opener.travel) * 0.999, 40):
        share = min(depth / opener.travel, 1.0)
        pair = opener.pitch / 2 + share * (opener.pair - opener.pitch) / 2
        beside = 1.5 * opener.pitch + share * (opener.aside - 1.5 * opener.pitch)
        for middle in (pair, beside):
            ring = middle + 0.98 * radius * np.array([-1.0, 0.0, 1.0])
            assert not outline.contains_points([(depth, y) for y in (*ring, *-ring)]).any(), (depth, middle)
    assert outline.contains_points([(opener.reach * 0.99, (opener.aside - radius) - opener.wall / 2)]).all()


def _outline(part: Part) -> Outline:
    plate, _ = prism_of(part.shape, 0)
    corners = plate.section.outline.points
    return Outline(np.stack([corners.real, corners.imag], axis=1))


def test_the_pinion_has_a_rim_no_undercut_and_rolls_on_its_rack_with_play() -> None:
    """By points in polygons over a pitch: its play is that of the rack, to a fifth."""
    parts = {part.id: part for part, _ in head_tree(_head()).occurrences()}
    pinion, rack, rolls = parts[turning.PINION], parts[turning.RACK], _head().params.pinion
    gear = Gear(2 * rolls / turning.TEETH, turning.TEETH, turning.SHIFT)
    assert not gear.undercut
    assert gear.root_radius - turning.CLUTCH[0] / 2 > 1.2 * gear.module
    assert turning.CLUTCH[0] / 2 == pytest.approx(min(abs(prism_of(pinion.shape, 0)[0].section.holes[0].points)))
    wheel, teeth = (_outline(part).vertices @ [1, 1j] for part in (pinion, rack))
    line, pitch = rolls + turning.SHIFT * gear.module, 2 * np.pi * rolls / turning.TEETH
    bar = Outline(np.stack([line - teeth.real, 4 * pitch - teeth.imag], axis=1))  # a tooth's middle at half a pitch
    assert -teeth.real.min() + turning.SHIFT * gear.module == pytest.approx(turning.BACK)
    half = turning.BACKLASH / 2
    for rolled in np.linspace(0.0, pitch, 25):
        within = [
            bar.contains_points(np.stack([turned.real, turned.imag + aside], axis=1)).any()
            for aside in (-1.2 * half, -0.8 * half, 0.0, 0.8 * half, 1.2 * half)
            for turned in [wheel * np.exp(1j * rolled / rolls) + 1j * -rolled]
        ]
        assert within == [True, False, False, False, True], rolled


def test_a_shuttle_is_hollow_by_its_bobbin_and_full_with_it() -> None:
    """By its mesh; a magnet in each nose, an eye in each end wall."""
    made = WEFT.design(WeftParams(carrier="shuttle"))
    carried = made.carried
    assert isinstance(carried, Shuttle)
    parts = {part.id: part for part, _ in made.bodies.tree.occurrences()}
    wood, core = parts[SHUTTLE_WOOD], parts[BOBBIN]
    assert wood.shape is not None
    assert core.shape is not None
    beech = made.params.shuttle_density
    empty = volume(wood.shape.mesh(1e-7)) * beech + 2 * (parts[FITTINGS].mass + parts[MAGNET].mass)
    assert carried.empty == pytest.approx(empty, rel=1e-4)
    full = empty + volume(core.shape.mesh(1e-7)) * beech + max(one.mass for one in carried.windings)
    assert carried.full == pytest.approx(full, rel=1e-4)
    low, high = bounds(wood.shape.mesh())
    assert high - low == pytest.approx([carried.length, carried.width, carried.depth], abs=1e-9)
    assert made.axis.mass >= carried.full + made.bodies.tree.body(DRAGGING).moments.zeroth


def test_a_rapier_weighs_its_tube_and_gripper() -> None:
    made = WEFT.design(WeftParams(carrier="rapier"))
    assert isinstance(made.carried, Rapier)
    tube = next(part for part, _ in made.bodies.tree.occurrences() if part.id == RAPIER_TUBE)
    assert tube.shape is not None
    mass = volume(tube.shape.mesh()) * made.params.rapier_density
    assert made.carried.mass == pytest.approx(mass + made.params.gripper_mass, rel=1e-9)


@cache
def _loom(weft: str) -> tuple[Any, Scene]:
    settings = {"width": "0.4 m", "length": "0.3 m", "heads": "2", "weft": weft, "beat": "travelling"}
    made = LOOM.designed(LOOM.params.read(settings))
    return made, scene(made, loom_report(made))


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("weft", ["rapier", "shuttle"])
def test_every_part_of_heads_and_weft_in_space_is_a_line_with_its_checks(weft: str) -> None:
    made, found = _loom(weft)
    lines = {line.part: line for line in parts_of_loom(made).parts if line.part}
    screws = {part.id for part, _ in bolted(loom_tree(made)).occurrences() if part.purchase and part.joins}
    assert screws.isdisjoint(lines)
    shown = {}
    for part in found.parts:
        if part.machine in ("weaver", "weft"):
            name = part.name.split(" of ")[0]
            if name in screws:
                continue
            shown[name] = part
            assert part.number * (made.heads if part.machine == "weaver" else 1) >= lines[name].number
            assert all(name in check.parts for check in part.checks)
    assert set(shown) == {name for name in lines if name.startswith(("weaver/", "weft/"))}
    assert shown["weaver/sley-cam"].checks or shown["weaver/side-gripper-motion-cam"].checks
    assert any(check.name.startswith("clearance: ") for part in shown.values() for check in part.checks)
    named = {part for check in loom_report(made).all_checks for part in check.parts}
    assert {name for name in named if name.startswith(("weaver/", "weft/"))} <= set(shown)
    assert len(next(frame for frame in found.frames if frame.name == found.heads).origins) == made.heads

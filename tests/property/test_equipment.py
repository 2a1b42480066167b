"""Equipment of a loom: signals and their parts, safety distances, the fence against what moves, tension of a yarn.

Evidence: closed forms of the capstan equation, tables of ISO 13857 read again, meshes of the bodies at random angles.
"""

import csv
import io
import math
from collections import defaultdict
from functools import cache
from itertools import combinations, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from small_programme import small_programme

from ilmek.elements.carpet_yarns import YarnProperties
from ilmek.elements.energy_chains import ENERGY_CHAINS, SHELF, ChainLines, chain_for, width_needed
from ilmek.elements.field_devices import ROWS
from ilmek.elements.materials import GRAVITY, MATERIALS
from ilmek.elements.safety_distances import FENCES, approach, over, through
from ilmek.io.plc.io_list import io_csv
from ilmek.io.plc.project import plc_project
from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.creel import BRAKE_ID, CORE, DENSITY, creel_of, package_size
from ilmek.machines.automated_loom.equipment.energy_chain import chain_checks, energy_chain, trough_box
from ilmek.machines.automated_loom.equipment.guard_parts import mesh_panel
from ilmek.machines.automated_loom.equipment.guards import MESH, WIRE, fence_of
from ilmek.machines.automated_loom.equipment.site import site_of
from ilmek.machines.automated_loom.equipment.station import station_of
from ilmek.machines.automated_loom.equipment.stopping import stopping_time
from ilmek.machines.automated_loom.equipment.surroundings import surroundings
from ilmek.machines.automated_loom.equipment.tree import equipment_trees, whole_list
from ilmek.machines.automated_loom.equipment.yarn_path import PathStep, tensions, yarn_path
from ilmek.machines.automated_loom.in_space.maker import KNOT, ROW
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.on_rail import CHAIN, share_of
from ilmek.machines.automated_loom.papers.wiring import channels, levels_of
from ilmek.part.extents import Extent, around, extents
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.poses import chains, poses
from ilmek.part.shapes import box
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.report.scene import SceneMotion
from ilmek.units import mm, turn


@cache
def _loom(**wishes: object) -> LoomDesign:
    return design(AutomatedLoomParams(aim="price", **wishes))  # type: ignore[arg-type]


def _kind(settings: dict[str, object]) -> LoomDesign:
    (item,) = settings.items()
    return _loom(**{item[0]: item[1]}) if not isinstance(item[1], dict) else _tiers()


@cache
def _tiers() -> LoomDesign:
    return design(AutomatedLoomParams.read({"aim": "price", "weaver.tube_tiers": "2"}))


def _rows(heads: int) -> list[dict[str, str]]:
    program = plc_project(small_programme(heads=heads)).units[-1]
    return [row for row in csv.DictReader(io.StringIO(io_csv(program))) if row["address"]]


_KINDS = (
    *({"beat": beat} for beat in ("travelling", "comb", "linkage")),
    {"knotting": "arms"},
    {"weft": "rapier"},
    {"tiers": {}},
)


def test_signals_and_devices_of_looms_of_all_kinds_name_each_other() -> None:
    """Each sensor and motor of the list is named by a signal, and each part of a signal is in a loom of some kind."""
    wired = {
        signals.RESET,
        signals.ACTUATOR,
        signals.ENABLING,
        signals.MODE,
        signals.TERMINAL,
        signals.MAINS_TERMINAL,
    }  # in the safety circuit, or between
    named = {part for row in _rows(heads=1) for part in row["parts"].split()}
    kinds, every = {"clutch and brake", *(row.kind for row in ROWS)}, set[str]()
    for kind in _KINDS:
        placed = {part.id: part for part, _ in loom_tree(_kind(kind)).occurrences()}
        devices = {name for name, part in placed.items() if part.process in kinds}
        drives = {name for name, part in placed.items() if part.purchase and part.purchase.drives}
        creel = {BRAKE_ID}  # brakes are set by hand
        assert (devices | drives) - creel - wired == named & set(placed)
        every |= set(placed)
    assert named <= every


def test_terminals_and_controller_are_enough_for_the_signals() -> None:
    assert len(_rows(heads=1)) == len(signals.signals_of(1))
    for kind in (*_KINDS, {"heads": 3}):
        loom = _kind(kind)
        numbers = {part.id: number for part, number in loom_tree(loom).occurrences()}
        levels = levels_of(loom)
        assert len({level.address for level in levels}) == len(levels)
        assert numbers[signals.TERMINAL] == len({(level.strip, level.number) for level in levels})
        read = {own.signal: own for own in channels(loom)}
        assert all(read)  # every input has its variable
        for name, parts in signals.signals_of(loom.heads, loom.weavers):  # a wire to an input, or none at all
            assert (name in read) == (parts[0] != signals.CONTROLLER), name
        field = {level.part for level in levels if level.strip == "X1"}
        inside = {
            signals.STRAIN_AMPLIFIER,
            *signals.IN_CABINET,
            signals.YARN_STOP,
        }  # a yarn's sensor is at its head's module
        assert field >= {own.part for own in read.values()} - inside


def test_a_signal_of_each_head_has_a_part_on_each() -> None:
    rows = _rows(heads=3)
    assert len(rows) == len(signals.signals_of(3))
    placed = {part.id: number for part, number in loom_tree(_loom(heads=3)).occurrences()}
    assert placed[signals.HEAD_ANGLE] == sum(signals.HEAD_ANGLE in row["parts"].split() for row in rows) == 3


def test_the_list_has_every_part_of_the_loom_and_nothing_else() -> None:
    loom = _loom(heads=3)
    placed = {part.id: number for part, number in loom_tree(loom).occurrences()}
    listed = {line.part: line.number for line in whole_list(loom).parts}
    assert {name: number for name, number in placed.items() if name in listed} == listed
    assert set(placed) == set(listed)


@settings(max_examples=40)
@given(
    st.floats(0.01, 2.0),
    st.floats(0.0, 0.6),
    st.lists(st.tuples(st.floats(0.0, 3.0), st.floats(0.1, 4.0)), min_size=1, max_size=6),
)
def test_wraps_multiply_and_weight_adds(tension: float, friction: float, steps: list[tuple[float, float]]) -> None:
    def of(density: float, wraps: bool) -> float:
        yarn = YarnProperties("wool", density, 1e-3, 1e3, 90.0, friction)
        path = tuple(PathStep("", long, long, wrap if wraps else 0.0) for long, wrap in steps)
        return tensions(path, yarn, tension)[-1]

    whole = math.fsum(wrap for _, wrap in steps)
    assert of(0.0, wraps=True) == pytest.approx(tension * math.exp(friction * whole), rel=1e-12)
    risen = math.fsum(long for long, _ in steps)
    assert of(1e-3, wraps=False) == pytest.approx(tension + 1e-3 * GRAVITY * risen, rel=1e-9)


def test_the_brake_leaves_the_pull_that_the_head_counts_with() -> None:
    path, forces = yarn_path(_loom()), _loom().weaver.params.forces
    assert path.tension == pytest.approx(forces.yarn_pull, rel=1e-9)
    more = yarn_path(_loom(width=1.6))
    assert more.length > path.length
    assert more.brake < path.brake


@given(st.floats(0.0, 2.7), st.floats(1.0, 2.7))
def test_a_higher_fence_never_asks_for_more_room(hazard: float, fence: float) -> None:
    assert over(hazard, fence) >= over(hazard, min(fence + 0.2, 2.7))
    near = (over(hazard, known) for known in FENCES if known <= fence + 1e-9)
    assert over(hazard, fence) == min(near)


def test_distances_are_those_of_the_standards() -> None:
    assert [over(1.4, fence) for fence in FENCES[:6]] == pytest.approx([1.5, 1.4, 1.1, 0.9, 0.8, 0.0])
    assert [through(one * mm) for one in (4, 6, 8, 10, 12, 20, 30, 40, 120)] == pytest.approx(
        [0.002, 0.005, 0.015, 0.025, 0.08, 0.12, 0.12, 0.2, 0.85]
    )
    assert approach(0.43) == pytest.approx(0.688)


@settings(max_examples=4, deadline=None)
@given(st.sampled_from([ROW, KNOT]), st.floats(0.0, turn))
def test_what_moves_stays_as_far_from_the_fence_as_an_arm_reaches(drive: str, angle: float) -> None:
    loom = _loom()
    fence, tree, reach = fence_of(site_of(loom)), loom_tree(loom), through(MESH - WIRE)
    own = {body.id for tree in equipment_trees(loom) for body in tree.bodies}
    known: dict[str, list[Extent]] = defaultdict(list)  # a body can stand several times
    for extent in extents(tree, (ROW, KNOT)):
        if extent.moving:
            known[extent.body].append(extent)
    for chain in chains(tree):
        body = chain[-1].body
        if body.id not in known or body.id in own:
            continue
        here, (low, high) = poses(chain, drive, np.array([angle])), around(known[body.id])
        for occurrence in body.occurrences:
            assert occurrence.part.shape is not None
            mesh = occurrence.part.shape.mesh(1 * mm).points
            for position in (occurrence.positions[0], occurrence.positions[-1]):
                points = here.points(position.points(mesh))[0]
                assert np.all(points >= low - 2 * mm)
                assert np.all(points <= high + 2 * mm)
                sides = points[:, 0] - fence.left, fence.right - points[:, 0], points[:, 2] - fence.rear
                assert min(float(side.min()) for side in sides) >= reach - 2 * mm
                assert fence.front - float(points[:, 2].max()) >= approach(fence.stopping.whole) - 2 * mm


@settings(max_examples=20, deadline=None)
@given(st.lists(st.tuples(*(st.floats(-2.0, 2.0),) * 3), min_size=2, max_size=4), st.booleans(), st.booleans())
def test_boxes_of_copies_contain_their_own_points(origins, turned: bool, carried: bool) -> None:
    """Copies beside each other, about each other, and on a carrier that turns: each against poses of its own chain."""
    angle, fine = np.linspace(0.0, turn, 13), np.linspace(0.0, turn, 361)
    swing, still = 0.4 * np.sin(angle), np.zeros(13)
    slide = SceneMotion(ROW, angle, np.stack([0.3 * np.sin(angle), still, still], 1), swing if carried else still)
    positions = tuple(placement(*at, about=(0.0, 0.0, 1.0), angle=0.5 * k * turned) for k, at in enumerate(origins))
    bar = Part("bar", "bar", "welded frame", box(0.1, 0.2, 0.5), MATERIALS["structural steel"])
    own = (Occurrence(bar, (placement(0.1, 0.0, 0.2),)),)
    tilted = (placement(about=(1.0, 0.0, 0.0), angle=0.3),)
    tree = Tree(
        (
            RigidBody("carrier", own, joint=Joint(JointKind.SLIDE, motion=slide), positions=tilted),
            RigidBody("copy", own, "carrier", positions=positions),
            RigidBody(
                "arm", own, "copy", Joint(JointKind.PIN, motion=SceneMotion(KNOT, angle, 0 * slide.shift, swing))
            ),
        )
    )
    boxes, corners = iter(extents(tree, (ROW, KNOT))), np.array(list(product((-0.05, 0.05), (-0.1, 0.1), (0.0, 0.5))))
    for chain in chains(tree):
        every = [poses(chain, drive, fine).points(own[0].positions[0].points(corners)) for drive in (ROW, KNOT)]
        found, points = next(boxes), np.concatenate(every).reshape(-1, 3)
        chord = 2 * float(np.linalg.norm(points, axis=-1).max()) / 800  # of two bodies that turn
        assert found.low == pytest.approx(points.min(0), abs=chord)
        assert found.high == pytest.approx(points.max(0), abs=chord)
    assert next(boxes, None) is None


@pytest.mark.parametrize("beat", ["comb", "travelling"])
def test_nothing_comes_nearer_to_a_hand_on_its_button_than_it_comes_while_that_moves(beat: str) -> None:
    """Meshes over a row; and while weavers tie, nothing that moves in a row stands before the cloth at their hands."""
    loom = _loom(knotting="hand", beat=beat)
    station, stops, tree = station_of(site_of(loom)), stopping_time(loom), loom_tree(loom)
    half, hands = loom.task.cloth.width / 2, 0.12
    own = {body.id for tree in equipment_trees(loom) for body in tree.bodies}
    for chain in chains(tree):
        body = chain[-1].body
        if body.id in own or all(one.body.joint.motion is None for one in chain):
            continue
        here = poses(chain, ROW, np.linspace(0.0, turn, 37))
        for occurrence in body.occurrences:
            assert occurrence.part.shape is not None
            mesh = occurrence.part.shape.mesh(1 * mm).points
            points = np.concatenate([here.points(placed.points(mesh)) for placed in occurrence.positions], axis=1)
            gap = station.buttons - float(points[:, :, 2].max())
            assert gap >= 1.6 * stops.of(body.id) - 2 * mm, body.id
            at_rest = points[0]
            before = (np.abs(at_rest[:, 0]) < half) & (at_rest[:, 2] > 5 * mm) & (np.abs(at_rest[:, 1]) < hands)
            assert not before.any(), occurrence.part.id
    assert min(1.6 * stops.of(one.body) for one in surroundings(loom).hazards) > 0.05


@given(st.floats(0.1, 1.2), st.floats(0.2, 2.6))
def test_a_panel_has_no_wider_openings_and_weighs_what_its_wires_do(wide: float, tall: float) -> None:
    shape, clamps = mesh_panel("panel", "panel", wide + 10 * mm, tall), 4 * 5 * 30 * 6e-9 * 7850
    upright, level = (math.ceil((size - WIRE) / MESH - 1e-9) for size in (wide, tall))
    assert max((wide - WIRE) / upright, (tall - WIRE) / level) - WIRE <= MESH - WIRE + 1e-9
    wire = (upright + 1) * tall + (level + 1) * wide
    assert shape.mass - clamps == pytest.approx(wire * WIRE**2 * 7850, rel=2e-3)


@given(st.floats(0.05, 20.0))
def test_a_package_holds_its_yarn(mass: float) -> None:
    size = package_size(mass)
    assert math.pi / 4 * (size**2 - CORE**2) * size * DENSITY == pytest.approx(mass, rel=1e-9)


def test_each_tube_of_each_head_has_a_package_with_room_for_a_hand() -> None:
    loom = _loom(heads=3)
    places = creel_of(loom).axes
    assert len(places) == 3 * loom.weaver.params.tubes
    apart = min(math.dist(first, other) for first, other in combinations(places, 2))
    assert apart >= creel_of(loom).size + 50 * mm


@pytest.mark.parametrize("weft", ["shuttle", "rapier"])
def test_the_creel_stands_where_no_rapier_runs_out(weft: str) -> None:
    """So the duct is no longer than the fence is away from the feet there."""
    loom = _loom(weft=weft, width=1.5, length=1.5)
    creel, fence, near = creel_of(loom), fence_of(site_of(loom)), surroundings(loom)
    feet = near.of("automated-loom/front-foot")
    ways = {-1: float(feet[0].low[0]) - fence.left, 1: fence.right - float(feet[-1].high[0])}
    assert ways[creel.hand] == min(ways.values())
    assert abs(creel.duct_end - creel.mouth[0]) < ways[creel.hand] + 0.3
    assert creel.hand * creel.inner > creel.hand * (fence.left, fence.right)[creel.hand > 0]
    assert creel.hand * creel.base > creel.hand * creel.inner + creel.size


@given(st.sampled_from(ENERGY_CHAINS), st.integers(1, 40), st.floats(3e-3, 14e-3))
def test_lines_of_a_chain_have_their_room_on_shelves(row, number: int, diameter: float) -> None:
    """They are laid one by one, from the bottom shelf up, then beside these."""
    pitch, x, y = 1.2 * diameter, 0.0, 0.0
    if pitch > row.inner[1]:
        return
    for _ in range(number):
        if y + pitch > row.inner[1] * (1 + 1e-9):
            x, y = x + pitch, 0.0
        y += pitch + SHELF
    laid = ChainLines("tubes", number, diameter, 0.2, 8.0, 0.02)
    assert width_needed(row, [laid]) == pytest.approx(x + pitch)


@given(st.sampled_from(ENERGY_CHAINS), st.floats(0.2, 3.0), st.floats(-0.5, 0.5))
def test_a_chain_is_as_long_as_its_runs_and_its_loop(row, travel: float, place: float) -> None:
    """The moving end is `place` of the travel from its middle, where the chain is fixed: both runs and half a turn."""
    free = row.length(travel) - 2 * row.pitch - math.pi * row.radius
    lower = (free + place * travel) / 2
    upper = lower - place * travel
    assert lower >= -1e-12
    assert upper >= -1e-12
    assert lower + upper == pytest.approx(travel / 2)
    assert lower <= travel / 2 * (1 + 1e-9)  # so the loop passes its share by its own reach only


def test_the_chain_is_the_least_that_takes_the_lines_of_its_head() -> None:
    many = tuple(chain_for([ChainLines("tubes", number, 5 * mm, 0.2, 8.0, 0.02)]) for number in (4, 16, 48))
    assert sorted(many, key=lambda row: row.inner[0] * row.inner[1]) == list(many)
    for made in (_loom(), _loom(heads=3)):
        row = energy_chain(made)
        assert all(check.ok for check in chain_checks(made))
        parts = {line.part: line for line in whole_list(made).parts}
        assert parts[CHAIN].number == made.heads
        assert parts[CHAIN].length == pytest.approx(share_of(made) / 2 + math.pi * row.radius + 2 * row.pitch)
        low, high = trough_box(made)
        assert high[1] - low[1] > 2 * row.radius + row.outer[1]
    thick = [ChainLines("hoses", 2, 30 * mm, 0.2, 8.0, 0.5)]
    assert 8 * 30 * mm > chain_for(thick).radius

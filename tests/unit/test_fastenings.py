"""What holds parts: neighbours that let them move in no direction, a stated weld; and what a loom holds by nothing."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from default_machines import SETTLED, default_design

from ilmek.cams.loaded_plate_cam import STEEL
from ilmek.io.mechanism_file import read_mechanism
from ilmek.jobs.mechanism.making import made_mechanism
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.machines.automated_loom import MACHINE
from ilmek.machines.automated_loom.equipment.guards import GUARDS
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.tree_manual import UP, assembly_check, fastening_check, weld_check
from ilmek.machines.weaver.drive_parts import COLOUR_MOTOR
from ilmek.part.bolting import bolted
from ilmek.part.catalogue import REAR_THREADS
from ilmek.part.contacts import joined_by
from ilmek.part.fastenings import Means, fastenings
from ilmek.part.insertion import insertions
from ilmek.part.meetings import meetings
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, Shape, bar, box, rectangle, square_tube, tube
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.part.welds import welds_of
from ilmek.plane.contours import circle
from ilmek.units import mm

ROOT = Path(__file__).parents[2]
PIN, WIDE = 6 * mm, 10 * mm
GEARED = {"reducer", "motor adapter"}


def made(name: str, shape: Shape, z: float = 0.0, *, turning: bool = False) -> Occurrence:
    return Occurrence(Part(f"test/{name}", name, "pin or bush", shape, STEEL), (placement(z=z),), turning)


def fork(bore: float, second: float) -> Tree:
    """A roller of a bore on a pin that is pressed into a cheek; the other one is `second` beyond the roller."""
    cheek = Prism(Profile(rectangle(30 * mm, 30 * mm), (circle(0j, PIN / 2),)), 5 * mm)
    bolt, roller = bar(PIN, WIDE + 10 * mm + second), tube(20 * mm, (20 * mm - bore) / 2, WIDE)
    return Tree(
        (
            RigidBody(
                "test/fork",
                (
                    made("cheek", cheek, -5 * mm),
                    made("other", cheek, WIDE + second),
                    made("pin", bolt, -5 * mm),
                    made("roller", roller, turning=True),
                ),
            ),
        )
    )


@pytest.mark.parametrize(("bore", "second", "held"), [(6, 0, True), (6.2, 0.2, True), (6, 3, False), (12, 0, False)])
def test_a_roller_is_held_between_the_cheeks_of_its_fork(bore: float, second: float, held: bool) -> None:
    """With play, and not where it can slide along its pin, or off it."""
    assert ("test/roller" not in fastenings(fork(bore * mm, second * mm)).loose) == held


def test_a_part_that_lies_on_another_is_not_held_by_it() -> None:
    tree = Tree(
        (RigidBody("test/body", (made("lower", box(0.05, 0.05, 0.01)), made("upper", box(0.01, 0.01, 0.01), 0.01))),)
    )
    assert fastenings(tree).loose == ("test/upper",)
    check = fastening_check(tree)
    assert not check.ok
    assert check.value == 1
    assert "upper" in check.source


def test_a_part_is_welded_to_what_it_states() -> None:
    lower, upper = made("lower", box(0.05, 0.05, 0.01)), made("upper", box(0.01, 0.01, 0.01), 0.01)
    welded = replace(upper, part=replace(upper.part, joins=(lower.part.id,), throat=3 * mm))
    tree = Tree((RigidBody("test/body", (lower, welded)),))
    assert fastenings(tree).contacts == {Means.WELD: 1}
    assert sum(len(own) for own in welds_of(tree).values()) == 1


@pytest.mark.matrix(light=1)
@pytest.mark.parametrize("settings", [{}, {"heads": "2"}, {"width": "4m"}])
def test_a_loom_with_heads_on_cams_is_fastened_by_welds_that_can_be_made(settings: dict[str, str]) -> None:
    """Each part is held; each weld keeps both bounds of its throat, or is preheated, as hard steels are."""
    tree = bolted(loom_tree(MACHINE.designed(MACHINE.params.read(SETTLED | settings))))
    assert fastening_check(tree).ok
    assert weld_check(tree).ok
    parts = {part.id: part for part, _ in tree.occurrences()}
    arcs = [(name, weld) for name, own in welds_of(tree).items() for weld in own if weld.throat >= 1 * mm]
    assert len(arcs) > 50
    for name, weld in arcs:
        materials = [parts[own].material for own in (name, weld.other) if own]
        thin, thick = (1e3 * wall for wall in weld.walls)
        if any("C45" in material.designation for material in materials if material):
            assert weld.preheat > 200
        elif not weld.bevel:
            throat = 1e3 * weld.throat
            assert throat <= 0.7 * thin + 1e-3 or (throat == 3 and thin >= 4 - 1e-3)
            assert throat >= thick**0.5 - 0.5 - 1e-3 or weld.preheat > 0 or thin + 2 * thick <= 25
    assert all(parts[name].joins or sum(w.lengths) > 0 for name, own in welds_of(tree).items() for w in own)


def test_feet_have_threads_and_what_stands_beside_the_loom_is_anchored() -> None:
    """By the axes of holes and screws: each foot and each anchor is in a hole, each post of the guards on a plate."""
    tree = loom_tree(MACHINE.designed(MACHINE.params.read(SETTLED)))
    number = {part.id.partition("/")[2]: count for part, count in tree.occurrences()}
    assert number["foot-plate"] == number["levelling-foot"]
    assert number["guard-plate"] == number["guard-post"]
    assert number["guard-plate-anchor"] == 2 * number["guard-plate"]
    assert number["weft-sole-anchor"] == 4
    bores = {frozenset((own.bore.part.id, own.inner.part.id)) for own in meetings(tree)}
    for inner, bore in (
        ("levelling-foot", "foot-plate"),
        ("eye-bolt", "column-eye-plate"),
    ):
        assert frozenset((f"automated-loom/{inner}", f"automated-loom/{bore}")) in bores


def test_a_plate_of_the_guards_runs_under_no_other_post_or_plate() -> None:
    """By the corners of their meshes; feet of three columns a side stand near the cabinet, beside which posts stand."""
    tree = loom_tree(MACHINE.designed(MACHINE.params.read({**SETTLED, "width": "2m", "heads": "10"})))
    (guards,) = (body for body in tree.bodies if body.id == GUARDS[0])
    named = {own.part.id.partition("/")[2]: own for own in guards.occurrences}
    corners = {
        name: [position.points(own.part.shape.mesh(1e-4).points) for position in own.positions]
        for name, own in named.items()
        if name in {"guard-plate", "guard-post"} and own.part.shape is not None
    }
    flat = {name: [(np.min(own, 0)[::2], np.max(own, 0)[::2]) for own in pieces] for name, pieces in corners.items()}
    plates, posts = flat["guard-plate"], flat["guard-post"]
    assert len(plates) == len(posts) > 10
    for number, (low, high) in enumerate(plates):
        under = [k for k, (begin, end) in enumerate(posts) if ((begin < high - 1e-6) & (low < end - 1e-6)).all()]
        assert len(under) == 1  # its own
        for begin, end in plates[:number]:
            assert not ((begin < high - 1e-6) & (low < end - 1e-6)).all()


def test_a_part_that_touches_along_an_edge_is_not_welded_there() -> None:
    post, arm = (Part(f"test/{name}", name, "welded frame", square_tube(0.05, 0.005, 0.4), STEEL) for name in "ab")
    lies = placement(0.05, 0.05)
    beside = Occurrence(arm, (lies,))
    assert fastenings(Tree((RigidBody("test/body", (Occurrence(post), beside)),))).loose


CHOICES: dict[str, dict[str, str]] = {
    "knotting-four-bar": {"sides": "2"},
    "warp-tension": {"winding": "hand"},
    "weft": {"carrier": "rapier"},
    "hammer": {"drive": "linkage"},
    "knotting-dyad": {"needle_breadth": "3mm"},
}
"""Another choice of a machine alone, beside its defaults."""
ALONE = [(name, {}) for name, machine in MACHINES.items() if machine.tree and name != "automated-loom"]


DIRECT = "knotting-dyad", {"elbow_drive": "direct"}


@pytest.mark.one_in(3)
@pytest.mark.parametrize(("name", "settings"), [*ALONE, *CHOICES.items(), DIRECT])
def test_a_machine_alone_has_a_fastening_and_a_way_in_for_each_part(name: str, settings: dict[str, str]) -> None:
    machine = MACHINES[name]
    assert machine.tree is not None
    design = machine.designed(machine.params.read(settings)) if settings else default_design(name)
    tree = machine.tree(design)
    screwed = bolted(tree)
    for check in (fastening_check(screwed), assembly_check(insertions(tree, UP))):
        assert check.ok, (check.name, check.source)
    assert not drives_without_screws(screwed)


def drives_without_screws(screwed: Tree) -> set[str]:
    """Motors, reducers and adapters with neither screws in the holes of their catalogue nor a fixing of their own."""
    parts = {part.id: part for part, _ in screwed.occurrences()}
    screws = frozenset(name for name, part in parts.items() if part.process == "fastener")
    joined = set[str]().union(*joined_by(screwed, screws).values())
    drives = {
        name for name, part in parts.items() if part.purchase and (part.purchase.drives or part.process in GEARED)
    }
    return {name for name in drives - joined if not parts[name].fixing}


def test_a_motor_on_its_rear_cover_is_ordered_with_threads_there_and_without_them_nothing_holds_it() -> None:
    tree = MACHINES["weaver"].tree(default_design("weaver"))
    assert not drives_without_screws(bolted(tree))

    def plain(occurrence: Occurrence) -> Occurrence:
        part = occurrence.part
        if part.id != COLOUR_MOTOR:
            return occurrence
        assert part.purchase is not None
        assert REAR_THREADS in part.purchase.data
        holes = tuple(replace(own, faces=(1,)) for own in part.purchase.holes)
        return replace(occurrence, part=replace(part, purchase=replace(part.purchase, holes=holes)))

    bodies = (replace(body, occurrences=tuple(map(plain, body.occurrences))) for body in tree.bodies)
    assert drives_without_screws(bolted(Tree(tuple(bodies)))) == {COLOUR_MOTOR}


OWN = sorted((ROOT / "examples").glob("*.toml")) + sorted((ROOT / "tests/reference/own_mechanisms").glob("*.toml"))


@pytest.mark.one_in(3)
@pytest.mark.parametrize("file", [own for own in OWN if "[joints]" in own.read_text()], ids=lambda own: own.stem)
def test_an_own_mechanism_has_a_fastening_and_a_way_in_for_each_part(file: Path) -> None:
    """Pins over carriages, thin plates, spacers between bushes, shapes that a bore would cut, keys at any angle."""
    tree = made_mechanism(run(read_mechanism(file), MotionRequest({}))).tree
    for check in (fastening_check(bolted(tree)), assembly_check(insertions(tree, UP))):
        assert check.ok, (check.name, check.source)

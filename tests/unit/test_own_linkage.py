"""The parts of own mechanisms: layers in depth, pins and eyes by their forces, masses, folders, bad input."""

import csv
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from own_linkages import meeting_parts, toml_text

from ilmek.cli import main
from ilmek.errors import MechanismError, ParameterError
from ilmek.io.mechanism_file import parse_mechanism, read_mechanism
from ilmek.jobs.mechanism.making import MadeMechanism, made_mechanism
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.linkage.model import GROUND
from ilmek.machines.own_linkage.forms import Eye, link_layer
from ilmek.machines.own_linkage.layers import RingSide
from ilmek.machines.own_linkage.report import made_inertias
from ilmek.machines.own_linkage.tree import own_tree
from ilmek.part.mobility import TreeMobility
from ilmek.part.shapes import Prism
from ilmek.plane.contours import area, rounded_hull

FOUR_BAR = """\
name = "indexer"
gravity = "9.81m/s^2"
links = { width = "24mm", thickness = "8mm", material = "structural steel" }
motions = { O = "60rpm" }
[bodies]
ground.points = { O = [0, 0], C = ["120mm", 0] }
crank.length = "40mm"
rod.points = { A = [0, 0], B = ["100mm", 0], P = ["50mm", "60mm"] }
rocker = { length = "90mm", mass = "1kg" }
[joints]
O.pin = ["ground", "crank"]
A.pin = ["crank", "rod"]
B.pin = ["rod", "rocker"]
C.pin = ["ground", "rocker"]
[inputs]
O = "crank"
[branches]
B = 1
[pins]
B = { diameter = "12mm", length = "20mm" }
[loads]
work = { torque = "20N*m", on = "rocker" }
"""


def made(text: str = FOUR_BAR) -> MadeMechanism:
    """A mechanism as made."""
    return made_mechanism(run(parse_mechanism(text), MotionRequest({})))


def test_a_pin_that_is_given_is_made_and_the_others_bear_their_forces() -> None:
    built = made().built
    assert built.studs["B"].journal == pytest.approx(0.012)
    for axis in built.axes:
        for stress in built.stresses(axis):
            allowed = built.studs[axis.name].member
            assert stress.bending <= allowed.bending
            assert stress.pressure <= allowed.pressure
    weaker, stronger = (made(FOUR_BAR.replace("20N*m", f"{torque}N*m")).built.studs["C"].journal for torque in (1, 200))
    assert weaker < stronger


def test_the_bending_of_a_pin_is_that_of_a_cantilever() -> None:
    built = made().built
    axis = next(one for one in built.axes if one.name == "C")
    stud, force = built.studs["C"], built.loads.pins["C"]["rocker"]
    arm = built.bottoms["rocker"] + stud.lengths["rocker"] / 2  # from the upper face of the plate that stands
    assert built.stresses(axis)[1].bending == pytest.approx(32 * force * arm / (np.pi * stud.shank**3))


def test_masses_that_the_file_leaves_open_are_those_of_the_parts() -> None:
    mechanism = made()
    parts, used = made_inertias(mechanism.built), mechanism.analysis.run.machine.inertias
    assert used["rocker"].mass == 1.0
    for body in ("crank", "rod"):
        assert used[body].mass == pytest.approx(parts[body].mass, rel=1e-12)
        assert used[body].centre == pytest.approx(parts[body].centre, abs=1e-12)
        assert used[body].moment == pytest.approx(parts[body].moment, rel=1e-12)


def test_parts_that_are_near_one_another_in_no_pose_are_in_the_layers() -> None:
    """Judged by solids of another make, every 15 degrees, with what the layers know left aside."""
    assert meeting_parts(made().tree, 24) == set()


def test_the_judge_finds_what_meets() -> None:
    """The links in one layer run through one another: the judge of the test above can fail."""
    built = made().built
    flat = replace(built.layering, layers={**built.layering.layers, "rod": built.layering.layers["crank"]})
    assert meeting_parts(own_tree(replace(built, layering=flat)), 4)


def test_no_layers_fail_a_check_that_names_the_links() -> None:
    """Both cranks of a drag link pass the other's pivot: each must lie above the other."""
    text = toml_text(
        {"O": (0, 0), "C": (30, 0)},
        {"a": 70, "b": 60, "c": 80},
        [("O", "ground", "a"), ("A", "a", "b"), ("B", "b", "c"), ("C", "ground", "c")],
    )
    mechanism = made(text + "[branches]\nB = 1\n")
    (check,) = (one for one in mechanism.report.checks if "without a layer" in one.name)
    assert not mechanism.built.layering.found
    assert (check.ok, check.value) == (False, 3)
    assert check.parts == ("mechanism/a", "mechanism/b", "mechanism/c")


def test_a_link_too_short_for_its_pins_is_refused() -> None:
    pins = 'B = { diameter = "100mm", length = "20mm" }\nC = { diameter = "100mm", length = "20mm" }'
    with pytest.raises(MechanismError, match=r"rocker is too short for its pins: B and C are 90 mm apart"):
        made(FOUR_BAR.replace('B = { diameter = "12mm", length = "20mm" }', pins))


def test_a_pin_without_a_ring_offers_the_nearest() -> None:
    with pytest.raises(ParameterError, match=r"no retaining ring for a shaft of 12.3 mm.*the nearest of DIN 471 is 12"):
        made(FOUR_BAR.replace('diameter = "12mm"', 'diameter = "12.3mm"'))


def test_a_crank_with_a_short_throw_is_of_one_piece_with_its_shaft() -> None:
    built = made(FOUR_BAR.replace('"40mm"', '"10mm"').replace("20N*m", "2N*m")).built
    axis = next(one for one in built.axes if one.driven)
    assert built.side(axis) is RingSide.NONE
    assert made().built.side(axis) is RingSide.ABOVE


def test_a_link_with_eyes_wider_than_its_bar_has_the_area_of_both() -> None:
    eyed = link_layer([Eye(0j, 0.012), Eye(0.1 + 0.02j, 0.009)], 0.01, 0.005)
    length, half = abs(0.1 + 0.02j), 0.005
    eyes = [(r, np.arcsin(half / r), np.sqrt(r**2 - half**2)) for r in (0.012, 0.009)]
    bars = length - sum(cut for _, _, cut in eyes)
    wanted = 2 * half * bars + sum(r**2 * (np.pi - lean) + half * cut for r, lean, cut in eyes)
    assert area(eyed.contour) == pytest.approx(wanted, rel=1e-12)
    plain = link_layer([Eye(0j, 0.01), Eye(0.1 + 0j, 0.01)], 0.02, 0.005)
    assert area(plain.contour) == pytest.approx(area(rounded_hull(np.array([0j, 0.1 + 0j]), 0.01)), rel=1e-12)


def test_the_folder_has_drawings_lists_and_the_parts_in_space(tmp_path: Path) -> None:
    file, folder = tmp_path / "mine.toml", tmp_path / "parts"
    file.write_text(FOUR_BAR, encoding="utf-8")
    arguments = ["mechanism", str(file), "--workshop", str(folder), "--issue", "B,2026-11-29", "--json", "-"]
    found = CliRunner().invoke(main, arguments)
    assert found.exit_code == 0, found.output
    names = {path.name for path in folder.iterdir()}
    wanted = {
        "index.html",
        "drawings.pdf",
        "parts.csv",
        "purchase.csv",
        "cut-list.csv",
        "fasteners.csv",
        "assembly.glb",
    }
    assert wanted <= names
    with (folder / "parts.csv").open(encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(lines))
    assert {row["id"].rpartition("/")[2] for row in rows} >= {"frame", "crank", "rod", "rocker", "shaft", "housing"}
    assert any(row["designation"].startswith("DIN 471") for row in rows)
    results = json.loads(found.stdout)["results"]
    assert results["layers"] == max(results["layer_of"].values())
    assert results["layer_of"][GROUND] == 0


def test_a_crank_of_shapes_is_made_of_them() -> None:
    """The pieces lie on top of one another: the part weighs their sum, less its bores, with shaft and keys."""
    steel = 'material = "structural steel"'
    disc = f'{{ disc = "O", radius = "60mm", thickness = "10mm", {steel} }}'
    boss = f'{{ disc = "A", radius = "15mm", thickness = "20mm", {steel} }}'
    mechanism = made(
        FOUR_BAR.replace('crank.length = "40mm"', f'crank = {{ length = "40mm", shapes = [{disc}, {boss}] }}')
    )
    plate = next(part for part, _ in mechanism.tree.occurrences() if part.id == "mechanism/crank")
    assert plate.shape is not None
    bores = sum(
        np.pi * radius**2 * length
        for radius, length in (
            (mechanism.built.studs["A"].shank / 2, 0.03),
            (mechanism.built.studs["O"].journal / 2, 0.01),
        )
    )
    solid = np.pi * (0.06**2 * 0.01 + 0.015**2 * 0.02)
    assert plate.shape.volume == pytest.approx(solid - bores, rel=2e-3)  # the keyway besides
    assert mechanism.built.thickness("crank") == pytest.approx(0.03)


def test_a_slide_has_a_rail_as_long_as_its_travel_and_a_carriage_on_it() -> None:
    text = FOUR_BAR.replace(
        'rocker = { length = "90mm", mass = "1kg" }', "ram = { points = { B = [0, 0], C = [0, 0] } }"
    )
    text = text.replace('"rocker"', '"ram"').replace('C.pin = ["ground", "ram"]', 'C = { slide = ["ram", "ground"] }')
    text = text.replace('{ torque = "20N*m", on = "ram" }', '{ friction = "100N", on = "ram.B" }')
    mechanism = made(text)
    parts = {part.id: part for part, _ in mechanism.tree.occurrences()}
    (line,) = mechanism.built.lines
    assert line.travel[1] - line.travel[0] == pytest.approx(0.08, abs=1e-6)  # twice the crank
    rail = parts["mechanism/rail"]
    assert rail.purchase is not None
    guide = mechanism.built.guides["C"]
    assert 0 <= rail.purchase.length - (0.08 + guide.block_length + 0.01) <= 0.001
    assert meeting_parts(mechanism.tree, 12) == set()


@pytest.mark.parametrize("name", ["quick_return", "slider_crank_press", "jansen_leg", "geared_five_bar", "class_three"])
def test_the_bodies_of_a_tree_are_as_free_as_they_are_driven(name: str) -> None:
    """By the rank of what its joints and closures require, which knows nothing of the mechanism's own."""
    file = read_mechanism(Path(__file__).parents[2] / "examples" / f"{name}.toml")
    mobility = TreeMobility(made_mechanism(run(file, MotionRequest({}))).tree)
    assert mobility.degrees_of_freedom == len(mobility.driven) == 1


EXAMPLES = ("class_three", "jansen_leg", "klann_leg", "quick_return", "slider_crank_press", "stephenson_dwell")


@pytest.mark.parametrize("name", EXAMPLES)
def test_outlines_of_the_examples_have_no_edge_that_a_kernel_takes_for_a_point(name: str) -> None:
    """A carriage as wide as its link had edges of 4e-11 m, of which the CAD kernel makes no solid."""
    root = Path(__file__).parents[2]
    tree = made_mechanism(run(read_mechanism(root / "examples" / f"{name}.toml"), MotionRequest({}))).tree
    contours = [
        contour
        for part, _ in tree.occurrences()
        if isinstance(part.shape, Prism)
        for contour in part.shape.section.contours
    ]
    edges = np.concatenate([np.abs(np.roll(own.points, -1) - own.points) for own in contours])
    assert edges.min() > 1e-6

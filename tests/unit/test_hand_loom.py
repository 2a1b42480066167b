"""The hand loom and its machines: forces of the hands, bending, blows, times, cost, and what moves it."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from cloths import cloth
from PIL import Image

from ilmek.cli.loom_summary import loom_pairs
from ilmek.errors import LoomError
from ilmek.jobs.design import design_machine
from ilmek.jobs.loom import read_loom_order
from ilmek.jobs.order import read_order
from ilmek.jobs.weave import weave, weave_results
from ilmek.machines.automated_loom.drives import drive_checks
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.hand_beat.design import blow_forces
from ilmek.machines.hand_loom import HandLoom, HandLoomParams
from ilmek.machines.hand_loom.frame import tree
from ilmek.machines.hand_loom.scene import scene
from ilmek.machines.hand_shed import HandShed, HandShedParams
from ilmek.machines.hand_shed.design import on_foundation, sag_of, warp_in_shed
from ilmek.machines.warp_tension import WarpTensionParams
from ilmek.part.drive_balance import drive_balance
from ilmek.part.tree import Tree
from ilmek.report import Report
from ilmek.weaving.fell import assumed_fabric

BY_HAND = {"knotting": "hand", "shed": "hand", "beat": "hand"}
PAPERS = {**BY_HAND, "beat": "travelling"}


@pytest.fixture(scope="module")
def report() -> Report:
    return design_machine("automated-loom", BY_HAND, illustrated=False).report


def loom(**settings: str) -> HandLoom:
    return MACHINES["hand-loom"].design(HandLoomParams.read(settings))


def shed(**settings: str) -> HandShed:
    return MACHINES["hand-shed"].design(HandShedParams.read(settings))


@pytest.mark.parametrize("opening", ["12mm", "20mm", "35mm"])
def test_the_force_of_a_string_is_the_slope_of_the_warps_energy(opening: str) -> None:
    """Judge: virtual work. E = T dL + EA dL² / 2 L of a warp over its chain; its slope along p is the force."""
    made = shed(opening=opening)
    params, warp = made.params, made.params.cloth.carpet_yarns.warp

    def energy(pulled: float) -> float:
        rod = complex(-made.rod.outer / 2, params.rod_high)
        chain = [0j, complex(pulled, params.heddle_height), rod, 1j * params.free_length]
        longer = sum(abs(end - begin) for begin, end in pairwise(chain)) - params.free_length
        return params.cloth.warp_tension * longer + warp.stiffness / params.free_length * longer**2 / 2

    step = 1e-6
    slope = (energy(made.pulled + step) - energy(made.pulled - step)) / (2 * step)
    assert made.string_force == pytest.approx(slope, rel=1e-6)
    assert made.heddle_force == pytest.approx(slope * (params.cloth.warps // 2), rel=1e-6)
    assert made.lever_force * made.hands_on_levers * made.lever == pytest.approx(made.heddle_force * made.arm)


def test_both_sheds_open_as_far_as_required_by_plane_geometry() -> None:
    made = shed()
    params, half = made.params, made.rod.outer / 2
    low = 2 * half * params.weft_height / params.rod_low
    front = (half + made.rod_deflection) / params.rod_high
    high = params.weft_height * ((made.pulled - made.bar_deflection) / params.heddle_height - front)
    assert made.opening_low == pytest.approx(low)
    assert made.opening_high == pytest.approx(high)
    assert params.opening <= made.opening_high < 1.05 * params.opening
    assert params.opening <= made.opening_low < 1.2 * params.opening  # a step of the tubes


def test_a_warp_that_is_not_deflected_has_its_tension_and_presses_on_nothing() -> None:
    straight = warp_in_shed(HandShedParams(cloth=cloth(tension=9.0)), [0.4j])
    assert straight.tension == pytest.approx(9.0)
    assert straight.force(1) == pytest.approx(0.0)


@pytest.mark.parametrize("rate", [10.0, 3e4, 3e6])
def test_a_rod_on_its_warps_bends_as_by_finite_differences(rate: float) -> None:
    """Judge: E I w'''' + k w = q with w = w'' = 0 at both ends on 800 pieces."""
    made, length, load, number = shed(), 2.5, 300.0, 800
    stiff, step = 210e9 * made.rod.inertia, 2.5 / 800
    second = (
        np.diag(-2.0 * np.ones(number - 1)) + np.diag(np.ones(number - 2), 1) + np.diag(np.ones(number - 2), -1)
    ) / step**2
    bent = np.linalg.solve(stiff * second @ second + rate * np.eye(number - 1), np.full(number - 1, load))
    moment = -stiff * second @ bent
    sag, stress = on_foundation(made.rod, load, rate, length)
    middle = number // 2 - 1
    assert sag == pytest.approx(bent[middle], rel=1e-4)
    assert stress == pytest.approx(abs(moment[middle]) * made.rod.outer_radius / made.rod.inertia, rel=1e-3, abs=1e3)
    if rate < 100:
        assert sag == pytest.approx(sag_of(made.rod, load * length, length), rel=1e-2)


def test_a_hand_has_no_more_force_than_the_standard_allows_and_a_wide_loom_fails() -> None:
    assert shed().lever_force <= 75.0
    short = shed(**{"hands.pull": "50N"})
    assert short.lever > shed().lever
    wide = MACHINES["hand-shed"].report_for({"cloth.warps": "2000", "weavers": "6"})
    assert {check.name for check in wide.failed} >= {"force of a hand on its lever"}


def test_blows_pack_a_row_by_their_energy() -> None:
    """Judge: each blow's energy is what packing and stretching take beyond the blow before."""
    fabric, energy = assumed_fabric(4e-3, 15.0, 1800.0, 1.3), 10.5e-3
    needed = float(fabric.resistance(4e-3))
    forces = blow_forces(fabric, energy, needed, 50)
    assert 1 < len(forces) < 50
    assert forces[-2] < needed <= forces[-1]
    spent = 0.0
    for force in forces:
        packing = fabric.packing_work(float(fabric.spacing(force)))
        assert packing - spent + fabric.stretching_work(force) == pytest.approx(energy, rel=1e-6)
        spent = packing
    assert len(blow_forces(fabric, energy, needed, 2)) == 2


def test_the_torque_of_a_hand_wheel_is_that_of_all_warps_through_the_reducer() -> None:
    machine = MACHINES["warp-tension"]
    made = machine.design(WarpTensionParams.read({"winding": "hand", "carpet_thickness": "10mm"}))
    pull = made.params.cloth.pull
    assert made.motor_torque * made.ratio * 0.45 == pytest.approx(pull * made.roll_radius)
    assert made.motor_limit == pytest.approx(75.0 * 0.25)
    assert made.motor is None
    free = drive_balance(machine.tree(made))
    assert (free.axes, len(free.by_hand), free.undriven) == (0, 2, ())
    weak = machine.report_for({"winding": "hand", "hands.pull": "5N", "ratio": "100"})
    assert "torque of a hand wheel" in {check.name for check in weak.failed}


def test_the_hand_loom_is_one_machine_that_only_hands_move(report: Report) -> None:
    assert report.machine == "hand-loom"
    assert report.failed == ()
    results = report.as_json()["results"]
    assert results["buildable"] is True
    assert results["driven_axes"] == 0
    made = loom()
    free = drive_balance(tree(made))
    assert results["degrees_of_freedom"] == len(free.by_hand) == free.number == free.driven
    assert set(results["moved_by_hand"]) == set(free.by_hand)
    assert not [part for part, _ in tree(made).occurrences() if part.purchase is not None and part.purchase.drives]


def test_in_the_picture_rod_and_strings_move_with_the_warps(report: Report) -> None:
    """Judge: the rod's own solid, moved by its frame, lies between the sheets; a string ends on the warp it pulls."""
    made = loom()
    seen = scene(made, report)
    heddles = next(own for own in tree(made).bodies if own.id == "hand-shed/heddles")
    frame = next(own for own in seen.frames if own.name == "hand-shed/shed rod")
    rod = next(part for part in seen.parts if part.ids[0] == "hand-shed/rod").solids[0].points
    rear, front = seen.warps
    assert frame.motion is not None
    for number, angle in enumerate(rear.angle):
        y = frame.origins[0, 1] + np.interp(angle, frame.motion.angle, frame.motion.shift[:, 1])
        z = [float(np.interp(y, *sheet.points[number, :4, 1:].T)) for sheet in (rear, front)]
        assert z == pytest.approx([rod[:, 2].min(), rod[:, 2].max()], abs=1e-5)
    pulled, motion = len(rear.angle) // 2, heddles.joint.motion
    assert motion is not None
    swing = np.interp(rear.angle[pulled], motion.angle, motion.rotation)
    strings = next(own for own in heddles.occurrences if own.part.id == "hand-shed/string-heddle")
    end = np.array([[0.0, 0.0, made.shed.string]])
    x, up, ahead = np.array([own.points(end)[0] for own in strings.positions]).T
    origin = heddles.positions[0].points(np.zeros((1, 3)))[0]
    assert x == pytest.approx(rear.across)
    assert origin[1] + up * np.cos(swing) - ahead * np.sin(swing) == pytest.approx(rear.points[pulled, 1, 1])
    assert origin[2] + up * np.sin(swing) + ahead * np.cos(swing) == pytest.approx(rear.points[pulled, 1, 2])
    across = np.sort(np.concatenate([rear.across, front.across]))
    assert np.diff(across) == pytest.approx(loom().params.cloth.warp_pitch)
    assert {one.machine for one in seen.parts} == {"hand-loom", "hand-shed", "hand-beat", "warp-tension"}
    assert seen.nearest


def test_a_body_that_no_hand_moves_is_found() -> None:
    made = tree(loom())
    lost = tuple(
        replace(body, joint=replace(body.joint, hand="")) if body.id == "hand-shed/shed rod" else body
        for body in made.bodies
    )
    failed = {check.name: check.source for check in drive_checks(Tree(lost, made.closures)) if not check.ok}
    assert "hand-shed/shed rod" in failed["degrees of freedom"]


def test_time_and_cost_of_a_hand_woven_carpet_by_a_calculation_of_its_own(report: Report) -> None:
    """450 rows of 300 knots, two weavers, 8,000 knots in a day of 8 h; wage 8, 4,000 h, 90 %.

    Between two carpets 608 warps are dressed, and 4.5 h go to the rest.
    """
    rows, knots = 450, 150 * 8 * 3600 / 8000
    results = report.as_json()["results"]
    acts = 2 * 3 * 4 + 2 * ((300 * 2 + 8) * 2e-3 / 0.15 + 4) + 2 * 13 * 0.5 / 2
    row = 4e-3 * (1 + results["warp_strain"]) / 0.99  # off the loom and washed 25 rows are in a decimetre
    winding = results["winding_time"] * row / 0.15
    assert results["row_time"] == pytest.approx(knots + acts + winding)
    hours = rows * results["row_time"] / 3600
    assert results["weaving_time"] == pytest.approx(hours * 3600)
    warp = 1.8 / 0.99 * 1.03 + 2 * 0.1 + 0.4  # unwashed, with crimp, fringes and what is lost in the loom
    carpets = 4000 * 0.9 / (hours + 4.5 + (1800 + 608 * (12 + warp / 1.0) + 2 * 31 * 30) / 3600)
    shares = results["cost_shares"]
    assert shares["operators"] == pytest.approx(8 * 2 * 4000 / carpets)
    assert shares["energy"] == 0.0
    assert results["cost_per_carpet"] == pytest.approx(sum(shares.values()))


def test_a_deadline_that_no_weaver_meets_names_the_persons_needed() -> None:
    late = design_machine("automated-loom", {**BY_HAND, "deadline": "20h"}, illustrated=False).report
    (check,) = (one for one in late.failed if one.name == "weaving time, estimated")
    needed = int(str(check.cure).split()[0])
    made = loom()
    assert made.rows * made.row_time * made.weavers / needed <= 20 * 3600 < made.rows * made.row_time


@pytest.mark.parametrize(
    ("mixed", "cure"),
    [
        ({"shed": "hand"}, "set knotting=hand"),
        ({"beat": "hand"}, "or shed=hand"),
        ({"knotting": "hand", "shed": "hand", "beat": "linkage"}, "set beat=hand"),
        ({**BY_HAND, "weft": "rapier"}, "set weft=auto"),
        ({"knotting": "hand", "weft": "hand"}, "or shed=hand"),
    ],
)
def test_what_no_loom_has_by_hand_beside_a_drive_is_refused_with_what_to_set(mixed: dict[str, str], cure: str) -> None:
    with pytest.raises(LoomError, match=cure):
        design_machine("automated-loom", mixed)


@pytest.fixture(scope="module")
def papers() -> Report:
    return design_machine("automated-loom", PAPERS, illustrated=False).report


def test_the_papers_machine_is_designed_by_one_command_and_only_its_beat_is_driven(papers: Report) -> None:
    assert papers.failed == ()
    results, made = papers.as_json()["results"], loom(beat="travelling")
    assert (results["buildable"], results["driven_axes"], results["assembly_groups"]) == (True, 2, 1)
    free = drive_balance(tree(made))
    assert results["degrees_of_freedom"] == len(free.by_hand) + 2 == free.driven
    assert results["beat_force"] > 60.0  # the paper's abstract, at its own speed of the crank
    assert {part.purchase.row for part, _ in tree(made).occurrences() if part.purchase and part.purchase.drives}
    assert "comb" not in " ".join(results["moved_by_hand"])


def test_a_comb_on_its_own_axes_beats_for_weavers_who_open_the_shed_over_it() -> None:
    report = design_machine("automated-loom", {**BY_HAND, "beat": "comb"}, illustrated=False).report
    assert report.failed == ()
    made, results = loom(beat="comb"), report.as_json()["results"]
    assert (results["assembly_clashes"], results["assembly_groups"], results["beaten_warps"]) == (0, 1, 608)
    assert {track.name for track in made.cyclograms[1].tracks} == {"beater"}
    low = design_machine("hand-loom", {"beat": "comb", "hands.weft_laid": "100mm"}, illustrated=False).report
    assert {check.name for check in low.failed} == {"what beats over the hands that tie"}


def test_the_beat_of_the_papers_machine_stays_below_the_shed_and_strikes_every_warp(papers: Report) -> None:
    """Judge: the run of the slide by counting warps; outlines carried along the path against rod and heddle bar."""
    made = loom(beat="travelling")
    seen = scene(made, papers)
    frames = {one.name: one for one in seen.frames}
    slide = frames["beat-up/carriage"].motion
    assert slide is not None
    run = slide.shift[:, 0]
    cloth, drive = made.params.cloth, made.drive
    assert drive is not None
    assert np.ptp(run) == pytest.approx((cloth.warps - drive.beaten) * cloth.warp_pitch + 2 * drive.beat.park)
    assert drive.beat.strokes * drive.beaten >= cloth.warps
    assert run[0] == pytest.approx(run[-1])  # the second beat brings it back
    assert seen.periods["beat"] == pytest.approx(2 * drive.beat.whole + 2.0)
    highest = max(float(drive.path.carried(one, drive.path.tip).imag.max()) for one in drive.path.outline)
    lowest = made.shed.params.heddle_height - made.shed.bar.outer_radius
    assert drive.path.rise < highest < lowest < made.shed.params.rod_low - made.shed.rod.outer / 2


def test_a_row_of_the_papers_machine_has_its_weavers_in_it(papers: Report) -> None:
    made = loom(beat="travelling")
    row, beats = made.cyclograms
    results = papers.as_json()["results"]
    assert row.period == pytest.approx(results["row_time"]) == pytest.approx(sum(made.row_acts.values()))
    assert [part.name for part in row.track("loom").segments] == ["beat", "beat again"]
    assert made.drive is not None
    assert results["row_acts"]["beats"] == pytest.approx(2 * (4 + made.drive.beat.whole))
    ends = sorted((part.start, part.end) for track in row.tracks for part in track.segments)
    assert all(end == pytest.approx(start) for (_, end), (start, _) in pairwise(ends))
    assert {track.name for track in beats.tracks} == {"beater", "slide of the beater"}
    work = made.rows * 2 * sum(one.energy for one in made.drive.work) / 0.7
    assert results["energy"] == pytest.approx(work + 2 * 10.0 * results["weaving_time"])


def test_the_papers_machine_weaves_a_carpet_with_wage_time_and_the_cyclogram_of_its_beat(tmp_path: Path) -> None:
    picture = tmp_path / "stripes.png"
    Image.fromarray(np.kron(np.array([[0, 255], [255, 0]], np.uint8), np.ones((8, 8), np.uint8))).save(picture)
    order = read_order(picture, size="40x50cm", quality="20x20/dm")
    woven = weave(order, read_loom_order(order, loom=PAPERS), tmp_path / "woven")
    assert woven.weaves
    page = (tmp_path / "woven" / "loom.html").read_text(encoding="utf-8")
    assert "Two beats" in page
    assert "One row with its weavers" in page
    assert "the loom beats while all hold their buttons" in woven.warnings[0]
    assert ("weavers", "1 (of 1 that fit), wage") in [(name, text[:23]) for name, text in loom_pairs(woven)]


def test_a_carpet_is_woven_on_a_hand_loom_with_chart_time_and_wage_and_no_programme(tmp_path: Path) -> None:
    picture = tmp_path / "stripes.png"
    Image.fromarray(np.kron(np.array([[0, 255], [255, 0]], np.uint8), np.ones((8, 8), np.uint8))).save(picture)
    order = read_order(picture, size="40x50cm", quality="12x12/dm")
    woven = weave(order, read_loom_order(order, loom=BY_HAND), tmp_path / "woven")
    assert woven.weaves
    assert not (tmp_path / "woven" / "programme.ilmek").exists()
    assert (tmp_path / "woven" / "rows.pdf").exists()
    assert "loom-in-space" in (tmp_path / "woven" / "loom.html").read_text(encoding="utf-8")
    results = weave_results(woven)
    assert (results["heads"], results["weavers"]) == (0, 1)
    assert results["weaving_time"] == pytest.approx(woven.loom["weaving_time"])
    assert "nothing of the loom is driven" in woven.warnings[0]
    assert not [text for _, text in loom_pairs(woven) if "by hand" in text]
    strings = (tmp_path / "woven" / "drawing-in.csv").read_text(encoding="utf-8").splitlines()
    assert strings[5:7] == ["5,1,1,odd,string heddle 3,5", "6,1,2,even,shed rod,6"]  # after four warps of the selvedge
    assert len(strings) == 1 + 2 * 48 + 8
    steps = {one["name"]: one["cost"] for one in results["making_steps"]}
    assert steps["yarn"] == results["price"]
    assert sum(steps.values()) == pytest.approx(results["price"] + woven.making.cost.cost_per_carpet)
    assert results["woven_longer"] == pytest.approx(0.5 * (1 + woven.loom["warp_strain"]) / 0.99 - 0.5)

"""Shedding on several shafts: how the pitch is shared, one shed for all, torque, buckling, choice, parts and plates."""

import itertools
import math

import numpy as np
import pytest
from cam_bars import beyond_cams
from cloths import cloth
from scipy.linalg import eigvalsh_tridiagonal

from ilmek.elements.nose_buckling import nose_buckling
from ilmek.errors import ParameterError
from ilmek.machines.automated_loom import MACHINE as LOOM
from ilmek.machines.automated_loom import AutomatedLoomParams
from ilmek.machines.shedding import MACHINE, SheddingDesign, SheddingParams, shed_lengthenings
from ilmek.machines.shedding.positions import dealt
from ilmek.machines.shedding.reed import dent
from ilmek.machines.shedding.stack import shared
from ilmek.machines.shedding.tree import reed, tree
from ilmek.machines.shedding.warp import shed_warp
from ilmek.part.contacts import contacts
from ilmek.part.placement import placement
from ilmek.report import Report
from ilmek.units import mm

CLOTH = dict(tension=15.0, warp_stiffness=1350.0)
LENGTHS = dict(front_span=0.5, back_span=0.6, warp_length=1.8)
SPANS = dict(cloth=cloth(**CLOTH), **LENGTHS)
PITCHES = [0.25 * mm, 0.5 * mm, 1 * mm, 2 * mm, 4 * mm]


def made(**settings_given) -> SheddingDesign:
    return MACHINE.design(SheddingParams(**settings_given))


def failed(report: Report) -> set[str]:
    return {check.name for check in report.failed}


@pytest.mark.parametrize(("thickness", "height", "cosine"), [(3e-4, 0.06, 1), (1e-3, 0.1, 0.87), (2e-3, 0.02, 0.7)])
def test_nose_buckles_at_the_least_eigenvalue_of_the_wedge(thickness, height, cosine) -> None:
    """-w'' = N / (E I(x)) w with I = 2 x t^3 / 12, w(0) = 0 at the tip, w'(a) = 0 at the foot (differences)."""
    number, modulus, long = 800, 200e9, height / cosine
    step = long / number
    x = step * np.arange(1, number + 1)
    bend = modulus * x * thickness**3 / 6
    above, below = -bend[:-1] / step**2, -bend[1:] / step**2
    below[-1] *= 2
    least = eigvalsh_tridiagonal(2 * bend / step**2, np.sqrt(above * below), select="i", select_range=(0, 0))[0]
    assert nose_buckling(thickness, height, cosine, modulus) == pytest.approx(least, rel=2e-3)


@pytest.mark.parametrize(("shafts", "guides"), list(itertools.product((1, 2, 3, 4), ("cams", "reed"))))
def test_cam_guides_and_passing_warps_fill_the_pitch_of_a_shaft(shafts, guides) -> None:
    params = SheddingParams(cloth=cloth(warp_pitch=1 * mm, warps=1200, warp_diameter=0.5 * mm))
    shares = shared(params, shafts, guides)
    passing = (shafts - 1) * 0.5 * mm + (shafts * params.warp_clearance if shafts > 1 else 0.0)
    used = shares.thickness + shares.guides * shares.guide + passing
    assert used <= shafts * mm * (1 + 1e-12)
    assert guides == "reed" or used == pytest.approx(shafts * mm)
    assert shares.thickness >= 0.5 * mm + 2 * params.warp_clearance


@pytest.mark.parametrize("guides", ["cams", "reed"])
@pytest.mark.parametrize("diameter", [0.1 * mm, 0.4 * mm, 0.7 * mm])
def test_more_shafts_have_no_thinner_plates(guides, diameter) -> None:
    params = SheddingParams(cloth=cloth(warp_pitch=1 * mm, warps=1200, warp_diameter=diameter))
    cams, all_guides = zip(
        *((one.thickness, one.guide) for one in (shared(params, k, guides) for k in (1, 2, 3, 4))), strict=True
    )
    assert all(after >= before - 1e-12 for before, after in itertools.pairwise(cams))
    assert all_guides[3] >= all_guides[0] - 1e-12
    assert guides == "cams" or cams[3] > cams[0]


@pytest.mark.parametrize("warps", [2, 7, 600, 601])
@pytest.mark.parametrize("shafts", [1, 2, 3, 4])
def test_warps_are_dealt_in_turn(warps, shafts) -> None:
    """Against a count, warp by warp; the first warp is odd."""
    counted = [[0, 0] for _ in range(shafts)]
    for warp in range(1, warps + 1):
        counted[(warp - 1) % shafts][warp % 2] += 1
    assert [list(one) for one in dealt(warps, shafts)] == counted


@pytest.mark.parametrize("shafts", [1, 2, 3, 4])
def test_torque_of_all_shafts_is_the_virtual_work_on_the_warps(shafts) -> None:
    """M = dW/dtheta with W of every warp from its own lift and spans, by differences."""
    design = made(shafts=shafts, lift=0.04, **SPANS)

    def work(angle: np.ndarray) -> np.ndarray:
        total = np.zeros_like(angle)
        for one in design.shafts:
            warp = shed_warp(one.params)
            for number, programme in zip(one.numbers, (one.even, one.odd), strict=True):
                longer = warp.lengthening(programme.at(angle).s)
                total += number * (warp.tension * longer + warp.rate * longer**2 / 2)
        return total

    angle, step = np.linspace(0.1, 6.1, 37), 1e-5
    wanted = (work(angle + step) - work(angle - step)) / (2 * step)
    np.testing.assert_allclose(design.torque(angle), wanted, atol=1e-4 * np.max(np.abs(wanted)))
    whole = np.linspace(0.0, 2 * math.pi, 20_001)
    assert abs(np.trapezoid(design.torque(whole), whole)) < 1e-3 * np.max(work(angle))


@pytest.mark.parametrize("shafts", [2, 3])
def test_all_shafts_open_one_shed_and_clear_each_other(shafts) -> None:
    design = made(shafts=shafts, **SPANS)
    angle = np.linspace(0.0, 6.2, 33)
    for one in design.shafts:
        front = 0.5 + one.beyond
        assert one.params.spans_of_warp == pytest.approx((front, 0.6 + design.shafts[-1].beyond - one.beyond))
        # Height of the lifted warps 0.3 m from the fell.
        np.testing.assert_allclose(one.even.at(angle).s * 0.3 / front, design.even.at(angle).s * 0.3 / 0.5, atol=1e-12)
    for before, after in itertools.pairwise(design.shafts):
        gap = after.beyond - before.beyond - after.stack.guide_radius - before.stack.guide_radius
        assert gap >= 10 * mm - 1e-9
    assert "deviation of the shafts' shed lines" not in failed(MACHINE.report(design))


@pytest.mark.parametrize("shafts", [1, 2, 3])
def test_mean_lengthening_of_each_parity(shafts) -> None:
    """Against the lengths of every warp of a small shed."""
    design = made(shafts=shafts, cloth=cloth(warps=11, **CLOTH), **LENGTHS)
    angle = np.linspace(0.0, 6.0, 13)
    found = shed_lengthenings(design, angle)
    totals, counts = [np.zeros_like(angle), np.zeros_like(angle)], [0, 0]
    for warp in range(1, 12):
        one = design.shafts[(warp - 1) % shafts]
        s = (one.odd if warp % 2 else one.even).at(angle).s
        front, back = one.params.spans_of_warp
        totals[warp % 2] += np.sqrt(front**2 + s**2) - front + np.sqrt(back**2 + s**2) - back
        counts[warp % 2] += 1
    assert design.parity_numbers == tuple(counts) == (5, 6)
    for mine, total, count in zip(found, totals, counts, strict=True):
        np.testing.assert_allclose(mine, total / count, rtol=1e-9, atol=1e-15)


def test_lengthening_without_spans_is_none_at_all() -> None:
    assert not np.any(shed_lengthenings(made(), np.linspace(0, 6, 7)))


@pytest.mark.parametrize(("shafts", "guides"), [(1, "cams"), (1, "reed"), (3, "cams"), (2, "reed")])
def test_parts_weigh_what_the_stacks_weigh(shafts, guides) -> None:
    design = made(shafts=shafts, guides=guides, **SPANS)
    parts = MACHINE.parts(design)
    turning = [part for part in parts if " of the reed" not in part.name and not math.isnan(part.mass)]
    weighed = sum(part.mass_all for part in turning if part.kind in ("laser-cut part", "steel bar"))
    beyond = design.params.density * math.fsum(
        beyond_cams(design, index, design.shafts[index].shaft.length) for index in range(shafts)
    )
    assert weighed == pytest.approx(design.stack.mass + beyond, rel=1e-6)
    assert sum(part.number for part in parts if part.name.startswith("shedding cam")) == 600
    assert sum(part.drives for part in parts) == shafts
    assert len({part.name for part in parts}) == len(parts)


@pytest.mark.parametrize(("shafts", "guides"), [(1, "cams"), (2, "cams"), (2, "reed")])
def test_every_shaft_has_its_plates_and_tables(shafts, guides) -> None:
    report = MACHINE.report(made(shafts=shafts, guides=guides, **SPANS))
    names = [plate.name for plate in report.plates]
    assert len(set(names)) == len(names)
    assert sum(plate.number for plate in report.plates if plate.name.startswith("shedding-cam")) == 600
    dents = [plate.number for plate in report.plates if plate.name.startswith("reed-dent")]
    assert dents == ([601] * shafts if guides == "reed" else [])
    assert len(report.cam_tables) == 2
    assert len({table.name for table in report.cam_tables}) == 2


def test_the_thesis_pitch_needs_one_shaft_with_guide_cams() -> None:
    design = made(**SPANS)
    assert (len(design.shafts), design.guides, design.stack.thickness) == (1, "cams", pytest.approx(1 * mm))
    assert design.choice.decided_by == "price"


def test_fine_pitch_takes_a_reed_and_guide_cams_take_more_shafts() -> None:
    fine = dict(cloth=cloth(warp_pitch=0.5 * mm, warps=2400, tension=1.4, warp_stiffness=120.0), **LENGTHS)
    reed, cams = made(**fine), made(guides="cams", **fine)
    assert (len(reed.shafts), reed.guides) == (1, "reed")
    assert (reed.choice.decided_by, reed.choice.next_cheaper) == ("cam stack, worst case", "1 shaft with guide cams")
    assert not failed(MACHINE.report(reed))
    assert len(cams.shafts) > 1 or "thickness of a guide cam" in failed(MACHINE.report(cams))


@pytest.mark.matrix(light=4)
@pytest.mark.parametrize("pitch", PITCHES)
@pytest.mark.parametrize("shafts", [None, 1, 2, 3, 4])
def test_every_pitch_gives_a_design_with_its_checks(pitch, shafts) -> None:
    """From 0.25 to 4 mm on one to four shafts: finite checks, each failed one with its cure; never an error."""
    report = MACHINE.report(
        made(
            cloth=cloth(warp_pitch=pitch, warps=round(0.6 / pitch), tension=7500 * pitch),
            shafts=shafts,
            front_span=0.17,
            back_span=0.17,
        )
    )
    assert all(math.isfinite(check.value) and math.isfinite(check.limit) for check in report.checks)
    assert all(check.cure for check in report.failed)
    assert not any("invariant" in check.source for check in report.failed)


def test_thinner_cams_are_nearer_to_buckling() -> None:
    ratios = []
    for thickness in (0.2 * mm, 0.4 * mm, 0.8 * mm):
        force, critical = made(cam_thickness=thickness, **SPANS).first.buckling()
        ratios.append(force / critical)
    assert ratios[0] / ratios[1] == pytest.approx(8.0)
    assert ratios[1] / ratios[2] == pytest.approx(8.0)
    assert "buckling of a cam" in failed(
        MACHINE.report(made(cam_thickness=0.1 * mm, cloth=cloth(tension=100.0, warp_stiffness=1350.0), **LENGTHS))
    )


def test_staggered_cams_are_no_guideway() -> None:
    step = "step of the shuttle's guideway on the tips"
    assert step in failed(MACHINE.report(made(phase="staggered")))
    assert step not in failed(MACHINE.report(made()))
    assert step not in failed(MACHINE.report(made(phase="staggered", guideway=False)))


def test_a_motor_bearing_and_bar_beyond_their_tables_are_the_largest_and_fail() -> None:
    report = MACHINE.report(made(cloth=cloth(warps=6000, tension=400.0), front_span=0.3, back_span=0.3))
    assert {"motor torque", "life of the bearings", "slope of the shaft"} <= failed(report)
    parts = {part.name: part.description for part in report.parts}
    assert parts["cam shaft"].startswith("square 150 mm, ")
    assert parts["motor of the cam shaft"].startswith("servo 15000 W")


def test_choices_name_the_check_that_the_next_cheaper_fails() -> None:
    given = dict(cloth=cloth(**CLOTH), half_span=0.17, warp_length=1.5)
    chosen = {choice.name: choice for choice in MACHINE.report(made(**given)).choices}
    assert set(chosen) == {"cam shafts", "prime_radius", "shaft_bar", "bearing", "motor"}
    bar = chosen["shaft_bar"]
    smaller = MACHINE.report(made(shaft_bar=float(bar.next_cheaper.split()[0]) * mm, **given))
    assert bar.decided_by in failed(smaller)
    bearing = MACHINE.report(made(bearing=chosen["bearing"].next_cheaper, **given))
    assert chosen["bearing"].decided_by in failed(bearing)


def test_a_shaft_that_starts_and_stops_bears_its_inertia() -> None:
    """J w / t at the shaft, through the reducer; no more than the warps' torque where it takes its time."""
    steady, quick = made(**SPANS), made(stop_time=1e-3, **SPANS)
    shaft = quick.stack.inertia * quick.params.speed / 1e-3
    assert quick.drive.motor_torque == pytest.approx(shaft / 100 / 0.85)
    assert made(stop_time=1.0, **SPANS).drive.motor_torque == steady.drive.motor_torque < quick.drive.motor_torque


def test_two_shafts_in_a_loom() -> None:
    loom = LOOM.design(AutomatedLoomParams.read({"aim": "price", "shedding.shafts": "2", "beat": "comb"}))
    assert len(loom.shedding.shafts) == 2
    first, last = loom.shedding.shafts
    assert last.params.lift == pytest.approx(
        first.params.lift * last.params.spans_of_warp[0] / first.params.spans_of_warp[0]
    )
    assert sum(first.numbers) + sum(last.numbers) == loom.warps


def test_too_few_warps_for_the_shafts() -> None:
    with pytest.raises(ParameterError, match="3 warps on 2 shafts; two warps a shaft; set fewer shafts"):
        made(cloth=cloth(warps=3), shafts=2)


@pytest.mark.parametrize("shafts", [1, 2])
def test_the_baulks_of_a_reed_clamp_all_dents_and_stand_on_the_bearings(shafts) -> None:
    design = made(shafts=shafts, guides="reed", cloth=cloth(warps=12, **CLOTH), **LENGTHS)
    connected = contacts(tree(design, [placement(y=float(k)) for k in range(shafts)])).groups
    held = [group for group in connected if any(name.startswith("shedding/reed") for name in group.parts)]
    dents = [n for group in held for name, n in group.parts.items() if name.startswith("shedding/reed-dent")]
    assert dents == [13] * shafts
    assert len(held) == shafts


def test_a_dent_weighs_its_solid_and_baulks_follow_the_beam() -> None:
    design = made(shafts=1, guides="reed", **SPANS)
    own, shaft = reed(design, 0), design.first
    assert own is not None
    assert dent(shaft).volume * design.params.density == pytest.approx(shaft.stack.guide_mass, rel=1e-12)
    inertia = 2 * own.side**4 / 12
    expected = 5 * own.rubbing * own.length**3 / (384 * 210e9 * inertia)
    assert own.sags[0] == pytest.approx(expected, rel=1e-3)
    assert "deflection of the reed across the warps" in {check.name for check in MACHINE.report(design).checks}

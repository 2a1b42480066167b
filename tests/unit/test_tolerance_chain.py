"""Tolerances along a cam shaft: piles of random sheets, coils at their limits, shims in list and space; of a loom."""

import itertools

import numpy as np
import pytest
from cloths import cloth
from default_machines import default_design
from hypothesis import given
from hypothesis import strategies as st

from ilmek.elements.sheet_tolerances import CLASSES, sheet_tolerance, statistical_sum, worst_sum
from ilmek.elements.tolerance_chains import ToleranceLink, ToleranceStack
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.tolerance_chains import BAR, FACE, GRIPPER, tolerance_stacks
from ilmek.machines.shedding import MACHINE, SheddingDesign, SheddingParams
from ilmek.machines.shedding.tree import tree
from ilmek.part.bill import bill
from ilmek.part.meetings import meetings
from ilmek.report import Check
from ilmek.units import mm

FINE, COARSE = cloth(warp_pitch=1.3 * mm, warps=400), cloth(warp_pitch=3 * mm, warps=60)
LOOMS = {
    "thesis": {},
    "fine, two shafts": dict(cloth=FINE, shafts=2, guides="cams"),
    "fine, reed": dict(cloth=FINE, shafts=1, guides="reed"),
    "coarse": dict(cloth=COARSE, sheet_tolerance="normal"),
}


def made(**settings_given) -> SheddingDesign:
    return MACHINE.design(SheddingParams(**settings_given))


def check(name: str, **settings_given) -> Check:
    return next(one for one in MACHINE.report(made(**settings_given)).checks if one.name == name)


@given(st.lists(st.tuples(st.integers(1, 20), st.floats(0.01, 0.2)), min_size=1, max_size=4), st.floats(0, 1))
def test_random_piles_keep_their_sums(sheets, share) -> None:
    """Coils at their mean deviation and normal scatter: 99.7 % (one-sided 99.87 %) keep the statistical sum."""
    rng = np.random.default_rng(7)
    tolerances = np.repeat([tolerance for _, tolerance in sheets], [number for number, _ in sheets])
    piles = (tolerances * rng.normal(share, (1 - share) / 3, (4000, len(tolerances)))).sum(axis=1)
    kept = statistical_sum(sheets, share)
    assert np.mean(piles <= kept + 1e-9) > 0.995
    assert kept <= worst_sum(sheets) + 1e-12
    limits = (tolerances * rng.choice([-1, 1], (100, len(tolerances)))).sum(axis=1)
    assert np.abs(limits).max() <= worst_sum(sheets) + 1e-12


@pytest.mark.parametrize("quality", CLASSES)
def test_thicker_sheets_have_no_smaller_tolerance(quality) -> None:
    values = [sheet_tolerance(thickness * mm, quality) for thickness in np.linspace(0.1, 6, 500)]
    assert np.all(np.diff(values) >= 0)
    assert all(sheet_tolerance(t * mm) < sheet_tolerance(t * mm, "normal") for t in np.linspace(0.1, 6, 50))


@pytest.mark.parametrize("name", LOOMS)
def test_the_stack_in_space_has_no_gap_and_no_overlap(name) -> None:
    """Sheets of the tree in a row: each begins where the last one ends, within a shim that a place leaves out."""
    design = made(**LOOMS[name])
    for index, shaft in enumerate(design.shafts):
        body = next(one for one in tree(design).bodies if one.id == f"shedding/cam shaft{_of(index)}")
        sheets = [
            one
            for one in body.occurrences
            if any(k in one.part.id for k in ("shedding-cam", "guide", "spacer", "shim"))
        ]
        spans = sorted(
            (position.origin[2], position.origin[2] + one.part.shape.length)
            for one in sheets
            for position in one.positions
        )
        gaps = np.array([later[0] - before[1] for before, later in itertools.pairwise(spans)])
        assert np.abs(gaps).max() < 1e-9
        pitches = (shaft.stack.shares.pitch * (sum(shaft.numbers) - 1), spans[-1][1] - spans[0][0])
        assert pitches[0] < pitches[1] < pitches[0] + 3 * shaft.stack.shares.pitch
        cams = sum(len(one.positions) for one in sheets if "shedding-cam" in one.part.id)
        places = sum(len(one.positions) for one in sheets if "/shims" in one.part.id)
        assert places == (cams - 1) // design.chain.interval


def _of(index: int) -> str:
    return f"-shaft-{index + 1}" if index else ""


@pytest.mark.parametrize("name", LOOMS)
def test_coils_at_a_limit_leave_a_place_for_their_shims(name) -> None:
    """Every sheet at its limit: the shims of a place still fill it, nothing must be ground."""
    design = made(**LOOMS[name])
    shares, chain, quality = design.first.stack.shares, design.chain, design.params.sheet_tolerance
    widths = [shares.thickness] + [shares.guide] * shares.guides + [shares.spacer] * (shares.spacer > 0)
    deviation = chain.interval * sum(sheet_tolerance(width, quality) for width in widths)
    assert chain.worst == pytest.approx(deviation)
    assert chain.shims - deviation >= -1e-9


@pytest.mark.parametrize(
    ("name", "settings"),
    [
        ("cam stack, worst case", dict(shim_interval=20)),
        ("cam stack, statistical", dict(shim_interval=12)),
        ("cam stack, statistical", dict(offset_limit=0.05)),
        ("groove against warp", dict(cam_thickness=0.95 * mm, guides="cams", shafts=1)),
        ("groove against warp", dict(cam_thickness=0.97 * mm, sheet_tolerance="normal", guides="cams")),
    ],
)
def test_a_stack_that_does_not_keep_its_warps_fails(name, settings) -> None:
    failed = check(name, **settings)
    assert not failed.ok
    assert failed.cure
    assert check(name).ok


def test_shims_are_in_the_list() -> None:
    titles = {line.name: line.number for line in bill(tree(made()))}
    assert titles["shims of the cams"] == titles["guide cam beside shims"] == 599 // made().chain.interval
    assert titles["guide cam"] + titles["guide cam beside shims"] == 601


def test_random_assemblies_keep_the_closures_of_a_loom() -> None:
    """Every link of 10⁵ looms anywhere within its tolerance: sizes normal, cut off at their limits; play even."""
    random = np.random.default_rng(3)
    stacks = tolerance_stacks(default_design("automated-loom"))
    assert [one.title for one in stacks] == [
        "height of the shed",
        "opener between two warps",
        "gripper beside a warp",
    ]
    for one in stacks:
        closure = np.zeros(100_000)
        for link in one.links:
            shape = random.uniform(-1, 1, len(closure)) if link.play else random.normal(0, 1 / 3, len(closure))
            closure += link.ratio * link.deviation * np.clip(shape, -1, 1)
        assert one.statistical < np.abs(closure).max() <= one.worst
        assert np.mean(np.abs(closure) > one.statistical) < 0.0035
        assert np.quantile(np.abs(closure), 0.997) > 0.8 * one.statistical
        assert one.statistical < one.worst < one.room


def test_a_gripper_in_two_bores_moves_its_tip_farther_than_they_are_off() -> None:
    loom = default_design("automated-loom")
    guided = [
        one for one in meetings(loom_tree(loom)) if one.inner.part.id == GRIPPER and one.bore.part.id in {FACE, BAR}
    ]
    places = [(one.bore.part.id, sum(one.along) / 2) for one in guided]
    middles = {part: max(middle for bore, middle in places if bore == part) for part in (FACE, BAR)}  # of the left one
    off = {FACE: 7e-6, BAR: -4e-6}
    slope, tip = np.polyfit([middles[FACE], middles[BAR]], [off[FACE], off[BAR]], 1)
    (stack,) = (one for one in tolerance_stacks(loom) if one.title == "gripper beside a warp")
    ratios = {part: next(link.ratio for link in stack.links if link.play and word in link.name) for part, word in WORDS}
    assert sum(ratios[part] * off[part] for part in off) == pytest.approx(tip)
    assert slope != 0


WORDS = (FACE, "face"), (BAR, "cross-bar")


def test_one_link_that_is_play_keeps_its_worst_case() -> None:
    alone = ToleranceStack("", 1.0, (ToleranceLink("", 0.2, -2.0, play=True),))
    assert (alone.worst, alone.statistical) == (0.4, 0.4)

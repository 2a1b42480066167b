"""Sizes of a head that follow from the loads of a coarse carpet, and the rail that they need."""

from functools import cache

import pytest
from default_machines import SETTLED, loom_report

from ilmek.elements.motors import smallest_motor
from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign, design
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.knotting import CAMS
from ilmek.machines.automated_loom.own_parts import RETREAT_MOTOR
from ilmek.machines.weaver.carriage_belt import RADIUS
from ilmek.machines.weaver.carriage_drive import PULLEY_AT
from ilmek.machines.weaver.params import WeaverParams
from ilmek.machines.weaver.sizes import PLATES
from ilmek.machines.weaver.tree import drive_of
from ilmek.units import dm

SIZES = ("cam_thickness", "cam_gap", "cam_belt", "tool_mass", "sley_stroke")


@cache
def loom(knots: float, **others: str) -> LoomDesign:
    settings = {"knots_across": f"{knots}/dm", "width": "0.6m", "length": "0.9m", "beat": "comb", **SETTLED, **others}
    return design(AutomatedLoomParams.read({"aim": "price", **settings}))


def failed(made: LoomDesign) -> list[str]:
    return [check.name for check in made.head.checks if not check.ok]


@pytest.mark.parametrize("knots", [12, 15, 20, 24])
def test_cams_tie_coarse_knots_within_all_limits(knots: float) -> None:
    made = loom(knots)
    assert made.head.kind == CAMS
    assert failed(made) == []


def test_a_heavy_head_steps_more_slowly_so_that_its_motor_has_room_behind_the_drum() -> None:
    wide = {"width": "2.7m", "beat": "guide-cams", "weft.room": "7m", "tension": "25N"}
    made = loom(18, colours="23", heads="3", **wide).weaver
    usual, drive = WeaverParams().carriage_acceleration, drive_of(made)
    assert made.params.carriage_acceleration < usual
    assert drive.motor is not None
    assert drive.motor.face / 2 < PULLEY_AT + made.shape.front - (made.shape.magazine + made.shape.magazine_size).real
    quick = drive.force * usual / made.params.carriage_acceleration * RADIUS
    wider = smallest_motor(quick)
    assert wider is not None
    assert wider.face > drive.motor.face


def test_the_head_of_the_usual_quality_keeps_its_usual_sizes() -> None:
    params, usual = loom(25).weaver.params, WeaverParams()
    assert [getattr(params, size) for size in SIZES] == [getattr(usual, size) for size in SIZES]
    assert params.opener.height == usual.opener.height


@pytest.mark.parametrize("knots", [12, 15, 20])
def test_the_next_thinner_plate_would_not_bear_the_levers(knots: float) -> None:
    chosen = loom(knots).weaver.params.cam_thickness
    thinner = PLATES[PLATES.index(chosen) - 1]
    made = loom(knots, knotting=CAMS, **{"weaver.cam_thickness": f"{thinner} m"})
    assert [name for name in failed(made) if name.startswith("stress of the lever")]


@pytest.mark.parametrize(
    ("size", "value", "check"),
    [
        ("weaver.tool_mass", "0.25kg", "mass that a cam moves, side-gripper motion"),
        ("weaver.opener.height", "20mm", "opener: room of the tools between its plates"),
        ("weaver.sley_stroke", "50mm", "sley: stroke from above the opener to the fell"),
    ],
)
def test_a_size_that_is_set_stays_and_its_check_fails(size: str, value: str, check: str) -> None:
    made = loom(15, knotting=CAMS, **{size: value})
    assert check in failed(made)
    assert f"weaver: {check}" in [one.name for one in loom_report(made).failed]


@pytest.mark.parametrize("knots", [12, 15, 25])
def test_a_head_over_its_last_knot_and_its_step_is_beside_the_motors_of_the_retreat(knots: float) -> None:
    """By the meshes: the widest of the head, from the middle of its last pair on, and the inner side of a motor."""
    made = loom(knots, heads="1")
    bodies = {body.id: body for body in loom_tree(made).bodies}

    def extent(body: str, part: str) -> list[float]:
        return [
            abs(x)
            for occurrence in bodies[body].occurrences
            if occurrence.part.id == part
            for place in occurrence.positions
            for x in bodies[body].positions[0].after(place).points(occurrence.part.shape.mesh().points)[:, 0]
        ]

    last = made.task.cloth.width / 2 - made.knot_pitch / 2 + made.knot_pitch
    assert min(extent("automated-loom/retreat", RETREAT_MOTOR)) >= last + max(
        extent("weaver/head", "weaver/left-side-plate")
    )
    assert knots == pytest.approx(1 / made.knot_pitch * dm)

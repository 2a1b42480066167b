"""The weft side: what a bobbin holds, when it is changed, how the carrier moves, what holds its turns, its price."""

import math
from dataclasses import replace

import numpy as np
import pytest
from cloths import cloth

from ilmek.carpet.ground import ground_yarns
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.elements.materials import GRAVITY
from ilmek.machines.automated_loom import AutomatedLoomParams
from ilmek.machines.automated_loom import design as loom_for
from ilmek.machines.weft import MACHINE, Rapier, Shuttle, Weft, WeftParams, design
from ilmek.timing.cyclogram import check_all
from ilmek.timing.track import peak_acceleration, peak_speed
from ilmek.units import mm
from ilmek.weaving.selvedge import in_front, warps_let_go


def shuttle(**settings: object) -> tuple[Weft, Shuttle]:
    made = design(WeftParams(carrier="shuttle", **settings))  # type: ignore[arg-type]
    assert isinstance(made.carried, Shuttle)
    return made, made.carried


def rapier(**settings: object) -> tuple[Weft, Rapier]:
    made = design(WeftParams(carrier="rapier", **settings))  # type: ignore[arg-type]
    assert isinstance(made.carried, Rapier)
    return made, made.carried


def failed(made: Weft) -> list[str]:
    return [check.name for check in made.checks if not check.ok]


@pytest.mark.parametrize("diameter", [12 * mm, 25 * mm, 40 * mm])
def test_a_bobbin_holds_yarn_for_its_share_of_the_volume(diameter: float) -> None:
    """Layer by layer, round by round: the yarn's own volume is the packing times that of the winding."""
    made, carried = shuttle(bobbin_diameter=diameter)
    size, yarns = carried.bobbin, made.params.cloth.carpet_yarns
    radii = np.linspace(size.core / 2, size.diameter / 2, 100_001)
    winding = float(np.trapezoid(2 * math.pi * radii * size.length, radii))
    for wound, yarn in zip(carried.windings, (yarns.straight_weft, yarns.sinuous_weft), strict=True):
        volume = wound.capacity * math.pi * yarn.diameter**2 / 4
        assert volume == pytest.approx(made.params.packing * winding, rel=1e-9)
        assert wound.mass == pytest.approx(wound.capacity * yarn.linear_density)
        taken = np.cumsum(np.full(100_000, wound.a_row))
        assert wound.rows == int(np.sum(taken <= wound.capacity - made.params.reserve))


def test_the_sinuous_weft_is_longer_and_its_bobbin_lasts_longer() -> None:
    made, carried = shuttle()
    assert made.lengths.sinuous > made.lengths.straight
    straight, sinuous = carried.windings
    assert sinuous.rows > straight.rows


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("carrier", ["shuttle", "rapier"])
@pytest.mark.parametrize("width", [0.6, 1.2, 6.0])
def test_the_motion_keeps_its_limits_and_covers_the_cloth(carrier: str, width: float) -> None:
    made = design(WeftParams(carrier=carrier, cloth=cloth(warps=round(width / (2 * mm)))))
    passage, params = made.passage, made.params
    time = np.linspace(0.0, passage.time, 200_001)
    position, speed, acceleration, jerk = passage.at(time)
    step = time[1]
    assert np.abs(np.gradient(position, step)).max() <= params.speed * (1 + 1e-6)
    assert np.abs(np.gradient(speed, step)).max() <= params.acceleration * (1 + 1e-3)
    assert np.abs(np.diff(acceleration) / step).max() <= params.jerk * (1 + 1e-6)
    assert np.abs(jerk).max() <= params.jerk * (1 + 1e-9)
    assert np.gradient(position, step)[1:-1] == pytest.approx(speed[1:-1], abs=1e-3)
    assert passage.run + params.cloth.width <= position.max() == pytest.approx(passage.stroke)
    assert position[-1] == pytest.approx(0.0 if passage.back else passage.stroke, abs=1e-9)


def test_a_rapier_goes_there_and_back_and_pauses_to_grip() -> None:
    made, _ = rapier()
    assert made.passage.time == pytest.approx(2 * made.passage.move.time + made.params.grip_time)
    middle = made.passage.at(np.array([made.passage.time / 2]))
    assert middle[:, 0] == pytest.approx([made.passage.stroke, 0, 0, 0])


def test_the_sag_of_a_rapier_is_that_of_a_beam() -> None:
    """Against the integral of the curvature along the rapier."""
    made, carried = rapier()
    span = made.params.cloth.width + 2 * made.params.edge
    tall, wide, wall = carried.tube
    area = tall * wide - (tall - 2 * wall) * (wide - 2 * wall)
    x = np.linspace(0, span, 20_001)
    weight, load = made.params.rapier_density * area * GRAVITY, made.params.gripper_mass * GRAVITY
    curvature = (weight * (span - x) ** 2 / 2 + load * (span - x)) / carried.rigidity
    slope = np.concatenate([[0], np.cumsum((curvature[1:] + curvature[:-1]) / 2)]) * x[1]
    assert float(np.trapezoid(slope, x)) == pytest.approx(carried.sag, rel=1e-6)


def held(front_outside: bool, crosses_in_front: bool, warps: int) -> int:
    """Brute force: the turn is pulled warp by warp; it passes one only where it lies on the same side of both wefts."""
    for warp in range(warps):
        own = front_outside if warp % 2 == 0 else not front_outside
        if own != crosses_in_front:
            return warp
    return warps


@pytest.mark.parametrize("front", [True, False])
@pytest.mark.parametrize("crosses", [True, False])
def test_a_turn_lets_go_of_no_or_one_warp(front: bool, crosses: bool) -> None:
    assert warps_let_go(front, crosses) == held(front, crosses, 100)


def test_wefts_that_cross_wrongly_let_the_outermost_warps_go() -> None:
    assert in_front(0, 1)
    assert not in_front(0, 0)
    assert failed(shuttle()[0]) == []
    assert failed(shuttle(crossed=False)[0]) == ["outermost warps that a turn releases"]


@pytest.mark.parametrize(
    ("settings", "name"),
    [
        (dict(bobbin_diameter=8 * mm), "rows between two changes of a bobbin"),
        (dict(lift=20 * mm), "opening of the shed for the carrier"),
        (dict(cloth=cloth(warp_pitch=40 * mm, warps=30), bobbin_diameter=8 * mm), "lifted warps under the shuttle"),
        (dict(edge=300 * mm), "gap that the shuttle bridges at the edge"),
        (dict(acceleration=300.0, jerk=1e5), "force on the shuttle's magnets"),
        (dict(brake=50.0), "tension of the straight weft"),
        (dict(speed=90.0, acceleration=9e3, jerk=1e7), "torque of the axis' servo"),
        (dict(carriage_mass=50.0, acceleration=2000.0, jerk=1e6), "belt of the axis"),
    ],
)
def test_shuttles_that_would_not_work_fail_a_check_with_a_cure(settings: dict[str, object], name: str) -> None:
    found = {check.name: check for check in shuttle(**settings)[0].checks}
    assert not found[name].ok
    assert found[name].cure


def test_an_edge_without_selvedge_is_reported() -> None:
    assert MACHINE.report(design(WeftParams())).warnings == ()
    assert "no selvedge warp" in MACHINE.report(design(WeftParams(selvedge_warps=1))).warnings[0]


@pytest.mark.parametrize(
    ("settings", "name"),
    [
        (dict(cloth=cloth(warps=3008)), "sag of the rapier"),
        (dict(rapier_height=3 * mm, acceleration=500.0, jerk=1e5), "safety of the rapier against buckling"),
        (dict(room=0.5), "room of the rapier beside the cloth"),
        (dict(brake=30.0), "pull of the weft in the gripper"),
        (dict(turn=4 * mm), "warps that bind a tucked end"),
    ],
)
def test_rapiers_that_would_not_work_fail_a_check_with_a_cure(settings: dict[str, object], name: str) -> None:
    found = {check.name: check for check in rapier(**settings)[0].checks}
    assert not found[name].ok
    assert found[name].cure


def test_the_cheaper_carrier_is_chosen_or_the_quicker() -> None:
    cheap, quick = design(WeftParams(cloth=cloth(warps=308))), design(WeftParams(cloth=cloth(warps=308), aim="time"))
    assert cheap.price <= min(one.price for one in cheap.alternatives)
    assert quick.time <= min(one.time for one in quick.alternatives)
    assert (cheap.carrier, quick.carrier) == ("shuttle", "rapier")
    assert design(WeftParams(aim="time", cloth=cloth(warps=1508))).carrier == "shuttle"
    choice = {one.name: one for one in design(WeftParams()).choices}["bobbin"]
    assert choice.decided_by == "rows between two changes of a bobbin"


@pytest.mark.parametrize("carrier", ["shuttle", "rapier"])
def test_a_loom_times_its_carrier_within_its_limits(carrier: str) -> None:
    loom = loom_for(AutomatedLoomParams.read({"aim": "price", "weft": carrier, "width": 2.0, "weft.speed": 2.0}))
    row = loom.row_cyclogram
    track = row.track(carrier)
    assert peak_speed(track, row.period) <= 2.0 * (1 + 1e-9)
    assert peak_acceleration(track, row.period) <= loom.weft.params.acceleration * (1 + 1e-9)
    assert all(check.ok for check in check_all(row, row.relations))
    assert len(track.segments) == (4 if carrier == "rapier" else 2)


@pytest.mark.parametrize("selvedge", [8, 20])
@pytest.mark.parametrize("pitch", [0.5 * mm, 2 * mm])
def test_bill_and_loom_have_the_same_wefts_warps_and_lengths(selvedge: int, pitch: float) -> None:
    given = {"width": 0.8, "warp_pitch": pitch, "selvedge_warps": selvedge, "heads": 1, "weft.turn": 30 * mm}
    given |= {"yarns.weft": "wool", "knotting": "cams"}
    loom = loom_for(AutomatedLoomParams.read({"aim": "price", **given}))
    size, quality = CarpetSize(0.8, 1.8), Quality(0.5 / pitch, 0.5 / pitch)
    ground = loom.params.ground
    warp, straight, sinuous, ends = ground_yarns(size, quality, loom.rows, loom.columns, ground)
    weft, yarns = loom.weft, loom.task.yarns
    assert weft.weft_need == pytest.approx({"straight weft": straight.length, "sinuous weft": sinuous.length})
    assert straight.mass == pytest.approx(straight.length * yarns.straight_weft.linear_density)
    assert sinuous.mass == pytest.approx(sinuous.length * yarns.sinuous_weft.linear_density)
    assert ends.length == pytest.approx(
        2 * math.ceil(20 * mm / yarns.sinuous_weft.diameter) * sinuous.length / loom.rows
    )
    assert warp.length / (1.8 / 0.99 * 1.03 + 2 * 0.1 + 0.4) == pytest.approx(loom.warps)
    assert loom.weft.params.cloth is loom.task.cloth


def test_the_bobbins_of_a_shuttle_last_longer_for_a_narrower_cloth_and_a_thinner_weft() -> None:
    made, carried = shuttle()
    params, own = made.params, made.params.cloth
    assert made.bobbins_for(own.warps, own.yarns) == made.bobbins
    assert [one.rows for one in made.bobbins] == [one.rows for one in carried.windings]
    narrow = made.bobbins_for(own.warps // 2, own.yarns)
    same = design(
        replace(
            params,
            carrier="shuttle",
            cloth=replace(own, warps=own.warps // 2),
            bobbin_diameter=carried.bobbin.diameter,
            bobbin_length=carried.bobbin.length,
        )
    )
    assert narrow == same.bobbins
    thin = made.bobbins_for(own.warps, replace(own.yarns, straight_weft_density=2e-4))
    assert thin[0].rows > made.bobbins[0].rows
    assert rapier()[0].bobbins_for(100, own.yarns) == ()


@pytest.mark.parametrize("carrier", ["shuttle", "rapier"])
@pytest.mark.parametrize("pitch", [0.25 * mm, 4 * mm])
@pytest.mark.parametrize("width", [0.6, 6.0])
def test_every_width_and_pitch_has_a_report(carrier: str, pitch: float, width: float) -> None:
    woven = cloth(warps=round(width / pitch), warp_pitch=pitch)
    params = WeftParams(carrier=carrier, cloth=woven, rows=round(1 / pitch))
    report = MACHINE.report(design(params))
    assert not [warning for warning in report.warnings if "left out" in warning]
    assert all(check.cure for check in report.checks if not check.ok and check.name != "parts")

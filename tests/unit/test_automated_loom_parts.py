"""The loom's parts list, prices, frame and energy."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from default_machines import default_report, loom_report
from hypothesis import given
from hypothesis import strategies as st

from ilmek.elements.columns import SECTIONS
from ilmek.elements.drive_parts import positive_work
from ilmek.elements.prices import PRICES, read_prices
from ilmek.errors import ParameterError
from ilmek.loom.bobbins import stop_time
from ilmek.machines import BEATS, warp_tension
from ilmek.machines.automated_loom import AutomatedLoomParams, LoomDesign, design
from ilmek.machines.automated_loom.cyclogram import BEATER
from ilmek.machines.automated_loom.energy import energy_of
from ilmek.machines.automated_loom.estimate import estimated_time, estimated_times_at, time_shares
from ilmek.machines.automated_loom.frame import (
    MOST_COLUMNS,
    STEEL,
    FrameTask,
    HollowSquare,
    RailTask,
    column_load,
    eccentric,
    euler,
    frame_for,
    rail_ahead,
    rail_sag,
    rail_support_load,
)
from ilmek.machines.automated_loom.parts import PartsList, parts_of_loom, price_of
from ilmek.report import Report
from ilmek.timing.track import peak_acceleration
from ilmek.units import turn


@cache
def loom() -> LoomDesign:
    return design(AutomatedLoomParams(aim="price"))


@cache
def listed() -> PartsList:
    return parts_of_loom(loom())


def task_of_rail() -> RailTask:
    rail = task_of_frame().rail
    assert rail is not None
    return rail


def task_of_frame() -> FrameTask:
    return listed().frame.task


def loose() -> Report:
    return default_report("automated-loom")


def test_a_price_list_from_a_text_changes_what_it_names_and_nothing_else():
    prices = read_prices("bearing each = 9  # a remark\n\nservo per W = 1; control each = 0; milling s per cm3 = 2")
    assert prices["bearing"].each == 9
    assert prices["servo"] == replace(PRICES["servo"], per_W=1.0)
    assert prices["control"].each == 0
    assert prices["milling"] == replace(PRICES["milling"], time_per_cm3=2.0)
    assert {kind for kind in PRICES if prices[kind] != PRICES[kind]} == {"bearing", "servo", "control", "milling"}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("bearing = 9", "is no price"),
        ("bearing each", "is no price"),
        ("baering each = 9", "did you mean bearing"),
        ("bearing each = -1", "0 or more"),
        ("bearing each = 9 EUR", "leave the currency out"),
        ("bearing each = nan", "0 or more"),
    ],
)
def test_a_line_that_is_no_price_is_told(text, said):
    with pytest.raises(ParameterError) as caught:
        read_prices(text)
    assert said in str(caught.value)


def test_the_price_is_linear_in_every_rate():
    """Twice all rates, twice the price; and the sum over kinds priced alone is the whole."""
    money = ("each", "per_kg", "per_m", "per_W", "per_m2", "per_h")
    double = {k: replace(r, **{name: 2 * getattr(r, name) for name in money}) for k, r in PRICES.items()}
    assert sum(price_of(part, double) for part in listed().parts) == pytest.approx(2 * listed().price)
    assert listed().price > 0


def test_the_list_has_a_part_for_every_warp_head_and_axis():
    numbers = {part.name: part.number for part in listed().parts}
    assert numbers["shedding cam"] == loom().warps == 608
    # Between two warps, and at both ends; some are thin, with shims.
    assert numbers["guide cam"] + numbers["guide cam beside shims"] == 609
    assert numbers["guide cam beside shims"] == numbers["shims of the cams"] == 607 // 7
    each = ("cam shaft of the head", "motor of a head", "motor of a carriage")
    assert {numbers[name] for name in each} == {loom().heads}
    assert numbers["cylinder"] + numbers["spacer cylinder"] == 3
    assert numbers["yarn tube"] == loom().heads * loom().params.colours
    motors = sum(part.number for part in listed().parts if part.name.startswith("motor"))
    assert motors == numbers["axis of the control"]


def test_mass_and_price_of_the_report_are_those_of_its_table():
    made = loose()
    results = {result.name: result.value for result in made.results}
    rows = next(table for table in made.tables if table.name == "loom-parts").rows
    assert results["price"] == pytest.approx(sum(float(row[6]) for row in rows))
    assert results["mass"] == pytest.approx(sum(float(row[5]) for row in rows if row[5] == row[5]))
    assert results["power_mean"] == pytest.approx(sum(results["power_shares"].values()))
    assert sum(results["time_shares"].values()) == pytest.approx(1.0)
    assert results["energy_per_area"] * 1.2 * 1.8 == pytest.approx(results["power_mean"] * results["weaving_time"])


def test_cylinders_of_the_list_are_those_of_the_warp_tension_at_the_looms_own_pitch_and_shed():
    loom = design(AutomatedLoomParams(aim="price", width=1.0, warp_pitch=1.6e-3, lift=0.07))
    results = {one.name: one.value for one in warp_tension.MACHINE.report(loom.warp_tension).results}
    masses = [part.mass_all for part in parts_of_loom(loom).parts if part.name in ("cylinder", "spacer cylinder")]
    assert sum(masses) == pytest.approx(results["mass_cylinders"])
    assert results["slot_pitch"] == loom.task.cloth.warp_pitch
    compensator = loom.machines["tension-compensator"].design
    gain = results["tension_woven"] - loom.warp_tension.params.cloth.warp_tension
    assert results["tension_shed"] == pytest.approx(compensator.tension_open + gain)


def test_work_of_a_torque_counts_only_where_it_drives():
    assert positive_work(lambda q: 3.0 * np.sin(q)) == pytest.approx(6.0, rel=1e-5)
    assert positive_work(lambda q: -np.ones_like(q)) == 0.0


def test_energy_without_losses_or_standby_is_the_work_alone():
    bare = design(AutomatedLoomParams(aim="price", drive_efficiency=1.0, standby_power=0.0))
    usual, work = energy_of(loom(), listed().axes), energy_of(bare, listed().axes)
    assert work.shares["standing by"] == 0
    assert usual.total - usual.shares["standing by"] == pytest.approx(work.total / 0.7)


def test_column_formulas_at_their_limits():
    section = HollowSquare(0.1, 0.005)
    assert section.area == pytest.approx(0.0019)
    assert section.inertia == pytest.approx((0.1**4 - 0.09**4) / 12)
    load = euler(2.0, section)
    stress, bow = eccentric(1e-3 * load, 0.0, 2.0, section)
    assert (stress, bow) == (pytest.approx(1e-3 * load / section.area), 0.0)
    # Small loads: the bow of a couple P e at both ends, P e h^2 / (8 E I).
    small = 1e-6 * load
    expected = small * 0.05 * 2.0**2 / (8 * STEEL.modulus * section.inertia)
    assert eccentric(small, 0.05, 2.0, section)[1] == pytest.approx(expected, rel=1e-5)
    assert eccentric(1.01 * load, 0.05, 2.0, section) == (math.inf, math.inf)


@given(st.floats(0.01, 1.0))
def test_sag_of_a_load_over_the_middle_is_its_influence_line_integrated(share):
    """Deflection in the middle of a point load at a from an end: P a (3 l^2 - 4 a^2) / (48 E I), a <= l/2."""
    section, span = HollowSquare(0.1, 0.005), 1.3
    wide = share * span
    task = replace(task_of_rail(), width=span, spans=1, heads=1, head_mass=40.0, head_width=wide)
    own = rail_sag(replace(task, head_mass=0.0), section)
    assert own == pytest.approx(5 * task.rail_mass(section) * 9.81 * span**4 / (384 * STEEL.modulus * section.inertia))
    places = (span - wide) / 2 + (np.arange(2000) + 0.5) / 2000 * wide / 2
    influence = places * (3 * span**2 - 4 * places**2) / (48 * STEEL.modulus * section.inertia)
    assert rail_sag(task, section) - own == pytest.approx(40.0 * 9.81 * float(influence.mean()), rel=1e-6)


@given(st.floats(1e3, 1e5), st.floats(0.5, 4.0), st.floats(0.01, 0.2))
def test_the_frame_keeps_its_limits_with_the_lightest_section(pull, width, lever):
    rail_task = RailTask(width, 2, 4, 8.0, 0.08, 2e-4)
    frame = frame_for(FrameTask(2.0, 0.6, pull, lever, 500.0, 2.0, 4.0, 1e-3, rail=rail_task))
    rail, _ = frame.guide
    assert frame.column_stress <= STEEL.strength / 2
    assert frame.buckling_factor >= 4
    assert frame.column_bow <= 1e-3
    assert rail_sag(rail_task, rail) <= rail_task.sag_limit
    lighter = [HollowSquare(*size) for size in SECTIONS if HollowSquare(*size).area < rail.area]
    assert all(rail_sag(rail_task, section) > rail_task.sag_limit for section in lighter)


def test_as_many_heads_count_on_a_span_as_find_room_on_it():
    section = HollowSquare(0.1, 0.005)
    few = rail_sag(replace(task_of_rail(), heads=3, head_width=0.5, width=1.5, spans=1), section)
    assert rail_sag(replace(task_of_rail(), heads=30, head_width=0.5, width=1.5, spans=1), section) == few


def test_a_frame_that_no_section_makes_is_of_the_largest_and_fails():
    longer = replace(task_of_rail(), width=50.0)
    wide, pulled = (
        frame_for(replace(task_of_frame(), **one)) for one in ({"rail": longer}, {"pull": 1e8, "room": 1.0})
    )
    assert wide.guide[0].side == pulled.column.side == max(side for side, _ in SECTIONS)
    assert pulled.number == MOST_COLUMNS
    assert [check.name for check in wide.checks if not check.ok] == [
        "frame: sag of the heads' rail",
        "frame: heads' rail bends: natural frequency",
    ]
    assert {check.name for check in pulled.checks if not check.ok} == {
        "frame: stress of a column",
        "frame: bow of a column",
    } | ({"frame: against buckling"} if pulled.buckling_factor < 4 else set())
    assert all(check.cure for check in (*wide.checks, *pulled.checks))


def test_columns_that_find_no_room_for_one_are_several_that_share_the_load():
    task = replace(task_of_frame(), pull=45e3, lever=0.48, height=3.0, carried=6000.0, room=1.0)
    free, narrow = frame_for(task), frame_for(replace(task, room=0.2))
    assert free.number == 1 < narrow.number
    assert narrow.column.side <= 0.2 < free.column.side
    assert not [check for check in narrow.checks if not check.ok]
    share = replace(task, pull=45e3 / narrow.number, carried=6000.0 / narrow.number)
    assert (narrow.column_stress, narrow.column_bow) == pytest.approx(column_load(share, narrow.column))
    fewer = [one for one in SECTIONS if one[0] <= 0.2]
    assert all(column_load(task, HollowSquare(*one), narrow.number - 1)[1] > task.bow_limit for one in fewer)


def test_a_support_before_the_rail_twists_it_as_a_bar_held_at_both_ends():
    """Half of the torque R a goes to each neighbour: finite differences of the twist along two spans give its angle."""
    section, task = HollowSquare(0.08, 0.004), replace(task_of_rail(), width=4.0, spans=2)
    single = replace(task, width=2.0, spans=1)
    sunk = rail_sag(task, section) - rail_sag(single, section)
    load, ahead = rail_support_load(task, section), rail_ahead(section, task.drop)
    shear, torsion, nodes = STEEL.modulus / 2.6, 0.076**3 * 0.004, 401
    step = 4.0 / (nodes - 1)
    stiff = np.diag(np.full(nodes - 2, 2.0)) - np.eye(nodes - 2, k=1) - np.eye(nodes - 2, k=-1)
    torque = np.zeros(nodes - 2)
    torque[(nodes - 3) // 2] = load * ahead
    twist = np.linalg.solve(stiff * shear * torsion / step, torque)
    assert sunk == pytest.approx(ahead * float(twist.max()), rel=1e-9)
    assert load == pytest.approx((task.rail_mass(section) * 2.0 + task.head_mass * task.heads) * 9.81, rel=1e-3)


def test_the_frame_bears_the_worst_case_of_the_warps():
    assert task_of_frame().pull == loom().warp_tension.loads.worst > loom().warp_tension.params.cloth.pull
    (columns, rail) = listed().frame.choices
    assert (columns.name, rail.name) == ("frame_columns", "frame_rail")
    assert columns.decided_by.startswith("frame: ")


def test_time_at_the_own_pitch_is_the_time_and_half_the_pitch_is_four_times_the_knots():
    own = estimated_time(loom())
    assert estimated_times_at(loom(), loom().task.cloth.warp_pitch, [loom().heads])[0] == pytest.approx(own)
    wefts, stops = loom().rows * loom().times.weft, stop_time(loom().bobbins, loom().rows)
    half = estimated_times_at(loom(), loom().task.cloth.warp_pitch / 2, [loom().heads])[0]
    # Four times the knots, twice the rows, and so at least twice the weft on thinner yarn.
    assert stops < half - 4 * (own - wefts - stops) - 2 * wefts < 4 * stops


def test_heads_are_busy_but_for_the_wefts_and_their_unequal_parts() -> None:
    found = time_shares(loom())
    assert found.knotting + found.colour_changes + found.wefts + found.stops == pytest.approx(1.0)
    tying = 1 - found.wefts - found.stops
    assert 0.8 * tying < found.utilisation <= tying + 1e-12


def test_shares_of_the_time_name_the_bottleneck():
    assert time_shares(loom()).bottleneck == "knotting"
    quick = design(
        AutomatedLoomParams(
            aim="price", width=0.4, length=0.2, knot_cycle=0.3, head_acceleration=1e4, heads=1, shed_speed=0.02
        )
    )
    assert time_shares(quick).bottleneck == "wefts and beats"


@cache
def beaten(kind: str) -> LoomDesign:
    return design(AutomatedLoomParams(aim="price", beat=kind))


@cache
def beaten_report(kind: str) -> Report:
    return loom_report(beaten(kind))


def comb_loom() -> LoomDesign:
    return beaten("comb")


@pytest.mark.parametrize("kind", BEATS)
def test_every_kind_of_beat_leaves_the_rows_that_the_carpet_has(kind):
    beat, report = beaten(kind).beat, beaten_report(kind)
    assert beat.beat_force_needed == pytest.approx(10.0)  # the hammer's fabric: 10 N on 15 N of tension
    assert beat.beat_force_warp >= beat.beat_force_needed * (1 - 1e-9)
    assert beat.row_pitch_left <= 4e-3 * (1 + 15 / 1346) / 0.99  # strained, unwashed
    # The bar of a comb on crank-rockers rests where a head with all of its parts stands.
    assert all("comb's bar" in check.name for check in report.failed) if kind == "linkage" else report.failed == ()


@pytest.mark.parametrize("kind", BEATS)
def test_a_loom_beats_with_one_of_them(kind):
    found = beaten_report(kind).as_json()["results"]
    with_one, without = ("beat_up", "hammer") if kind == "travelling" else ("hammer", "beat_up")
    assert with_one in found
    assert without not in found
    driven = sum(part.number for part in beaten(kind).beat.parts if part.drives)
    assert driven == ({"travelling": 2, "linkage": 1}.get(kind) or found["hammer"]["axes"])


def test_the_comb_beats_within_its_acceleration_and_after_the_shuttle():
    row = comb_loom().row_cyclogram
    assert peak_acceleration(row.track(BEATER), row.period) == pytest.approx(comb_loom().params.comb_acceleration)
    assert row.track(BEATER).segment("beat 1").start > row.track("shuttle").segment("pass").end
    slow = design(AutomatedLoomParams(aim="price", beat="comb", comb_acceleration=0.1))
    assert slow.row_cyclogram.period > row.period  # a longer beat needs a longer turn
    pressed = row.track(BEATER).segment("back 1").start - row.track(BEATER).segment("beat 1").end
    assert pressed / comb_loom().row_timing.beat.time * row.period / turn == pytest.approx(0.15)

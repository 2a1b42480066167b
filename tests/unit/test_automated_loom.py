"""The automated loom: what follows from a carpet, what is checked, and what cannot be."""

import contextlib
import math
import re
from functools import cache
from typing import Any

import numpy as np
import pytest
from default_machines import default_report, loom_report
from examples.draw_loom_scaling import OUT, drawn

from ilmek.elements.carpet_yarns import yarn
from ilmek.elements.yarns import usual_warp_density
from ilmek.errors import IlmekError, LoomError, ParameterError
from ilmek.machines import BEATS
from ilmek.machines.automated_loom import (
    AutomatedLoomParams,
    LoomDesign,
    design,
    estimated_time,
)
from ilmek.machines.automated_loom.cyclogram import BEATER, TAKE_UP
from ilmek.machines.automated_loom.figures import figures, time_against_pitch, time_of_one_knotter
from ilmek.machines.automated_loom.report import all_checks
from ilmek.report import Drawing, Plot, Report, Timing
from ilmek.timing.track import peak_acceleration, peak_speed, sample
from ilmek.units import deg, dm, hour, mm, rpm


@cache
def reported(**settings: Any) -> Report:
    """A loom's report, without its parts in space: the same settings are designed once."""
    return loom_report(design(AutomatedLoomParams(**{"aim": "price", **settings})))


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize(
    "settings",
    [
        dict(width=0.25, length=0.4, heads=1),
        dict(width=3.0, length=4.0, heads=10),
        dict(width=5.0, length=7.0, heads=20),
        dict(width=2.0, length=3.0, knots_across=100 / dm, heads=11),
        dict(width=2.2, length=2.8, knots_across=90 / dm, heads=10),
        dict(width=1.2, knots_across=10 / dm, knots_along=20 / dm, heads=2),
        dict(width=1.2, knotting="hand", beat="travelling"),
        dict(width=2.5, length=3.5, knotting="hand"),
    ],
)
def test_looms_for_other_carpets_keep_all_limits_but_those_in_space(settings: dict[str, Any]) -> None:
    loom = design(AutomatedLoomParams(aim="price", **settings))
    made = loom_report(loom)
    # Frames of the heaviest and the widest sway too near to the drives: their sections are chosen by strength and sag.
    frame = "frame: (.*: natural frequency)|deflection of an arm of the rail between its ends"
    assert [check.name for check in made.failed if not re.fullmatch(frame, check.name)] == []
    assert not made.failed or loom.params.width >= 5.0 or loom.heads > 10
    assert loom.warps == 2 * loom.columns + 8
    assert loom.shedding.params.cloth.warps == loom.warp_tension.params.cloth.warps == loom.warps
    assert loom.knot_pitch * loom.columns == pytest.approx(loom.params.width, abs=loom.knot_pitch)
    if loom.heads:
        assert loom.head_distance >= loom.head_width
    else:
        assert loom.weavers == math.floor(loom.params.width / 0.6)


def test_checks_carry_the_name_of_their_machine() -> None:
    names = [check.name for check in reported().all_checks]
    assert len(set(names)) == len(names)
    every = (
        "weaver",
        "beat-up",
        "weft",
        "shedding",
        "tension-compensator",
        "warp-tension",
        "row",
        "shuttle",
        "clearance",
    )
    for machine in every:
        assert any(name.startswith(f"{machine}: ") for name in names)


def test_results_and_figures() -> None:
    made = default_report("automated-loom")
    results = made.as_json()["results"]
    assert len(results) == len(made.results) + len(made.children)
    assert results["shedding"]["prime_radius"] == pytest.approx(78.16653826 * mm)
    assert results["warp_tension"]["torque"] == pytest.approx(608 * 15.0 * 70 * mm)
    assert results["weaver"]["cycle_time_knot"] == results["cycle_time_knot"] == 1.18
    assert [figure.name for figure in made.figures][:2] == ["loom-side", "loom-side-room"]
    assert {type(figure) for figure in made.figures} >= {Drawing, Timing, Plot}


def test_shuttle_and_beater_are_never_in_the_shed_together() -> None:
    loom = design(AutomatedLoomParams(aim="price"))
    angle = np.linspace(0, 2 * math.pi, 7201)
    moving = np.abs(sample(loom.row_cyclogram.track("shuttle"), angle).slope) > 1e-6
    beating = sample(loom.row_cyclogram.track(BEATER), angle).position > 1e-6
    assert moving.any()
    assert beating.any()
    assert not (moving & beating).any()
    opening = np.abs(loom.shedding.shed.opening(loom.row_timing.cam_angle(angle[moving])))
    assert opening.min() >= loom.params.open_share * loom.params.lift - 1e-9


def test_a_wide_loom_takes_the_time_that_its_shuttle_needs() -> None:
    loom = design(AutomatedLoomParams.read({"aim": "price", "width": 5.0, "weft.speed": 2.0, "beat": "comb"}))
    shuttle, period = loom.row_cyclogram.track("shuttle"), loom.row_cyclogram.period
    assert period > 12.0
    assert peak_speed(shuttle, period) == pytest.approx(2.0)
    assert peak_acceleration(shuttle, period) < 20.0
    assert loom.shedding.params.speed == pytest.approx(2 * math.pi / (loom.row_timing.turning * period))
    assert "speed of the shedding cams" not in {check.name for check in loom_report(loom).all_checks}


def test_a_speed_of_the_cams_that_is_required_and_not_reached_fails_a_check() -> None:
    for speed, reached in ((1.0 * rpm, True), (20 * rpm, False)):
        made = reported(width=0.45, length=0.6, beat="comb", heads=1, shed_speed=speed)
        check = next(check for check in made.checks if check.name == "speed of the shedding cams")
        assert check.ok is reached
        assert made["cycle_time_row"] >= 2 * math.pi / speed * (1 - 1e-9)


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize("width", [0.6, 2.0, 5.0, 6.0])
def test_a_wide_loom_is_many_narrow_ones_beside_each_other(width: float) -> None:
    """Supports of the cam shaft and strokes of the beater keep bar, cams and beat of a narrow loom."""
    loom = design(AutomatedLoomParams(aim="price", width=width, beat="travelling"))
    results = reported(width=width, beat="travelling").as_json()["results"]
    shaft, cams = results["shedding"], results["shedding"]["mass"]
    assert shaft["shaft_span"] <= 1.5
    assert shaft["shaft_bar"] <= 80 * mm
    assert shaft["prime_radius"] == pytest.approx(78.16653826 * mm)
    assert cams / width < 400
    # The travelling beater strokes on: the force of a warp is the same whatever the width.
    assert results["beaters"] == 1
    assert results["beat_force_warp"] == pytest.approx(results["beat_force"] / results["beaten_warps"])
    assert results["beat_force_knot"] == pytest.approx(2 * results["beat_force_warp"])
    assert results["beat_strokes"] == math.ceil(loom.warps / results["beaten_warps"])


def test_a_shaft_without_supports_between_would_grow_without_end() -> None:
    """The cams of a 4 m loom on two bearings: it is said, and supports are what mends it."""
    free = reported(width=4.0, shaft_span=6.0, beat="comb")
    assert [check.name for check in free.failed if check.name.startswith("shedding: ")] != []
    held = reported(width=4.0, beat="comb")
    assert [check.name for check in held.failed] == []
    assert held.as_json()["results"]["mass"] < free.as_json()["results"]["mass"]


def test_cylinders_that_weigh_on_the_warps_are_said() -> None:
    assert any("what the warps pull" in said for said in reported(width=6.0, beat="comb").warnings)
    assert not any("what the warps pull" in said for said in reported(width=2.0, beat="comb").warnings)


def test_one_head_has_no_neighbour_to_check() -> None:
    made = reported(heads=1, beat="comb")
    assert "distance of two heads" not in [check.name for check in made.all_checks]
    assert all(math.isfinite(check.value) and math.isfinite(check.limit) for check in made.all_checks)


def test_a_slow_beat_lengthens_the_row() -> None:
    quick, slow = (design(AutomatedLoomParams(aim="price", beat="travelling", beat_speed=one)) for one in (15.5, 10.0))
    assert slow.times.weft > quick.times.weft > 12.0
    assert [check for check in all_checks(slow) if check.name.startswith("row") and not check.ok] == []


@pytest.mark.parametrize(
    ("settings", "pitch", "across"),
    [({}, 2 * mm, 250.0), ({"warp_pitch": 1 * mm}, 1 * mm, 500.0), ({"knots_across": 400.0}, 1.25 * mm, 400.0)],
)
def test_pitch_and_quality_follow_each_other(settings: dict[str, Any], pitch: float, across: float) -> None:
    params = AutomatedLoomParams(aim="price", **settings)
    assert params.cloth.warp_pitch == pytest.approx(pitch)
    assert (params.quality.across, params.quality.along) == pytest.approx((across, across))


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (
            dict(warp_pitch=2 * mm, knots_across=40 / dm),
            "40 knots/dm on a warp pitch of 2 mm; 25 knots/dm is all that 2 mm pitch gives; 40/dm needs 1.25 mm",
        ),
        (dict(warp_pitch=2 * mm, knots_across=20 / dm), "25 knots/dm is what that 2 mm pitch gives"),
        (dict(heads=9), "9 heads of 88 mm do not fit a carpet 1.2 m wide; at most 7"),
        (dict(knotting="hand", heads=2, tubes=8), "heads, tubes with knotting=hand; a loom without heads has weavers="),
        (dict(knotting="hand", weavers=3), "3 weavers of 600 mm do not fit a carpet 1.2 m wide; at most 2"),
        (dict(weavers=2), "weavers=2 with knotting=auto"),
        (dict(open_share=1.0), "a shed of 60 mm is never as open as open_share=1 of it"),
        (dict(beat_end=105 * deg), "the shed is free of the shuttle from 108.4 deg on"),
        (dict(take_up_end=150 * deg), "the take-up ends before the beat"),
        (dict(width=20.0), "a carpet of 2000 × 180 cm is 2000 × 183.8 cm on the loom; at most 12 m wide"),
    ],
)
def test_looms_that_cannot_be(settings: dict[str, Any], said: str) -> None:
    with pytest.raises(LoomError, match=said):
        design(AutomatedLoomParams(aim="price", **settings))


@pytest.mark.parametrize(
    "settings",
    [dict(width=60.0), dict(width=-1.0), dict(heads=0), dict(knots_across=0.0), dict(colours=300), dict(knot="granny")],
)
def test_parameters_out_of_bounds(settings: dict[str, Any]) -> None:
    with pytest.raises(ParameterError):
        AutomatedLoomParams(aim="price", **settings)


@pytest.mark.matrix(light=2)
@pytest.mark.parametrize(
    "settings",
    [
        dict(width=0.01, length=0.01, heads=1),
        dict(width=12.0, length=50.0, knots_across=1 / dm, heads=1),
        dict(width=0.3, knots_across=500 / dm, heads=1),
        dict(lift=0.5),
        dict(shed_speed=6.0),
        dict(margin=0.0),
        dict(head_width=1.0, heads=1),
        dict(knot_cycle=0.001),
        dict(weft="rapier"),
        dict(beat_speed=0.01),
    ],
)
def test_extreme_looms_are_designed_or_refused_in_words(settings: dict[str, Any]) -> None:
    with contextlib.suppress(IlmekError):
        assert reported(**settings).as_json()["results"]["cycle_time_row"] > 0


def test_more_heads_weave_sooner() -> None:
    loom = design(AutomatedLoomParams(aim="price", beat="comb"))
    times = [estimated_time(loom, heads) for heads in range(1, loom.heads_max + 1)]
    assert times == sorted(times, reverse=True)
    stops = 90.0 * sum(one.changes(450) for one in loom.bobbins)
    assert times[0] == pytest.approx(450 * (12 + 300 * (2 + 0.06 * loom.weaver.colour_change)) + stops)


def test_heads_are_the_fewest_for_the_price_and_the_most_for_the_time() -> None:
    assert reported()["heads"] == 1
    assert reported(aim="time", beat="comb")["heads"] == reported(aim="time", beat="comb")["heads_max"]
    assert reported(beat="comb", heads=7)["heads"] == 7


def test_a_deadline_takes_the_cheapest_loom_that_keeps_it() -> None:
    """No other kind of beat, with the heads that it needs for the deadline, is cheaper."""
    chosen = reported(deadline=24 * hour)
    assert chosen.failed == ()
    assert chosen["weaving_time"] <= 24 * hour
    others = [reported(deadline=24 * hour, beat=beat) for beat in BEATS]
    assert chosen["price"] == min(one["price"] for one in others if not one.failed)
    heads = chosen["heads"]
    assert estimated_time(design(AutomatedLoomParams(aim="price", deadline=24 * hour)), heads - 1) > 24 * hour


def test_a_deadline_that_no_number_of_heads_meets() -> None:
    assert [check.name for check in reported(deadline=8 * hour, beat="comb").failed] == ["weaving time, estimated"]


def test_the_machine_reads_its_parameters() -> None:
    settings = {"width": "1.2m", "warp_pitch": "2mm", "heads": "4", "knots_along": "30 1/dm", "beat": "comb"}
    results = loom_report(design(AutomatedLoomParams.read({"aim": "price", **settings}))).as_json()["results"]
    assert (results["heads"], results["rows"], results["columns"]) == (4, 540, 300)


def test_figure_of_the_scaling_has_a_curve_for_each_pitch() -> None:
    kept, made = (OUT / "loom-scaling.svg").read_text(encoding="utf-8"), drawn()
    for pitch in ("0.8 mm: 62.5/dm", "1 mm: 50/dm", "2 mm: 25/dm", "4 mm: 12.5/dm"):
        assert pitch in kept
        assert pitch in made


def scaling(loom: LoomDesign) -> Plot:
    """The figure of a loom's weaving time over the warp pitch, among those that it has."""
    plots = [make() for make in figures(loom) if make.func in (time_against_pitch, time_of_one_knotter)]
    (plot,) = plots
    assert isinstance(plot, Plot)
    assert plot.name == "weaving-time-pitch"
    return plot


@pytest.mark.parametrize("width", [0.01, 0.1])
def test_a_loom_of_one_head_shows_its_time_over_the_pitch(width: float) -> None:
    """Knots grow as the square of the density, rows with their wefts as the density itself: between both."""
    curve = scaling(design(AutomatedLoomParams(aim="price", width=width, beat="comb"))).series[0]
    finer = curve.x[-1] / curve.x[0]
    assert finer < curve.y[0] / curve.y[-1] < finer**2


def test_the_coarsest_carpet_has_its_loom() -> None:
    """Its page shows how time scales without asking for a carpet that is none."""
    plot = scaling(design(AutomatedLoomParams(aim="price", warp_pitch=50 * mm, beat="comb")))
    assert not any(series.label.startswith(("75 mm", "100 mm")) for series in plot.series)


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"length": 0.9013, "knots_along": 33 / dm},
        {"yarns.warp": "wool", "finish.shrink_along": 0.03, "finish.shrink_across": 0.02},
        {"tension": 40.0, "warp_pitch": 2.5 * mm, "length": 1.0},
    ],
)
def test_the_finished_carpet_has_the_size_and_the_knots_that_are_asked_for(settings: dict[str, Any]) -> None:
    """What the take-up winds, cut off and washed: the rows that are woven times its stroke, without the strain."""
    made = design(AutomatedLoomParams.read({"aim": "price", "beat": "comb", "width": 0.3, **settings}))
    wash, asked = (settings.get(f"finish.shrink_{name}") for name in ("along", "across")), made.params
    along, across = (default if one is None else one for one, default in zip(wash, (0.01, 0.0), strict=True))
    warp = yarn(settings.get("yarns.warp", "cotton"), made.task.yarns.warp.linear_density)
    strained = 1 + made.warp_tension.params.cloth.warp_tension / warp.stiffness
    stroke = made.row_cyclogram.track(TAKE_UP).stroke
    finished = made.rows * stroke / strained * (1 - along)
    wide = (made.warps - asked.selvedge_warps) * made.task.cloth.warp_pitch * (1 - across)
    assert finished == pytest.approx(asked.length, abs=stroke / 2)
    assert wide == pytest.approx(asked.width, abs=made.knot_pitch / 2)
    assert made.rows / finished == pytest.approx(settings.get("knots_along", made.columns / wide))
    assert made.columns / wide == pytest.approx(0.5 / settings.get("warp_pitch", 2 * mm))  # 2.5 mm gives 20/dm
    thick = made.weaver.params.pile_height + 3 * made.task.yarns.warp.diameter
    wound = math.pi * (made.side.roll**2 - made.side.lower.radius**2) / thick
    assert wound == pytest.approx(made.rows * stroke, abs=stroke / 2)
    assert made.warp_tension.params.carpet_length == pytest.approx(made.rows * stroke, abs=stroke / 2)


def test_the_warps_of_a_carpet_are_as_long_as_it_is_woven_without_their_strain() -> None:
    made, tension = reported(), 15.0
    warp = yarn("cotton", usual_warp_density(2 * mm, "cotton"))
    assert made["warp_strain"] == pytest.approx(tension / warp.stiffness)
    woven = 1.8 / 0.99 * (1 + tension / warp.stiffness)
    assert (made["woven_size"]["length"], made["woven_longer"]) == pytest.approx((woven, woven - 1.8))
    assert made["warp_cut"] == pytest.approx(woven / (1 + tension / warp.stiffness) * 1.03 + 2 * 0.1 + 0.4)
    slack = reported(tension=tension / 2)
    assert (slack["rows"], slack["warp_cut"]) == (made["rows"], pytest.approx(made["warp_cut"]))
    assert slack["woven_longer"] < made["woven_longer"]


def test_warps_are_wound_between_bars_drawn_in_and_tied() -> None:
    """608 warps of 2.47 m at 1 m/s, 12 s each; 31 bundles of 20 at both ends, 30 s each; half an hour to set up."""
    made = reported()
    each = made["warp_cut"]
    assert made["dressing_time"] == pytest.approx(0.5 * hour + 608 * (12 + each) + 2 * 31 * 30)
    assert made["warp_mass"] == pytest.approx(608 * each * usual_warp_density(2 * mm, "cotton"))
    assert made["warping_bars"] == ["first bar", "lease bar 1", "lease bar 2", "last bar"]
    assert made["bar_load"] == pytest.approx(608 * 0.05 * 15)
    params = AutomatedLoomParams.read({"length": 6.0, "width": 0.02, "selvedge_warps": 5, "warping.bar_distance": 2.5})
    long = params.dressing
    assert long.bars[3:] == ("turning bar 1", "turning bar 2", "last bar")  # 6.84 m in three legs
    assert long.bar_load == pytest.approx(2 * 15 * 0.05 * 15)
    ends = list(long.ends())
    assert [(one.knot, one.of_knot) for one in ends] == [
        *[(None, None)] * 2,
        *[(knot, of) for knot in range(1, 6) for of in (1, 2)],
        *[(None, None)] * 3,
    ]
    assert [one.number for one in ends if one.odd] == [1, 3, 5, 7, 9, 11, 13, 15]


def test_the_mass_off_the_loom_is_that_of_the_yarns_in_the_carpet() -> None:
    made = reported()
    yarns, rows, warps = AutomatedLoomParams(aim="price").cloth.carpet_yarns, made["rows"], made["warps"]
    weaver = next(child for child in made.children if child.machine == "weaver")
    pile = made["knots"] * weaver["yarn_in_knot"] * yarns.pile.linear_density
    warp = warps * (1.8 + 0.2) * yarns.warp.linear_density
    # The sinuous weft is at most a quarter longer than the straight one; ends and selvedges are a few percent.
    straight = rows * warps * 2 * mm * yarns.straight_weft.linear_density
    least = pile + warp + straight * 1.5
    assert 0.97 * least < made["mass_off_loom"] < 1.1 * least

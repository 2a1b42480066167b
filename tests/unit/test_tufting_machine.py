"""The tufting machine: the loop against a geometry built here, the looper against its linkage, bad input."""

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from ilmek.errors import ParameterError
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.tufting_machine import TuftingMachine
from ilmek.machines.tufting_machine.price import tufting_price
from ilmek.machines.tufting_machine.rocker_drive import RockerDrive
from ilmek.sentences.nouns_turkish import named
from ilmek.timing.cyclogram import check_cyclogram
from ilmek.timing.track import sample
from ilmek.units import deg, mm, turn

MACHINE = MACHINES["tufting-machine"]


@cache
def made(**settings: str) -> TuftingMachine:
    found: TuftingMachine = MACHINE.design(MACHINE.params.read(settings))
    return found


def answer(**settings: str) -> dict[str, Any]:
    report = MACHINE.report(made(**settings), illustrated=False)
    return {result.name: result.value for result in report.results}


def needle_height(angle: float) -> float:
    """Height of the needle's end E by circles cut with circles: the paper's Table 1."""
    crank, coupler, rocker, arm, rod = 15.0, 138.0, 115.0, 125.0, 120.0
    pin, shaft = crank * np.exp(1j * angle), 70 + 155j
    reach = abs(shaft - pin)
    turned = math.acos((coupler**2 + reach**2 - rocker**2) / (2 * coupler * reach))
    joint = pin + coupler * (shaft - pin) / reach * np.exp(1j * turned)
    end = shaft + arm * (joint - shaft) / rocker * np.exp(1j * math.radians(168))
    return float((end.imag - math.sqrt(rod**2 - (170 - end.real) ** 2)) * mm)


def amplitude(length: float, slack: float) -> float:
    """Half wave over a chord whose arc is longer by the slack: the arc's length by quadrature, not to first order."""

    def excess(height: float) -> float:
        steep = math.pi * height / length
        return quad(lambda y: math.hypot(1, steep * math.cos(math.pi * y / length)), 0, length)[0] - length - slack

    return float(brentq(excess, 0, length)) if slack > 0 else 0.0


def linking_number(first: np.ndarray, second: np.ndarray) -> float:
    """Gauss' integral of two closed polygons, segment by segment as solid angles [Klenin and Langowski, 2000]."""
    total = 0.0
    for a, b in zip(first, np.roll(first, -1, axis=0), strict=True):
        for c, d in zip(second, np.roll(second, -1, axis=0), strict=True):
            corners = [c - a, d - a, d - b, c - b]
            normals = [np.cross(corners[k], corners[(k + 1) % 4]) for k in range(4)]
            sizes = [np.linalg.norm(normal) for normal in normals]
            if min(sizes) < 1e-18:
                continue
            units = [normal / size for normal, size in zip(normals, sizes, strict=True)]
            angles = [math.asin(max(-1.0, min(1.0, float(units[k] @ units[(k + 1) % 4])))) for k in range(4)]
            sign = np.sign(np.cross(d - c, b - a) @ (c - a))
            total += sign * sum(angles)
    return total / (4 * math.pi)


def space(machine: TuftingMachine, angle: float, ahead: float) -> float:
    """Linking number of yarn and hook in space: x with the hook, y up from the lowest needle's point, z beside it."""
    looper = machine.params.looper
    heights = [needle_height(at) for at in np.linspace(0, turn, 1441)]
    rise = needle_height(angle) - min(heights)
    eye = rise + looper.eye
    hook = looper.eye + looper.below + looper.height  # upper edge
    under, middle = hook + machine.params.pile_height, hook - looper.height / 2
    height = amplitude(under - eye, rise)
    y = np.linspace(eye, under, 21)
    leg = np.stack((np.zeros(21), y, height * np.sin(math.pi * (y - eye) / (under - eye)) + 1e-6), axis=1)
    groove = np.array([[0, under + 5 * mm, -looper.needle], [0, eye, -looper.needle]])
    yarn = np.concatenate((groove, leg, [[0, under + 5 * mm, 1e-6]]))
    # The far side of the hook has to pass inside of the yarn.
    beside, low = looper.gap + looper.thickness, -60 * mm
    shank = np.array(
        [[-50 * mm, middle, beside], [ahead, middle, beside], [ahead, low, beside], [-50 * mm, low, beside]]
    )
    return abs(linking_number(yarn, shank))


@pytest.mark.parametrize(
    ("settings", "end", "outside"),
    [({}, 0, -1), ({}, 1, 1), ({"pile_height": "7mm"}, 0, -1), ({"pile_height": "7mm"}, 1, 1)],
)
def test_the_window_of_the_loop_is_that_of_curves_in_space(settings: dict[str, str], end: int, outside: int) -> None:
    """Linked one degree within each end; beyond the opening the hook passes outside of the yarn.

    The window closes before curves unlink: by the clearance to the eye.
    """
    machine = made(**settings)
    window = machine.loop.window
    at = (window.opened, window.shut)[end]
    assert space(machine, at - outside * deg, 2 * mm) == pytest.approx(1, abs=1e-6)
    if outside < 0:
        assert space(machine, at + outside * deg, 2 * mm) == pytest.approx(0, abs=1e-6)
    assert space(machine, at - outside * deg, -2 * mm) == pytest.approx(0, abs=1e-6)


def test_the_eye_rises_past_the_hook_where_circles_put_it() -> None:
    machine, angles = made(), np.arange(107, 250, 0.01)
    rises = np.array([needle_height(angle * deg) for angle in angles])
    rises -= min(needle_height(angle) for angle in np.linspace(0, turn, 7201))
    looper, window = machine.params.looper, machine.loop.window
    level = 0.5 * mm + 10 * mm + looper.height + looper.below + looper.eye
    assert window.out / deg == pytest.approx(angles[np.argmax(rises > level)], abs=0.02)
    eye = angles[np.argmax(rises + looper.eye > looper.eye + looper.below - looper.clear)]
    assert window.shut / deg <= eye + 0.02


def test_a_loop_is_formed_and_a_looper_60_degrees_late_forms_none() -> None:
    assert answer()["tufts"] is True
    assert answer()["loop_formed"] is True
    late = answer(**{"looper.late": "60deg"})
    assert late["tufts"] is False
    assert late["loop_formed"] is False
    assert any("hook enters before the loop closes" in str(reason) for reason in late["reasons"])
    early = answer(**{"looper.late": "-20deg"})
    assert early["loop_formed"] is False
    assert any("after the loop has opened" in str(reason) for reason in early["reasons"])


@pytest.mark.parametrize("margin", [-0.5, 0.5])
def test_the_loop_is_lost_at_the_end_of_its_window(margin: float) -> None:
    window = made().loop.window
    late = (window.shut - window.opened) / 2 + margin * deg
    assert answer(**{"looper.late": f"{late}rad"})["loop_formed"] is (margin < 0)


@pytest.mark.parametrize("pile", ["loop", "cut"])
def test_the_linkage_moves_the_hook_as_its_synthesis_says(pile: str) -> None:
    machine = made(pile=pile)
    forces, drive = machine.looper_forces, machine.looper
    motion, angle, needle = forces.moves.motion, forces.moves.angle, machine.params.needle
    tip = motion.point("looper rocker", "tip").position
    line = needle.shaft_distance + needle.needle_distance
    assert np.abs(drive.sense * (tip.real - line) - drive.ahead(angle)).max() < 1e-12
    assert drive.ahead(angle).max() == pytest.approx(machine.params.looper.reach, abs=1e-6)
    assert drive.ahead(angle).min() == pytest.approx(-machine.params.looper.retreat, abs=1e-6)
    at_line = np.interp(machine.loop.catch, angle, tip.imag)
    assert at_line - machine.lowest == pytest.approx(machine.loop.geometry.hook, abs=1e-6)
    assert np.abs(drive.ahead(np.array(drive.passing))).max() < 1e-9
    assert forces.forces.power_error < 1e-9


def test_the_needles_enter_and_leave_at_the_backing() -> None:
    """Depth by the paper's circles; force over depth by hand."""
    drive = made().needle
    lowest = min(needle_height(angle) for angle in np.linspace(0, turn, 7201))
    for angle in (drive.params.entry, drive.params.exit):
        assert needle_height(angle) - lowest == pytest.approx(made().loop.depth, abs=1e-8)
    state, given = drive.state, drive.params.penetration
    at = np.flatnonzero((state.angle > 60 * deg) & (state.angle < 61 * deg))[0]
    depth = made().loop.depth - (needle_height(float(state.angle[at])) - lowest)
    force = 3 + 5 * math.exp(-(depth - given.taper) / given.taper)
    assert abs(state.friction[at]) == pytest.approx(126 * force, rel=1e-6)


def test_a_crank_is_lengthened_where_the_stroke_is_too_short() -> None:
    machine = made(pile_height="16mm")
    assert machine.needle.stroke == pytest.approx(machine.loop.depth + machine.params.lift, rel=1e-6)
    assert machine.needle.params.crank > 15 * mm


def test_a_longer_needle_bar_span_bends_as_the_fourth_power() -> None:
    """A bar cut between its drives is a cantilever to both sides: y = q (p / 2)^4 / 8 E I."""
    machine = made(**{"needle.phase": "36deg"})
    bar, found = machine.params.needle_bar, machine.needle_bar
    rigidity = 70e9 * bar.thickness * bar.height**3 / 12
    assert found.deflection == pytest.approx(found.load * 0.2**4 / 8 / rigidity, rel=1e-9)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"gauge": "50mm", "width": "0.3m"}, "6 needles at gauge=50 mm"),
        ({"looper.arm": "15mm"}, "cannot reach its stroke"),
        ({"low_height": "12mm"}, "low_height=12 mm"),
        ({"needle.bars": "3"}, "needle.bars given"),
        ({"gauge": "0.1mm"}, "gauge"),
    ],
)
def test_bad_input_is_refused_in_one_sentence(settings: dict[str, str], words: str) -> None:
    with pytest.raises(ParameterError, match=words):
        made(**settings)


def test_what_the_machine_cannot_do_is_a_failed_check() -> None:
    def failed(**settings: str) -> str:
        return " ".join(check.name for check in MACHINE.report(made(**settings), illustrated=False).failed)

    assert "needle, hook and yarn beside each other" in failed(gauge="2mm")
    assert "travel of the backing while needles are in it" in failed(stitch_rate="200/m")
    assert "twist of a needle against its looper" in failed(**{"shafts.diameter": "20mm"})
    assert "deflection of the needle bar" in failed(drives="4")


def test_hooks_in_space_stand_beside_their_needles_at_the_height_of_the_loops() -> None:
    """Every needle of the tree has a hook beside it, a gap away, whose point passes it under the backing."""
    machine = made(drives="4", width="1m")
    tree = MACHINE.tree(machine)
    needles = next(
        one for one in tree.body("tufting-machine/needle-bar").occurrences if one.part.title == "tufting needle"
    )
    bar = tree.body("tufting-machine/needle-bar").positions[0]
    across = sorted(float(bar.after(place).origin[2]) for place in needles.positions)
    hooks = []
    for drive in range(4):
        body = tree.body(f"tufting-machine/looper-rocker {drive + 1}")
        held = next(one for one in body.occurrences if one.part.id == "tufting-machine/looper")
        hooks += [float(body.positions[0].after(place).origin[2]) for place in held.positions]
    assert len(hooks) == len(across) == machine.carpet.needles
    looper = machine.params.looper
    assert np.allclose(np.array(sorted(hooks)) - across, looper.needle / 2 + looper.gap)


def test_what_the_looper_moves_weighs_what_its_forces_count() -> None:
    machine = made()
    body = MACHINE.tree(machine).body("tufting-machine/looper-rocker 1")
    mass = sum(len(one.positions) * one.part.mass for one in body.occurrences)
    parts = machine.looper_forces.parts
    counted = sum(len(one.positions) * one.part.mass for one in parts.carried(0))
    linkage = parts.rocker.linkage
    rest = (linkage.plates["looper rocker"].mass, *(pin.mass for pin in linkage.pins.values()))
    assert mass - counted <= sum(rest) + 1e-9
    assert mass - counted >= rest[0] - 1e-9


def test_the_cyclogram_has_the_motion_of_the_linkages() -> None:
    """Between its points the spline is off the circles' height and the linkage's path by less than a micrometre."""
    machine = made()
    (stitch,) = MACHINE.cyclograms(machine)
    angle = np.random.default_rng(1).uniform(0, turn, 40)
    found = sample(stitch.track("needles"), np.sort(angle)).position
    lowest = min(needle_height(at) for at in np.linspace(0, turn, 7201))
    assert np.abs(found - [needle_height(at) - lowest for at in np.sort(angle)]).max() < 1e-6
    hooks = sample(stitch.track("loopers"), np.sort(angle)).position
    assert np.abs(hooks - machine.looper.ahead(np.sort(angle))).max() < 1e-6
    assert all(check.ok for check in check_cyclogram(stitch))
    (late,) = MACHINE.cyclograms(made(**{"looper.late": "60deg"}))
    assert not all(check.ok for check in check_cyclogram(late))


def numbers(**settings: str) -> dict[str, float]:
    """Pieces of the machine's parts by id."""
    counted: dict[str, float] = {}
    for line in tufting_price(made(**settings)).lines:
        counted[line.part] = counted.get(line.part, 0) + line.number
    return counted


SCROLLED = {"width": "1.2m", "drives": "3", "pattern.attachment": "scrolls", "pattern.colours": "3"}


def test_a_scroll_for_each_needle_stands_in_tiers_and_has_its_motor() -> None:
    report = MACHINE.report(made(**SCROLLED), illustrated=False)
    found = {result.name: result.value for result in report.results}
    assert not report.failed
    assert found["needles"] == found["yarn_rollers"] == 377
    assert found["assembly_clashes"] == 0
    assert found["assembly_groups"] == 1
    assert found["degrees_of_freedom"] == found["driven_axes"] == 377 + 3  # spiked rollers, main shaft
    parts = numbers(**SCROLLED)
    assert parts["tufting-machine/yarn-motor"] == parts["tufting-machine/yarn-roller"] == 377
    tiers = math.ceil((42.3 + 2) / 3.175)
    assert sum("scroll-plate" in part for part in parts) == tiers
    whole = 2 * 10.5 + 25.4 / 8  # yarn of a loop and its slanted back [mm]
    assert found["yarn_speed_max"] == pytest.approx(2 * whole * mm * 160 / 60, rel=1e-9)


def test_latches_have_the_time_near_the_highest_position_and_hang_on_their_bar() -> None:
    """The time by the paper's circles; the mass of a latch for each needle; two sides and tiers without a clash."""
    chosen = {**SCROLLED, "pattern.selection": "needles"}
    machine, plain = made(**chosen), made(**SCROLLED)
    assert machine.latches is not None
    assert plain.latches is None
    heights = np.array([needle_height(angle) for angle in np.linspace(0, turn, 7200, endpoint=False)])
    near = np.mean(heights.max() - heights <= 0.3 * mm) * 60 / 160
    assert machine.latches.window == pytest.approx(near, abs=2e-4)
    assert machine.needle_bar.mass - plain.needle_bar.mass == pytest.approx(377 * 0.009)  # a solenoid of 12 x 12 mm
    report = MACHINE.report(machine, illustrated=False)
    assert not report.failed
    assert numbers(**chosen)["tufting-machine/latch"] == 377
    quick = made(**chosen, **{"needle_bar.notch": "0.001mm"})
    assert [check.ok for check in quick.latches.checks] == [False, True, True]


def test_groups_of_needles_have_a_roller_each() -> None:
    settings = {"width": "1.2m", "drives": "3", "pattern.attachment": "groups", "pattern.groups": "3"}
    machine = made(**settings, low_height="5mm")
    report = MACHINE.report(machine, illustrated=False)
    assert not report.failed
    assert machine.feed.torques["yarn"] == pytest.approx(math.ceil(377 / 3) * 0.5 * 0.04)
    assert numbers(**settings)["tufting-machine/yarn-roller"] == 3


@pytest.mark.parametrize(
    ("settings", "check"),
    [
        ({"low_height": "5mm"}, "each yarn is fed as its loops need"),
        ({"pattern.colours": "3"}, "each yarn is fed as its loops need"),
        ({"pattern.colours": "9", "pattern.attachment": "scrolls"}, "colours on the creel"),
        ({"shift": "0.5"}, "needle, hook and yarn beside each other"),
    ],
)
def test_a_pattern_that_the_machine_cannot_make_is_a_failed_check(settings: dict[str, str], check: str) -> None:
    assert check in {str(one.name) for one in MACHINE.report(made(**settings), illustrated=False).failed}


def test_half_gauges_have_twice_the_loopers() -> None:
    coarse = {"width": "1.2m", "drives": "3", "gauge": "8mm"}
    assert numbers(**coarse)["tufting-machine/looper"] == 150
    assert numbers(**coarse, shift="0.5")["tufting-machine/looper"] == 299  # none beyond the last end
    half = MACHINE.report(made(**coarse, shift="0.5"), illustrated=False)
    assert not half.failed


def circles(pivot: complex, pin: complex, coupler: float, rocker: float) -> complex:
    """The joint of coupler and rocker on the clockwise side of pin -> pivot: two circles."""
    away = abs(pivot - pin)
    along = (away**2 + coupler**2 - rocker**2) / (2 * away)
    return pin + (pivot - pin) / away * (along - 1j * math.sqrt(coupler**2 - along**2))


def test_a_knife_passes_its_hook_as_circles_and_corners_put_it() -> None:
    """Both linkages by circles from their lengths and phases; the hook's under edge by its corners turned."""
    machine = made(pile="cut")
    knife, looper = machine.knife, machine.looper
    assert knife is not None
    params, angles = machine.params, np.linspace(0.0, turn, 361)

    def rockers(drive: RockerDrive, shaft: complex) -> np.ndarray:
        at, pivot, found = knife.hooks.crank_shaft, shaft, []
        for angle in angles:
            pin = at + drive.lengths["crank"] * np.exp(1j * (angle + drive.phase))
            found.append(np.angle(circles(pivot, pin, drive.lengths["coupler"], drive.lengths["rocker"]) - pivot))
        return np.unwrap(found)

    hooks = rockers(looper.rocker, knife.hooks.shaft)
    turned = hooks - (hooks.max() + hooks.min()) / 2
    swung = rockers(knife.drive, knife.moves.shaft)
    edge = knife.moves.shaft + knife.moves.tip * np.exp(1j * swung)
    low, back = params.looper.arm - params.looper.height, params.looper.reach + params.looper.retreat + 9 * mm
    corners = [knife.hooks.shaft + (x + 1j * low) * np.exp(1j * turned) for x in (-60 * mm, 60 * mm)]
    under = [np.interp(at.real, [a.real, b.real], [a.imag, b.imag]) for at, a, b in zip(edge, *corners, strict=True)]
    over = edge.imag - np.array(under)
    assert np.abs(over - knife.over).max() < 1e-8
    point = [knife.hooks.shaft + (x + 1j * params.looper.arm) * np.exp(1j * turned) for x in (0.0, back)]
    assert np.all(edge.real - point[0].real > params.knife.width / 2)
    assert np.all(point[1].real - edge.real > params.knife.width / 2)
    rising, yarn = np.gradient(over) > 0, machine.carpet.yarn_diameter
    cut = angles[rising & (over > -yarn) & (over < 0)]
    assert knife.cut_angle == pytest.approx([cut[0], cut[-1]], abs=1.5 * deg)


def test_knives_bear_the_cut_that_their_motor_gives() -> None:
    """The work of a cut is its force over the way that the edge takes in the yarn: half a newton more, as much more."""
    works = []
    for force in ("0N", "4N"):
        machine = made(pile="cut", **{"knife.force": force})
        forces = machine.knife_forces
        assert forces is not None
        works.append(float(np.trapezoid(forces.torque, forces.moves.angle)))
    knife = machine.knife
    assert knife is not None
    way = np.abs(np.diff(knife.edge[np.flatnonzero(knife.cutting)])).sum()
    hooks = machine.carpet.needles / machine.params.drives
    assert works[0] == pytest.approx(0, abs=1e-4)
    assert works[1] == pytest.approx(4 * hooks * way, rel=0.06)  # a sample on each end
    assert made().knife is None


@pytest.mark.parametrize(
    ("settings", "check"),
    [
        ({"knife.thickness": "1.5mm"}, "needle, hook and knife beside each other"),
        ({"knife.under": "50mm", "knife.depth": "120mm"}, "knife beside the hook's beak the whole turn"),
        ({"knife.under": "0.1mm"}, "knife under the next loop"),
        ({"knife.overlap": "3mm"}, "knife past the hook's under edge, below its upper one"),
    ],
)
def test_knives_that_have_no_room_are_a_failed_check(settings: dict[str, str], check: str) -> None:
    report = MACHINE.report(made(pile="cut", **settings), illustrated=False, assembled=False)
    assert check in {str(one.name) for one in report.failed}


@pytest.mark.parametrize("settings", [{"pile": "cut"}, {**SCROLLED, "pattern.selection": "needles"}])
def test_every_part_has_a_turkish_noun(settings: dict[str, str]) -> None:
    bodies = MACHINE.tree(made(**settings)).bodies
    titles = {str(one.part.title) for body in bodies for one in body.occurrences}
    assert [title for title in sorted(titles) if named(title) == title] == []

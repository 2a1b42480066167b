"""The public names: few, documented, forgiving towards what people type, and safe to compare and print."""

import dataclasses
import math
import re
import sys
import types
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
import pytest

import ilmek
from ilmek.machines.catalogue import MACHINES
from ilmek.params import Params
from ilmek.units import deg, mm, rpm

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "reference" / "python.md"
LONGEST = 300
"""Characters of a representation."""

FOUR_BAR = ilmek.four_bar(300 * mm, 60 * mm, 200 * mm, 230 * mm)
INERTIAS = {"crank": ilmek.bar(0, 60 * mm, mass=0.1), "rocker": ilmek.bar(0, 230 * mm, mass=0.4)}


def moving() -> ilmek.Motion:
    return ilmek.solve(FOUR_BAR, np.linspace(0, 6, 13), speed=10.0)


def too_long() -> ilmek.Mechanism:
    bodies = ilmek.Body("ground", {"A0": 0}), ilmek.Body("crank", {"A0": 0, "A": 60})
    return ilmek.Mechanism(bodies, [ilmek.Pin("A0", "ground", "crank")], [ilmek.Rotation("crank", "A0")])


def path_of_medallion() -> Path:
    return ROOT / "examples" / "medallion.png"


def cam() -> ilmek.PlateCam:
    lift = 40 * mm
    parts = ilmek.rise(100 * deg, lift), ilmek.dwell(80 * deg), ilmek.fall(100 * deg, lift), ilmek.dwell(80 * deg)
    return ilmek.plate_cam(ilmek.cam_programme(*parts), roller_radius=10 * mm)


def test_reference_page_lists_every_public_name_once() -> None:
    rows = re.findall(r"^\| `(\w+)` \| (.+) \|$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    assert sorted(name for name, _ in rows) == sorted(ilmek.__all__)
    assert all(len(meaning) > 10 for _, meaning in rows)


# what people type


@pytest.mark.parametrize(
    ("typed", "message"),
    [
        (lambda: ilmek.four_bar(300, 60, 200, 230), "300 m.*write 300 \\* mm"),
        (lambda: ilmek.slider_crank(60, 0.2), "60 m.*write 60 \\* mm"),
        (lambda: ilmek.four_bar("300", 0.06, 0.2, 0.23), "ground of a four-bar: 300 has no unit; write 300mm"),
        (lambda: ilmek.four_bar("300kg", 0.06, 0.2, 0.23), "ground of a four-bar: '300kg' has the wrong unit"),
        (lambda: ilmek.solve(FOUR_BAR, np.linspace(0, 360)), "360 rad.*degrees"),
        (lambda: ilmek.solve(FOUR_BAR, np.linspace(0, 360, 3600, endpoint=False)), "degrees"),
        (lambda: ilmek.solve(FOUR_BAR, np.arange(0, 360, 10)), "degrees"),
        (lambda: ilmek.solve(FOUR_BAR, 90), "90 rad.*degrees"),
        (lambda: ilmek.solve(FOUR_BAR, {"crank": np.linspace(0, 360)}), "degrees"),
        (lambda: ilmek.solve("press.toml", 0.0), "str given for a mechanism"),
        (lambda: ilmek.forward_dynamics(FOUR_BAR, INERTIAS, 1.0, position=90), "degrees"),
        (lambda: ilmek.rise(100, 40 * mm, "harmonic"), "write 100 \\* deg"),
        (lambda: ilmek.rise(100 * deg, 40, "harmonic"), "write 40 \\* mm"),
        (lambda: ilmek.rise(100 * deg, 40 * mm, "modified sine"), "'modified-sine'"),
        (lambda: ilmek.rise(100 * deg, ilmek.motion_law("harmonic"), 40 * mm), "the span, the lift and then the law"),
        (lambda: ilmek.fall("harmonic", 100 * deg, 40 * mm), "the span, the lift and then the law"),
        (lambda: ilmek.fall("100", 40 * mm, "harmonic"), "100 has no unit; write 100deg"),
        (lambda: ilmek.dwell(80), "write 80 \\* deg"),
        (lambda: ilmek.dwell(ilmek.motion_law("harmonic")), "law 'harmonic'"),
        (lambda: ilmek.crank_rocker(30), "write 30 \\* deg"),
        (lambda: ilmek.plate_cam(cam().programme, 50), "write 50 \\* mm"),
        (lambda: ilmek.plate_cam(cam().programme, 50 * mm, pressure_angle=30 * deg), "leave one"),
        (lambda: ilmek.motion_four_bars([0, 1, 2], [0, 1]), "one angle for each point"),
        (lambda: ilmek.motion_four_bars([0, 25, 30], [0.1, 0.2, 0.3]), "write 25 \\* mm"),
        (lambda: ilmek.four_bar(0.3, 0.06, 0.2, 0.23, points={"rockr": {"E": 0.3}}), "'rockr'.*did you mean 'rocker'"),
        (lambda: ilmek.four_bar(0.3, 0.06, 0.2, 0.23, points={"rocker": {"E": 300}}), "write 300 \\* mm"),
        (lambda: ilmek.slider_crank(0.06, 0.2, points={"slidr": {"E": 0.3}}), "did you mean 'slider'"),
        (lambda: ilmek.solve(too_long(), 0.5), "point 'A' of body 'crank' is 60 m.*write 60 \\* mm"),
        (lambda: ilmek.solve(FOUR_BAR, "90"), "90 has no unit; write 90deg"),
        (lambda: ilmek.Slide("line", "ram", "ground", along=90), "write 90 \\* deg"),
        (lambda: ilmek.bar(0, 200, mass=1), "write 200 \\* mm"),
        (lambda: ilmek.bar_mass(300, 30, 10, 7800), "write 300 \\* mm"),
        (lambda: ilmek.Gravity(9.81), "along x.*-9.81j"),
        (lambda: ilmek.OwnMachine(FOUR_BAR, gravity=9.81), "along x.*-9.81j"),
        (
            lambda: ilmek.inverse_dynamics(ilmek.solve(FOUR_BAR, 0.5), INERTIAS),
            "at rest and no load acts.*give solve a speed",
        ),
        (lambda: ilmek.inverse_dynamics(moving(), INERTIAS, ilmek.Gravity(-9.81j)), "write \\[loads\\]"),
        (lambda: ilmek.inverse_dynamics(moving(), {}, [ilmek.Torque("rockr", 1)]), "did you mean 'rocker'"),
        (lambda: ilmek.inverse_dynamics(moving(), {}, [ilmek.Torque("rocker", np.ones(5))]), "each of the 13 samples"),
        (lambda: ilmek.forward_dynamics(FOUR_BAR, INERTIAS, 1.0, drive=5.0), "a function of time, position and speed"),
        (lambda: ilmek.Mechanism((ilmek.Body("ground", {}),), ilmek.Pin("A", "a", "b"), ()), "write \\[joints\\]"),
        (lambda: ilmek.plate_cam(1), "programme of the cam is 1; CamProgramme"),
        (lambda: cam().programme.at(45), "45 rad.*degrees"),
        (lambda: cam().programme.at(np.linspace(0, 360, 721)), "360 rad.*degrees"),
        (lambda: cam().surface(np.arange(0, 360)), "degrees"),
        (lambda: cam().pressure_angle("45"), "45 has no unit; write 45deg"),
        (lambda: ilmek.path_four_bars(1000 * np.array(POINTS)), "write 1000 \\* mm"),
        (lambda: ilmek.path_four_bars(np.array([(0.0, 0.1)] * 12).T), "int64|float64\\[2x12\\].*N x 2; transpose it"),
        (lambda: ilmek.run_machine(FOUR_BAR, speed="10"), "10 has no unit; write 10rpm"),
        (lambda: ilmek.run_machine(FOUR_BAR, over=("0deg", "1m")), "'1m' has the wrong unit"),
        (lambda: ilmek.run_machine(FOUR_BAR, fixed={"rocker": 1.0}), "has no input 'rocker'"),
        (lambda: ilmek.make_chart(np.full((8, 8, 3), 0.5), "30x40cm", "10x10/dm"), "round\\(\\).astype"),
        (
            lambda: ilmek.make_chart(path_of_medallion(), "30x40cm", "10x10/dm", kind="photo"),
            "unknown parameter 'kind'",
        ),
        (lambda: ilmek.design("beat_up"), "did you mean beat-up"),
        (lambda: ilmek.design("beat-up", swing=30), "did you mean 30deg"),
        (lambda: ilmek.design("automated-loom", width=1200), "did you mean 1200mm"),
        (lambda: ilmek.design("automated-loom", knots_across=40), '4 knots per dm.*did you mean "40/dm"'),
        (lambda: ilmek.make_chart(3, "30x40cm", "10x10/dm"), "a int given for a picture"),
        (lambda: ilmek.make_chart(np.zeros((8, 8, 3)), "30x40cm", "10x10/dm"), "uint8"),
        (lambda: ilmek.make_chart(np.zeros((8, 8), np.uint8), "30x40cm", "10x10/dm"), "rows x columns x 3"),
        (lambda: ilmek.write_chart("chart.txt", chart()), "one of .png, .bmp, .tiff, .oxs, .wif, .pdf"),
    ],
)
def test_slip_is_caught_with_what_was_given_and_a_guess(typed: object, message: str) -> None:
    with pytest.raises(ilmek.IlmekError, match=message):
        typed()  # type: ignore[operator]


@pytest.mark.parametrize("angles", [0.0, 7.3, [0, 0.1], np.linspace(0, 20 * math.pi, 721), 1])
def test_angles_in_radians_pass(angles: object) -> None:
    assert len(ilmek.solve(FOUR_BAR, angles)) == np.size(angles)  # type: ignore[arg-type]


def test_numbers_of_a_run_are_radians_and_its_texts_have_units() -> None:
    numbers = ilmek.run_machine(FOUR_BAR, over=(0.0, 1.0), speed=12.5, steps=20).motion
    texts = ilmek.run_machine(FOUR_BAR, over="0rad..1rad", speed="12.5rad/s", steps=20).motion
    assert np.array_equal(numbers.drives["crank"].value, np.linspace(0, 1, 21))
    assert np.array_equal(numbers.omega("rocker"), texts.omega("rocker"))
    assert ilmek.run_machine(FOUR_BAR, fixed={"crank": 1.0}).motion.drives["crank"].value == 1.0
    turned = ilmek.run_machine(FOUR_BAR, over=("0deg", math.pi), speed=15.5 * rpm, steps=4).motion
    assert np.allclose(turned.drives["crank"].value, np.linspace(0, math.pi, 5))
    assert turned.drives["crank"].speed == pytest.approx(2 * math.pi * 15.5 / 60)


def test_points_are_complex_or_two_coordinates() -> None:
    built = [
        ilmek.four_bar(0.3, 0.06, 0.2, 0.23, points={"rocker": {"E": point}})
        for point in (0.3 + 0.05j, (0.3, 0.05), [0.3, 0.05], np.array([0.3, 0.05]), ("300mm", "50mm"))
    ]
    assert all(mechanism == built[0] for mechanism in built)
    assert ilmek.Inertia(1, (0.1, 0.2), 1).centre == 0.1 + 0.2j
    assert ilmek.Gravity((0, -9.81)) == ilmek.Gravity(-9.81j)


def test_forces_by_sample_are_complex_or_rows_of_two() -> None:
    motion, rows = moving(), np.column_stack((np.arange(13.0), -np.ones(13)))
    loads = [ilmek.PointForce("rocker.B", force) for force in (rows, rows[:, 0] + 1j * rows[:, 1])]
    first, second = (ilmek.inverse_dynamics(motion, INERTIAS, [load]).effort("crank") for load in loads)
    assert np.array_equal(first, second)


def test_a_law_is_a_name_or_a_law() -> None:
    law = ilmek.motion_law("modified-sine", constant_velocity=0.5)
    assert ilmek.rise(1.0, 0.04, law).law is law
    assert ilmek.rise(1.0, 0.04, "harmonic") == ilmek.rise(1.0, 0.04, ilmek.motion_law("harmonic"))
    assert ilmek.fall(1.0, 0.04, "harmonic").change == -0.04


def test_mechanism_file_is_solved_as_it_is() -> None:
    file = ilmek.read_mechanism(str(ROOT / "examples" / "jansen_leg.toml"))
    angles = np.linspace(0, 6, 7)
    again = ilmek.solve(file.mechanism, angles)
    assert np.array_equal(
        ilmek.solve(file, angles).angle(file.mechanism.moving[-1]), again.angle(again.plan.mechanism.moving[-1])
    )


def test_mechanism_is_written_and_read(tmp_path: Path) -> None:
    path = tmp_path / "four_bar.toml"
    ilmek.write_mechanism(str(path), FOUR_BAR, INERTIAS)
    assert ilmek.read_mechanism(path).mechanism == FOUR_BAR


def test_table_has_a_column_for_each_quantity_of_the_motion() -> None:
    motion = ilmek.solve(FOUR_BAR, np.linspace(0, 6, 13), speed=10.0)
    table = motion.table()
    assert {len(column) for column in table.values()} == {13}
    assert np.array_equal(table["crank [rad]"], np.linspace(0, 6, 13))
    assert np.array_equal(table["rocker angle [rad]"], motion.angle("rocker"))
    assert np.array_equal(table["coupler.B ay [m/s^2]"], motion.point("coupler", "B").acceleration.imag)


@pytest.mark.parametrize("library", ["pandas", "polars"])
def test_a_frame_is_the_table_by_the_library_that_is_there(library: str, monkeypatch: pytest.MonkeyPatch) -> None:
    motion = ilmek.solve(FOUR_BAR, np.linspace(0, 6, 13), speed=10.0)
    kept = {name: None for name in ("pandas", "polars") if name != library}
    for name, module in (kept | {library: types.SimpleNamespace(DataFrame=lambda table: (library, table))}).items():
        monkeypatch.setitem(sys.modules, name, module)
    made, table = motion.frame()
    assert made == library
    assert table.keys() == motion.table().keys()
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(ilmek.IlmekError, match="needs pandas or polars"):
        motion.frame()


def test_forces_balance_the_power() -> None:
    forces = ilmek.inverse_dynamics(ilmek.solve(FOUR_BAR, np.linspace(0, 6, 37), speed=10.0), INERTIAS)
    assert forces.power_error < 1e-9


def test_coasting_run_keeps_its_energy() -> None:
    run = ilmek.forward_dynamics(FOUR_BAR, INERTIAS, 1.0, speed=10.0)
    assert np.ptp(run.kinetic) < 1e-6 * run.kinetic[0]


def test_plate_cam_keeps_its_pressure_angle() -> None:
    assert ilmek.largest_pressure_angle(cam()).value == pytest.approx(30 * deg, abs=1e-6)
    assert ilmek.plate_cam(cam().programme, 70 * mm).prime_radius == 70 * mm


def test_crank_rocker_builds_a_four_bar() -> None:
    found = ilmek.crank_rocker(30 * deg, ground=300 * mm).best
    rocker = ilmek.solve(found, np.linspace(0, 2 * math.pi, 3601)).angle("rocker")
    assert np.ptp(rocker) == pytest.approx(30 * deg, abs=1e-6)


def test_four_bars_for_a_motion_take_the_poses() -> None:
    found = ilmek.motion_four_bars([0, (25 + 15j) * mm, (30 + 1j) * mm], [10 * deg, 3 * deg, -25 * deg])
    assert found
    assert max(solution.error for solution in found) < 1e-9


def test_four_bars_for_a_function() -> None:
    found = ilmek.function_four_bars(
        lambda x: np.sqrt(1 + x), 0, 3, 80 * deg, 60 * deg, crank_start=1, rocker_start=0.8
    )
    assert found.best.error == pytest.approx(0.8363 * deg, rel=1e-3)


POINTS = [0, 1 + 0.2j, 2 + 0.1j, 2.2 + 0.8j, 1.5 + 1.6j, 0.4 + 1.1j, 0.1 + 1.9j, 1.1 + 0.4j]


def test_path_search_ends_at_its_time_limit() -> None:
    (found,) = ilmek.path_four_bars(POINTS, time_limit=1e-9, count=1)
    assert found.details.search.starts == 384


def test_path_search_reports_and_is_cancelled() -> None:
    shares: list[float] = []
    ilmek.path_four_bars(POINTS, progress=ilmek.Progress(lambda _, share: shares.append(share)), time_limit=1e-9)
    assert shares == [0.0, 0.125]
    with pytest.raises(ilmek.Cancelled):
        ilmek.path_four_bars(POINTS, progress=ilmek.Progress(cancelled=lambda: True))


def test_path_search_needs_time() -> None:
    with pytest.raises(ilmek.IlmekError, match="time_limit 0 s"):
        ilmek.path_four_bars(POINTS, time_limit=0)


def chart() -> ilmek.Chart:
    return ilmek.make_chart(ROOT / "examples" / "medallion.png", "30x40cm", "10x10/dm", colours=4)


def test_chart_of_a_path_a_picture_and_its_pixels() -> None:
    path = ROOT / "examples" / "medallion.png"
    picture = ilmek.read_picture(str(path))
    charts = [
        ilmek.make_chart(one, "30x40cm", "10x10/dm", colours=4) for one in (str(path), path, picture, picture.rgb)
    ]
    assert all(np.array_equal(one.knots, charts[0].knots) for one in charts)


def test_chart_is_written_and_read(tmp_path: Path) -> None:
    made, path = chart(), str(tmp_path / "chart.png")
    ilmek.write_chart(path, made)
    assert np.array_equal(ilmek.read_chart(path).knots, made.knots)


def test_machine_is_designed_from_numbers_and_texts() -> None:
    report = ilmek.design("beat-up", {"beta": "48deg"}, swing=30 * deg)
    assert report["drive_torque_max"] > 0
    assert report.parameters["swing"] == 30 * deg
    assert set(ilmek.list_machines()) == set(MACHINES)
    for error in (KeyError, ilmek.IlmekError):
        with pytest.raises(error, match="beat-up has no result 'drive_torque'; did you mean 'drive_torque"):
            _ = report["drive_torque"]


def test_catalogue_is_a_mapping_that_names_the_nearest() -> None:
    assert "beat_up" not in MACHINES
    assert MACHINES.get("beat_up") is None
    with pytest.raises(KeyError, match="did you mean beat-up"):
        MACHINES["beat_up"]


def test_papers_are_reproduced() -> None:
    assert set(ilmek.reproduce("beat-up").verdicts) == {"beat-up"}


@pytest.mark.usefixtures("plain_page")
def test_carpet_is_woven(tmp_path: Path) -> None:
    woven = ilmek.weave(
        str(ROOT / "examples" / "medallion.png"), str(tmp_path / "out"), size="30x40cm", quality="10x10/dm", heads=1
    )
    assert woven.loomed.programme.heads == 1
    assert (tmp_path / "out" / "report.html").exists()


# records


def records(value: object, seen: dict[int, object]) -> Iterator[object]:
    """Every dataclass reachable from a value."""
    if isinstance(value, str | bytes | int | float | complex | type | np.ndarray | None) or id(value) in seen:
        return
    seen[id(value)] = value
    below: list[object] = []
    if isinstance(value, Mapping):
        below += value.values()
    elif isinstance(value, tuple | list | set | frozenset):
        below += value
    elif dataclasses.is_dataclass(value):
        yield value
        below += [getattr(value, one.name) for one in dataclasses.fields(value)]
    for one in below:
        yield from records(one, seen)


def check_records(*values: object) -> None:
    for one in records(values, {}):
        again = dataclasses.replace(one) if not isinstance(one, Params) else one  # type: ignore[type-var]
        assert one == one, type(one)  # noqa: PLR0124 - that it does not raise
        assert isinstance(one == again, bool), type(one)
        assert isinstance(hash(one), int)
        assert len(repr(one)) <= LONGEST, repr(one)


@pytest.mark.parametrize("name", sorted(MACHINES))
@pytest.mark.one_in(3)
def test_records_of_a_design_compare_and_print(name: str) -> None:
    machine = MACHINES[name]
    design = machine.design(machine.params.read({}))
    check_records(machine, design, machine.report(design))


def test_public_records_compare_and_print() -> None:
    motion = ilmek.solve(FOUR_BAR, np.linspace(0, 6, 13), speed=10.0)
    check_records(
        motion,
        motion.plan,
        ilmek.inverse_dynamics(motion, INERTIAS),
        ilmek.forward_dynamics(FOUR_BAR, INERTIAS, 0.1, speed=10.0),
        ilmek.read_mechanism(ROOT / "examples" / "jansen_leg.toml"),
        cam(),
        chart(),
        ilmek.read_picture(ROOT / "examples" / "medallion.png"),
        ilmek.path_four_bars(POINTS, time_limit=1e-9),
        ilmek.motion_four_bars([0, (25 + 15j) * mm, (30 + 1j) * mm], [10 * deg, 3 * deg, -25 * deg]),
        ilmek.Gravity(-9.81j),
        ilmek.PointForce("rocker.B", np.ones(3) + 0j),
        ilmek.Torque("rocker", np.ones(3)),
    )


def test_parameters_print_what_differs_from_the_defaults() -> None:
    params = MACHINES["beat-up"].params
    assert repr(params()) == "BeatUpParams()"
    assert repr(params(swing=0.4)) == "BeatUpParams(swing=0.4)"

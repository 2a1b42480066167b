"""`ilmek mechanism` on a file that is a machine: forces, strength, servo, study, forward run; what each output has."""

import csv
import dataclasses
import io
import json
import math
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result
from tests.support.mechanisms import CRANK_ROCKER, pushed_slider_crank, two_motors

from ilmek.cli import main
from ilmek.dynamics import own_forward
from ilmek.dynamics.inertia import Inertia, bar, point_mass
from ilmek.dynamics.inverse_run import inverse_run
from ilmek.dynamics.joint_friction import SlideFriction
from ilmek.dynamics.loads import PointForce
from ilmek.dynamics.motor_drive import MotorDrive
from ilmek.dynamics.own_machine import (
    ForwardTask,
    GivenMotion,
    NamedLoad,
    OwnMachine,
    SpeedStudy,
    StopEvent,
)
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import MechanismFile, parse_mechanism
from ilmek.jobs.mechanism.analysis import analysis
from ilmek.jobs.mechanism.report import report
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.linkage.fourbar import slider_crank
from ilmek.linkage.model import Body, Displacement, Mechanism, Pin, Rotation
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

EXAMPLES = Path(__file__).parents[2] / "examples"
MECHANISMS = [path for path in sorted(EXAMPLES.glob("*.toml")) if "[bodies" in path.read_text(encoding="utf-8")]

PRESS = """
name = "eccentric press"
servo = "crank"
gravity = "9.81m/s^2"
[bodies.ground]
points = { O = ["0mm", "0mm"], guide = ["0mm", "0mm"] }
[bodies.crank]
points = { O = ["0mm", "0mm"], A = ["25mm", "0mm"] }
section = { width = "70mm", thickness = "30mm", material = "heat-treatable steel" }
[bodies.rod]
length = "180mm"
between = ["A", "B"]
section = { width = "40mm", thickness = "16mm", material = "heat-treatable steel" }
[bodies.ram]
points = { B = ["0mm", "0mm"], guide = ["0mm", "0mm"], tool = ["0mm", "-120mm"] }
mass = "18kg"
[joints]
O = { pin = ["ground", "crank"] }
A = { pin = ["crank", "rod"] }
B = { pin = ["rod", "ram"] }
guide = { slide = ["ram", "ground"], along = "-90deg" }
[inputs]
O = "crank"
[branches]
B = 1
[loads]
cut = { force = "9kN", direction = "90deg", on = ["ram", "tool"], while = { from = "230deg", to = "262deg" } }
[friction]
A = { coefficient = 0.08, radius = "15mm" }
guide = { coefficient = 0.1, breadth = "120mm" }
[pins]
A = { diameter = "30mm", length = "30mm" }
B = { diameter = "24mm", length = "30mm" }
O = { diameter = "35mm", length = "17mm", bearing = "6207", life = "10000h" }
[motions]
O = "150rpm"
[study]
from = "100rpm"
to = "1000rpm"
count = 4
"""


def called(*arguments: str) -> Result:
    return CliRunner().invoke(main, ["mechanism", *arguments])


@pytest.fixture(scope="module")
def press(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("press") / "press.toml"
    path.write_text(PRESS, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def pressed(press: Path) -> dict:
    found = called(str(press), "--json", "-")
    assert found.exit_code == 0
    return json.loads(found.stdout)


def analysed(machine: OwnMachine, **request: str):
    return analysis(run(MechanismFile(machine), MotionRequest({}, **request)))


def test_the_names_at_the_top_are_those_in_the_results(pressed: dict) -> None:
    for name in ("closing_ranges", "pin_forces_max", "drive_torque_max", "power_residual"):
        assert pressed[name] == pressed["results"][name]
    assert pressed["closing_ranges"] == [[0.0, pytest.approx(2 * math.pi)]]
    assert set(pressed["pin_forces_max"]) == {"O", "A", "B"}
    assert pressed["results"]["closes"] == pressed["closing_ranges"]
    assert {test["name"] for test in pressed["self_tests"]} >= {"power_residual", "frame_residual", "link_residual"}


def test_the_work_of_the_drive_is_that_of_the_cut_and_of_friction(pressed: dict) -> None:
    """Height of the ram: 25 sin q - sqrt(180² - (25 cos q)²) mm."""
    height = [0.025 * math.sin(q) - math.sqrt(0.18**2 - (0.025 * math.cos(q)) ** 2) for q in np.radians([230, 262])]
    lost = pressed["results"]["friction_power_mean"] * 60 / 150
    assert pressed["results"]["drive_work"] == pytest.approx(9e3 * (height[0] - height[1]) + lost, rel=1e-3)


def test_histories_have_one_value_per_sample(pressed: dict) -> None:
    samples = len(pressed["values"])
    assert samples == 361 + 4  # two beside each jump of the cut
    assert len(pressed["forces"]["B"]["force"]) == len(pressed["slides"]["guide"]["velocity"]) == samples
    assert len(pressed["drives"]["crank"]) == len(pressed["shaking"]["force"]) == len(pressed["time"]) == samples
    assert max(map(abs, pressed["drives"]["crank"])) == pressed["drive_torque_max"]
    size = max(math.hypot(*force) for force in pressed["forces"]["B"]["force"])
    assert size == pytest.approx(pressed["pin_forces_max"]["B"])


def test_the_table_has_every_column_with_its_unit(press: Path) -> None:
    found = called(str(press), "--steps", "36", "--csv", "-")
    heading, *rows = csv.reader(io.StringIO(found.stdout))
    assert heading[0] == "crank [rad]"
    for column in (
        *("time [s]", "guide s [m]", "guide v [m/s]", "guide a [m/s^2]", "B transmission [rad]", "O Fx [N]"),
        *("guide couple [N*m]", "crank drive torque [N*m]", "shaking Fx [N]", "shaking moment [N*m]", "frame Fy [N]"),
    ):
        assert column in heading
    assert len(rows) == 37 + 4
    speed = np.array([float(row[heading.index("guide v [m/s]")]) for row in rows])
    place = np.array([float(row[heading.index("guide s [m]")]) for row in rows])
    time = np.array([float(row[heading.index("time [s]")]) for row in rows])
    assert np.trapezoid(speed, time) == pytest.approx(place[-1] - place[0], abs=1e-5)


def test_a_check_that_fails_ends_with_3_and_is_named_first(press: Path, tmp_path: Path) -> None:
    weak = tmp_path / "weak.toml"
    weak.write_text(PRESS.replace('diameter = "24mm", length = "30mm"', 'diameter = "12mm", length = "12mm"'), "utf-8")
    found = called(str(weak))
    assert found.exit_code == 3
    assert found.stdout.splitlines()[2].startswith("  pin B: pressure: 61.54 MPa, must be at most 15 MPa; a bush")


def test_a_pin_too_large_for_its_link_is_a_failed_check(tmp_path: Path) -> None:
    wide = tmp_path / "wide.toml"
    wide.write_text(PRESS.replace('B = { diameter = "24mm"', 'B = { diameter = "45mm"'), encoding="utf-8")
    found = called(str(wide))
    assert found.exit_code == 3
    assert "rod: hole of its pins: 45 mm, must be at most 30 mm; make rod wider than 60 mm" in found.stdout


def test_the_study_gives_the_greatest_admissible_speed(pressed: dict, press: Path) -> None:
    study = pressed["results"]["study"]
    assert [round(row["speed"] * 30 / math.pi) for row in study] == [100, 400, 700, 1000]
    limit = pressed["results"]["study_speed_max"] * 30 / math.pi
    assert study[1]["holds"]
    assert not study[2]["holds"]
    assert called(str(press), "--speed", f"{limit * 0.999}rpm").exit_code == 0
    beyond = called(str(press), "--speed", f"{limit * 1.001}rpm")
    assert beyond.exit_code == 3
    assert pressed["results"]["study_limited_by"] in beyond.stdout


def test_one_pose_has_its_forces(press: Path, pressed: dict) -> None:
    """At a speed those of the run; at rest those of weight and load, without friction."""
    found = json.loads(called(str(press), "--at", "90deg", "--speed", "150rpm", "--json", "-").stdout)
    k = int(np.argmin(np.abs(np.array(pressed["values"]) - math.pi / 2)))
    assert found["drives"]["crank"][0] == pytest.approx(pressed["drives"]["crank"][k], rel=1e-9)
    still = called(str(press), "--at", "90deg", "--json", "-")
    weight = json.loads(still.stdout)["forces"]["B"]["force"][0]
    assert weight == pytest.approx([0, 18 * 9.81], abs=1e-9)
    assert "friction of joints is left out" in still.stderr


def test_a_force_acts_on_the_second_body_of_a_pin_and_on_the_slide(press: Path) -> None:
    """At rest in the lower dead centre the ram hangs on the rod, and the crank on the ground: both are held upward."""
    found = json.loads(called(str(press), "--at", "270deg", "--json", "-").stdout)
    on_crank, on_ram = found["forces"]["O"]["force"][0], found["forces"]["B"]["force"][0]
    assert on_ram == pytest.approx([0, 18 * 9.81], abs=1e-9)
    assert on_crank[1] > 18 * 9.81
    assert found["frame"]["force"][0] == pytest.approx([0, -on_crank[1]], abs=1e-9)


@pytest.mark.parametrize("path", MECHANISMS, ids=lambda path: path.stem)
@pytest.mark.one_in(2)
def test_the_power_balance_holds_on_every_example(path: Path) -> None:
    over = ["--over", "-40deg..40deg"] if path.stem == "peaucellier" else []
    found = called(str(path), *over, "--speed", "60rpm", "--json", "-")
    data = json.loads(found.stdout)
    if data["power_residual"] is None:
        assert "motion only" in found.stderr
    else:
        assert data["power_residual"] <= 1e-9


def machine(**more: object) -> OwnMachine:
    inertias = {"crank": bar(0, 0.05, mass=1.0), "rod": bar(0, 0.2, mass=1.2), "slider": point_mass(5.0, 0j)}
    return OwnMachine(slider_crank(0.05, 0.2, branch=+1), inertias, **more)  # type: ignore[arg-type]


def test_a_motion_of_the_file_is_run_over_its_period() -> None:
    """q = 0.5 (1 - cos w t): at rest at both ends, the work over a period is none."""
    w = 6.0

    def law(t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return 0.5 * (1 - np.cos(w * t)), 0.5 * w * np.sin(w * t), 0.5 * w**2 * np.cos(w * t)

    found = analysed(machine(motions={"crank": GivenMotion(law, 2 * np.pi / w)}))
    assert found.run.by_time
    assert found.run.time is not None
    assert found.run.time[-1] == pytest.approx(2 * np.pi / w)
    assert found.run.forces is not None
    assert found.run.forces.drive_work == pytest.approx(0, abs=1e-9)
    made = report(found)
    assert made.figures[0].name == "mechanism"
    assert {figure.x.label for figure in made.figures if figure.name.startswith("forces")} == {"time"}


def test_a_sliding_input_has_a_force() -> None:
    mechanism = pushed_slider_crank()
    entry = mechanism.inputs[0]
    assert isinstance(entry, Displacement)
    inertias = {body: bar(0, 0.1, mass=2.0) for body in mechanism.moving}
    found = analysed(OwnMachine(mechanism, inertias, gravity=-9.81j), over="0.25m..0.35m")
    made = report(found)
    assert made["drive_torque_max"] is None
    assert made["drive_force_max"] > 0


def test_two_drives_share_the_work() -> None:
    """Both inputs move, one over a range, the other by its law: the balance of power holds for their sum."""
    mechanism = two_motors()
    first, second = mechanism.inputs
    assert isinstance(first, Rotation)
    inertias = {body: bar(0, 0.5, mass=1.0) for body in mechanism.moving}
    law = GivenMotion(lambda t: (0.3 + 2.0 * t, np.full_like(t, 2.0), np.zeros_like(t)), np.pi, (), 2.0)
    found = analysed(OwnMachine(mechanism, inertias, gravity=-9.81j, motions={second.name: law}), speed="1rad/s")
    forces = found.run.forces
    assert forces is not None
    assert forces.power_residual < 1e-12
    assert {table.name for table in report(found).tables} >= {"drives"}


def test_where_friction_locks_the_mechanism_a_check_fails() -> None:
    load = NamedLoad("push", PointForce("slider.B", -100 + 0j))
    found = analysed(machine(loads=(load,), frictions=(SlideFriction("line", 0.001, 30.0),)), speed="10rpm")
    check = next(one for one in found.checks if not one.ok)
    assert check.name == "not self-locking"
    assert "it locks at crank from" in check.source


REQUESTS = (MotionRequest({}, speed="60rpm"), MotionRequest({}))


def test_a_machine_that_does_not_close_over_its_turn_fails_a_check() -> None:
    """Half a turn of a double rocker's crank; without a speed the range is not required, and nothing fails."""
    text = """
links = { width = "20mm", thickness = "5mm", material = "structural steel" }
[bodies]
ground.points = { O = [0, 0], C = ["300mm", 0] }
crank.length = "200mm"
rod.length = "200mm"
rocker.length = "230mm"
[joints]
O.pin = ["ground", "crank"]
A.pin = ["crank", "rod"]
B.pin = ["rod", "rocker"]
C.pin = ["ground", "rocker"]
[inputs]
O = "crank"
[branches]
B = 1
"""
    file = parse_mechanism(text)
    required, free = ({check.name: check for check in analysis(run(file, request)).checks} for request in REQUESTS)
    check = required["closes over its range"]
    closed = 2 * np.radians(117.226) / (2 * np.pi)
    assert not check.ok
    assert check.value == pytest.approx(closed, abs=1e-4)
    assert "closes over its range" not in free


def test_a_study_needs_a_drive_of_constant_speed() -> None:
    law = GivenMotion(lambda t: (np.sin(t), np.cos(t), -np.sin(t)), 2 * np.pi)
    with pytest.raises(MechanismError, match="without one driving input of constant speed"):
        analysed(machine(motions={"crank": law}, study=SpeedStudy((1.0, 2.0))))


def test_a_forward_run_of_one_body_is_that_of_the_formula() -> None:
    """q = T t² / 2 J: the time and angle at a speed, and a stop at an angle after it."""
    crank = Mechanism(
        (Body("ground", {"O": 0}), Body("crank", {"O": 0})), (Pin("O", "ground", "crank"),), (Rotation("crank", "O"),)
    )
    torque, inertia, wheel = 3.0, 0.2, 0.1
    events = (StopEvent("fast", "speed", 4.0, terminal=False), StopEvent("there", "position", 5.0))
    task = ForwardTask(10.0, drive=MotorDrive(torque, inertia=wheel), events=events)
    found = analysed(OwnMachine(crank, {"crank": Inertia(1.0, 0j, inertia)}, forward=task)).forward
    assert found is not None
    rate = torque / (inertia + wheel)
    fast, there = found.forward_events
    assert (fast["time"], fast["position"]) == (pytest.approx(4 / rate), pytest.approx(8 / rate))
    assert (found.forward_end, there["time"]) == ("there", pytest.approx(math.sqrt(10 / rate)))
    assert found.forward_energy_residual < 1e-8
    assert found.effort_error < 1e-8
    assert found.forward_pin_forces_max["O"] == pytest.approx(0, abs=1e-9)


def test_doubling_the_speed_without_loads_multiplies_all_forces_by_four() -> None:
    """Inertia forces grow with the square of the speed: a law that no check of one speed sees."""
    base = machine()
    angle = np.linspace(0, 2 * np.pi, 50)
    slow, fast = (inverse_run(base, solve(plan(base.mechanism), angle, w), "crank", angle / w) for w in (3.0, 6.0))
    for name, force in slow.forces.reactions.items():
        np.testing.assert_allclose(fast.forces.reactions[name], 4 * force, atol=1e-12 * np.abs(force).max() * 4 + 1e-30)
    assert fast.shaking_force_max == pytest.approx(4 * slow.shaking_force_max)


def test_a_mechanism_without_masses_says_what_to_add() -> None:
    found = analysed(dataclasses.replace(machine(), inertias={}))
    made = report(found)
    assert made["pin_forces_max"] is None
    assert made.warnings == ("motion only: for forces give bodies a mass (mass, centre, moment), or the machine loads",)


FAST = f"""
{CRANK_ROCKER}[forward]
duration = "0.5s"
motor = {{ torque = "300N*m" }}
"""


def test_a_forward_run_beyond_its_steps_is_reported_as_far_as_it_came(tmp_path, monkeypatch):
    monkeypatch.setattr(own_forward, "MOST_STEPS", 400)
    path = tmp_path / "fast.toml"
    path.write_text(FAST, encoding="utf-8")
    result = CliRunner().invoke(main, ["mechanism", str(path), "--json", "-"])
    assert result.exit_code == 3
    data = json.loads(result.stdout)
    (check,) = [one for one in data["checks"] if not one["ok"]]
    assert check["name"] == "forward run: time reached"
    assert check["limit"] == 0.5
    assert 0 < check["value"] == data["results"]["forward_time"] == data["forward"]["time"][-1] < 0.5
    assert "400 steps of the integrator reached" in data["results"]["forward_end"]
    assert data["results"]["forward_turns"] > 1


def test_a_forward_run_into_the_end_of_its_range_is_a_failed_check():
    """The rocker drives: it swings down by its weight and stops where crank and coupler are in line."""
    text = (
        FAST.replace('{ A = "crank" }', '{ D = "rocker" }')
        .replace("C = 1", "B = 1")
        .replace('motor = { torque = "300N*m" }', "")
    )
    text = text.replace("[forward]", '[forward]\nposition = "60deg"').replace(
        "inputs", 'gravity = "9.81m/s^2"\ninputs', 1
    )
    found = analysis(
        run(MechanismFile(parse_mechanism(text, toml=True).machine), MotionRequest({"rocker": "60deg"}, "", ""))
    )
    assert found.forward is None  # a pose alone
    found = analysis(
        run(MechanismFile(parse_mechanism(text, toml=True).machine), MotionRequest({}, "40deg..70deg", ""))
    )
    assert found.forward is not None
    end = found.forward.run.end
    assert end.kind.early
    failed = {check.name: check.value for check in found.checks if not check.ok}
    assert failed == {"forward run: time reached": end.state.time}
    assert len(found.forward.run.time) > 2


BELT = """
inputs = { O = "motor" }
motions = { O = "60rpm" }
links = { width = "30mm", thickness = "8mm", material = "structural steel" }
[bodies]
ground.points = { O = [0, 0], Q = ["300mm", 0] }
motor.points = { O = [0, 0] }
wheel = { points = { Q = [0, 0], T = ["100mm", 0] } }
[joints]
O.pin = ["ground", "motor"]
Q.pin = ["ground", "wheel"]
[couplings]
chain = { belt = [["motor", "O"], ["wheel", "Q"]], ratio = 1, first_at = 0, second_at = 0 }
[loads]
work = { torque = "-12N*m", on = "wheel" }
[pins]
Q = { diameter = "12mm", length = "16mm" }
"""


def test_what_depends_on_the_tension_of_a_chain_is_named_and_all_else_is_computed():
    found = analysis(run(MechanismFile(parse_mechanism(BELT, toml=True).machine), MotionRequest({}, "", "")))
    results = report(found)
    assert results["drive_torque_max"] == pytest.approx(12.0)
    assert results["coupling_torques_max"] == pytest.approx({"chain": 12.0})
    assert results["undetermined"] == ["O", "Q", "chain"]
    assert "not determined without the tension of chain: the forces of O, Q" in found.warnings
    assert [check.name for check in found.checks if not check.ok] == ["pin Q: force is determined"]
    assert found.strength is not None
    assert not found.strength.pins
    forces = next(table for table in results.tables if table.name == "forces")
    assert {row[0]: row[2] for row in forces.rows} == dict.fromkeys(
        ("O (pin)", "Q (pin)", "chain (belt)"), "not determined"
    )


@pytest.mark.parametrize(
    ("angle", "press"),
    [("", 90.99255856655058), ('pressure_angle = "25deg", ', 116.57691453), ("pressure_angle = 0, ", 0.0)],
)
def test_a_rack_presses_on_its_guide_by_its_pressure_angle(angle, press):
    text = BELT.replace('[pins]\nQ = { diameter = "12mm", length = "16mm" }\n', "")
    text = text.replace('Q.pin = ["ground", "wheel"]', 'Q = { slide = ["wheel", "ground"] }')
    text = text.replace(
        'work = { torque = "-12N*m", on = "wheel" }', 'work = { force = ["-250N", 0], on = ["wheel", "Q"] }'
    )
    text = text.replace(
        'chain = { belt = [["motor", "O"], ["wheel", "Q"]], ratio = 1,',
        "mesh = { " + angle + 'rack = [["motor", "O"], ["wheel", "Q"]], ratio = "20mm/rad",',
    )
    forces = analysis(
        run(MechanismFile(parse_mechanism(text, toml=True).machine), MotionRequest({}, "", ""))
    ).run.forces
    assert forces is not None
    assert forces.slide_forces_max["Q"] == pytest.approx(press, rel=1e-8, abs=1e-9)  # 250 N tan alpha
    assert forces.pin_forces_max["O"] == pytest.approx(math.hypot(250.0, press), rel=1e-8)
    assert forces.drive_torque_max == pytest.approx(5.0)


def test_a_belt_has_no_pressure_angle():
    with pytest.raises(MechanismError, match="pressure_angle"):
        parse_mechanism(BELT.replace("ratio = 1,", 'ratio = 1, pressure_angle = "20deg",'), toml=True)

"""Machines of slides alone through the command and the studio: a servo feed, an XY stage."""

import csv
import json
import tomllib
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from ilmek.cams.laws import law_of
from ilmek.cli.mechanism import command
from ilmek.io.mechanism.motions import MotionSequence, MotionStep
from ilmek.io.mechanism_file import parse_mechanism
from ilmek.jobs.mechanism.analysis import analysis
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.linkage.quality import quality
from ilmek.jobs.studio.linkage.tasks import DraggedJoint, MechanismRequest, mechanism

FEED = """\
inputs = { S = "car" }
[bodies]
ground.points = { S = [0, 0] }
car = { points = { S = [0, 0], P = ["200mm", 0] }, mass = "6kg" }
[joints]
S = { slide = ["car", "ground"], along = "30deg" }
"""

STAGE = """\
inputs = { X = "saddle", Y = "table" }
motions = { X = "10mm/s", Y = "20mm/s" }
gravity = "10m/s^2"
[bodies]
ground.points = { X = [0, 0] }
saddle = { points = { X = [0, 0], Y = [0, 0] }, mass = "2kg" }
table = { points = { Y = [0, 0] }, mass = "3kg" }
[joints]
X = { slide = ["saddle", "ground"] }
Y = { slide = ["table", "saddle"], along = "90deg" }
"""

LOADS = '[loads]\nside = { force = ["100N", "20N"], on = "car.P" }\ndrag = { drag = "5N*s/m", on = "car.P" }\n'
FRICTION = '[friction]\nS = { coefficient = 0.1, breadth = "100mm", drag = "3N*s/m" }\n'
STEPS = '[motions.S]\nsteps = [{ to = "80mm", time = "0.3s" }, { dwell = "0.1s" }, { to = 0, time = "0.2s" }]\n'
SECTION = 'section = { width = "20mm", thickness = "8mm", material = "structural steel" }'
OVER = ("--over", "0mm..80mm")


@pytest.mark.parametrize(
    ("text", "options"),
    [
        (FEED, OVER),
        (FEED.replace(', mass = "6kg"', ""), OVER),
        (FEED, ("--at", "10mm")),
        (FEED + LOADS + FRICTION, (*OVER, "--speed", "0.2m/s")),
        (FEED + STEPS, ()),
        (FEED + '[study]\nspeeds = ["0.1m/s", "0.2m/s"]\n', OVER),
        (STAGE, OVER),
        (STAGE, ("--at", "X=10mm", "--at", "Y=2mm")),
        (STAGE, ("--at", "X=10mm", *OVER)),
    ],
)  # fmt: skip
def test_the_command_writes_every_product(tmp_path: Path, text: str, options: tuple[str, ...]) -> None:
    file = tmp_path / "machine.toml"
    file.write_text(text)
    page, table = tmp_path / "page.html", tmp_path / "table.csv"
    products = ("--json", str(tmp_path / "out.json"), "--report", str(page), "--csv", str(table))
    shown = CliRunner().invoke(command, [str(file), *options, *products])
    assert shown.exit_code == 0, shown.output
    assert json.loads((tmp_path / "out.json").read_text())["holds"]
    assert page.stat().st_size > 10_000
    heads, *rows = csv.reader(table.read_text().splitlines())
    assert np.isfinite(np.array(rows, dtype=float)).all()
    assert len(heads) == len(rows[0])


def test_a_rail_with_a_section_goes_to_the_workshop(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    file.write_text(FEED.replace('mass = "6kg"', SECTION) + STEPS)
    shown = CliRunner().invoke(command, [str(file), "--workshop", str(tmp_path / "made")])
    assert shown.exit_code == 0, shown.output
    assert "leave an error" not in shown.stderr  # every cam table follows the motion
    assert any(part.suffix == ".dxf" for part in (tmp_path / "made").iterdir())


def test_the_efforts_of_a_stage_are_those_by_hand() -> None:
    found = run(parse_mechanism(STAGE), MotionRequest({}, "0mm..80mm"))
    assert found.forces is not None
    efforts = found.forces.forces.efforts
    assert efforts["X"] == pytest.approx(np.zeros(361), abs=1e-12)
    assert efforts["Y"] == pytest.approx(np.full(361, 30.0))
    assert found.forces.slide_forces_max == pytest.approx({"X": 50.0, "Y": 0.0}, abs=1e-12)


def test_a_forward_run_on_a_slide_is_accelerated_uniformly() -> None:
    """20 N on 6 kg and 1 kg of the motor, against nothing: s = F t^2 / 2 m, with a start at 0.1 m/s."""
    task = '[forward]\nduration = "0.5s"\nspeed = "0.1m/s"\nmotor = { force = "20N", inertia = "1kg" }\n'
    forward = analysis(run(parse_mechanism(FEED + task), MotionRequest({}, "0mm..80mm"))).forward
    assert forward is not None
    end = forward.run.time[-1]
    assert end == pytest.approx(0.5)
    assert forward.run.position[-1] == pytest.approx(0.1 * end + 20 / 7 * end**2 / 2, rel=1e-6)
    assert forward.run.speed[-1] == pytest.approx(0.1 + 20 / 7 * end, rel=1e-6)


@pytest.mark.parametrize(("text", "over"), [(FEED + LOADS, "0mm..80mm"), (FEED + STEPS, ""), (STAGE, "0mm..80mm")])
def test_the_studio_shows_it_with_forces(text: str, over: str) -> None:
    request = MechanismRequest(tomllib.loads(text), over=over, rates=True, forces=True)
    answer = mechanism(request, Context())
    assert answer.structure.missing is None
    assert {group.kind for group in answer.structure.groups} == {"input"}
    assert answer.motion is not None
    assert answer.motion.forces is not None
    assert set(answer.motion.status) == {0}
    judged = quality(request, Context())
    assert judged.fault is None
    assert judged.checks
    assert all(check["ok"] for check in judged.checks)


def test_in_the_studio_a_slide_without_a_range_and_a_dragged_one_are_shown() -> None:
    data = tomllib.loads(FEED)
    answer = mechanism(MechanismRequest(data), Context())
    assert answer.motion is not None
    moved = mechanism(MechanismRequest(data, drag=DraggedJoint("S", 0.01, 0.02)), Context())
    assert moved.refused is None
    assert moved.changes


def test_between_the_steps_of_a_motion_there_is_no_gap() -> None:
    """0.4 - 0.1 is later than 0.3 by a rounding: the dwell begins where the step before it ends."""
    law = law_of("3-4-5")
    motion = MotionSequence(
        0.0, (MotionStep(0.08, 0.3, law), MotionStep(0.08, 0.1, law), MotionStep(0.0, 0.2, law)), False
    )
    value, speed, _ = motion(np.array([0.3, np.nextafter(0.3, 1), 0.35, np.nextafter(0.4, 0)]))
    assert value == pytest.approx(np.full(4, 0.08))
    assert speed == pytest.approx(np.zeros(4), abs=1e-12)

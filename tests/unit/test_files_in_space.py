"""`--step`, `--pose` and `--mjcf` of `ilmek design`: what is written, and what is refused."""

import importlib.util
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from click.testing import CliRunner, Result

from ilmek.cli import main

_STEP = pytest.mark.skipif(importlib.util.find_spec("OCP") is None, reason="the extra step is not installed")

_UNDERCUT = ("law=harmonic", "lift=40mm", "rise=30deg", "prime_radius=12mm", "roller_radius=11.5mm")


def _run(*arguments: str) -> Result:
    return CliRunner().invoke(main, ["design", *arguments])


@_STEP
def test_both_files_are_written_and_named(tmp_path: Path) -> None:
    model, solids = tmp_path / "needles.xml", tmp_path / "needles.step"
    ran = _run("tufting", "--mjcf", str(model), "--step", str(solids), "--pose", "turn=90deg")
    assert ran.exit_code == 0
    assert f"assembly: {solids}\nmodel for MuJoCo: {model}\n" in ran.stdout
    root = ET.parse(model).getroot()
    assert [servo.get("joint") for servo in root.iter("position")] == ["tufting/main-shaft"]
    assert [pin.get("body2") for pin in root.iter("connect")] == ["tufting/rocker", "tufting/rod"]
    assert b"AP242" in solids.read_bytes()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--mjcf", "needles.stl"), "--mjcf needles.stl ends in '.stl'; .xml or .mjcf"),
        (("--step", "needles.glb"), "--step needles.glb ends in '.glb'; .step or .stp"),
        (("--pose", "turn=90deg"), "--pose needs --step FILE"),
        (("--step", "a.step", "--pose", "row=90deg"), "pose 'row=90deg'; turn=ANGLE"),
        (("--step", "a.step", "--pose", "turn=9mm"), "'9mm' has the wrong unit"),
    ],
)
def test_what_cannot_be_written_is_refused(
    arguments: tuple[str, ...], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    ran = _run("tufting", *arguments)
    assert ran.exit_code == 2
    assert said in ran.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_cam_that_undercut_leaves_nothing_of_has_no_file_and_a_note(tmp_path: Path) -> None:
    model = tmp_path / "none.xml"
    ran = _run("cam", *_UNDERCUT, "--mjcf", str(model))
    assert ran.exit_code == 3
    assert f"{model} was not written: there are no parts" in ran.stderr
    assert not model.exists()

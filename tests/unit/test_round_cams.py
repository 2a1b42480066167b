"""Barrel and end cams for the workshop: the flanks on cylinders, the development, the solid as it is read back."""

import json
import math
from pathlib import Path
from typing import Literal

import numpy as np
import pytest

from ilmek.cams.barrel import Barrel
from ilmek.io.dxf import read_dxf, write_dxf
from ilmek.jobs.workshop import write_workshop
from ilmek.machines.cam import MACHINE, CamDesign
from ilmek.machines.cam.developed_cams import axial_ends
from ilmek.machines.cam.round_cams import developed, flank_on_cylinder, solid

TURN = math.tau
SETTINGS = {"barrel": {}, "face": {"preload": "200N", "spring_rate": "5N/mm"}}


def made(kind: str, **more: str) -> CamDesign:
    design: CamDesign = MACHINE.design(MACHINE.params.read({"kind": kind} | SETTINGS[kind] | more))
    return design


@pytest.mark.parametrize("side", [-1, 1])
def test_a_flank_on_a_cylinder_is_on_it_and_touches_the_roller(side: Literal[1, -1]) -> None:
    cam = made("barrel").cam
    assert isinstance(cam, Barrel)
    angle = np.linspace(0.0, TURN, 40)
    points = flank_on_cylinder(cam, angle, 0.04, side)
    assert np.hypot(points[:, 0], points[:, 1]) == pytest.approx(0.04, rel=1e-12)
    turned = (points[:, 0] + 1j * points[:, 1]) * np.exp(1j * angle)
    centre = np.asarray(cam.roller_motion(cam.programme.at(angle))[0])
    apart = np.hypot(points[:, 2] - centre.real, turned.imag - centre.imag)
    assert apart == pytest.approx(cam.roller_radius, rel=1e-9)


def test_the_development_is_seen_from_outside() -> None:
    """A point at x of the sheet lies at the angle x / R of the cam, counter-clockwise; the ends of the sheet meet."""
    cam = made("barrel", rise="120deg").cam
    assert isinstance(cam, Barrel)
    line = developed(cam, 0.04, -1)
    assert line[0].real == 0.0
    assert line[-1].real == pytest.approx(TURN * 0.04)
    assert line[0].imag == pytest.approx(line[-1].imag, abs=1e-12)
    assert np.all(np.diff(line.real) > 0)
    point = flank_on_cylinder(cam, np.array([1.3]), 0.04, -1)[0]
    at = math.atan2(point[1], point[0]) % TURN
    assert np.interp(at * 0.04, line.real, line.imag) == pytest.approx(point[2], abs=1e-7)


def test_the_volume_of_a_groove_without_lift_is_that_of_a_ring() -> None:
    """With next to no lift the groove is a ring between two planes, its flanks at the roller's radius."""
    design = made("barrel", lift="10um", prime_radius="40mm")
    cam, (low, high) = design.cam, axial_ends(design)
    assert isinstance(cam, Barrel)
    inner, outer = cam.depths
    part = solid(design, (low, high))
    assert part.bore is not None
    ring = math.pi * (outer**2 - inner**2) * 2 * cam.roller_radius
    bored = design.hub.area * (high - low)
    assert part.volume == pytest.approx(math.pi * outer**2 * (high - low) - bored - ring, rel=1e-5)


def test_the_mass_of_an_end_cam_is_that_of_its_solid() -> None:
    """The contact moves on as the follower rises: the mean height over the cam angle would be off by 3 %."""
    design = made("face")
    part = solid(design, axial_ends(design))
    mass = MACHINE.report(design)["mass"]
    assert mass == pytest.approx(7850 * part.volume, rel=2e-3)


def test_flanks_and_cutter_path_are_in_the_drawing(tmp_path: Path) -> None:
    (plate,) = MACHINE.plates(made("barrel"))
    write_dxf(tmp_path / "cam.dxf", plate)
    facts = read_dxf(tmp_path / "cam.dxf")
    assert facts.errors == 0
    assert plate.area is not None
    assert facts.area == pytest.approx(plate.area, rel=1e-6)
    text = (tmp_path / "cam.dxf").read_text(encoding="utf-8")
    assert text.count("GROOVE\n") >= 3
    assert "seen from outside" in text


@pytest.mark.parametrize("kind", ["barrel", "face"])
def test_the_solid_read_back_has_the_volume_of_the_flanks(
    kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("OCP")
    monkeypatch.setattr("ilmek.machines.cam.round_cams.ANGLES", 91)
    write_workshop(MACHINE.report(made(kind)), tmp_path / "parts")
    index = json.loads((tmp_path / "parts" / "workshop.json").read_text(encoding="utf-8"))
    (step,) = (entry for entry in index["files"] if entry["kind"] == "step")
    assert step["volume_error"] < 1e-4

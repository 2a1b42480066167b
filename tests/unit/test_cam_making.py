"""How cams are cut, as their sheets state it: judged by waves in time, and by distances of points alone."""

import math
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from matplotlib.path import Path as Path2D

from ilmek.cams.loaded_plate_cam import MODULUS, PRESSURE_LIMIT
from ilmek.cams.profile_tolerance import BAND, increment_tolerance
from ilmek.jobs.design import design_machine
from ilmek.jobs.workshop_order import WorkshopOrder
from ilmek.machines.catalogue import find_machine
from ilmek.machines.making_checks import making_checks
from ilmek.part.shapes import Prism
from ilmek.part.specification import specification
from ilmek.part.tolerances import Characteristic, FeatureKind
from ilmek.part.tolerancing import tolerances_of
from ilmek.units import deg, mm, um


@pytest.mark.parametrize(("spare", "speed"), [(40.0, 12.5), (5.0, 3.14), (2.0, 6.0)])
def test_errors_whose_changes_are_within_the_tolerance_add_no_more_than_is_spare(spare: float, speed: float) -> None:
    """Waves of whole degrees at all phases, as high as the change from degree to degree lets them be."""
    increment = increment_tolerance(spare, speed, deg)
    degrees, time = np.arange(0, 361), np.linspace(0.0, 20 * deg / speed, 40_001)

    def added(change: float, half: int, phase: float) -> float:
        height = change / np.abs(np.diff(np.cos(np.pi * degrees / half + phase))).max()
        wave = height * np.cos(np.pi * speed * time / (half * deg) + phase)
        return float(np.abs(np.diff(wave, 2) / (time[1] - time[0]) ** 2).max())

    assert added(increment, 1, 0.0) <= spare < added(increment + 1 * um, 1, 0.0)
    longer = [added(increment, half, phase) for half in range(2, 20) for phase in np.linspace(0.0, np.pi, 19)]
    assert max(longer) < 0.6 * spare
    assert increment_tolerance(math.inf, speed, deg) == increment_tolerance(1e9, speed, deg) == pytest.approx(BAND)


def test_a_cam_that_cannot_be_ground_as_its_follower_needs_is_a_failed_check() -> None:
    machine = find_machine("weaver")
    assert machine.tree is not None
    for force, ok in (("5N", True), ("0.5N", False)):
        tree = machine.tree(machine.design(machine.params.read({"contact_force": force})))
        (check,) = (one for one in making_checks(tree) if one.unit == "um")
        assert check.ok is ok, (force, check)


def test_the_follower_of_a_head_stays_on_its_cam_with_errors_within_the_tolerance() -> None:
    machine = find_machine("weaver")
    for cam in machine.design(machine.params.read({})).cams:
        spare, mass = cam.spare_acceleration, np.where(cam.motion.ds >= 0, *cam.mass_moved)
        assert 0 < spare < 100
        lightest, heaviest = cam.force - mass * spare, cam.force + mass * spare
        curvature = 1 / cam.cam.roller_radius + cam.trace.surface_curvature
        on_width = np.abs(heaviest) / np.cos(cam.trace.pressure_angle) / cam.thickness
        hertz = np.sqrt(on_width * MODULUS * curvature / math.pi)  # p² = F' E* k / pi
        reserve = min(lightest.min() / np.abs(cam.force).max(), 1 - (hertz / PRESSURE_LIMIT).max() ** 2)
        assert reserve == pytest.approx(0, abs=1e-9)


def test_the_largest_cutter_fits_all_hollows_and_a_larger_one_cuts_into_the_cam() -> None:
    machine = find_machine("weaver")
    for cam in machine.design(machine.params.read({})).cams:
        largest = cam.concave_radius + cam.cam.roller_radius
        surface = cam.trace.surface[::4]
        for cutter, kept in ((0.98 * largest, True), (1.05 * largest, False)):
            path = cam.trace.parallel(cutter - cam.cam.roller_radius)[::4]
            nearest = np.array([np.abs(surface - centre).min() for centre in path])
            assert bool(nearest.min() > cutter - 1 * um) is kept


def test_the_sheets_of_a_cam_state_circles_turn_tolerance_and_cutter(tmp_path: Path) -> None:
    pytest.importorskip("OCP")
    design_machine("cam", {"cutter_radius": "20mm"}, WorkshopOrder(tmp_path / "parts"), illustrated=False)
    sheet = ezdxf.readfile(tmp_path / "parts" / "cam.sheet.dxf")
    machine = find_machine("cam")
    design = machine.design(machine.params.read({"cutter_radius": "20mm"}))
    circles = {
        entity.dxf.text.partition(" ⌀")[0]: entity.dxf.actual_measurement
        for entity in sheet.modelspace().query("DIMENSION")
        if "circle" in entity.dxf.text
    }
    prime, roller = design.cam.prime_radius / mm, design.cam.roller_radius / mm
    exact = {"prime circle": 2 * prime, "base circle": 2 * (prime - roller)}
    assert circles == pytest.approx(exact, abs=3e-3)  # contours are within 1 um, radii in the table to 1 um
    words = [text.dxf.text for text in sheet.modelspace().query("TEXT")]
    assert "turns" in words
    assert any(text.startswith("0°: zero mark") for text in words)
    assert any(text.startswith("r(θ) ±0.05") for text in words)
    second = ezdxf.readfile(tmp_path / "parts" / "cam.sheet-2.dxf")
    heads = [text.dxf.text for text in second.modelspace().query("TEXT")]
    assert [heads.count(name) for name in ("profile", "roller", "cutter")] == [8, 8, 8]
    document = ezdxf.readfile(tmp_path / "parts" / "cam.dxf")
    assert len(document.modelspace().query("LWPOLYLINE[layer=='CUTTER_PATH']")) == 1


def test_the_faces_of_every_cam_run_true_to_its_bore() -> None:
    """Both faces have a run-out from the bore's datum; the point where it is stated lies on the plate."""
    machine = find_machine("weaver")
    assert machine.tree is not None
    tree = machine.tree(machine.design(machine.params.read({})))
    cams = [part for part, _ in tree.occurrences() if part.cam is not None and isinstance(part.shape, Prism)]
    assert len(cams) >= 5
    for part in cams:
        features = tolerances_of(tree)[part.id]
        (datum,) = {own.datum for own in features if own.datum}
        faces = [own for own in features if own.kind is FeatureKind.FACE]
        assert sorted(own.position.origin[2] for own in faces) == [0.0, part.shape.length]
        for face in faces:
            (limit,) = face.geometric
            assert (limit.characteristic, limit.datums) == (Characteristic.RUN_OUT, (datum,))
            assert 0.01 * mm < limit.value < 0.1 * mm
            section = part.shape.section
            outline, *holes = (Path2D(np.column_stack([own.points.real, own.points.imag])) for own in section.contours)
            point = face.position.origin[:2]
            assert outline.contains_point(point)
            assert not any(hole.contains_point(point) for hole in holes)


@pytest.mark.parametrize("name", ["shedding", "weaver", "hammer"])
def test_edges_on_which_yarns_run_are_rounded_and_leave_a_face(name: str) -> None:
    machine = find_machine(name)
    assert machine.tree is not None
    tree = machine.tree(machine.design(machine.params.read({})))
    touching = [part for part, _ in tree.occurrences() if part.yarns]
    assert touching
    for part in touching:
        assert part.shape is not None
        thin = np.ptp(np.concatenate(part.shape.pieces(0.1 * mm)), axis=0).min()
        assert 0.05 * mm <= specification(part).yarn_edge < thin / 2

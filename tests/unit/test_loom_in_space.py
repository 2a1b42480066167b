"""The loom in space: masses of the parts list, the side view's coordinates, and the cyclograms' motions."""

import math
from functools import cache

import numpy as np
import pytest

from ilmek.elements.columns import STEEL
from ilmek.machines.automated_loom import MACHINE
from ilmek.machines.automated_loom.bodies import beat_displacement
from ilmek.machines.automated_loom.cyclogram import EVEN, HEADS
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.scene import scene
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.plane.contours import area
from ilmek.plane.solids import bounds, is_closed, plate_solid, volume
from ilmek.report import Contour
from ilmek.report.scene import Scene, SceneFrame, ScenePart
from ilmek.timing.track import sample


@cache
def _made(*settings: tuple[str, str]) -> tuple[LoomDesign, Scene]:
    loom = MACHINE.designed(MACHINE.params.read(dict(settings)))
    return loom, scene(loom, MACHINE.report(loom))


def _part(found: Scene, name: str) -> ScenePart:
    return next(one for one in found.parts if one.name == name)


def _frame(found: Scene, name: str) -> SceneFrame:
    return next(one for one in found.frames if one.name == name)


def _turned(points: np.ndarray, rotation: float) -> np.ndarray:
    """Points of the side view, turned about x: from up to the front."""
    return points * np.exp(-1j * rotation)


@pytest.mark.parametrize(
    "settings", [(), (("width", "0.3 m"), ("length", "0.4 m"), ("beat", "linkage"), ("weft", "rapier"))]
)
def test_every_solid_is_closed_and_stands_in_a_frame_of_the_scene(settings: tuple[tuple[str, str], ...]) -> None:
    _, found = _made(*settings)
    names = {frame.name for frame in found.frames} | {""}
    assert len(names) == len(found.frames) + 1
    assert {frame.parent for frame in found.frames} <= names
    assert len({part.name for part in found.parts}) == len(found.parts)
    for part in found.parts:
        assert part.frame in names
        assert all(is_closed(one) and volume(one) > 0 for one in part.solids), part.name


def test_the_frames_members_weigh_what_the_parts_list_states() -> None:
    loom, found = _made()
    members = [_part(found, f"automated-loom/{name}") for name in ("column", "beam", "foot", "rail")]
    mass = sum(volume(part.solids[0]) * part.number for part in members) * STEEL.density
    assert mass == pytest.approx(parts_of_loom(loom).frame.mass, rel=1e-9)
    assert mass == pytest.approx(sum(part.mass * part.number for part in members), rel=1e-9)
    shaft = _part(found, "shedding/cam-shaft")
    assert volume(shaft.solids[0]) * STEEL.density == pytest.approx(shaft.mass, rel=1e-9)


def test_every_plate_of_the_loom_has_the_volume_of_its_drawing() -> None:
    loom, found = _made()
    plates = {one.name: one for one in MACHINE.report(loom).all_plates}
    drawn = [part for part in found.parts if part.plate]
    assert {part.plate for part in drawn} == set(plates)
    for part in drawn:
        plate = plates[part.plate]
        solid = plate_solid(plate, 0.0, 1e-6)
        cut = math.fsum(math.pi * hole.radius**2 for hole in plate.holes)
        cut += math.fsum(abs(_area(one)) for one in plate.cutouts)
        exact = (abs(_area(plate.outline)) - cut) * plate.thickness
        assert is_closed(solid)
        assert volume(solid) == pytest.approx(exact, rel=2e-4)


def _area(line: np.ndarray | Contour) -> float:
    if isinstance(line, Contour):
        return area(line)
    return float(np.sum((np.conj(line) * np.roll(line, -1)).imag)) / 2


def test_boxes_and_rollers_have_the_coordinates_of_the_side_view() -> None:
    loom, found = _made()
    side = loom.side
    column = _part(found, "automated-loom/column")
    lower, upper = bounds(column.solids[0])
    origin = _frame(found, column.frame).origins[0]
    assert np.allclose([lower[1] + origin[1], upper[1] + origin[1]], [side.floor, side.top], atol=1e-9)
    assert origin[2] + (lower[2] + upper[2]) / 2 == pytest.approx(side.column, abs=1e-9)
    for name, roller in (("upper", side.upper), ("lower", side.lower)):
        at = _frame(found, f"warp-tension/{name} cylinder").origins[0]
        assert complex(at[2], at[1]) == pytest.approx(roller.at, abs=1e-9)
        shell = _part(found, f"warp-tension/cylinder of warp-tension/{name} cylinder")
        assert bounds(shell.solids[0])[1][2] == pytest.approx(roller.radius, abs=3e-4)
    drawn = {"opener": "weaver/opener-plate", "sley": "weaver/sley", "centre gripper": "weaver/centre-gripper"}
    for tool in side.head.tools:
        if tool.name in drawn:
            low, high = _in_head(found, _part(found, drawn[tool.name]))
            assert complex(low[2], low[1]) == pytest.approx(tool.corner, abs=1e-9)
            assert complex(high[2], high[1]) == pytest.approx(tool.corner + tool.size, abs=1e-9)


def _in_head(found: Scene, part: ScenePart) -> tuple[np.ndarray, np.ndarray]:
    """Least and greatest coordinates of a part in the head's frame, of the last where it is there several times."""
    low, high = bounds(part.solids[0])
    frame = part.frame
    while frame != found.heads:
        origin = _frame(found, frame).origins[-1]
        low, high, frame = low + origin, high + origin, _frame(found, frame).parent
    return low, high


def test_motions_are_those_of_the_cyclograms() -> None:
    loom, found = _made()
    row = loom.row_cyclogram
    rail = _frame(found, "heads' rail").motion
    assert rail is not None
    assert np.allclose(rail.shift[:, 2], sample(row.track(HEADS), rail.angle).position, atol=1e-9)
    beater = _frame(found, "beater").motion
    assert beater is not None
    expected = beat_displacement(loom.beat.path, row)(beater.angle) + loom.beat.path.tip[0]
    assert np.allclose(beater.shift[:, 2] + 1j * beater.shift[:, 1], expected, atol=1e-9)


def test_a_cam_lifts_its_warp_as_the_cyclogram_states() -> None:
    loom, found = _made()
    cam, turned = loom.shedding.cam, _frame(found, "shedding/cam shaft").motion
    even = _frame(found, "shedding/cam shaft: shedding/shedding-cam")
    assert turned is not None
    assert even.phases is not None
    lift = sample(loom.row_cyclogram.track(EVEN), turned.angle).position
    assert _frame(found, "shedding/cam shaft").axis == pytest.approx((-1.0, 0.0, 0.0))  # to the weaver's left
    for rotation, lifted in zip(-turned.rotation[::7], lift[::7], strict=True):
        angle = -np.linspace(-0.02, 0.02, 2001) - rotation
        outline = _turned(cam.surface(angle), rotation)  # of an even cam: its phase is 0
        at = np.interp(0.0, outline.imag[np.argsort(outline.imag)], outline.real[np.argsort(outline.imag)])
        assert at == pytest.approx(cam.prime_radius + lifted, abs=1e-6)
    assert sorted(set(np.round(np.abs(even.phases), 9))) == pytest.approx([0.0, math.pi])


def test_the_links_of_the_beat_up_stay_joined_and_carry_the_beater() -> None:
    loom, found = _made()
    one = loom.beat.design
    crank, coupler, rocker, beater = (_frame(found, name) for name in ("crank", "coupler", "rocker", "beater"))
    for index in range(0, len(crank.motion.angle), 97):  # type: ignore[union-attr]

        def turned(frame: SceneFrame, point: complex, index: int = index) -> complex:
            assert frame.motion is not None
            phase = 0.0 if frame.phases is None else frame.phases[0]
            at = complex(frame.origins[0][2], frame.origins[0][1])
            return complex(at + _turned(np.array(point), phase + frame.motion.rotation[index]))

        pin = turned(crank, turned(coupler, complex(one.lengths["coupler"])))
        assert pin == pytest.approx(turned(rocker, complex(one.lengths["rocker"])), abs=2e-4)
        shift = beater.motion.shift[index]  # type: ignore[union-attr]
        assert turned(rocker, complex(one.lengths["beater"])) == pytest.approx(complex(shift[2], shift[1]), abs=1e-9)

"""The loom in space: masses of the parts list, the side view's coordinates, and the cyclograms' motions."""

import math
from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from default_machines import SETTLED, loom_report
from plate_solids import plate_solid

from ilmek.elements.columns import STEEL
from ilmek.machines.arrangement.side_view import RETREAT
from ilmek.machines.automated_loom import MACHINE
from ilmek.machines.automated_loom.beat_motion import beat_tip
from ilmek.machines.automated_loom.cyclogram import EVEN, HEADS
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.feet import FOOT
from ilmek.machines.automated_loom.in_space.scene import scene
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.machines.beat_up import BeatUp
from ilmek.machines.beat_up.tree import in_side_view
from ilmek.machines.weaver.grippers import taut
from ilmek.machines.weaver.motions import CENTRE_GRASP, SIDE_GRASP, SIDE_MOTION
from ilmek.plane.contours import area
from ilmek.plane.solids import bounds, is_closed, volume
from ilmek.report import Contour
from ilmek.report.scene import Scene, SceneFrame, ScenePart
from ilmek.timing.track import sample


@cache
def _made(*settings: tuple[str, str]) -> tuple[LoomDesign, Scene]:
    loom = MACHINE.designed(MACHINE.params.read({"aim": "price", **SETTLED, **dict(settings)}))
    return loom, scene(loom, loom_report(loom))


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
    kinds = {line.part for line in parts_of_loom(loom).parts if line.kind in ("welded frame", "laser-cut part")}
    members = [part for part in found.parts if part.name.startswith("automated-loom/") and part.name in kinds]
    assert {"automated-loom/column", "automated-loom/upper-bracket", "automated-loom/rail"} <= {
        one.name for one in members
    }
    mass = sum(volume(part.solids[0]) * part.number for part in members) * STEEL.density
    # Less the holes of screws: those of bearings and reducers are 0.24 % of the frame.
    assert mass == pytest.approx(parts_of_loom(loom).frame.mass, rel=3e-3)
    weighed = sum(part.mass * part.number for part in members)
    assert weighed == pytest.approx(mass, rel=1e-4)  # round ends of brackets are chords
    shaft = _part(found, "shedding/cam-shaft")
    assert volume(shaft.solids[0]) * STEEL.density == pytest.approx(shaft.mass, rel=2e-4)  # chords


def test_every_plate_of_the_loom_has_the_volume_of_its_drawing() -> None:
    loom, found = _made()
    plates = {one.name: one for one in loom_report(loom).all_plates}
    drawn = [part for part in found.parts if part.plate]
    assert {part.plate for part in drawn} == set(plates)
    for part in drawn:
        plate = plates[part.plate]
        solid = plate_solid(plate, 1e-6)
        cut = math.fsum(math.pi * hole.radius**2 for hole in plate.holes)
        cut += math.fsum(abs(_area(one)) for one in plate.cutouts)
        exact = (abs(_area(plate.outline)) - cut) * plate.thickness
        assert is_closed(solid)
        assert volume(solid) == pytest.approx(exact, rel=4e-4)  # chords of 1 um on arcs of the smallest links


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
    assert np.allclose([lower[1] + origin[1], upper[1] + origin[1]], [side.floor + FOOT, side.top], atol=1e-9)
    assert origin[2] + (lower[2] + upper[2]) / 2 == pytest.approx(side.column, abs=1e-9)
    for name, roller in (("upper", side.upper), ("lower", side.lower)):
        at = _frame(found, f"warp-tension/{name} cylinder").origins[0]
        assert complex(at[2], at[1]) == pytest.approx(roller.at, abs=1e-9)
        shell = _part(found, f"warp-tension/cylinder of warp-tension/{name} cylinder")
        assert bounds(shell.solids[0])[1][2] == pytest.approx(roller.radius, abs=3e-4)
    drawn = {
        "opener": ("weaver/opener-plate",),
        "sley": ("weaver/sley",),
        "centre gripper": ("weaver/centre-head", "weaver/centre-gripper"),
    }
    for tool in side.of_heads.shape.tools:
        if tool.name in drawn:
            # The opener's two plates are one solid here; the tool is the upper one.
            least = tool.corner.imag - 1e-3 if tool.name == "opener" else -math.inf
            ends = np.array([_in_head(found, _part(found, name), least) for name in drawn[tool.name]])
            low, high = ends[:, 0].min(0), ends[:, 1].max(0)
            assert complex(low[2], low[1]) == pytest.approx(tool.corner, abs=1e-9)
            # To the back they reach as far as what drives them.
            assert high[1] == pytest.approx((tool.corner + tool.size).imag, abs=1e-9)
            assert high[2] >= (tool.corner + tool.size).real - 1e-9


def _in_head(found: Scene, part: ScenePart, least: float = -math.inf) -> tuple[np.ndarray, np.ndarray]:
    """Least and greatest coordinates of a part in the head's frame, of the last where it is there several times.

    least  height from which on its points count [m]
    """
    points, frame = part.solids[0].points, part.frame
    while frame != found.heads:
        points, frame = points + _frame(found, frame).origins[-1], _frame(found, frame).parent
    points = points[points[:, 1] >= least]
    return points.min(0), points.max(0)


def test_motions_are_those_of_the_cyclograms() -> None:
    loom, found = _made()
    row = loom.row_cyclogram
    rail = _frame(found, "heads' rail").motion
    assert rail is not None
    along = rail.shift @ np.array([0.0, RETREAT.imag, RETREAT.real])
    assert np.allclose(along, sample(row.track(HEADS), rail.angle).position, atol=1e-9)
    assert np.allclose(np.linalg.norm(rail.shift, axis=1), along, atol=1e-9)


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


def _rotated(axis: tuple[float, float, float], angle: float, points: np.ndarray) -> np.ndarray:
    """Rodrigues' formula."""
    k = np.array(axis)
    return (
        points * math.cos(angle)
        + np.cross(k, points) * math.sin(angle)
        + np.outer(points @ k, k) * (1 - math.cos(angle))
    )


def _in_space(found: Scene, name: str, points: np.ndarray, drive: str, angle: float) -> np.ndarray:
    """Points of the first of the frames of a name in the ground's axes, at an angle of a drive."""
    while name:
        frame = _frame(found, name)
        shift, turned = np.zeros(3), 0.0 if frame.phases is None else float(frame.phases[0])
        if frame.motion is not None and frame.motion.drive == drive:
            motion = frame.motion
            turned += float(np.interp(angle, motion.angle, motion.rotation))
            shift = np.array([np.interp(angle, motion.angle, one) for one in motion.shift.T])
        points = frame.origins[0] + shift + _rotated(frame.axis, turned, points)
        name = frame.parent
    return points


def _beyond(points: np.ndarray, convex: np.ndarray) -> np.ndarray:
    """How far points of the side view are outside a convex polygon [m]; below 0 inside."""
    edges, sense = np.roll(convex, -1) - convex, np.sign(np.sum((convex.conj() * np.roll(convex, -1)).imag))
    away: np.ndarray = -sense * ((points[:, None] - convex) * (edges / np.abs(edges)).conj()).imag
    return away.max(axis=1)


BEATS = [(), (("beat", "linkage"), ("heads", "2")), (("beat", "comb"),)]


@pytest.mark.parametrize("settings", BEATS)
def test_what_beats_is_in_space_where_its_clearances_have_it(settings: tuple[tuple[str, str], ...]) -> None:
    """The solids of teeth and bar, through all frames, fill the polygons of the side view over the row.

    Leaves end in slots of their bar.
    """
    loom, found = _made(*settings)
    names = ("beat-up/tooth", "beat-up/beater-bar") if loom.beat.name == "beat-up" else ("hammer/leaf", "hammer/bar")
    path = loom.beat.path
    assert any(check.name.startswith("beat: stroke") for check in _part(found, names[1]).checks)
    for angle in np.linspace(0.0, 2 * math.pi, 23):
        tip = beat_tip(path, loom.row_cyclogram, np.array([angle]))
        carried = [path.carried(polygon, tip)[0] for polygon in path.outline[:2]]
        for name, expected in zip(names, carried, strict=True):
            part = _part(found, name)
            points = _in_space(found, part.frame, part.solids[0].points, "row", angle)
            side = points[:, 2] + 1j * points[:, 1]
            assert np.abs(side[:, None] - expected).min(axis=0) == pytest.approx(0.0, abs=2e-4)
            outside = np.min([_beyond(side, own) for own in carried], axis=0)  # holes of screws among others
            assert np.max(outside) < 2e-4


@pytest.mark.parametrize("settings", BEATS[:2])
def test_the_links_of_the_beat_up_stay_joined(settings: tuple[tuple[str, str], ...]) -> None:
    """Pin B is where the coupler has it and where the rocker has it; the rest is on the ground or on one another."""
    loom, found = _made(*settings)
    one = loom.beat.design if loom.beat.name == "beat-up" else loom.beat.design.linkage.one
    back = _side_of(one)
    for angle in np.linspace(0.0, 2 * math.pi, 41):
        at = {}
        for link in ("coupler", "rocker"):
            part = _part(found, f"beat-up/{link}")
            at[link] = _in_space(found, part.frame, back(link, one.lengths[link]), "row", angle)[0, 1:]
        assert at["coupler"] == pytest.approx(at["rocker"], abs=5e-4)


def _side_of(one: BeatUp) -> Callable[[str, float], np.ndarray]:
    """A point on the line of a link at the beat, at a distance from its first pin, in the scene's axes."""
    rotation = in_side_view(one).rotation
    line = {"coupler": one.beta, "rocker": one.rocker_angles[0]}  # at the beat crank and coupler are in line

    def point(link: str, distance: float) -> np.ndarray:
        direction = np.array([math.cos(line[link]), math.sin(line[link]), 0.0])
        return (rotation @ direction * distance)[None, :]

    return point


@pytest.mark.parametrize(
    "settings", [(), (("width", "0.3 m"), ("length", "0.4 m"), ("beat", "linkage"), ("weft", "rapier"))]
)
def test_all_that_moves_is_held_down_to_the_floor_and_led_by_a_motor(settings: tuple[tuple[str, str], ...]) -> None:
    bodies = _made(*settings)[1].bodies

    def leads(name: str) -> list[str]:
        body = bodies[name]
        return [name, *(leads(body.follows[0]) if body.follows else [body.motor or body.passive])]

    for name, body in bodies.items():
        assert body.parent in {"", *bodies}
        if body.drive:
            assert leads(name)[-1], name
    led = leads("weaver/centre gripper")
    between = ("centre-gripper-motion-lever", "centre-gripper-motion-follower", "turning cam shaft")
    assert led[1:] == [*(f"weaver/{one}" for one in between), "motor of a head"]


def test_a_screw_is_as_large_as_itself_wherever_its_copies_stand() -> None:
    _, found = _made()
    screw = _part(found, "warp-tension/upper-bearing-screw")
    assert screw.copies == 8
    assert np.ptp(screw.solids[0].points, axis=0).max() > 1.0
    assert sorted(screw.extents)[2] < 0.1
    assert screw.extents[1] == pytest.approx(screw.extents[2], rel=1e-2)


def _about(axis: complex, line: np.ndarray) -> float:
    """Angle by which a line goes about an axis [rad]."""
    return float(np.angle((line[1:] - axis) / (line[:-1] - axis)).sum())


def test_the_yarn_of_a_knot_is_taut_and_goes_about_both_warps() -> None:
    loom, found = _made()
    by, knot = loom.weaver.grippers, loom.knot_cyclogram
    yarn = next(one for one in found.yarns if one.drive == "knot")
    flat = yarn.points[:, :, 0] + 1j * yarn.points[:, :, 2]
    closed = knot.track(SIDE_GRASP).segment("close").end
    taken = knot.track(CENTRE_GRASP).segment("close").end
    led = np.flatnonzero((yarn.angle >= closed) & (yarn.angle <= taken))
    lengths = np.linalg.norm(np.diff(yarn.points[led], axis=1), axis=2).sum(axis=1)
    assert lengths == pytest.approx(taut(by, sample(knot.track(SIDE_MOTION), yarn.angle[led]).position), rel=2e-3)
    out = int(np.searchsorted(yarn.angle, knot.track(CENTRE_GRASP).segment("open").start))
    left, right = np.split(flat[out], 2)
    assert _about(-by.pair / 2 + 0j, left) < -1.5 * math.pi
    assert _about(by.pair / 2 + 0j, right) < -1.5 * math.pi
    near = np.abs(flat[out][1:-1, None] - np.array([-by.pair / 2, by.pair / 2])).min(axis=1)
    assert near == pytest.approx((by.warp + by.yarn) / 2, rel=1e-6)
    assert yarn.points[-1, :, 1].max() <= loom.weaver.params.yarn


def test_the_tools_that_tie_are_frames_of_the_scene_and_their_motions_are_named() -> None:
    _, found = _made()
    assert set(found.tools) <= {frame.name for frame in found.frames}
    tracks = {(phase.drive, phase.track) for phase in found.phases}
    assert {("knot", SIDE_MOTION), ("row", EVEN)} <= tracks
    assert set(found.dyed) <= {part.ids[0] for part in found.parts}


def test_warps_are_lifted_by_their_track_at_the_height_of_their_cams_and_straight_from_the_fell() -> None:
    loom, found = _made()
    even = loom.row_cyclogram.track(EVEN)
    assert sum(sheet.across.size for sheet in found.warps) == loom.warps
    for sheet in found.warps[::2]:
        cam = loom.side.cams[found.warps.index(sheet) // 2]
        own = int(np.argmin(np.abs(sheet.points[0, :, 1] - cam.at.imag)))
        share = sample(even, sheet.angle).position / loom.row_timing.lift
        assert sheet.points[:, own, 2] == pytest.approx(share * cam.lift)
        steps = np.diff(sheet.points[:, : own + 1], axis=1)
        assert np.ptp(steps[..., 2] / steps[..., 1], axis=1) == pytest.approx(0.0, abs=1e-12)

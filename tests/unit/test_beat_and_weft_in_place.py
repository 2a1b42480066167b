"""Beat and weft in the loom: links in planes of their own, shuttles in their cells, the beam on its posts."""

from functools import cache

import numpy as np
import pytest
from default_machines import SETTLED, loom_report

from ilmek.machines.automated_loom import MACHINE as LOOM
from ilmek.machines.automated_loom.in_space.scene import scene
from ilmek.machines.weft.tree import RIGHT_BOX, SINUOUS, STRAIGHT
from ilmek.report.scene import Scene

LOOMS = ((), (("beat", "linkage"),), (("beat", "comb"), ("width", "0.6m")))


@cache
def _scene(*settings: tuple[str, str]) -> Scene:
    loom = LOOM.design(LOOM.params.read({"aim": "price", **SETTLED, "weft": "shuttle", **dict(settings)}))
    return scene(loom, loom_report(loom))


def _spans(found: Scene, name: str) -> np.ndarray:
    """Extent of a part along the width in its own frame, without the frame's rotation about it."""
    part = next(part for part in found.parts if part.name == name)
    x, frame = part.solids[0].points[:, 0], part.frame
    while frame:
        one = next(one for one in found.frames if one.name == frame)
        x, frame = x + one.origins[0][0], one.parent
    return np.array([x.min(), x.max()])


@pytest.mark.parametrize("settings", LOOMS[:2])
def test_links_run_in_planes_next_to_each_other(settings: tuple[tuple[str, str], ...]) -> None:
    found = _scene(*settings)
    names = ("beat-up/rocker", "beat-up/coupler", "beat-up/crank", "beat-up/carriage-plate")
    planes = np.array([_spans(found, name) for name in names])
    assert np.all(planes[1:, 0] > planes[:-1, 1])
    assert np.all(np.ptp(planes, axis=1) == pytest.approx(np.ptp(planes[0]), rel=1e-9))


def test_the_travelling_beater_stands_beside_its_rocker() -> None:
    found = _scene()
    bar, plate, rocker = (_spans(found, f"beat-up/{name}") for name in ("beater-bar", "beater-plate", "rocker"))
    assert bar[1] == pytest.approx(plate[0], abs=1e-9)
    assert plate[1] == pytest.approx(rocker[0], abs=1e-9)


@pytest.mark.parametrize("settings", LOOMS)
def test_a_shuttle_waits_in_its_cell_while_the_other_passes(settings: tuple[tuple[str, str], ...]) -> None:
    """At every angle the two are apart by a cell, and what is not in the shed moves as its box does."""
    found = _scene(*settings)
    frames = {frame.name: frame for frame in found.frames}
    motions = {name: frames[name].motion for name in (STRAIGHT, SINUOUS, RIGHT_BOX)}
    angle = np.linspace(0.0, 2 * np.pi, 721)

    def position(name: str) -> np.ndarray:
        motion = motions[name]
        assert motion is not None
        shift = np.stack([np.interp(angle, motion.angle, one) for one in motion.shift.T], axis=1)
        return np.asarray(shift + frames[name].origins[0])

    straight, sinuous, box = position(STRAIGHT), position(SINUOUS), position(RIGHT_BOX)
    right = straight[:, 0].max()
    assert sinuous[0, 0] == pytest.approx(right)
    wood = next(part for part in found.parts if part.name == f"weft/shuttle of {STRAIGHT}").solids[0].points
    long, tall = np.ptp(wood[:, 0]), np.ptp(wood[:, 1])
    apart = np.abs(straight - sinuous)
    assert np.all((apart[:, 0] >= long) | (apart[:, 1] > tall))
    line = box[0, 1]
    waiting = straight[:, 0] > right - 1e-6
    assert np.allclose(straight[waiting, 1] - straight[0, 1], box[waiting, 1] - line, atol=1e-9)
    passing = (straight[:, 0] > straight[0, 0] + 1e-6) & ~waiting
    assert np.allclose(straight[passing, 1], straight[0, 1], atol=1e-9)
    flying = (sinuous[:, 0] < right - 1e-6) & (sinuous[:, 0] > sinuous[:, 0].min() + 1e-6)
    assert np.allclose(sinuous[flying, 1], straight[0, 1], atol=1e-9)


@pytest.mark.parametrize("settings", LOOMS)
def test_the_beam_of_the_beat_lies_on_its_posts(settings: tuple[tuple[str, str], ...]) -> None:
    found = _scene(*settings)
    beam = next(part for part in found.parts if part.name == "beat-up/beam")
    post = next(part for part in found.parts if part.name == "automated-loom/beat-post")

    def at_rest(part, points: np.ndarray) -> np.ndarray:
        frame = part.frame
        while frame:
            one = next(one for one in found.frames if one.name == frame)
            points, frame = points + one.origins[0], one.parent
        return points

    low = at_rest(beam, beam.solids[0].points)
    top = np.concatenate(
        [
            at_rest(post, post.solids[0].points + origin)
            for frame in found.frames
            if frame.name == post.frame
            for origin in (np.zeros(3),)
        ]
    )
    assert low[:, 1].min() == pytest.approx(top[:, 1].max(), abs=1e-9)
    assert low[:, 2].min() < top[:, 2].mean() < low[:, 2].max()

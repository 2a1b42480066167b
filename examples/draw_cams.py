"""Draws docs/_static/cam-kinds.svg, every kind of cam to scale, and cam-four-bar.svg, a cam that is a four-bar.

Run it as `python examples/draw_cams.py`; it ends with the largest difference, in degrees, between the pressure angle of
a roller arm on an eccentric circle and the four-bar's transmission angle from 90 degrees.
"""

import math
from pathlib import Path

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.cams.barrel import BarrelCam
from ilmek.cams.conjugate import conjugate
from ilmek.cams.flat import FlatCam
from ilmek.cams.groove import Groove
from ilmek.cams.laws import LAWS
from ilmek.cams.oscillating import OscillatingCam, roller_motion
from ilmek.cams.oscillating_flat import OscillatingFlatCam
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, CamProgramme, FollowerMotion, dwell, fall, rise
from ilmek.cams.strip import WedgeCam
from ilmek.cams.trace import CamTrace, trace_of_point
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.quality import transmission_angle
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.report import Dot, Drawing, Stroke
from ilmek.units import deg, mm
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static"

ROUND = np.linspace(0.0, TURN, 721)
AT = 65 * deg
"""Cam angle of the pose that is drawn: on the rise."""

ROLLER, PIVOT, ARM = 9 * mm, 110 * mm, 95 * mm
CIRCLE, SHIFT = 42 * mm, 16 * mm


def motion(lift: float) -> CamProgramme:
    """Out over 110 degrees, a dwell, back over 120 degrees and a rest."""
    law = LAWS["modified-sine"]
    return CamProgramme((rise(110 * deg, lift, law), dwell(50 * deg), fall(120 * deg, lift, law), dwell(80 * deg)))


def disc(centre: complex, radius: float, role: str = "outline", label: str = "") -> Stroke:
    """A circle."""
    return Stroke(centre + radius * np.exp(1j * ROUND[::10]), role, label, closed=True)


def turned(points: ComplexArray, by: float = AT) -> ComplexArray:
    """Points of the cam in the world."""
    return np.asarray(points * np.exp(1j * by))


def here(cam: PlateCam | FlatCam | OscillatingCam | OscillatingFlatCam) -> tuple[complex, complex, complex]:
    """Roller's centre, place of contact and normal in the world, in the pose that is drawn."""
    trace = cam.trace(np.array([AT]))
    return tuple(complex(turned(points)[0]) for points in (trace.pitch, trace.surface, trace.normal))  # type: ignore[return-value]


def body(cam: PlateCam | FlatCam | OscillatingCam | OscillatingFlatCam) -> tuple[Stroke, ...]:
    """The cam's surface, and its pitch curve where that is another."""
    trace = cam.trace(ROUND)
    pitch = (Stroke(turned(trace.pitch), "path", "pitch curve", closed=True),) if cam.roller_radius else ()
    return Stroke(turned(trace.surface), "outline", "", closed=True, filled=True), *pitch


def push(at: complex, normal: complex, clear: float = 2 * ROLLER) -> Stroke:
    """The line of the push, beyond the roller."""
    return Stroke(at + np.array([clear, clear + 22 * mm]) * normal, "dimension", "push")


AXIS = Dot(0j, "", "pivot")


def translating() -> Drawing:
    """A roller in a slide beside the axis."""
    cam = PlateCam(motion(25 * mm), 45 * mm, 12 * mm, ROLLER)
    centre, touch, normal = here(cam)
    stem = Stroke(np.array([centre, centre.imag * 1j + 115 * mm]), "link", "follower")
    beside = Stroke(np.array([-0.02 - 12j * mm, 115 * mm - 12j * mm]), "construction")
    strokes = (*body(cam), stem, beside, disc(centre, ROLLER), push(touch, normal))
    return Drawing("translating", "Translating roller, offset", strokes, (AXIS, Dot(centre, "")))


def flat() -> Drawing:
    """A flat face in a slide."""
    cam = FlatCam(motion(14 * mm), 45 * mm)
    _, touch, normal = here(cam)
    face = Stroke(touch.real + 1j * np.array([-26 * mm, 26 * mm]), "link")
    stem = Stroke(np.array([touch.real, touch.real + 40 * mm], complex), "link", "follower")
    return Drawing("flat", "Translating flat face", (*body(cam), face, stem, push(touch, normal, 0.0)), (AXIS,))


def arm() -> Drawing:
    """A roller on an arm."""
    cam = OscillatingCam(motion(18 * deg), 48 * mm, PIVOT, ARM, -1, ROLLER)
    centre, touch, normal = here(cam)
    strokes = (*body(cam), Stroke(np.array([centre, PIVOT]), "link", "arm"), disc(centre, ROLLER), push(touch, normal))
    return Drawing("arm", "Oscillating roller", strokes, (AXIS, Dot(PIVOT, "", "pivot"), Dot(centre, "")))


def swinging_face() -> Drawing:
    """A flat face that swings."""
    cam = OscillatingFlatCam(motion(8 * deg), 45 * mm, PIVOT)
    _, touch, normal = here(cam)
    way = (touch - PIVOT) / abs(touch - PIVOT)
    face = Stroke(np.array([PIVOT, touch + 25 * mm * way]), "link", "face")
    return Drawing(
        "face", "Oscillating flat face", (*body(cam), face, push(touch, normal, 0.0)), (AXIS, Dot(PIVOT, "", "pivot"))
    )


def groove() -> Drawing:
    """A roller in the groove of a plate."""
    cam = PlateCam(motion(25 * mm), 48 * mm, 0.0, ROLLER)
    inner, outer = (turned(flank) for flank in Groove(cam).flanks(ROUND))
    centre, _, _ = here(cam)
    strokes = (
        Stroke(inner, "outline", "inner flank", closed=True),
        Stroke(outer, "outline", "outer flank", closed=True),
        Stroke(turned(cam.pitch(ROUND)), "path", "pitch curve", closed=True),
        disc(0j, 98 * mm),
        disc(centre, ROLLER),
    )
    return Drawing("groove", "Groove in a plate", strokes, (AXIS, Dot(centre, "")))


def pair() -> Drawing:
    """Two conjugate plates between two rollers of one slide."""
    both = conjugate(PlateCam(motion(25 * mm), 45 * mm, 0.0, ROLLER), 125 * mm)
    first, second = both.traces(ROUND)
    one, other = (complex(turned(trace.pitch)[0]) for trace in both.traces(np.array([AT])))
    strokes = (
        Stroke(turned(first.surface), "outline", "first plate", closed=True),
        Stroke(turned(second.surface), "path", "second plate", closed=True),
        Stroke(np.array([one, other]) - 80j * mm, "dimension", "fixed distance"),
        disc(one, ROLLER),
        disc(other, ROLLER),
    )
    return Drawing("pair", "Conjugate plates", strokes, (AXIS, Dot(one, ""), Dot(other, "")))


def end() -> Drawing:
    """The face of an end cam in space, seen from aside and above, with the roller on it."""
    cam = BarrelCam(motion(25 * mm), 50 * mm, ROLLER, 20 * mm)
    look = np.array([[1.0, 0.0, 0.0], [0.0, 0.45, 0.89]])
    front = np.exp(-50j * deg)

    def seen(points: np.ndarray, by: complex) -> ComplexArray:
        level = (points[..., 0] + 1j * points[..., 1]) * by
        placed = np.stack([level.real, level.imag, points[..., 2]], axis=-1) @ look.T
        return np.asarray(placed[..., 0] + 1j * placed[..., 1])

    def ring(depth: float) -> np.ndarray:
        round_, up = (
            ROLLER * np.cos(ROUND[::10]),
            float(cam.programme.at(np.array(AT)).s) + ROLLER * np.sin(ROUND[::10]),
        )
        return np.stack([np.full_like(round_, depth), round_, up], axis=-1)

    as_drawn = complex(front * np.exp(1j * AT))
    angle = np.linspace(0.0, TURN, 241)
    rims = [cam.flank(angle, depth) for depth in cam.depths]
    rays = (Stroke(seen(np.stack([rim[i] for rim in rims]), as_drawn), "construction") for i in range(0, 240, 5))
    below = seen(rims[1] * np.array([1, 1, 0]) + np.array([0, 0, -35 * mm]), as_drawn)
    side = np.argmin(below.real), np.argmax(below.real)
    skirt = below[below.imag <= below[side[0]].imag]
    axle = np.array([[depth, 0.0, ring(depth)[:, 2].mean()] for depth in (60 * mm, 85 * mm)])
    strokes = (
        *rays,
        Stroke(skirt[np.argsort(skirt.real)], "outline"),
        *(Stroke(np.array([below[i], seen(rims[1], as_drawn)[i]]), "outline") for i in side),
        Stroke(seen(rims[0], as_drawn), "outline", "inner rim", closed=True),
        Stroke(seen(rims[1], as_drawn), "outline", "outer rim", closed=True),
        *(Stroke(seen(ring(depth), front), "outline", closed=True, filled=True) for depth in cam.depths),
        Stroke(seen(axle, front), "link", "roller"),
    )
    return Drawing("end", "End cam: the flank under a radial roller", strokes)


def wedge() -> Drawing:
    """A plate that moves to and fro under a roller."""
    cam = WedgeCam(motion(25 * mm), 340 * mm, ROLLER, used=240 * deg)
    angle = np.linspace(0.0, 240 * deg, 300)
    trace = cam.trace(angle)
    lying = 1j * np.concatenate([trace.surface, trace.surface[[-1, 0]].imag * 1j - 22 * mm])
    place = cam.trace(np.array([AT]))
    centre, touch, normal = (1j * complex(points[0]) for points in (place.pitch, place.surface, place.normal))
    strokes = (
        Stroke(lying, "outline", "wedge", closed=True, filled=True),
        Stroke(1j * trace.pitch, "path", "pitch curve"),
        Stroke(np.array([centre, centre + 45j * mm]), "link", "follower"),
        disc(centre, ROLLER),
        push(touch, normal),
    )
    return Drawing("wedge", "Wedge", strokes, (Dot(centre, ""),))


KINDS = (translating, flat, arm, swinging_face, groove, pair, end, wedge)


def sheet(wide: int = 420, high: int = 300, columns: int = 2) -> str:
    """All kinds on one sheet."""
    inner = ""
    for i, kind in enumerate(KINDS):
        x, y, drawing = i % columns * wide, i // columns * (high + 20), kind()
        placed = f'<svg x="{x}" y="{y + 20}" width="{wide}" height="{high}" '
        inner += svg(drawing).replace("<svg ", placed, 1)
        inner += f'<text x="{x + 26}" y="{y + 14}" font-family="sans-serif" font-size="11">{drawing.title}</text>'
    size = f"0 0 {columns * wide} {-(-len(KINDS) // columns) * (high + 20)}"
    head = f'<svg xmlns="http://www.w3.org/2000/svg" role="img" viewBox="{size}" aria-label="Kinds of cams">'
    return f"{head}{inner}</svg>\n"


def arm_on_circle(angle: np.ndarray) -> tuple[CamTrace, np.ndarray]:
    """A roller arm on an eccentric circle, moved by its four-bar; and the deviation of the transmission angle [rad]."""
    moved = solve(plan(four_bar(PIVOT, SHIFT, CIRCLE + ROLLER, ARM, branch=+1)), angle, 1.0).require()
    psi, dpsi, ddpsi = math.pi - moved.angle("rocker"), -moved.omega("rocker"), -moved.alpha("rocker")
    centre = roller_motion(psi, dpsi, ddpsi, pivot=PIVOT, arm=ARM, side=1)
    course = FollowerMotion(psi, dpsi, ddpsi, np.zeros_like(psi))
    trace = trace_of_point(angle, course, centre, 1j * np.exp(-1j * psi), ROLLER)
    return trace, np.abs(math.pi / 2 - transmission_angle(moved, "B"))


def four_bar_drawing() -> Drawing:
    """The cam, and over it the four-bar that it is."""
    trace, _ = arm_on_circle(ROUND)
    place, _ = arm_on_circle(np.array([AT]))
    centre, eccentric = complex(turned(place.pitch)[0]), SHIFT * complex(np.exp(1j * AT))
    strokes = (
        Stroke(turned(trace.surface), "outline", "cam", closed=True, filled=True),
        Stroke(turned(trace.pitch), "path", "pitch curve", closed=True),
        Stroke(np.array([0j, eccentric]), "link", "crank"),
        Stroke(np.array([eccentric, centre]), "link", "coupler"),
        Stroke(np.array([PIVOT, centre]), "link", "rocker"),
        disc(centre, ROLLER),
    )
    dots = AXIS, Dot(PIVOT, "", "pivot"), Dot(eccentric, ""), Dot(centre, "")
    return Drawing("cam-four-bar", "A roller arm on an eccentric circle is a four-bar", strokes, dots)


if __name__ == "__main__":
    (OUT / "cam-kinds.svg").write_text(sheet(), encoding="utf-8")
    (OUT / "cam-four-bar.svg").write_text(svg(four_bar_drawing()), encoding="utf-8")
    traced, leaning = arm_on_circle(ROUND)
    print(f"{np.max(np.abs(np.abs(traced.pressure_angle) - leaning)) / deg:.1e}")

"""Figures of hands that tie: to scale among the warps, in motion with the yarn, and how the path becomes the knot.

The view is along the warps, stretched across them by 1 / cos b: so links and fingers, which move in the inclined plane,
have their true shapes, and warps are ellipses.
"""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.linkage.motion import Motion
from ilmek.machines.knot_pictures import RING, KnotPictures
from ilmek.machines.knotting_four_bar.hands.design import TyingHands, led_ends, returning
from ilmek.machines.knotting_four_bar.hands.hand import TyingHand
from ilmek.machines.knotting_four_bar.hands.section import InclinedSection
from ilmek.report import Animation, Axis, Dot, Drawing, Figure, MovingDot, MovingStroke, Reading, Stroke
from ilmek.synthesis.four_bar import TRACER
from ilmek.units import format_quantity
from ilmek.weaving.knots.led_yarn import yarn_over_time

HALF = 36
"""Frames of a stroke in the animation."""

ALONG, ARC, EACH = 120, 24, 200
"""Points of the yarn and of a finger that are drawn; samples of a path in the pictures."""

SHOWN = 2
"""Warps drawn on each side of the knot."""


def _same(points: ComplexArray) -> ComplexArray:
    return points


def _image(points: ComplexArray) -> ComplexArray:
    return np.asarray(-np.conj(points))


SIDES = {"left": _same, "right": _image}
"""Points of the left hand on each side."""


def figures(hands: TyingHands) -> tuple[Figure, ...]:
    """The hands at the middle of their stroke, tying, and the yarn's path at five instants; none without hands."""
    if hands.made is None:
        return ()
    hand = hands.made.hand
    moving = (animation(hand), *((path_to_knot(hand),) if hands.ties else ()))
    return (at_middle(hand), *moving)


def _warps(section: InclinedSection) -> tuple[Stroke, ...]:
    count = 2 * (section.task.each + SHOWN)
    x = (np.arange(count) - (count - 1) / 2) * section.task.cloth.warp_pitch
    ring = section.task.warp / 2 * RING
    shape = ring.real / section.cosine + 1j * ring.imag
    return tuple(
        Stroke(at / section.cosine + shape, "outline", "" if number else "warps", closed=True, filled=True)
        for number, at in enumerate(x.tolist())
    )


def _note(section: InclinedSection) -> str:
    tilt = format_quantity(section.inclination, "deg", 3)
    return f"along the warps, across them {1 / section.cosine:.3g} times: in the plane of the hands, inclined by {tilt}"


def _arc(hand: TyingHand) -> ComplexArray:
    """The finger's middle line at the middle of the stroke, from its tip [m]."""
    return np.asarray(hand.centre - 1j * hand.radius * np.exp(-1j * np.linspace(0, hand.span, ARC)))


def at_middle(hand: TyingHand) -> Drawing:
    """Both hands at the middle of their strokes."""
    links, arc = hand.four_bar, _arc(hand)
    assert links.tracer is not None
    strokes = list(_warps(hand.section))
    for name, side in SIDES.items():
        lines = {
            "coupler": (links.a, links.b, links.tracer),
            "crank": (links.a0, links.a),
            "rocker": (links.b0, links.b),
        }
        for label, points in lines.items():
            shown = label if name == "left" else ""
            strokes.append(Stroke(side(np.array(points)), "link", shown, closed=len(points) > 2))
        strokes.append(Stroke(side(arc), "outline", f"{name} finger"))
    dots = [Dot(links.a0, "A0", "pivot"), Dot(links.b0, "B0", "pivot"), Dot(links.a, "A"), Dot(links.b, "B")]
    dots += [Dot(-links.a0.conjugate(), "A0'", "pivot"), Dot(-links.b0.conjugate(), "B0'", "pivot")]
    return Drawing(
        "knotting-hands", "Hands at the middle of their stroke", tuple(strokes), tuple(dots), note=_note(hand.section)
    )


def animation(hand: TyingHand) -> Animation:
    """A knot tied: both hands to and fro, and the yarn where its ends were led, not yet tightened."""
    section, stroke = hand.section, hand.stroke(HALF + 1)
    to_and_fro = np.concatenate([np.arange(HALF + 1), np.arange(HALF - 1, 0, -1)])
    time = np.arange(2 * HALF) * (section.task.stroke_time / HALF)
    strokes = [MovingStroke(_yarn(hand, stroke, time), "yarn", "yarn")]
    for name, side in SIDES.items():
        for label, role, points in _links(hand, stroke):
            own = side(points)[to_and_fro]
            strokes.append(
                MovingStroke(own, role, f"{name} {label}" if label else "", closed=role == "link" and own.shape[1] > 2)
            )
    links = hand.four_bar
    pivots = [Dot(at, "", "pivot") for p in (links.a0, links.b0) for at in (p, complex(-np.conj(p)))]
    still = Drawing(
        "knotting-hands-moving", "The hands tie a knot", _warps(section), tuple(pivots), note=_note(section)
    )
    pins = [np.asarray(stroke.point("coupler", name).position)[to_and_fro] for name in ("A", "B")]
    dots = tuple(MovingDot(own, "") for pin in pins for own in (pin, -np.conj(pin)))
    readings = (Reading("crank of the left hand", np.asarray(stroke.angle("crank"))[to_and_fro], "deg"),)
    period = 2 * section.task.stroke_time
    return Animation(still, Axis("time", "ms"), time, tuple(strokes), dots, period=period, readings=readings)


def _links(hand: TyingHand, motion: Motion) -> list[tuple[str, str, ComplexArray]]:
    """Label, role and points over the samples of crank, rocker, coupler and finger of the left hand [m]."""
    a, b, foot = (np.asarray(motion.point("coupler", name).position) for name in ("A", "B", TRACER))
    local = np.array([hand.on_coupler(at) for at in _arc(hand)])
    finger = motion.origin("coupler")[:, None] + motion.direction("coupler")[:, None] * local
    still = np.ones(len(a))
    return [
        ("crank", "link", np.stack([hand.four_bar.a0 * still, a], axis=1)),
        ("", "link", np.stack([hand.four_bar.b0 * still, b], axis=1)),
        ("coupler", "link", np.stack([a, b, foot], axis=1)),
        ("finger", "outline", finger),
    ]


def _yarn(hand: TyingHand, stroke: Motion, time: FloatArray) -> ComplexArray:
    """The yarn at times [s] in the plane of the hands [m]."""
    there = np.linspace(0.0, hand.section.task.stroke_time, len(stroke))
    tip = stroke.origin("coupler") + stroke.direction("coupler") * hand.tip
    ends = []
    for name, side in SIDES.items():
        points, back = side(tip), name == returning(hand.section.task)
        ends.append((there + there[-1], points[::-1]) if back else (there, points))
    return yarn_over_time(ends, time, ALONG)


def path_to_knot(hand: TyingHand) -> Drawing:
    """The yarn's path in the section at five instants, and its knot."""
    task = hand.section.task
    count = 2 * (task.each + 1)
    warps = (np.arange(count) - (count - 1) / 2) * task.cloth.warp_pitch + 0j
    ends = led_ends(hand, EACH)
    back = [side == returning(task) for side in ("left", "right")]
    instants = []
    for half in (0.0, 0.5, 1.0, 1.5, 2.0):
        parts = []
        for path, late in zip(ends, back, strict=True):
            share = min(max(half - 1.0 if late else half, 0.0), 1.0)
            parts.append(path.points[: max(round(share * len(path.points)), 1)])
        text = format_quantity(half * task.stroke_time, "ms", 3)
        instants.append((text, np.concatenate([parts[0][::-1], parts[1]])))
    low = float(np.min(np.concatenate([end.points for end in ends]).imag))
    pictures = KnotPictures(
        warps=warps,
        knot=task.knot_after(1),
        pitch=task.cloth.warp_pitch,
        warp=task.warp,
        yarn=task.yarn,
        wide=1.5 * max(count * task.cloth.warp_pitch, task.front - 2 * low),
        low=-1.3 * low,
        instants=instants,
    )
    return pictures.drawn("knotting-hands-yarn", "time")

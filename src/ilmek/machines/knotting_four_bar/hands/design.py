"""The design of hands that tie: the search, the best that can be made, the proof of their knot, and their servos.

Ends of the yarn are led by the fingers' tips, to and fro between the front beside the group, A, and the front over the
knot's middle, M. Both hands swing together; in which direction each leads its end follows from the knot:

    symmetric               both from A to M
    asymmetric, open left   the left one from M to A as it returns, the right one from A to M
    asymmetric, open right  the mirror image

The yarn lies straight in front between its ends before, and its path is proved by its crossing word [`weaving.knots`].
"""

from functools import lru_cache

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.loads import Gravity, PointForce
from ilmek.elements.micro_servos import MicroServo, lightest_servo
from ilmek.errors import IlmekError
from ilmek.machines.knotting_four_bar.hands.hand import TyingHand, hand_of
from ilmek.machines.knotting_four_bar.hands.parts import HandParts, hand_parts
from ilmek.machines.knotting_four_bar.hands.search import SearchedPlane, searched
from ilmek.machines.knotting_four_bar.hands.section import NEIGHBOURS, InclinedSection, least_inclination
from ilmek.machines.knotting_four_bar.hands.task import KNOTS, HandsTask
from ilmek.progress import SILENT, Progress
from ilmek.records import computed, group, record
from ilmek.weaving.knots.led_yarn import SampledPath, end_path, knot_of_ends
from ilmek.weaving.knots.proof import TiedKnot

MADE = 8
"""Hands of a plane that are tried to be made, the best first."""


@record
class CrankLoads:
    """Torque on a crank [N m] and its speed [rad/s], at the samples; greatest error of the power balance [1]."""

    torque: FloatArray
    speed: FloatArray
    power_error: float


@record
class TyingHands:
    """Hands for a task.

    planes  searched, up to the one that was taken
    made    the hand as it is made; None: none keeps the limits
    tied    the knot that both tie
    loads   of a crank over a stroke to and fro; None without hands
    """

    params: HandsTask
    planes: tuple[SearchedPlane, ...]
    made: HandParts | None = group()
    tied: TiedKnot | None
    loads: CrankLoads | None
    servo: MicroServo | None

    ties = computed(
        "",
        "whether the knot is proved, tied by hands that keep the limits and can be made",
        lambda it: it.tied is not None and it.tied.knot == it.params.knot_after(NEIGHBOURS),
    )
    knot = computed(
        "", "knot that both hands tie, by the crossings of the yarn", lambda it: it.tied.words if it.tied else "no knot"
    )
    candidates = computed(
        "1", "hands within all limits, clear of the warps, in the plane taken", lambda it: it.planes[-1].candidates
    )
    searched = computed(
        "",
        "planes searched, SI: inclination, four-bars tried, of these within all limits but the clearance, candidates, "
        "greatest clearance, less by what the finger bends beyond it (null: none within)",
        lambda it: [plane.as_json() for plane in it.planes],
        shown=False,
    )
    least_inclination = computed(
        "deg", "below it no finger bent to an arc does, by closed form", lambda it: least_inclination(it.params)
    )
    inclination = computed(
        "deg",
        "of the plane of the hands from the section across the warps",
        lambda it: it.planes[-1].inclination if it.made else None,
        absent="none does",
    )

    crank_torque = computed(
        "mN*m",
        "greatest on a hand's crank: inertia, weight and yarn",
        lambda it: float(np.max(np.abs(it.loads.torque))) if it.loads else None,
        optional=True,
    )
    hand_servo = computed(
        "",
        "lightest servo or stepper of the catalogue that swings a hand",
        lambda it: it.servo.name if it.servo else None,
        optional=True,
    )


def design(params: HandsTask, progress: Progress = SILENT) -> TyingHands:
    """Search, make, prove and drive hands. Raises Cancelled."""
    planes, made = [], None
    for plane in searched(params, progress):
        planes.append(plane)
        made = _made(InclinedSection(params, plane.inclination), plane)
        if made is not None:
            break
    progress(1.0)
    if made is None:
        return TyingHands(params, tuple(planes), None, None, None, None)
    load = loads(made)
    servo = lightest_servo(load.torque, load.speed, made.hand.swing, params.servo_mass)
    return TyingHands(params, tuple(planes), made, proof(made.hand), load, servo)


def _made(section: InclinedSection, plane: SearchedPlane) -> HandParts | None:
    """The first of the best hands of a plane that is sure to be clear, and can be made."""
    for number in range(min(MADE, plane.candidates, len(plane.hands))):
        hand = hand_of(section, plane.hands, number)
        if hand.clearance < max(section.task.clearance, hand.bent * section.cosine):
            continue
        try:
            made = hand_parts(hand)
        except IlmekError:
            continue
        if made is not None:
            return made
    return None


@lru_cache(maxsize=16)
def proof(hand: TyingHand) -> TiedKnot:
    """The knot that the hand and its image tie; the tips lead the ends, clear of the warps by the yarn's own path."""
    section = hand.section
    return knot_of_ends(lambda samples: led_ends(hand, samples), section.warps, keep_out=section.task.warp / 2)


def returning(task: HandsTask) -> str:
    """The side whose hand leads its end as it returns: the open one; "" for a symmetric knot."""
    kind, opens, _ = KNOTS[task.knot]
    return opens if kind == "asymmetric" else ""


def led_ends(hand: TyingHand, samples: int) -> tuple[SampledPath, SampledPath]:
    """Paths of both ends of the yarn in the section, the left hand's first."""
    path, back = hand.tip_path(samples), returning(hand.section.task)
    right = SampledPath(-np.conj(path.points), path.lengths)
    return _led(path, back=back == "left"), _led(right, back=back == "right")


def _led(path: SampledPath, *, back: bool) -> SampledPath:
    step = -1 if back else 1
    return end_path([(path.points[::step], path.lengths[::step])])


def loads(made: HandParts) -> CrankLoads:
    """Torque on a crank [N m] and its speed [rad/s] over a stroke to and fro, with gravity either sense along u.

    The yarn pulls the tip against its motion. The hands are each other's image, so that weight helps one and hinders
    the other; to and fro differ by the sign of speed and pull.
    """
    hand, task = made.hand, made.hand.section.task
    motion, inertias, tip = hand.stroke(), made.inertias(), hand.tip
    turned = 1j * motion.omega("coupler") * motion.direction("coupler")
    velocity = motion["coupler"].velocity + turned * tip
    size = np.abs(velocity)
    pull = -task.yarn_pull * velocity / np.where(size > 0, size, 1.0)
    torques, errors = [], []
    for side in (+1, -1):
        weight = Gravity(complex(side * task.gravity * np.sin(hand.section.inclination)))
        for sense in (+1, -1):
            forces = inverse(motion, inertias, (weight, PointForce(("coupler", tip), sense * pull)))
            torques.append(forces.effort("crank"))
            errors.append(forces.power_error)
    return CrankLoads(np.concatenate(torques), np.tile(motion.omega("crank"), 4), max(errors))

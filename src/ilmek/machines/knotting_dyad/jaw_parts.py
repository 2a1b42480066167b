"""The jaws of the grippers as parts and bodies: blade and finger, pin and lugs, rod, spring, neck and solenoid.

Axes of a gripper: x along its needle from the elbow to the tip, y across, z to the fell with 0 amid the needles; the
centre gripper's as if it had an elbow as far from its tip as an arm's. Axes of a rod: z to its solenoid, 0 amid the
finger's tail that lies in its groove.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.machines.knotting_dyad.arm_drives import BONDED, HUB, NAME
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.jaws import (
    CHEEK,
    COLLAR,
    CUP,
    IN_BORE,
    LUG,
    PIN,
    PLAY,
    STEEL,
    TAIL,
    TINE,
    UNDER,
    WALL,
    Jaws,
    depth_of,
)
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.part.catalogue import spring_part
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Shape, Sum, bar, rectangle, stepped, tube
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import circle, polygon, slotted
from ilmek.report import Contour
from ilmek.units import deg, mm

ROD, SOLENOID = f"{NAME}/rod", f"{NAME}/solenoid"
"""Ids of parts; of the centre gripper's own with a suffix."""

OF_CENTRE = "-of-the-centre"

IN_GROOVE = 0.25 * mm
"""Play of a finger's tines in the groove of their rod, above and below together [m]."""

HEAD = 0.25 * mm
"""Thickness of a rod's head over the tines [m]."""

FOOT, FOOT_WIDTH = 2.5 * mm, 10 * mm
"""Thickness and width of the foot under the centre gripper's solenoid, on its axis [m]; assumed by this project."""

_ASIDE = placement(about=(1.0, 0.0, 0.0), angle=90 * deg)
"""A section in x and z of a gripper: its length goes to -y."""

ALONG = placement(about=(0.0, 1.0, 0.0), angle=-90 * deg)
"""A section in z and y of a gripper, or a rod along it: its length goes to -x, back from the tip."""


def clamped(head: Head, jaws: Jaws) -> float:
    """Depth of the slot in which a blade is bonded [m]: half way to that of the centre's rod; 0: on its face."""
    room = head.arm.second - head.section.needle_length - jaws.arm - LUG / 2
    return max(room - head.section.needle, 0.0) / 2


def for_blade(outline: Contour, head: Head, jaws: Jaws) -> Contour:
    """The outline of what ends at a blade's clamp, with the slot for the blade."""
    held, half = clamped(head, jaws), head.section.needle / 2
    begin = head.arm.second - head.section.needle_length - held
    return slotted(outline, complex(begin), 1.0 + 0j, half) if held else outline


def _blade(params: KnottingDyadParams, head: Head, jaws: Jaws) -> Part:
    """The blade of a needle, with the fixed jaw at its end: along x from its clamp, in whose slot it is bonded."""
    broad, length = params.needle_breadth, head.section.needle_length
    shape = Prism(_wedge(head, -clamped(head, jaws), length - PLAY), broad)
    return _made("needle", "blade of a needle", "laser-cut part", shape, BONDED)


def _wedge(head: Head, begin: float, end: float) -> Profile:
    """A needle in plan from begin to end [m], which narrows to half the tilt of the hand-over on both sides."""
    half = head.section.needle / 2
    edge = np.array([begin, end - half / math.tan(head.section.tilt / 2)]) + 1j * half
    return Profile(polygon(np.array([*np.conj(edge), end, *edge[::-1]])))


@lru_cache(maxsize=8)
def on_link(params: KnottingDyadParams, head: Head, jaws: Jaws) -> tuple[Occurrence, ...]:
    """Blade, and the lugs with the pin of the finger, in a gripper's axes: arms and centre gripper share the parts."""
    clamp = head.arm.second - head.section.needle_length
    blade = Occurrence(_blade(params, head, jaws), (placement(clamp, z=-params.needle_breadth / 2),))
    side, near = jaws.rod / 2 + IN_BORE / 4, LUG / 2
    corners = np.array(
        [-near - 1j * TAIL, near - 1j * TAIL, near + 1j * (PIN / 2 + WALL / 2), -near + 1j * (PIN / 2 + WALL / 2)]
    )
    lug = Prism(Profile(polygon(corners), (circle(0j, PIN / 2),)), CHEEK)
    lug_part = _made("lug", "lug of a finger's pin", "machined link", lug, BONDED)
    pin = _made("finger-pin", "pin of a finger", "pin or bush", bar(PIN, 2 * (side + CHEEK)))
    at = placement(jaws.arm, z=jaws.deep)
    return (
        blade,
        Occurrence(lug_part, tuple(at.after(placement(y=y)).after(_ASIDE) for y in (side + CHEEK, -side))),
        Occurrence(pin, (at.after(placement(y=side + CHEEK)).after(_ASIDE),)),
    )


@lru_cache(maxsize=8)
def finger_part(params: KnottingDyadParams, head: Head, jaws: Jaws, centre: bool) -> Part:
    """A finger with its pin's axis in the origin, closed: under the blade, and its fork about the rod's neck."""
    clamp = jaws.tip - head.section.needle_length + IN_BORE / 2
    half, near, top, low = jaws.rod / 2, min(LUG / 2, clamp), UNDER - TAIL, TINE / 2
    jaw, edge = params.needle_breadth / 2 - jaws.deep + PLAY, depth_of(params) - jaws.deep
    needle = Placed(Prism(_wedge(head, clamp, jaws.tip - IN_BORE), edge - jaw), (placement(z=jaw),))
    front = [-near + 1j * top, clamp + 1j * top, clamp + 1j * edge, -near + 1j * edge]
    if centre:
        outline, middle, tine = front, 0.5j * (top - jaws.crank - low), (TINE, jaws.crank + top + low)
    else:
        begin = min(half + 3 * IN_GROOVE - jaws.arm, -near - IN_GROOVE)
        outline = [begin - 1j * low, -near - 1j * low, *front, -near + 1j * low, begin + 1j * low]
        length = max(begin + jaws.arm + half / 2, IN_GROOVE)
        middle, tine = complex(begin - length / 2), (length, TINE)
    body = Prism(Profile(polygon(np.array(outline)), (circle(0j, PIN / 2),)), 2 * half)
    thick = half - _groove(jaws) / 2 - 0.05 * mm
    members = (
        needle,
        Placed(body, (placement(y=half).after(_ASIDE),)),
        Placed(
            Prism(Profile(polygon(rectangle(*tine).points + middle)), thick),
            tuple(placement(y=y).after(_ASIDE) for y in (half, thick - half)),
        ),
    )
    name, of = ("finger", "an arm") if not centre else (f"finger{OF_CENTRE}", "the centre gripper")
    return _made(name, f"finger of {of}", "machined link", Sum(members))


def _groove(jaws: Jaws) -> float:
    """Diameter of a rod's neck [m]."""
    return 0.4 * jaws.rod


@lru_cache(maxsize=8)
def rod_part(jaws: Jaws, length: float, centre: bool) -> Part:
    """A rod about its axis while the jaws are closed; length: from the finger's tail to what bears its neck [m]."""
    low = (TINE + IN_GROOVE) / 2
    before = (jaws.rod, HEAD), (_groove(jaws), 2 * low), (jaws.rod, length - low + COLLAR + jaws.on_rod)
    steps = *before, (jaws.coil, COLLAR), (jaws.rod, jaws.neck - jaws.on_rod - 2 * COLLAR - IN_BORE)
    shape = Sum((Placed(stepped(*steps), (placement(z=-low - HEAD),)),))
    name, of = ("rod", "an arm") if not centre else (f"rod{OF_CENTRE}", "the centre gripper")
    return _made(name, f"rod of the finger of {of}", "turned part", shape)


def drive_of(jaws: Jaws, on: Placement) -> Iterator[Occurrence]:
    """Neck with its cap, spring and solenoid of a finger, from where they begin on a rod's axis."""
    neck, cap, solenoid, *spring = _drive_parts(jaws)
    yield Occurrence(neck, (on,))
    yield Occurrence(cap, (on.after(placement(z=jaws.cup - COLLAR)),))
    yield from (Occurrence(part, (on.after(placement(z=COLLAR)),)) for part in spring)
    yield Occurrence(solenoid, (on.after(placement(z=jaws.neck)),))


@lru_cache(maxsize=8)
def _drive_parts(jaws: Jaws) -> tuple[Part, ...]:
    """Neck, the cap that is pressed into it when rod and spring are in it, solenoid, and the spring where one fits."""
    bore, row, spring = jaws.rod, jaws.solenoid, jaws.spring
    inner, stem = jaws.around - 2 * CUP, bore + 2 * CUP
    end = Placed(tube(jaws.around, (jaws.around - bore) / 2, COLLAR))
    about = Placed(tube(jaws.around, CUP, jaws.cup - COLLAR), (placement(z=COLLAR),))
    neck = _made("neck", "neck of a solenoid", "turned part", Sum((end, about)), BONDED)
    within = Placed(tube(inner, (inner - bore) / 2, COLLAR))
    beyond = Placed(tube(stem, CUP, jaws.neck - jaws.cup), (placement(z=COLLAR),))
    cap = _made("neck-cap", "cap of a neck", "turned part", Sum((within, beyond)))
    bought = Bought(row.designation, row.mass, power=row.power, drives=1)
    room = bar(row.diameter, row.length)
    solenoid = bought_part(SOLENOID, "solenoid of a finger", "solenoid", room, bought, fixing=BONDED)
    if spring is None:
        return neck, cap, solenoid
    wound = spring_part(f"{NAME}/finger-spring", "spring of a finger", spring, jaws.on_rod - jaws.stroke)
    return neck, cap, solenoid, wound


def finger_at(jaws: Jaws) -> Placement:
    """The axes of a closed finger in its gripper's."""
    return placement(jaws.arm, z=jaws.deep)


def rod_at(jaws: Jaws, centre: bool) -> Placement:
    """The axes of a rod in its gripper's."""
    return placement(jaws.arm, z=-jaws.over).after(ALONG) if centre else placement(z=jaws.deep)


RISE = HUB - TAIL
"""From the tail of an arm's finger to the end of its hub, which bears the neck [m]."""


def moving_parts(params: KnottingDyadParams, head: Head, jaws: Jaws) -> tuple[Occurrence, ...]:
    """An arm's closed finger and its rod in the gripper's axes, for the inertia of its link."""
    return (
        Occurrence(finger_part(params, head, jaws, False), (finger_at(jaws),)),
        Occurrence(rod_part(jaws, RISE, False), (rod_at(jaws, False),)),
    )


def centre_parts(params: KnottingDyadParams, head: Head, jaws: Jaws, ends: tuple[float, float]) -> Iterator[Occurrence]:
    """Bar with its foot and solenoid of the centre gripper, in its axes; ends: x of the nose's end and the rear [m]."""
    clamp, (nose, rear) = head.arm.second - head.section.needle_length, ends
    width, thick, back = params.link_width, params.link_thickness, bar_end(jaws, rear)
    slot = _rectangle(jaws.arm - LUG / 2, jaws.arm + LUG / 2, jaws.rod + IN_BORE)
    front = Prism(Profile(for_blade(_rectangle(nose, clamp, width), head, jaws), (slot,)), thick)
    section = Profile(rectangle(2 * jaws.bar, width), (circle(complex(-jaws.over), jaws.rod / 2),))
    foot = Prism(Profile(_rectangle(rear, back + FOOT_WIDTH, FOOT_WIDTH)), FOOT)
    members = (
        Placed(front, (placement(z=-thick / 2),)),
        Placed(Prism(section, nose - back), (placement(nose).after(ALONG),)),
        Placed(foot, (placement(z=jaws.bar),)),
    )
    material = replace(params.strength.of_links, density=params.density)
    yield Occurrence(
        Part(f"{NAME}/centre-bar", "bar of the centre gripper", "machined link", Sum(members), material),
        (placement(),),
    )
    yield from drive_of(jaws, placement(back, z=-jaws.over).after(ALONG))


def bar_end(jaws: Jaws, rear: float) -> float:
    """X of the end of the centre gripper's bar, before its solenoid, from that of the rear [m]."""
    return rear + jaws.neck + jaws.solenoid.length


def _rectangle(begin: float, end: float, width: float) -> Contour:
    half = 0.5j * width
    return polygon(np.array([begin - half, end - half, end + half, begin + half]))


def _made(name: str, title: str, process: str, shape: Shape, fixing: str = "") -> Part:
    return Part(f"{NAME}/{name}", title, process, shape, STEEL, fixing=fixing)

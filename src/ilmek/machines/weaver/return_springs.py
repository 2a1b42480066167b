"""The return springs of a head: at the tools, so that they take the play out of all that is between tool and cam.

A follower's spring of the rate k and the preload P is at its tool, which moves i times as far, one of n springs of
k / n i² and P / n i: the same force on the follower by virtual work. Each is the lightest of its rate that is safe at
its solid length (`elements.springs`), led by a rod. It is shown at its shortest, on the seat that stands.
"""

from functools import lru_cache

from ilmek.cams.loaded_plate_cam import LoadedPlateCam
from ilmek.elements.springs import CompressionSpring, choose_spring
from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.head_shape import SPRING
from ilmek.machines.weaver.motions import CENTRE_GRASP, CENTRE_MOTION, HANDLER, OPENER, SIDE_GRASP, SIDE_MOTION, SLEY
from ilmek.machines.weaver.tool_parts import part_id
from ilmek.part import catalogue
from ilmek.part.part import Part
from ilmek.records import record
from ilmek.units import mm

_LED = 1e-3
"""Factor of the length that counts for buckling: a spring on a rod does not buckle."""


@record
class SpringSeat:
    """What a spring must fit: its number, its least and greatest diameter, its greatest length [m].

    at_tool  or over the follower      at_rest  the length is that at rest, or else that at the end of the stroke
    """

    number: int
    inner: float
    outer: float
    length: float
    at_tool: bool = True
    at_rest: bool = True


SEATS = {
    SIDE_MOTION: SpringSeat(2, 5.5 * mm, 10.5 * mm, 120 * mm),
    OPENER: SpringSeat(2, 5.5 * mm, 10.5 * mm, 120 * mm),
    CENTRE_MOTION: SpringSeat(1, 5.5 * mm, 13 * mm, SPRING, at_rest=False),
    SLEY: SpringSeat(1, 5.5 * mm, 14 * mm, 120 * mm),
    SIDE_GRASP: SpringSeat(2, 2.5 * mm, 7 * mm, 12 * mm),
    CENTRE_GRASP: SpringSeat(1, 3.5 * mm, 9 * mm, 12 * mm),
    HANDLER: SpringSeat(1, 0.0, 8 * mm, 75 * mm, at_tool=False),
}
"""Of each track; assumed by this project."""


def spring_id(track: str) -> str:
    """Id of the return spring of a track."""
    return part_id(f"{track.replace(' ', '-')}-spring")


def stroke_at(cam: LoadedPlateCam) -> float:
    """Travel of a cam's spring [m]."""
    return cam.lift * _ratio(cam)


def _ratio(cam: LoadedPlateCam) -> float:
    return cam.ratio if SEATS[cam.name].at_tool else 1.0


@lru_cache(maxsize=64)
def spring_of(weaver: Weaver, track: str) -> CompressionSpring | None:
    """The return spring of a track; None: a groove needs none, or none fits."""
    cam = weaver.cam(track)
    seat, ratio = SEATS[track], _ratio(cam)
    if cam.preload <= 0:
        return None
    share = 1 / (seat.number * ratio)
    return choose_spring(
        cam.rate * share / ratio,
        cam.preload * share,
        stroke_at(cam),
        inner=seat.inner,
        outer=seat.outer,
        length=seat.length + (0.0 if seat.at_rest else stroke_at(cam)),
        end=_LED,
    )


def longest(weaver: Weaver, track: str) -> float:
    """Length of a track's spring while its follower is lowest [m]; where there is none, twice its travel."""
    cam, spring = weaver.cam(track), spring_of(weaver, track)
    return 2 * stroke_at(cam) if spring is None else spring.free_length - stroke_at(cam)


def shortest(weaver: Weaver, track: str) -> float:
    """Length of the same while its follower is highest [m]."""
    return longest(weaver, track) - stroke_at(weaver.cam(track))


@lru_cache(maxsize=64)
def spring_part(weaver: Weaver, track: str) -> Part | None:
    """A return spring, about z from z = 0, at its shortest."""
    spring = spring_of(weaver, track)
    if spring is None:
        return None
    return catalogue.spring_part(spring_id(track), f"return spring of the {track}", spring, shortest(weaver, track))


def stress_of(weaver: Weaver, track: str) -> tuple[float, float] | None:
    """Stress of a track's spring at its solid length and the allowed one [Pa]; None: there is none."""
    spring = spring_of(weaver, track)
    return None if spring is None else (spring.solid_stress, spring.allowed)

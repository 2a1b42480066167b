"""Natural frequencies of the loom's frame against the frequencies of its drives.

Across the width the columns sway as a portal with the beams across, hinged on their feet. Along the warps each side
sways on its feet, which bend between the levelling feet at their ends, with the posts of beat and rail on them. Both
are plane frames [`elements.plane_frame`]; cylinders, cams and all else that the columns carry are masses at the heights
of their axes. Brackets are taken as rigid, the heads as masses in the middle of a span of their rail, what beats as a
mass in the middle of its beam [`elements.whirl`].

What they keep their distance from: `shaking`.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import TypeAlias

from ilmek.elements.beam.model import Beam
from ilmek.elements.columns import STEEL, HollowSquare
from ilmek.elements.plane_frame import FrameMember, frame_frequencies, vibrates_above
from ilmek.elements.whirl import Mass, frequencies
from ilmek.machines.automated_loom.brackets import brackets_of
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import LoomFrame, part_id, rail_frequency
from ilmek.machines.automated_loom.rail_supports import rail_supports
from ilmek.machines.automated_loom.shaking import DISTANCE, drive_frequencies
from ilmek.machines.automated_loom.standing_frame import foot_reach
from ilmek.machines.automated_loom.steady_posts import cam_beam
from ilmek.machines.automated_loom.supports import base_section, beat_beam, floor_top, post_depth, supports
from ilmek.records import computed, record, result
from ilmek.report import Check, at_least
from ilmek.units import turn

_NEAR = 1e-6
_ROUNDING = 1e-6

_Sway: TypeAlias = tuple[list[complex], list[FrameMember], dict[int, tuple[bool, bool, bool]], dict[int, float], float]
"""A plane frame: the arguments of `frame_frequencies`."""

_HINGED = True, True, False


@record
class FrameModes:
    """Lowest natural frequencies of the frame [Hz], and the greatest frequency of a drive with its name."""

    across: float = result("Hz", "the frame sways across the width", name="frame_sway_across")
    along: float = result("Hz", "the frame sways along the warps", name="frame_sway_along")
    rail: float | None = result(
        "Hz", "the heads' rail bends between its supports", name="rail_frequency", optional=True
    )
    beam: float = result("Hz", "the beat's beam bends between its posts", name="beat_beam_frequency")
    drives: Mapping[str, float]

    fastest = computed(
        "Hz", "greatest frequency of a drive", lambda it: max(it.drives.values()), name="greatest_drive_frequency"
    )

    @property
    def checks(self) -> tuple[Check, ...]:
        """The distance of each but the rail's, which its section is chosen for [`frame`], from the drives."""
        return (
            _across_check(self.across, self.drives),
            _along_check(self.along, self.drives),
            _frequency_check("frame: beam of the beat bends", self.beam, self.drives, "beat-post"),
        )


@lru_cache(maxsize=4)
def frame_modes(loom: LoomDesign, frame: LoomFrame) -> FrameModes:
    """The natural frequencies of a loom's frame and the frequencies of its drives."""
    return FrameModes(
        across=_lowest_sway(_across(loom, frame)),
        along=_lowest_sway(_along(loom, frame)),
        rail=None if frame.rail is None else rail_frequency(frame.guide[1], frame.rail),
        beam=_beat_beam(loom),
        drives=drive_frequencies(loom),
    )


def sway_checks(loom: LoomDesign, frame: LoomFrame) -> Iterator[Check]:
    """Whether both natural frequencies of the frame as a whole keep their distance from those of the drives."""
    drives = drive_frequencies(loom)
    yield _across_check(_lowest_sway(_across(loom, frame)), drives)
    yield _along_check(_lowest_sway(_along(loom, frame)), drives)


def sways_slowly(loom: LoomDesign, frame: LoomFrame) -> bool:
    """Whether one of these checks fails; found without the frequencies. Near the limit it may be False all the same."""
    limit = (1 - _ROUNDING) * DISTANCE * max(drive_frequencies(loom).values())
    return not all(vibrates_above(*sway(loom, frame), frequency=limit) for sway in (_across, _along))


def _across_check(value: float, drives: Mapping[str, float]) -> Check:
    return _frequency_check("frame: sway across the width", value, drives, "column")


def _along_check(value: float, drives: Mapping[str, float]) -> Check:
    return _frequency_check("frame: sway along the warps", value, drives, "column")


def _frequency_check(title: str, value: float, drives: Mapping[str, float], part: str) -> Check:
    name = max(drives, key=drives.__getitem__)
    return at_least(
        f"{title}: natural frequency",
        value,
        DISTANCE * drives[name],
        "Hz",
        f"{DISTANCE:g} times the {name}, {drives[name]:.3g} Hz; assumed by this project",
    ).with_cure("set a slower beat, fewer heads, or a narrower carpet", part_id(part))


@lru_cache(maxsize=4)
def carried_masses(loom: LoomDesign) -> tuple[tuple[float, float], ...]:
    """Masses that both sides of the frame carry [kg], each with its height above the floor [m]."""
    side = loom.side
    heights = {
        "warp-tension": [side.upper.at.imag, side.spacer.at.imag, side.lower.at.imag],
        "shedding": [cam.at.imag for cam in side.cams],
        "tension-compensator": [(side.compensator.corner + side.compensator.size / 2).imag],
        "weft": [(side.carrier.corner + side.carrier.size / 2).imag],
    }
    carried: list[tuple[float, float]] = []
    for name, own in heights.items():
        machine = loom.machines.get(name)
        mass = 0.0 if machine is None else sum(machine.number * part.mass_all for part in machine.parts)
        carried += [(mass / len(own), height - side.floor) for height in own]
    for plate in brackets_of(loom).plates:
        carried.append((2 * plate.plate.volume * STEEL.density, float(plate.nodes.imag.mean()) - side.floor))
    return tuple(carried)


def _member(start: int, end: int, section: HollowSquare, number: int = 1) -> FrameMember:
    return FrameMember(start, end, number * section.area, number * section.inertia, number * section.line_mass)


@lru_cache(maxsize=64)
def _levels(loom: LoomDesign, *beams: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Heights above the floor at which a side has nodes, from its feet on, and what it carries at each [m, kg]."""
    top = loom.side.top - loom.side.floor
    masses = [(mass / 2, min(height, top)) for mass, height in carried_masses(loom)]
    levels = _apart(0.0, top, *beams, *(height for _, height in masses))
    carried = [0.0] * len(levels)
    for mass, height in masses:
        carried[_nearest(levels, height)] += mass
    return tuple(levels), tuple(carried)


def _apart(*coordinates: float) -> list[float]:
    """Coordinates of nodes in ascending order, one where several are the same but for rounding [m].

    >>> _apart(1.0, 0.0, 1.0 + 1e-15)
    [0.0, 1.000000000000001]
    """
    return [low for low, high in pairwise([*sorted(coordinates), math.inf]) if high - low > _NEAR]


def _nearest(coordinates: Sequence[float], wanted: float) -> int:
    return min(range(len(coordinates)), key=lambda k: abs(coordinates[k] - wanted))


def _lowest_sway(sway: _Sway) -> float:
    return float(frame_frequencies(*sway)[0])


def _across(loom: LoomDesign, frame: LoomFrame) -> _Sway:
    """Both columns hinged at the floor, with the beams at the floor, behind the cams and under the back rest."""
    brackets, floor = brackets_of(loom), loom.side.floor
    base = base_section(loom, frame)
    beams = {
        floor_top(loom, frame) - base.side / 2 - floor: base,
        cam_beam(loom, frame, brackets).imag - floor: frame.column,
        brackets.rest.imag - floor: brackets.beam,
    }
    levels, carried = _levels(loom, *beams)
    half, number = sum(frame.beside(brackets.face)) / frame.number, len(levels)
    nodes = [complex(x, y) for x in (-half, half) for y in levels]
    members = [
        _member(begin + k, begin + k + 1, frame.column, frame.number)
        for begin in (0, number)
        for k in range(number - 1)
    ]
    levelled = [(_nearest(levels, y), section) for y, section in beams.items()]
    members += [_member(level, number + level, section) for level, section in levelled]
    masses = dict(enumerate([*carried, *carried]))
    held = dict.fromkeys((0, number), _HINGED)
    return nodes, members, held, masses, STEEL.modulus


def _along(loom: LoomDesign, frame: LoomFrame) -> _Sway:
    """A side: its columns, on feet that bend between their ends, and the posts before the columns."""
    levels, carried = _levels(loom)
    rear, front = foot_reach(loom, frame)
    base, column = base_section(loom, frame), loom.side.column
    posts = [(depth - column, height, section, mass) for depth, height, section, mass in _posts(loom, frame)]
    feet = _apart(-rear, 0.0, front, *(min(x, front) for x, *_ in posts))
    nodes = (
        [complex(x) for x in feet] + [1j * y for y in levels[1:]] + [complex(min(x, front), h) for x, h, *_ in posts]
    )
    upright = [_nearest(feet, 0.0), *range(len(feet), len(feet) + len(levels) - 1)]
    members = [_member(k, k + 1, base, frame.number) for k in range(len(feet) - 1)]
    members += [_member(low, high, frame.column, frame.number) for low, high in pairwise(upright)]
    masses = dict(zip(upright, carried, strict=True))
    for top, (x, _, section, mass) in enumerate(posts, start=len(nodes) - len(posts)):
        members.append(_member(_nearest(feet, min(x, front)), top, section))
        masses[top] = mass
    held = dict.fromkeys((0, len(feet) - 1), _HINGED)
    return nodes, members, held, masses, STEEL.modulus


def _posts(loom: LoomDesign, frame: LoomFrame) -> Iterator[tuple[float, float, HollowSquare, float]]:
    """Posts on a side's front foot: depth, height, section, and what each carries [m, m, kg]."""
    held = supports(loom, frame)
    yield post_depth(loom, frame), held.height, held.post, sum(part.mass_all for part in loom.beat.parts) / 2
    for ends in rail_supports(loom, frame)[:1]:
        section, task = frame.guide
        rail = task.rail_mass(section) * task.width
        yield ends.depth, ends.height, ends.post, (loom.heads * task.head_mass + rail) / (2 * task.spans)


def _beat_beam(loom: LoomDesign) -> float:
    """The beat's beam on its posts, all that beats in its middle."""
    beam, _ = beat_beam(loom.beat)
    mass = sum(part.mass_all for part in loom.beat.parts) - beam.part.mass
    return _lowest(Beam(beam.span, (0.0, beam.span)), beam.section, Mass(beam.span / 2, max(mass, 0.0)))


def _lowest(beam: Beam, section: HollowSquare, mass: Mass) -> float:
    return float(frequencies(beam, STEEL.modulus * section.inertia, section.line_mass, (mass,), count=1)[0]) / turn

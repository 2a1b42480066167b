"""The commissioning list of a loom: what is measured before it weaves, with the values that its design expects.

f = sqrt(T / m') / 2 l      of a free span of a belt of the length l that is plucked, at the tension T, m' its mass
                            over its length                                        [string; makers of toothed belts]
"""

import math
from collections.abc import Iterator, Sequence

import numpy as np

from ilmek.arrays import Float
from ilmek.elements.belts import BeltDrive
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.sensors import beam_strain
from ilmek.machines.automated_loom.equipment.signals import GRID, HANDS, INTERLOCK, STOP
from ilmek.machines.automated_loom.equipment.stopping import stopping_time
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.papers.values import known, value_of
from ilmek.machines.automated_loom.papers.wiring import SIGNS, bought_of, brakes, numbers_of, plan_of
from ilmek.machines.shedding.tolerance_chain import GAUGE, STEP
from ilmek.machines.shedding.tree import stack_ends
from ilmek.machines.weaver.cam_belt import PROFILE, SMALL
from ilmek.machines.weaver.carriage_belt import BELT, CLAMP
from ilmek.machines.weaver.carriage_drive import HEADS_BELT
from ilmek.machines.weaver.drive_parts import CAM_BELT
from ilmek.machines.weaver.opener_checks import points_room
from ilmek.machines.weaver.tree import drive_of
from ilmek.part.placement import IDENTITY
from ilmek.part.space import rotations
from ilmek.part.tree import RigidBody
from ilmek.records import record
from ilmek.report import Column, Paper, PaperSection, Report, Table
from ilmek.sentences import Sentence
from ilmek.timing.cyclogram import Cyclogram
from ilmek.units import format_quantity, in_mm, mm

Setting = tuple[str, str, str, str, str]
"""What is measured, the value expected, its tolerance, the instrument, and where the value is from."""

Rows = Iterator[Setting]

_SLANTED = 0.3
"""Component of a unit vector from which a direction names it."""


def plucked(tension: float, mass: float, length: float) -> float:
    """Frequency of a free span [Hz] of a length [m] at a tension [N], mass over its length [kg/m].

    >>> plucked(100.0, 0.04, 0.5)
    50.0
    """
    return math.sqrt(tension / mass) / (2 * length)


def commissioning(loom: LoomDesign, report: Report) -> Paper:
    """The settings, the belts, the directions of the axes, the angles of both cyclograms, the safety circuit."""
    heads = (
        Column(Sentence("setting.what")),
        Column(Sentence("setting.expected")),
        Column(Sentence("setting.tolerance")),
        Column(Sentence("setting.instrument")),
        Column(Sentence("setting.source")),
    )

    def ticked(name: str, title: str, rows: Rows, text: str = "") -> PaperSection:
        return PaperSection(title, (text,) if text else (), Table(name, title, heads, tuple(rows)), boxes=True)

    knot, row = loom.cyclograms
    return Paper(
        "commissioning",
        Sentence("setting.title"),
        Sentence("setting.lead"),
        (
            ticked("stand", Sentence("setting.stand"), _stand(loom, report)),
            ticked("warp", Sentence("setting.warp"), _warp(loom, report)),
            ticked("tools", Sentence("setting.tools"), _tools(loom, report)),
            *(
                [ticked("belts", Sentence("setting.belts"), _belts(loom), Sentence("setting.plucked"))]
                if loom.heads
                else []
            ),
            _axes(loom),
            _angles(row, Sentence("setting.row", period=format_quantity(row.period, "s"))),
            _angles(knot, Sentence("setting.knot", period=format_quantity(knot.period, "s"))),
            ticked("safety", Sentence("setting.safety"), _safety(loom)),
            ticked("electrics", Sentence("setting.electrics"), _electrics(loom), Sentence("setting.electrics-how")),
        ),
    )


def _stand(loom: LoomDesign, report: Report) -> Rows:
    yield _set("level", "0.1 mm/m", "level", 0.02, "mm/m", Sentence("setting.assumed"))
    yield _set("foot", f"≤ {format_quantity(value_of(report, 'foot_load'), 'N')}", "jack", 0.05, "%", "foot_load")
    yield _set("fell", in_mm(value_of(report, "fell_height")), "rule", 2, "mm", "fell_height")
    if loom.heads:
        yield _set("rail", f"≤ {in_mm(loom.params.rail_sag)}", "wire", 0.02, "mm", "rail_sag")


def _warp(loom: LoomDesign, report: Report) -> Rows:
    tension, warps = value_of(report, "tension"), value_of(report, "warps")
    strain = f"{beam_strain(loom) * 1e6:.4g} µm/m"
    yield _set("tension", format_quantity(tension, "N"), "tension-meter", 0.1, "%", "tension")
    yield _set("pull", format_quantity(tension * warps, "N"), "strain-reading", 0.05, "%", f"{warps} × tension")
    yield _set("strain", strain, "strain-reading", 0.05, "%", "tension")
    yield from _cam_stacks(loom)
    opening = value_of(report, "shedding.shed_opening")
    yield _set("shed", in_mm(opening), "rule", 1, "mm", "shedding.shed_opening")
    room = f"≥ {in_mm(loom.shedding.params.shuttle_height)}"
    yield _set("room", room, "block", 0.1, "mm", "shedding.shuttle_height")
    lifted = known(report, "warp_tension.tension_lifted")
    if lifted is not None:
        most = f"≤ {format_quantity(lifted, 'N')}"
        yield _set("lifted", most, "tension-meter", 0.1, "%", "warp_tension.tension_lifted")


def _cam_stacks(loom: LoomDesign) -> Rows:
    """Of each shaft: where the cams stand along it, how long they are together, how they are clamped."""
    design, number = loom.shedding, loom.shedding.chain.interval
    for index, shaft in enumerate(design.shafts):
        low, high = stack_ends(design, index)
        more = Sentence("setting.stack-more", length=in_mm(number * shaft.stack.shares.pitch))
        piles, words = Sentence("setting.stack-piles", number=str(number)), {"shaft": str(index + 1)}
        within = STEP / 2 + GAUGE
        yield _set("stack", more, "depth", within / mm, "mm", piles, **words)
        yield _set("stack-length", in_mm(high - low), "depth", within / mm, "mm", piles, **words)
        torque = format_quantity(shaft.nut.torque, "Nm", 3)
        yield _set("locknut", torque, "torque", 0.1, "%", shaft.nut.designation, **words)


def _tools(loom: LoomDesign, report: Report) -> Rows:
    """Strokes, heights and clearances, of those that this loom has."""
    lengths = (
        ("beat-stroke", "beat_stroke", "rule", 1.0),
        ("row-pitch", "row_pitch_left", "rule", 0.1),
        ("weft-height", "weft_height", "rule", 1.0),
        ("retreat", "head_retreat", "rule", 1.0),
        ("pair", "weaver.pair_opened", "calliper", 0.1),
        ("gripper", "weaver.gripper_clearance", "feeler", 0.05),
        ("behind", "weaver.centre_depth", "calliper", 0.1),
    )
    found = ((key, name, tool, error, known(report, name)) for key, name, tool, error in lengths)
    for key, name, tool, error, value in found:
        if value is not None:
            yield _set(key, in_mm(value), tool, error, "mm", name)
    if loom.heads:
        points = f"≤ {in_mm(points_room(loom.weaver))}"
        yield _set("points", points, "calliper", 0.02, "mm", "warp_pitch")
        pull = f"≤ {format_quantity(value_of(report, 'yarn_tension'), 'N')}"
        yield _set("yarn", pull, "tension-meter", 0.1, "%", "yarn_tension")
        brake = format_quantity(value_of(report, "yarn_brake"), "N")
        yield _set("brake", brake, "tension-meter", 0.1, "%", "yarn_brake")


def _set(  # noqa: PLR0917 - the columns of a row
    key: str, expected: str, instrument: str, error: float, unit: str, source: str, **words: str
) -> Setting:
    """A setting by the keys of its sentence and of its instrument's, with its tolerance ± in a unit; "%": a share."""
    tolerance = f"± {error:.0%}" if unit == "%" else f"± {error:g} {unit}"
    return Sentence(f"setting.{key}", **words), expected, tolerance, Sentence(f"instrument.{instrument}"), source


@record
class BeltSpan:
    """A free span of a belt: id of the belt, title, tension at rest [N], frequency of the span [Hz]."""

    part: str
    title: str
    tension: float
    frequency: float


def belts(loom: LoomDesign) -> Iterator[BeltSpan]:
    """The belts of the heads with their tension at rest, and the frequency of a span by which it is measured."""
    if not loom.heads:
        return
    head, heads = loom.weaver, loom.heads
    drive = drive_of(head)
    tension, span = drive.force * (heads + 1) / 2, head.belt_length - 2 * CLAMP - heads * loom.head_width
    title = Sentence("setting.heads-belt", span=in_mm(span), tension=format_quantity(tension, "N", 3))
    yield BeltSpan(HEADS_BELT, title, tension, plucked(tension, BELT.belt.mass * drive.width, span))
    part = next(part for part, _ in loom_tree(loom).occurrences() if part.id == CAM_BELT)
    assert part.purchase is not None
    teeth = round(part.purchase.length / PROFILE.pitch)
    made = BeltDrive(PROFILE, SMALL, head.belt.large, teeth)
    free = math.sqrt(made.distance**2 - (made.radii[1] - made.radii[0]) ** 2)
    rest = head.belt.pull / 2
    title = Sentence("setting.cam-belt", span=in_mm(free), tension=format_quantity(rest, "N", 3))
    yield BeltSpan(CAM_BELT, title, rest, plucked(rest, PROFILE.mass * head.belt.width, free))


def _belts(loom: LoomDesign) -> Rows:
    named = {part.id: part.designation for part, _ in loom_tree(loom).occurrences() if part.purchase}
    return (
        (own.title, format_quantity(own.frequency, "Hz", 3), "± 5%", Sentence("instrument.frequency"), named[own.part])
        for own in belts(loom)
    )


def _electrics(loom: LoomDesign) -> Rows:
    """What is measured before the first motion: protective conductor, insulation, voltages, brakes."""
    yield _set("protective", "≤ 0.1 Ω", "ohmmeter", 0.01, "Ω", "IEC 60204-1, 18.2")
    yield _set("insulation", "≥ 1 MΩ", "insulation-meter", 0.1, "%", "IEC 60204-1, 18.3")
    for own in plan_of(loom).sources:
        title = Sentence("setting.voltage", sign=SIGNS[own.part])
        meter = Sentence("instrument.voltmeter")
        yield title, f"{own.row.volts:g} V", "± 5%", meter, f"{own.number} × {own.row.name}"
    numbers = numbers_of(loom)
    for _, sign, part in brakes(loom):
        title = Sentence("setting.held", sign=sign, part=part.title)
        count = Sentence("setting.each", count=numbers[part.id])
        yield title, count, "± 0.1 mm", Sentence("instrument.dial"), bought_of(part).row


def _axes(loom: LoomDesign) -> PaperSection:
    """The direction in which each axis that a motor drives goes first, and how far."""
    tree = loom_tree(loom)
    world = rotations(tree, IDENTITY)
    titles = {part.id: part.title for part, _ in tree.occurrences()}
    rows = [row for body in tree.bodies if body.joint.motor for row in _axis(body, world[body.id], titles)]
    heads = (
        Column(Sentence("setting.body")),
        Column(Sentence("setting.motor")),
        Column(Sentence("setting.direction")),
        Column(Sentence("setting.range")),
    )
    title = Sentence("setting.axes")
    return PaperSection(title, (Sentence("setting.axes-how"),), Table("axes", title, heads, tuple(rows)), boxes=True)


def _axis(
    body: RigidBody, rotation: Float[np.ndarray, "3 3"], titles: dict[str, str]
) -> Iterator[tuple[str, str, str, str]]:
    motion = body.joint.motion
    if motion is None:
        return
    name, moved = body.id.rpartition("/")[2], motion.shift - motion.shift[0]
    far = np.linalg.norm(moved, axis=1)
    turned = motion.rotation - motion.rotation[0]
    if far.max() > 0:
        first, travel = moved[int(np.argmax(far))], format_quantity(float(far.max()), "mm")
        yield name, titles[body.joint.motor], direction(rotation @ first), travel
    elif np.ptp(turned) > 0:
        sign = np.sign(turned[int(np.argmax(np.abs(turned)))])
        axis = direction(rotation @ np.array(body.joint.axis) * sign)
        yield (
            name,
            titles[body.joint.motor],
            Sentence("setting.about", axis=axis),
            format_quantity(float(np.ptp(turned)), "deg"),
        )


def direction(vector: Sequence[float] | Float[np.ndarray, " 3"]) -> str:
    """A direction in words: x to the right, y up, z to the front.

    >>> print(direction((0.0, -1.0, 1.0)))
    down, to the front
    """
    names = (
        (Sentence("direction.right"), Sentence("direction.left")),
        (Sentence("direction.up"), Sentence("direction.down")),
        (Sentence("direction.front"), Sentence("direction.back")),
    )
    unit = np.asarray(vector) / np.linalg.norm(vector)
    words = [
        pair[0] if own > 0 else pair[1] for pair, own in zip(names, unit.tolist(), strict=True) if abs(own) > _SLANTED
    ]
    text = words[0]
    for word in words[1:]:
        text = Sentence("direction.both", first=text, second=word)
    return text


def _angles(cyclogram: Cyclogram, title: str) -> PaperSection:
    """Begin and end of each motion over the turn of the master."""
    heads = (
        Column(Sentence("setting.track")),
        Column(Sentence("setting.motion")),
        Column(Sentence("setting.begins"), "deg"),
        Column(Sentence("setting.ends"), "deg"),
    )
    rows = tuple(
        (track.name, segment.name, segment.start, segment.end)
        for track in cyclogram.tracks
        for segment in track.segments
    )
    return PaperSection(title, (Sentence("setting.angles-how"),), Table("angles", title, heads, rows), boxes=True)


def _safety(loom: LoomDesign) -> Rows:
    stops, numbers = stopping_time(loom), {part.id: number for part, number in loom_tree(loom).occurrences()}
    for part, title in (
        (STOP, Sentence("setting.stops")),
        (INTERLOCK, Sentence("setting.interlocks")),
        (GRID, Sentence("setting.grid")),
        (HANDS, Sentence("setting.hands")),
    ):
        if part in numbers:
            count = Sentence("setting.each", count=numbers[part])
            yield title, count, "–", Sentence("instrument.trial"), part
    for axis in stops.axes:
        limit = format_quantity(stops.circuit + stops.axes[axis], "s", 3)
        stand, source = Sentence("setting.stands", axis=axis), Sentence("setting.circuit")
        yield stand, f"≤ {limit}", "± 0.01 s", Sentence("instrument.stop-meter"), source

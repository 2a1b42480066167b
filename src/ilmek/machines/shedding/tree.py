"""The shedding cams as bodies: every shaft with its cams, guide cams and spacers, and what carries and drives it.

Axes of a shaft as in the side view: x to the front, y up, z along the width to the weaver's left, 0 in the middle of
the warps. The rule of the outline: the point at the polar angle a of a cam is under the warp at the cam angle -a, so
that a cam turns by its angle about z. Even and odd cams are one plate: half a turn of the square bore is the square
again. Of staggered cams each group has a plate of its own, its bore turned by the lag of the group.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import BoolArray, ComplexArray, FloatArray, IntArray
from ilmek.cams.programme import TURN
from ilmek.elements.materials import MATERIALS, Material
from ilmek.elements.reducers import REDUCER_FLANGES
from ilmek.machines.shaft_stand import CarriedShaft, shaft_stand, stand_heights
from ilmek.machines.shedding.cam_shaft import RING, CamShaft
from ilmek.machines.shedding.design import SheddingDesign
from ilmek.machines.shedding.reed import Reed, dent, reed_of
from ilmek.machines.shedding.stack import POINTS, cam_outline, part_id
from ilmek.machines.shedding.steady import steadies
from ilmek.machines.shedding.tolerance_chain import SHIMS, STEP, tolerance_chain
from ilmek.part import catalogue
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Shape, Sum
from ilmek.part.shapes import bar as round_bar
from ilmek.part.tree import GROUND, Joint, JointKind, Occurrence, RigidBody, Tree
from ilmek.plane.contours import circle, keyed_bore, polygon
from ilmek.report import Contour
from ilmek.report.scene import SceneMotion
from ilmek.sentences import Sentence
from ilmek.units import in_mm, mm, turn

_INSIDE, _LOOSE = 1 * mm, 0.25 * mm
"""By how much the square ends inside of the cams, so that the nuts press the rings on these, and play of a ring about
the thread [m]; assumed by this project.
"""

_CUT, _ALONG = "laser-cut part", (0.0, 0.0, 1.0)


def warp_positions(design: SheddingDesign) -> FloatArray:
    """Positions of the warps along the width to the weaver's right, 0 in their middle [m]."""
    number = design.params.cloth.warps
    return (np.arange(number) - (number - 1) / 2) * design.params.cloth.warp_pitch


def warp_shafts(design: SheddingDesign) -> tuple[IntArray, BoolArray]:
    """Number of the shaft of each warp, and whether it is an odd one; the first is (see `shedding.positions.dealt`)."""
    index = np.arange(design.params.cloth.warps)
    return index % len(design.shafts), index % 2 == 0


def tree(
    design: SheddingDesign,
    positions: Sequence[Placement] = (),
    turning: SceneMotion | None = None,
    sinking: SceneMotion | None = None,
) -> Tree:
    """The bodies of the shafts.

    positions  of each shaft's axes; default: one above the other, as on their stand
    turning, sinking   motions of the shafts about their axes, and of all that is on them; default: they stand
    """
    where = positions or [placement(y=height) for height in stand_heights(_carried(design))]
    bodies = [
        body
        for index, position in enumerate(where)
        for body in _of_shaft(design, index, position, Joint(JointKind.PIN, _ALONG, turning), sinking)
    ]
    return Tree(tuple(bodies))


def stand(design: SheddingDesign) -> Tree:
    """What carries the shafts of the machine alone."""
    return shaft_stand(part_id, _carried(design))


def _carried(design: SheddingDesign) -> tuple[CarriedShaft, ...]:
    """The shafts, as their stand carries them: the cams with their guides take up room beside their axes."""
    return tuple(
        CarriedShaft(
            _numbered(design, index, "cam shaft"),
            f"shaft-{index + 1}",
            shaft.seat,
            bearing_inner(design, index),
            max(shaft.stack.guide_radius, front_of(design, index), catalogue.face_of(reducer(design, index)) / 2),
            catalogue.screwed_radius(reducer(design, index)),
        )
        for index, shaft in enumerate(design.shafts)
    )


def _of_shaft(
    design: SheddingDesign, index: int, position: Placement, pin: Joint, sinking: SceneMotion | None
) -> tuple[RigidBody, RigidBody]:
    """What carries a shaft, and the shaft with all that turns on it. Its bearings stand on
    brackets of the frame.
    """
    parts = (*_reed(design, index), *_bearings(design, index), *_drive(design, index))
    joint = Joint(motion=sinking) if sinking is None else Joint(JointKind.SLIDE, motion=sinking)
    standing = RigidBody(part_id("stand", index), parts, GROUND, joint, (position,))
    return standing, RigidBody(
        part_id("cam shaft", index), _turning(design, index), standing.id, replace(pin, motor=part_id("motor", index))
    )


@lru_cache(maxsize=16)
def _turning(design: SheddingDesign, index: int) -> tuple[Occurrence, ...]:
    """All that turns with a shaft: thousands of placements, made once for list, mass, price and space."""
    return tuple(_on_the_bar(design, index))


def _on_the_bar(design: SheddingDesign, index: int) -> Iterator[Occurrence]:
    """The square bar, cams by groups, guide cams on both sides of the warps, and spacers."""
    shaft = design.shafts[index]
    stack = shaft.stack
    yield Occurrence(_bar(design, index), (placement(z=-bearing_inner(design, index)),))
    end, title = shaft.driven_end, _numbered(design, index, "key of the cam shaft")
    far = bearing_inner(design, index) + shaft.seat.journal + end.length
    yield catalogue.keys(part_id("key", index), title, end, placement(z=-far))
    x, odd = _of(design, index)
    group, lag = _groups(shaft, odd)
    for number in range(shaft.shed.groups):
        chosen = group == number
        phases = np.where(odd[chosen], turn / 2, 0.0) + lag[chosen]
        yield Occurrence(_cam(design, index, number), _row(x[chosen], stack.thickness, phases))
    yield from _guides_and_spacers(design, index, x)
    yield from _clamped(design, index)


def _clamped(design: SheddingDesign, index: int) -> Iterator[Occurrence]:
    """Pressure ring, tab washer and nut at both ends of the cams."""
    nut, (low, high) = design.shafts[index].nut, stack_ends(design, index)
    radius, bore = design.shafts[index].shaft.bar, circle(0j, nut.thread / 2 + _LOOSE)
    shape = Prism(Profile(circle(0j, radius), (bore,)), RING)
    ring = _made(design, index, "pressure-ring", "pressure ring of the cams", shape, _CUT)
    named = ("tab-washer", "tab washer of the cams"), ("locknut", "locknut of the cams")
    washer, locknut = (
        catalogue.locked(part_id(name, index), _numbered(design, index, title), nut, washer=name == "tab-washer")
        for name, title in named
    )
    beyond = 0.0
    for part, thick in ((ring, RING), (washer, nut.washer), (locknut, nut.width)):
        yield Occurrence(part, _row(np.array([low - beyond - thick / 2, high + beyond + thick / 2]), thick))
        beyond += thick


def _guides_and_spacers(design: SheddingDesign, index: int, x: FloatArray) -> Iterator[Occurrence]:
    """Guide cams and spacers beside the cams at x [m]; at their places shims stand for a part of one, or the whole."""
    shaft = design.shafts[index]
    shares, radius, rest = shaft.stack.shares, shaft.stack.guide_radius, shaft.base_radius
    chain = tolerance_chain(shaft.params, shares)
    shimmed = np.arange(1, len(x) + 1) % chain.interval == 0
    shimmed[-1] = False
    wide = shares.guide
    if shares.guides and not shares.spacer:
        after, thin = x + (shares.thickness + wide) / 2, wide - chain.shims
        full = np.concatenate([x[:1] - (shares.thickness + wide) / 2, after[~shimmed]])
        yield from _discs(design, index, ("guide-cam", "guide cam"), radius, wide, full)
        shift = (wide - thin) / 2
        places = after[shimmed]
        yield from _discs(design, index, ("thin-guide-cam", "guide cam beside shims"), radius, thin, places - shift)
        yield from _shims(design, index, radius, chain.shims, places + thin / 2)
        return
    if shares.guides:
        yield from _discs(design, index, ("guide-cam", "guide cam"), radius, wide, _guides(x, shaft))
    beside = x + (shares.thickness + shares.spacer) / 2 + shares.guides / 2 * wide
    yield from _discs(design, index, ("spacer", "spacer of the cams"), rest, shares.spacer, beside[~shimmed])
    yield from _shims(design, index, rest, shares.spacer, beside[shimmed])


def _shims(design: SheddingDesign, index: int, radius: float, thickness: float, x: FloatArray) -> Iterator[Occurrence]:
    """Piles of shims at x [m], each chosen when the stack is built."""
    kit = ", ".join(f"{size / mm:g}" for size in SHIMS if size <= thickness + 1e-9)
    note = Sentence("sheet.shims", kit=kit, most=in_mm(2 * thickness), step=in_mm(STEP))
    for pile in _discs(design, index, ("shims", "shims of the cams"), radius, thickness, x):
        yield replace(pile, part=replace(pile.part, notes=(note,), yarns=False))


def _discs(  # noqa: PLR0917
    design: SheddingDesign, index: int, names: tuple[str, str], radius: float, thickness: float, x: FloatArray
) -> Iterator[Occurrence]:
    """Round plates of a thickness at x [m]; none without a thickness or a place."""
    if thickness > 0 and len(x):
        yield Occurrence(_disc(design, index, names, radius, thickness), _row(x, thickness))


def stack_ends(design: SheddingDesign, index: int) -> tuple[float, float]:
    """Both ends of the cams with their guides and spacers along the width [m]."""
    stack, (x, _) = design.shafts[index].stack, _of(design, index)
    guide, spacer = min(stack.shares.guides, 1) * stack.guide_thickness, stack.shares.spacer
    beside = stack.thickness / 2 + guide
    between = stack.thickness / 2 + stack.shares.guides / 2 * stack.guide_thickness + spacer if spacer > 0 else 0.0
    return float(x[0]) - beside, float(x[-1]) + max(beside, between)


def bearing_inner(design: SheddingDesign, index: int) -> float:
    """Inner side of a shaft's bearing from the middle of the width [m]: it stands at the shaft's support, or beyond the
    nut that clamps the cams.
    """
    shaft = design.shafts[index]
    ends = max(abs(end) for end in stack_ends(design, index))
    return max((shaft.shaft.length - shaft.seat.bearing.width) / 2, ends + shaft.beyond_cams)


def _bar(design: SheddingDesign, index: int) -> Part:
    """The square bar in the cams, with a thread, a neck and a journal at both ends through bearing and bracket.

    The inner side of a bearing is at z = 0. The driven end reaches into its reducer, where a key holds it.
    """
    shaft = design.shafts[index]
    bar, nut, beyond, end = shaft.shaft.bar, shaft.nut, shaft.seat.journal, shaft.driven_end
    inner, (low, high) = bearing_inner(design, index), stack_ends(design, index)
    begin, last, long = inner - high + _INSIDE, inner - low - _INSIDE, 2 * inner
    threaded = RING + _INSIDE + nut.washer + nut.width + nut.pitch
    thread = Prism(Profile(keyed_bore(nut.thread / 2, nut.tab, nut.groove - nut.thread / 2)), threaded)
    slim = max(min(math.floor((nut.thread - 1.2268 * nut.pitch) / mm) * mm, shaft.screws_inside), mm)
    necks = ((z, length) for z, length in ((0.0, begin - threaded), (last + threaded, long - last - threaded)))
    shape = Sum(
        (
            Placed(Prism(Profile(_square(bar)), last - begin), (placement(z=begin),)),
            Placed(thread, (placement(z=begin - threaded), placement(z=last))),
            *(Placed(round_bar(slim, length), (placement(z=z),)) for z, length in necks if length > _LEAST_NECK),
            Placed(round_bar(shaft.seat.bearing.bore, beyond), (placement(z=long), placement(z=-beyond))),
            Placed(catalogue.keyed_journal(end), (placement(z=-beyond - end.length),)),
        )
    )
    return _made(design, index, "cam-shaft", "cam shaft", shape, "steel bar")


_LEAST_NECK = 1e-6
"""Length below which there is no neck [m]."""


def _guides(x: FloatArray, shaft: CamShaft) -> FloatArray:
    """Positions of the guide cams on both sides of each cam."""
    beside = (shaft.stack.thickness + shaft.stack.guide_thickness) / 2
    return np.concatenate([x - beside, x + beside])


def _cam(design: SheddingDesign, index: int, group: int) -> Part:
    """The cam of a group, its bore turned by the group's lag."""
    shaft, several = design.shafts[index], design.shafts[index].shed.groups > 1
    bar, outline = shaft.shaft.bar, cam_outline(shaft.cam)
    name, title = (
        (f"shedding-cam-{group + 1}", f"shedding cam, group {group + 1}")
        if several
        else ("shedding-cam", "shedding cam")
    )
    bores = (_square(bar, float(shaft.shed.offsets[group])),) if _bored(shaft) else ()
    shape = Prism(Profile(polygon(outline), bores, smooth=True), shaft.stack.thickness)
    made = _made(design, index, name, title, shape, _CUT)
    pitch = shaft.cam.pitch(-np.arange(POINTS) * (TURN / POINTS)) if shaft.cam.roller_radius > 0 else None
    return replace(
        made,
        yarns=True,
        marks={"zero": np.array([bar / 2 + 0j, complex(outline[0])])},
        paths={} if pitch is None else {"pitch curve": pitch},
    )


def _disc(design: SheddingDesign, index: int, names: tuple[str, str], radius: float, thickness: float) -> Part:
    """A round plate with the square bore."""
    shaft = design.shafts[index]
    bar = shaft.shaft.bar
    bores = (_square(bar),) if _bored(shaft) else ()
    shape = Prism(Profile(circle(0j, radius), bores), thickness)
    made = _made(design, index, *names, shape, _CUT)
    return replace(made, yarns=radius > shaft.base_radius, marks={"zero": np.array([bar / 2 + 0j, radius + 0j])})


@lru_cache(maxsize=32)
def reed(design: SheddingDesign, index: int) -> Reed | None:
    """The reed of a shaft; None where guide cams turn."""
    return reed_of(design.shafts[index], design.params.cloth.warps, bearing_inner(design, index))


def front_of(design: SheddingDesign, index: int) -> float:
    """The front of a shaft's guide cams or reed before its axis [m]."""
    own = reed(design, index)
    return design.shafts[index].stack.guide_radius if own is None else own.front


def _reed(design: SheddingDesign, index: int) -> Iterator[Occurrence]:
    """Dents between the warps, where no guide cams turn, with baulks and arms."""
    shaft, own = design.shafts[index], reed(design, index)
    if own is None:
        return
    made = replace(_made(design, index, "reed-dent", "dent of the reed", dent(shaft), _CUT), yarns=True)
    x, pitch = warp_positions(design), design.params.cloth.warp_pitch
    yield Occurrence(made, _row(np.append(x - pitch / 2, x[-1] + pitch / 2), shaft.stack.guide_thickness))
    shape = Prism(Profile(_square(own.side)), own.length)
    baulk = _made(design, index, "reed-baulk", "baulk of the reed", shape, "steel bar")
    yield Occurrence(baulk, tuple(placement(z.real, z.imag, -own.length / 2) for z in own.axes))
    arm = _made(design, index, "reed-arm", "arm of the reed", own.arm, _CUT)
    yield Occurrence(arm, tuple(placement(z=z) for z in (own.length / 2, -own.length / 2 - catalogue.FLANGE)))


def _bearings(design: SheddingDesign, index: int) -> Iterator[Occurrence]:
    """The bearings at both ends, and the steadies of rollers between the spans."""
    shaft = design.shafts[index]
    inner = bearing_inner(design, index)
    flipped = placement(z=-inner, about=(1.0, 0.0, 0.0), angle=math.pi)
    ids = part_id("bearing", index), part_id("housing", index)
    title = _numbered(design, index, "bearing of the cam shaft")
    yield from shaft.seat.occurrences(ids, title, (placement(z=inner), flipped))
    yield from steadies(shaft, part_id("steady", index), _numbered(design, index, "steady of the cam shaft"))


@lru_cache(maxsize=16)
def reducer(design: SheddingDesign, index: int) -> Part:
    """The reducer on the driven end of a shaft, outside of its bracket: of a class whose screws keep off the seat's."""
    shaft, title = design.shafts[index], _numbered(design, index, "reducer of the cam shaft")
    drive = shaft.drive.reducer, shaft.drive.motor, shaft.driven_end
    faces = (0.0, *(row.face for row in REDUCER_FLANGES if row.number == len(shaft.seat.corners())))
    parts = [catalogue.reducer(part_id("reducer", index), title, *drive, least=face) for face in faces]
    return next((one for one in parts if shaft.seat.turned(one) is not None), parts[0])


def _drive(design: SheddingDesign, index: int) -> Iterator[Occurrence]:
    """Reducer and motor at the right end, one behind the other: their position there is assumed by this project."""
    shaft = design.shafts[index]
    drive, geared = shaft.drive, reducer(design, index)
    motor = catalogue.motor(
        part_id("motor", index),
        _numbered(design, index, "motor of the cam shaft"),
        drive.motor,
        drive.motor_torque,
        drive.motor_speed,
        rear=index == 0,  # for the encoder of the shed
    )
    far = bearing_inner(design, index) + shaft.seat.through + catalogue.length_of(geared)
    flange = placement(z=-far, about=_ALONG, angle=shaft.seat.turned(geared) or 0.0)
    yield Occurrence(geared, (flange,))
    yield Occurrence(motor, (flange,))


def _made(  # noqa: PLR0917
    design: SheddingDesign, index: int, name: str, title: str, shape: Shape, process: str
) -> Part:
    return Part(part_id(name, index), _numbered(design, index, title), process, shape, _steel(design))


def _steel(design: SheddingDesign) -> Material:
    return replace(MATERIALS["structural steel"], density=design.params.density)


def _numbered(design: SheddingDesign, index: int, title: str) -> str:
    """A title with the number of the shaft where there are several."""
    return f"{title} {index + 1}" if len(design.shafts) > 1 else title


def _square(side: float, turned: float = 0.0) -> Contour:
    """A square bore, turned by an angle [rad]."""
    corners: ComplexArray = side / 2 * np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j]) * np.exp(1j * turned)
    return polygon(corners)


def _bored(shaft: CamShaft) -> bool:
    """Whether the bore has room in the cam: where it has none, a check fails."""
    return shaft.shaft.bar / math.sqrt(2) < shaft.base_radius


def _of(design: SheddingDesign, index: int) -> tuple[FloatArray, BoolArray]:
    """Positions of the warps of a shaft [m], and which of them are odd."""
    shaft, odd = warp_shafts(design)
    return warp_positions(design)[shaft == index], odd[shaft == index]


def _groups(shaft: CamShaft, odd: BoolArray) -> tuple[IntArray, FloatArray]:
    """Number and lag [rad] of each cam's group: those of a parity are taken in turn along the shaft."""
    order = np.where(odd, np.cumsum(odd) - 1, np.cumsum(~odd) - 1).astype(int)
    group = order % shaft.shed.groups
    return group, np.asarray(shaft.shed.offsets)[group]


def _row(x: FloatArray, thickness: float, phases: FloatArray | None = None) -> tuple[Placement, ...]:
    """Plates with their middles at positions along the width, turned back by phases [rad]."""
    back = np.zeros(len(x)) if phases is None else -phases
    return tuple(
        placement(z=-position - thickness / 2, about=_ALONG, angle=angle)
        for position, angle in zip(x.tolist(), back.tolist(), strict=True)
    )

"""The shedding cams' parts for the workshop, and the warps' motions for a controller.

Even and odd cams are one plate: half a turn of the square bore is the square again. Of staggered cams each group has a
plate of its own, its bore turned by the lag of the group. Each of several shafts has its own plates.
"""

import math
from dataclasses import replace

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.limits import area
from ilmek.cams.opposed_cams import turn_knots
from ilmek.cams.programme import TURN, CamProgramme
from ilmek.machines.shedding.cam_shaft import CamShaft
from ilmek.machines.shedding.design import SheddingDesign
from ilmek.report import CamTable, Plate

STEEL = "structural steel"
POINTS = 1440


def plates(design: SheddingDesign) -> tuple[Plate, ...]:
    """Cam, guide cam or dent, and spacer of every shaft; none of a shaft where the bore does not fit into the cam.

    The cams of the first shaft have no number; those of the others have that of their shaft.
    """
    made: list[Plate] = []
    for index, one in enumerate(design.shafts):
        if one.shaft.bar / math.sqrt(2) >= one.base_radius:
            continue
        suffix = f"-shaft-{index + 1}" if index else ""
        for plate in (*_cams(one), *_guides(design, one), *_spacers(one)):
            named = f"{plate.title}, shaft {index + 1}" if index else plate.title
            made.append(replace(plate, name=f"{plate.name}{suffix}", title=named))
    return tuple(made)


def _cams(one: CamShaft) -> tuple[Plate, ...]:
    cam, stack, bar = one.cam, one.stack, one.shaft.bar
    angle = -np.arange(POINTS) * (TURN / POINTS)
    outline = cam.surface(angle)
    mark = np.array([bar / 2 + 0j, complex(outline[0])])
    numbers = [even + odd for even, odd in zip(one.shed.even.numbers, one.shed.odd.numbers, strict=True)]
    offsets = one.shed.offsets.tolist()
    return tuple(
        Plate(
            name="shedding-cam" if len(numbers) == 1 else f"shedding-cam-{index + 1}",
            title="Shedding cam" if len(numbers) == 1 else f"Shedding cam, group {index + 1}",
            outline=outline,
            thickness=stack.thickness,
            material=STEEL,
            cutouts=(_square(bar, lag),),
            paths={"pitch curve": cam.pitch(angle)} if cam.roller_radius > 0 else {},
            marks={"zero": mark},
            area=area(cam),
            number=number,
        )
        for index, (number, lag) in enumerate(zip(numbers, offsets, strict=True))
    )


def _guides(design: SheddingDesign, one: CamShaft) -> tuple[Plate, ...]:
    """The guide cam, or the dent of the reed: a ring from the warps' line over the tip and back to it."""
    stack, outer = one.stack, one.stack.guide_radius
    if stack.shares.guides:
        return (_disc("guide-cam", "Guide cam", (outer, stack.guide_thickness), one, stack.shares.guides),)
    half, inner = math.acos(min(one.base_radius / outer, 1.0)), outer - one.params.guide_height
    sweep = np.exp(1j * np.linspace(-half, half, POINTS // 4))
    outline = np.concatenate([outer * sweep, inner * sweep[::-1]])
    if one.params.guide_height <= 0:
        return ()
    return (
        Plate(
            name="reed-dent",
            title="Dent of the reed",
            outline=outline,
            thickness=stack.guide_thickness,
            material=STEEL,
            area=half * (outer**2 - inner**2),
            number=design.params.warps + 1,
        ),
    )


def _spacers(one: CamShaft) -> tuple[Plate, ...]:
    """The ring beside a cam that is no guide cam, where there is one."""
    thickness = one.stack.shares.spacer
    return (_disc("spacer", "Spacer of the cams", (one.base_radius, thickness), one, 1),) if thickness > 0 else ()


def _disc(name: str, title: str, size: tuple[float, float], one: CamShaft, number: int) -> Plate:
    """A round plate of a radius and a thickness [m] with the square bore, so many for each cam of a shaft."""
    bar, (radius, thickness) = one.shaft.bar, size
    return Plate(
        name=name,
        title=title,
        outline=radius * np.exp(1j * np.arange(POINTS) * (TURN / POINTS)),
        thickness=thickness,
        material=STEEL,
        cutouts=(_square(bar, 0.0),),
        marks={"zero": np.array([bar / 2 + 0j, radius + 0j])},
        area=math.pi * radius**2,
        number=number * sum(one.numbers),
    )


def _square(side: float, turned: float) -> ComplexArray:
    """Corners of a square bore, counter-clockwise, turned by an angle [rad]."""
    return np.asarray(side / 2 * np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j]) * np.exp(1j * turned))


def cam_tables(design: SheddingDesign) -> tuple[CamTable, ...]:
    """The motions of even and odd warps, of each group and each shaft."""
    return tuple(
        _motion(
            design,
            f"{parity}-warps"
            + (f"-{group + 1}" if one.shed.groups > 1 else "")
            + (f"-shaft-{index + 1}" if index else ""),
            programme,
        )
        for index, one in enumerate(design.shafts)
        for parity, cams in (("even", one.shed.even), ("odd", one.shed.odd))
        if sum(cams.numbers) > 0
        for group, programme in enumerate(cams.programmes)
    )


def _motion(design: SheddingDesign, name: str, programme: CamProgramme) -> CamTable:
    def motion(angle: FloatArray) -> FloatArray:
        return np.stack(programme.at(angle)[:3])

    title = f"Lift of the {name.replace('-', ' ')} over the cam shaft's angle"
    return CamTable(name, title, motion, turn_knots(programme), "mm", TURN / design.params.speed)

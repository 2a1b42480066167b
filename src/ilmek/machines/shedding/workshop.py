"""The shedding cams' parts for the workshop, and the warps' motions for a controller.

Even and odd cams are one plate: half a turn of the square bore is the square again. Of staggered cams each group has a
plate of its own, its bore turned by the lag of the group.
"""

import math

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.limits import area
from ilmek.cams.opposed_cams import turn_knots
from ilmek.cams.programme import TURN, CamProgramme
from ilmek.machines.shedding.design import SheddingDesign
from ilmek.report import CamTable, Plate

STEEL = "structural steel"
POINTS = 1440


def plates(design: SheddingDesign) -> tuple[Plate, ...]:
    """Cam and guide cam; none where the bore does not fit into the cam."""
    bar, cam = design.shaft.bar, design.cam
    if bar / math.sqrt(2) >= cam.prime_radius - cam.roller_radius:
        return ()
    return (*_cams(design), _guide(design))


def _cams(design: SheddingDesign) -> tuple[Plate, ...]:
    cam, stack, bar = design.cam, design.stack, design.shaft.bar
    angle = -np.arange(POINTS) * (TURN / POINTS)
    outline = cam.surface(angle)
    mark = np.array([bar / 2 + 0j, complex(outline[0])])
    numbers = [even + odd for even, odd in zip(design.shed.even.numbers, design.shed.odd.numbers, strict=True)]
    offsets = design.shed.offsets.tolist()
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


def _guide(design: SheddingDesign) -> Plate:
    stack, bar = design.stack, design.shaft.bar
    circle = stack.guide_radius * np.exp(1j * np.arange(POINTS) * (TURN / POINTS))
    return Plate(
        name="guide-cam",
        title="Guide cam",
        outline=circle,
        thickness=stack.guide_thickness,
        material=STEEL,
        cutouts=(_square(bar, 0.0),),
        marks={"zero": np.array([bar / 2 + 0j, stack.guide_radius + 0j])},
        area=math.pi * stack.guide_radius**2,
        number=design.params.warps,
    )


def _square(side: float, turned: float) -> ComplexArray:
    """Corners of a square bore, counter-clockwise, turned by an angle [rad]."""
    return np.asarray(side / 2 * np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j]) * np.exp(1j * turned))


def cam_tables(design: SheddingDesign) -> tuple[CamTable, ...]:
    """The motions of even and odd warps, of each group."""
    shed = design.shed
    return tuple(
        _motion(design, f"{parity}-warps" + (f"-{index + 1}" if shed.groups > 1 else ""), programme)
        for parity, cams in (("even", shed.even), ("odd", shed.odd))
        for index, programme in enumerate(cams.programmes)
    )


def _motion(design: SheddingDesign, name: str, programme: CamProgramme) -> CamTable:
    def motion(angle: FloatArray) -> FloatArray:
        return np.stack(programme.at(angle)[:3])

    title = f"Lift of the {name.replace('-', ' ')} over the cam shaft's angle"
    return CamTable(name, title, motion, turn_knots(programme), "mm", TURN / design.params.speed)

"""The warps' motions for a controller."""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.opposed_cams import turn_knots
from ilmek.cams.programme import TURN, CamProgramme
from ilmek.machines.shedding.design import SheddingDesign
from ilmek.report import CamTable


def cam_tables(design: SheddingDesign) -> tuple[CamTable, ...]:
    """The motions of even and odd warps, of each group and each shaft."""
    return tuple(
        _motion(
            design,
            f"{parity}-warps"
            + (f"-{group + 1}" if shaft.shed.groups > 1 else "")
            + (f"-shaft-{index + 1}" if index else ""),
            programme,
        )
        for index, shaft in enumerate(design.shafts)
        for parity, cams in (("even", shaft.shed.even), ("odd", shaft.shed.odd))
        if sum(cams.numbers) > 0
        for group, programme in enumerate(cams.programmes)
    )


def _motion(design: SheddingDesign, name: str, programme: CamProgramme) -> CamTable:
    def motion(angle: FloatArray) -> FloatArray:
        return np.stack(programme.at(angle)[:3])

    title = f"Lift of the {name.replace('-', ' ')} over the cam shaft's angle"
    return CamTable(name, title, motion, turn_knots(programme), "mm", TURN / design.params.speed)

"""The needle bar: its mass, and its deflection between the drives.

    q(theta) = (F - m (a + g)) / p,     y = q y_1,     sigma = q M_1 h / (2 I)

F force of the backing on the needles of a drive upward, m mass that a drive carries, a its acceleration upward, p the
distance of the drives; y_1 and M_1 deflection and moment under a unit load along the bar on its drives as supports.
With a phase between the drives the bar is cut between them: each piece is a cantilever to both sides of its drive.
"""

import numpy as np

from ilmek.elements.beam.model import Beam, LineLoad
from ilmek.elements.beam.solve import bend
from ilmek.elements.materials import MATERIALS
from ilmek.machines.tufting.design import Tufting
from ilmek.machines.tufting_machine.needle_parts import NEEDLE_BAR
from ilmek.machines.tufting_machine.params import TuftingMachineParams
from ilmek.records import record, result
from ilmek.report import Check, at_most

STRESS = 3.0
"""Yield strength over the allowed stress of the bar, which is loaded at every stitch; assumed by this project."""


@record
class NeedleBar:
    """The needle bar of a machine."""

    params: TuftingMachineParams
    mass: float = result("kg", "mass of needle bar, needles and push rods", name="needle_bar_mass")
    load: float = result("N/m", "greatest load along the needle bar", name="needle_bar_load")
    deflection: float = result("mm", "greatest deflection of the needle bar", name="needle_bar_deflection")
    stress: float = result("MPa", "greatest bending stress of the needle bar", name="needle_bar_stress")

    @property
    def checks(self) -> tuple[Check, ...]:
        """Deflection and stress."""
        allowed = MATERIALS[self.params.needle_bar.material].strength / STRESS
        cure = "set more drives, or a higher needle_bar.height"
        return (
            at_most(
                "deflection of the needle bar",
                self.deflection,
                self.params.needle_bar.bow,
                "mm",
                "parameter needle_bar.bow",
            ).with_cure(cure, NEEDLE_BAR),
            at_most("stress of the needle bar", self.stress, allowed, "MPa", "yield over 3; assumed").with_cure(
                cure, NEEDLE_BAR
            ),
        )


def needle_bar(params: TuftingMachineParams, mass: float, drive: Tufting) -> NeedleBar:
    """The needle bar over a turn of its drives."""
    bar, state, pitch = params.needle_bar, drive.state, params.width / params.drives
    inertia = bar.thickness * bar.height**3 / 12
    upward = state.friction + mass / params.drives * (state.acceleration - drive.params.gravity)
    load = float(np.max(np.abs(upward))) / pitch
    length = pitch if drive.params.phase else params.width
    supports = (length / 2,) if drive.params.phase else tuple((np.arange(params.drives) + 0.5) * pitch)
    unit = _unit_bend(length, supports)
    deflection, moment = (load * value for value in unit)
    return NeedleBar(
        params,
        mass,
        load,
        deflection / (MATERIALS[params.needle_bar.material].modulus * inertia),
        moment * bar.height / 2 / inertia,
    )


def _unit_bend(length: float, supports: tuple[float, ...]) -> tuple[float, float]:
    """Greatest deflection times E I, and greatest moment, under 1 N/m on a bar on supports [m³, m²]."""
    if len(supports) == 1:
        return (length / 2) ** 4 / 8, (length / 2) ** 2 / 2
    bent = bend(Beam(length, supports, (LineLoad(0.0, length, 1.0),)))
    return bent.deflection_max(1.0).size, bent.moment_max.size

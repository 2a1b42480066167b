"""Parts of the weft side: carrier, bobbins, boxes, axis with its motor."""

import math

from ilmek.elements.drive_parts import PULLEY, motor_part, reducer_part
from ilmek.elements.materials import GRAVITY
from ilmek.elements.motors import STEPPER, smallest_motor
from ilmek.machines.weft.axis import BeltAxis
from ilmek.machines.weft.params import WeftParams
from ilmek.machines.weft.passage import WeftPassage
from ilmek.machines.weft.rapier import Rapier
from ilmek.machines.weft.shuttle import Shuttle
from ilmek.report import BillLine
from ilmek.units import format_quantity

WOOD, CARBON = "beech", "carbon fibre"

SHIFT_SPEED = 0.1
"""Speed of a box from cell to cell [m/s]."""

CUTTER, SELECTOR, TUCKER = 0.3, 0.2, 0.5
"""Masses of a weft cutter, of the fingers of the selector and of a tuck-in needle [kg]; assumed by this project."""

AUXILIARY = 0.4
"""Torque of the motors of selector, cutter and tuck-in needles [N m]: the smallest stepper's."""


def parts_of(
    params: WeftParams, carried: Shuttle | Rapier, passage: WeftPassage, axis: BeltAxis
) -> tuple[BillLine, ...]:
    """Lines of the parts list."""
    own = _of_shuttles(params, carried) if isinstance(carried, Shuttle) else _of_rapier(params, carried)
    return (*own, *_of_axis(params.carrier, passage, axis))


def _of_shuttles(params: WeftParams, made: Shuttle) -> tuple[BillLine, ...]:
    size = made.bobbin.name
    both = f"{format_quantity(made.length, 'mm')} long, for a bobbin of {size}"
    force = 2 * made.full * GRAVITY
    motor = smallest_motor(force * PULLEY, SHIFT_SPEED / PULLEY, STEPPER)
    core = math.pi / 4 * made.bobbin.core**2 * made.bobbin.length * params.shuttle_density
    return (
        BillLine("shuttle", 2, both, WOOD, "machined link", made.empty),
        BillLine("bobbin of weft", 4, size, WOOD, "yarn tube", core),
        BillLine("carriage of the shuttle", 1, "with magnets", "", "machined link", params.carriage_mass),
        BillLine("box of the shuttles", 2, "two cells", "", "linear axis", length=2 * made.width),
        motor_part("motor of a box", motor, force * PULLEY, SHIFT_SPEED / PULLEY, 2),
    )


def _of_rapier(params: WeftParams, made: Rapier) -> tuple[BillLine, ...]:
    tall, wide, wall = (format_quantity(size, "mm", 3) for size in made.tube)
    small = smallest_motor(AUXILIARY, 0.0, STEPPER)
    return (
        BillLine(
            "rapier", 1, f"tube {tall} x {wide} x {wall}", CARBON, "machined link", made.mass - params.gripper_mass
        ),
        BillLine("gripper of the rapier", 1, "two jaws", "", "machined link", params.gripper_mass),
        BillLine("carriage of the rapier", 1, "with clamp", "", "machined link", params.carriage_mass),
        BillLine("weft selector", 1, "two fingers", "", "machined link", SELECTOR),
        BillLine("weft cutter", 2, "one at each edge", "", "machined link", CUTTER),
        BillLine("tuck-in needle", 2, "one at each edge", "", "machined link", TUCKER),
        BillLine("axis of a tuck-in needle", 2, "along the edge", "", "linear axis", length=2 * params.turn),
        motor_part("motor of selector, cutters and needles", small, AUXILIARY, 0.0, 5),
    )


def _of_axis(carrier: str, passage: WeftPassage, axis: BeltAxis) -> tuple[BillLine, ...]:
    wide = "wider than any of the table" if math.isnan(axis.width) else f"{format_quantity(axis.width, 'mm')} wide"
    motor = axis.drive.motor if axis.drive else None
    geared = () if axis.drive is None or axis.drive.reducer.ratio == 1 else (axis.drive.reducer.ratio,)
    return (
        BillLine(
            f"axis of the {carrier}", 1, f"belt {axis.belt.belt.name}, {wide}", "", "linear axis", length=passage.stroke
        ),
        motor_part(f"motor of the {carrier}", motor, axis.torque, axis.turning),
        *(reducer_part(f"reducer of the {carrier}", ratio, motor) for ratio in geared),
    )

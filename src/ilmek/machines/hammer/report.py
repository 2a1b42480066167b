"""What is reported of a hammer: checks, tables, warnings, and the stroke for a controller."""

import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.beat_up.report import POWER_LIMIT
from ilmek.machines.hammer.axis import axis_checks
from ilmek.machines.hammer.comb import BAR_ID, LEAF_ID
from ilmek.machines.hammer.design import Hammer
from ilmek.machines.hammer.linkage import linkage_checks
from ilmek.machines.linkage_strength import equilibrium_test
from ilmek.machines.strength_tables import strength_table
from ilmek.report import CamTable, Check, Table, at_least, at_most, columns
from ilmek.units import dm, format_quantity

THESIS = "thesis, 3.3"


def checks(design: Hammer) -> tuple[Check, ...]:
    """Rows, fell and comb, and the drive."""
    params, comb = design.params, design.comb
    harder, tight = "set a larger force", "set a higher tension, or a longer cloth_length"
    deep, leaf = "set a deeper comb, or more supports", "set a higher leaf, or a shorter reach of it"
    bar, whole = (BAR_ID,), (BAR_ID, LEAF_ID)
    return (
        at_most("distance of the rows", design.spacing, params.cloth.row_distance, "mm", "row_pitch").with_cure(
            harder, *whole
        ),
        at_most("force before the cloth is slack", design.force, design.fabric.bump, "N", "T (1 + kw/kc)").with_cure(
            tight
        ),
        at_least(
            "uniformity across the width", comb.uniformity, params.uniformity_limit, "1", f"{THESIS}: even"
        ).with_cure(deep, *bar),
        at_most("stress of the comb", comb.stress, params.strength, "MPa", "strength").with_cure(deep, *bar),
        at_most("stress of a leaf", comb.leaf_stress, params.strength, "MPa", "strength").with_cure(leaf, *whole[1:]),
        *_drive_checks(design),
    )


def _drive_checks(design: Hammer) -> tuple[Check, ...]:
    if design.axis is not None:
        return axis_checks(design.axis)
    assert design.linkage is not None
    needed, cure = (
        (design.params.force or design.needed) * design.params.cloth.warps,
        "set a higher beat_speed, or more ballast",
    )
    force = at_least("force of the crank-rockers", design.linkage.force, needed, "N", "inertia at the beat").with_cure(
        cure, BAR_ID, LEAF_ID
    )
    return (force, *linkage_checks(design.linkage))


def self_tests(design: Hammer) -> tuple[Check, ...]:
    """Power balance of the crank-rockers' forces, and the equilibrium of their links."""
    if design.linkage is None:
        return ()
    error = design.linkage.one.state.forces.power_error
    power = at_most("power balance of the forces", error, POWER_LIMIT, "1", "virtual power")
    return power, equilibrium_test(design.linkage.strength.found)


def tables(design: Hammer) -> tuple[Table, ...]:
    """Rows by force, the same row struck, rows across the width; strength of crank-rockers."""
    strength = () if design.linkage is None else strength_table(design.linkage.strength.found, "hammer")
    return (_row_table(design), _blow_table(design), _across_table(design), *strength)


def _row_table(design: Hammer) -> Table:
    """What other forces leave, from loose to nearly jammed."""
    warps, fabric = design.params.cloth.warps, design.fabric

    def row(force: float) -> tuple[float, ...]:
        spacing = float(fabric.spacing(force))
        return force, force * warps, spacing, 1 / spacing, float(fabric.fell(force)), fabric.energy(force) * warps

    heads = columns(
        "force of a warp [N] | all warps [kN] | rows [mm] | rows along [1/dm] | displacement of the fell [mm]",
        "energy of a beat [J]",
    )
    rows = tuple(row(share * design.needed) for share in (0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 4.0))
    return Table("hammer-rows", "Rows by the force of the beat", heads, rows)


def _blow_table(design: Hammer) -> Table:
    """The same row struck instead of pressed: speed and momentum of a mass whose energy goes into the fell."""
    warps, fabric, speed = design.params.cloth.warps, design.fabric, design.speed_max
    energy = fabric.energy(design.needed) * warps

    def row(name: str, mass: float) -> tuple[float | str, ...]:
        needed = math.sqrt(2 * energy / mass) if mass > 0 else math.inf
        left = float(fabric.spacing(fabric.struck(0.5 * mass * speed**2 / warps)))
        return name, mass, needed, mass * needed, speed, left

    comb = design.comb.mass
    masses = (
        {"comb on the crank-rockers": comb}
        if design.axis is None
        else {"cams and comb": design.axis.mass, "comb alone": comb}
    )
    heads = columns(
        "striking mass | mass [kg] | speed for the required rows [m/s] | momentum [N*s] | its speed [m/s]",
        "rows it would leave [mm]",
    )
    rows = tuple(row(name, mass) for name, mass in masses.items())
    return Table("hammer-blow", "The same row struck instead of pressed", heads, rows)


def _across_table(design: Hammer) -> Table:
    x = design.comb.line.x
    at = np.linspace(0, x.size - 1, 13).round().astype(int)
    force, spacing = design.force_across(), design.spacing_across()
    heads = columns("across [mm]", "force of a warp [N]", "rows [mm]", "rows along [1/dm]")
    rows = tuple((float(x[i]), float(force[i]), float(spacing[i]), 1 / float(spacing[i])) for i in at.tolist())
    return Table("hammer-across", "Force and rows across the width", heads, rows)


def warnings(design: Hammer) -> tuple[str, ...]:
    """A comb that leaves the fell, rows too loose, and axes that no servo drives."""
    warnings, required = [], design.params.cloth.row_distance
    if design.comb.line.least <= 0:
        warnings.append("the comb bends so much that it leaves the fell: set more supports or a deeper comb")
    if design.spacing > required * (1 + 1e-9):
        rows, wanted = (1 / pitch * dm for pitch in (design.spacing, required))
        force, speed = format_quantity(design.needed, "N"), design.linkage.speed_needed if design.linkage else None
        how = f" or turn the cranks at {format_quantity(speed, 'rad/s')}" if speed else ""
        warnings.append(f"{rows:.4g} rows a decimetre where {wanted:.4g} are required: press with {force} a warp{how}")
    if design.axis is not None and design.axis.drive is None:
        warnings.append(
            "no servo of the table is enough for an axis: set more axes, a smaller lead or a slower shed_speed"
        )
    return tuple(warnings)


def cam_tables(design: Hammer) -> tuple[CamTable, ...]:
    """The stroke of the comb over the cam shaft's angle; nothing for the linkage."""
    if design.axis is None:
        return ()
    programme = design.axis.programme

    def motion(angle: FloatArray) -> FloatArray:
        at = programme.at(angle)
        return np.stack([at.s, at.ds, at.dds])

    title = "Stroke of the comb over the cam shaft's angle"
    return (CamTable("comb", title, motion, programme.knots, "mm", design.params.turn_time),)

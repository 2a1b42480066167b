"""What the design says of its three cylinders and of the warps' tension over a row."""

import numpy as np

from ilmek.elements.bearings import slope_limit
from ilmek.elements.tubes import TUBES
from ilmek.machines.warp_tension.cylinders import (
    STATIC_SAFETY,
    STUB,
    STUB_SAFETY,
    Cylinder,
    Slots,
    cylinders,
    slots_of,
    tension_beyond,
)
from ilmek.machines.warp_tension.design import WarpTensionDesign, keeps_limits
from ilmek.machines.warp_tension.tension import WarpTension, history, tension_of
from ilmek.report import Axis, Check, Column, Drawing, Plot, Result, Series, Stroke, Table, at_least, at_most
from ilmek.units import mm, turn

SHOWN_ROWS = 4
SHOWN_TUBES = 8


def cylinder_results(design: WarpTensionDesign) -> tuple[Result, ...]:
    """The three cylinders by name, the spacer's slots, and the tension over a row."""
    three, slots, tension = cylinders(design), slots_of(design.params), tension_of(design)
    return (*_of_each(three), *_of_slots(slots, three[2]), *_of_tension(tension, design))


def cylinder_checks(design: WarpTensionDesign) -> tuple[Check, ...]:
    """Spacer, bearings, shaft ends, slots and the warp's strength."""
    params, slots, tension = design.params, slots_of(design.params), tension_of(design)
    three = cylinders(design)
    spacer, tired = three[2], min(three, key=lambda one: one.static_safety)
    weak = min(three, key=lambda one: one.stub_safety)
    return (
        at_most("slope of the spacer", spacer.slope, params.slope_limit, "rad", "under the slots"),
        at_most("deflection of the spacer", spacer.deflection, params.deflection_limit, "mm", "under the slots"),
        *_slopes(three, params.slope_limit),
        at_least(f"static safety, {tired.bearing.name}", tired.static_safety, STATIC_SAFETY, "1", "ISO 76"),
        at_least(f"shaft end of the {weak.name} cylinder", weak.stub_safety, STUB_SAFETY, "1", f"yield of {STUB.name}"),
        at_most("warp in its slot", slots.warp, slots.width, "mm", "slots of the spacer"),
        at_least("land between slots", slots.land, 0.0, "mm", "pitch of the warps"),
        at_most("tension with the shed open", tension.over.shed, tension.breaking, "N", "cotton breaks at 17 cN/tex"),
        at_most("tension of a motor's step", tension.step, 0.05 * params.tension, "N", "a twentieth of the tension"),
    )


def _slopes(three: tuple[Cylinder, ...], limit: float) -> tuple[Check, ...]:
    """Slopes within the limit that the bearings' kinds do not bear."""
    tilted = [one for one in three if slope_limit(one.bearing) < one.slope <= limit]
    return tuple(
        at_most(f"slope of {one.bearing.name}, {one.name}", one.slope, slope_limit(one.bearing), "rad", "its kind")
        for one in tilted
    )


def cylinders_table(design: WarpTensionDesign) -> Table:
    """The three cylinders side by side."""
    columns = (
        Column("cylinder"),
        Column("tube"),
        Column("load", "kN/m"),
        Column("slope", "mrad"),
        Column("deflection", "mm"),
        Column("reaction", "kN"),
        Column("torque", "Nm"),
        Column("mass", "kg"),
        Column("bearing"),
        Column("static safety"),
        Column("life, turns"),
        Column("shaft end", "MPa"),
    )
    rows = tuple(
        (
            one.name,
            _tube_name(one),
            abs(one.load),
            one.slope,
            one.deflection,
            one.reaction,
            one.torque,
            one.mass,
            one.bearing.name,
            one.static_safety,
            one.life,
            one.stub_stress,
        )
        for one in cylinders(design)
    )
    return Table("warp-tension-cylinders", "The three cylinders", columns, rows)


def stock_table(design: WarpTensionDesign) -> Table:
    """The lightest stock tubes that keep slope and deflection of the upper cylinder."""
    params = design.params
    enough = (t for t in TUBES.values() if keeps_limits(params, t.inner_radius, t.outer_radius))
    lightest = sorted(enough, key=lambda tube: tube.area)[:SHOWN_TUBES]
    rows = tuple((tube.name, tube.standard, tube.mass(params.density), tube.inertia) for tube in lightest)
    columns = Column("tube"), Column("standard"), Column("mass", "kg/m"), Column("second moment of area", "cm^4")
    return Table("warp-tension-stock", "The lightest stock tubes that carry these warps", columns, rows)


def tension_plot(design: WarpTensionDesign) -> Plot:
    """Tension of a warp over some rows."""
    rows = max(SHOWN_ROWS, design.params.rows_between + 1)
    at, over = history(design, rows)
    tension = tension_of(design)
    asked = Series("asked for", np.array([0.0, float(rows)]), np.full(2, tension.over.rest), dashed=True)
    note = "rises as the weft waves the warps; peaks: its shed; falls at the take-up, where the upper cylinder lets off"
    return Plot(
        "warp-tension-rows",
        "Tension of a warp over the rows",
        Axis("rows"),
        Axis("tension", "N"),
        (Series("a warp", at, over), asked),
        note=note,
    )


def side_view(design: WarpTensionDesign) -> Drawing:
    """The three cylinders from the side, to scale, with the way of the warps and what pulls at each."""
    upper, lower, spacer = cylinders(design)
    height, back, ring = design.params.free_length, 4 * design.outer_radius, np.exp(1j * np.linspace(0, turn, 73))
    wrap = design.params.spacer_wrap
    arc = np.exp(1j * np.linspace(0.0, wrap, 25))
    radius = spacer.outer
    middle = {"spacer": -radius + 1j * height, "lower": -lower.outer + 0j}
    leaves = middle["spacer"] + radius * arc[-1]
    along = 1j * np.exp(1j * wrap)
    middle["upper"] = leaves + back * along + 1j * along * upper.outer
    way = np.concatenate([[0j], middle["spacer"] + radius * arc, [leaves + back * along]])
    longest = max(abs(one.load) for one in (upper, lower, spacer))
    strokes = [Stroke(way, "yarn", "warps")]
    for one in (upper, lower, spacer):
        at = middle[one.name]
        pull = at + np.array([0.0, one.load / longest * height / 3])
        strokes += [Stroke(at + one.outer * ring, "outline", one.name, closed=True, filled=True)]
        strokes += [Stroke(at + one.inner * ring, "outline", closed=True), Stroke(pull, "dimension")]
    note = "the warps come off the upper cylinder and slip over the spacer, the carpet goes to the lower; arrows: loads"
    return Drawing("warp-tension-side", "The three cylinders from the side", tuple(strokes), unit="m", note=note)


def _of_each(three: tuple[Cylinder, ...]) -> tuple[Result, ...]:
    return (
        Result("cylinder_tube", {one.name: _tube_name(one) for one in three}, "", "stock tube of each cylinder"),
        Result("cylinder_load", {one.name: abs(one.load) for one in three}, "kN/m", "load, own weight included"),
        Result("cylinder_slope", {one.name: one.slope for one in three}, "mrad", "slope in the bearings"),
        Result("cylinder_slope_bare", {one.name: one.slope_bare for one in three}, "mrad", "the same, no own weight"),
        Result("cylinder_deflection", {one.name: one.deflection for one in three}, "mm", "deflection at mid-width"),
        Result("cylinder_deflection_bare", {one.name: one.deflection_bare for one in three}, "mm", "the same, bare"),
        Result("cylinder_reaction", {one.name: one.reaction for one in three}, "N", "force on each bearing"),
        Result("cylinder_mass", {one.name: one.mass for one in three}, "kg", "mass of each tube"),
        Result("bearing", {one.name: one.bearing.name for one in three}, "", "bearings of each cylinder"),
        Result("bearing_life", {one.name: one.life for one in three}, "1", "their life in turns [ISO 281]"),
        Result("bearing_time", {one.name: one.time for one in three}, "h", "the same at the take-up's mean speed"),
        Result("bearing_static_safety", {one.name: one.static_safety for one in three}, "1", "C0 / P0 [ISO 76]"),
        Result("stub_stress", {one.name: one.stub_stress for one in three}, "MPa", "von Mises, in the shaft ends"),
        Result("mass_cylinders", sum(one.mass for one in three), "kg", "mass of the three tubes"),
    )


def _of_slots(slots: Slots, spacer: Cylinder) -> tuple[Result, ...]:
    return (
        Result("slot_pitch", slots.pitch, "mm", "distance of the spacer's slots"),
        Result("slot_width", slots.width, "mm", "width of a slot"),
        Result("slot_depth", slots.depth, "mm", "depth of a slot"),
        Result("slot_land", slots.land, "mm", "metal between two slots"),
        Result("warp_diameter", slots.warp, "mm", "diameter of a warp"),
        Result("spacer_radius", spacer.outer + slots.depth, "mm", "outer radius of the spacer"),
    )


def _of_tension(tension: WarpTension, design: WarpTensionDesign) -> tuple[Result, ...]:
    return (
        Result("warp_stiffness", tension.stiffness, "kN", "force over strain of a warp"),
        Result(
            "tension_woven", tension.over.woven, "N", "tension before the take-up: the weft's waves tighten the warps"
        ),
        Result(
            "tension_row",
            (tension.over.woven - tension.over.rest) / design.params.rows_between,
            "N",
            "change over a row",
        ),
        Result("tension_shed", tension.over.shed, "N", "tension with the shed open, the cylinders standing"),
        Result("tension_locked", tension.over.locked, "N", "tension if only the lower cylinder took up"),
        Result("tension_spacer", tension_beyond(design.params), "N", "tension beyond the spacer while warps slip"),
        Result("tension_breaking", tension.breaking, "N", "breaking force of a cotton warp"),
        Result("tension_step", tension.step, "N", "change of tension for a full step of the motor"),
        Result("correction_angle", tension.correction, "deg", "that the upper cylinder lets off beyond the lower one"),
    )


def _tube_name(one: Cylinder) -> str:
    if one.tube is not None:
        return one.tube.name
    return f"{2 * one.outer / mm:.5g}x{(one.outer - one.inner) / mm:.5g}, no stock size"

"""What is reported of a needle mechanism: checks, tables and warnings."""

from ilmek.machines.linkage_strength import equilibrium_test
from ilmek.machines.strength_tables import strength_table
from ilmek.machines.tufting.design import JOINTS, LINKS, Tufting
from ilmek.machines.tufting.links import needle_parts
from ilmek.machines.tufting.strength import NeedleStrength, motor_check, needle_checks, needle_sizes, needle_strength
from ilmek.records import group, record
from ilmek.report import Check, Table, at_least, at_most, columns, must
from ilmek.units import deg, format_quantity, mm, turn

PAPER = "Xu et al., needle multi-linkage mechanism"
BALANCE = 1e-9
LEVELS = 0.5 * mm
"""Greatest difference of the needle's height at entry and exit: there is one backing."""

TRANSMISSION, PRESSURE = 40 * deg, 30 * deg
SIDES = {-1: "just before", 0: "", 1: "just after"}


@record
class TuftingAnalysis:
    """A needle mechanism, and the strength of its parts."""

    design: Tufting = group()
    strength: NeedleStrength = group()


def analyse(design: Tufting) -> TuftingAnalysis:
    """The strength of a design."""
    return TuftingAnalysis(design, needle_strength(design))


def checks(analysis: TuftingAnalysis) -> tuple[Check, ...]:
    """Stroke, backing and angles; links, pins, shafts, bearings and motor."""
    design = analysis.design
    params = design.params
    levels = abs(design.entry_height - design.exit_height)
    return (
        at_least("stroke of the needle", design.stroke, params.stroke, "mm", f"required; {PAPER}: about 33 mm"),
        at_most("needle's height at entry against exit", levels, LEVELS, "mm", "one backing: both at its level"),
        *angle_checks(design),
        *_lowest_check(design),
        *strength_checks(analysis),
        motor_check(analysis.strength),
    )


def angle_checks(design: Tufting) -> tuple[Check, ...]:
    """Transmission and pressure angle."""
    return (
        at_least("transmission angle of rocker", design.transmission, TRANSMISSION, "deg", "rule of thumb for rockers"),
        at_most("pressure angle of the rod", design.pressure_angle, PRESSURE, "deg", "rule of thumb for sliders"),
    )


def strength_checks(analysis: TuftingAnalysis) -> tuple[Check, ...]:
    """Links, pins, shafts and bearings."""
    design = analysis.design
    return needle_checks(analysis.strength, needle_parts(design.params, needle_sizes(design)).ids)


def _lowest_check(design: Tufting) -> tuple[Check, ...]:
    """The needle passes its lowest position in the backing; nothing is required where friction acts all the time."""
    if design.params.friction == "always":
        return ()
    lowest = format_quantity(design.lowest, "deg")
    cure = f"set entry and exit on both sides of {lowest}, or the other turning sense"
    return (must("needle lowest between entry and exit", design.lowest_within, f"lowest at {lowest}").with_cure(cure),)


def self_tests(analysis: TuftingAnalysis) -> tuple[Check, ...]:
    """The balances of work and power."""
    design = analysis.design
    work = design.work
    scale = max(abs(work["drive"]), design.main_shaft_torque_max)
    unbalanced = abs(work["drive"] - work["friction"]) / scale if scale else 0.0
    return (
        at_most("work of drive against friction, over a turn", unbalanced, BALANCE, "1", "energy balance"),
        at_most("power balance of the forces", design.state.forces.power_error, BALANCE, "1", "virtual power"),
        equilibrium_test(analysis.strength.linkage),
    )


def tables(analysis: TuftingAnalysis) -> tuple[Table, ...]:
    """Links with the range of their angles, the greatest values over a turn, strength of links and pins."""
    strength = strength_table(analysis.strength.linkage, "tufting")
    return (_link_table(analysis.design), _peak_table(analysis.design), *strength)


def _link_table(design: Tufting) -> Table:
    params, bodies = design.params, design.bodies
    ranges = {"crank": (0.0, turn), **{body: design.ranges[theta] for theta, body in LINKS.items()}}
    rows = tuple(
        (name, getattr(params, name), bodies[name].mass, bodies[name].moment, *ends) for name, ends in ranges.items()
    )
    heads = columns("link", "length [mm]", "mass [kg]", "J [kg*m^2]", "least angle [deg]", "greatest angle [deg]")
    return Table("tufting-links", "Links, and the range of their angles", heads, rows)


def _peak_table(design: Tufting) -> Table:
    named = {
        "main_torque": ("torque on the main shaft", "N*m"),
        "driven_torque": ("torque through the driven shaft", "N*m"),
        **{name: (f"force in {'the guide' if name == 'guide' else f'pin {name}'}", "N") for name in JOINTS},
        "C on rocker": ("force of the driven shaft on the rocker", "N"),
        "C on arm": ("force of the driven shaft on the arm", "N"),
        "total_torque": ("torque of all bars on the main shaft", "N*m"),
        "bearing": ("force of its bearings on the main shaft", "N"),
    }
    peaks = ((label, design.peaks[name], unit) for name, (label, unit) in named.items())
    rows = tuple((label, format_quantity(peak.value, unit), peak.at, SIDES[peak.side]) for label, peak, unit in peaks)
    heads = columns("quantity", "greatest magnitude", "at crank angle [deg]", "limit from")
    return Table("tufting-peaks", "Greatest values over a turn", heads, rows)

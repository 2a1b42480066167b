"""What is reported of a beat-up: checks against the paper's criteria, its run by a motor, tables and figures."""

import math
from functools import lru_cache

from ilmek.dynamics.counterweight import Balance
from ilmek.dynamics.motor_run import REACHED, LastTurn, MotorRun
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.family import QUANTITIES, FamilyResult, limits
from ilmek.machines.beat_up.family_figures import family_figures
from ilmek.machines.beat_up.figures import figures_of
from ilmek.machines.beat_up.linkage import PINS
from ilmek.machines.beat_up.links import LINKS, PART_IDS
from ilmek.machines.beat_up.params import BeatUpParams
from ilmek.machines.beat_up.use import BeatUpUse, in_use, use_checks
from ilmek.machines.beat_up.use_figures import start_plots, stroke_plot
from ilmek.machines.linkage_strength import equilibrium_test
from ilmek.machines.strength_tables import strength_table
from ilmek.records import ComputedGroup, record
from ilmek.report import Check, Column, Figure, Table, at_least, at_most, columns, group, must
from ilmek.synthesis.crank_rocker.dead_centres import grashof_margin
from ilmek.synthesis.crank_rocker.selection import DEVIATIONS, RATIO_LIMIT
from ilmek.units import format_quantity

PAPER = "Topalbekiroglu and Celik, beat-up mechanism"
POWER_LIMIT = 1e-9
ENERGY_LIMIT = 1e-6

SHOWN = 9
"""Members of the front in the table."""

COLUMNS = (
    "crank_coupler_ratio",
    "transmission_angle_min",
    "force_at_beat",
    "beater_acceleration_max",
    "drive_torque_max",
    "joint_force_max",
    "size",
)
"""Quantities of the table of the front."""


@record
class BeatUpAnalysis:
    """A beat-up, its balance, its run by the motor, and the family of crank-rockers with the same dead centres."""

    design: BeatUp = group()
    balance: Balance = group()
    running: MotorRun = group()
    last_turn: LastTurn | None = group()

    @ComputedGroup
    def family(self) -> FamilyResult:
        """All crank-rockers with its dead centres."""
        return self.design.family()

    @ComputedGroup
    def use(self) -> BeatUpUse:
        """Strength, travel and start."""
        return in_use(self.design)


@lru_cache(maxsize=8)
def analyse(design: BeatUp) -> BeatUpAnalysis:
    """The balance and the run of a design."""
    running = design.motor_run()
    return BeatUpAnalysis(design, design.balance, running, running.last_turn)


def checks(analysis: BeatUpAnalysis) -> tuple[Check, ...]:
    """The paper's criteria, the run by the motor, and the limits by which the member was chosen."""
    design = analysis.design
    given = tuple(
        (at_least if limit.sign > 0 else at_most)(
            f"{QUANTITIES[limit.quantity][0]}, {limit.name}",
            analysis.family.own[limit.quantity],
            limit.bound,
            limit.unit,
            "given",
        ).with_cure("relax this limit, or leave others out")
        for limit in limits(design.params)
    )
    return (*criteria(design), *_running_checks(design.params, analysis.running), *use_checks(analysis.use), *given)


def self_tests(analysis: BeatUpAnalysis) -> tuple[Check, ...]:
    """The power balance of the forces, and the energy balance of the runs, the equilibrium of the links."""
    forces, runs = analysis.design.state.forces, analysis.running.runs if analysis.running.start else ()
    energy = max((run.energy_error for run in runs), default=0.0)
    return (
        at_most("power balance of the forces", forces.power_error, POWER_LIMIT, "1", "virtual power").with_cure(_LINKS),
        at_most("energy balance of the runs", energy, ENERGY_LIMIT, "1", "work of motor and weight").with_cure(_LINKS),
        equilibrium_test(analysis.use.strength.found),
    )


def tables(analysis: BeatUpAnalysis) -> tuple[Table, ...]:
    """Links, dead centres, greatest values, Pareto front."""
    design = analysis.design
    strength = strength_table(analysis.use.strength.found, "beat-up")
    of_turn = (_link_table(design), _dead_centre_table(design), _peak_table(design))
    return (*of_turn, *strength, _front_table(analysis.family))


def figures(analysis: BeatUpAnalysis) -> tuple[Figure, ...]:
    """The mechanism, its curves over a turn, its run, its use, and its family."""
    used = (*start_plots(analysis.use.start), stroke_plot(analysis.use.travel, analysis.use.start))
    return (*figures_of(analysis.design, analysis.running), *used, *family_figures(analysis.family))


def criteria(design: BeatUp) -> tuple[Check, ...]:
    """The paper's criteria."""
    wanted, tolerated = (math.pi / 2 - deviation for deviation in DEVIATIONS)
    angle, ratio = design.transmission_angle_min, design.crank_coupler_ratio
    margin, force = float(grashof_margin(design.links)), design.beater_force_max
    turns, beats = "set crank_rotation=180deg, or other links", "set a higher speed, or a heavier beater_mass"
    ratio_cure, margin_cure = "set beta, or a shorter crank", "set a shorter crank"
    rule, links = f"{PAPER}, criterion", tuple(PART_IDS[name] for name in LINKS)
    return (
        at_least("transmission angle, to run at all", angle, tolerated, "deg", f"{rule} i: 90° - µ < 50°").with_cure(
            turns, *links
        ),
        at_least("transmission angle, to run well", angle, wanted, "deg", f"{rule} i: 90° - µ < 40°").with_cure(
            turns, *links
        ),
        at_most("crank/coupler ratio", ratio, RATIO_LIMIT, "1", f"{rule} ii").with_cure(ratio_cure, *links[:2]),
        at_least("Grashof margin, in ground links", margin, 0.0, "1", f"{rule} iii").with_cure(margin_cure, *links),
        at_least(
            "force on the beater", force, design.params.beat_force, "N", f"{PAPER}, abstract: over 60 N"
        ).with_cure(beats, *links[2:]),
    )


_LINKS = "set links farther from a toggle"
_STRONGER = "set a larger motor_torque, or a lower speed"
_SOFTER = "give less torque, more slip or a larger flywheel"
_FLYWHEEL = "leave flywheel out, or set a larger one"


def _running_checks(params: BeatUpParams, running: MotorRun) -> tuple[Check, ...]:
    """Whether the motor starts it, and the flywheel is enough; a linkage that needs no torque needs no motor."""
    if running.start is None:
        toggle = "the motion near a toggle position has no usable Fourier series"
        return (must("the motor runs the linkage", False, toggle).with_cure(_LINKS),) if running.torque else ()
    reached, run, last = max(float(run.speed.max()) for run in running.runs), running.runs[-1], running.last_turn
    cure = _SOFTER if run.end.kind.early else _STRONGER
    source = "forward run, 95 % of it"
    speed = at_least("speed that the motor reaches", reached, REACHED * params.speed, "rad/s", source).with_cure(cure)
    if last is None:
        ended = (
            (must("the run at speed is complete", False, run.end.reason).with_cure(_SOFTER),) if running.started else ()
        )
        return (speed, *ended)
    limit, source = params.fluctuation, "forward run"
    return (speed, at_most("fluctuation of the speed", last.fluctuation, limit, "1", source).with_cure(_FLYWHEEL))


def warnings(analysis: BeatUpAnalysis) -> tuple[str, ...]:
    """The speed that would give the force required, and why there is no run or no start."""
    return (*_force_warnings(analysis.design), *_running_warnings(analysis.running))


def _force_warnings(design: BeatUp) -> tuple[str, ...]:
    force, wanted = design.beater_force_max, design.params.beat_force
    if force >= wanted or design.params.gravity > 0 or force == 0:
        return ()
    # Without weight every force grows with the square of the speed.
    speed = format_quantity(design.params.speed * math.sqrt(wanted / force), "rad/s")
    reached, required = format_quantity(force, "N"), format_quantity(wanted, "N")
    return (f"the rocker pushes the beater with {reached}, {required} are required: turn the crank at {speed}",)


def _running_warnings(running: MotorRun) -> tuple[str, ...]:
    if running.start is None:
        return () if running.torque else ("no run by the motor: the linkage needs no torque",)
    if running.started:
        return ()
    if running.start.end.kind.early:
        return (f"the start of the crank by the motor ends early: {running.start.end.reason}; {_SOFTER}",)
    torque, reached = format_quantity(running.torque, "N*m"), format_quantity(float(running.start.speed.max()), "rad/s")
    return (f"the motor does not bring the crank to its speed: with {torque} it reaches {reached}; give more torque",)


def _link_table(design: BeatUp) -> Table:
    heads = columns("link", "over ground", "length [mm]", "mass [kg]", "J [kg*m^2]")
    rows = tuple(
        (name, design.lengths[name] / design.lengths["ground"], design.lengths[name], design.masses[name], moment)
        for name, moment in design.inertias.items()
    )
    return Table("beat-up-links", "Links, with their mass and moment of inertia", heads, rows)


def _dead_centre_table(design: BeatUp) -> Table:
    at_beat, back = design.rocker_angles
    heads = columns("dead centre", "crank angle [deg]", "rocker angle [deg]", "time [s]")
    rows = (
        ("extended: the beat", design.beta, at_beat, design.beta / design.params.speed),
        ("folded: farthest back", design.back_angle, back, design.back_angle / design.params.speed),
    )
    return Table("beat-up-dead-centres", "Dead centres", heads, rows)


def _peak_table(design: BeatUp) -> Table:
    named = {
        "beater_velocity": ("speed of the beater", "m/s"),
        "beater_acceleration": ("acceleration of the beater", "m/s^2"),
        "beater_force": ("force on the beater", "N"),
        "drive_torque": ("drive torque", "N*m"),
        **{pin: (f"force in pin {pin}", "N") for pin in PINS},
    }
    rows = tuple(
        (label, format_quantity(design.peaks[name].value, unit), design.peaks[name].at)
        for name, (label, unit) in named.items()
    )
    heads = columns("quantity", "greatest value", "at crank angle [deg]")
    return Table("beat-up-peaks", "Greatest values over a turn", heads, rows)


def _front_table(family: FamilyResult) -> Table:
    """Some members of the front, and the beat-up itself."""
    members = (*family.some(SHOWN), family.own)
    rows = tuple(
        ("this" if member is family.own else "front", *(member[name] for name in COLUMNS)) for member in members
    )
    heads = columns("member", *(Column(*QUANTITIES[name]) for name in COLUMNS))
    return Table("beat-up-front", "Members on the Pareto front, and this beat-up", heads, rows)

"""The tufting machine's design: stroke and backing, needle drives, loop, looper, shafts, feed.

The needle goes so deep under the backing that its eye passes the hook; where the stroke of the needle drive is too
short for that depth and the lift over the backing, its crank is lengthened until it suffices.
"""

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np
from scipy.interpolate import CubicSpline

from ilmek.arrays import FloatArray
from ilmek.dynamics.balance import crank_counterweight, shaking
from ilmek.dynamics.loads import PointForce
from ilmek.errors import ParameterError
from ilmek.linkage.structure import plan
from ilmek.machines.tufting.design import Tufting
from ilmek.machines.tufting.model import mechanism, move
from ilmek.machines.tufting.params import TuftingParams
from ilmek.machines.tufting.strength import SHAFTS, needle_strength
from ilmek.machines.tufting.strength import design as needle_drive
from ilmek.machines.tufting_machine.feed import TuftingFeed
from ilmek.machines.tufting_machine.knife import KnifeDrive, knife_drive, knife_parts
from ilmek.machines.tufting_machine.latches import NeedleLatches, needle_latches
from ilmek.machines.tufting_machine.loop import Loop, NeedlePath, loop_geometry, loop_window, needle_depth
from ilmek.machines.tufting_machine.looper import LooperDrive, looper_drive
from ilmek.machines.tufting_machine.looper_parts import looper_parts
from ilmek.machines.tufting_machine.needle_bar import NeedleBar, needle_bar
from ilmek.machines.tufting_machine.needle_parts import needle_parts
from ilmek.machines.tufting_machine.params import TuftingMachineParams
from ilmek.machines.tufting_machine.product import TuftedCarpet
from ilmek.machines.tufting_machine.rocker_forces import (
    RockerForces,
    reflected_inertia,
    rocker_forces,
    rocker_motion,
)
from ilmek.machines.tufting_machine.shafts import SAMPLES, CrankTorques, TuftingShafts, tufting_shafts
from ilmek.records import computed, group, record, result
from ilmek.units import format_quantity, turn

STEPS = 20
"""Most steps of the search for the crank."""


@record
class TuftingMachine:
    """A tufting machine.

    needle   a needle drive, one of all alike
    lowest   height of its point where it is lowest, in the axes of the drive [m]
    """

    params: TuftingMachineParams
    needle: Tufting
    lowest: float
    loop: Loop = group()
    carpet: TuftedCarpet = group()
    looper: LooperDrive = group()
    looper_forces: RockerForces = group("looper_")
    knife: KnifeDrive | None = group()
    knife_forces: RockerForces | None = group("knife_")
    needle_bar: NeedleBar = group()
    latches: NeedleLatches | None = group()
    shafts: TuftingShafts = group()
    feed: TuftingFeed = group()
    counterweight: float = result("", "counterweight on each crank: mass times radius (kg m)", least=0.0)
    shaking: tuple[float, float]

    needle_stroke = computed("mm", "stroke of the needles", lambda it: it.needle.stroke)
    needle_crank = computed("mm", "crank of the needle drives", lambda it: it.needle.params.crank)
    needle_lift = computed(
        "mm", "needle's point over the backing where it is highest", lambda it: it.needle.stroke - it.loop.depth
    )
    needle_torque_max = computed(
        "N*m", "greatest torque of a needle drive on the main shaft", lambda it: it.needle.main_shaft_torque_max
    )
    backing_force_max = computed(
        "N", "greatest force of the backing on the needles of a drive", lambda it: it.greatest_friction
    )
    shaking_force = computed(
        "N",
        "greatest force of the moving masses of a needle drive on the frame, without and with the counterweight",
        lambda it: dict(zip(("without", "with_counterweight"), it.shaking, strict=True)),
    )

    @property
    def below(self) -> tuple[RockerForces, ...]:
        """The drives under the bed: of the loopers, and of the knives in cut pile."""
        return (self.looper_forces, *([self.knife_forces] if self.knife_forces else []))

    @property
    def greatest_friction(self) -> float:
        """Greatest force of the backing on the needles of a drive [N]."""
        return float(np.max(np.abs(self.needle.state.friction)))


@lru_cache(maxsize=8)
def design(params: TuftingMachineParams) -> TuftingMachine:
    """The machine for a carpet.

    Raises ParameterError for a width with too few needles, a looper that cannot reach, a stroke that cannot be had;
    MechanismError for a needle drive that does not close.
    """
    carpet = TuftedCarpet(params, params.needle.speed)
    _require_needles(params, carpet)
    depth = needle_depth(params)
    drive, path, lowest = _with_stroke(params.needle, depth + params.lift)
    geometry = loop_geometry(params, path, carpet)
    window, mass = loop_window(geometry), needle_parts(params).mass(carpet.needles, params.drives)
    given = replace(
        drive,
        bars=params.drives,
        needle_mass=mass / params.drives,
        friction="depth",
        penetration=replace(drive.penetration, needles=max(1, round(carpet.needles / params.drives))),
        entry=path.down(geometry.level) % turn,
        exit=window.out % turn,
        stroke=depth + params.lift,
    )
    needle, looper = needle_drive(given), looper_drive(params.looper, geometry, window)
    loop = Loop(geometry, window, *looper.passing)
    moved, knife, cutting = _below(params, carpet, looper, loop, lowest)
    below = (moved, cutting) if cutting else (moved,)
    loads = CrankTorques(
        {"main": _even(needle), "looper": np.sum([one.torque[:-1] for one in below], axis=0)},
        {
            "main": reflected_inertia(needle.state.motion, dict(needle.bodies), given.speed),
            "looper": sum(one.inertia for one in below),
        },
    )
    shafts, needle = _shafts(params, loads, loop.margin, needle)
    return TuftingMachine(
        params,
        needle,
        lowest,
        loop,
        carpet,
        looper,
        moved,
        knife,
        cutting,
        needle_bar(params, mass, needle),
        needle_latches(params, carpet.needles, path, _on_needle(needle)),
        shafts,
        TuftingFeed(params, carpet, (window.out - path.down(geometry.level)) % turn),
        *_balance(needle),
    )


def _below(
    params: TuftingMachineParams, carpet: TuftedCarpet, looper: LooperDrive, loop: Loop, lowest: float
) -> tuple[RockerForces, KnifeDrive | None, RockerForces | None]:
    """The forces of a looper drive, and the knives of cut pile; lowest: height of the needle's lowest point [m].

    Held loops pull their hooks up with both legs; a knife presses on the hook as its loop does on it.
    """
    needle, own = params.needle, params.looper
    shaft = looper.shaft(needle.shaft_distance + needle.needle_distance, lowest + loop.geometry.hook)
    moves, hooks = rocker_motion(looper.rocker, shaft, 1j * own.arm, needle.speed), carpet.needles / params.drives
    held = np.mod(moves.angle - loop.catch, turn) < loop.release - loop.catch
    pulls = [PointForce((looper.rocker.bodies[2], moves.tip), hooks * 2j * own.loop_tension * held)]
    parts = looper_parts(params, looper, moves.plan.mechanism, carpet.needles)
    knife = cutting = None
    if params.pile == "cut":
        knife = knife_drive(params, looper, moves, carpet.yarn_diameter)
        made = knife_parts(params, knife, carpet.needles, parts.rocker)
        on_knives = PointForce((knife.drive.bodies[2], knife.moves.tip), hooks * knife.force)
        cutting = rocker_forces(knife.moves, made, (on_knives,), own, needle)
        pulls.append(PointForce((looper.rocker.bodies[2], knife.on_hook), -hooks * knife.force))
    return rocker_forces(moves, parts, pulls, own, needle), knife, cutting


def _require_needles(params: TuftingMachineParams, carpet: TuftedCarpet) -> None:
    if carpet.needles < params.drives:
        raise ParameterError(
            f"{carpet.needles} needles at gauge={format_quantity(params.gauge, 'mm')} over "
            f"width={format_quantity(params.width, 'm')}",
            allowed=f"at least one for each of {params.drives} drives",
            do="set a smaller gauge, or fewer drives",
        )


def needle_path(params: TuftingParams) -> tuple[NeedlePath, float]:
    """The path of the needle of a drive, and the height of its point where it is lowest [m]."""
    angle = np.linspace(0.0, turn, 721)
    motion = move(params, plan(mechanism(params)), angle)
    height = np.array(motion.point("needle", "F").position.imag)
    height[-1] = height[0]
    spline = CubicSpline(angle, height, bc_type="periodic")
    ends = np.unique(np.mod(spline.derivative().roots(extrapolate=False), turn))
    heights = spline(ends)
    low, high = (float(ends[at]) for at in (np.argmin(heights), np.argmax(heights)))
    lowest = float(np.min(heights))
    rise = CubicSpline(angle, height - lowest, bc_type="periodic")
    return NeedlePath(rise, low, low + (high - low) % turn, float(np.ptp(heights))), lowest


def _with_stroke(params: TuftingParams, stroke: float) -> tuple[TuftingParams, NeedlePath, float]:
    """The needle drive, its crank lengthened where its stroke is too short [m], with the path and lowest height."""
    path, lowest = needle_path(params)
    for _ in range(STEPS):
        if path.stroke >= stroke * (1 - 1e-9):
            return params, path, lowest
        # The stroke is nearly in proportion to the crank.
        params = replace(params, crank=params.crank * stroke / path.stroke * (1 + 1e-10))
        path, lowest = needle_path(params)
    raise ParameterError(
        f"a stroke of {format_quantity(stroke, 'mm')} cannot be had by a longer crank",
        allowed=f"{format_quantity(path.stroke, 'mm')} with needle.crank={format_quantity(params.crank, 'mm')}",
        do="set a lower pile_height, or other links of the needle drive",
    )


def _shafts(
    params: TuftingMachineParams, loads: CrankTorques, margin: float, needle: Tufting
) -> tuple[TuftingShafts, Tufting]:
    """The shafts, and the needle drives on them: the least diameter that torsion and the drives' fatigue allow.

    With the masses given, the forces of the drives stay as they are; where they are those of the links as made, the
    drives are designed again.
    """
    least = 0.0
    while True:
        shafts = tufting_shafts(params, loads, margin, least)
        limits = replace(needle.params.strength, shaft_diameter=shafts.diameter)
        given = replace(needle.params, strength=limits)
        made = needle_drive(given) if given.link_mass == "made" else replace(needle, params=given)
        strength = needle_strength(made)
        enough = min(strength.main.fatigue, strength.driven.fatigue) >= limits.fatigue
        if enough or params.shafts.diameter or shafts.diameter >= SHAFTS[-1]:
            return shafts, made
        least = math.nextafter(shafts.diameter, math.inf)


def _on_needle(needle: Tufting) -> float:
    """Greatest force of the backing on a needle [N]."""
    return float(np.max(np.abs(needle.state.friction))) / needle.params.penetration.needles


def _even(needle: Tufting) -> FloatArray:
    """Torque of a needle drive at even steps of a turn [N m]; at a jump the mean of both limits."""
    angle = np.arange(SAMPLES) * (turn / SAMPLES)
    state = needle.state
    return np.asarray(np.interp(angle, state.angle, state.main_torque))


def _balance(needle: Tufting) -> tuple[float, tuple[float, float]]:
    """Static moment of the counterweight on a crank [kg m]; shaking force without and with it [N]."""
    speed = needle.params.speed
    angle, first = np.unique(needle.state.angle, return_index=True)
    even = np.linspace(0.0, turn, SAMPLES + 1)
    whole = shaking(needle.state.motion, needle.bodies).force[first]
    force = np.interp(even, angle, whole)
    weight = crank_counterweight(force[:-1], speed)
    with_weight = force + weight * speed**2 * np.exp(1j * even)
    return abs(weight), (float(np.max(np.abs(force))), float(np.max(np.abs(with_weight))))

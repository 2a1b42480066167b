"""What the synthesis through three poses says: arms, four-bars, and how each pose is met; nothing without poses."""

import numpy as np

from ilmek.arrays import Float
from ilmek.machines.knotting_four_bar.design import KnottingFourBar
from ilmek.machines.knotting_four_bar.model import KnottingState
from ilmek.machines.knotting_four_bar.poses import PoseFourBar, Synthesis, sines
from ilmek.plane.vectors import unit
from ilmek.report import Check, Column, Json, Result, Table, at_most
from ilmek.synthesis.dyad import RootKind, TwoLinkArm
from ilmek.units import turn

MET = 1e-9
"""Error of a place, of the extent of the poses, and of an angle [rad], that is rounding."""


def results(design: KnottingFourBar) -> tuple[Result, ...]:
    """Arms, four-bars, poses and the crank's way."""
    found, state = design.synthesis, design.at_poses
    if found is None or state is None:
        return ()
    solutions: list[Json] = [_solution(found, dyad) for dyad in found.dyads]
    four_bars: list[Json] = [_four_bar(found, one) for one in found.choices]
    roots: list[Json] = [RootKind(int(one)).words for one in found.roots.found]
    pivots: list[Json] = [[arm.pivot.real, arm.pivot.imag] for arm in (found.crank, found.rocker)]
    ends: list[Json] = list(design.working or ())
    return (
        Result("solutions", solutions, "", f"every real arm through the poses, SI and radians: {ARM}", shown=False),
        Result("roots", roots, "", "what each of the task's two roots is", shown=False),
        Result(
            "four_bars", four_bars, "", f"the arms joined, either one driven, SI and radians: {FOUR_BAR}", shown=False
        ),
        Result("chosen", found.choices.index(found.best) + 1, "", "number of the four-bar to build, from 1"),
        Result("poses", _met(found, state), "", f"how the poses are met, by moving the four-bar: {POSE}", shown=False),
        Result("pivots", pivots, "mm", "places of O1 and O1'"),
        Result("working_range", ends, "deg", "crank angles on the way through the poses"),
        Result("drive_torque_max", design.load_torque, "N*m", "greatest torque on the crank on the way, or at rest"),
    )


ARM = "pivot a0 along theta0 = (pivot_x, pivot_y), links a1 and a2, theta1 and residual at the poses"
FOUR_BAR = (
    "numbers of the driven and the other arm in solutions, links, ground_angle from O1 to O1', hand, branch; class, "
    "order of the poses, transmission angle least on the way, sine of it at the poses, whether kept, defects in words"
)
POSE = "place, coupler's direction, crank angle; errors, number in the crank's order, branch, circuit, drive torque"


def _solution(found: Synthesis, dyad: TwoLinkArm) -> dict[str, Json]:
    poses = found.poses
    return {
        "a0": dyad.ground,
        "theta0": found.ground_angle,
        "a1": dyad.first,
        "a2": dyad.second,
        "theta1": dyad.first_angles(poses.points, poses.angles).tolist(),
        "pivot_x": dyad.pivot.real,
        "pivot_y": dyad.pivot.imag,
        "residual": float(np.max(found.residuals(dyad))),
    }


def _four_bar(found: Synthesis, one: PoseFourBar) -> dict[str, Json]:
    candidate = one.candidate
    drawn, along = candidate.four_bar, candidate.four_bar.tracer_on_coupler
    return {
        "driven": one.crank + 1,
        "other": one.rocker + 1,
        **drawn.lengths._asdict(),
        "ground_angle": float(np.angle(drawn.b0 - drawn.a0)) % turn,
        "hand": (along or 0j).real,
        "branch": drawn.branch,
        "grashof": candidate.grashof.kind,
        "crank_angles": [met.crank_angle for met in candidate.positions],
        "order": list(candidate.order),
        "in_order": candidate.in_order,
        "one_circuit": candidate.one_circuit,
        "one_branch": candidate.one_branch,
        "transmission_angle_min": candidate.least_transmission,
        "transmission_sines": sines(found.poses, found.dyads[one.rocker]).tolist(),
        "link_ratio": candidate.link_ratio,
        "size": candidate.size,
        "kept": not one.defects,
        "defects": list(one.defects.values()),
    }


def _met(found: Synthesis, state: KnottingState) -> list[Json]:
    places, turned = errors(found, state)
    met, order = found.best.candidate.positions, found.best.candidate.order
    poses = zip(found.poses.points, found.poses.angles, strict=True)
    return [
        {
            "x": float(point.real),
            "y": float(point.imag),
            "theta2": float(angle),
            "crank_angle": float(state.angle[at]),
            "point_error": float(places[at]),
            "angle_error": float(turned[at]),
            "order": order.index(at + 1) + 1,
            "branch": met[at].branch,
            "circuit": met[at].circuit,
            "drive_torque": float(state.torque[at]),
        }
        for at, (point, angle) in enumerate(poses)
    ]


def errors(found: Synthesis, state: KnottingState) -> tuple[Float[np.ndarray, "3"], Float[np.ndarray, "3"]]:
    """By how much hand [m] and coupler [rad] of the moved machine miss the poses."""
    poses = found.poses
    places = np.abs(state.motion.point("coupler", "H").position - poses.points)
    # The coupler's frame looks from O2 to O2', which may be against the poses' direction.
    against = float(np.sign(found.crank.second - found.rocker.second))
    turned = np.angle(against * state.motion.direction("coupler") * np.conj(unit(poses.angles)))
    return places, np.abs(turned)


def checks(design: KnottingFourBar) -> tuple[Check, ...]:
    """The poses are met."""
    found, state = design.synthesis, design.at_poses
    if found is None or state is None:
        return ()
    places, turned = errors(found, state)
    points = found.poses.points
    extent = float(np.max(np.abs(points - points[0])))
    source = "forward simulation"
    return (
        at_most("hand at the poses, missed, of their extent", float(np.max(places)) / extent, MET, "1", source),
        at_most("coupler at the poses, missed", float(np.max(turned)), MET, "deg", source),
    )


def tables(design: KnottingFourBar) -> tuple[Table, ...]:
    """Arms, four-bars and poses."""
    found, state = design.synthesis, design.at_poses
    if found is None or state is None:
        return ()
    return _arm_table(found), _four_bar_table(found), _pose_table(found, state)


def _arm_table(found: Synthesis) -> Table:
    heads = ("ground a0", "first link a1", "second link a2", "pivot x", "pivot y")
    angles = tuple(Column(f"θ1 at pose {at}", "deg", 7) for at in (1, 2, 3))
    rows = tuple(
        (
            at + 1,
            *(dyad.ground, dyad.first, dyad.second, dyad.pivot.real, dyad.pivot.imag),
            *dyad.first_angles(found.poses.points, found.poses.angles).tolist(),
        )
        for at, dyad in enumerate(found.dyads)
    )
    columns = (Column("arm"), *(Column(head, "mm", 7) for head in heads), *angles)
    return Table(
        "knotting-arms", "Arms through the poses with their pivots on the ground ray", columns, rows, brief=True
    )


def _four_bar_table(found: Synthesis) -> Table:
    heads = ("ground", "crank", "coupler", "rocker")
    rows = tuple(
        (
            one.crank + 1,
            *one.candidate.four_bar.lengths,
            one.candidate.grashof.kind,
            one.candidate.least_transmission,
            "to build" if one is found.best else "; ".join(one.defects.values()) or "no defect",
        )
        for one in found.choices
    )
    columns = (
        *(Column("driven arm"), *(Column(head, "mm", 7) for head in heads), Column("class")),
        *(Column("least transmission angle", "deg"), Column("verdict")),
    )
    return Table("knotting-four-bars", "The arms joined as one four-bar", columns, rows, brief=True)


def _pose_table(found: Synthesis, state: KnottingState) -> Table:
    places, turned = errors(found, state)
    met = found.best.candidate.positions
    rows = tuple(
        (
            at + 1,
            *(float(state.angle[at]), found.best.candidate.order.index(at + 1) + 1, met[at].branch),
            *(float(places[at]), float(turned[at]), float(state.torque[at])),
        )
        for at in range(3)
    )
    columns = (
        *(Column("pose"), Column("crank angle", "deg", 7), Column("met as number"), Column("branch")),
        *(Column("place missed", "mm"), Column("angle missed", "deg"), Column("drive torque", "N*m")),
    )
    return Table("knotting-poses", "The poses, by moving the four-bar", columns, rows, brief=True)

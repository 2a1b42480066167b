"""Random mechanisms of class II and III with one crank, drawn in place, and the check of their closing ranges."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from benchmarks.campaign.dead_centres import distances
from ilmek.linkage.closing import closing
from ilmek.linkage.model import GROUND, Body, Joint, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.one_input import one_input
from ilmek.linkage.pose_branch import pose_branch
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan, plan

BESIDE = 1e-7
"""Distance [rad] from a dead centre at which the independent calculation starts."""

Points = dict[str, complex]


@dataclass(frozen=True)
class Checked:
    """The closing ranges of a mechanism against the independent calculation.

    error   greatest distance [rad] of an end from det J = 0      dead  number of dead centres
    missed  samples that close outside of the ranges, or do not close inside of them
    """

    error: float
    dead: int
    missed: int


def check(mechanism: Mechanism, samples: int = 2001) -> Checked:
    """The closing ranges over a turn: their ends, and nothing lost between them."""
    planned = plan(mechanism)
    found = closing(one_input(planned), -np.pi, np.pi)
    truth = distances(mechanism)
    errors = [0.0]
    branch = (
        pose_branch(planned, mechanism.inputs[0].name, {}) if "plate" in {b.name for b in mechanism.bodies} else None
    )
    seams = {(branch.stop, 1), (branch.start, -1)} if branch else set()  # where whole turns reduce to the branch
    for low, high in found.ranges:
        for end, inward in ((low, 1), (high, -1)):
            if abs(end) < np.pi and (end, inward) not in seams:
                at = solve(planned, end + inward * BESIDE)
                p = np.array([[point.real, point.imag] for point in _pins(at, truth.free)]).ravel()
                errors.append(abs(truth.dead_centre(p, end) - end))
    return Checked(max(errors), len(found.dead_centres), _missed(planned, found.ranges, samples))


def _pins(motion: Motion, names: tuple[str, ...]) -> list[complex]:
    """Positions of pins at the first sample."""
    mechanism = motion.plan.mechanism
    owner = {point: body.name for body in mechanism.bodies for point in body.points if body.name != GROUND}
    return [complex(np.ravel(motion.point(owner[name], name).position)[0]) for name in names]


def _missed(planned: Plan, ranges: tuple[tuple[float, float], ...], samples: int) -> int:
    """Class II: samples whose status differs. Class III: ends that differ from those of an independent continuation."""
    mechanism = planned.mechanism
    values = np.linspace(-np.pi, np.pi, samples, endpoint=False) + 1e-3 / samples
    inside = np.zeros(samples, dtype=bool)
    for low, high in ranges:
        inside |= (values > low) & (values < high)
    missed = int(np.count_nonzero(inside != (solve(planned, values).status == 0)))
    if mechanism.branches:
        return missed
    branch, truth = pose_branch(planned, mechanism.inputs[0].name, {}), distances(mechanism)
    assert branch is not None
    p = np.array([[at.real, at.imag] for at in _pins(solve(planned, 0.0), truth.free)]).ravel()
    step = 2 * np.pi / samples
    for sign, end in ((1, branch.stop), (-1, branch.start)):
        most = 2 * np.pi if branch.full else 4 * np.pi
        last = truth.followed(p, 0.0, sign * step, sign * most)
        missed += abs(last - sign * most) > 1e-9 if branch.full else not abs(last - end) <= 2 * step
    return missed


def four_bar(rng: np.random.Generator) -> Mechanism:
    """A four-bar: class II."""
    points = _drawn(rng, "A0 B0 A B")
    return _made(points, {"crank": "A0 A", "coupler": "A B", "rocker": "B0 B"}, "A0 B0", branches=("B",))


def slider_crank(rng: np.random.Generator) -> Mechanism:
    """An offset slider-crank: class II."""
    points = _drawn(rng, "A0 A B")
    return _made(points, {"crank": "A0 A", "coupler": "A B"}, "A0", slider=("B", rng.uniform(-3, 3)), branches=("B",))


def six_bar(rng: np.random.Generator) -> Mechanism:
    """A six-bar of two dyads, the second on the coupler, the rocker or both: class II."""
    points = _drawn(rng, "A0 B0 D0 A B C D")
    if rng.integers(2):
        links = {"crank": "A0 A", "coupler": "A B C", "rocker": "B0 B", "rod": "C D", "arm": "D0 D"}
        return _made(points, links, "A0 B0 D0", branches=("B", "D"))
    del points["D0"]
    links = {"crank": "A0 A", "coupler": "A B", "rocker": "B0 B C", "rod": "C D"}
    return _made(points, links, "A0 B0", slider=("D", rng.uniform(-3, 3)), branches=("B", "D"))


def stephenson(rng: np.random.Generator) -> Mechanism:
    """Stephenson's third six-bar driven at its dyad: a plate on three links, class III."""
    points = _drawn(rng, "A0 L0 R0 A L R P")
    links = {"crank": "A0 A", "low": "A P", "left": "L0 L", "right": "R0 R", "plate": "L R P"}
    return _made(points, links, "A0 L0 R0")


def plate_with_slider(rng: np.random.Generator) -> Mechanism:
    """A plate on two links and a slider: class III."""
    points = _drawn(rng, "A0 L0 A L R P")
    links = {"crank": "A0 A", "low": "A P", "left": "L0 L", "plate": "L R P"}
    return _made(points, links, "A0 L0", slider=("R", rng.uniform(-3, 3)))


def plate_behind_a_dyad(rng: np.random.Generator) -> Mechanism:
    """A four-bar, a plate on its coupler, rocker and the ground, and a slider-crank behind: dyad, class III, dyad."""
    points = _drawn(rng, "A0 B0 A B C E R0 L R P Q S")
    links = {
        "crank": "A0 A",
        "coupler": "A B C",
        "rocker": "B0 B E",
        "low": "C P",
        "left": "E L",
        "right": "R0 R",
        "plate": "L R P Q",
        "rod": "Q S",
    }
    return _made(points, links, "A0 B0 R0", slider=("S", rng.uniform(-3, 3)), branches=("B", "S"))


CLASS_II: tuple[Callable[[np.random.Generator], Mechanism], ...] = (four_bar, slider_crank, six_bar)
CLASS_III: tuple[Callable[[np.random.Generator], Mechanism], ...] = (stephenson, plate_with_slider)


def _drawn(rng: np.random.Generator, names: str) -> Points:
    """Points at random in a square of 4."""
    return {name: complex(*rng.uniform(-2, 2, 2)) for name in names.split()}


def _made(
    points: Points,
    links: dict[str, str],
    grounded: str,
    *,
    slider: tuple[str, float] | None = None,
    branches: tuple[str, ...] = (),
) -> Mechanism:
    """Links between points drawn in place, pinned where they share one; a slider on the ground; the crank at 0."""
    bodies = [Body(name, {point: points[point] for point in on.split()}) for name, on in links.items()]
    ground = {name: points[name] for name in grounded.split()}
    joints: list[Joint] = []
    if slider:
        name, along = slider
        ground["guide"] = points[name]
        bodies.append(Body("slider", {name: points[name], "guide": points[name]}))
        joints.append(Slide("guide", "slider", GROUND, along))
    bodies.insert(0, Body(GROUND, ground))
    seen: dict[str, str] = {}
    for body in bodies:
        for point in body.points:
            if point == "guide":
                continue
            if point in seen:
                joints.append(Pin(point, seen[point], body.name))
            seen.setdefault(point, body.name)
    made = Mechanism(tuple(bodies), tuple(joints), (Rotation("crank", "A0"),), name="random")
    if not branches:
        return made
    return Mechanism(made.bodies, made.joints, made.inputs, branches=_branches(made, branches), name="random")


def _branches(drawn: Mechanism, names: tuple[str, ...]) -> dict[str, int]:
    """The signs of the closed forms in the pose in which the mechanism is drawn."""
    signs: dict[str, int] = {}
    for name in names:
        for sign in (+1, -1):
            signs[name] = sign
            tried = Mechanism(
                drawn.bodies, drawn.joints, drawn.inputs, branches={**dict.fromkeys(names, 1), **signs}, name="random"
            )
            body = next(pin for pin in tried.joints if pin.name == name).bodies[0]
            at = complex(np.ravel(solve(plan(tried), 0.0).point(body, name).position)[0])
            if abs(at - tried.point(body, name)) < 1e-9:
                break
    return signs

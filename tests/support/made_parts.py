"""Masses of the parts of machines measured on their meshes, tetrahedron by tetrahedron: the code's own moments have no
part in it.

    python -m made_parts --seed 7 --number 200          so many random looms, and machines; the largest deviations
"""

import argparse
import dataclasses
import math
import random
import sys
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from ilmek.arrays import Float
from ilmek.dynamics.inertia import Inertia
from ilmek.errors import IlmekError
from ilmek.linkage.mirror import other
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.beat import GUIDED
from ilmek.machines.beat_up.design import BeatUp
from ilmek.machines.beat_up.links import PART_IDS
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.hammer.tree import COMB
from ilmek.machines.knotting_dyad.drives import head_motion
from ilmek.machines.weft.rapier_tree import RAPIER_BODY
from ilmek.machines.weft.shuttle import Shuttle
from ilmek.machines.weft.tree import DRAGGING, STRAIGHT
from ilmek.params import declared
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.tree import RigidBody, Tree
from ilmek.report.scene import Solid

SETTLED: Mapping[str, Mapping[str, Any]] = {
    "knotting-four-bar": {"link_mass": "made"},
    "tufting": {"link_mass": "made"},
}
"""Parameters with which the forces count the made links."""

FINE, FINEST = 1e-5, 1e-6
"""Deviations of a mesh over the cube root of the part's volume: the finer one where the other is not near enough."""

MASS, TENSOR = 1e-6, 1e-4
"""Largest deviation of masses in forces, and of moments from those of a mesh."""


def changed(machine: str, seed: int) -> Any:
    """The design of a machine with up to four lengths, masses and angles changed by a third; None: it cannot be."""
    chance, params = random.Random(seed), MACHINES[machine].params(**SETTLED.get(machine, {}))
    numbers = [one.name for one in declared(type(params)) if isinstance(getattr(params, one.name), float)]
    picked = chance.sample(numbers, min(len(numbers), chance.randint(0, 4)))
    values = {name: getattr(params, name) * math.exp(chance.uniform(-0.3, 0.3)) for name in picked}
    try:
        return MACHINES[machine].designed(dataclasses.replace(params, **values))
    except IlmekError:
        return None


def measured(solid: Solid, density: float) -> tuple[float, Float[np.ndarray, "3"], Float[np.ndarray, "3 3"]]:
    """Mass, centre and inertia tensor about it of a closed surface, as tetrahedra from its first point.

    One with the corners 0, a, b, c: V = det / 6, the integral of r r^T is V/20 (sum r_i r_i^T + s s^T), s = a + b + c.
    """
    start = solid.points[0]
    corners = solid.points[solid.triangles] - start
    volume = np.linalg.det(corners) / 6
    sums = corners.sum(axis=1)
    second = np.einsum("t,tci,tcj->ij", volume, corners, corners) + np.einsum("t,ti,tj->ij", volume, sums, sums)
    first = np.einsum("t,ti->i", volume, sums) / 4
    whole = float(volume.sum())
    centre = first / whole
    central = second / 20 - whole * np.outer(centre, centre)
    return density * whole, centre + start, density * (np.trace(central) * np.eye(3) - central)


def made_parts(tree: Tree) -> Iterator[Part]:
    """Each part that is made."""
    return (part for part, _ in tree.occurrences() if part.material is not None)


def deviation_of(part: Part) -> float:
    """Greatest relative difference of mass, place of the centre and tensor from those of the mesh."""
    coarse = _deviation(part, FINE)
    return coarse if coarse <= TENSOR else _deviation(part, FINEST)


def _deviation(part: Part, fine: float) -> float:
    assert part.shape is not None
    assert part.material is not None
    size = part.shape.volume ** (1 / 3)
    mass, centre, tensor = measured(part.shape.mesh(fine * size), part.material.density)
    own = part.moments
    assert own is not None
    scale = np.linalg.norm(own.inertia)
    return max(
        abs(mass / part.mass - 1),
        float(np.linalg.norm(centre - own.centre)) / size,
        float(np.linalg.norm(tensor - own.inertia) / scale),
    )


def counted(machine: str, design: Any) -> dict[str, Inertia]:
    """Inertias that the forces of a machine count, by the ids of the bodies."""
    if machine == "knotting-four-bar":
        return {f"{machine}/{body}": inertia for body, inertia in design.inertias.items()}
    if machine == "tufting":
        return {f"{machine}/{body}": inertia for body, inertia in design.bodies.items()}
    if machine == "knotting-dyad":
        arms = head_motion(design.params, design.head).arms
        sides: tuple[Callable[[str], str], ...] = (str, other)
        return {
            f"{machine}/{side(body).replace(' ', '-')}": inertia
            for arm, side in zip(arms.values(), sides, strict=True)
            for body, inertia in arm.loaded.inertias.items()
        }
    return {}


def mass_error(machine: str, design: Any, tree: Tree) -> float:
    """Greatest relative difference of mass, first and second moment of a body in the forces from those of its parts.

    Forces of an arm count closed jaws in its second link.
    """
    worst = _of_follower(design, tree) if machine == "cam" else 0.0
    for name, inertia in counted(machine, design).items():
        jaws = [body for body in tree.bodies if body.parent == name and body.id.endswith(("-finger", "-rod"))]
        bodies = [tree.body(name), *jaws]
        mass = math.fsum(len(own.positions) * _weight(own.part) for body in bodies for own in body.occurrences)
        moments = sum((body.moments.placed(_closed(body)) for body in jaws), bodies[0].moments)
        worst = max(worst, abs(inertia.mass - mass) / (mass or 1.0))
        if mass:
            away = abs(complex(*moments.centre[:2]) - inertia.centre)
            worst = max(worst, away / (abs(inertia.centre) or 1.0), abs(moments.inertia[2, 2] / inertia.moment - 1))
    return worst


def _closed(jaw: RigidBody) -> Placement:
    """Where a body of a jaw is in its gripper while this is closed: a finger opens below its angle then."""
    assert jaw.joint.motion is not None
    return jaw.positions[0].after(placement(about=jaw.joint.axis, angle=float(jaw.joint.motion.rotation.max())))


def moving_error(loom: Any) -> float:
    """Greatest relative difference of the masses that a loom's drives move, in its forces, from those of its parts.

    Beside its parts a shuttle moves the yarn on its bobbin, and each carrier its belt.
    """
    tree, beat, weft = loom_tree(loom), loom.beat.design, loom.weft
    shuttle = isinstance(weft.carried, Shuttle)
    yarn = max(winding.mass for winding in weft.carried.windings) if shuttle else 0.0
    width = weft.axis.belt.belt.widths[-1] if math.isnan(weft.axis.width) else weft.axis.width
    belt = weft.axis.belt.length * width * weft.axis.belt.belt.mass
    pairs = [(weft.axis.mass - yarn - belt, _made(tree, DRAGGING, STRAIGHT) if shuttle else _made(tree, RAPIER_BODY))]
    linkage = beat if isinstance(beat, BeatUp) else beat.linkage and beat.linkage.one
    if linkage:
        number = 1 if isinstance(beat, BeatUp) else beat.linkage.number
        pairs += [(number * linkage.bodies[name].mass, _made(tree, PART_IDS[name])) for name in ("crank", "coupler")]
    if isinstance(beat, BeatUp):
        pairs.append((beat.bodies["rocker"].mass, _made(tree, PART_IDS["rocker"])))
    else:
        rockers = {PART_IDS["rocker"]} if linkage else set()
        sinking = {body.id for body in tree.bodies if loom.params.beat == GUIDED and body.id.startswith("shedding/")}
        moved = number * linkage.bodies["rocker"].mass if linkage else beat.axis.mass
        pairs.append((moved, _made(tree, COMB, *rockers, *sinking)))
    return max(float(abs(forces / made - 1)) for forces, made in pairs)


def _made(tree: Tree, *bodies: str) -> float:
    """Mass of what is weighed of some bodies, each as often as it is there: of made parts volume times density."""
    counts = tree.counts()
    weights = (
        counts[name] * len(own.positions) * _weight(own.part) for name in bodies for own in tree.body(name).occurrences
    )
    return math.fsum(weight for weight in weights if not math.isnan(weight))


def _weight(part: Part) -> float:
    """Volume times density of a made part, else the mass of its catalogue row [kg]."""
    return part.mass if part.shape is None or part.material is None else part.shape.volume * part.material.density


def _of_follower(design: Any, tree: Tree) -> float:
    """Relative difference of the moving mass in a cam's forces from the follower's, no less than its rollers'."""
    if not tree.bodies:
        return 0.0
    mass, rollers = tree.body("cam/follower").moments.zeroth, 0.0
    for one in tree.body("cam/follower").occurrences:
        rollers += len(one.positions) * one.part.mass if one.part.id == "cam/roller" else 0.0
    return float(abs(mass - max(design.params.mass, rollers)) / (mass or 1.0))


QUICK = ("cam", "function-four-bar", "knotting-four-bar", "tufting", "knotting-dyad")
OTHERS = ("beat-up", "hammer", "shedding", "tension-compensator", "warp-tension", "weaver", "weft", "tufting-machine")

EVERY = 10
"""Cases after which the largest deviations so far are printed."""


def random_loom(seed: int) -> Any:
    """A loom of random size, pitch, heads and kind of beat; None: it cannot be."""
    chance, loom = random.Random(seed), MACHINES["automated-loom"]
    wishes = {
        "width": chance.uniform(0.4, 4.0),
        "length": chance.uniform(0.5, 3.0),
        "warp_pitch": chance.choice([0.0015, 0.002, 0.003, 0.004]),
        "heads": chance.choice([1, 2, 4, 8]),
        "beat": chance.choice(["travelling", "linkage", "comb", "guide-cams"]),
    }
    try:
        return loom.designed(loom.params(**wishes))
    except IlmekError:
        return None


def main() -> int:
    """Random looms and machines in turn; end with 1 for a deviation that is too large."""
    parser = argparse.ArgumentParser(prog="python -m made_parts", description=__doc__)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--number", type=int, default=200)
    given = parser.parse_args()
    worst, masses, looms, machines = dict[str, tuple[float, str]](), 0.0, 0, 0
    for number in range(given.number):
        seed, name = 1000 * given.seed + number, (*QUICK, *OTHERS)[number % (len(QUICK) + len(OTHERS))]
        design, loom = changed(name, seed), random_loom(seed)
        if design is not None:
            tree_of = MACHINES[name].tree
            assert tree_of is not None
            tree, machines = tree_of(design), machines + 1
            masses = max(masses, mass_error(name, design, tree))
            _measure(tree, f"{name}, seed {seed}", worst)
        if loom is not None:
            looms, masses = looms + 1, max(masses, moving_error(loom))
            _measure(loom_tree(loom), f"loom, seed {seed}", worst)
        if (number + 1) % EVERY == 0 or number + 1 == given.number:
            (part, (found, where)) = max(worst.items(), key=lambda entry: entry[1])
            _show(
                f"{looms} looms, {machines} machines: a mass in the forces {masses:.1e} off, "
                f"a part from its mesh {found:.1e}: {part} of {where}"
            )
    return int(masses > MASS or max(worst.values())[0] > TENSOR)


def _measure(tree: Tree, where: str, worst: dict[str, tuple[float, str]]) -> None:
    for part in made_parts(tree):
        worst[part.id] = max(worst.get(part.id, (0.0, "")), (deviation_of(part), where))


def _show(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())

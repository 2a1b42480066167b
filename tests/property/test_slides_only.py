"""Machines that only translate: chains and trees of slides against their closed form.

Every direction is fixed, so that a body is at the sum of its displacements along fixed lines, and the force in a slide
is what the bodies that it carries need: sum of m a - F.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse_run import inverse_run
from ilmek.dynamics.loads import PointForce, Torque
from ilmek.dynamics.own_machine import NamedLoad, OwnMachine
from ilmek.linkage.batch import solve_batch
from ilmek.linkage.model import GROUND, Body, Displacement, Mechanism, Slide
from ilmek.linkage.outputs import Travel, output_history
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan

SAMPLES = 7


class Tree:
    """Bodies on slides, each on the ground or on a body before it, with all its numbers in the world."""

    def __init__(self, seed: int, bodies: int) -> None:
        draw = np.random.default_rng(seed)
        self.names = [f"car {k}" for k in range(bodies)]
        self.parent = [int(draw.integers(-1, k)) if k else -1 for k in range(bodies)]
        numbers = draw.uniform(-1, 1, (bodies, 14))
        self.root, self.at = numbers[:, 0] + 1j * numbers[:, 1], numbers[:, 2] + 1j * numbers[:, 3]
        self.along, self.turned = np.pi * numbers[:, 4], np.pi * numbers[:, 5]
        self.centre, self.mass = numbers[:, 6] + 1j * numbers[:, 7], 2 + numbers[:, 8]
        self.point, self.force = numbers[:, 9] + 1j * numbers[:, 10], 10 * (numbers[:, 11] + 1j * numbers[:, 12])
        self.torque, self.gravity = numbers[:, 13], complex(*draw.uniform(-9, 9, 2))
        self.rates = draw.uniform(-1, 1, (3, bodies, SAMPLES))
        self.direction = np.ones(bodies, dtype=complex)
        self.line = np.ones(bodies, dtype=complex)
        for k, parent in enumerate(self.parent):
            frame = self.direction[parent] if parent >= 0 else 1.0
            self.direction[k], self.line[k] = frame * np.exp(1j * self.turned[k]), frame * np.exp(1j * self.along[k])

    def mechanism(self) -> Mechanism:
        guides = [self.names[parent] if parent >= 0 else GROUND for parent in self.parent]
        points: dict[str, dict[str, complex]] = {GROUND: {}, **{name: {} for name in self.names}}
        for k, (name, guide) in enumerate(zip(self.names, guides, strict=True)):
            points[guide][f"slide {k}"] = complex(self.root[k])
            points[name] |= {f"slide {k}": complex(self.at[k]), "tool": complex(self.point[k])}
        return Mechanism(
            tuple(Body(name, own) for name, own in points.items()),
            tuple(
                Slide(f"slide {k}", name, guide, float(self.along[k]), float(self.turned[k]))
                for k, (name, guide) in enumerate(zip(self.names, guides, strict=True))
            ),
            tuple(Displacement(f"slide {k}") for k in range(len(self.names))),
        )

    def machine(self) -> OwnMachine:
        loads = [
            NamedLoad(f"f {name}", PointForce((name, "tool"), complex(f)))
            for name, f in zip(self.names, self.force, strict=True)
        ]
        loads += [
            NamedLoad(f"t {name}", Torque(name, float(t))) for name, t in zip(self.names, self.torque, strict=True)
        ]
        inertias = {
            name: Inertia(float(self.mass[k]), complex(self.centre[k]), 0.3) for k, name in enumerate(self.names)
        }
        return OwnMachine(self.mechanism(), inertias=inertias, loads=tuple(loads), gravity=self.gravity)

    def origins(self, order: int) -> np.ndarray:
        """Origins of the bodies, or their rates: (bodies, samples)."""
        origin = np.zeros((len(self.names), SAMPLES), dtype=complex)
        for k, parent in enumerate(self.parent):
            if order == 0:
                frame = self.direction[parent] if parent >= 0 else 1.0
                base = origin[parent] if parent >= 0 else 0.0
                origin[k] = base + frame * self.root[k] - self.direction[k] * self.at[k]
            elif parent >= 0:
                origin[k] = origin[parent]
            origin[k] += self.line[k] * self.rates[order, k]
        return origin

    def carried(self, k: int) -> list[int]:
        """The bodies that slide k carries."""
        every = [k]
        for body, parent in enumerate(self.parent):
            every += [body] if parent in every and body > k else []
        return every

    def wrench(self, k: int) -> tuple[np.ndarray, np.ndarray]:
        """Force on the bodies that slide k carries, and its moment about the slide's point of its body."""
        origins, accelerations = self.origins(0), self.origins(2)
        about = origins[k] + self.direction[k] * self.at[k]
        force, moment = np.zeros(SAMPLES, dtype=complex), np.zeros(SAMPLES)
        for body in self.carried(k):
            inertial = self.mass[body] * (accelerations[body] - self.gravity)
            centre = origins[body] + self.direction[body] * self.centre[body]
            tool = origins[body] + self.direction[body] * self.point[body]
            force += inertial - self.force[body]
            moment += np.imag(np.conj(centre - about) * inertial)
            moment -= np.imag(np.conj(tool - about) * self.force[body]) + self.torque[body]
        return force, moment


@given(st.integers(0, 2**32), st.integers(1, 5))
def test_positions_rates_and_forces_are_those_of_the_closed_form(seed: int, bodies: int) -> None:
    tree = Tree(seed, bodies)
    machine = tree.machine()
    inputs = [{f"slide {k}": rates[k] for k in range(bodies)} for rates in tree.rates]
    planned = plan(machine.mechanism)
    for solver in (solve, solve_batch):
        motion = solver(planned, *inputs)
        for k, name in enumerate(tree.names):
            body = motion.point(name, "tool")
            tool = tree.direction[k] * tree.point[k]
            assert body.position == pytest.approx(tree.origins(0)[k] + tool, abs=1e-12)
            assert body.velocity == pytest.approx(tree.origins(1)[k], abs=1e-12)
            assert body.acceleration == pytest.approx(tree.origins(2)[k], abs=1e-12)
            travel = output_history(motion, Travel(f"slide {k}"))
            for history, rates in zip((travel.value, travel.rate, travel.second_rate), tree.rates, strict=True):
                assert history == pytest.approx(rates[k], abs=1e-12)
    run = inverse_run(machine, motion, "slide 0", np.arange(SAMPLES, dtype=float))
    for k in range(bodies):
        force, moment = tree.wrench(k)
        line = tree.line[k]
        assert run.forces.efforts[f"slide {k}"] == pytest.approx(np.real(np.conj(line) * force), abs=1e-9)
        across = 1j * line * np.imag(np.conj(line) * force)
        assert run.forces.reactions[f"slide {k}"] == pytest.approx(across, abs=1e-9)
        assert run.forces.couples[f"slide {k}"] == pytest.approx(moment, abs=1e-9)
    assert run.balance < 1e-9
    assert run.power_residual < 1e-9

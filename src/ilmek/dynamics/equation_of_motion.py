"""Equation of motion of a mechanism with any number of inputs and with friction in its joints.

    D(q) q'' + b(q, q') + Σ x_k r_k(q) = M - W q'',    x_k + s_k lim_k(F) = 0,    F = F_0 + Σ q''_i F_i + Σ x_k G_k

q inputs [rad; m], M efforts of their drives, W inertias that move with them, x friction efforts of the joints, s signs
of the joints' speeds, F joint forces, lim Coulomb's limit of a joint. Inverse dynamics at q'' = 0 and at each unit
acceleration gives b, D, F_0 and F_i; unit efforts in the joints give r and G. So all is exact, and all but the limits
is linear: q'' is eliminated, and x is found as in `joint_friction`.

While no joint with friction reverses, s is constant and the equation smooth; a run is integrated from reversal to
reversal. At one, the accelerations without the friction of the resting joints give the directions in which they would
move. Where friction then acts against that, it holds them.                    [Newton-Euler; Coulomb; derived here]
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ilmek.arrays import BoolArray, Float, FloatArray
from ilmek.dynamics.equations import Pulls, input_efforts, joint_pulls, loaded, needs
from ilmek.dynamics.forward_run import Drive, ForwardState, Row
from ilmek.dynamics.inverse import MASSLESS, load_power
from ilmek.dynamics.joint_friction import EffortLaw, Separation, components, consistent, second_rate, separations
from ilmek.dynamics.loads import Gravity
from ilmek.dynamics.pose_block import ForceAndMoment, PoseBlock, pose_block
from ilmek.dynamics.reduced import ReducedMechanism, Samples
from ilmek.dynamics.undetermined import undetermined
from ilmek.errors import MechanismError
from ilmek.linkage.model import GROUND
from ilmek.linkage.solve import solve
from ilmek.records import record

AHEAD = 1e-6
"""How far ahead the direction is sought in which a joint begins to move [rad; m]."""


@record
class StateTerms:
    """The linear terms at a state, with poses in 1 + inputs + laws samples: without acceleration, then with each unit
    acceleration, then, without loads, with the unit effort of each law.

    matrix     D + W, shape (inputs, inputs)      rest  b, shape (inputs,)
    levers     r, shape (inputs, laws)            forces, responses  components of F by sample, and of each G
    power      of the loads except gravity, and of viscous friction [W]
    """

    poses: PoseBlock
    matrix: FloatArray
    rest: FloatArray
    levers: FloatArray
    forces: Float[np.ndarray, "laws 2 accelerations"]
    responses: Float[np.ndarray, "laws laws 2"]
    power: float


@record
class GeneralEquation:
    """The equation of motion with the signs of its frictions.

    drives  of the inputs, in their order; None: none
    laws    dry frictions of joints, then forces that separate teeth: these load joints with friction
    signs   of the speeds in the joints of the laws; those of teeth are -1
    """

    reduced: ReducedMechanism
    drives: tuple[Drive | None, ...]
    laws: tuple[EffortLaw, ...]
    signs: tuple[float, ...]

    def rates(self, time: float, row: Row) -> Row:
        """Time derivative of a row; NaN where the mechanism does not close, or friction locks it."""
        count = len(self.drives)
        terms = self.terms(time, row) if np.isfinite(row).all() else None
        if terms is None:
            return np.full(len(row), np.nan)
        efforts, speed = self.efforts(time, row), row[count : 2 * count]
        acceleration, frictions = self.moved(terms, efforts, self.signs)
        rubbing = frictions[: self.dry] @ self.speeds(terms.poses)
        return np.concatenate((speed, acceleration, [efforts @ speed, terms.power + rubbing]))

    def efforts(self, time: float, row: Row) -> Float[np.ndarray, " inputs"]:
        """Efforts of the drives [N m; N]."""
        count = len(self.drives)
        states = zip(self.drives, row[:count].tolist(), row[count : 2 * count].tolist(), strict=True)
        return np.array([0.0 if drive is None else float(drive(time, at, speed)) for drive, at, speed in states])

    def terms(self, time: float, row: Row) -> StateTerms | None:
        """The terms at a row; None where the mechanism does not close."""
        names, count = tuple(self.reduced.wheels), len(self.drives)
        samples = 1 + count + len(self.laws)
        units = np.eye(samples)
        whole = np.where(np.arange(samples) <= count, 1.0, 0.0)
        values, speeds = (
            {name: np.full(samples, one) for name, one in zip(names, part, strict=True)}
            for part in (row[:count], row[count : 2 * count])
        )
        solved = solve(self.reduced.plan, values, speeds, dict(zip(names, units[1:], strict=False)))
        if solved.status.any():
            return None
        motion = replace(solved, time=np.full(samples, time))
        bodies = {body: self.reduced.inertias.get(body, MASSLESS) for body in motion.plan.mechanism.moving}
        poses = pose_block(motion, bodies)
        loads = (*self.reduced.weights, *self.reduced.steady, *self.reduced.live)
        wrenches = [(load, wrench) for load in loads for wrench in load.wrenches(motion, bodies)]
        acting = [wrench for _, wrench in wrenches if wrench.body != GROUND]
        needed = {
            body: ForceAndMoment(need.force * whole, need.moment * whole)
            for body, need in needs(poses, bodies, acting).items()
        }
        drag = {law.joint: -law.drag * _rate(poses, law.joint) for law in self.reduced.frictions if law.drag}
        rubbing = {joint: effort * whole for joint, effort in drag.items()}
        for law, unit in zip(self.laws, units[1 + count :], strict=True):
            rubbing[law.joint] = rubbing.get(law.joint, 0.0) + unit
        pulls = joint_pulls(poses, loaded(poses, needed, rubbing))
        joints, efforts = [poses.joints[law.joint] for law in self.laws], _driven(poses, pulls)
        parts = components(joints, self.laws, pulls, samples, whole)
        others = [wrench for load, wrench in wrenches if not isinstance(load, Gravity) and wrench.body != GROUND]
        power = load_power(poses, others) + sum(effort * _rate(poses, joint) for joint, effort in drag.items())
        return StateTerms(
            poses,
            (efforts[1 : count + 1] - efforts[0]).T + np.diag(list(self.reduced.wheels.values())),
            efforts[0],
            efforts[count + 1 :].T,
            parts[..., : count + 1],
            np.moveaxis(parts[..., count + 1 :], -1, 0),
            float(np.broadcast_to(power, samples)[0]),
        )

    def moved(
        self, terms: StateTerms, efforts: FloatArray, signs: Sequence[float]
    ) -> tuple[Float[np.ndarray, " inputs"], Float[np.ndarray, " laws"]]:
        """Accelerations of the inputs, and the dry friction efforts; NaN where friction locks the mechanism."""
        try:
            free = np.linalg.solve(terms.matrix, efforts - terms.rest)
            shifts = np.linalg.solve(terms.matrix, terms.levers)
        except np.linalg.LinAlgError:
            raise MechanismError(
                f"no mass moves with an input of {self.reduced.plan.mechanism.name}",
                do="give each input a flywheel, or a mass that it moves",
            ) from None
        if not self.laws:
            return free, np.zeros(0)
        changes = terms.forces[..., 1:] - terms.forces[..., :1]
        start = terms.forces[..., 0] + changes @ free
        responses = terms.responses - np.einsum("lci,ik->klc", changes, shifts)
        found, _ = consistent(self.laws, np.array(signs)[:, None], start[..., None], responses[..., None])
        frictions: FloatArray = found[:, 0]
        return free - shifts @ frictions, frictions

    @property
    def dry(self) -> int:
        """Number of the laws that are friction."""
        return sum(not isinstance(law, Separation) for law in self.laws)

    def speeds(self, poses: PoseBlock) -> Float[np.ndarray, " dry"]:
        """Speeds in the joints with dry friction [rad/s; m/s]."""
        return np.array([_rate(poses, law.joint) for law in self.laws[: self.dry]])

    def state(self, time: float, row: Row) -> ForwardState:
        """Position and speed of a row."""
        count = len(self.drives)
        if count == 1:
            return ForwardState(float(row[0]), float(row[1]), time)
        return ForwardState(row[:count].copy(), row[count : 2 * count].copy(), time)

    def first(self, start: ForwardState) -> tuple[Row, Row]:
        """The first row, and the scale of the errors: 1 rad, and speed and energy at the start or of the efforts."""
        position, speed = np.atleast_1d(start.position), np.atleast_1d(start.speed)
        row = np.concatenate((position, speed, np.zeros(2)))
        terms, efforts = self.terms(start.time, row), self.efforts(start.time, row)
        if terms is None or not np.isfinite(np.concatenate((efforts, terms.rest))).all():
            raise MechanismError("effort of a drive or a load is not finite at the start", allowed="finite efforts")
        size = float(np.abs(efforts).sum() + np.abs(terms.rest).sum())
        energy = max(float(speed @ terms.matrix @ speed) / 2, size) or float(np.trace(terms.matrix))
        quick = (
            np.sqrt(2 * energy / np.diag(terms.matrix)) if (np.diag(terms.matrix) > 0).all() else np.ones(len(speed))
        )
        return row, np.concatenate((np.ones(len(speed)), quick, np.full(2, energy)))

    def history(self, time: Samples, rows: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Speeds, accelerations and efforts of the drives at rows, shape (inputs, samples) or (samples,) of one."""
        count = len(self.drives)
        found = np.empty((3, count, len(time)))
        for k, (at, row) in enumerate(zip(time.tolist(), rows, strict=True)):
            terms, efforts = self.terms(at, row), self.efforts(at, row)
            acceleration = self.moved(terms, efforts, self.signs)[0] if terms else np.full(count, np.nan)
            found[:, :, k] = row[count : 2 * count], acceleration, efforts
        speed, acceleration, effort = found[:, 0] if count == 1 else found
        return speed, acceleration, effort

    def along(self, time: float, row: Row) -> Float[np.ndarray, " dry"]:
        """Speed in each joint with dry friction times its sign: negative where it has reversed; NaN: does not close."""
        terms = self.terms(time, row) if self.dry else None
        return self.speeds(terms.poses) * self.signs[: self.dry] if terms else np.full(self.dry, np.nan)

    def turned(self, time: float, row: Row, resting: BoolArray) -> "GeneralEquation | None":
        """The equation after a state in which some joints with dry friction rest; None: friction holds one of them."""
        terms, efforts = self.terms(time, row), self.efforts(time, row)
        if terms is None:
            return self
        held = np.array(self.signs)
        held[: self.dry][resting] = 0.0
        seconds = self._seconds(terms)
        if not row[len(efforts) : 2 * len(efforts)].any():
            # Where all inputs rest at a dead centre of the joint, its acceleration is 0 too: look ahead.
            begun, _ = self.moved(terms, efforts, held.tolist())
            ahead = row.copy()
            ahead[: len(efforts)] += AHEAD * begun / (np.abs(begun).max() or 1.0)
            later = self.terms(time, ahead)
            seconds = seconds if later is None else self._seconds(later)

        def starts(signs: FloatArray) -> FloatArray:
            acceleration, _ = self.moved(terms, efforts, signs.tolist())
            return seconds[:, 0] + (seconds[:, 1:] - seconds[:, :1]) @ acceleration

        begins = np.sign(starts(held))
        held[: self.dry][resting] = begins[resting]
        if not (starts(held) * begins > 0)[resting].all():
            return None
        return replace(self, signs=tuple(held.tolist()))

    def departed(self, time: float, row: Row, direction: float) -> "GeneralEquation":
        """The equation of one input that leaves its rest in a direction, +1 or -1, with the signs just ahead."""
        ahead = row.copy()
        ahead[0] += direction * AHEAD
        terms = self.terms(time, ahead) if self.dry else None
        if terms is None:
            return self
        return replace(self, signs=(*np.sign(self.speeds(terms.poses)).tolist(), *self.signs[self.dry :]))

    def _seconds(self, terms: StateTerms) -> Float[np.ndarray, "dry accelerations"]:
        """Accelerations in the joints with dry friction, without and with each unit acceleration of an input."""
        joints = [terms.poses.joints[law.joint] for law in self.laws[: self.dry]]
        return np.stack([second_rate(terms.poses, joint) for joint in joints])[:, : len(self.drives) + 1]


def general_equation(reduced: ReducedMechanism, drives: Sequence[Drive | None], start: ForwardState) -> GeneralEquation:
    """The equation at a start at which the mechanism closes; the signs of joints that rest are still 0.

    Friction that the equations do not determine, as in a joint that a belt's tension loads, is left out.
    """
    bare = GeneralEquation(reduced, tuple(drives), (), ())
    terms = bare.terms(start.time, bare.first(start)[0])
    assert terms is not None
    bodies = {body: reduced.inertias.get(body, MASSLESS) for body in reduced.plan.mechanism.moving}
    open_ = undetermined(terms.poses, bodies, reduced.frictions).frictions
    dry = [law for law in reduced.frictions if law.dry and law.joint not in open_]
    teeth = [*separations(reduced.plan.mechanism)] if dry else []
    signs = [float(np.sign(_rate(terms.poses, law.joint))) for law in dry]
    return replace(bare, laws=(*dry, *teeth), signs=(*signs, *(-1.0 for _ in teeth)))


def _rate(poses: PoseBlock, joint: str) -> float:
    """Speed in a joint [rad/s; m/s], the same in all samples."""
    return float(np.ravel(poses.rate(poses.joints[joint]))[0])


def _driven(poses: PoseBlock, pulls: Pulls) -> FloatArray:
    """Efforts of the inputs on their driven bodies, shape (samples, inputs)."""
    signs = [1.0 if name in (joint.on, joint.name) else -1.0 for name, joint in poses.drivers.items()]
    return input_efforts(poses, pulls, len(poses.motion)) * signs

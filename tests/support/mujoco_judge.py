"""A tree of bodies written as MJCF, read and moved by MuJoCo: the judge of its joints, its closures and its contacts.

Of the project it takes nothing but the text of the file: the tables in it move the driven joints, and the others follow
by Newton's method on MuJoCo's own residuals and Jacobian of the closures.
"""

from collections.abc import Mapping

import mujoco
import numpy as np

_SMALL, _STEPS, _TURNED = 1e-10, 30, 0.05


class Judge:
    """A model, with the tables of its motions by joint."""

    def __init__(self, text: str) -> None:
        self.model = mujoco.MjModel.from_xml_string(text)
        self.data = mujoco.MjData(self.model)
        model = self.model
        mujoco.mj_resetDataKeyframe(model, self.data, 0)
        tables: dict[str, tuple[str, np.ndarray]] = {}
        for number in range(model.nnumeric):
            drive, between, joint = model.numeric(number).name.partition(": ")
            if between:
                tables[joint] = drive, model.numeric(number).data.reshape(-1, 2)
        self.tables = tables
        self.driven = {model.actuator(number).name for number in range(model.nu)}
        self.following = [number for number in range(model.nv) if model.joint(number).name not in self.driven]

    @property
    def drives(self) -> tuple[str, ...]:
        """The drives of the tables."""
        return tuple(dict.fromkeys(drive for drive, _ in self.tables.values()))

    def place(self) -> None:
        """Put the bodies where the joints have them."""
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)

    def closures(self) -> tuple[np.ndarray, np.ndarray]:
        """Residuals of the closures, and their derivatives by the joints, in the present position."""
        model, data = self.model, self.data
        self.place()
        mujoco.mj_makeConstraint(model, data)
        rows = np.flatnonzero(data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY)
        jacobian = np.zeros((data.nefc, model.nv))
        if mujoco.mj_isSparse(model):
            mujoco.mju_sparse2dense(jacobian, data.efc_J, data.efc_J_rownnz, data.efc_J_rowadr, data.efc_J_colind)
        else:
            jacobian[:] = data.efc_J.reshape(data.nefc, model.nv)
        return data.efc_pos[rows].copy(), jacobian[rows]

    def degrees_of_freedom(self, *, transmissions: bool = False) -> int:
        """Joints less the rank of the closures, at the present position; of transmissions, too, if these are asked."""
        if transmissions:
            self.data.eq_active[:] = 1
        _, jacobian = self.closures()
        self.data.eq_active[:] = self.model.eq_active0
        return int(self.model.nv - (np.linalg.matrix_rank(jacobian, tol=1e-7) if len(jacobian) else 0))

    def follow(self, drive: str, angle: float) -> None:
        """Set all joints by their tables at an angle of a drive, others at 0; then close the loops by the others."""
        for joint, (own, table) in self.tables.items():
            at = angle if own == drive else 0.0
            self.data.joint(joint).qpos[0] = np.interp(at, table[:, 0], table[:, 1])
        self.close()

    def close(self) -> None:
        """Newton's method on the joints that are not driven."""
        for _ in range(_STEPS if self.following else 0):
            residual, jacobian = self.closures()
            if np.abs(residual).max() < _SMALL:
                break
            step = np.linalg.lstsq(jacobian[:, self.following], -residual, rcond=1e-9)[0]
            self.data.qpos[self.following] += step
        else:
            assert not self.following, "the loops do not close"

    def contacts(self, drive: str, angle: float) -> Mapping[tuple[str, str], float]:
        """Depth of the contacts of two bodies with tables at an angle of a drive [m]."""
        self.follow(drive, angle)
        self.place()
        mujoco.mj_collision(self.model, self.data)
        depths: dict[tuple[str, str], float] = {}
        for contact in self.data.contact[: self.data.ncon]:
            first, other = sorted(self.model.body(self.model.geom_bodyid[geom]).name for geom in contact.geom)
            depths[first, other] = max(depths.get((first, other), 0.0), -float(contact.dist))
        return depths

    def turn(self, joint: str, value: float, speed: float) -> None:
        """Turn a driven joint to a value by small steps, then let it go on at a constant speed: q, v and a of all."""
        data, column = self.data, self.model.joint(joint).id
        for at in np.linspace(data.qpos[column], value, 2 + int(abs(value - data.qpos[column]) / _TURNED)):
            data.qpos[column] = at
            self.close()
        at, step = data.qpos.copy(), 1e-4
        beside = []
        for aside in (-step, step):
            data.qpos[:] = at
            data.qpos[column] += aside
            self.close()
            beside.append(data.qpos.copy())
        data.qpos[:] = at
        data.qvel[:] = (beside[1] - beside[0]) / (2 * step) * speed
        data.qacc[:] = (beside[1] - 2 * at + beside[0]) / step**2 * speed**2

    def effort(self, joint: str) -> float:
        """Force or torque of a driven joint at the present position, velocity and acceleration.

        Of MuJoCo's inverse dynamics without the closures, by the power of all joints over the velocity of this one:
        the velocities of the joints in its loop are those that the closures leave.
        """
        model, data = self.model, self.data
        _, jacobian = self.closures()
        column = model.joint(joint).id
        velocity = np.zeros(model.nv)
        velocity[column] = 1.0
        if self.following:
            velocity[self.following] = np.linalg.lstsq(jacobian[:, self.following], -jacobian[:, column], rcond=1e-9)[0]
        model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
        mujoco.mj_inverse(model, data)
        model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
        return float(velocity @ data.qfrc_inverse)

"""The beat-up's crank-rocker in other engines: .3/.0597/.2007/.2308 m, .129/.434/.649 kg, bars, fall 9.81 m/s².

It starts with its crank at 0, at a given speed, under a torque that may fall with the speed: T - D omega.

exudyn   rigid bodies and revolute joints in the plane, generalised alpha, joints held in position (index 3)
mujoco   a tree of hinges closed by `connect`, whose springs are made as stiff as the step allows (solref = 2 h, full
         impedance); Runge-Kutta of order 4. The loop is never shut exactly, and the error falls with h.
"""

import math

import exudyn as exu
import exudyn.itemInterface as eii
import mujoco
import numpy as np

GROUND_LINK, CRANK, COUPLER, ROCKER = 0.3, 0.0597, 0.2007, 0.2308
LENGTH = {"crank": CRANK, "coupler": COUPLER, "rocker": ROCKER}
MASS = {"crank": 0.129, "coupler": 0.434, "rocker": 0.649}
FALL = 9.81


def pose(angle: float) -> dict[str, tuple[complex, float]]:
    """Each bar's first pin and angle, by circles."""
    a = CRANK * np.exp(1j * angle)
    d = GROUND_LINK - a
    along = 0.5 * (1 + (COUPLER**2 - ROCKER**2) / abs(d) ** 2)
    b = a + d * (along + 1j * math.sqrt(COUPLER**2 / abs(d) ** 2 - along**2))
    return {"crank": (0j, angle), "coupler": (a, float(np.angle(b - a))),
            "rocker": (GROUND_LINK + 0j, float(np.angle(b - GROUND_LINK)))}  # fmt: skip


def rates(angle: float, speed: float) -> dict[str, tuple[complex, float]]:
    """Velocity of each bar's first pin and its angular velocity."""
    at = pose(angle)
    u, w = (LENGTH[name] * np.exp(1j * at[name][1]) for name in ("coupler", "rocker"))
    v = 1j * speed * at["coupler"][0]
    # v + i wb u = i wc w
    coupler, rocker = np.linalg.solve(
        [[-(1j * u).real, (1j * w).real], [-(1j * u).imag, (1j * w).imag]], [v.real, v.imag]
    )
    return {"crank": (0j, speed), "coupler": (complex(v), float(coupler)), "rocker": (0j, float(rocker))}


def exudyn_angle(duration: float, h: float, speed: float = 20.0, torque: float = 0.0, drag: float = 0.0) -> float:
    """Crank angle at the end [rad] by exudyn."""
    container = exu.SystemContainer()
    system = container.AddSystem()
    ground = system.AddObject(eii.ObjectGround())
    at, moving = pose(0.0), rates(0.0, speed)
    nodes, bodies = {}, {}
    for name, length in LENGTH.items():
        origin, angle = at[name]
        arm = 0.5 * length * np.exp(1j * angle)
        velocity = moving[name][0] + 1j * moving[name][1] * arm
        place = origin + arm
        mass, moment = MASS[name], MASS[name] * length**2 / 12
        start = [velocity.real, velocity.imag, moving[name][1]]
        node = eii.NodeRigidBody2D(referenceCoordinates=[place.real, place.imag, angle], initialVelocities=start)
        nodes[name] = system.AddNode(node)
        bodies[name] = system.AddObject(eii.ObjectRigidBody2D(mass=mass, inertia=moment, nodeNumber=nodes[name]))
        marker = system.AddMarker(eii.MarkerBodyMass(bodyNumber=bodies[name]))
        system.AddLoad(eii.LoadMassProportional(markerNumber=marker, loadVector=[0, -FALL, 0]))

    def marker(name: str | None, x: float) -> int:
        body = ground if name is None else bodies[name]
        found: int = system.AddMarker(eii.MarkerBodyPosition(bodyNumber=body, localPosition=[x, 0, 0]))
        return found

    ends = (
        (marker(None, 0), marker("crank", -CRANK / 2)),
        (marker("crank", CRANK / 2), marker("coupler", -COUPLER / 2)),
        (marker("coupler", COUPLER / 2), marker("rocker", ROCKER / 2)),
        (marker(None, GROUND_LINK), marker("rocker", -ROCKER / 2)),
    )
    for pair in ends:
        system.AddObject(eii.ObjectJointRevolute2D(markerNumbers=list(pair)))
    if torque or drag:
        turning = system.AddMarker(eii.MarkerBodyRigid(bodyNumber=bodies["crank"], localPosition=[0, 0, 0]))
        system.AddLoad(eii.LoadTorqueVector(markerNumber=turning, loadVector=[0, 0, torque]))
        spin = system.AddMarker(eii.MarkerNodeCoordinate(nodeNumber=nodes["crank"], coordinate=2))
        still = system.AddMarker(
            eii.MarkerNodeCoordinate(nodeNumber=system.AddNode(eii.NodePointGround()), coordinate=0)
        )
        system.AddObject(eii.ObjectConnectorCoordinateSpringDamper(markerNumbers=[still, spin], damping=drag))
    system.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.endTime, settings.timeIntegration.numberOfSteps = duration, round(duration / h)
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.9
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    settings.timeIntegration.newton.relativeTolerance = 1e-10
    system.SolveDynamic(settings)
    return float(system.GetNodeOutput(nodes["crank"], exu.OutputVariableType.Coordinates)[2])


TREE = """
<mujoco><option timestep="{h}" integrator="RK4" gravity="0 {fall} 0" tolerance="1e-12"/>
<default><equality solref="{stiff} 1" solimp="0.9999 0.9999 0.001 0.5 2"/></default>
<worldbody>
 <body name="crank" pos="0 0 0"><joint name="crank" type="hinge" axis="0 0 1" damping="{drag}"/>{crank}
  <body name="coupler" pos="{crank_length} 0 0"><joint name="coupler" type="hinge" axis="0 0 1"/>{coupler}</body></body>
 <body name="rocker" pos="{ground} 0 0"><joint name="rocker" type="hinge" axis="0 0 1"/>{rocker}</body>
</worldbody>
<equality><connect body1="coupler" body2="rocker" anchor="{coupler_length} 0 0"/></equality>
</mujoco>"""


def mujoco_angle(duration: float, h: float, speed: float = 20.0, torque: float = 0.0, drag: float = 0.0) -> float:
    """Crank angle at the end [rad] by mujoco."""
    bars = {
        name: f'<inertial pos="{length / 2} 0 0" mass="{MASS[name]}" diaginertia="1e-6 {MASS[name] * length**2 / 12} '
        f'{MASS[name] * length**2 / 12}"/>'
        for name, length in LENGTH.items()
    }
    text = TREE.format(
        h=h, fall=-FALL, stiff=2 * h, drag=drag, crank_length=CRANK, coupler_length=COUPLER, ground=GROUND_LINK, **bars
    )
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    at, moving = pose(0.0), rates(0.0, speed)
    crank, coupler, rocker = (at[name][1] for name in ("crank", "coupler", "rocker"))
    data.qpos[:] = crank, coupler - crank, rocker
    data.qvel[:] = speed, moving["coupler"][1] - speed, moving["rocker"][1]
    model.eq_data[0, :3] = COUPLER, 0, 0
    model.eq_data[0, 3:6] = ROCKER, 0, 0
    data.qfrc_applied[0] = torque
    for _ in range(round(duration / h)):
        mujoco.mj_step(model, data)
    return float(data.qpos[0])

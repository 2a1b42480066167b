"""Internal forces of a rigid link over a motion: axial force, shear and bending moment along it.

The link is a frame of straight beams through its joints and the points where loads act: the shortest tree that
connects them. Three joints give the two shorter sides of their triangle; the third side, which a plate also has, only
makes it stiffer. A section at s of a beam from u to v with the direction e carries all that acts beyond it, on the
side of v (d'Alembert):

    N = e · Σ F,   V = e x Σ F,   M = Σ (r x F + T),   dF = μ (g - a) ds + masses at the ends

where a is the acceleration of the rigid body at that point. μ is the mass per length of the beams; the rest of the
body's mass is split between the ends of the beam nearest its centre by the lever rule; what then remains of the given
mass centre and moment of inertia acts as force and couple at that centre. The loads of the whole body are in
equilibrium by the equations of motion (`equilibrium_error`).
                                        [d'Alembert; Norton, Design of Machinery, chapter 11; method of sections]
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np

from ilmek.arrays import ComplexArray, ComplexField, FloatArray, RealField
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.inverse import MASSLESS, Forces
from ilmek.dynamics.link_frame import SAME, LinkFrame, frame_through, with_masses
from ilmek.dynamics.loads import Gravity, Load
from ilmek.dynamics.pose_block import PoseBlock, pose_block
from ilmek.linkage.model import Joint, Mechanism, Slide
from ilmek.plane.vectors import cross, dot
from ilmek.records import record

_ROUNDING = 1e-13
"""Share of a beam's length by which a point of its link differs by rounding."""

STATIONS = 33
"""Sections of each beam at which the forces are computed, both ends included."""


@record
class BeamForces:
    """Internal forces of a straight beam of a link.

    start, end  names of its ends        length  [m]        at  positions from its start [m], (stations,)
    axial       N [N], tension positive, (stations, samples)      shear   V [N], the same shape
    moment      M [N m], the same shape
    """

    start: str
    end: str
    length: float
    at: FloatArray
    axial: FloatArray
    shear: FloatArray
    moment: FloatArray


@record
class LinkForces:
    """Internal forces of a link.

    body    its name             beams   of the frame; () of a body with all its joints and loads at one point
    points  name -> position in the body's frame [m] of each node       joints  names of the nodes with a joint
    masses  node -> mass there [kg]      line_mass   of the beams [kg/m]
    equilibrium_error  greatest sum of all forces and moments on the body, over that of their magnitudes [1]: rounding
    """

    body: str
    beams: tuple[BeamForces, ...]
    points: Mapping[str, complex]
    joints: frozenset[str]
    masses: Mapping[str, float]
    line_mass: float
    equilibrium_error: float


@record
class _Acting:
    """A force [N] and torque [N m] at a position, all in the body's frame [m]; one value per sample.

    name  of its node; "": it adds no node, and acts on the beam nearest to it
    """

    name: str
    at: ComplexArray
    force: ComplexArray
    torque: FloatArray


@record
class _Gravity:
    """Gravity less acceleration of the body's points, q(z) = base - rate z [m/s²], in the body's frame."""

    base: ComplexArray
    rate: ComplexArray

    def at(self, point: ComplexField) -> ComplexArray:
        return np.asarray(self.base - self.rate * point)


def internal_forces(
    forces: Forces,
    body: str,
    inertias: Mapping[str, Inertia],
    loads: Sequence[Load] = (),
    *,
    line_mass: float = 0.0,
    points: Sequence[str] = (),
) -> LinkForces:
    """Axial force, shear and bending moment along a body over its motion; NaN where the forces are.

    forces      of `inverse`              inertias, loads  as given to it
    line_mass   of the beams [kg/m]; as much of it as the body's mass allows      points  further nodes, by name

    Raises MechanismError for an unknown body or point.
    """
    mechanism, samples = forces.mechanism, len(forces.motion)
    mechanism.body(body)
    known = {name: inertias.get(name, MASSLESS) for name in mechanism.moving}
    with np.errstate(invalid="ignore", over="ignore"):
        poses = pose_block(forces.motion, known)
        moved = poses.bodies[body]
        back = np.broadcast_to(np.conj(moved.direction), samples)
        gravity = sum((load.acceleration for load in loads if isinstance(load, Gravity)), 0j)
        here = _Gravity(
            np.broadcast_to(back * (gravity - moved.carry(0j).acceleration), samples),
            np.broadcast_to(1j * moved.alpha - np.square(moved.omega), samples),
        )
        acting = [*_of_joints(forces, body, poses, back), *_of_loads(forces, body, known, loads, back)]
        frame = with_masses(_frame(mechanism, body, acting, points), known[body], line_mass)
        lines = [_line(frame, edge, here, 0.0) for edge in range(len(frame.tree))]
        acting += _of_masses(frame, known[body], here, lines)
        beams = tuple(_beam(frame, edge, acting, here, lines) for edge in range(len(frame.tree)))
    return LinkForces(
        body=body,
        beams=beams,
        points=dict(zip(frame.names, frame.nodes, strict=True)),
        joints=frame.joints,
        masses=dict(zip(frame.names, frame.masses, strict=True)),
        line_mass=frame.line_mass,
        equilibrium_error=_unbalanced(frame, acting, lines),
    )


def _of_joints(forces: Forces, body: str, poses: PoseBlock, back: ComplexArray) -> Iterator[_Acting]:
    """Forces, couples, efforts and friction of the body's joints and couplings."""
    origin = poses.bodies[body].carry(0j).position
    for name, joint in poses.joints.items():
        if body in (joint.on, joint.by):
            side, place = (1.0 if body == joint.on else -1.0), joint.point_on(body)
            force, moment = forces.acting[name]
            torque = np.asarray(moment + cross(joint.at - place, force))
            at = np.asarray(np.broadcast_to(back * (place - origin), torque.shape))
            yield _Acting("" if joint.tooth is not None else name, at, side * back * force, side * torque)


def _of_loads(
    forces: Forces, body: str, inertias: Mapping[str, Inertia], loads: Sequence[Load], back: ComplexArray
) -> Iterator[_Acting]:
    """Loads on the body, except for gravity, which acts with its mass."""
    others = (load for load in loads if not isinstance(load, Gravity))
    wrenches = [one for load in others for one in load.wrenches(forces.motion, inertias) if one.body == body]
    for number, wrench in enumerate(wrenches, start=1):
        torque = np.broadcast_to(np.asarray(wrench.torque, dtype=float), back.shape)
        name = "" if np.ndim(wrench.force) == 0 and wrench.force == 0 else f"load {number}"
        yield _Acting(name, np.full(back.shape, complex(wrench.at)), np.asarray(back * wrench.force), torque)


def _frame(mechanism: Mechanism, body: str, acting: Iterable[_Acting], points: Iterable[str]) -> LinkFrame:
    """Nodes and tree: joints, further points, and the ends of the travel of what slides along the body."""
    own = mechanism.body(body).points
    size = max((abs(point) for point in own.values()), default=0.0) or 1.0
    nodes: dict[str, complex] = {}
    fixed = [joint.name for joint in mechanism.joints if body in _fixed_on(joint)]
    wheels = (point for coupling in mechanism.couplings for who, point in coupling.ends if who == body)
    named = [(name, mechanism.point(body, name)) for name in (*fixed, *wheels, *points)]
    for name, position in (*named, *(end for one in acting if one.name not in fixed for end in _travel(one, size))):
        if all(abs(position - other) > SAME * size for other in nodes.values()):
            point = next((known for known, at in own.items() if abs(at - position) <= SAME * size), name)
            nodes[point] = position
    joined = [own[name] for name in fixed]
    at_joints = (name for name, at in nodes.items() if any(abs(at - other) <= SAME * size for other in joined))
    return frame_through(nodes, frozenset(at_joints))


def _fixed_on(joint: Joint) -> tuple[str, ...]:
    """Bodies on which the joint has one fixed point: both of a pin, the slider of a slide."""
    return (joint.body,) if isinstance(joint, Slide) else joint.bodies


def _travel(acting: _Acting, size: float) -> Iterator[tuple[str, complex]]:
    """A load's node, or the two ends of its travel along the body."""
    at = acting.at[np.isfinite(acting.at)]
    if not acting.name or not at.size:
        return
    reach = at[np.argmax(np.abs(at - at[0]))] - at[0]
    if abs(reach) <= SAME * size:
        yield acting.name, complex(at[0])
        return
    along = dot(reach / abs(reach), at - at[0])
    yield f"{acting.name} (start)", complex(at[np.argmin(along)])
    yield f"{acting.name} (end)", complex(at[np.argmax(along)])


def _line(frame: LinkFrame, edge: int, here: _Gravity, at: RealField) -> tuple[ComplexArray, FloatArray]:
    """Force of the line mass beyond a position on an edge [m], or positions in a column, and its moment about the
    body's origin.
    """
    start, end = frame.ends(edge)
    length = abs(end - start)
    direction, left = (end - start) / length, length - at
    section = start + direction * at
    load = frame.line_mass * here.at(section)
    force = frame.line_mass * left * here.at(section + direction * left / 2)
    moment = left**2 / 2 * cross(direction, load)
    moment -= frame.line_mass * left**3 / 3 * cross(direction, here.rate * direction)
    return force, np.asarray(moment + cross(section, force))


def _of_masses(
    frame: LinkFrame, inertia: Inertia, here: _Gravity, lines: Sequence[tuple[ComplexArray, FloatArray]]
) -> list[_Acting]:
    """Forces of the masses at the nodes, and what is left of the body's inertia, at its mass centre."""
    none = np.zeros(here.base.shape)
    masses = [
        _Acting("", np.full(here.base.shape, at), np.asarray(mass * here.at(at)), none)
        for at, mass in zip(frame.nodes, frame.masses, strict=True)
        if mass
    ]
    moment = inertia.mass * inertia.centre
    force = inertia.mass * here.base - here.rate * moment
    turning = cross(moment, here.base) - inertia.about(0j) * here.rate.imag
    force = force - sum((one.force for one in masses), none) - sum((line[0] for line in lines), none)
    turning = turning - sum((cross(one.at, one.force) for one in masses), none) - sum((line[1] for line in lines), none)
    centre = np.full(here.base.shape, complex(inertia.centre))
    return [*masses, _Acting("", centre, force, np.asarray(turning - cross(centre, force)))]


def _beam(
    frame: LinkFrame,
    edge: int,
    acting: Sequence[_Acting],
    here: _Gravity,
    lines: Sequence[tuple[ComplexArray, FloatArray]],
) -> BeamForces:
    """Internal forces along an edge: of all that acts beyond each section."""
    start, end = frame.ends(edge)
    length = abs(end - start)
    direction = (end - start) / length
    stations, beyond = np.linspace(0.0, length, STATIONS), list(frame.beyond[edge])
    at = stations[:, None]
    force, turning = _line(frame, edge, here, at)
    force = force + sum(lines[other][0] for other in beyond)
    turning = turning + sum(lines[other][1] for other in beyond)
    for one in acting:
        # Where it acts at one point of the link, what is beyond is the same for all samples.
        still = one.at.size > 0 and bool((np.abs(one.at - one.at[0]) <= _ROUNDING * length).all())
        on, along = frame.nearest(one.at[:1] if still else one.at)
        past = np.isin(on, beyond)
        far = past | ((on == edge) & (along > SAME * length) & (along >= at - SAME * length))
        if far.any():
            torque = one.torque + cross(one.at, one.force)
            force = force + (one.force if far.all() else np.where(far, one.force, 0))
            turning = turning + (torque if far.all() else np.where(far, torque, 0.0))
    moment = np.asarray(turning - cross(start + direction * at, force))
    first, last = (frame.names[node] for node in frame.tree[edge])
    axial, shear = np.asarray(dot(direction, force)), np.asarray(cross(direction, force))
    return BeamForces(first, last, length, stations, axial, shear, moment)


def _unbalanced(frame: LinkFrame, acting: Sequence[_Acting], lines: Sequence[tuple[ComplexArray, FloatArray]]) -> float:
    """Greatest sum of all forces and of all moments about the origin, over that of their magnitudes [1]."""
    forces = [*(one.force for one in acting), *(line[0] for line in lines)]
    moments = [*(one.torque + cross(one.at, one.force) for one in acting), *(line[1] for line in lines)]
    pulled, turned = (np.sum(np.abs(parts), axis=0) for parts in (forces, moments))
    reach = max(map(abs, frame.nodes), default=0.0)
    found = ((np.abs(sum(forces)), pulled), (np.abs(sum(moments)), turned + reach * pulled))
    tops = ((np.nanmax(total, initial=0.0), np.nanmax(size, initial=0.0)) for total, size in found)
    return max(float(total / top) if top > 0 else 0.0 for total, top in tops)

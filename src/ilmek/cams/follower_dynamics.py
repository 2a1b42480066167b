"""Dynamic response of a follower of one or more masses on springs, driven by a cam.

The masses form a row of springs and dampers; the first one follows the cam's surface y:

    M x'' + C x' + K x = (k1 y + c1 y') e1                                 [Norton, Cam Design and Manufacturing, 10]

K contains the springs of the row and the return springs r to the frame. With the deviation z = x - y of each mass,

    M z'' + C z' + K z = -m y'' - r y

is linear, and its right side is smooth between the knots of the motion. In modal coordinates q, each with
q' = mu q + f, it is solved exactly by

    q(t + h) = e^(mu h) q(t) + integral of e^(mu (h - s)) f(t + s) ds

Gauss' rule gives the integral, exact to rounding, over panels that are short against every natural period. A step of
the cam's velocity adds an impulse. The periodic motion follows from the condition that the state repeats after a turn.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.follower_model import FollowerModel, Stage, one_mass
from ilmek.cams.laws import Law
from ilmek.cams.programme import TURN, CamProgramme, FollowerMotion, jumps
from ilmek.errors import ParameterError
from ilmek.records import record
from ilmek.report.framed import Framed

__all__ = [
    "FollowerModel",
    "Response",
    "Stage",
    "one_mass",
    "residual_of",
    "rise_response",
    "steady_response",
]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)
_REACH = 2.0
"""Largest |mu h| of a panel: Gauss' rule with 12 points is exact to rounding within it."""

_MOST_PANELS = 200_000
_BESIDE = 1e-12
_RESONANT = 1e-9
_DEFECTIVE = 1e7
_APART = 1e-10


@record
class Response(Framed):
    """Response of a follower.

    at            time in a rise [s], or cam angle in a turn [rad], ascending, (points,)
    cam           displacement given by the cam [m], (points,)
    displacement, velocity, acceleration   of the masses from the cam outwards [m, m/s, m/s^2], (masses, points)
    contact       force on the cam [N], (points,); below 0 the follower leaves the cam
    over          heading of `at`
    """

    at: FloatArray
    cam: FloatArray
    displacement: FloatArray
    velocity: FloatArray
    acceleration: FloatArray
    contact: FloatArray
    over: str

    def table(self) -> dict[str, FloatArray]:
        """Columns by heading: displacement of the cam, motion of each mass from the cam outwards, force on the cam."""
        columns = {self.over: self.at, "cam displacement [m]": self.cam}
        rows = zip(self.displacement, self.velocity, self.acceleration, strict=True)
        for number, motion in enumerate(rows, 1):
            units = ("displacement [m]", "velocity [m/s]", "acceleration [m/s^2]")
            columns |= {f"mass {number} {unit}": values for unit, values in zip(units, motion, strict=True)}
        return {**columns, "contact [N]": self.contact}

    @property
    def lag(self) -> FloatArray:
        """Deviation of each mass from the displacement of the cam [m], (masses, points)."""
        return np.asarray(self.displacement - self.cam)


def rise_response(
    follower: FollowerModel, law: Law, lift: float, time: float, *, after: float = 1.0, count: int = 401
) -> Response:
    """Response of a follower from rest to a rise, and after it.

    lift, time  of the rise [m, s]      after  time after the rise, over `time` [-]
    count       of even points over the whole time; the knots of the law are added
    Raises ParameterError for a time that is not above 0, and for a follower too stiff to be integrated.
    """
    motion = _of_law(law, after)
    return _response(follower, motion, _even(0.0, 1.0 + after, count), (_rate(time), lift, time), _from_rest)


def steady_response(follower: FollowerModel, programme: CamProgramme, speed: float, count: int = 721) -> Response:
    """Periodic response of a follower over one turn, from the programme's start.

    speed  of the cam [rad/s]      count  of even points over the turn; the knots of the programme are added
    Raises ParameterError where an undamped follower resonates with a multiple of the speed, and where it is too stiff.
    """
    motion = _of_programme(programme)
    points = _even(programme.start, programme.start + TURN, count)
    return _response(follower, motion, points, (speed, 1.0, 1.0), _repeating)


def residual_of(follower: FollowerModel, law: Law, time: float) -> FloatArray:
    """Residual amplitude of each mass after a rise in `time` [s], over the lift [-], (masses,): the sum over the modes.

    For one mass without return spring it equals `vibration.residual` at the time ratio time x frequency / 2 pi.
    """
    motion = _of_law(law, 0.0)
    modes = _modes(follower, _rate(time))
    _, states = _states(modes, motion, np.array([0.0, 1.0]), _from_rest)
    # The static deflection by the return springs is no vibration.
    swing = states[:, -1] + modes.driven @ np.array([1.0, 0.0]) / modes.rates
    oscillates = np.abs(modes.rates.imag) > _BESIDE * np.abs(modes.rates)
    return np.asarray(np.abs(modes.shapes[: follower.masses.size] * (swing * oscillates)).sum(axis=1))


@dataclass(frozen=True, slots=True)
class _Motion:
    """Excitation of the follower: s, s', s'' over the parameter (time ratio or cam angle), its knots, steps of s'."""

    curve: Callable[[FloatArray], FloatArray]
    knots: FloatArray
    kicks: tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class _Modes:
    """Natural modes over the parameter: q' = rates q + driven (s, s''), state (z, z') = Re shapes q."""

    rates: ComplexArray
    shapes: ComplexArray
    driven: ComplexArray
    kicked: ComplexArray


def _rate(time: float) -> float:
    if not 0 < time < math.inf:
        raise ParameterError(f"a rise in {time:g} s", allowed="above 0")
    return 1.0 / time


def _of_law(law: Law, after: float) -> _Motion:
    def curve(u: FloatArray) -> FloatArray:
        at = law.motion(np.minimum(u, 1.0))
        still = u >= 1.0
        return np.array([np.where(still, law.s(1.0), at.s), np.where(still, 0.0, at.v), np.where(still, 0.0, at.a)])

    ends = (0.0, *law.breaks, 1.0, *([1.0 + after] if after else []))
    return _Motion(curve, np.array(ends), ((0.0, float(law.v(0.0))), (1.0, -float(law.v(1.0)))))


def _of_programme(programme: CamProgramme) -> _Motion:
    def curve(angle: FloatArray) -> FloatArray:
        at: FollowerMotion = programme.motion(angle)
        return np.array(at[:3])

    kicks = tuple((jump.angle, jump.after - jump.before) for jump in jumps(programme, 1))
    return _Motion(curve, programme.knots, kicks)


def _modes(follower: FollowerModel, speed: float) -> _Modes:
    if not (speed > 0 and math.isfinite(speed)):
        raise ParameterError(f"a follower driven at {speed:g} rad/s", allowed="above 0")
    n, mass = follower.masses.size, follower.masses[:, None]
    system = np.zeros((2 * n, 2 * n))
    system[:n, n:] = np.eye(n)
    system[n:, :n] = -follower.stiffness / mass / speed**2
    for damping in (follower.damping, follower.damping * (1.0 + _APART)):
        system[n:, n:] = -damping / mass / speed
        rates, shapes = np.linalg.eig(system)
        # At critical damping two modes coincide; a trace more damping separates them.
        if np.linalg.cond(shapes / np.abs(shapes).max(axis=0)) < _DEFECTIVE:
            break
    inverse = np.linalg.inv(shapes)
    force = np.zeros((2 * n, 2))
    force[n:, 0] = -follower.return_rates / follower.masses / speed**2
    force[n:, 1] = -1.0
    return _Modes(
        *(np.asarray(part, complex) for part in (rates, shapes, inverse @ force, -inverse[:, n:].sum(axis=1)))
    )


def _states(
    modes: _Modes, motion: _Motion, points: FloatArray, begin: Callable[[ComplexArray, ComplexArray], ComplexArray]
) -> tuple[FloatArray, ComplexArray]:
    """Points with knots and panel ends, and the modal states there, (modes, points), after the impulses."""
    edges = _panels(np.unique(np.concatenate([motion.knots, points])), float(np.max(np.abs(modes.rates))))
    length = np.diff(edges)
    grow = np.exp(modes.rates[:, None] * length)
    gain = _gains(modes, motion, edges)
    for at, step in motion.kicks:
        first = int(np.searchsorted(edges, at - _BESIDE))
        kick = modes.kicked * step
        gain[:, first] += kick
    state = np.empty((modes.rates.size, edges.size), complex)
    state[:, 0] = begin(np.exp(modes.rates * (edges[-1] - edges[0])), _march(grow, gain, 0.0 * modes.rates)[:, -1])
    return edges, _march(grow, gain, state[:, 0])


def _march(grow: ComplexArray, gain: ComplexArray, start: ComplexArray) -> ComplexArray:
    """States at all edges: the gain is added at the edge, then the state crosses the panel."""
    state = np.empty(gain.shape, complex)
    state[:, 0] = start + gain[:, 0]
    for i in range(gain.shape[1] - 1):
        state[:, i + 1] = grow[:, i] * state[:, i] + gain[:, i + 1]
    return state


def _gains(modes: _Modes, motion: _Motion, edges: FloatArray) -> ComplexArray:
    """Gain of each mode over the panel that ends at each edge, (modes, edges); 0 at the first edge."""
    half = 0.5 * np.diff(edges)
    ahead = half[:, None] * (1.0 - _NODES)
    cam = motion.curve(edges[1:, None] - ahead)
    force = np.einsum("mf,fpn->mpn", modes.driven, cam[[0, 2]])
    added = np.exp(modes.rates[:, None, None] * ahead) * force * (half[:, None] * _WEIGHTS)
    return np.concatenate([np.zeros((modes.rates.size, 1)), added.sum(axis=-1)], axis=1)


def _panels(edges: FloatArray, fastest: float) -> FloatArray:
    """The edges of panels that are short against the fastest mode."""
    apart = np.concatenate([[True], np.diff(edges) > _BESIDE])
    edges = edges[apart]
    counts = np.ceil(np.diff(edges) * max(fastest / _REACH, 4.0)).astype(int)
    if counts.sum() > _MOST_PANELS:
        raise ParameterError(
            f"follower too stiff: {fastest:g} rad of vibration per unit of the motion", do="model the follower as rigid"
        )
    pieces = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(edges[:-1], edges[1:], counts, strict=True)]
    return np.concatenate([*pieces, edges[-1:]])


def _from_rest(_grown: ComplexArray, _gained: ComplexArray) -> ComplexArray:
    return 0.0 * _gained


def _repeating(grown: ComplexArray, gained: ComplexArray) -> ComplexArray:
    """The state that repeats after a turn: q = grown q + gained."""
    if np.min(np.abs(1.0 - grown)) < _RESONANT:
        raise ParameterError(
            "the follower resonates: a natural frequency is a multiple of the cam's speed, without damping",
            do="give damping, or another speed",
        )
    return gained / (1.0 - grown)


def _even(first: float, last: float, count: int) -> FloatArray:
    return np.linspace(first, last, max(count, 2))


def _response(
    follower: FollowerModel,
    motion: _Motion,
    points: FloatArray,
    units: tuple[float, float, float],
    begin: Callable[[ComplexArray, ComplexArray], ComplexArray],
) -> Response:
    """The response in SI units; `units`: parameter per second, metres per displacement, shown value per parameter."""
    speed, scale, shown = units
    modes, n = _modes(follower, speed), follower.masses.size
    edges, states = _states(modes, motion, points, begin)
    keep = np.isin(edges, np.concatenate([points, motion.knots]))
    edges, z = edges[keep], (modes.shapes @ states[:, keep]).real * scale
    s, ds, _ = motion.curve(edges) * scale
    displacement, velocity = s + z[:n], speed * (ds + z[n:])
    stage = follower.stages[0]
    push = stage.stiffness * z[0] + stage.damping * speed * z[n]
    forces = follower.stiffness @ z[:n] + follower.damping @ (speed * z[n:]) + np.outer(follower.return_rates, s)
    acceleration = -forces / follower.masses[:, None]
    over = "cam angle [rad]" if begin is _repeating else "time [s]"
    return Response(edges * shown, s, displacement, velocity, acceleration, follower.preload - push, over)

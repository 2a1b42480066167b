"""Beside limits, does OK mean two digits of every acceleration? Links of all lengths anywhere, against 40 digits.

A crank carries one, two or three dyads in a row. The last one is at a limit (its links in line, the link normal to
the line, its lines parallel) at the drawn angle of the crank, and the crank is 1e-14 to 1e-3 rad away from it.
"""

from dataclasses import dataclass, field, replace
from decimal import Decimal

import numpy as np

from benchmarks.campaign.forty_digits import DoesNotClose, Placed, fixed, motion
from ilmek.linkage.groups.group import Step
from ilmek.linkage.model import GROUND, Body, Joint, Mechanism, Pin, Rotation, Slide
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.status import Status
from ilmek.linkage.structure import Plan, plan

KINDS = ("RRR", "RRP", "RPR", "PRP", "RPP")
SAMPLES = 8
"""Angles for each mechanism."""

CLEAR = 1e-9
"""Distance from a limit [rad] from which on a sample that closes may not be given as one that does not."""


@dataclass
class NearLimits:
    """What was found.

    samples   angles looked at, of which the exact mechanism closes     ok   of these with status OK
    worst     worst error of an acceleration of these, relative to the largest of its group
    silent    of these with an error above a hundredth, or that do not close
    misjudged  samples that close with the status CANNOT_CLOSE, 1e-9 rad or more from the limit
    good      samples that close with four digits or more               refused  of these without status OK
    """

    samples: int = 0
    ok: int = 0
    worst: float = 0.0
    silent: int = 0
    misjudged: int = 0
    good: int = 0
    refused: int = 0
    cases: list[tuple[Mechanism, float, float]] = field(default_factory=list)


@dataclass
class Drawing:
    """A mechanism drawn in place: every body's frame and points in the world."""

    rng: np.random.Generator
    frames: dict[str, tuple[complex, float]]
    points: dict[str, dict[str, complex]]
    joints: list[Joint]
    branches: dict[str, int]

    def body(self, name: str, near: complex, size: float) -> None:
        offset = size * self.rng.uniform(0, 1) * self.phase()
        self.frames[name], self.points[name] = (near + offset, float(self.rng.uniform(-np.pi, np.pi))), {}

    def phase(self) -> complex:
        return complex(np.exp(1j * self.rng.uniform(-np.pi, np.pi)))

    def mark(self, body: str, point: str, at: complex) -> None:
        origin, angle = self.frames[body]
        self.points[body][point] = complex((at - origin) * np.exp(-1j * angle))

    def pin(self, name: str, first: str, second: str, at: complex) -> None:
        self.mark(first, name, at)
        self.mark(second, name, at)
        self.joints.append(Pin(name, first, second))

    def slide(self, name: str, body: str, guide: str, at: complex, root: complex) -> None:
        """A slide along the line from `root` on the guide to `at` on the body."""
        self.mark(guide, name, root)
        self.mark(body, name, at)
        along = float(np.angle(at - root)) - self.frames[guide][1]
        self.joints.append(Slide(name, body, guide, along, self.frames[body][1] - self.frames[guide][1]))


def length(rng: np.random.Generator) -> float:
    """A link of 1e-4 to 1."""
    return float(10 ** rng.uniform(-4, 0))


def draw(kind: str, dyads: int, rng: np.random.Generator) -> tuple[Mechanism, float]:
    """A mechanism of which the last dyad is at a limit, and the crank's angle there; its ground anywhere."""
    drawing = Drawing(rng, {GROUND: (0j, 0.0)}, {GROUND: {}}, [], {})
    away = float(10 ** rng.uniform(-2, 3)) * drawing.phase() if rng.random() < 0.8 else 0j
    crank, angle = length(rng), float(rng.uniform(-np.pi, np.pi))
    drawing.frames["crank"], drawing.points["crank"] = (away, angle), {}
    drawing.pin("O", GROUND, "crank", away)
    A, carrier = away + crank * drawing.phase(), "crank"
    for k in range(dyads - 1):
        A, carrier = _free_dyad(drawing, k, A, carrier)
    _limit_dyad(drawing, kind, A, carrier)
    bodies = tuple(Body(name, points) for name, points in drawing.points.items())
    inputs = (Rotation("crank", "O"),)
    return Mechanism(bodies, tuple(drawing.joints), inputs, drawing.branches, pose=drawing.frames), angle


def _free_dyad(drawing: Drawing, k: int, A: complex, carrier: str) -> tuple[complex, str]:
    """Two links at a transmission angle of 1e-3 to 1 rad or so; a point of the first carries on."""
    rng, one, two = drawing.rng, f"one {k}", f"two {k}"
    u = length(rng) * drawing.phase()
    bend = float(10 ** rng.uniform(-3, 0)) * rng.choice((-1, 1))
    v = length(rng) * u / abs(u) * np.exp(1j * bend) * rng.choice((-1, 1))
    C, B = A + u, A + u + v
    for body, at, size in ((one, A, abs(u)), (two, B, abs(v))):
        drawing.body(body, at, size)
    drawing.pin(f"A{k}", carrier, one, A)
    drawing.pin(f"B{k}", GROUND, two, complex(B))
    drawing.pin(f"C{k}", one, two, C)
    drawing.branches[f"C{k}"] = 1 if (np.conj(B - A) * (C - A)).imag > 0 else -1
    return A + length(rng) * drawing.phase(), one


def _limit_dyad(drawing: Drawing, kind: str, A: complex, carrier: str) -> None:
    rng = drawing.rng
    u, v = length(rng) * drawing.phase(), length(rng) * drawing.phase()
    if kind == "RRR":
        v = abs(v) * u / abs(u) * rng.choice((-1, 1))
    elif kind in {"RRP", "RPR"}:
        v = abs(v) * 1j * u / abs(u)
    elif kind == "PRP":
        v = abs(v) * u / abs(u)
    C, B = A + u, A + u + v
    if kind == "RPR":
        # Pin A, foot C of A on the slide's line, slide normal to A -> C: B is on the line at C, t = 0.
        B = C
    for body, at, size in (("p", A, abs(u)), ("q", B, abs(v))):
        drawing.body(body, complex(at), size)
    drawing.branches["C"] = int(rng.choice((-1, 1)))
    if kind == "RRR":
        drawing.pin("A", carrier, "p", A)
        drawing.pin("B", GROUND, "q", B)
        drawing.pin("C", "p", "q", C)
    elif kind == "RRP":
        drawing.pin("A", carrier, "p", A)
        drawing.slide("B", "q", GROUND, C + v, C - length(rng) * v / abs(v))
        drawing.pin("C", "p", "q", C)
    elif kind == "RPR":
        drawing.pin("A", carrier, "p", A)
        drawing.pin("B", GROUND, "q", C)
        drawing.slide("C", "q", "p", C + v, C - length(rng) * v / abs(v))
    elif kind == "PRP":
        drawing.slide("A", "p", carrier, A, A - length(rng) * u / abs(u))
        drawing.slide("B", "q", GROUND, B, B + length(rng) * u / abs(u))
        drawing.pin("C", "p", "q", C)
        drawing.branches.pop("C")
    else:
        drawing.pin("A", carrier, "p", A)
        drawing.slide("B", "q", GROUND, B, B - length(rng) * v / abs(v))
        drawing.slide("C", "p", "q", C, C - u)
        drawing.branches.pop("C")


def near_limits(
    kind: str, count: int, rng: np.random.Generator, *, dyads: int = 1, closed_forms: bool = True
) -> NearLimits:
    """Random mechanisms, `SAMPLES` angles each."""
    found = NearLimits()
    for _ in range(count):
        mechanism, angle = draw(kind, dyads, rng)
        exact = plan(mechanism)
        steps = exact if closed_forms else _followed(exact, angle)
        if steps is None:
            continue
        angles = angle + rng.choice((-1.0, 1.0), SAMPLES) * 10 ** rng.uniform(-14, -3, SAMPLES)
        speed, gain = float(rng.uniform(0.5, 2)), float(rng.uniform(-1, 1))
        parts = (angles,) if closed_forms else np.split(angles, SAMPLES)  # Newton's method: each from the pose alone
        for part in parts:
            moved = solve(steps, part, speed, gain)
            for k in range(len(part)):
                _compare(found, exact, moved, k, (float(part[k]), speed, gain), either=not closed_forms)
                if moved.status[k] == Status.CANNOT_CLOSE and abs(part[k] - angle) >= CLEAR:
                    found.misjudged += _closes(exact, (float(part[k]), speed, gain))
    return found


def _closes(exact: Plan, drive: tuple[float, float, float]) -> bool:
    try:
        motion(exact, drive)
    except DoesNotClose:
        return False
    return True


def _followed(exact: Plan, angle: float) -> Plan | None:
    """The plan for Newton's method, from a pose a tenth of a radian beside the limit; None where it does not close."""
    beside = solve(exact, angle + np.array([-0.1, 0.1]))
    closes = np.flatnonzero(beside.status == Status.OK)
    if not len(closes):
        return None
    return plan(replace(exact.mechanism, pose=beside.pose(int(closes[0]))), closed_forms=False)


def _compare(
    found: NearLimits, exact: Plan, moved: Motion, k: int, drive: tuple[float, float, float], *, either: bool
) -> None:
    """One sample; either: the branch of the last dyad is open, as Newton's method may follow either from a limit."""
    ok = moved.status[k] == Status.OK
    try:
        possible = [motion(one, drive) for one in ((exact, _other(exact)) if either else (exact,))]
    except DoesNotClose:
        found.silent += int(ok)
        if ok:
            found.cases.append((exact.mechanism, drive[0], np.inf))
        return
    found.samples += 1
    found.ok += int(ok)
    error = min(max(_error(exact.mechanism, step, moved, k, bodies) for step in exact.steps[1:]) for bodies in possible)
    error = error if np.isfinite(error) else np.inf
    if error <= 1e-4:
        found.good += 1
        found.refused += int(not ok)
    if ok:
        found.worst = max(found.worst, error)
    if (ok and error > 0.01) or (error <= 1e-4 and not ok):
        found.silent += int(ok)
        found.cases.append((exact.mechanism, drive[0], error))


def _other(exact: Plan) -> Plan:
    """The same with the last dyad on its other branch."""
    mechanism = exact.mechanism
    branches = {pin: -sign if pin == "C" else sign for pin, sign in mechanism.branches.items()}
    return plan(replace(mechanism, branches=branches))


def _error(mechanism: Mechanism, step: Step, moved: Motion, k: int, bodies: dict[str, Placed]) -> float:
    """The largest error of a group's accelerations: of its joints, and of its links' ends against one another."""
    turns, joints = [(0.0, 0.0)], [(0.0, 0.0)]
    for body in step.bodies:
        points = mechanism.body(body).points
        for point, local in points.items():
            at = bodies[body].carry(local)
            ours = complex(np.asarray(moved.point(body, point).acceleration)[k])
            joints.append(_apart(ours, at.x.a, at.y.a))
        arm = max(abs(one - other) for one in points.values() for other in points.values())
        omega, alpha = bodies[body].rates
        ours = complex(-(moved.omega(body)[k] ** 2), moved.alpha(body)[k])
        turns.append(tuple(arm * one for one in _apart(ours, -omega * omega, alpha)))  # type: ignore[arg-type]
    for joint in mechanism.joints:
        if isinstance(joint, Slide) and joint.body in step.bodies:
            end, root = (bodies[body].carry(mechanism.point(body, joint.name)) for body in joint.bodies)
            e = bodies[joint.guide].direction * fixed(joint.along)
            gain = (end - root).turned_back(e).x.a
            column = moved.columns[joint.body]
            if not np.iscomplexobj(column[0]):
                turns.append((abs(float(Decimal(float(column[2][k])) - gain)), abs(float(gain))))
    return max(_ratio(turns), _ratio(joints))


def _apart(ours: complex, x: Decimal, y: Decimal) -> tuple[float, float]:
    """Distance of a number from the exact one, and the exact one's magnitude."""
    if not np.isfinite(ours):
        return np.inf, float(abs(complex(float(x), float(y))))
    return float(abs(complex(float(Decimal(ours.real) - x), float(Decimal(ours.imag) - y)))), abs(
        complex(float(x), float(y))
    )


def _ratio(pairs: list[tuple[float, float]]) -> float:
    largest = max(size for _, size in pairs)
    return max(error for error, _ in pairs) / largest if largest else 0.0
